//! The flared skirt: half a circle of cloth, cut in two panels, without darts. It shows how a fabric hangs.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, left, towards, whole};
use crate::sheet::Draft;
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// Ease of the waist, all round.
pub const WAIST_EASE: f64 = 8.0;
/// Waist to hem, mm.
const LENGTH: f64 = 620.0;
/// Half the angle of a panel, degrees: the four halves make half a circle.
const HALF_ANGLE: f64 = 45.0;
/// Reach of the handles of a curve, share of the chord: an arc of 45 degrees within 1e-5 of its radius.
const REACH: f64 = 0.346_5;

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let radius = (m.waist + WAIST_EASE) / std::f64::consts::PI;
    vec![piece("FRONT", radius, 0.0), piece("BACK", radius, 1500.0)]
}

fn piece(name: &'static str, radius: f64, x: f64) -> Draft {
    let edges = whole(&half(radius), left_name);
    let middle = |edge: &Edge| edge.length() / 2.0;
    Draft {
        name,
        notches: vec![(1, middle(&edges[1])), (3, middle(&edges[3])), (2, middle(&edges[2])), (0, middle(&edges[0]))],
        edges,
        grain: [at(0.0, WAIST_HEIGHT - LENGTH + 100.0), at(0.0, WAIST_HEIGHT - 100.0)],
        quantity: Quantity { plain: 1, mirrored: 0 },
        shift: at(x, 0.0),
        ..Draft::default()
    }
}

fn left_name(right: &'static str) -> &'static str {
    if right == "side" { "side-2" } else { right }
}

/// The right half: hem, side, waist.
fn half(radius: f64) -> Vec<Edge> {
    let centre = at(0.0, WAIST_HEIGHT + radius);
    let out = towards(HALF_ANGLE - 90.0);
    let on = |r: f64, direction: Vec2| centre + direction * r;
    let (hem, waist) = (on(radius + LENGTH, out), on(radius, out));
    let around = left(out);
    vec![
        Edge::start("hem", on(radius + LENGTH, at(0.0, -1.0))).curve(at(1.0, 0.0), hem, around, [REACH; 2], 20),
        Edge::start("side", hem).line(waist, 16),
        Edge::start("waist", waist).curve(-around, on(radius, at(0.0, -1.0)), at(-1.0, 0.0), [REACH; 2], 10),
    ]
}
