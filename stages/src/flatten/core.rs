//! From the garment to the sheet and back.

use super::align::Rigid;
use super::codes;
use super::energy::{EdgePair, Triangle};
use super::features::{self, Features};
use super::metric::{carried, cauchy_green, edges2, edges3, noise_bias, noise_variance, smoothed, sqrt_spd};
use super::params::{FlattenParams, MetricChoice};
use super::sewn::{self, MeshEdges, Station};
use super::solve::{Flattened, Sheet, SolveError, Stop, solve};
use super::{figures, findings};
use nalgebra::Matrix2;
use toile_garment::flat::{Flat, FlatMetric, FlatPiece};
use toile_garment::mesh::PieceMesh;
use toile_garment::{Diagnostic, Garment, MeshVertex, Piece, Report, Vec2, Vec3};
use toile_stage_api::StageError;

/// Repeats of the solve that give back what the smoothing of a noisy surface took from a real edit.
const REFINEMENTS: u32 = 4;

/// Mean strain above which a second, weighed solve is worth its time.
const WORTH_RELIEVING: f64 = 1e-4;

/// A piece with all that the flattening needs of it.
struct Source<'a> {
    piece: &'a Piece,
    mesh: &'a PieceMesh,
    surface: &'a [Vec3],
    before: &'a [Vec3],
    /// First vertex of the piece in the sheet.
    offset: u32,
}

/// Flattens all pieces of a draped garment. `watch` is told round and motion (metres) and says whether to go on.
///
/// # Errors
/// When the garment has no mesh or drape, a triangle has no area, or the solve does not come to rest.
pub fn flatten_garment(
    garment: &Garment,
    params: &FlattenParams,
    report: &mut Report,
    watch: &mut dyn FnMut(u32, f64) -> bool,
) -> Result<Flat, StageError> {
    let metric = metric_of(garment, params.metric);
    let sources = sources(garment)?;
    findings::metric(garment, metric, report);
    let wanted = sources.iter().map(|s| wanted(s, metric)).collect::<Result<Vec<_>, _>>()?;
    let edges = MeshEdges::of(garment);
    let (before, now): (Vec<_>, Vec<_>) = sources.iter().map(|s| (s.before, s.surface)).unzip();
    let alike = |s: &Station| sewn::alike(s, &before, &now);
    let stations: Vec<Station> = sewn::all(garment, &edges).into_iter().filter(alike).collect();
    for seam in garment.seams.iter().filter(|s| !sewn::stations(s, &edges).iter().all(alike)) {
        report.push(findings::one_sided(seam));
    }
    let pairs = pairs(&sources, &stations, params.pair_stiffness);
    let (mut sheet, mut solved, targets) = fitted(&sources, &wanted, pairs, params, watch)?;
    relieved(&mut sheet, &mut solved, params, watch)?;
    let pieces: Vec<FlatPiece> =
        sources.iter().zip(&targets).map(|(s, t)| measured(garment, s, t, &sheet, &solved)).collect();
    for (source, flat) in sources.iter().zip(&pieces) {
        findings::developable(source.piece, flat, params.strain_limit.0, report);
    }
    let rest: Vec<&[Vec2]> = sources.iter().map(|s| s.mesh.rest.as_slice()).collect();
    let flat: Vec<&[Vec2]> = pieces.iter().map(|p| p.positions.as_slice()).collect();
    let changes = garment.seams.iter().map(|s| sewn::change(s, &edges, &rest, &flat)).collect();
    Ok(Flat { metric, pieces, pairs: changes })
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

fn sources(garment: &Garment) -> Result<Vec<Source<'_>>, StageError> {
    let missing = |what: &str| {
        StageError::input(
            Diagnostic::error(
                codes::FLATTEN_NOTHING,
                format!("the garment has no {what}; there is nothing to flatten"),
            )
            .hint("run `triangulate` and `drape` first, or give a GLB that toile wrote"),
        )
    };
    let drape = garment.drape.as_ref().ok_or_else(|| missing("drape"))?;
    let before = garment.drape_before_edit.as_ref().unwrap_or(drape);
    let mut out = Vec::new();
    let mut offset = 0u32;
    for (i, piece) in garment.pieces.iter().enumerate() {
        let mesh = piece.mesh.as_ref().ok_or_else(|| missing("mesh"))?;
        let n = mesh.rest.len();
        let shape = |s: &'_ toile_garment::garment::Shape| s.positions.get(i).is_some_and(|p| p.len() == n);
        let inside = mesh.triangles.iter().flatten().all(|v| (*v as usize) < n);
        if !shape(drape) || !shape(before) || !inside {
            return Err(StageError::input(Diagnostic::error(
                codes::FLATTEN_VERTICES_DIFFER,
                format!("piece `{}`: mesh, drape and the shape before the edit differ in their vertices", piece.name),
            )));
        }
        out.push(Source { piece, mesh, surface: &drape.positions[i], before: &before.positions[i], offset });
        let count = u32::try_from(n).ok().and_then(|n| offset.checked_add(n));
        offset = count.ok_or_else(|| StageError::Limit("more than 4,294,967,295 vertices".into()))?;
    }
    Ok(out)
}

/// Stretch that every triangle of the stored piece should get; `None` where the stored piece itself is asked for.
fn wanted(source: &Source<'_>, metric: FlatMetric) -> Result<Option<Vec<Matrix2<f64>>>, StageError> {
    let stored = source.stored();
    if let Some(k) = stored.iter().map(Matrix2::determinant).position(|d| d.is_nan() || d <= 0.0) {
        return Err(bad_triangle(source, k, "has no area, or lies on its wrong side, in the stored piece"));
    }
    if metric == FlatMetric::Unedited {
        return Ok(None);
    }
    let mut stretch = Vec::with_capacity(stored.len());
    for (k, (t, e)) in source.mesh.triangles.iter().zip(&stored).enumerate() {
        let now = cauchy_green(e, &edges3(source.surface, *t));
        let h = match metric {
            FlatMetric::Carried => {
                cauchy_green(e, &edges3(source.before, *t)).zip(now).and_then(|(b, n)| carried(&b, &n))
            }
            _ => now.as_ref().map(sqrt_spd),
        };
        let good = h.filter(|h| h.iter().all(|x| x.is_finite()) && h.determinant() > 1e-6);
        stretch.push(good.ok_or_else(|| bad_triangle(source, k, "has no area in 3D, or is not finite"))?);
    }
    Ok(Some(stretch))
}

fn bad_triangle(source: &Source<'_>, k: usize, what: &str) -> StageError {
    let at =
        source.mesh.triangles.get(k).and_then(|t| source.mesh.rest.get(t[0] as usize)).copied().unwrap_or_default();
    let place = format!("{:.2}, {:.2} mm", 1e3 * at.x, 1e3 * at.y);
    StageError::input(
        Diagnostic::error(
            codes::FLATTEN_BAD_TRIANGLE,
            format!("piece `{}`: triangle {k} at ({place}) {what}", source.piece.name),
        )
        .at(source.piece.source.clone())
        .hint("mesh the piece afresh, or take the edit back at this place"),
    )
}

/// Target edges of every triangle, per piece.
type Targets = Vec<Vec<Matrix2<f64>>>;

/// Solves for the wanted stretches, smoothed first where that is asked for.
///
/// Smoothing alone would blur a real edit. So the answer is refined: what the smoothing took from the answer's own
/// metric is given back, and the solve repeated. A metric that can be flat is a fixed point, noise is not.
fn fitted(
    sources: &[Source<'_>],
    wanted: &[Option<Vec<Matrix2<f64>>>],
    pairs: Vec<EdgePair>,
    params: &FlattenParams,
    watch: &mut dyn FnMut(u32, f64) -> bool,
) -> Result<(Sheet, Flattened, Targets), StageError> {
    let blurred: Vec<Option<Vec<Matrix2<f64>>>> =
        sources.iter().zip(wanted).map(|(s, w)| w.as_ref().map(|h| s.blurred(h, params.smoothing))).collect();
    let targets: Targets = sources.iter().zip(&blurred).map(|(s, b)| s.targets(b.as_deref())).collect();
    let start: Vec<Vec2> = sources.iter().flat_map(|s| s.mesh.rest.iter().copied()).collect();
    let mut best = solved(sources, targets, start, pairs, params, watch)?;
    if params.smoothing == 0 || blurred.iter().all(Option::is_none) {
        return Ok(best);
    }
    for _ in 0..REFINEMENTS {
        let x = best.1.positions.clone();
        let refined =
            sources.iter().zip(&blurred).map(|(s, b)| s.refined(b.as_deref(), &x, params.smoothing)).collect();
        let rounds = best.1.rounds;
        best = solved(sources, refined, x, std::mem::take(&mut best.0.pairs), params, watch)?;
        best.1.rounds = best.1.rounds.saturating_add(rounds);
    }
    Ok(best)
}

impl Source<'_> {
    fn stored(&self) -> Vec<Matrix2<f64>> {
        self.mesh.triangles.iter().map(|t| edges2(&self.mesh.rest, *t)).collect()
    }

    fn targets(&self, metric: Option<&[Matrix2<f64>]>) -> Vec<Matrix2<f64>> {
        let stored = self.stored();
        match metric {
            Some(metric) => metric.iter().zip(&stored).map(|(c, e)| sqrt_spd(c) * e).collect(),
            None => stored,
        }
    }

    /// The metric of a field of stretches, smoothed, less what noise adds to it on average.
    fn blurred(&self, stretch: &[Matrix2<f64>], passes: u32) -> Vec<Matrix2<f64>> {
        let metric: Vec<Matrix2<f64>> = stretch.iter().map(|h| h.transpose() * h).collect();
        if passes == 0 {
            return metric;
        }
        let (stored, soft) = (self.stored(), self.smooth(&metric, passes));
        let taken: Vec<Matrix2<f64>> = metric.iter().zip(&soft).map(|(c, s)| c - s).collect();
        let variance = noise_variance(&taken, &stored);
        let bias: Vec<Matrix2<f64>> = stored.iter().map(|e| noise_bias(e, variance)).collect();
        let bias = self.smooth(&bias, passes);
        soft.iter()
            .zip(&bias)
            .map(|(c, b)| if (c - b).determinant() > 1e-3 && (c - b).trace() > 0.0 { c - b } else { *c })
            .collect()
    }

    fn smooth(&self, metric: &[Matrix2<f64>], passes: u32) -> Vec<Matrix2<f64>> {
        let area: Vec<f64> = self.stored().iter().map(|e| 0.5 * e.determinant()).collect();
        smoothed(metric, &self.mesh.triangles, &area, passes)
    }

    /// Targets with the metric `C(x) + blurred(wanted) − blurred(C(x))` of the answer `x` so far.
    fn refined(&self, blurred: Option<&[Matrix2<f64>]>, x: &[Vec2], passes: u32) -> Vec<Matrix2<f64>> {
        let Some(blurred) = blurred else { return self.stored() };
        let moved = self.mesh.triangles.iter().map(|t| edges2(x, t.map(|v| v + self.offset)));
        let stretch: Vec<_> = moved.zip(self.stored()).map(|(f, e)| f * e.try_inverse().unwrap_or_default()).collect();
        let sharp: Vec<Matrix2<f64>> = stretch.iter().map(|h| h.transpose() * h).collect();
        let soft = self.smooth(&sharp, passes);
        let metric: Vec<Matrix2<f64>> = (0..sharp.len())
            .map(|k| {
                let c = sharp[k] + blurred[k] - soft[k];
                if c.trace() > 0.0 && c.determinant() > 1e-3 { c } else { blurred[k] }
            })
            .collect();
        self.targets(Some(&metric))
    }
}

fn solved(
    sources: &[Source<'_>],
    targets: Targets,
    start: Vec<Vec2>,
    pairs: Vec<EdgePair>,
    params: &FlattenParams,
    watch: &mut dyn FnMut(u32, f64) -> bool,
) -> Result<(Sheet, Flattened, Targets), StageError> {
    let mut sheet = Sheet { start, pairs, ..Sheet::default() };
    for (source, targets) in sources.iter().zip(&targets) {
        for (k, (t, target)) in source.mesh.triangles.iter().zip(targets).enumerate() {
            let triangle = Triangle::new(t.map(|v| v + source.offset), target);
            sheet.triangles.push(triangle.ok_or_else(|| bad_triangle(source, k, "has no area"))?);
        }
    }
    let stop = Stop { motion: params.stop_motion.0, rounds: params.max_rounds };
    let solved = solve(&sheet, stop, watch).map_err(failure)?;
    settled(&solved, stop)?;
    Ok((sheet, solved, targets))
}

/// Solves once more with every triangle weighed by what its cloth suffers, where strain cannot be avoided.
fn relieved(
    sheet: &mut Sheet,
    solved: &mut Flattened,
    params: &FlattenParams,
    watch: &mut dyn FnMut(u32, f64) -> bool,
) -> Result<(), StageError> {
    if forced_strain(sheet, &solved.positions, 0, solved.positions.len())[0] < WORTH_RELIEVING {
        return Ok(());
    }
    sheet.start.clone_from(&solved.positions);
    sheet.triangles.iter_mut().for_each(|t| t.weigh(&solved.positions));
    let stop = Stop { motion: params.stop_motion.0, rounds: params.max_rounds };
    let again = solve(sheet, stop, watch).map_err(failure)?;
    settled(&again, stop)?;
    *solved = Flattened { rounds: again.rounds.saturating_add(solved.rounds), ..again };
    Ok(())
}

fn settled(solved: &Flattened, stop: Stop) -> Result<(), StageError> {
    if solved.converged {
        return Ok(());
    }
    Err(StageError::Unstable(format!(
        "flattening did not come to rest: after {} rounds a vertex still moves {:.3e} mm a round (goal {:.1e} mm)",
        solved.rounds,
        1e3 * solved.last_motion,
        1e3 * stop.motion
    )))
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

/// Lays a piece on its grain and measures it.
fn measured(
    garment: &Garment,
    source: &Source<'_>,
    targets: &[Matrix2<f64>],
    sheet: &Sheet,
    solved: &Flattened,
) -> FlatPiece {
    let (mesh, n) = (source.mesh, source.mesh.rest.len());
    let rest = &mesh.rest;
    let from = source.offset as usize;
    let raw = &solved.positions[from..from + n];
    let weight = figures::vertex_areas(rest, &mesh.triangles);
    let features = features::of(garment, source.piece, mesh);
    let motion = on_grain(&features, rest, raw, &weight);
    let flat: Vec<Vec2> = raw.iter().map(|p| motion.apply(*p)).collect();
    let warp = source.piece.warp();
    FlatPiece {
        piece: source.piece.id,
        area: [
            figures::area2(rest, &mesh.triangles),
            figures::area2(&flat, &mesh.triangles),
            figures::area3(source.surface, &mesh.triangles),
        ],
        edges: figures::lengths(&features, rest, &flat, source.surface),
        darts: features.darts.iter().map(|d| figures::dart(d, rest, &flat)).collect(),
        grain_shift: figures::grain_shift(&features, rest, &flat, &weight),
        drape_strain: figures::strain(rest, source.surface, &mesh.triangles, warp),
        flat_strain: figures::strain(&flat, source.surface, &mesh.triangles, warp),
        rounds: solved.rounds,
        last_motion: solved.last_motion,
        curvature: figures::enclosed_defect(n, &mesh.triangles, targets),
        forced_strain: forced_strain(sheet, &solved.positions, from, n),
        positions: flat,
    }
}

/// The grain line keeps its stored direction; a piece without one is laid by best fit.
fn on_grain(features: &Features, rest: &[Vec2], flat: &[Vec2], weight: &[f64]) -> Rigid {
    match features.grain.map(|g| g.map(|v| v as usize)) {
        Some([a, b]) => Rigid::along(flat[b] - flat[a], rest[b] - rest[a], flat, rest, weight),
        None => Rigid::best(flat, rest, weight),
    }
}

/// Mean and largest |stretch − 1| between the lengths asked for and the flat ones.
fn forced_strain(sheet: &Sheet, x: &[Vec2], from: usize, count: usize) -> [f64; 2] {
    let inside = |v: u32| (from..from + count).contains(&(v as usize));
    let (mut sum, mut area, mut largest) = (0.0, 0.0, 0.0f64);
    for t in sheet.triangles.iter().filter(|t| inside(t.v[0])) {
        let [s1, s2] = t.stretches(x).map(|s| (s - 1.0).abs());
        sum += t.area * 0.5 * (s1 + s2);
        area += t.area;
        largest = largest.max(s1).max(s2);
    }
    [if area > 0.0 { sum / area } else { 0.0 }, largest]
}
