//! The rings of every piece: its outline with all wedge darts notched out, its cutouts, and the lines inside it to which
//! other pieces are sewn.

use super::codes;
use super::ring::{Gap, Ring, SAME, arcs, clean, snap};
use crate::codes::OUTLINE_TOO_SMALL;
use toile_formats::codes::COORDINATE_OUT_OF_RANGE;
use toile_garment::dart::{Dart, DartKind};
use toile_garment::sewing::SewingPlan;
use toile_garment::{Diagnostic, Garment, Piece, Vec2};

/// A mouth drawn this far off the outline is still taken to lie on it.
const MOUTH_TOLERANCE: f64 = 3e-3;
/// A mouth this near to an outline vertex is that vertex.
const VERTEX_TOLERANCE: f64 = 1e-4;
/// An intake narrower than this sews nothing away.
const NO_INTAKE: f64 = 1e-4;

/// Rings of one piece: `rings[0]` is the outline, `rings[1 + k]` cutout `k`, and the last ones go around seam lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PieceShape {
    /// Outline first, then cutouts, then seam lines.
    pub rings: Vec<Ring>,
    /// Number of seam lines.
    pub seam_lines: usize,
    /// Darts that take nothing away: left out of the mesh.
    pub void_darts: Vec<usize>,
}

/// Rings of all pieces, in the order of `Garment::pieces`.
pub type Shapes = Vec<PieceShape>;

/// Rings of all pieces.
///
/// # Errors
/// Every outline that is too small, and every dart whose mouth is not on its outline.
pub fn shapes(garment: &Garment) -> Result<Shapes, Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let shapes: Shapes = garment.pieces.iter().map(|piece| shape(piece, &garment.plan, &mut errors)).collect();
    if errors.is_empty() { Ok(shapes) } else { Err(errors) }
}

impl PieceShape {
    /// The number of the seam line that a ring goes around.
    #[must_use]
    pub fn seam_line(&self, ring: usize) -> Option<usize> {
        ring.checked_sub(self.rings.len() - self.seam_lines)
    }
}

/// Rings of one piece.
pub fn shape(piece: &Piece, plan: &SewingPlan, errors: &mut Vec<Diagnostic>) -> PieceShape {
    let found = errors.len();
    let seam_lines = plan.seam_lines(&piece.name);
    check_numbers(piece, &seam_lines, errors);
    let (base, map) = clean(&piece.outline.positions());
    if errors.len() == found && base.len() < 3 {
        errors.push(
            Diagnostic::error(
                OUTLINE_TOO_SMALL,
                format!("piece `{}`: the outline has {} different points, a piece needs 3", piece.name, base.len()),
            )
            .at(piece.outline.source.clone().or_else(|| piece.source.clone())),
        );
    }
    if errors.len() > found {
        return PieceShape::default();
    }
    let mut void_darts = Vec::new();
    let mut rings = vec![outer(piece, base, &map, &mut void_darts, errors)];
    rings.extend(piece.cutouts.iter().map(|c| Ring::from_line(&c.positions())));
    rings.extend(seam_lines.iter().map(|line| Ring::around(line)));
    PieceShape { rings, seam_lines: seam_lines.len(), void_darts }
}

/// Largest coordinate of a piece: a kilometre is no garment, and keeps every product of coordinates sound.
const FARTHEST: f64 = 1e3;

fn check_numbers(piece: &Piece, seam_lines: &[&[Vec2]], errors: &mut Vec<Diagnostic>) {
    let sound = |p: &Vec2| p.x.is_finite() && p.y.is_finite() && p.x.abs() < FARTHEST && p.y.abs() < FARTHEST;
    let lines = std::iter::once(&piece.outline).chain(&piece.cutouts).chain(&piece.internal_lines);
    let darts = piece.darts.iter().flat_map(|d| d.legs.iter().flatten().chain(&d.mouth).chain(&d.apexes));
    let seam_lines = seam_lines.iter().copied().flatten();
    if let Some(p) =
        lines.flat_map(|l| l.points.iter().map(|p| &p.at)).chain(darts).chain(seam_lines).find(|p| !sound(p))
    {
        errors.push(
            Diagnostic::error(
                COORDINATE_OUT_OF_RANGE,
                format!("piece `{}` has a point at ({}, {}) m, beyond {FARTHEST} m", piece.name, p.x, p.y),
            )
            .at(piece.source.clone())
            .hint("check the units of the file"),
        );
    }
}

/// The effect of a dart on the outline.
struct Splice {
    dart: usize,
    kind: DartKind,
    /// Mouth positions on the drawn ring, walking forward.
    from: f64,
    to: f64,
    /// Points between the mouths that replace the drawn ones (marked wedges).
    between: Option<Vec<Vec2>>,
    /// Index of the apex in `between`.
    apex_at: usize,
    swapped: bool,
}

/// The outline with marked darts notched out and the gaps of all darts.
fn outer(
    piece: &Piece,
    base: Vec<Vec2>,
    map: &[usize],
    void_darts: &mut Vec<usize>,
    errors: &mut Vec<Diagnostic>,
) -> Ring {
    let drawn = Ring::new(base, map.iter().map(|i| Some(*i)).collect());
    let mut splices = Vec::new();
    for (k, dart) in piece.darts.iter().enumerate().filter(|(_, d)| d.kind != DartKind::FishEye) {
        if dart.kind != DartKind::Pleat && dart.intake() < NO_INTAKE {
            void_darts.push(k);
            // A marked one was never cut; the hair of a drawn one may be cleaned away already.
            splices.extend(splice(k, dart, &drawn).ok().filter(|_| dart.kind == DartKind::Wedge));
            continue;
        }
        match splice(k, dart, &drawn) {
            Ok(s) => splices.push(s),
            Err(what) => errors.push(mouth_error(piece, dart, what)),
        }
    }
    splices.sort_by(|a, b| a.from.total_cmp(&b.from));
    if let Some((a, b)) = overlap(&drawn, &splices) {
        errors.push(
            Diagnostic::error(
                codes::DARTS_OVERLAP,
                format!(
                    "piece `{}`: darts `{}` and `{}` share a part of the outline",
                    piece.name,
                    name(piece, a),
                    name(piece, b)
                ),
            )
            .at(piece.darts.get(b).and_then(|d| d.source.clone()))
            .hint("deny one of them with [[dart]] kind = \"none\""),
        );
        return drawn;
    }
    let mut ring = build(&drawn, &splices, void_darts);
    find_wedge_apexes(piece, &mut ring);
    ring
}

fn name(piece: &Piece, dart: usize) -> &str {
    piece.darts.get(dart).map_or("", |d| &d.name)
}

fn mouth_error(piece: &Piece, dart: &Dart, what: String) -> Diagnostic {
    Diagnostic::error(codes::DART_MOUTH_OFF_OUTLINE, format!("piece `{}`, dart `{}`: {what}", piece.name, dart.name))
        .at(dart.source.clone().or_else(|| piece.source.clone()))
        .hint("declare the dart with its mouth points on the outline, or deny it with kind = \"none\"")
}

/// A point in millimetres, for messages.
#[must_use]
pub fn mm(p: Vec2) -> String {
    format!("({:.1}, {:.1}) mm", p.x * 1e3, p.y * 1e3)
}

fn on_ring(ring: &Ring, p: Vec2) -> Result<f64, String> {
    let (s, distance) = ring.project(p);
    if distance > MOUTH_TOLERANCE {
        return Err(format!("the mouth point {} lies {:.1} mm off the outline", mm(p), distance * 1e3));
    }
    let i = ring.arc.partition_point(|a| *a <= s).max(1) - 1;
    let near = [i, (i + 1) % ring.points.len().max(1)]
        .into_iter()
        .filter(|k| ring.points.get(*k).is_some())
        .find(|k| (ring.points[*k] - ring.at(s)).norm() < VERTEX_TOLERANCE);
    Ok(near.map_or(s, |k| ring.arc[k]))
}

fn splice(k: usize, dart: &Dart, ring: &Ring) -> Result<Splice, String> {
    let [m0, m1] = [on_ring(ring, dart.mouth[0])?, on_ring(ring, dart.mouth[1])?];
    let mut out = Splice { dart: k, kind: dart.kind, from: m0, to: m1, between: None, apex_at: 0, swapped: false };
    match dart.kind {
        DartKind::Wedge => {
            let apex = dart.apexes.first().copied().ok_or("it has no apex")?;
            let (apex, distance) = ring.project(apex);
            if distance > 1e-3 {
                return Err(format!("its apex lies {:.1} mm off the outline", distance * 1e3));
            }
            out.swapped = ring.ahead(m0, apex) > ring.ahead(m0, m1);
        }
        _ => out.swapped = ring.ahead(m0, m1) > ring.ahead(m1, m0),
    }
    if out.swapped {
        (out.from, out.to) = (m1, m0);
    }
    if dart.kind == DartKind::MarkedWedge {
        let (first, second) = if out.swapped { (1, 0) } else { (0, 1) };
        let (down, up) = (inner(&dart.legs[first]), inner(&dart.legs[second]));
        let apex = dart.apexes.first().copied().or_else(|| dart.legs[0].last().copied()).ok_or("it has no apex")?;
        out.apex_at = down.len();
        out.between = Some(down.into_iter().chain([snap(apex)]).chain(up.into_iter().rev()).collect());
    }
    Ok(out)
}

/// Points of a leg without its ends, snapped.
fn inner(leg: &[Vec2]) -> Vec<Vec2> {
    if leg.len() < 3 {
        return Vec::new();
    }
    let mut points: Vec<Vec2> = Vec::new();
    let last = snap(leg[leg.len() - 1]);
    for p in leg[1..leg.len() - 1].iter().map(|p| snap(*p)) {
        let before = points.last().copied().unwrap_or_else(|| snap(leg[0]));
        if (p - before).norm() > SAME && (p - last).norm() > SAME {
            points.push(p);
        }
    }
    points
}

fn overlap(ring: &Ring, splices: &[Splice]) -> Option<(usize, usize)> {
    let n = splices.len();
    (0..n).filter(|_| n > 1).find_map(|i| {
        let (a, b) = (&splices[i], &splices[(i + 1) % n]);
        let width = ring.ahead(a.from, a.to);
        let inside = |s: f64| {
            let x = ring.ahead(a.from, s);
            x > SAME && x < width - SAME
        };
        let same = ring.ahead(a.from, b.from) < SAME;
        (inside(b.from) || inside(b.to) || same).then_some((a.dart, b.dart))
    })
}

/// Walks the drawn ring and writes the sewn one.
fn build(drawn: &Ring, splices: &[Splice], void_darts: &[usize]) -> Ring {
    // Stations along the drawn ring: (position, order within it, point, drawn index).
    let mut stations: Vec<(f64, usize, Vec2, Option<usize>)> = Vec::new();
    let swallowed = |s: f64| {
        splices.iter().any(|x| {
            let (d, width) = (drawn.ahead(x.from, s), drawn.ahead(x.from, x.to));
            let void = void_darts.contains(&x.dart);
            d > SAME && ((void && d < width + SAME) || (x.between.is_some() && d < width - SAME))
        })
    };
    for (i, p) in drawn.points.iter().enumerate().filter(|(i, _)| !swallowed(drawn.arc[*i])) {
        stations.push((drawn.arc[i], 0, *p, Some(i)));
    }
    for x in splices {
        for s in [x.from, x.to].into_iter().filter(|_| !void_darts.contains(&x.dart)) {
            if !drawn.arc.iter().any(|a| (a - s).abs() < SAME) {
                stations.push((s, 0, snap(drawn.at(s)), None));
            }
        }
        for (order, p) in x.between.iter().flatten().enumerate() {
            stations.push((x.from, order + 1, *p, None));
        }
    }
    stations.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut of_drawn = vec![None; drawn.points.len()];
    for (k, station) in stations.iter().enumerate() {
        if let Some(i) = station.3 {
            of_drawn[i] = Some(k);
        }
    }
    let points: Vec<Vec2> = stations.iter().map(|s| s.2).collect();
    let of_line = drawn.of_line.iter().map(|i| i.and_then(|i| of_drawn[i])).collect();
    let mut ring = Ring { arc: arcs(&points, true), points, of_line, gaps: Vec::new() };
    ring.gaps = splices.iter().filter(|x| !void_darts.contains(&x.dart)).filter_map(|x| gap(x, &stations)).collect();
    ring
}

fn gap(x: &Splice, stations: &[(f64, usize, Vec2, Option<usize>)]) -> Option<Gap> {
    let find = |s: f64| stations.iter().position(|t| t.1 == 0 && (t.0 - s).abs() < SAME);
    let (from, to) = (find(x.from)?, find(x.to)?);
    let apex = match x.kind {
        DartKind::MarkedWedge => Some(from + 1 + x.apex_at),
        _ => None,
    };
    Some(Gap { dart: x.dart, kind: x.kind, from, apex, to, swapped: x.swapped })
}

/// Fills in the apexes of wedges, which are points of the outline itself.
fn find_wedge_apexes(piece: &Piece, ring: &mut Ring) {
    for g in &mut ring.gaps {
        if g.kind != DartKind::Wedge {
            continue;
        }
        let Some(apex) = piece.darts.get(g.dart).and_then(|d| d.apexes.first()) else { continue };
        let n = ring.points.len();
        let steps = (g.to + n - g.from) % n;
        g.apex = (1..steps)
            .map(|k| (g.from + k) % n)
            .min_by(|a, b| (ring.points[*a] - apex).norm().total_cmp(&(ring.points[*b] - apex).norm()));
    }
}
