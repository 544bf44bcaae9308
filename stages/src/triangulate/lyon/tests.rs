//! lyon decides where cloth is and places vertices. Its tessellation and its sums of lengths measurably fall short.

use super::*;
use crate::testing::{one, piece, rectangle, run};
use crate::triangulate::check::{findings, quality};
use crate::triangulate::curve::CurveKind;
use crate::triangulate::edge_use::triangles_at;
use crate::triangulate::layout::Layout;
use crate::triangulate::{Mesher, Params, Triangulate, regular};

fn ring(points: &[(f64, f64)]) -> Vec<Vec2> {
    points.iter().map(|(x, y)| Vec2::new(*x, *y) * 1e-3).collect()
}

#[test]
fn a_hole_is_no_cloth_and_an_island_in_it_is() {
    let square = |r: f64| ring(&[(-r, -r), (r, -r), (r, r), (-r, r)]);
    let rings = [square(100.0), square(50.0), square(10.0)];
    let at = |x: f64| covers(rings.iter().map(Vec::as_slice), Vec2::new(x, 0.001) * 1e-3);
    assert_eq!([0.0, 30.0, 70.0, 120.0, -30.0, -70.0, -120.0].map(at), [true, false, true, false, false, true, false]);
}

/// A ring runs over the place of a point by a ten-thousandth of a millimetre, two metres from the origin.
#[test]
fn a_grid_step_beside_the_line_is_told() {
    let triangle = ring(&[(2000.0, 0.0), (2300.0, 0.0), (2300.0, 100.0)]);
    let on = |above: f64| covers([triangle.as_slice()], Vec2::new(2.15, 0.05 + above));
    assert!(on(-GRID) && !on(GRID));
}

/// A front of 0.7 m, slashed 110 mm deep and 0.2 mm wide.
fn slashed() -> Layout {
    let points = ring(&[
        (340.9058, 0.0),
        (256.5881, 256.5881),
        (0.0, 0.2676),
        (-113.2178, 113.3517),
        (-34.8055, 34.8465),
        (-113.3782, 113.5119),
        (-226.596, 226.596),
        (-368.2766, 0.0),
        (-142.9327, -142.9327),
        (0.0, -247.4903),
        (164.534, -164.534),
    ]);
    let chain = (0..points.len() as u32).collect();
    Layout { points, chains: vec![chain], kinds: vec![(CurveKind::Outline, true)], ..Layout::default() }
}

/// The reason why the mesh that is draped does not start from lyon's tessellation: it loses an edge of this outline,
/// although every point is exact in `f32`. The constrained triangulation keeps all edges.
#[test]
fn the_tessellation_loses_an_edge_beside_a_narrow_slit() {
    let layout = slashed();
    let (edges, repeated) = layout.all_edges();
    assert!(repeated.is_empty());
    let lost = |triangles: &[[u32; 3]]| triangles_at(triangles, &edges).into_iter().filter(|n| *n != 1).count();
    assert_eq!(lost(&regular::cloth(&layout.points, &edges, &layout).expect("mesh")), 0);
    let draft = fill(&layout, 0.05).expect("draft");
    assert!(lost(&draft.1) > 0, "lyon can be what the mesher starts from");
}

/// All vertices of a side lie on a straight line, so lyon alone makes triangles without area, and some as long as the
/// piece.
#[test]
fn triangles_of_a_draft_have_area() {
    let params =
        Params { mesher: Mesher::Lyon, edge_length: Some("9 mm".parse().expect("length")), ..Params::default() };
    let trapezium = piece(0, "r", &[(0.0, 0.0), (613.7, 0.0), (501.3, 291.3), (97.1, 291.3)].map(|(x, y)| (x, y, 'T')));
    let (garment, _) = run(&Triangulate, &params, one(trapezium)).expect("draft");
    let mesh = garment.pieces[0].mesh.as_ref().expect("mesh");
    let widest = |t: usize| {
        let [a, b, c] = mesh.rest_triangle(t).expect("triangle");
        (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared())
    };
    let aspect = |t: usize| {
        let [a, b, c] = mesh.rest_triangle(t).expect("triangle");
        (b - a).perp(&(c - a)) / widest(t)
    };
    let least = (0..mesh.triangles.len()).map(aspect).fold(1.0, f64::min);
    assert!(least > 0.1, "{least}");
    let longest = (0..mesh.triangles.len()).map(widest).fold(0.0, f64::max).sqrt();
    assert!(longest < 0.018, "{longest}");
}

/// A narrow slit costs the draft an edge, so it is refused with the reason before anything is sewn.
#[test]
fn a_draft_that_loses_an_edge_is_refused() {
    let layout = slashed();
    let (points, triangles) = fill(&layout, 0.05).expect("draft");
    let quality = quality(&layout, &points, &triangles);
    assert!(quality.lost > 0);
    let found = findings(&rectangle(0, "r", 1.0, 1.0), &quality, true);
    assert_eq!(found[0].code.as_str(), "draft-mesh-wrong");
    assert_eq!(found[0].severity, toile_garment::Severity::Error);
}

/// The draft has the area of the outline: its points are exact in `f32`.
#[test]
fn the_draft_keeps_the_area() {
    let params = Params { mesher: Mesher::Lyon, ..Params::default() };
    let (garment, _) = run(&Triangulate, &params, one(rectangle(0, "r", 613.7, 291.3))).expect("draft");
    let area = garment.pieces[0].mesh.as_ref().expect("mesh").area();
    assert!((area / (0.6137 * 0.2913) - 1.0).abs() < 1e-12, "{area}");
}

/// A wavy line of 1.4 m, in steps of about 3 mm.
fn wave() -> Vec<Vec2> {
    (0..400).map(|i| Vec2::new(3.3e-3 * f64::from(i), 0.02 * libm::sin(0.07 * f64::from(i)))).collect()
}

#[test]
fn places_keep_to_the_grid_along_a_stretch() {
    let wave = wave();
    let stretch = &wave[..120];
    let arc = crate::sewing::ring::arcs(stretch, false);
    let shares: Vec<f64> = (0..50).map(|k| f64::from(k) / 50.0).collect();
    let places = places_along(stretch, &shares);
    assert_eq!(places[0], stretch[0]);
    for (share, place) in shares.iter().zip(&places) {
        let s = share * arc[arc.len() - 1];
        let i = arc.partition_point(|a| *a <= s) - 1;
        let exact = crate::sewing::ring::along(stretch[i], stretch[i + 1], arc[i], arc[i + 1], s);
        assert!((place - exact).norm() < 2.5 * GRID, "{}", (place - exact).norm());
    }
    assert!(places_along(&[], &shares).is_empty());
    assert_eq!(places_along(&[stretch[7]; 3], &[0.0, 0.5]), [stretch[7]; 2]);
}

/// The reason why positions of notches and seam ends are measured in `f64`: over a long line lyon's sum of lengths is
/// farther off than two places may be that are one.
#[test]
fn lengths_drift_over_a_whole_outline() {
    use lyon::algorithms::length::approximate_length;
    let there_and_back: Vec<Vec2> = wave().into_iter().chain(wave().into_iter().rev()).collect();
    let arc = crate::sewing::ring::arcs(&there_and_back, false);
    let mut path = lyon::path::Path::builder();
    let frame = Frame(there_and_back[0]);
    path.begin(frame.to(there_and_back[0]));
    for p in &there_and_back[1..] {
        path.line_to(frame.to(*p));
    }
    path.end(false);
    let length = f64::from(approximate_length(&path.build(), NO_CURVES)) * GRID;
    let drift = (length - arc[arc.len() - 1]).abs();
    assert!(drift > crate::sewing::ring::SAME, "lyon can measure whole outlines: {drift}");
}
