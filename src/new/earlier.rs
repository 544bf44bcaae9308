//! What a folder holds from before: the sewing file, which belongs to the person, and the seams proposed until now.
//!
//! A seam that was proposed and is no longer in the sewing file was taken out by the person. It is not proposed again,
//! and `proposal.json` remembers it.

use super::dress::at;
use super::pattern::Source;
use super::sewing::LEAST_SURE;
use crate::engine::{MAX_INPUT, of_file_error, read_limited};
use serde_json::Value;
use std::path::Path;
use toile_garment::sewing::SewingPlan;
use toile_garment::{Diagnostic, Vec2};
use toile_stages::proposal::{Known, Run, tell_the_same};
use toile_stages::roles::{PiecePoint, joins_of_plan};
use toile_stages::sewing::{resolve, shapes};

/// Points at which a proposed seam is compared.
const STATIONS: usize = 40;

/// The files of a folder that are looked at.
#[derive(Debug)]
pub struct Earlier {
    /// The sewing file as it was written.
    pub text: String,
    /// Its content.
    pub plan: SewingPlan,
    /// Seams that were proposed or declined earlier, as `proposal.json` has them.
    seams: Vec<Value>,
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
        let was_sewn = |s: &Value| s["kind"] != "dart" && s["confidence"].as_f64().is_some_and(|c| c >= LEAST_SURE);
        let mut seams: Vec<Value> = list("seams").into_iter().filter(was_sewn).collect();
        seams.extend(list("declined"));
        Ok(Some(Self { text, plan, seams }))
    }

    /// What the person decided: the seams of the sewing file, and the proposals that are no longer in it. Those come as
    /// they were written too.
    ///
    /// # Errors
    /// Seams of the sewing file that are not on the outlines.
    pub fn decisions(&self, source: &Source) -> Result<(Known, Vec<Value>), Vec<Diagnostic>> {
        let rings = shapes::shapes(&source.garment)?;
        let seams = resolve::placed(resolve::find(&source.garment, &rings))?;
        let given: Vec<[PiecePoint; 2]> = joins_of_plan(&seams, &rings).into_iter().flat_map(|j| j.pairs).collect();
        let gone: Vec<(Vec<[PiecePoint; 2]>, &Value)> = self
            .seams
            .iter()
            .filter_map(|s| Some((stitches(source, s)?, s)))
            .filter(|(pairs, _)| !tell_the_same(pairs, &given))
            .collect();
        let declined = gone.iter().flat_map(|(pairs, _)| pairs.clone()).collect();
        Ok((Known { given, declined }, gone.into_iter().map(|(_, s)| s.clone()).collect()))
    }
}

/// Points that a seam of `proposal.json` sews to each other. None where it tells pieces that are not there.
fn stitches(source: &Source, seam: &Value) -> Option<Vec<[PiecePoint; 2]>> {
    let [a, b] = [runs(source, &seam["a"])?, runs(source, &seam["b"])?];
    let length =
        |runs: &[Run]| -> f64 { runs.iter().flat_map(|r| r.points.windows(2)).map(|w| (w[1] - w[0]).norm()).sum() };
    let (long_a, long_b) = (length(&a), length(&b));
    let share = |k: usize| (k as f64 + 0.5) / STATIONS as f64;
    (0..STATIONS).map(|k| Some([at(&a, share(k) * long_a)?, at(&b, share(k) * long_b)?])).collect()
}

fn runs(source: &Source, side: &Value) -> Option<Vec<Run>> {
    let run = |r: &Value| {
        let (piece, turned) = source.find(r["piece"].as_str()?, r["instance"].as_u64()?)?;
        let point = |p: &Value| {
            let x = p[0].as_f64()? * 1e-3;
            Some(Vec2::new(if turned { -x } else { x }, p[1].as_f64()? * 1e-3))
        };
        let points: Vec<Vec2> = r["points_mm"].as_array()?.iter().map(point).collect::<Option<_>>()?;
        let ends = [*points.first()?, *points.last()?];
        Some(Run { piece, ends, forward: true, points, edges: Vec::new() })
    };
    side["runs"].as_array()?.iter().map(run).collect()
}
