//! Files of golden cases in folders.

use super::codes;
use crate::codes::FILE_MISSING;
use crate::engine::clean;
use std::path::{Path, PathBuf};
use toile_garment::Diagnostic;

/// Name of a file of golden cases.
pub const FILE_NAME: &str = "toile-test.toml";
/// Deepest folder that is looked into.
const MAX_DEPTH: usize = 16;

/// The files that are given, and those in the folders that are given or below, in the order of their names.
///
/// # Errors
/// Paths that lead nowhere, and folders without such a file.
pub fn find(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Vec<Diagnostic>> {
    let (mut found, mut wrong) = (Vec::new(), Vec::new());
    for path in paths {
        let before = found.len();
        if path.is_dir() {
            let folder = if path == Path::new(".") { Path::new("") } else { path };
            walk(folder, 0, &mut found);
        } else if path.is_file() {
            found.push(path.clone());
        } else {
            let message = format!("there is no file or folder `{}`", clean(path));
            wrong.push(Diagnostic::error(FILE_MISSING, message));
            continue;
        }
        if found.len() == before {
            let message = format!("there is no {FILE_NAME} in `{}` or below", clean(path));
            let hint = "the book's chapter on golden cases shows one; `toile schema test` prints its schema";
            wrong.push(Diagnostic::error(codes::TEST_EMPTY, message).hint(hint));
        }
    }
    let mut seen = Vec::new();
    found.retain(|path| {
        !seen.contains(path) && {
            seen.push(path.clone());
            true
        }
    });
    if wrong.is_empty() { Ok(found) } else { Err(wrong) }
}

/// Looks into a folder; links and hidden folders are not followed.
fn walk(folder: &Path, depth: usize, found: &mut Vec<PathBuf>) {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(here).into_iter().flatten().flatten();
    let mut entries: Vec<_> = entries.filter_map(|e| Some((e.file_name(), e.file_type().ok()?))).collect();
    entries.sort_by(|a, b| a.0.cmp(&b.0));
    for (name, kind) in entries {
        let path = folder.join(&name);
        if kind.is_file() && name == FILE_NAME {
            found.push(path);
        } else if kind.is_dir() && depth < MAX_DEPTH && !name.to_string_lossy().starts_with('.') {
            walk(&path, depth + 1, found);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_looked_through_in_the_order_of_names() {
        let dir = tempfile::tempdir().expect("folder");
        for name in ["b", "a/c", ".git"] {
            std::fs::create_dir_all(dir.path().join(name)).expect("folder");
            std::fs::write(dir.path().join(name).join(FILE_NAME), "").expect("file");
        }
        let root = dir.path().to_path_buf();
        let found = find(&[root.clone(), root.join("b")]).expect("files");
        assert_eq!(found, [root.join("a/c").join(FILE_NAME), root.join("b").join(FILE_NAME)]);
        std::fs::create_dir(root.join("empty")).expect("folder");
        let wrong = find(&[root.join("empty"), root.join("none")]).expect_err("neither is good");
        let codes: Vec<&str> = wrong.iter().map(|w| w.code.as_str()).collect();
        assert_eq!(codes, ["test-empty", "file-missing"]);
    }
}
