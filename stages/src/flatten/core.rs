//! From the garment to the sheet and back.

use super::align::Rigid;
use super::dart_strain::HeldDart;
use super::energy::{EdgePair, Triangle};
use super::features::{self, Features};
use super::lock::Lock;
use super::params::{FlattenParams, LockKind, MetricChoice};
use super::point_location::PointLocation;
use super::sewn::{self, MeshEdges, Station};
use super::solve::{Flattened, Sheet, SolveError, Stop, solve};
use super::source::{Source, bad_triangle, is_mirrored, scale, sources};
use super::wanted::{REFINEMENTS, Wanted};
use super::{dart_strain, figures, findings, held_lines, overlaps, pleats, symmetry};
use nalgebra::Matrix2;
use toile_garment::flat::{Flat, FlatMetric, FlatPiece};
use toile_garment::{Garment, MeshVertex, Report, Vec2};
use toile_stage_api::StageError;

/// No edit makes a garment larger or smaller than so many times, and an editor with another unit does. The smallest such
/// factor is 10.
const SCALE_MOST: f64 = 4.0;
/// Largest change of length of a grain line that lies on the cloth. Edits stretch a piece less.
const GRAIN_LENGTH_CHANGE: f64 = 0.5;

/// How the solve tells its caller of round and motion (metres); `false` stops it.
pub type Watch<'w> = dyn FnMut(u32, f64) -> bool + 'w;

/// Flattens all pieces of a draped garment. `watch` is told round and motion (metres) and says whether to go on.
///
/// # Errors
/// When the garment has no mesh or drape, or a triangle has no area.
pub fn flatten_garment(
    garment: &Garment,
    params: &FlattenParams,
    report: &mut Report,
    watch: &mut Watch<'_>,
) -> Result<Flat, StageError> {
    let metric = metric_of(garment, params.metric);
    let sources = sources(garment)?;
    let scale = scale(&sources);
    if !(1.0 / SCALE_MOST..=SCALE_MOST).contains(&scale) {
        return Err(StageError::input(findings::scaled(scale)));
    }
    findings::metric(garment, metric, report);
    if is_mirrored(&sources) {
        report.push(findings::mirrored());
    }
    let edges = MeshEdges::of(garment);
    let (before, now): (Vec<_>, Vec<_>) = sources.iter().map(|s| (s.before, s.surface)).unzip();
    let alike = |s: &Station| sewn::alike(s, &before, &now);
    let stations: Vec<Station> = sewn::all(garment, &edges).into_iter().filter(alike).collect();
    for seam in garment.seams.iter().filter(|s| !sewn::stations(s, &edges).iter().all(alike)) {
        report.push(findings::one_sided(seam));
    }
    let stiffness = if params.locks(LockKind::Seams) { params.pair_stiffness } else { 0.0 };
    let pairs = pairs(&sources, &stations, stiffness);
    let start = stored(&sources);
    let mut fit = fitted(&sources, metric, Sheet { start, pairs, ..Sheet::default() }, params, watch)?;
    let features: Vec<Features> = sources.iter().map(|s| features::of(garment, s.piece, s.mesh)).collect();
    hold(garment, &sources, &features, metric, &mut fit, params, report, watch)?;
    if !fit.solved.converged {
        report.push(findings::not_at_rest(&fit.solved, params.stop_motion.0));
    }
    let mut flats: Vec<Vec<Vec2>> = sources.iter().map(|s| laid(s, s.part(&fit.solved.positions), params)).collect();
    if metric != FlatMetric::Unedited {
        symmetry::make(&sources, &features, params, &mut flats, report);
    }
    let pieces: Vec<FlatPiece> = sources
        .iter()
        .zip(&features)
        .zip(flats)
        .enumerate()
        .map(|(k, ((s, f), flat))| measured(s, f, &fit, k, flat))
        .collect();
    for (source, flat) in sources.iter().zip(&pieces) {
        findings::developable(source.piece, source.mesh, flat, params.strain_limit.0, report);
        findings::overlapping(source.piece, &overlaps::find(source.mesh, &flat.positions), report);
    }
    let rest: Vec<&[Vec2]> = sources.iter().map(|s| s.mesh.rest.as_slice()).collect();
    let flat: Vec<&[Vec2]> = pieces.iter().map(|p| p.positions.as_slice()).collect();
    let changes = garment.seams.iter().map(|s| sewn::change(s, &rest, &flat)).collect();
    Ok(Flat { metric, pieces, pairs: changes, over_tolerance: None, verdicts: Vec::new() })
}

/// The strain of the cloth is known when the shape before an edit is, or when the drape is our own (it carries a
/// certificate): then it stays in the cloth. A foreign surface has only its own lengths.
fn metric_of(garment: &Garment, choice: MetricChoice) -> FlatMetric {
    let edited = garment.drape_before_edit.is_some();
    match choice {
        MetricChoice::Surface => FlatMetric::Surface,
        MetricChoice::Auto if !edited && garment.certificate.is_none() => FlatMetric::Surface,
        MetricChoice::Auto | MetricChoice::Carried if edited => FlatMetric::Carried,
        MetricChoice::Auto | MetricChoice::Carried => FlatMetric::Unedited,
    }
}

/// The sheet, its answer and the target edges of every triangle, per piece.
pub struct Fit {
    sheet: Sheet,
    /// The answer.
    pub solved: Flattened,
    targets: Vec<Vec<Matrix2<f64>>>,
}

/// Solves for the wanted metric of every piece.
///
/// Smoothing alone would blur a real edit. So the answer is refined: what the smoothing took from the answer's own
/// metric is given back, and the solve repeated. A metric that can be flat is a fixed point, noise is not.
pub fn fitted(
    sources: &[Source<'_>],
    metric: FlatMetric,
    mut sheet: Sheet,
    params: &FlattenParams,
    watch: &mut Watch<'_>,
) -> Result<Fit, StageError> {
    let mut wanted = sources.iter().map(|s| Wanted::of(s, metric, params.smooth.0)).collect::<Result<Vec<_>, _>>()?;
    let repeats = if wanted.iter().any(Wanted::is_smooth) { REFINEMENTS } else { 0 };
    let mut answer: Option<(Flattened, Vec<Vec<Matrix2<f64>>>)> = None;
    for _ in 0..=repeats {
        let x = answer.as_ref().map(|(a, _)| a.positions.as_slice());
        let targets: Vec<Vec<Matrix2<f64>>> =
            sources.iter().zip(&mut wanted).map(|(s, w)| w.targets(s, x.map(|x| s.part(x)))).collect();
        sheet.triangles = triangles(sources, &targets)?;
        let earlier = answer.as_ref().map_or(0, |(a, _)| a.rounds);
        if let Some((a, _)) = answer.take() {
            sheet.start = a.positions;
        }
        let mut solved = run(&sheet, params, watch)?;
        solved.rounds = solved.rounds.saturating_add(earlier);
        answer = Some((solved, targets));
    }
    match answer {
        Some((solved, targets)) => Ok(Fit { sheet, solved, targets }),
        None => Err(StageError::Internal("flattening without a solve".to_owned())),
    }
}

fn triangles(sources: &[Source<'_>], targets: &[Vec<Matrix2<f64>>]) -> Result<Vec<Triangle>, StageError> {
    let mut out = Vec::new();
    for (source, targets) in sources.iter().zip(targets) {
        for (k, (t, target)) in source.mesh.triangles.iter().zip(targets).enumerate() {
            let triangle = Triangle::new(t.map(|v| v + source.offset), target);
            out.push(triangle.ok_or_else(|| bad_triangle(source, k, "has no area"))?);
        }
    }
    Ok(out)
}

fn run(sheet: &Sheet, params: &FlattenParams, watch: &mut Watch<'_>) -> Result<Flattened, StageError> {
    let stop = Stop { motion: params.stop_motion.0, rounds: params.max_rounds };
    solve(sheet, stop, watch).map_err(failure)
}

/// Positions of all stored pieces.
pub fn stored(sources: &[Source<'_>]) -> Vec<Vec2> {
    sources.iter().flat_map(|s| s.mesh.rest.iter().copied()).collect()
}

/// Solves once more with what is locked, where the free answer would change it.
#[allow(clippy::too_many_arguments, reason = "all of it is the state of one flattening")]
fn hold(
    garment: &Garment,
    sources: &[Source<'_>],
    features: &[Features],
    metric: FlatMetric,
    fit: &mut Fit,
    params: &FlattenParams,
    report: &mut Report,
    watch: &mut Watch<'_>,
) -> Result<(), StageError> {
    if metric == FlatMetric::Unedited {
        return Ok(());
    }
    let free = fit.solved.positions.clone();
    let mut locks: Vec<Lock> = Vec::new();
    for (source, features) in sources.iter().zip(features) {
        locks.extend(held_lines::find(source, features, source.part(&free), params, report));
        locks.extend(pleats::find(source, source.part(&free), params, report));
    }
    let darts = dart_strain::find(garment, sources, features, metric, &fit.sheet, &free, params, watch)?;
    locks.extend(darts.iter().flat_map(|d| d.locks.iter().cloned()));
    if locks.is_empty() {
        return Ok(());
    }
    // A gap is held by its size, so the solve begins where no legs overlap.
    let overlap = darts.iter().any(HeldDart::overlaps);
    fit.sheet.start = if overlap { stored(sources) } else { free };
    fit.sheet.locks = locks;
    let again = run(&fit.sheet, params, watch)?;
    fit.solved = Flattened { rounds: again.rounds.saturating_add(fit.solved.rounds), ..again };
    darts.iter().for_each(|d| d.tell(&fit.solved.positions, report));
    Ok(())
}

/// Sewn edges as pairs of the sheet, with the shares of their stored lengths.
fn pairs(sources: &[Source<'_>], stations: &[Station], stiffness: f64) -> Vec<EdgePair> {
    let mut out = Vec::new();
    let vertex = |v: MeshVertex| sources.get(v.piece.index()).map(|s| s.offset + v.vertex);
    let place = |v: MeshVertex| sources.get(v.piece.index()).and_then(|s| s.mesh.rest.get(v.vertex as usize));
    let length = |[p, q]: [MeshVertex; 2]| place(p).zip(place(q)).map_or(0.0, |(p, q)| (q - p).norm());
    for s in stations.iter().filter(|_| stiffness > 0.0) {
        let [Some(a0), Some(a1), Some(b0), Some(b1)] = [s.a[0], s.a[1], s.b[0], s.b[1]].map(vertex) else { continue };
        let (la, lb) = (length(s.a), length(s.b));
        let mean = 0.5 * (la + lb);
        if la > 1e-9 && lb > 1e-9 {
            out.push(EdgePair { v: [a0, a1, b0, b1], share: [la / mean, lb / mean], stiffness });
        }
    }
    out
}

fn failure(error: SolveError) -> StageError {
    match error {
        SolveError::Stopped => StageError::Cancelled,
        SolveError::System(e) => StageError::Unstable(format!("flattening failed: {e}")),
    }
}

/// A flattened piece laid where the stored one lies.
fn laid(source: &Source<'_>, raw: &[Vec2], params: &FlattenParams) -> Vec<Vec2> {
    let rest = &source.mesh.rest;
    if raw == rest.as_slice() {
        return raw.to_vec();
    }
    let weight = figures::vertex_areas(rest, &source.mesh.triangles);
    let motion =
        if params.locks(LockKind::Grain) { on_grain(source, raw, &weight) } else { Rigid::best(raw, rest, &weight) };
    raw.iter().map(|p| motion.apply(*p)).collect()
}

/// The figures of a piece.
fn measured(source: &Source<'_>, features: &Features, fit: &Fit, k: usize, flat: Vec<Vec2>) -> FlatPiece {
    let (mesh, rest) = (source.mesh, &source.mesh.rest);
    let weight = figures::vertex_areas(rest, &mesh.triangles);
    let warp = source.piece.warp();
    FlatPiece {
        piece: source.piece.id,
        area: [
            figures::area2(rest, &mesh.triangles),
            figures::area2(&flat, &mesh.triangles),
            figures::area3(source.surface, &mesh.triangles),
        ],
        edges: figures::lengths(features, rest, &flat, source.surface),
        darts: features.darts.iter().map(|d| figures::dart(d, rest, &flat)).collect(),
        grain_shift: figures::grain_shift(features, rest, &flat, &weight),
        drape_strain: figures::strain(rest, source.surface, &mesh.triangles, warp),
        flat_strain: figures::strain(&flat, source.surface, &mesh.triangles, warp),
        rounds: fit.solved.rounds,
        last_motion: fit.solved.last_motion,
        curvature: figures::enclosed_defect(rest.len(), &mesh.triangles, &fit.targets[k]),
        forced_strain: forced_strain(fit, source),
        positions: flat,
    }
}

/// The grain line keeps its stored direction; a piece without one is laid by best fit. The line is taken where it is
/// drawn, and not at the vertices nearest to its ends: so the written line has the direction, too.
fn on_grain(source: &Source<'_>, flat: &[Vec2], weight: &[f64]) -> Rigid {
    let (rest, triangles) = (&source.mesh.rest, &source.mesh.triangles);
    let Some([a, b]) = source.piece.grain else { return Rigid::best(flat, rest, weight) };
    let cloth = PointLocation::new(rest, triangles);
    let [from, to] = [a, b].map(|p| cloth.interpolate(p, flat));
    let share = (to - from).norm() / (b - a).norm();
    // A line that is drawn beside the piece says nothing.
    let is_on_cloth = (1.0 - GRAIN_LENGTH_CHANGE..=1.0 + GRAIN_LENGTH_CHANGE).contains(&share);
    if is_on_cloth { Rigid::along(to - from, b - a, flat, rest, weight) } else { Rigid::best(flat, rest, weight) }
}

/// Mean and largest |stretch − 1| between the lengths asked for and the flat ones.
fn forced_strain(fit: &Fit, source: &Source<'_>) -> [f64; 2] {
    let from = source.offset as usize;
    let inside = |v: u32| (from..from + source.mesh.rest.len()).contains(&(v as usize));
    let (mut sum, mut area, mut largest) = (0.0, 0.0, 0.0f64);
    for t in fit.sheet.triangles.iter().filter(|t| inside(t.v[0])) {
        let [s1, s2] = t.stretches(&fit.solved.positions).map(|s| (s - 1.0).abs());
        sum += t.area * 0.5 * (s1 + s2);
        area += t.area;
        largest = largest.max(s1).max(s2);
    }
    [if area > 0.0 { sum / area } else { 0.0 }, largest]
}
