//! `alter`: what a pattern maker does with paper and scissors. Darts are pivoted, closed and moved, pieces are cut apart
//! along style lines. Seams, notches, grain and allowances follow.

mod build;
mod contour;
mod cut;
mod dart;
mod follow;
mod marks;
mod motion;
mod params;
mod pivot;
mod spot;
#[cfg(test)]
mod tests;

pub use params::AlterParams;

use crate::codes::SEAM_PROPOSED;
use crate::sewing::resolve::{find, placed};
use crate::sewing::shapes::{Shapes, shapes};
use build::Altered;
use params::Change;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::sewing::DartSpec;
use toile_garment::{Aspect, Code, Diagnostic, Garment, PieceId, Report};
use toile_stage_api::{Cost, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

codes! {
    pub(crate) list CODES;

    /// A change of a piece was made. The message says what became of it.
    ALTERED = "altered";

    /// A line along which a piece is to be cut leaves the piece, or cuts through a pleat. Exit code 2.
    ALTER_LINE_LEAVES_PIECE = "alter-line-leaves-piece";

    /// A place of a change is not where it has to be: a line must begin and end on the outline or at the point of a
    /// wedge dart. Exit code 2.
    ALTER_PLACE = "alter-place";

    /// A piece is changed, and its copy is not. Write the same change for both.
    ALTER_COPY = "alter-copy";

    /// The piece has no dart of that name, or the dart cannot be changed so. The message lists the darts. Exit code 2.
    ALTER_DART = "alter-dart";

    /// The changed piece would lie over itself. Exit code 2.
    ALTER_OVERLAPS = "alter-overlaps";

    /// A change made one side of a seam longer than the other. The message tells both lengths.
    ALTER_SEAM_DIFFERS = "alter-seam-differs";

    /// The legs of a changed dart differ in length. A step is left in the outline where it is closed.
    ALTER_LEGS_DIFFER = "alter-legs-differ";
}

/// The sides of a seam that differ by so much more than before are told, metres.
const SEAM_DIFFERS: f64 = 1e-3;
/// Sides whose lengths differ by less have no ease, metres.
const NO_EASE: f64 = 5e-5;

/// The stage.
pub struct Alter;

impl Stage for Alter {
    type Params = AlterParams;

    const INFO: StageInfo = StageInfo::new(
        "alter",
        "pivots, closes and moves darts, and cuts pieces apart along lines; the sewing file follows",
        &[Aspect::Pieces],
        &[Aspect::Pieces],
        1,
    )
    .reading_outdated();

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        if !forecast.garment.pieces.is_empty() {
            let altered = self.run(params, forecast.garment.clone(), cx);
            // Later stages look at the pieces as they were.
            forecast.in_doubt |= altered.is_err();
            forecast.garment = altered?;
        }
        Ok(Some(Cost::seconds(0.01)))
    }

    fn run(&self, params: &AlterParams, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        // Places in space are looked up before the shapes are gone.
        let mut errors = Errors::default();
        let mut flattened = |c| errors.keep(spot::flattened(&garment, c).map_err(StageError::parameter));
        let changes: Vec<Change> = params.change.iter().filter_map(&mut flattened).collect();
        unchanged_copies(&garment, &changes, cx.report);
        let drawn: Vec<String> = garment.pieces.iter().map(|p| p.name.to_lowercase()).collect();
        let before = seam_lengths(&garment);
        let (mut garment, mut failed, mut told) = (garment, BTreeSet::new(), Vec::new());
        for (number, change) in (1..).zip(&changes) {
            let piece = change.piece().to_lowercase();
            // Nothing is known of a piece that an earlier change would have made or altered.
            if !failed.is_empty() && (failed.contains(&piece) || !drawn.contains(&piece)) {
                continue;
            }
            let altered = alter(garment.clone(), change, &mut told, cx.report);
            match errors.keep(altered.map_err(|error| of_change(number, error))) {
                Some(altered) => garment = altered,
                None => {
                    failed.insert(piece);
                }
            }
        }
        if !told.is_empty() {
            cx.report.push(Diagnostic::info(ALTERED, told.join("; ")));
        }
        errors.finish()?;
        cx.report.findings.extend(differing_seams(&before, &seam_lengths(&garment)));
        Ok(garment)
    }
}

/// Lengths of both sides of all seams by their names, metres; none where a seam cannot be found.
fn seam_lengths(garment: &Garment) -> BTreeMap<String, [f64; 2]> {
    let found = shapes(garment).ok().and_then(|shapes| placed(find(garment, &shapes)).ok());
    found.into_iter().flatten().map(|seam| (seam.name, [seam.a.length, seam.b.length])).collect()
}

/// The seams whose sides differ more than before.
fn differing_seams(before: &BTreeMap<String, [f64; 2]>, after: &BTreeMap<String, [f64; 2]>) -> Vec<Diagnostic> {
    let apart = |[a, b]: [f64; 2]| a - b;
    let told = |(name, lengths): (&String, &[f64; 2])| {
        let old = before.get(name)?;
        let [a, b] = lengths.map(|l| 1e3 * l);
        let message = format!(
            "the sides of seam `{name}` differ by {:.1} mm now ({a:.1} on {b:.1} mm), and by {:.1} mm before",
            (a - b).abs(),
            1e3 * apart(*old).abs()
        );
        let hint = "change the other side alike, or ease the difference in where it is meant";
        (apart(*lengths).abs() > apart(*old).abs() + SEAM_DIFFERS)
            .then(|| Diagnostic::warning(ALTER_SEAM_DIFFERS, message).hint(hint))
    };
    after.iter().filter_map(told).collect()
}

/// Tells of pieces that are changed while their mirrored copy, or the piece that they are copies of, is not.
fn unchanged_copies(garment: &Garment, changes: &[Change], report: &mut Report) {
    let is_changed = |name: &str| changes.iter().any(|c| c.piece().eq_ignore_ascii_case(name));
    for copy in &garment.plan.copies {
        let (changed, other) = match [is_changed(&copy.piece), is_changed(&copy.name)] {
            [true, false] => (&copy.piece, &copy.name),
            [false, true] => (&copy.name, &copy.piece),
            _ => continue,
        };
        let message = format!("piece `{changed}` is changed, and `{other}`, which is the same piece again, is not");
        report.push(Diagnostic::warning(ALTER_COPY, message).hint("write the same change for both"));
    }
}

/// Tells which change could not be made.
fn of_change(number: usize, error: StageError) -> StageError {
    let told = |list: Vec<Diagnostic>| {
        let told = |mut d: Diagnostic| {
            d.message.insert_str(0, &format!("change {number}: "));
            d
        };
        list.into_iter().map(told).collect()
    };
    match error {
        StageError::Parameter(list) => StageError::Parameter(told(list)),
        StageError::Input(list) => StageError::Input(told(list)),
        other => other,
    }
}

/// Makes one change, and tells it.
fn alter(
    garment: Garment,
    change: &Change,
    told: &mut Vec<String>,
    report: &mut Report,
) -> Result<Garment, StageError> {
    let shapes = shapes(&garment).map_err(StageError::Input)?;
    let id = crate::sewing::lookup::piece(&garment, change.piece(), None).map_err(StageError::parameter)?;
    let altered = match change {
        Change::Pivot(p) => pivot::pivot(&garment, &shapes, id, p),
        Change::Close(p) => pivot::close(&garment, &shapes, id, p),
        Change::Point(p) => dart::point(&garment, &shapes, id, p),
        Change::Cut(p) => cut::cut(&garment, &shapes, id, p),
    };
    let altered = altered.map_err(StageError::parameter)?;
    let piece = &garment.pieces[id.index()];
    if let Some(dart) = altered.cut_dart(piece) {
        let message = format!("a line cuts through dart `{}` of piece `{}`", dart.name, piece.name);
        let hint = "let it pass beside it, or cross its legs; a pleat cannot be cut apart";
        return Err(StageError::parameter(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message).hint(hint)));
    }
    told.push(altered.told.clone());
    report.findings.extend(altered.findings.iter().cloned());
    put_in(garment, &shapes, id, altered, report)
}

/// Puts the parts of a piece in its place, and lets the sewing plan follow.
fn put_in(
    mut garment: Garment,
    shapes: &Shapes,
    id: PieceId,
    altered: Altered,
    report: &mut Report,
) -> Result<Garment, StageError> {
    let mut plan = follow::plan(&garment, shapes, id, &altered).map_err(StageError::Parameter)?;
    let old = garment.pieces.remove(id.index());
    let parts = altered.pieces(&old);
    let names: Vec<String> = parts.iter().map(|p| p.name.clone()).collect();
    garment.pieces.splice(id.index()..id.index(), parts);
    for (i, piece) in garment.pieces.iter_mut().enumerate() {
        piece.id = PieceId::from(i);
        piece.mesh = None;
    }
    plan.seams.extend(altered.seams);
    // Darts and folds are in the pieces already. They stay in the plan for those who write it.
    let kept = (std::mem::take(&mut plan.darts), std::mem::take(&mut plan.folds));
    let mut again = Report::default();
    crate::sewing::apply(&mut garment, plan, &mut again)?;
    ease(&mut garment)?;
    // What was told of the sewing file before is not told again.
    report.findings.extend(again.findings.into_iter().filter(|f| f.code != SEAM_PROPOSED));
    (garment.plan.darts, garment.plan.folds) = kept;
    garment.plan.darts.retain(|d| !d.piece.eq_ignore_ascii_case(&old.name));
    let declared = garment.pieces.iter().filter(|p| names.contains(&p.name)).flat_map(follow::declared);
    let declared: Vec<DartSpec> = declared.collect();
    garment.plan.darts.extend(declared);
    Ok(garment)
}

/// Declares the ease of seams of which one side became longer, and changes their gathers.
fn ease(garment: &mut Garment) -> Result<(), StageError> {
    let shapes = shapes(garment).map_err(StageError::Input)?;
    let seams = placed(find(garment, &shapes)).map_err(StageError::Parameter)?;
    for (spec, seam) in garment.plan.seams.iter_mut().zip(seams) {
        let [a, b] = [seam.a.length, seam.b.length];
        match spec.gather {
            Some(_) => spec.gather = Some(a.max(b) / a.min(b)),
            None => spec.ease = spec.ease.or_else(|| ((a - b).abs() > NO_EASE).then_some(0.0)).map(|_| a - b),
        }
    }
    Ok(())
}
