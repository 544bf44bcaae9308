//! The fitted bodice, 85 mm below the waist: bust darts from the side, front waist darts that run out at the hem,
//! fish-eye darts in the back. Front and back are cut whole; the fastening is not drawn.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, left, solve, towards, turned, whole};
use crate::sheet::{Draft, Wedge};
use crate::upper::{FITTED, Upper, left_name};
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// Ease of the bust, all round.
pub const BUST_EASE: f64 = 60.0;
/// Ease of the waist, all round.
pub const WAIST_EASE: f64 = 40.0;
/// Height of the hem.
const HEM: f64 = 965.0;
/// Share of the way from waist girth to hip girth that the body has made at the hem.
const HEM_SHARE: f64 = 0.45;
/// How much longer the front quarter is than the back quarter, half of it.
const SHIFT: f64 = 5.0;
/// Hem width moved from the front to the back, so that the side seam is balanced.
const HEM_BALANCE: f64 = 8.0;
/// Half the distance of the bust points, and their height on the flat front.
const BUST_POINT: [f64; 2] = [95.0, 1226.0];
/// How far the darts end short of the bust point.
const SHORT: f64 = 25.0;
/// Intake of the bust dart.
const BUST_DART: f64 = 28.0;
/// Intake of the front waist dart at the waist.
const FRONT_DART: f64 = 20.0;
/// Intake of the back waist dart.
pub const BACK_DART: f64 = 26.0;
/// Underarm height of the back.
const UNDERARM: f64 = 1234.0;

/// Finished quarter widths: bust, waist, hem; `sign` is +1 in front and −1 in the back.
fn quarters(m: &Measures, sign: f64) -> [f64; 3] {
    let hem = m.waist + HEM_SHARE * (m.hip - m.waist) + WAIST_EASE;
    [
        (m.bust + BUST_EASE) / 4.0 + sign * SHIFT,
        (m.waist + WAIST_EASE) / 4.0 + sign * SHIFT,
        hem / 4.0 + sign * (SHIFT - HEM_BALANCE),
    ]
}

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let (back_half, back_waist) = back(m);
    let (front_half, front_waist) = front(m, back_half[1].length());
    let front_edges = whole(&front_half, left_name);
    let back_edges = whole(&back_half, left_name);
    // The waist notch lies at the same distance from the hem on both sides of the seam.
    let waist = 0.5 * (front_waist + back_waist);
    let reach = |e: &Edge, d: f64| e.length() - d;
    let middle = |e: &Edge| e.length() / 2.0;
    let front = Draft {
        name: "FRONT",
        wedges: [1, 5, 14, 18].map(|leg| Wedge { leg }).into(),
        notches: vec![
            (4, waist),
            (16, reach(&front_edges[16], waist)),
            (8, 75.0),
            (12, reach(&front_edges[12], 75.0)),
            (10, middle(&front_edges[10])),
            (0, middle(&front_edges[0])),
        ],
        edges: front_edges,
        grain: [at(0.0, 1010.0), at(0.0, 1340.0)],
        quantity: Quantity::default(),
        ..Draft::default()
    };
    let x = m.bust / 10.0 - 3.0;
    let eye = |sign: f64| {
        let width = BACK_DART / 2.0;
        [
            at(sign * x, HEM + 20.0),
            at(sign * x + width, WAIST_HEIGHT),
            at(sign * x, 1200.0),
            at(sign * x - width, WAIST_HEIGHT),
        ]
    };
    let back = Draft {
        name: "BACK",
        fish_eyes: vec![eye(1.0), eye(-1.0)],
        notches: vec![
            (1, waist),
            (7, reach(&back_edges[7], waist)),
            (2, 75.0),
            (2, 83.0),
            (6, reach(&back_edges[6], 75.0)),
            (6, reach(&back_edges[6], 83.0)),
            (4, middle(&back_edges[4])),
            (0, middle(&back_edges[0])),
        ],
        edges: back_edges,
        grain: [at(0.0, 1010.0), at(0.0, 1340.0)],
        quantity: Quantity::default(),
        shift: at(700.0, 0.0),
        ..Draft::default()
    };
    vec![front, back]
}

/// Half the width of the neck at its base.
fn neck_width(m: &Measures) -> f64 {
    m.neck / 5.0 + 3.0
}

/// The right half of the back, and the distance of the waist from the hem along its side.
fn back(m: &Measures) -> (Vec<Edge>, f64) {
    let [bust, waist, hem] = quarters(m, -1.0);
    let upper = Upper {
        neck: at(neck_width(m), 1468.0),
        shoulder_x: 188.0,
        slope: FITTED,
        neck_centre: 1446.0,
        neck_reach: [0.22, 0.5],
        pitch: at(m.bust / 8.0 + 63.0, UNDERARM + 68.0),
    };
    let corner = at(hem, HEM + 14.0);
    let middle = at(waist + BACK_DART, WAIST_HEIGHT);
    let underarm = at(bust, UNDERARM);
    let (below, above) = (towards(90.0 + 7.0), towards(90.0 - 9.0));
    let at_waist = at(0.0, 1.0);
    let lower = Edge::start("side", corner).curve(below, middle, at_waist, [0.33; 2], 12);
    let down = lower.length();
    let side = lower.curve(at_waist, underarm, above, [0.33; 2], 10);
    let hem = Edge::start("hem", at(0.0, HEM - 3.0)).curve(at(1.0, 0.0), corner, -left(below), [0.33; 2], 8);
    let [armhole, shoulder, neck] = upper.edges(underarm, above);
    (vec![hem, side, armhole, shoulder, neck], down)
}

/// The right half of the front, whose side seam is as long as the back's when the bust dart is closed.
fn front(m: &Measures, side: f64) -> (Vec<Edge>, f64) {
    let bust = quarters(m, 1.0)[0];
    let x = solve(bust - 60.0, bust + 60.0, |x| front_at(m, side, x).0[7].last().x - bust);
    front_at(m, side, x)
}

fn front_at(m: &Measures, side: f64, mouth_x: f64) -> (Vec<Edge>, f64) {
    let [_, waist, hem] = quarters(m, 1.0);
    let [a, apex, b] = front_dart();
    let slant = slant();
    let corner = at(hem + (b.x - a.x), HEM + 24.0);
    let middle = at(waist + FRONT_DART, WAIST_HEIGHT);
    let (below, at_waist) = (towards(90.0 + 24.0), towards(90.0 + 5.0));
    // The bust dart points at the bust point; its upper leg is the lower one turned about the apex.
    let bust_apex = at(BUST_POINT[0] + SHORT, BUST_POINT[1]);
    let low = at(mouth_x, BUST_POINT[1] - 20.0);
    let opening = 2.0 * libm::asin(BUST_DART / 2.0 / (low - bust_apex).norm()).to_degrees();
    let high = turned(low, bust_apex, opening);
    let lean = 90.0 - 15.0;
    let lower = Edge::start("side-low", corner).curve(below, middle, at_waist, [0.33; 2], 12);
    let down = lower.length();
    let lower = lower.curve(at_waist, low, towards(lean), [0.33; 2], 10);
    let up = towards(lean + opening);
    let underarm = high + up * (side - lower.length());
    let centre = at(0.0, a.y + a.x * libm::tan((slant / 2.0).to_radians()));
    let upper = Upper {
        neck: at(neck_width(m), 1478.0),
        shoulder_x: 188.0,
        slope: FITTED,
        neck_centre: 1478.0 - neck_width(m) - 13.0,
        neck_reach: [0.42, 0.5],
        pitch: at(m.bust / 8.0 + 52.0, underarm.y + 58.0),
    };
    let [armhole, shoulder, neck] = upper.edges(underarm, up);
    let third = [1.0 / 3.0; 2];
    let edges = vec![
        Edge::start("hem", centre).curve(at(1.0, 0.0), a, towards(-slant), third, 4),
        Edge::straight("leg", a, apex),
        Edge::straight("leg", apex, b),
        Edge::start("hem-side", b).curve(towards(slant), corner, -left(below), third, 12),
        lower,
        Edge::straight("leg", low, bust_apex),
        Edge::straight("leg", bust_apex, high),
        Edge::straight("side-top", high, underarm),
        armhole,
        shoulder,
        neck,
    ];
    (edges, down)
}

/// Half the angle of the front waist dart, degrees.
fn slant() -> f64 {
    libm::atan(FRONT_DART / 2.0 / (BUST_POINT[1] - SHORT - WAIST_HEIGHT)).to_degrees()
}

/// The front waist dart: where its legs meet the hem, and its apex below the bust point.
fn front_dart() -> [Vec2; 3] {
    let apex = at(BUST_POINT[0], BUST_POINT[1] - SHORT);
    let leg = apex.y - HEM + 4.0;
    [apex + towards(270.0 - slant()) * leg, apex, apex + towards(270.0 + slant()) * leg]
}
