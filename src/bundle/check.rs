//! Opens a bundle from elsewhere. Nothing in it is believed before it is checked.

use super::archive::{self, Entry};
use super::codes;
use super::manifest::{FORM, MANIFEST_NAME, Manifest};
use crate::engine::{MAX_INPUT, clean, of_file_error, output_below, read_limited};
use std::collections::BTreeMap;
use std::path::Path;
use toile_garment::{Code, Diagnostic, SourceRef};

/// Largest bundle, bytes.
pub(super) const MAX_BUNDLE: u64 = 1 << 30;
/// Largest list, bytes.
const MAX_MANIFEST: u64 = 16 << 20;
/// Most files.
pub(super) const MAX_FILES: usize = 10_000;

/// A bundle whose files are what its list says.
pub struct Bundle {
    /// The list.
    pub manifest: Manifest,
    /// The files by their paths.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Digest of the whole bundle, hex.
    pub blake3: String,
}

/// Opens a bundle and checks every file in it.
///
/// # Errors
/// All that is wrong with it.
pub fn open(path: &Path) -> Result<Bundle, Vec<Diagnostic>> {
    let archive = read_limited(path, path, MAX_BUNDLE).map_err(|e| of_file_error(&e).0)?;
    let mut wrong = Wrong { file: clean(path), findings: Vec::new() };
    let Some(manifest) = manifest(&archive, &mut wrong) else { return Err(wrong.findings) };
    let files = files(&archive, &manifest, &mut wrong);
    let missing = manifest.files.iter().filter(|f| !files.contains_key(&f.path));
    for file in missing.filter(|_| wrong.findings.is_empty()).collect::<Vec<_>>() {
        wrong.add(codes::BUNDLE_DAMAGED, format!("`{}` is in the list and not in the bundle", file.path));
    }
    if !wrong.findings.is_empty() {
        return Err(wrong.findings);
    }
    Ok(Bundle { manifest, files, blake3: blake3::hash(&archive).to_hex().to_string() })
}

/// The mistakes of a bundle.
struct Wrong {
    file: String,
    findings: Vec<Diagnostic>,
}

impl Wrong {
    fn add(&mut self, code: Code, message: String) {
        let finding = Diagnostic::error(code, message).at(SourceRef::file(self.file.clone()));
        let is_damaged = finding.code == codes::BUNDLE_DAMAGED;
        let hint = if is_damaged { "ask for the bundle again" } else { "do not trust this file" };
        self.findings.push(finding.hint(hint));
    }
}

/// The list, which is the first entry.
fn manifest(archive: &[u8], wrong: &mut Wrong) -> Option<Manifest> {
    let mut first = None;
    let read = archive::read(archive, &|_| MAX_MANIFEST, &mut |entry| {
        first = Some(entry);
        false
    });
    let is_list = |e: &Entry| e.is_file && e.path.as_deref() == Some(MANIFEST_NAME) && e.size <= MAX_MANIFEST;
    let Some(entry) = first.filter(|e| read.is_ok() && is_list(e)) else {
        wrong.add(codes::BUNDLE_REFUSED, format!("the file is no bundle: it does not begin with {MANIFEST_NAME}"));
        return None;
    };
    let manifest: Manifest = match serde_json::from_slice(&entry.bytes) {
        Ok(manifest) => manifest,
        Err(error) => {
            wrong.add(codes::BUNDLE_DAMAGED, format!("{MANIFEST_NAME} cannot be read: {error}"));
            return None;
        }
    };
    check_manifest(&manifest, wrong);
    wrong.findings.is_empty().then_some(manifest)
}

fn check_manifest(manifest: &Manifest, wrong: &mut Wrong) {
    if manifest.toile_bundle != FORM {
        let message = format!("the bundle has form {}, this program reads {FORM}", manifest.toile_bundle);
        wrong.add(codes::BUNDLE_REFUSED, message);
        return;
    }
    let sum = manifest.files.iter().try_fold(0_u64, |sum, f| sum.checked_add(f.bytes));
    if manifest.files.len() > MAX_FILES || sum.is_none_or(|sum| sum > MAX_BUNDLE) {
        wrong.add(codes::BUNDLE_REFUSED, format!("it lists more than {MAX_FILES} files, or more than 1 GiB"));
        return;
    }
    let mut seen: Vec<&str> = Vec::new();
    for file in &manifest.files {
        if !is_plain(&file.path) || file.path == MANIFEST_NAME {
            let message = format!("`{}` cannot stand in a bundle: it leads out of its folder", file.path);
            wrong.add(codes::BUNDLE_REFUSED, message);
        }
        if file.bytes > MAX_INPUT {
            wrong.add(codes::BUNDLE_REFUSED, format!("`{}` is larger than {MAX_INPUT} bytes", file.path));
        }
        seen.push(&file.path);
    }
    seen.sort_unstable();
    if let Some(twice) = seen.windows(2).find(|w| w[0] == w[1]) {
        wrong.add(codes::BUNDLE_REFUSED, format!("`{}` is listed twice", twice[0]));
    }
    if !seen.contains(&manifest.pipeline.as_str()) {
        wrong.add(codes::BUNDLE_REFUSED, format!("its pipeline `{}` is not in the list", manifest.pipeline));
    }
}

/// Returns `true` for a relative path in its plain form, which every system takes.
pub(super) fn is_plain(path: &str) -> bool {
    !path.starts_with('{') && output_below(Path::new(path)).is_ok_and(|p| p.to_str() == Some(path))
}

/// The files, each checked against the list.
fn files(archive: &[u8], manifest: &Manifest, wrong: &mut Wrong) -> BTreeMap<String, Vec<u8>> {
    let listed: BTreeMap<&str, _> = manifest.files.iter().map(|f| (f.path.as_str(), f)).collect();
    let most = |path: &str| listed.get(path).map_or(0, |f| f.bytes);
    let mut files = BTreeMap::new();
    let mut is_first = true;
    let mut refuse = |entry: Entry| -> Option<(Code, String)> {
        let refused = |why: String| Some((codes::BUNDLE_REFUSED, why));
        let Some(path) = entry.path else { return refused("an entry has a name that is no text".to_owned()) };
        if std::mem::take(&mut is_first) {
            return None;
        }
        if !entry.is_file {
            return refused(format!("`{path}` is a link, a folder or a device, and no plain file"));
        }
        if !is_plain(&path) {
            return refused(format!("`{path}` leads out of the folder of the bundle"));
        }
        let Some(file) = listed.get(path.as_str()) else { return refused(format!("`{path}` is not in the list")) };
        if files.contains_key(&path) {
            return refused(format!("`{path}` is in the bundle twice"));
        }
        if entry.size > file.bytes {
            return refused(format!("`{path}` has {} bytes, the list says {}", entry.size, file.bytes));
        }
        if blake3::hash(&entry.bytes).to_hex().as_str() != file.blake3 {
            return Some((codes::BUNDLE_DAMAGED, format!("`{path}` has changed: its hash is not that of the list")));
        }
        files.insert(path, entry.bytes);
        None
    };
    let mut found = Vec::new();
    let read = archive::read(archive, &most, &mut |entry| {
        found.extend(refuse(entry));
        found.len() <= MAX_FILES
    });
    found.into_iter().for_each(|(code, message)| wrong.add(code, message));
    if let Err(error) = read {
        wrong.add(codes::BUNDLE_DAMAGED, format!("the archive is damaged: {error}"));
    }
    files
}
