//! The archive: tar, in the plain form that every program reads. The same files give the same bytes.

use std::io::{Read as _, Result};
use tar::{Archive, Builder, EntryType, Header};

/// Permissions of all entries.
const MODE: u32 = 0o644;

/// Writes entries in this order: no owner, no date.
///
/// # Errors
/// When a path is too long for the archive.
pub(super) fn write<'a>(entries: impl Iterator<Item = (&'a str, &'a [u8])>) -> Result<Vec<u8>> {
    let mut builder = Builder::new(Vec::new());
    for (path, bytes) in entries {
        let mut header = Header::new_ustar();
        header.set_path(path)?;
        header.set_mode(MODE);
        header.set_uid(0);
        header.set_gid(0);
        header.set_mtime(0);
        header.set_size(bytes.len() as u64);
        header.set_entry_type(EntryType::Regular);
        header.set_cksum();
        builder.append(&header, bytes)?;
    }
    builder.into_inner()
}

/// An entry of an archive from elsewhere.
pub(super) struct Entry {
    /// Its path as written; `None` if it is no text.
    pub path: Option<String>,
    /// True for a plain file.
    pub is_file: bool,
    /// The size that it states.
    pub size: u64,
    /// Its bytes; empty where it is larger than `most` says.
    pub bytes: Vec<u8>,
}

/// Reads entries one by one until `see` has seen enough. `most` tells the largest size of an entry that is read.
///
/// # Errors
/// When the archive is damaged.
pub(super) fn read(archive: &[u8], most: &dyn Fn(&str) -> u64, see: &mut dyn FnMut(Entry) -> bool) -> Result<()> {
    // Raw: entries that change the meaning of others are refused like all that is no plain file.
    for entry in Archive::new(archive).entries()?.raw(true) {
        let entry = entry?;
        let path = String::from_utf8(entry.path_bytes().into_owned()).ok();
        let is_file = entry.header().entry_type() == EntryType::Regular;
        let size = entry.header().entry_size()?;
        let limit = path.as_deref().map_or(0, most);
        let mut bytes = Vec::new();
        if is_file && size <= limit {
            entry.take(limit).read_to_end(&mut bytes)?;
        }
        if !see(Entry { path, is_file, size, bytes }) {
            break;
        }
    }
    Ok(())
}
