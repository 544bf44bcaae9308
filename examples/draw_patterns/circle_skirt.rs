//! The circle skirt: two half circles, whose straight edges are the side seams.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, whole};
use crate::sheet::Draft;
use std::f64::consts::TAU;
use toile_garment::piece::Quantity;

/// Ease of the waist, all round.
pub const WAIST_EASE: f64 = 8.0;
/// Waist to hem.
const LENGTH: f64 = 560.0;

/// Front and back.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    vec![piece(m, "FRONT", 0.0), piece(m, "BACK", 1600.0)]
}

fn piece(m: &Measures, name: &'static str, x: f64) -> Draft {
    let waist = (m.waist + WAIST_EASE) / TAU;
    let hem = waist + LENGTH;
    let centre = at(0.0, WAIST_HEIGHT + waist);
    let side = |x: f64| centre + at(x, 0.0);
    let half = [
        Edge::start("hem", centre - at(0.0, hem)).arc(centre, 90.0, 48),
        Edge::start("side", side(hem)).line(side(waist), 4),
        Edge::start("waist", side(waist)).arc(centre, -90.0, 20),
    ];
    let edges = whole(&half, |name| if name == "side" { "side-2" } else { name });
    let middle = |e: &Edge| e.length() / 2.0;
    Draft {
        name,
        // Balance marks above the hem, and the centres.
        notches: vec![(1, 180.0), (3, LENGTH - 180.0), (2, middle(&edges[2])), (0, middle(&edges[0]))],
        edges,
        grain: [at(0.0, WAIST_HEIGHT - LENGTH + 60.0), at(0.0, WAIST_HEIGHT - 60.0)],
        quantity: Quantity { plain: 1, mirrored: 0 },
        shift: at(x, 0.0),
        ..Draft::default()
    }
}
