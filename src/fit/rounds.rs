//! The loop: move to the body, lay flat, sew, measure, correct.

use super::changes::changes;
use super::codes::{FIT_BODY, FIT_EASE, FIT_NO_MEASURE, FIT_NOT_REACHED, FIT_NOT_SEWN};
use super::pipeline::{Copied, copied};
use super::wearing::{Means, Worn};
use super::{Fitted, OWN_NAME, Order, PATTERN_NAME, PIPELINE_NAME, SEWING_NAME};
use crate::codes::WRITE_FAILED;
use crate::engine::{Exit, Memory, Stop, clean, of_stage_error, run_alone, write_whole};
use crate::halt::Halt;
use crate::load::Request;
use crate::pipeline::cut_behind_drape;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use toile_garment::body::Body;
use toile_garment::{Diagnostic, Garment, Report, Severity};
use toile_stage_api::Registry;
use toile_stages::fit::measure;
use toile_stages::transfer::{LEVELS, transferred};

/// Folder of the last drape, on the new body.
const RUN_NAME: &str = "run";

/// Largest negative ease, as a share of the body's girth. Knitted bands have about a tenth.
const LARGEST_NEGATIVE_EASE: f64 = 0.25;

/// An ease that is further from what is asked was measured on other cloth: a transfer is never so far off, metres.
const JUMP: f64 = 0.06;

/// Ease at one height, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Name.
    pub name: String,
    /// Girth of the body that the garment was made for.
    pub own_body: f64,
    /// Ease on that body.
    pub own_ease: f64,
    /// Girth of the new body.
    pub body: f64,
    /// Ease that is asked for.
    pub asked: f64,
    /// Ease of the pattern that is written.
    pub ease: f64,
    /// False where the measure jumped to other cloth, such as the bag of a pocket, so that nothing is corrected by it.
    pub is_followed: bool,
}

/// Ease by height after one round, metres.
pub type Round = BTreeMap<String, f64>;

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
    let folder = Folder::write(order, registry)?;
    let mut levels = asked(order, &own.garment, &folder.body)?;
    tell(0, &levels);
    let mut add: Round = levels.iter().map(|l| (l.name.clone(), l.asked - l.own_ease)).collect();
    let mut rounds = Vec::new();
    let mut best: Option<Tried> = None;
    let mut broken = None;
    while broken.is_none() && rounds.len() < order.rounds as usize {
        let tried = Bench { order, means: &means }.tried(&own.garment, &folder.body, &add, &mut levels, registry);
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
        if best.as_ref().is_none_or(|b| off < b.off) {
            best = Some(tried);
        }
        if off <= order.within {
            break;
        }
        // The measured ease scatters a little from drape to drape, so later corrections take half of what is missing.
        let step = if rounds.len() == 1 { 1.0 } else { 0.5 };
        for level in levels.iter().filter(|l| l.is_followed) {
            *add.entry(level.name.clone()).or_default() += step * (level.asked - level.ease);
        }
    }
    let Some(mut best) = best else { return Err(Halt::new(Vec::new(), Exit::Usage)) };
    if best.add != add {
        // The folder holds what was tried last.
        best = Bench { order, means: &means }.tried(&own.garment, &folder.body, &best.add, &mut levels, registry)?;
    }
    let mut findings: Vec<Diagnostic> = [folder.findings, best.findings].concat();
    findings.extend(unreached(&levels, order, rounds.len()));
    findings.extend(broken.into_iter().flatten().take(1));
    let passed = best.passed && levels.iter().all(|l| is_reached(l, order));
    Ok(Fitted { levels, rounds, changes: changes(&best.flat), flat: best.flat, worn: best.worn, findings, passed })
}

/// A pattern that was tried.
struct Tried {
    /// Girth that was added for it.
    add: Round,
    /// The garment on its own body, moved and laid flat.
    flat: Garment,
    /// The pattern on the new body.
    worn: Garment,
    /// Did its certificate pass?
    passed: bool,
    /// Largest difference of an ease from what is asked, metres.
    off: f64,
    findings: Vec<Diagnostic>,
}

fn is_reached(level: &Level, order: &Order) -> bool {
    level.is_followed && (level.asked - level.ease).abs() <= order.within
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

/// Files of the working folder that no round changes.
struct Folder {
    body: Body,
    /// What there is to say of the body.
    findings: Vec<Diagnostic>,
}

impl Folder {
    fn write(order: &Order, registry: &Registry) -> Result<Self, Halt> {
        let opened = order.body.open().map_err(|findings| Halt::new(findings, Exit::Input))?;
        let Some(body) = opened.model else {
            let message = format!("`{}` cannot be read as a body", order.body.file_name());
            let finding = Diagnostic::error(FIT_BODY, message).hint("`toile body measure` says what is wrong with it");
            return Err(Halt::new(vec![finding], Exit::Input));
        };
        let Copied { text, files } = copied(&order.request, &order.body.file_name(), registry)?;
        for (name, bytes) in opened.files.iter().chain(&files) {
            put(&order.out.join(name), bytes)?;
        }
        put(&order.out.join(PIPELINE_NAME), text.as_bytes())?;
        Ok(Self { body, findings: opened.findings })
    }
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), Halt> {
    write_whole(path, bytes).map_err(|e| {
        let message = format!("cannot write `{}`: {e}", clean(path));
        Halt::new(vec![Diagnostic::error(WRITE_FAILED, message)], Exit::System)
    })
}

/// The ease that each height shall have.
fn asked(order: &Order, own: &Garment, body: &Body) -> Result<Vec<Level>, Halt> {
    let measured = measure(own).levels;
    let level = |l: &toile_formats::report::Level| {
        let (name, own_body, own_ease) = (l.name.clone(), l.body?, l.ease()?);
        let asked = order.ease.get(&name).copied().unwrap_or(own_ease);
        let at = toile_stages::fit::level_height(&name, body)?;
        let girth = toile_stages::body::girth_at(body, at);
        LEVELS.contains(&name.as_str()).then_some(Level {
            name,
            own_body,
            own_ease,
            body: girth,
            asked,
            ease: f64::NAN,
            is_followed: true,
        })
    };
    let levels: Vec<Level> = measured.iter().filter_map(level).collect();
    let slim = levels.iter().find(|l| l.asked < -LARGEST_NEGATIVE_EASE * l.body);
    if let Some(l) = slim {
        let message =
            format!("an ease of {:.0} mm at the {} is asked, of {:.0} mm of body", 1e3 * l.asked, l.name, 1e3 * l.body);
        let hint =
            "cloth is stretched by a fourth of its length at most; write how much wider than the body it shall be";
        return Err(Halt::new(vec![Diagnostic::error(FIT_EASE, message).hint(hint)], Exit::Usage));
    }
    let lost = order.ease.keys().find(|name| !levels.iter().any(|l| l.name == **name));
    if levels.is_empty() || lost.is_some() {
        let names: Vec<&str> = levels.iter().map(|l| l.name.as_str()).collect();
        let message = match lost {
            Some(name) => format!("the garment has no ease at `{name}` that can be measured"),
            None => "the garment has no height at which its ease can be measured".to_owned(),
        };
        let hint = if names.is_empty() {
            "a garment around the trunk is needed, and a body that names bust, waist or hip".to_owned()
        } else {
            format!("heights of this garment are {}", names.join(", "))
        };
        return Err(Halt::new(vec![Diagnostic::error(FIT_NO_MEASURE, message).hint(hint)], Exit::Usage));
    }
    Ok(levels)
}

/// Takes ease and girth of the body at every level, where the cloth is measured.
fn take(garment: &Garment, levels: &mut [Level]) {
    let measured = measure(garment).levels;
    for level in levels {
        let found = measured.iter().find(|l| l.name == level.name);
        level.ease = found.and_then(toile_formats::report::Level::ease).unwrap_or(f64::NAN);
        level.body = found.and_then(|l| l.body).unwrap_or(level.body);
        level.is_followed &= (level.ease - level.asked).abs() <= JUMP;
    }
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
        "begin with a size whose body is nearer to it, e.g. --set size=42; run/failure.html in the folder shows where",
    ));
    halt
}

/// Tells what is not as asked.
fn unreached(levels: &[Level], order: &Order, rounds: usize) -> Option<Diagnostic> {
    let off: Vec<&Level> = levels.iter().filter(|l| !is_reached(l, order)).collect();
    let words = |l: &&Level| {
        let why = if l.is_followed { "" } else { ", where other cloth was measured" };
        format!("{} {:.1} mm instead of {:.1} mm{why}", l.name, 1e3 * l.ease, 1e3 * l.asked)
    };
    let words: Vec<String> = off.iter().map(words).collect();
    let message = format!("after {rounds} rounds the ease is not as asked: {}", words.join(", "));
    let finding = Diagnostic::error(FIT_NOT_REACHED, message);
    (!off.is_empty())
        .then(|| finding.hint("measure the page of the run there, or ask for an ease that the garment can have"))
}

/// The size label of the pattern: the name of the body.
fn label_of(order: &Order) -> String {
    let name = order.body.file_name();
    let stem = name.strip_suffix(".obj").unwrap_or(&name);
    let kept = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '-' });
    kept.collect::<String>().trim_matches('-').to_owned()
}

/// Puts another size label on a garment, and on its blocks that end with the one it had.
fn label(garment: &mut Garment, size: &str) {
    let old = garment.size.replace(size.to_owned());
    let Some(old) = old.filter(|o| !o.is_empty()) else { return };
    for piece in &mut garment.pieces {
        piece.size = Some(size.to_owned());
        if let Some(name) = piece.block.strip_suffix(&old) {
            piece.block = format!("{name}{size}");
        }
    }
}

/// Makes patterns and tries them.
struct Bench<'a> {
    order: &'a Order,
    means: &'a Means<'a>,
}

impl Bench<'_> {
    /// Writes a pattern, sews it and measures.
    fn tried(
        &self,
        own: &Garment,
        body: &Body,
        add: &Round,
        levels: &mut [Level],
        registry: &mut Registry,
    ) -> Result<Tried, Halt> {
        let (flat, mut findings) = self.pattern(own, body, add, registry)?;
        let request = Request { file: self.order.out.join(PIPELINE_NAME), ..Request::default() };
        let Worn { garment: worn, passed, findings: told } =
            self.means.wear(&request, self.order.out.join(RUN_NAME), registry, |_| Ok(()))?;
        findings.extend(told);
        take(&worn, levels);
        let followed = levels.iter().filter(|l| l.is_followed).map(|l| (l.asked - l.ease).abs());
        let off = followed.fold(None, |most: Option<f64>, off| Some(most.map_or(off, |m| m.max(off))));
        Ok(Tried { add: add.clone(), flat, worn, passed, off: off.unwrap_or(f64::INFINITY), findings })
    }

    /// Moves the garment to the body, lays it flat and writes its pattern into the folder.
    fn pattern(
        &self,
        own: &Garment,
        body: &Body,
        add: &Round,
        registry: &Registry,
    ) -> Result<(Garment, Vec<Diagnostic>), Halt> {
        let mut report = Report::default();
        let written = self.written(own, body, add, registry, &mut report);
        let (garment, files) = written.map_err(|error| {
            let (findings, exit) = of_stage_error(error);
            Halt::new(report.findings.iter().cloned().chain(findings).collect(), exit)
        })?;
        for (name, bytes) in files {
            put(&self.order.out.join(name), &bytes)?;
        }
        let told = report.findings.into_iter().filter(|f| f.severity != Severity::Info);
        Ok((garment, told.collect()))
    }

    fn written(
        &self,
        own: &Garment,
        body: &Body,
        add: &Round,
        registry: &Registry,
        report: &mut Report,
    ) -> Result<(Garment, Vec<(&'static str, Vec<u8>)>), toile_stage_api::StageError> {
        let worn_by = own.body.clone().unwrap_or_default();
        let mut moved = transferred(own.clone(), &worn_by, body.clone(), add)?;
        label(&mut moved, &label_of(self.order));
        let mut files = Memory::default();
        let flatten = ("flatten", self.order.flatten.as_str());
        let flat = run_alone(registry, flatten, moved, self.means.stop, report, &mut files)?;
        let params = format!("{{ file = \"{{out}}/{PATTERN_NAME}\", sewing = \"{{out}}/{SEWING_NAME}\" }}");
        run_alone(registry, ("export-dxf", &params), flat.clone(), self.means.stop, report, &mut files)?;
        let taken = [PATTERN_NAME, SEWING_NAME].map(|name| Ok((name, files.take(name)?)));
        Ok((flat, taken.into_iter().collect::<Result<_, toile_stage_api::StageError>>()?))
    }
}
