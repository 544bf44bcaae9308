//! The T-shirt: front, back, a set-in sleeve that is cut twice, and a neckband that is stretched onto the neckline.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, left, solve, towards, whole};
use crate::sheet::Draft;
use crate::upper::{Upper, left_name};
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// Ease of the bust, all round.
pub const BUST_EASE: f64 = 120.0;
/// Ease of the hip, all round.
const HIP_EASE: f64 = 50.0;
/// Ease of the upper arm.
const ARM_EASE: f64 = 80.0;
/// Ease of the sleeve cap over the armhole.
pub const CAP_EASE: f64 = 6.0;
/// Length of the neckline over the length of the band.
pub const NECK_STRETCH: f64 = 1.1;
/// Finished width of the neckband.
const BAND: f64 = 20.0;
/// Height of the hem.
const HEM: f64 = WAIST_HEIGHT - 200.0;
/// Underarm height.
const UNDERARM: f64 = 1232.0;
/// Side length of the sleeve below the underarm.
const SLEEVE: f64 = 110.0;
/// Notches from the underarm, along armhole and cap.
const FRONT_NOTCH: f64 = 85.0;
const BACK_NOTCH: [f64; 2] = [95.0, 103.0];

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let front = body(m, 1380.0 - (m.neck - 360.0) / 5.0, [0.45, 0.5], m.bust / 8.0 + 68.0);
    let back = body(m, 1447.0, [0.2, 0.52], m.bust / 8.0 + 76.0);
    let armholes = [front[2].length(), back[2].length()];
    let neckline = 2.0 * (front[4].length() + back[4].length());
    vec![
        torso("FRONT", &front, &[FRONT_NOTCH], 0.0),
        torso("BACK", &back, &BACK_NOTCH, 700.0),
        sleeve(m, armholes),
        band(neckline / NECK_STRETCH, 2.0 * front[4].length() / NECK_STRETCH),
    ]
}

/// The right half of front or back.
fn body(m: &Measures, neck_centre: f64, neck_reach: [f64; 2], across: f64) -> Vec<Edge> {
    let underarm = at((m.bust + BUST_EASE) / 4.0, UNDERARM);
    let corner = at((m.hip + HIP_EASE) / 4.0, HEM);
    let upper = Upper {
        neck: at(m.neck / 5.0 + 16.0, 1472.0),
        shoulder_x: 206.0 + (m.bust - 880.0) / 20.0,
        slope: 19.0,
        neck_centre,
        neck_reach,
        pitch: at(across, UNDERARM + 92.0),
    };
    let up = (underarm - corner).normalize();
    let hem = Edge::start("hem", at(0.0, HEM)).curve(at(1.0, 0.0), corner, -left(up), [0.33; 2], 8);
    let [armhole, shoulder, neck] = upper.edges(underarm, up);
    vec![hem, Edge::straight("side", corner, underarm), armhole, shoulder, neck]
}

fn torso(name: &'static str, half: &[Edge], notches: &[f64], x: f64) -> Draft {
    let edges = whole(half, left_name);
    let mut marks = vec![(0, edges[0].length() / 2.0), (4, edges[4].length() / 2.0)];
    for d in notches {
        marks.extend([(2, *d), (6, edges[6].length() - d)]);
    }
    // A balance notch 150 mm above the hem.
    marks.extend([(1, 150.0), (7, edges[7].length() - 150.0)]);
    Draft {
        name,
        notches: marks,
        edges,
        grain: [at(0.0, 920.0), at(0.0, 1300.0)],
        quantity: Quantity::default(),
        shift: at(x, 0.0),
        ..Draft::default()
    }
}

/// One half of the cap, from the underarm at `x` to the top at height `h`.
fn half_cap(x: f64, h: f64) -> Edge {
    let s = if x > 0.0 { -1.0 } else { 1.0 };
    Edge::start("cap", at(x, 0.0)).curve(towards(90.0 - s * 84.0), at(0.0, h), at(s, 0.0), [0.48, 0.42], 32)
}

/// The left sleeve: front to the left. Each half of the cap is as long as its armhole and half the ease.
fn sleeve(m: &Measures, [front, back]: [f64; 2]) -> Draft {
    let width = m.upper_arm + ARM_EASE;
    let cap = |split: f64| {
        let h = solve(40.0, 220.0, |h| half_cap(width - split, h).length() - back - CAP_EASE / 2.0);
        (half_cap(width - split, h), half_cap(-split, h), h)
    };
    let split = solve(0.4 * width, 0.6 * width, |s| cap(s).1.length() - front - CAP_EASE / 2.0);
    let (back_cap, front_cap, h) = cap(split);
    let taper = 14.0;
    let (left_hem, right_hem) = (at(taper - split, -SLEEVE), at(width - split - taper, -SLEEVE));
    let up = |from: Vec2, to: Vec2| (to - from).normalize();
    let (right_up, left_up) = (up(right_hem, back_cap.first()), up(left_hem, front_cap.first()));
    let total = back_cap.length() + front_cap.length();
    let middle = 0.5 * (left_hem + right_hem) + at(0.0, 10.0);
    let hem = Edge::start("hem", left_hem).curve(-left(left_up), middle, at(1.0, 0.0), [0.33; 2], 8).curve(
        at(1.0, 0.0),
        right_hem,
        -left(right_up),
        [0.33; 2],
        8,
    );
    let edges = vec![
        hem,
        Edge::straight("under-back", right_hem, back_cap.first()),
        back_cap.clone().then(front_cap.clone().reversed()),
        Edge::straight("under-front", front_cap.first(), left_hem),
    ];
    let under = edges[1].length();
    Draft {
        name: "SLEEVE",
        // Notches at the same distance from the underarm as on the armhole, and one at the top for the shoulder.
        notches: vec![
            (2, BACK_NOTCH[0]),
            (2, BACK_NOTCH[1]),
            (2, back_cap.length()),
            (2, total - FRONT_NOTCH),
            (1, under - 40.0),
            (3, 40.0),
        ],
        edges,
        grain: [at(0.0, -90.0), at(0.0, h - 20.0)],
        quantity: Quantity { plain: 1, mirrored: 1 },
        annotation: "FRONT IS LEFT, CUT 1 PAIR",
        shift: at(1250.0, 1200.0),
        ..Draft::default()
    }
}

/// The neckband, single: its lower edge is sewn to the neckline, the join lies at the left shoulder.
fn band(length: f64, front: f64) -> Draft {
    let corners = [at(0.0, 0.0), at(length, 0.0), at(length, BAND), at(0.0, BAND)];
    let edge = |name, i: usize| Edge::straight(name, corners[i], corners[(i + 1) % 4]);
    Draft {
        name: "NECKBAND",
        edges: vec![edge("neck", 0), edge("join", 1), edge("top", 2), edge("join-2", 3)],
        // Where the band meets the right shoulder, and the centres.
        notches: vec![(0, length - front), (0, length - front / 2.0), (0, (length - front) / 2.0)],
        grain: [at(length * 0.3, BAND / 2.0), at(length * 0.7, BAND / 2.0)],
        quantity: Quantity::default(),
        annotation: "STRETCH ONTO THE NECKLINE",
        shift: at(1050.0, 950.0),
        ..Draft::default()
    }
}
