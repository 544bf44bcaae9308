//! Skirts of straight widths of cloth: gathered by elastic at the waist, and laid into box pleats.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, whole};
use crate::sheet::Draft;
use toile_garment::piece::Quantity;

/// Cloth over the waist of the gathered skirt.
pub const GATHER: f64 = 2.0;
/// Ease of the waist of the pleated skirt, all round.
pub const PLEATED_WAIST_EASE: f64 = 8.0;
/// Cloth in a pleat of the pleated skirt.
pub const PLEAT: f64 = 80.0;
/// Pleats in the front, and as many in the back.
pub const PLEATS: usize = 4;
/// Waist to hem.
const LENGTH: f64 = 560.0;

/// The gathered skirt: front and back, each as wide as the waist is round.
pub fn gathered(m: &Measures) -> Vec<Draft> {
    both(0.5 * GATHER * m.waist)
}

/// The pleated skirt: front and back with their pleats.
pub fn pleated(m: &Measures) -> Vec<Draft> {
    both(0.5 * (m.waist + PLEATED_WAIST_EASE) + PLEATS as f64 * PLEAT)
}

fn both(width: f64) -> Vec<Draft> {
    vec![piece("FRONT", width, 0.0), piece("BACK", width, 1600.0)]
}

fn piece(name: &'static str, width: f64, x: f64) -> Draft {
    let (side, low) = (0.5 * width, WAIST_HEIGHT - LENGTH);
    let half = [
        Edge::start("hem", at(0.0, low)).line(at(side, low), 4),
        Edge::start("side", at(side, low)).line(at(side, WAIST_HEIGHT), 4),
        Edge::start("waist", at(side, WAIST_HEIGHT)).line(at(0.0, WAIST_HEIGHT), 4),
    ];
    let edges = whole(&half, |name| if name == "side" { "side-2" } else { name });
    Draft {
        name,
        // Balance marks above the hem, and the centre.
        notches: vec![(1, 180.0), (3, LENGTH - 180.0), (2, side)],
        edges,
        grain: [at(0.0, low + 60.0), at(0.0, WAIST_HEIGHT - 60.0)],
        quantity: Quantity { plain: 1, mirrored: 0 },
        shift: at(x, 0.0),
        ..Draft::default()
    }
}
