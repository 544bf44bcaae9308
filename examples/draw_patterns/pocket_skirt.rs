//! The skirt with pockets and lining: an A-line with slanted pockets in the front, and a lining of its own shape.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, whole};
use crate::long_skirt::{self, halves};
use crate::sheet::{Draft, Wedge};
use toile_garment::piece::Quantity;

/// Waist to hem at the centre.
const LENGTH: f64 = 560.0;
/// Ease of the waist: the shell lies around the lining, which lies around the body.
pub const WAIST_EASE: f64 = 16.0;
/// Ease of the waist of the lining.
pub const LINING_EASE: f64 = 8.0;
/// How much shorter the lining is.
const LINING_SHORTER: f64 = 40.0;
/// Where the opening of the pocket begins at the waist, from the side seam.
const ACROSS: f64 = 50.0;
/// Where it ends at the side seam, from the waist.
const DOWN: f64 = 160.0;
/// How far the bag goes on at the waist beside the opening.
const LAP: f64 = 28.0;
/// How deep the bag hangs below the end of the opening.
const DEPTH: f64 = 90.0;

/// Front, back, both sides of the pocket bag, and the lining.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let [front, back] = halves(m, LENGTH, WAIST_EASE);
    let [lining_front, lining_back] = halves(m, LENGTH - LINING_SHORTER, LINING_EASE);
    let [side, upper] = front[1].cut(front[1].length() - DOWN, ["side", "side-top"], [16, 8]);
    let [outer, inner] = front[2].cut(ACROSS, ["waist-bag", "waist-side"], [6, 6]);
    let [lap, _] = inner.cut(LAP, ["waist-bag", "waist-side"], [4, 4]);
    let opening = Edge::start("opening", side.last()).line(outer.last(), 4);
    let bag = bag(lap.last(), side.last());
    let mut with_pocket = vec![front[0].clone(), side, opening.clone(), inner];
    with_pocket.extend(front[3..].iter().cloned());
    vec![
        shell("FRONT", &with_pocket, 0.0),
        long_skirt::piece("BACK", &back, 900.0),
        pocket("POCKET-BACK", vec![upper, outer, lap.clone(), bag.clone()], 300.0),
        pocket("POCKET-FRONT", vec![opening, lap, bag], 500.0),
        lining(long_skirt::piece("LINING-FRONT", &lining_front, 1900.0)),
        lining(long_skirt::piece("LINING-BACK", &lining_back, 2800.0)),
    ]
}

fn lining(piece: Draft) -> Draft {
    Draft { material: "LINING", ..piece }
}

/// The front, whose pockets cut off the corners at the side.
fn shell(name: &'static str, half: &[Edge], x: f64) -> Draft {
    let edges = whole(half, |name| match name {
        "side" => "side-2",
        "opening" => "opening-2",
        "waist-side" => "waist-side-2",
        other => other,
    });
    let middle = |i: usize| (i, edges[i].length() / 2.0);
    Draft {
        name,
        wedges: vec![Wedge { leg: 4 }, Wedge { leg: 7 }],
        notches: vec![(1, 180.0), (11, edges[11].length() - 180.0), middle(6), middle(0)],
        edges,
        grain: [at(0.0, WAIST_HEIGHT - LENGTH + 80.0), at(0.0, WAIST_HEIGHT - 160.0)],
        quantity: Quantity { plain: 1, mirrored: 0 },
        shift: at(x, 0.0),
        ..Draft::default()
    }
}

/// The curve of the bag, from the waist around to the end of the opening.
fn bag(waist: toile_garment::Vec2, end: toile_garment::Vec2) -> Edge {
    let low = at(0.6 * waist.x + 0.4 * end.x, end.y - DEPTH);
    Edge::start("bag", waist).line(at(waist.x, end.y), 4).curve(at(0.0, -1.0), low, at(1.0, 0.0), [0.4; 2], 17).curve(
        at(1.0, 0.0),
        end,
        at(0.55, 0.83),
        [0.4; 2],
        18,
    )
}

fn pocket(name: &'static str, edges: Vec<Edge>, x: f64) -> Draft {
    let bag = &edges[edges.len() - 1];
    let (top, low) = (bag.first(), bag.last() - at(0.0, 0.6 * DEPTH));
    Draft {
        name,
        grain: [at(top.x + 20.0, low.y), at(top.x + 20.0, top.y - 60.0)],
        edges,
        quantity: Quantity { plain: 1, mirrored: 1 },
        material: "LINING",
        annotation: "CUT 1 PAIR",
        shift: at(x, 0.0),
        ..Draft::default()
    }
}
