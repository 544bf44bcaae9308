//! Files that a verb writes beside stdout: whole, never over a file without `--force`, never over what it reads.

use super::console::Console;
use crate::codes::PATH_REFUSED;
use crate::engine::codes::OUTPUTS_COLLIDE;
use crate::engine::{Exit, Temps, clean, refuse_input, unwritten};
use std::path::{Path, PathBuf};
use toile_garment::{Code, Diagnostic};

/// The files that a verb writes, and its rights to replace.
pub(super) struct Results {
    force: bool,
    /// Real paths of what it reads.
    inputs: Vec<PathBuf>,
}

impl Results {
    /// With `force` files that are there are replaced, but never the inputs.
    pub fn new(force: bool, inputs: &[&Path]) -> Self {
        Self { force, inputs: inputs.iter().filter_map(|i| i.canonicalize().ok()).collect() }
    }

    /// Says so when a file may not be written.
    pub fn is_free(&self, path: &Path, console: &mut Console<'_>) -> bool {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Some(Err(error)) = folder.map(std::fs::metadata) {
            console.findings(&[unwritten(path, &error)], None);
            return false;
        }
        if let Err(error) = refuse_input(path, &self.inputs) {
            tell(PATH_REFUSED, &error.to_string(), console);
            return false;
        }
        let taken = path.exists() && !self.force;
        if taken {
            tell(PATH_REFUSED, &format!("`{}` is there already; replace it with --force", clean(path)), console);
        }
        !taken
    }

    /// The same for several files, which must also differ from each other.
    pub fn are_free(&self, paths: &[&Path], console: &mut Console<'_>) -> bool {
        for (k, path) in paths.iter().enumerate() {
            if paths[..k].contains(path) {
                tell(OUTPUTS_COLLIDE, &format!("two outputs are called `{}`", clean(path)), console);
                return false;
            }
            if !self.is_free(path, console) {
                return false;
            }
        }
        true
    }

    /// Writes one result and names it on stdout.
    pub fn write(&self, path: &Path, bytes: &[u8], console: &mut Console<'_>) -> Exit {
        let exit = self.write_silently(path, bytes, console);
        if exit == Exit::Good {
            console.result(&format!("{}\n", clean(path)));
        }
        exit
    }

    /// The same without a word on stdout.
    pub fn write_silently(&self, path: &Path, bytes: &[u8], console: &mut Console<'_>) -> Exit {
        self.put(&[(path, bytes)], console)
    }

    /// Writes results that belong together and names them on stdout. New ones never lie beside old ones: those go first.
    pub fn write_all(&self, files: &[(&Path, &[u8])], console: &mut Console<'_>) -> Exit {
        let exit = self.put(files, console);
        if exit == Exit::Good {
            files.iter().for_each(|(path, _)| console.result(&format!("{}\n", clean(path))));
        }
        exit
    }

    fn put(&self, files: &[(&Path, &[u8])], console: &mut Console<'_>) -> Exit {
        let paths: Vec<&Path> = files.iter().map(|(path, _)| *path).collect();
        if !self.are_free(&paths, console) {
            return Exit::Usage;
        }
        let mut temps = Temps::default();
        let staged = files.iter().try_for_each(|(path, bytes)| temps.add(path, bytes));
        // One file takes the place of the old one in a single step.
        let ready = staged.and_then(|()| if files.len() > 1 { temps.retire_old() } else { Ok(()) });
        if let Err((path, error)) = ready.and_then(|()| temps.name()) {
            console.findings(&[unwritten(&path, &error)], None);
            return Exit::System;
        }
        Exit::Good
    }
}

fn tell(code: Code, message: &str, console: &mut Console<'_>) {
    console.findings(&[Diagnostic::error(code, message)], None);
}
