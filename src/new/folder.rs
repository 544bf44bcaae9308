//! The files of a working folder; those that are there already are kept.

use crate::engine::Temps;
use std::path::{Path, PathBuf};

/// Files by their names.
#[derive(Debug, Default)]
pub struct Folder {
    files: Vec<File>,
}

#[derive(Debug)]
struct File {
    name: String,
    bytes: Vec<u8>,
    /// True for files of the program's own, which a new one replaces.
    is_ours: bool,
}

/// The fate of the files.
#[derive(Debug, Default)]
pub struct Made {
    /// Written.
    pub written: Vec<PathBuf>,
    /// Kept as they were.
    pub kept: Vec<PathBuf>,
}

impl Folder {
    /// Adds a file, which is written only if there is none of its name.
    pub fn add(&mut self, name: &str, bytes: Vec<u8>) {
        self.files.push(File { name: name.to_owned(), bytes, is_ours: false });
    }

    /// Adds a file that is the program's own, and replaces the one before it.
    pub fn replace(&mut self, name: &str, bytes: Vec<u8>) {
        self.files.push(File { name: name.to_owned(), bytes, is_ours: true });
    }

    /// The content of a file.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        self.files.iter().find(|f| f.name == name).map(|f| f.bytes.as_slice())
    }

    /// Writes the files into a folder, which is made if it is not there. They get their names in the order in which they
    /// were added, once all of them are written.
    ///
    /// # Errors
    /// The path that could not be written, and why.
    pub fn write(&self, folder: &Path) -> Result<Made, (PathBuf, std::io::Error)> {
        std::fs::create_dir_all(folder).map_err(|e| (folder.to_owned(), e))?;
        let (mut made, mut temps) = (Made::default(), Temps::default());
        for file in &self.files {
            let path = folder.join(&file.name);
            if std::fs::symlink_metadata(&path).is_ok() && !file.is_ours {
                made.kept.push(path);
                continue;
            }
            temps.add(&path, &file.bytes)?;
            made.written.push(path);
        }
        temps.name()?;
        Ok(made)
    }
}
