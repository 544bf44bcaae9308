//! Flaps that are pressed back onto their piece start folded, as lapels and hems do. Pleats start bent a little.
//!
//! A lapel that started flat would lie under the other front, which would hold it there. A flap that reaches beyond its
//! piece starts flat: folded, the fall of a collar would cover the seam at the neck.
//!
//! Sewing the mouth of a flat pleat pushes its cloth to either side by chance, and mostly away from the body. So the
//! vertices on its folds start a little to the side to which they are pressed.

use crate::joined::Joined;
use crate::roles::outline::Polygon;
use crate::solve::lines::fold_vertices;
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use toile_garment::mesh::PieceMesh;
use toile_garment::seam::Seam;
use toile_garment::{Piece, Vec2, Vec3};

/// Distance of a flap from the piece that it lies on, m. Layers of a garment start farther apart.
const FLAP_GAP: f64 = 5e-3;
/// How far a folded flap may reach beyond its piece, m: the sides of a hem are seldom square to it.
const OVERHANG_MOST: f64 = 8e-3;
/// How far the folds of a pleat stand out at the start, as a share of the width of its mouth. Only 0 was tried beside it:
/// with 0 the drape of the pleated skirt has half as much energy again.
const PLEAT_RISE: f64 = 0.1;
/// Step along a piece by which its tangents are taken, m.
const TANGENT_STEP: f64 = 1e-4;

/// Where the vertices of a piece start. `seams` are those of the garment, and `at` says where a point of the flat piece lies.
pub fn start(piece: &Piece, seams: &[Seam], at: impl Fn(Vec2) -> Vec3) -> Vec<Vec3> {
    let Some(mesh) = &piece.mesh else { return Vec::new() };
    let mut places: Vec<Vec3> = mesh.rest.iter().map(|p| at(*p)).collect();
    let outline = Polygon::of(piece);
    let runs = seams.iter().flat_map(|s| s.a.runs.iter().chain(&s.b.runs)).filter(|r| r.piece == piece.id);
    let sewn: BTreeSet<u32> = runs.flat_map(|r| r.vertices.iter().copied()).collect();
    for fold in piece.folds.iter().filter(|f| f.angle.abs() > FRAC_PI_2) {
        // The folds of a pleat lie over one another in cloth that is sewn at its mouth, and sewing brings them there.
        if let Some(pleat) = &fold.pleat {
            let width = piece.darts.iter().find(|d| d.name == *pleat).map_or(0.0, |d| (d.mouth[1] - d.mouth[0]).norm());
            for v in fold_vertices(mesh, &fold.line) {
                let rise = PLEAT_RISE * width * fold.angle.signum();
                places[v as usize] += normal(&at, mesh.rest[v as usize]) * rise;
            }
            continue;
        }
        let flap: Vec<FlapVertex> =
            flap_vertices(mesh, &fold.line, &sewn).into_iter().map(|v| FlapVertex::of(mesh, v, &fold.line)).collect();
        let lies_beyond = |p: Vec2| !outline.contains(p) && outline.outwards(p).1 > OVERHANG_MOST;
        if flap.iter().any(|f| lies_beyond(f.mirrored)) {
            continue;
        }
        for FlapVertex { vertex, mirrored, width } in flap {
            places[vertex as usize] =
                at(mirrored) - normal(&at, mirrored) * (width.min(FLAP_GAP) * fold.angle.signum());
        }
    }
    places
}

/// A vertex of a flap.
struct FlapVertex {
    vertex: u32,
    /// Where it lies on the piece when it is folded.
    mirrored: Vec2,
    /// Distance from the fold, m.
    width: f64,
}

impl FlapVertex {
    fn of(mesh: &PieceMesh, vertex: u32, line: &[Vec2]) -> Self {
        let p = mesh.rest[vertex as usize];
        let off = p - foot(line, p);
        Self { vertex, mirrored: p - off * 2.0, width: off.norm() }
    }
}

/// The nearest point of a line that goes on straight beyond its ends.
fn foot(line: &[Vec2], p: Vec2) -> Vec2 {
    let last = line.len().saturating_sub(2);
    let on = |(k, w): (usize, &[Vec2])| {
        let way = w[1] - w[0];
        let share = (p - w[0]).dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE);
        let low = if k == 0 { f64::NEG_INFINITY } else { 0.0 };
        w[0] + way * share.clamp(low, if k == last { f64::INFINITY } else { 1.0 })
    };
    let feet = line.windows(2).enumerate().map(on);
    feet.min_by(|a, b| (p - a).norm_squared().total_cmp(&(p - b).norm_squared())).unwrap_or(p)
}

/// The direction in which the right side looks, unit.
fn normal(at: &impl Fn(Vec2) -> Vec3, p: Vec2) -> Vec3 {
    let tangent = |d: Vec2| at(p + d * TANGENT_STEP) - at(p - d * TANGENT_STEP);
    tangent(Vec2::x()).cross(&tangent(Vec2::y())).normalize()
}

/// Vertices of the part with fewer sewn vertices, where a fold line parts a mesh in two; of equal ones the smaller part.
fn flap_vertices(mesh: &PieceMesh, line: &[Vec2], sewn: &BTreeSet<u32>) -> Vec<u32> {
    let parts = parts(mesh, &fold_vertices(mesh, line));
    if parts.iter().max() != Some(&1) {
        return Vec::new();
    }
    let [first, second] = [0, 1].map(|part| {
        let own = || mesh.triangles.iter().zip(&parts).filter(|(_, p)| **p == part).map(|(t, _)| *t);
        let vertices: BTreeSet<u32> = own().flatten().collect();
        (vertices.intersection(sewn).count(), own().map(|t| mesh.triangle_area(t)).sum::<f64>(), vertices)
    });
    let is_first = first.0.cmp(&second.0).then(first.1.total_cmp(&second.1)).is_lt();
    (if is_first { first.2 } else { second.2 }).into_iter().collect()
}

/// The part of every triangle. Parts hang together by edges that are not on the line.
fn parts(mesh: &PieceMesh, line: &[u32]) -> Vec<usize> {
    let ordered = |a: u32, b: u32| [a.min(b), a.max(b)];
    let mut cut: Vec<[u32; 2]> = line.windows(2).map(|w| ordered(w[0], w[1])).collect();
    cut.sort_unstable();
    let sides = |t: &[u32; 3]| [ordered(t[0], t[1]), ordered(t[1], t[2]), ordered(t[2], t[0])];
    let mut edges: Vec<([u32; 2], usize)> =
        mesh.triangles.iter().enumerate().flat_map(|(i, t)| sides(t).map(|e| (e, i))).collect();
    edges.retain(|(e, _)| cut.binary_search(e).is_err());
    edges.sort_unstable();
    let mut joined = Joined::new(mesh.triangles.len());
    for w in edges.windows(2).filter(|w| w[0].0 == w[1].0) {
        joined.join(w[0].1, w[1].1);
    }
    let roots: Vec<usize> = (0..mesh.triangles.len()).map(|i| joined.root(i)).collect();
    let mut known: Vec<usize> = roots.clone();
    known.sort_unstable();
    known.dedup();
    roots.iter().map(|r| known.binary_search(r).unwrap_or(0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::dart::DartKind;
    use toile_garment::piece::PressedFold;

    /// A strip of three squares, 30 mm high, with a fold between the second and the third.
    fn strip(angle: f64) -> Piece {
        let rest: Vec<Vec2> = (0..4u8).flat_map(|i| [0.0, 0.03].map(|y| Vec2::new(0.03 * f64::from(i), y))).collect();
        let triangles =
            (0..3u32).flat_map(|k| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]]).collect();
        let line = vec![Vec2::new(0.06, 0.0), Vec2::new(0.06, 0.03)];
        let outline = [(0.0, 0.0, 't'), (90.0, 0.0, 't'), (90.0, 30.0, 't'), (0.0, 30.0, 't')];
        Piece {
            mesh: Some(PieceMesh { rest, triangles, ..PieceMesh::default() }),
            folds: vec![PressedFold { name: "hem".into(), line, angle, pleat: None }],
            ..crate::testing::piece(0, "STRIP", &outline)
        }
    }

    #[test]
    fn the_flap_starts_on_the_side_to_which_it_is_pressed() {
        let at = |p: Vec2| Vec3::new(p.x, p.y, 0.2);
        for (angle, z) in [(3.1, 0.195), (-3.1, 0.205)] {
            let places = start(&strip(angle), &[], at);
            assert!((places[6] - Vec3::new(0.03, 0.0, z)).norm() < 1e-12, "{}", places[6]);
            assert!((places[4] - Vec3::new(0.06, 0.0, 0.2)).norm() < 1e-12, "the line stays");
            assert!((places[0] - Vec3::new(0.0, 0.0, 0.2)).norm() < 1e-12, "the larger part stays");
        }
    }

    #[test]
    fn a_fold_is_of_a_pleat_where_it_says_so_and_not_by_its_name() {
        let at = |p: Vec2| Vec3::new(p.x, p.y, 0.2);
        let folded = start(&strip(3.1), &[], at);
        let mut pleated = strip(3.1);
        let ends = [(60.0, 0.0), (90.0, 0.0)];
        pleated.darts = vec![crate::testing::dart("pleat-1", DartKind::Pleat, &[(60.0, 10.0)], ends)];
        pleated.folds[0].name = "pleat-1-hem".into();
        assert_eq!(start(&pleated, &[], at), folded, "a hem that is called so starts folded");
        pleated.folds[0].pleat = Some("pleat-1".into());
        assert_eq!(start(&pleated, &[], at)[6], at(Vec2::new(0.09, 0.0)));
    }

    #[test]
    fn the_folds_of_a_pleat_start_beside_the_piece_on_the_side_to_which_they_are_pressed() {
        for angle in [3.1, -3.1] {
            let mut piece = strip(angle);
            piece.folds[0].pleat = Some("pleat-1".into());
            let mouth = [(30.0, 0.0), (90.0, 0.0)];
            piece.darts.push(crate::testing::dart("pleat-1", DartKind::Pleat, &[(60.0, 30.0)], mouth));
            let places = start(&piece, &[], |p| Vec3::new(p.x, p.y, 0.2));
            let rise = PLEAT_RISE * 0.06 * f64::signum(angle);
            for (v, p) in places.iter().enumerate() {
                let on_fold = v == 4 || v == 5;
                assert!((p.z - 0.2 - if on_fold { rise } else { 0.0 }).abs() < 1e-12, "{v}: {p}");
            }
        }
    }

    #[test]
    fn a_slight_fold_and_a_line_that_parts_nothing_start_flat() {
        let flat = start(&strip(0.0), &[], |p| Vec3::new(p.x, p.y, 0.0));
        assert_eq!(start(&strip(1.0), &[], |p| Vec3::new(p.x, p.y, 0.0)), flat);
        let mut short = strip(3.1);
        short.folds[0].line[1].y = 0.02;
        assert_eq!(start(&short, &[], |p| Vec3::new(p.x, p.y, 0.0)), flat);
        // A strip that is narrower where its flap would lie.
        let narrow = [
            (0.0, 10.0, 't'),
            (60.0, 10.0, 't'),
            (60.0, 0.0, 't'),
            (90.0, 0.0, 't'),
            (90.0, 30.0, 't'),
            (0.0, 30.0, 't'),
        ];
        let mut beyond = Piece { outline: crate::testing::piece(0, "STRIP", &narrow).outline, ..strip(3.1) };
        assert_eq!(start(&beyond, &[], |p| Vec3::new(p.x, p.y, 0.0)), flat);
        beyond.outline.points[0].at.y = 0.002;
        beyond.outline.points[1].at.y = 0.002;
        assert_ne!(start(&beyond, &[], |p| Vec3::new(p.x, p.y, 0.0)), flat);
    }
}
