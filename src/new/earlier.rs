//! A folder's earlier content: the sewing file, which belongs to the person, and the pieces that had a proposal.
//!
//! `proposal.json` lists the pieces that were looked at. A person has seen what was proposed for them, and has kept it
//! or taken it out. So no seam between two of them is proposed anew.

use super::codes::FOLDER_OF_ANOTHER;
use super::pattern::Source;
use super::stock::Body;
use crate::engine::{MAX_INPUT, clean, of_file_error, read_limited};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toile_garment::Diagnostic;
use toile_garment::sewing::SewingPlan;
use toile_garment::text::shown;
use toile_stages::import_dxf::FileUnit;
use toile_stages::proposal::{Known, written};
use toile_stages::roles::joins_of_plan;
use toile_stages::sewing::{resolve, shapes};

/// Copies of one piece that are looked for at most.
const MOST_COPIES: u64 = 2;

/// The files of a folder that are looked at.
#[derive(Debug)]
pub struct Earlier {
    /// The sewing file as it was written.
    pub text: String,
    /// Its content.
    pub plan: SewingPlan,
    /// Pieces that were proposed on earlier, as `proposal.json` has them.
    pieces: Vec<Value>,
    /// Seams that were proposed earlier, as `proposal.json` has them.
    seams: Vec<Value>,
    /// The body that its pipeline sews on.
    pub body: Option<Body>,
    /// The size that its pipeline sews.
    pub size: Option<String>,
    /// The unit in which its pipeline reads the pattern, where one is given.
    pub unit: Option<FileUnit>,
    /// The layers that stand for others in its pipeline.
    pub layers: BTreeMap<String, String>,
    /// The pattern that its pipeline reads.
    pattern: Option<PathBuf>,
}

/// The pipeline of a folder.
fn pipeline_of(folder: &Path) -> Option<toml::Table> {
    std::fs::read_to_string(folder.join("pipeline.toml")).ok()?.parse().ok()
}

/// The values of the stages of a pipeline at a key.
fn value<'a>(pipeline: &'a toml::Table, key: &str) -> Option<&'a toml::Value> {
    pipeline.get("stage")?.as_array()?.iter().find_map(|stage| stage.get("with")?.get(key))
}

/// The text at a key.
fn said<'a>(pipeline: &'a toml::Table, key: &str) -> Option<&'a str> {
    value(pipeline, key)?.as_str()
}

/// The size that a pipeline sews: an input of this name, or what the import says.
fn size_of(pipeline: &toml::Table) -> Option<String> {
    let input = pipeline.get("input").and_then(|i| i.get("size")?.get("default")?.as_str());
    input.or_else(|| said(pipeline, "size")).map(str::to_owned)
}

impl Earlier {
    /// The files of a folder; none where it has no sewing file.
    ///
    /// # Errors
    /// All mistakes of the sewing file.
    pub fn read(folder: &Path) -> Result<Option<Self>, Vec<Diagnostic>> {
        let path = folder.join("sewing.toml");
        if !path.exists() {
            return Ok(None);
        }
        let bytes =
            read_limited(&path, &path, MAX_INPUT).map_err(|e| of_file_error(&e).0.into_iter().collect::<Vec<_>>())?;
        let text = toile_stages::text::text("sewing.toml", &bytes).map_err(|finding| vec![finding])?;
        let plan = toile_formats::sewing::read(&text, "sewing.toml")?;
        let proposal = folder.join("proposal.json");
        let json = read_limited(&proposal, &proposal, MAX_INPUT).ok();
        let json: Value = json.and_then(|b| serde_json::from_slice(&b).ok()).unwrap_or_default();
        let list = |key: &str| json[key].as_array().cloned().unwrap_or_default();
        let pipeline = pipeline_of(folder).unwrap_or_default();
        let body = said(&pipeline, "body").map(|name| folder.join(name)).filter(|path| path.is_file());
        Ok(Some(Self {
            text,
            plan,
            pieces: list("pieces"),
            seams: list("seams"),
            body: body.map(Body::File),
            size: size_of(&pipeline),
            unit: value(&pipeline, "units").and_then(|v| v.clone().try_into().ok()),
            layers: value(&pipeline, "layers").and_then(|v| v.clone().try_into().ok()).unwrap_or_default(),
            pattern: said(&pipeline, "file").map(|name| folder.join(name)),
        }))
    }

    /// Refuses a pattern, or a size of it, that the folder was not made from.
    ///
    /// # Errors
    /// What the folder was made from.
    pub fn check(&self, pattern: &Path, size: Option<&str>) -> Result<(), Vec<Diagnostic>> {
        let refused = |message: String, or: &str| {
            let finding = Diagnostic::error(FOLDER_OF_ANOTHER, message);
            Err(vec![finding.hint(format!("choose another folder with --out{or}"))])
        };
        let own = self.pattern.as_deref().filter(|own| own.is_file());
        let read = |path: &Path| read_limited(path, path, MAX_INPUT).ok();
        if let Some(own) = own
            && own.file_stem() != pattern.file_stem()
        {
            return refused(format!("this folder is that of `{}`, not of `{}`", clean(own), clean(pattern)), "");
        }
        if let Some(own) = own
            && read(own) != read(pattern)
        {
            let message = format!("`{}` is another pattern than `{}`", clean(own), clean(pattern));
            return refused(message, ", or copy the new pattern over the one in the folder first");
        }
        match (&self.size, size) {
            (Some(own), Some(size)) if !own.trim().eq_ignore_ascii_case(size.trim()) => {
                let message = format!("this folder sews size {}, not {}", shown(own, &[]), shown(size, &[]));
                refused(message, ", or write the size into its pipeline.toml")
            }
            _ => Ok(()),
        }
    }

    /// Likelihood of a seam. One that the person has not confirmed yet is no surer for lying in the sewing file.
    fn confidence(&self, name: &str) -> f64 {
        let Some(told) = self.plan.seams.iter().find(|s| s.name == name).and_then(|s| s.proposed) else { return 1.0 };
        let exact = self.seams.iter().find(|s| s["name"] == name).and_then(|s| s["confidence"].as_f64());
        // The sewing file has two digits.
        exact.filter(|c| (c - told).abs() <= 0.006).unwrap_or(told)
    }

    /// The person's decisions: the seams of the sewing file, and the pieces that had a proposal.
    ///
    /// # Errors
    /// Seams that are not on the outlines.
    pub fn decisions(&self, source: &Source) -> Result<Known, Vec<Diagnostic>> {
        let rings = shapes::shapes(&source.garment)?;
        let seams = resolve::placed(resolve::find(&source.garment, &rings))?;
        let given = joins_of_plan(&seams, &rings).into_iter().flat_map(|j| j.pairs).collect();
        let copies = |p: &Value| p["copies"].as_u64().unwrap_or(1).min(MOST_COPIES);
        let instances = |p: &Value| (0..copies(p)).filter_map(|i| source.find(p["block"].as_str()?, i)).collect();
        let decided = self.pieces.iter().flat_map(|p| -> Vec<(usize, bool)> { instances(p) }).map(|(piece, _)| piece);
        let decided = decided.collect();
        Ok(Known { given, decided, written: written(&source.garment, &rings, &seams, |name| self.confidence(name)) })
    }
}
