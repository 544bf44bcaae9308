//! Which files a pipeline may touch. A pipeline from elsewhere must not read or write where it likes.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use toile_stage_api::FileError;

/// Files whose presence marks the root of a project.
const ROOT_MARKS: [&str; 3] = [".git", "toile.root", "Cargo.toml"];

/// The folders a run may read from, and how paths of the pipeline lead there.
#[derive(Clone, Debug)]
pub struct Gate {
    base: PathBuf,
    roots: Vec<PathBuf>,
    mounts: BTreeMap<String, PathBuf>,
}

impl Gate {
    /// A gate for the pipeline in `folder`: its project's root and the folders the caller allows. `mounts` stand for
    /// paths that the caller named and thereby allows.
    ///
    /// # Errors
    /// When a folder is not there.
    pub fn new(folder: &Path, allow: &[PathBuf], mounts: &BTreeMap<String, PathBuf>) -> Result<Self, FileError> {
        let base = canonical(folder)?;
        let mut roots = vec![project_root(&base)];
        for dir in allow {
            roots.push(canonical(dir)?);
        }
        let mut named = BTreeMap::new();
        for (name, dir) in mounts {
            let dir = canonical(dir)?;
            roots.push(dir.clone());
            named.insert(name.clone(), dir);
        }
        Ok(Self { base, roots, mounts: named })
    }

    /// The folder of the pipeline file.
    #[must_use]
    pub fn base(&self) -> &Path {
        &self.base
    }

    /// The real path of an input.
    ///
    /// # Errors
    /// [`FileError::Refused`] outside the allowed folders, [`FileError::Missing`] when it is not there.
    pub fn input(&self, path: &Path) -> Result<PathBuf, FileError> {
        let plain = self.lexical(path)?;
        if !self.allows(&plain) {
            return Err(refused(path, "it leads out of the project's folder; allow the folder with --allow-read DIR"));
        }
        let real = plain.canonicalize().map_err(|e| missing(path, &e))?;
        if !self.allows(&real) {
            return Err(refused(path, "a link on the way leads out of the allowed folders; see --allow-read DIR"));
        }
        if !real.is_file() {
            return Err(refused(path, "it is a folder or a device, not a file"));
        }
        Ok(real)
    }

    /// Opens like [`Self::input`], but the file may be absent and its name is matched without regard to case.
    ///
    /// # Errors
    /// [`FileError::Refused`] outside the allowed folders.
    pub fn optional_input(&self, path: &Path) -> Result<Option<PathBuf>, FileError> {
        match self.input(path) {
            Ok(real) => Ok(Some(real)),
            Err(FileError::Missing { .. }) => match self.other_case(path)? {
                Some(found) => self.input(&found).map(Some),
                None => Ok(None),
            },
            Err(error) => Err(error),
        }
    }

    /// A file beside the wanted one whose name differs in case only.
    fn other_case(&self, path: &Path) -> Result<Option<PathBuf>, FileError> {
        let plain = self.lexical(path)?;
        let (Some(folder), Some(wanted)) = (plain.parent(), plain.file_name().and_then(|n| n.to_str())) else {
            return Ok(None);
        };
        let Ok(entries) = std::fs::read_dir(folder) else { return Ok(None) };
        let mut names: Vec<String> = entries.flatten().filter_map(|e| e.file_name().into_string().ok()).collect();
        names.sort();
        let found = names.into_iter().find(|n| n.to_lowercase() == wanted.to_lowercase());
        Ok(found.map(|name| path.with_file_name(name)))
    }

    /// Names in the folder where a missing file was looked for.
    #[must_use]
    pub fn neighbours(&self, path: &Path) -> Vec<String> {
        let Ok(plain) = self.lexical(path) else { return Vec::new() };
        let Some(entries) = plain.parent().filter(|f| self.allows(f)).and_then(|f| std::fs::read_dir(f).ok()) else {
            return Vec::new();
        };
        let mut names: Vec<String> =
            entries.flatten().take(1000).filter_map(|e| e.file_name().into_string().ok()).collect();
        names.sort();
        names
    }

    /// The name an input has in the document: as the pipeline writes it, never an absolute path.
    #[must_use]
    pub fn shown(path: &Path) -> String {
        if path.is_absolute() {
            return path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        }
        path.to_string_lossy().replace('\\', "/")
    }

    /// Where a path leads, with `.` and `..` worked off and nothing looked up on disk.
    ///
    /// # Errors
    /// [`FileError::Refused`] for a name that means something else on another system.
    pub fn place(&self, path: &Path) -> Result<PathBuf, FileError> {
        self.lexical(path)
    }

    fn allows(&self, path: &Path) -> bool {
        self.roots.iter().any(|root| path.starts_with(root))
    }

    /// Base and path joined, `.` and `..` worked off, nothing looked up on disk.
    fn lexical(&self, path: &Path) -> Result<PathBuf, FileError> {
        let text = path.to_str().ok_or_else(|| refused(path, "its name is not valid text"))?;
        check_text(path, text)?;
        let (start, rest) = match self.mount(text) {
            Some((dir, rest)) => (dir.clone(), Path::new(rest)),
            None if text.starts_with('{') => return Err(refused(path, "an output cannot be read")),
            None => (self.base.clone(), path),
        };
        let mut plain = if rest.is_absolute() { PathBuf::new() } else { start };
        for part in rest.components() {
            match part {
                Component::ParentDir => {
                    plain.pop();
                }
                Component::CurDir => {}
                other => plain.push(other),
            }
        }
        Ok(plain)
    }

    fn mount<'a>(&self, text: &'a str) -> Option<(&PathBuf, &'a str)> {
        let (name, rest) = text.strip_prefix('{')?.split_once('}')?;
        Some((self.mounts.get(name)?, rest.strip_prefix('/').unwrap_or(rest)))
    }
}

/// NUL, backslashes, drives: names that mean something else on another system.
fn check_text(path: &Path, text: &str) -> Result<(), FileError> {
    let drive = text.as_bytes().get(1) == Some(&b':') && text.as_bytes()[0].is_ascii_alphabetic();
    if text.is_empty() {
        Err(refused(path, "it is empty"))
    } else if text.chars().any(toile_garment::text::steers) {
        Err(refused(path, "it holds a control character, or one that changes the direction of text"))
    } else if text.contains('\\') || (drive && !cfg!(windows)) {
        Err(refused(path, "write it with forward slashes, relative to the pipeline file"))
    } else if text.len() > 4096 {
        Err(refused(path, "it is longer than 4096 bytes"))
    } else {
        Ok(())
    }
}

/// Where an output stands below the output folder.
///
/// # Errors
/// When it could leave the folder, or its name means something else on another system.
pub fn output_below(path: &Path) -> Result<PathBuf, FileError> {
    let text = path.to_str().ok_or_else(|| refused(path, "its name is not valid text"))?;
    check_text(path, text)?;
    let text = text.strip_prefix("{out}").map_or(text, |t| t.trim_start_matches('/'));
    let mut below = PathBuf::new();
    for part in Path::new(text).components() {
        match part {
            Component::Normal(name) => below.push(check_name(path, &name.to_string_lossy())?),
            Component::CurDir => {}
            _ => return Err(refused(path, "an output must stay below the output folder; see --out and --allow-write")),
        }
    }
    if below.as_os_str().is_empty() { Err(refused(path, "it names the output folder itself")) } else { Ok(below) }
}

/// A file name that every system keeps as it is.
fn check_name(path: &Path, name: &str) -> Result<String, FileError> {
    const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "com1", "lpt1"];
    let stem = name.split('.').next().unwrap_or(name).to_lowercase();
    if DEVICES.contains(&stem.as_str()) {
        return Err(refused(path, "its name is a device on some systems"));
    }
    if name.len() > 200 {
        return Err(refused(path, "its name is longer than 200 bytes"));
    }
    if name.ends_with(['.', ' ']) || name.contains([':', '*', '?', '"', '<', '>', '|']) {
        return Err(refused(path, "its name ends in a dot or blank, or holds one of : * ? \" < > |"));
    }
    Ok(name.to_owned())
}

/// The nearest folder upwards that is marked as a project's root, but never the root of the disk or a folder just below
/// it. A project without a mark reads its own folder only.
#[must_use]
pub fn project_root(base: &Path) -> PathBuf {
    let deep = |p: &&Path| p.components().filter(|c| matches!(c, Component::Normal(_))).count() >= 2;
    let marked = base.ancestors().filter(deep).find(|dir| ROOT_MARKS.iter().any(|mark| dir.join(mark).exists()));
    marked.unwrap_or(base).to_path_buf()
}

fn canonical(folder: &Path) -> Result<PathBuf, FileError> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    folder.canonicalize().map_err(|e| missing(folder, &e))
}

/// A refusal.
#[must_use]
pub fn refused(path: &Path, reason: &str) -> FileError {
    FileError::Refused { path: clean(path), reason: reason.to_owned() }
}

fn missing(path: &Path, error: &std::io::Error) -> FileError {
    FileError::Missing { path: clean(path), reason: error.to_string() }
}

/// A path for a message: control characters shown, not sent to the terminal.
#[must_use]
pub fn clean(path: &Path) -> String {
    toile_garment::text::shown(&path.to_string_lossy(), &[])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gate() -> (tempfile::TempDir, Gate) {
        let dir = tempfile::tempdir().expect("folder");
        let base = dir.path().join("project/pipelines/line");
        std::fs::create_dir_all(&base).expect("folders");
        std::fs::create_dir_all(dir.path().join("project/samples")).expect("folders");
        std::fs::write(dir.path().join("project/toile.root"), "").expect("mark");
        std::fs::write(dir.path().join("project/samples/a.DXF"), "x").expect("file");
        std::fs::write(dir.path().join("secret.txt"), "x").expect("file");
        let gate = Gate::new(&base, &[], &BTreeMap::new()).expect("gate");
        (dir, gate)
    }

    #[test]
    fn reads_inside_the_project_only() {
        let (_dir, gate) = gate();
        assert!(gate.input(Path::new("../../samples/a.DXF")).is_ok());
        for bad in ["../../../secret.txt", "/etc/passwd", "../../samples", "a\0b", "c:/x", "..\\x", "", "/dev/zero"] {
            assert!(matches!(gate.input(Path::new(bad)), Err(FileError::Refused { .. })), "{bad:?}");
        }
        assert!(matches!(gate.input(Path::new("../../samples/b.dxf")), Err(FileError::Missing { .. })));
        assert!(gate.optional_input(Path::new("../../samples/a.dxf")).expect("case").is_some());
        assert!(gate.optional_input(Path::new("../../samples/b.dxf")).expect("absent").is_none());
    }

    #[cfg(unix)]
    #[test]
    fn follows_no_link_out_of_the_project() {
        let (dir, gate) = gate();
        let link = dir.path().join("project/samples/link.dxf");
        std::os::unix::fs::symlink(dir.path().join("secret.txt"), link).expect("link");
        assert!(matches!(gate.input(Path::new("../../samples/link.dxf")), Err(FileError::Refused { .. })));
    }

    #[test]
    fn a_project_without_a_mark_reads_its_own_folder_only() {
        let dir = tempfile::tempdir().expect("folder");
        let base = dir.path().join("lines/skirt");
        std::fs::create_dir_all(&base).expect("folders");
        for name in ["lines/skirt/a.dxf", "lines/b.dxf"] {
            std::fs::write(dir.path().join(name), "x").expect("file");
        }
        let gate = Gate::new(&base, &[], &BTreeMap::new()).expect("gate");
        assert!(gate.input(Path::new("a.dxf")).is_ok());
        assert!(matches!(gate.input(Path::new("../b.dxf")), Err(FileError::Refused { .. })));
    }

    #[test]
    fn the_caller_can_widen_it() {
        let (dir, gate) = gate();
        let wide = Gate::new(gate.base(), &[dir.path().to_path_buf()], &BTreeMap::new()).expect("gate");
        assert!(wide.input(Path::new("../../../secret.txt")).is_ok());
        let mounts = BTreeMap::from([("pattern".to_owned(), dir.path().to_path_buf())]);
        let named = Gate::new(gate.base(), &[], &mounts).expect("gate");
        assert!(named.input(Path::new("{pattern}/secret.txt")).is_ok());
    }

    #[test]
    fn outputs_stay_below_their_folder() {
        assert_eq!(output_below(Path::new("{out}/a/b.glb")).expect("below"), Path::new("a/b.glb"));
        assert_eq!(output_below(Path::new("b.glb")).expect("below"), Path::new("b.glb"));
        for bad in ["{out}/../b", "/tmp/b", "{out}", "{out}/con.txt", "{out}/a.", "a\u{1b}b", "{out}x/../../y"] {
            assert!(output_below(Path::new(bad)).is_err(), "{bad:?}");
        }
    }
}
