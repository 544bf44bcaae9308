//! The loop: move to the body, lay flat, sew, measure, correct.

use super::changes::changes;
use super::codes::FIT_NOT_SEWN;
use super::folder::Folder;
use super::hem::hems;
use super::levels::{Level, Round, asked, is_reached, unreached};
use super::response::Response;
use super::trial::{Bench, Tried};
use super::wearing::{Means, Worn};
use super::{Fitted, OWN_NAME, Order};
use crate::engine::{Exit, Stop};
use crate::halt::Halt;
use crate::pipeline::cut_behind_drape;
use std::sync::Arc;
use toile_garment::Diagnostic;
use toile_stage_api::Registry;

/// Fits a garment. `tell` hears the ease of every round; round 0 is the garment on its own body.
///
/// # Errors
/// When the pipeline or the body is wrong, or the first pattern cannot be sewn.
pub fn fit(
    order: &Order,
    registry: &mut Registry,
    stop: &Arc<Stop>,
    mut tell: impl FnMut(usize, &[Level]),
) -> Result<Fitted, Halt> {
    let means = Means { threads: order.threads, stop };
    let own = draped(order, &means, registry)?;
    let trial = Bench { order, means: &means };
    let folder = Folder::write(order, registry)?;
    let mut levels = asked(order, &own.garment, &folder.body)?;
    tell(0, &levels);
    let mut add: Round = levels.iter().map(|l| (l.name.clone(), l.asked - l.own_ease)).collect();
    let mut rounds = Vec::new();
    let mut best: Option<Tried> = None;
    let mut broken = None;
    let mut response = Response::new(levels.len());
    while broken.is_none() {
        let tried = trial.tried(&own.garment, &folder.body, &add, &mut levels, registry);
        let tried = match tried {
            Ok(tried) => tried,
            Err(halt) if best.is_some() && halt.exit != Exit::Stopped => {
                broken = Some(halt.findings);
                continue;
            }
            Err(halt) => return Err(not_sewn(halt, &levels, order)),
        };
        rounds.push(levels.iter().map(|l| (l.name.clone(), l.ease)).collect());
        tell(rounds.len(), &levels);
        let off = tried.off;
        let [added, ease] = values(&levels, &add);
        response.learn(&added, &ease);
        if best.as_ref().is_none_or(|b| off < b.off) {
            best = Some(tried);
        }
        if off <= order.within || rounds.len() == order.rounds as usize {
            break;
        }
        // Where no height is followed any more, a further round would sew the same pattern again.
        if levels.iter().all(|l| !l.is_followed) {
            break;
        }
        let missing: Vec<f64> = levels.iter().map(|l| if l.is_followed { l.asked - l.ease } else { 0.0 }).collect();
        for (level, step) in levels.iter().zip(response.step(&missing)).filter(|(l, _)| l.is_followed) {
            *add.entry(level.name.clone()).or_default() += step;
        }
    }
    let Some(mut best) = best else { return Err(Halt::new(Vec::new(), Exit::Usage)) };
    if best.add != add {
        // The folder holds what was tried last.
        best = trial.tried(&own.garment, &folder.body, &best.add, &mut levels, registry)?;
    }
    let mut findings: Vec<Diagnostic> = [folder.findings, best.findings].concat();
    findings.extend(unreached(&levels, order, rounds.len()));
    findings.extend(broken.into_iter().flatten().take(1));
    findings.extend(super::sizes::carry(order, &own.garment, &best.flat, registry, stop)?);
    let passed = best.passed && levels.iter().all(|l| is_reached(l, order));
    let hems = hems(&own.garment, &best.worn);
    let changes = changes(&best.flat);
    Ok(Fitted { levels, rounds, changes, hems, flat: best.flat, worn: best.worn, findings, passed })
}

/// The girth that was added at every height, and the ease that came of it.
fn values(levels: &[Level], add: &Round) -> [Vec<f64>; 2] {
    let added = levels.iter().map(|l| add.get(&l.name).copied().unwrap_or_default());
    // Where other cloth was measured, the ease says nothing of what was added.
    let ease = levels.iter().map(|l| if l.is_followed { l.ease } else { f64::NAN });
    [added.collect(), ease.collect()]
}

/// The garment on its own body.
fn draped(order: &Order, means: &Means<'_>, registry: &mut Registry) -> Result<Worn, Halt> {
    means.wear(&order.request, order.out.join(OWN_NAME), registry, |pipeline| {
        if cut_behind_drape(pipeline) {
            return Ok(());
        }
        let message = format!("`{}` drapes nothing, so there is no garment to be fitted", pipeline.line);
        Err(Diagnostic::error(super::codes::FIT_NO_DRAPE, message).hint("add `use = \"drape\"` to the chain"))
    })
}

/// A pattern that cannot be sewn on the body, mostly because the garment was made for a far smaller or larger one.
fn not_sewn(mut halt: Halt, levels: &[Level], order: &Order) -> Halt {
    if matches!(halt.exit, Exit::Stopped | Exit::System) {
        return halt;
    }
    let differs = |l: &Level| format!("{} {:+.0} mm", l.name, 1e3 * (l.body - l.own_body));
    let words: Vec<String> = levels.iter().map(differs).collect();
    let body = order.body.file_name();
    let message = format!(
        "the new pattern cannot be sewn on `{body}`; its girths against those of the garment's own body: {}",
        words.join(", ")
    );
    let finding = Diagnostic::error(FIT_NOT_SEWN, message);
    halt.findings.push(finding.hint(
        "run/failure.html in the folder shows where; if the pattern has a size whose body is nearer, begin with it \
         (`toile inspect` lists the sizes)",
    ));
    halt
}
