//! A folder of contents named by their hash, and of small files that carry their own hash: safe under many writers,
//! bounded in size. Nothing is forced to the disk, since all is verified when it is read.

use super::files::read_limited;
use std::io::{Result, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime};

/// Largest file that is read, bytes.
const MAX_FILE: u64 = 1 << 30;
/// The part of the limit that is left after trimming.
const LEFT: f64 = 0.8;
/// A temporary file of this age belongs to no living program.
const OLD: Duration = Duration::from_secs(3600);

/// The result of reading.
pub enum Found {
    /// The content, with the right hash.
    Good(Vec<u8>),
    /// It is there, but is not what was written.
    Damaged,
    /// It is not there.
    Nothing,
}

/// The folder.
pub struct Store {
    root: PathBuf,
    limit: u64,
    has_grown: AtomicBool,
}

impl Store {
    /// A store in a folder, which need not be there yet.
    pub fn new(root: &Path, limit: u64) -> Self {
        Self { root: root.to_path_buf(), limit, has_grown: AtomicBool::new(false) }
    }

    /// Names of the files of a kind below a key, in order.
    pub fn names(&self, kind: &str, key: &str) -> Vec<String> {
        let folder = self.root.join(kind).join(&key[..2]).join(key);
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let mut names: Vec<String> = entries.filter_map(|e| e.file_name().into_string().ok()).collect();
        names.retain(|n| !n.starts_with('.'));
        names.sort();
        names
    }

    /// Stores a content; gives its hash.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn put(&self, bytes: &[u8]) -> Result<String> {
        let hash = blake3::hash(bytes).to_hex().to_string();
        let path = self.object_path(&hash);
        // One that is there already may be damaged.
        if read(&path).as_deref() != Some(bytes) {
            self.write(&path, &[bytes])?;
        }
        Ok(hash)
    }

    /// A content by its hash.
    pub fn object(&self, hash: &str) -> Found {
        if hash.len() != 64 || !hash.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Found::Damaged;
        }
        let path = self.object_path(hash);
        let Some(bytes) = read(&path) else { return Found::Nothing };
        if blake3::hash(&bytes).to_hex().as_str() == hash { used(&path, bytes) } else { drop_damaged(&path) }
    }

    /// A small file that begins with the hash of the rest.
    pub fn sealed(&self, name: &str) -> Found {
        let path = self.root.join(name);
        let Some(bytes) = read(&path) else { return Found::Nothing };
        match bytes.split_at_checked(64) {
            Some((hash, text)) if blake3::hash(text).to_hex().as_bytes() == hash => used(&path, text.to_vec()),
            _ => drop_damaged(&path),
        }
    }

    /// Writes such a file.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn seal(&self, name: &str, text: &[u8]) -> Result<()> {
        self.write(&self.root.join(name), &[blake3::hash(text).to_hex().as_bytes(), text])
    }

    fn object_path(&self, hash: &str) -> PathBuf {
        self.root.join("objects").join(&hash[..2]).join(hash)
    }

    /// Under a name that nobody else has, then renamed.
    fn write(&self, path: &Path, parts: &[&[u8]]) -> Result<()> {
        let folder = path.parent().unwrap_or(&self.root);
        std::fs::create_dir_all(folder)?;
        let mut file = tempfile::Builder::new().prefix(".new-").tempfile_in(folder)?;
        for part in parts {
            file.write_all(part)?;
        }
        file.persist(path).map_err(|e| e.error)?;
        self.has_grown.store(true, Ordering::Relaxed);
        Ok(())
    }

    /// Removes what was used longest ago until the store is well within its limit, if this program has added anything.
    pub fn trim(&self) {
        if !self.has_grown.load(Ordering::Relaxed) {
            return;
        }
        let mut files = Vec::new();
        walk(&self.root, 4, &mut files);
        let mut whole: u64 = files.iter().map(|f| f.1).sum();
        if whole <= self.limit {
            return;
        }
        files.sort();
        for (_, size, path) in files {
            if whole as f64 <= LEFT * self.limit as f64 {
                break;
            }
            // Another program may have removed it already.
            drop(std::fs::remove_file(&path));
            whole -= size;
        }
    }
}

/// Time of the last use, size and path of all files; old temporaries go.
fn walk(folder: &Path, depth: u32, found: &mut Vec<(SystemTime, u64, PathBuf)>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let Ok(meta) = entry.metadata() else { continue };
        let path = entry.path();
        if meta.is_dir() && depth > 0 {
            walk(&path, depth - 1, found);
        } else if meta.is_file() {
            let time = meta.modified().unwrap_or(SystemTime::UNIX_EPOCH);
            let is_new = entry.file_name().to_string_lossy().starts_with(".new-");
            if is_new && time.elapsed().is_ok_and(|age| age > OLD) {
                drop(std::fs::remove_file(&path));
            } else if !is_new {
                found.push((time, meta.len(), path));
            }
        }
    }
}

fn read(path: &Path) -> Option<Vec<u8>> {
    read_limited(path, path, MAX_FILE).ok()
}

/// Notes the time of use, for trimming.
fn used(path: &Path, bytes: Vec<u8>) -> Found {
    // A folder that may only be read is no mistake.
    drop(std::fs::File::options().append(true).open(path).and_then(|f| f.set_modified(SystemTime::now())));
    Found::Good(bytes)
}

fn drop_damaged(path: &Path) -> Found {
    drop(std::fs::remove_file(path));
    Found::Damaged
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_good(found: &Found, bytes: &[u8]) -> bool {
        matches!(found, Found::Good(b) if b == bytes)
    }

    #[test]
    fn what_is_damaged_is_found_and_removed() {
        let dir = tempfile::tempdir().expect("folder");
        let store = Store::new(dir.path(), 1 << 20);
        let hash = store.put(b"cloth").expect("stored");
        assert!(is_good(&store.object(&hash), b"cloth"));
        std::fs::write(store.object_path(&hash), b"clotH").expect("damage");
        assert!(matches!(store.object(&hash), Found::Damaged));
        assert!(matches!(store.object(&hash), Found::Nothing));
        store.seal("entries/ab/x", b"text").expect("sealed");
        assert!(is_good(&store.sealed("entries/ab/x"), b"text"));
        std::fs::write(dir.path().join("entries/ab/x"), b"short").expect("damage");
        assert!(matches!(store.sealed("entries/ab/x"), Found::Damaged));
        assert!(matches!(store.object("../../etc/passwd"), Found::Damaged));
        store.put(b"cloth").expect("stored");
        std::fs::write(store.object_path(&hash), b"clotH").expect("damage");
        store.put(b"cloth").expect("stored again");
        assert!(is_good(&store.object(&hash), b"cloth"), "a damaged content is written anew");
    }

    #[test]
    fn what_was_used_longest_ago_goes_first() {
        let dir = tempfile::tempdir().expect("folder");
        let store = Store::new(dir.path(), 3000);
        let hashes: Vec<String> = (0..4_u8).map(|k| store.put(&[k; 1000]).expect("stored")).collect();
        for (k, hash) in hashes.iter().enumerate() {
            let file = std::fs::File::options().append(true).open(store.object_path(hash)).expect("file");
            file.set_modified(SystemTime::UNIX_EPOCH + Duration::from_secs(k as u64)).expect("time");
        }
        assert!(is_good(&store.object(&hashes[0]), &[0; 1000]), "a use makes it the newest");
        store.trim();
        let left: Vec<bool> = hashes.iter().map(|h| store.object_path(h).exists()).collect();
        assert_eq!(left, [true, false, false, true]);
    }

    #[test]
    fn many_writers_of_one_content_do_not_meet() {
        let dir = tempfile::tempdir().expect("folder");
        let bytes = vec![7_u8; 200_000];
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    let store = Store::new(dir.path(), 1 << 30);
                    for _ in 0..20 {
                        let hash = store.put(&bytes).expect("stored");
                        store.seal("entries/ab/x", hash.as_bytes()).expect("sealed");
                        assert!(is_good(&store.sealed("entries/ab/x"), hash.as_bytes()));
                        assert!(is_good(&store.object(&hash), &bytes));
                    }
                });
            }
        });
        let mut files = Vec::new();
        walk(dir.path(), 4, &mut files);
        assert_eq!(files.len(), 2);
    }
}
