//! The puff-sleeve blouse: a loose bodice, sleeves that are gathered into the armhole and into a cuff.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::draft::at;
use crate::loose::{Loose, torso};
use crate::sheet::Draft;
use crate::sleeve::Sleeve;
use toile_garment::piece::Quantity;

/// Ease of the bust, all round.
pub const BUST_EASE: f64 = 110.0;
/// Length of the sleeve cap over the armhole.
pub const CAP_GATHER: f64 = 1.4;
/// Length of the hem of the sleeve over the cuff.
pub const CUFF_GATHER: f64 = 1.5;
/// Ease of the cuff on the upper arm.
const CUFF_EASE: f64 = 30.0;
/// Height of the cuff.
const CUFF: f64 = 30.0;
/// Side length of the sleeve below the underarm.
const SLEEVE: f64 = 110.0;
/// Notches from the underarm, along the armhole.
const FRONT_NOTCH: f64 = 85.0;
const BACK_NOTCH: [f64; 2] = [95.0, 103.0];

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let neck = at(m.neck / 5.0 + 26.0, 1468.0);
    let bodice = |neck_centre, neck_reach, across| Loose {
        bust_ease: BUST_EASE,
        hip_ease: 60.0,
        hem: WAIST_HEIGHT - 170.0,
        underarm: 1236.0,
        neck,
        shoulder: 184.0,
        neck_centre,
        neck_reach,
        across,
    };
    let front = bodice(1350.0, [0.45, 0.5], m.bust / 8.0 + 56.0).half(m);
    let back = bodice(1436.0, [0.2, 0.52], m.bust / 8.0 + 64.0).half(m);
    let cuff = m.upper_arm + CUFF_EASE;
    let hem = CUFF_GATHER * cuff;
    let caps = [&front, &back].map(|half| CAP_GATHER * half[2].length());
    let sleeve = Sleeve { caps, width: hem + 20.0, hem, length: SLEEVE, bow: 0.0, steps: 40 };
    let scaled = |d: &f64| CAP_GATHER * d;
    let [back_notches, front_notch] = [BACK_NOTCH.map(|d| scaled(&d)), [scaled(&FRONT_NOTCH); 2]];
    vec![
        torso("FRONT", &front, &[FRONT_NOTCH], 0.0),
        torso("BACK", &back, &BACK_NOTCH, 700.0),
        sleeve.draft("SLEEVE", &back_notches, &front_notch[..1], at(1350.0, 1200.0)),
        Draft {
            quantity: Quantity { plain: 1, mirrored: 1 },
            annotation: "CUT 1 PAIR",
            shift: at(1100.0, 950.0),
            ..Draft::strip("CUFF", ["sleeve", "join", "low", "join-2"], cuff, CUFF)
        },
    ]
}
