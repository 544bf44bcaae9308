//! A folder's earlier content: the sewing file, which belongs to the person, and the pieces that had a proposal.
//!
//! `proposal.json` lists the pieces that were looked at. A person has seen what was proposed for them, and has kept it
//! or taken it out. So no seam between two of them is proposed anew.

use super::pattern::Source;
use super::stock::Body;
use crate::engine::{MAX_INPUT, of_file_error, read_limited};
use serde_json::Value;
use std::path::Path;
use toile_garment::sewing::{SeamSpec, SewingPlan};
use toile_garment::{Diagnostic, Vec2};
use toile_stages::proposal::{Known, ProposedSeam, Run};
use toile_stages::roles::{Join, PiecePoint, joins_of_plan};
use toile_stages::sewing::ring::{arcs, nearest_on};
use toile_stages::sewing::{resolve, shapes};

/// Copies of one piece that are looked for at most.
const MOST_COPIES: u64 = 2;

/// A point nearer to a run lies on it, metres: points of the sewing file are snapped to the outline.
const ON_RUN: f64 = 1e-3;

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
}

/// The mesh in a folder that its pipeline names.
fn body_of(folder: &Path) -> Option<Body> {
    let text = std::fs::read_to_string(folder.join("pipeline.toml")).ok()?;
    let table: toml::Table = text.parse().ok()?;
    let name = table.get("stage")?.as_array()?.iter().find_map(|stage| stage.get("with")?.get("body")?.as_str())?;
    let path = folder.join(name);
    path.is_file().then_some(Body::File(path))
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
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let plan = toile_formats::sewing::read(&text, "sewing.toml")?;
        let proposal = folder.join("proposal.json");
        let json = read_limited(&proposal, &proposal, MAX_INPUT).ok();
        let json: Value = json.and_then(|b| serde_json::from_slice(&b).ok()).unwrap_or_default();
        let list = |key: &str| json[key].as_array().cloned().unwrap_or_default();
        Ok(Some(Self { text, plan, pieces: list("pieces"), seams: list("seams"), body: body_of(folder) }))
    }

    /// Likelihood of a seam that the person has not confirmed yet: it is no surer for lying in the sewing file.
    pub fn doubt(&self, seam: &SeamSpec) -> Option<f64> {
        let told = seam.proposed?;
        let exact = self.seams.iter().find(|s| s["name"] == seam.name).and_then(|s| s["confidence"].as_f64());
        // The sewing file has two digits.
        Some(exact.filter(|c| (c - told).abs() <= 0.006).unwrap_or(told))
    }

    /// The seams of the sewing file, as points that meet.
    ///
    /// # Errors
    /// Seams that are not on the outlines.
    pub fn joins(&self, source: &Source) -> Result<Vec<Join>, Vec<Diagnostic>> {
        let rings = shapes::shapes(&source.garment)?;
        let seams = resolve::placed(resolve::find(&source.garment, &rings))?;
        Ok(joins_of_plan(&seams, &rings))
    }

    /// The seam of the sewing file whose points a proposed one sews to each other.
    pub fn told(&self, joins: &[Join], seam: &ProposedSeam) -> Option<&SeamSpec> {
        let lies = |runs: &[Run], p: &PiecePoint| runs.iter().any(|r| r.piece == p.piece && is_near(r, p.at));
        let meets =
            |[p, q]: &[PiecePoint; 2]| lies(&seam.a, p) && lies(&seam.b, q) || lies(&seam.a, q) && lies(&seam.b, p);
        let same = joins.iter().find(|j| 2 * j.pairs.iter().filter(|pair| meets(pair)).count() > j.pairs.len())?;
        self.plan.seams.iter().find(|s| s.name == same.name)
    }

    /// The person's decisions: the seams of the sewing file, and the pieces that had a proposal.
    pub fn decisions(&self, source: &Source, joins: &[Join]) -> Known {
        let given: Vec<[PiecePoint; 2]> = joins.iter().flat_map(|j| j.pairs.iter().copied()).collect();
        let copies = |p: &Value| p["copies"].as_u64().unwrap_or(1).min(MOST_COPIES);
        let instances = |p: &Value| (0..copies(p)).filter_map(|i| source.find(p["block"].as_str()?, i)).collect();
        let decided = self.pieces.iter().flat_map(|p| -> Vec<(usize, bool)> { instances(p) }).map(|(piece, _)| piece);
        Known { given, decided: decided.collect() }
    }
}

fn is_near(run: &Run, at: Vec2) -> bool {
    nearest_on(&run.points, &arcs(&run.points, false), false, at).1 < ON_RUN
}
