//! The hooded sweatshirt: long sleeves with cuffs, a waistband of rib, and a hood of two halves.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, solve};
use crate::loose::{Loose, torso};
use crate::sheet::Draft;
use crate::sleeve::Sleeve;
use toile_garment::piece::Quantity;

/// Ease of the bust, all round.
pub const BUST_EASE: f64 = 180.0;
/// Ease of the sleeve cap over the armhole.
pub const CAP_EASE: f64 = 6.0;
/// Length of the hem over the rib.
pub const HEM_STRETCH: f64 = 1.15;
/// Length of the hem of the sleeve over the cuff.
pub const CUFF_STRETCH: f64 = 1.2;
/// Height of the rib at the hem, and of the cuffs.
const RIB: f64 = 60.0;
/// Height of the hood at its face.
const HOOD: f64 = 340.0;
/// Notches from the underarm, along armhole and cap.
const FRONT_NOTCH: f64 = 85.0;
const BACK_NOTCH: [f64; 2] = [95.0, 103.0];

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let neck = at(m.neck / 5.0 + 20.0, 1474.0);
    let bodice = |neck_centre, neck_reach, across| Loose {
        bust_ease: BUST_EASE,
        hip_ease: 100.0,
        hem: WAIST_HEIGHT - 150.0,
        underarm: 1212.0,
        neck,
        shoulder: 212.0,
        neck_centre,
        neck_reach,
        across,
    };
    let front = bodice(1380.0, [0.45, 0.5], m.bust / 8.0 + 78.0).half(m);
    let back = bodice(1447.0, [0.2, 0.52], m.bust / 8.0 + 86.0).half(m);
    let caps = [&front, &back].map(|half| half[2].length() + CAP_EASE / 2.0);
    let wrist = 1.25 * (m.upper_arm - 70.0);
    let sleeve = Sleeve { caps, width: m.upper_arm + 120.0, hem: wrist, length: 400.0, bow: 0.0, steps: 32 };
    let hem = 2.0 * (front[0].length() + back[0].length());
    let rib = |name, length: f64, x, pair: bool| Draft {
        quantity: Quantity { plain: 1, mirrored: u32::from(pair) },
        shift: at(x, 700.0),
        ..Draft::strip(name, ["top", "join", "low", "join-2"], length, RIB)
    };
    vec![
        torso("FRONT", &front, &[FRONT_NOTCH], 0.0),
        torso("BACK", &back, &BACK_NOTCH, 700.0),
        sleeve.draft("SLEEVE", &BACK_NOTCH, &[FRONT_NOTCH], at(1400.0, 1200.0)),
        rib("CUFF", wrist / CUFF_STRETCH, 1300.0, true),
        rib("WAISTBAND", hem / HEM_STRETCH, 0.0, false),
        hood(front[4].length(), back[4].length()),
    ]
}

/// The left half of the hood: face to the left. Its lower edge is as long as half the neckline.
fn hood(front: f64, back: f64) -> Draft {
    let neck =
        |x: f64| {
            Edge::start("neck", at(0.0, 0.0))
                .curve(at(0.95, 0.3), at(0.5 * x, 22.0), at(1.0, 0.0), [0.35; 2], 15)
                .curve(at(1.0, 0.0), at(x, 0.0), at(0.93, -0.36), [0.35; 2], 15)
        };
    let lower = neck(solve(100.0, 400.0, |x| neck(x).length() - front - back));
    let end = lower.last();
    let crown = at(0.42 * end.x, HOOD + 12.0);
    let centre = Edge::start("centre", end)
        .curve(at(0.36, 0.93), at(end.x + 22.0, 0.55 * HOOD), at(0.0, 1.0), [0.35; 2], 21)
        .curve(at(0.0, 1.0), crown, at(-1.0, 0.0), [0.52, 0.45], 32)
        .curve(at(-1.0, 0.0), at(-12.0, HOOD - 4.0), at(-1.0, -0.04), [0.35; 2], 11);
    let face = Edge::start("face", centre.last()).line(at(0.0, 0.0), 8);
    Draft {
        name: "HOOD",
        notches: vec![(0, front), (1, 150.0)],
        edges: vec![lower, centre, face],
        grain: [at(0.4 * end.x, 60.0), at(0.4 * end.x, HOOD - 60.0)],
        quantity: Quantity { plain: 1, mirrored: 1 },
        annotation: "FACE IS LEFT, CUT 1 PAIR",
        shift: at(1900.0, 1400.0),
        ..Draft::default()
    }
}
