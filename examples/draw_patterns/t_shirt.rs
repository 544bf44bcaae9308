//! The T-shirt: front, back, a set-in sleeve that is cut twice, and a neckband that is stretched onto the neckline.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at};
use crate::loose::{Loose, torso};
use crate::sheet::Draft;
use crate::sleeve::Sleeve;
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
    let loose = Loose {
        bust_ease: BUST_EASE,
        hip_ease: HIP_EASE,
        hem: HEM,
        underarm: UNDERARM,
        neck: at(m.neck / 5.0 + 16.0, 1472.0),
        shoulder: 206.0,
        neck_centre,
        neck_reach,
        across,
    };
    loose.half(m)
}

/// The left sleeve: front to the left.
fn sleeve(m: &Measures, [front, back]: [f64; 2]) -> Draft {
    let width = m.upper_arm + ARM_EASE;
    let caps = [front + CAP_EASE / 2.0, back + CAP_EASE / 2.0];
    let sleeve = Sleeve { caps, width, hem: width - 2.0 * 14.0, length: SLEEVE, bow: 10.0, steps: 32 };
    // Notches at the same distance from the underarm as on the armhole.
    sleeve.draft("SLEEVE", &[BACK_NOTCH[0], BACK_NOTCH[1]], &[FRONT_NOTCH], at(1250.0, 1200.0))
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
