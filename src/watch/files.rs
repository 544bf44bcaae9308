//! The files of a run as they are on the disk, to see that one has changed.

use crate::engine::{FileRead, Gate};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Size and time of a file; nothing for one that is not there.
type State = Option<(u64, SystemTime)>;

/// Files with the state in which they were seen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Watched(BTreeMap<PathBuf, State>);

impl Watched {
    /// The pipeline file, and all files that a run reads or looks for.
    #[must_use]
    pub fn of(pipeline: &Path, reads: &[FileRead], gate: Option<&Gate>) -> Self {
        let base = gate.map_or_else(PathBuf::new, |g| g.base().to_path_buf());
        let real = |read: &FileRead| {
            let found = gate.and_then(|g| g.optional_input(&read.path).ok().flatten());
            found.unwrap_or_else(|| base.join(&read.path))
        };
        let paths = std::iter::once(pipeline.to_path_buf()).chain(reads.iter().map(real));
        Self(paths.map(|path| (path.clone(), state(&path))).collect())
    }

    /// The same files as they are now.
    #[must_use]
    pub fn now(&self) -> Self {
        Self(self.0.keys().map(|path| (path.clone(), state(path))).collect())
    }

    /// The files that are not as they were.
    #[must_use]
    pub fn changed(&self, now: &Self) -> Vec<&Path> {
        self.0.iter().filter(|(path, state)| now.0.get(*path) != Some(*state)).map(|(path, _)| path.as_path()).collect()
    }
}

fn state(path: &Path) -> State {
    let meta = path.metadata().ok()?;
    Some((meta.len(), meta.modified().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_changes_or_comes_is_seen() {
        let dir = tempfile::tempdir().expect("folder");
        let (here, absent) = (dir.path().join("p.toml"), dir.path().join("p.rul"));
        std::fs::write(&here, "a").expect("file");
        let watched = Watched([&here, &absent].into_iter().map(|p| (p.clone(), state(p))).collect());
        assert!(watched.changed(&watched.now()).is_empty());
        std::fs::write(&absent, "b").expect("file");
        std::fs::write(&here, "longer").expect("file");
        assert_eq!(watched.changed(&watched.now()), [absent.as_path(), here.as_path()]);
    }
}
