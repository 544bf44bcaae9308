//! Files of a ZIP archive, as a material comes in (`.u3ma`). The `zip` crate reads them.
//!
//! An archive is read as hostile: the number of its files and the size of each are bounded, whatever it states.

use super::MAX_BYTES;
use std::io::{Cursor, Read};
use zip::ZipArchive;
use zip::result::ZipError;

/// The beginning of an archive that holds a file.
pub const ARCHIVE: &[u8] = b"PK\x03\x04";
/// Most files of an archive.
const MOST_FILES: usize = 4096;

/// An archive.
#[derive(Clone, Debug)]
pub struct Archive {
    bytes: Vec<u8>,
    names: Vec<String>,
}

impl Archive {
    /// Reads the list of files.
    ///
    /// # Errors
    /// Words for what is wrong.
    pub fn open(bytes: Vec<u8>) -> Result<Self, String> {
        let damaged = |_: ZipError| "the list of its files is missing, damaged or cut short".to_owned();
        let list = opened(&bytes).map_err(damaged)?;
        if list.len() > MOST_FILES {
            return Err(format!("it holds {} files, over the limit of {MOST_FILES}", list.len()));
        }
        let names = list.file_names().map(|name| name.map(|n| n.into_owned())).collect::<Result<_, _>>();
        let names = names.map_err(damaged)?;
        Ok(Self { bytes, names })
    }

    /// The names of all files.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    /// The bytes of a file. Folders may be parted by `/` or `\\`.
    ///
    /// # Errors
    /// Words for what is wrong.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let damaged = || format!("`{name}` in it is damaged");
        let known = self.names.iter().find(|n| n.replace('\\', "/") == name.replace('\\', "/"));
        let known = known.ok_or_else(|| format!("it does not hold `{name}`"))?;
        let mut list = opened(&self.bytes).map_err(|_| damaged())?;
        let file = list.by_name(known).map_err(|why| match why {
            ZipError::UnsupportedArchive(what) => format!("`{name}` in it is not read: {what}"),
            _ => damaged(),
        })?;
        let most = MAX_BYTES as u64;
        let mut out = Vec::new();
        file.take(most + 1).read_to_end(&mut out).map_err(|_| damaged())?;
        if out.len() > MAX_BYTES {
            return Err(format!("`{name}` in it has more than {MAX_BYTES} bytes, which is the limit"));
        }
        Ok(out)
    }
}

fn opened(bytes: &[u8]) -> Result<ZipArchive<Cursor<&[u8]>>, ZipError> {
    ZipArchive::new(Cursor::new(bytes))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use std::io::Write;
    use zip::write::SimpleFileOptions;
    use zip::{CompressionMethod, ZipWriter};

    /// An archive of these files; every second one is deflated.
    pub fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
        let mut out = ZipWriter::new(Cursor::new(Vec::new()));
        for (k, (name, data)) in files.iter().enumerate() {
            let way = if k % 2 == 0 { CompressionMethod::Stored } else { CompressionMethod::Deflated };
            out.start_file(*name, SimpleFileOptions::default().compression_method(way)).expect("a file");
            out.write_all(data).expect("written");
        }
        out.finish().expect("an archive").into_inner()
    }

    #[test]
    fn files_are_read_whether_they_are_stored_or_deflated() {
        let long = b"warp and weft ".repeat(200);
        let archive = Archive::open(archive(&[("a.u3m", b"{}"), ("maps/base.png", &long)])).expect("an archive");
        assert_eq!(archive.names().collect::<Vec<_>>(), ["a.u3m", "maps/base.png"]);
        assert_eq!((archive.read("a.u3m"), archive.read("maps\\base.png")), (Ok(b"{}".to_vec()), Ok(long)));
        assert!(archive.read("b").is_err_and(|why| why.contains("does not hold `b`")));
    }

    #[test]
    fn damaged_archives_are_refused_and_nothing_panics() {
        let long = b"warp and weft ".repeat(20);
        let whole = archive(&[("a.u3m", b"{}"), ("base.png", &long)]);
        for cut in 0..whole.len() {
            assert!(Archive::open(whole[..cut].to_vec()).is_err(), "cut at {cut}");
        }
        for at in 0..whole.len() {
            let mut changed = whole.clone();
            changed[at] ^= 0x5a;
            // What is read is what was written, or nothing is.
            let read = Archive::open(changed).and_then(|a| a.read("base.png"));
            assert!(read.is_err() || read == Ok(long.clone()), "byte {at}");
        }
    }
}
