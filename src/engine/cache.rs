//! The stage cache: what a stage gave, under the content of everything it had.
//!
//! The key of a stage is its document, parameters, revision, seed and the program. Stages that give nothing, such as
//! exports, also have the history and the findings so far in their key. Which files a stage reads is known only after
//! it ran. So the first key leads to the lists of files that it read before, and the contents of these files now make
//! the second key. It leads to the entry.
//!
//! An entry and all that it names is verified by hash before it is used. Files are written under a temporary name and
//! renamed, so that many programs may share one folder.

use super::content::{digest, program};
use super::files::FileRead;
use super::store::{Found, Store};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use toile_garment::body::Body;
use toile_garment::bundle;
use toile_garment::{Diagnostic, Garment};
use toile_stage_api::StageInfo;

/// Version of the form of entries.
const FORM: u32 = 1;
/// Stages that take less are not worth an entry, s.
const LEAST_SECONDS: f64 = 0.02;
/// Most lists of files that are tried for one stage.
const MAX_LISTS: usize = 8;

/// Where the cache is, and how large it may be.
#[derive(Clone, Debug, PartialEq)]
pub struct CacheOptions {
    /// Folder; it may be shared.
    pub folder: PathBuf,
    /// Most bytes.
    pub limit: u64,
}

/// The result of a stage, without body and history.
pub struct Entry {
    /// Files that the stage looked for, in the order of the first time.
    pub reads: Vec<FileRead>,
    /// The document after the stage.
    pub garment: Garment,
    /// Findings that the stage added.
    pub findings: Vec<Diagnostic>,
    /// Outputs that it wrote.
    pub writes: Vec<(PathBuf, Vec<u8>)>,
}

/// An entry as it is stored: contents are named by their hash.
#[derive(Serialize, Deserialize)]
struct Stored {
    reads: Vec<FileRead>,
    garment: String,
    body: Option<String>,
    findings: Vec<Diagnostic>,
    writes: Vec<(PathBuf, String)>,
}

/// The cache of one run.
pub struct Cache {
    store: Store,
    damaged: usize,
    unwritten: Option<String>,
}

impl Cache {
    /// Opens a cache; its folder is made when something is stored.
    #[must_use]
    pub fn open(options: &CacheOptions) -> Self {
        Self { store: Store::new(&options.folder, options.limit), damaged: 0, unwritten: None }
    }

    /// First key of a stage. `None` for stages of other programs: nobody knows what they read.
    #[must_use]
    pub fn key(
        info: &StageInfo,
        params: &Value,
        seed: u64,
        garment: &mut Garment,
        findings: &[Diagnostic],
    ) -> Option<String> {
        if info.name.contains('.') {
            return None;
        }
        let past = info.gives.is_empty().then(|| json!([garment.provenance, findings]));
        let [document, body] = hashes(garment).ok()?;
        Some(digest(&json!([FORM, program(), info.name, info.revision, params, seed, document, body, past])))
    }

    /// Looks for the result of a stage. `content` tells the content of a file now: `None` if it cannot be looked at.
    pub fn find(&mut self, key: &str, content: impl Fn(&Path) -> Option<FileRead>) -> Option<Entry> {
        for list in self.store.names("lists", key).into_iter().take(MAX_LISTS) {
            let Some(paths) = self.read::<Vec<PathBuf>>(&format!("lists/{}/{key}/{list}", &key[..2])) else { continue };
            let reads: Option<Vec<FileRead>> = paths.iter().map(|p| content(p)).collect();
            let Some(reads) = reads else { continue };
            let second = second(key, &reads);
            let Some(stored) = self.read::<Stored>(&format!("entries/{}/{second}", &second[..2])) else { continue };
            if let Some(entry) = self.unpack(stored, reads) {
                return Some(entry);
            }
        }
        None
    }

    fn read<T: for<'d> Deserialize<'d>>(&mut self, name: &str) -> Option<T> {
        match self.store.sealed(name) {
            Found::Good(text) => serde_json::from_slice(&text).ok(),
            Found::Damaged => {
                self.damaged += 1;
                None
            }
            Found::Nothing => None,
        }
    }

    fn object(&mut self, hash: &str) -> Option<Vec<u8>> {
        match self.store.object(hash) {
            Found::Good(bytes) => Some(bytes),
            Found::Damaged => {
                self.damaged += 1;
                None
            }
            Found::Nothing => None,
        }
    }

    fn unpack(&mut self, stored: Stored, reads: Vec<FileRead>) -> Option<Entry> {
        if stored.reads != reads {
            return None;
        }
        let text = String::from_utf8(self.object(&stored.garment)?).ok()?;
        let mut garment = bundle::from_text(&text).ok()?;
        if let Some(hash) = &stored.body {
            garment.body = Some(serde_json::from_slice::<Body>(&self.object(hash)?).ok()?);
        }
        let mut writes = Vec::new();
        for (path, hash) in stored.writes {
            writes.push((path, self.object(&hash)?));
        }
        Some(Entry { reads, garment, findings: stored.findings, writes })
    }

    /// Is a stage that took so long worth an entry?
    #[must_use]
    pub fn is_worth(seconds: f64) -> bool {
        seconds >= LEAST_SECONDS
    }

    /// Stores the result of a stage; contents first, so that who finds the entry finds all. A document that would not
    /// read back as the same bytes is not stored.
    pub fn keep(&mut self, key: &str, mut entry: Entry) {
        if let Err(error) = self.store_all(key, &mut entry) {
            self.unwritten = Some(error.to_string());
        }
    }

    fn store_all(&mut self, key: &str, entry: &mut Entry) -> std::io::Result<()> {
        let body = entry.garment.body.take();
        entry.garment.provenance = Default::default();
        let Ok(text) = bundle::to_text(&entry.garment) else { return Ok(()) };
        let same = bundle::from_text(&text).ok().and_then(|g| bundle::to_text(&g).ok());
        let body = body.map(|b| serde_json::to_vec(&b).unwrap_or_default());
        let whole = |bytes: &Vec<u8>| {
            serde_json::from_slice::<Body>(bytes).ok().and_then(|b| serde_json::to_vec(&b).ok()).as_ref() == Some(bytes)
        };
        if same.as_ref() != Some(&text) || !body.as_ref().is_none_or(whole) {
            return Ok(());
        }
        let mut writes = Vec::new();
        for (path, bytes) in entry.writes.drain(..) {
            writes.push((path, self.store.put(&bytes)?));
        }
        let stored = Stored {
            garment: self.store.put(text.as_bytes())?,
            body: body.map(|bytes| self.store.put(&bytes)).transpose()?,
            findings: std::mem::take(&mut entry.findings),
            reads: std::mem::take(&mut entry.reads),
            writes,
        };
        let second = second(key, &stored.reads);
        self.store.seal(&format!("entries/{}/{second}", &second[..2]), &serde_json::to_vec(&stored)?)?;
        let paths: Vec<&PathBuf> = stored.reads.iter().map(|r| &r.path).collect();
        let list = digest(&json!(paths));
        self.store.seal(&format!("lists/{}/{key}/{}", &key[..2], &list[..16]), &serde_json::to_vec(&paths)?)
    }

    /// Keeps the folder within its limit, and tells how many entries were damaged and why something was not stored.
    pub fn close(self) -> (usize, Option<String>) {
        self.store.trim();
        (self.damaged, self.unwritten)
    }
}

fn second(key: &str, reads: &[FileRead]) -> String {
    digest(&json!([key, reads]))
}

/// Hashes of the document without body and history, and of the body.
fn hashes(garment: &mut Garment) -> Result<[String; 2], serde_json::Error> {
    let (body, past) = (garment.body.take(), std::mem::take(&mut garment.provenance));
    let hash = |write: &dyn Fn(&mut blake3::Hasher) -> Result<(), serde_json::Error>| {
        let mut hasher = blake3::Hasher::new();
        write(&mut hasher)?;
        Ok(hasher.finalize().to_hex().to_string())
    };
    let document = hash(&|h| serde_json::to_writer(std::io::BufWriter::with_capacity(1 << 16, h), garment));
    let skin = hash(&|h| serde_json::to_writer(std::io::BufWriter::with_capacity(1 << 16, h), &body));
    (garment.body, garment.provenance) = (body, past);
    Ok([document?, skin?])
}
