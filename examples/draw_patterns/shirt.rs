//! The shirt: fronts that are buttoned over each other, sleeves with cuffs, and a collar on a stand.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::curved_band::{Curved, curved};
use crate::draft::{Edge, at};
use crate::loose::{Loose, torso};
use crate::sheet::Draft;
use crate::sleeve::Sleeve;
use toile_garment::piece::Quantity;

/// Ease of the bust, all round.
pub const BUST_EASE: f64 = 150.0;
/// Ease of the sleeve cap over the armhole.
pub const CAP_EASE: f64 = 6.0;
/// Length of the hem of the sleeve over the cuff.
pub const CUFF_GATHER: f64 = 1.3;
/// How far each front goes beyond the centre.
pub const EXTENSION: f64 = 15.0;
/// Height of the cuff, of the stand, and of the collar.
const CUFF: f64 = 60.0;
const STAND: f64 = 28.0;
const COLLAR: f64 = 58.0;
/// Angles by which stand and collar are curved, degrees. The stand leans to the neck, the collar spreads over it.
const STAND_CURVE: f64 = 24.0;
const COLLAR_CURVE: f64 = 60.0;
/// Notches from the underarm, along armhole and cap.
const FRONT_NOTCH: f64 = 85.0;
const BACK_NOTCH: [f64; 2] = [95.0, 103.0];

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let neck = at(m.neck / 5.0 + 4.0, 1468.0);
    let bodice = |neck_centre, neck_reach, across| Loose {
        bust_ease: BUST_EASE,
        hip_ease: 90.0,
        hem: WAIST_HEIGHT - 220.0,
        underarm: 1222.0,
        neck,
        shoulder: 200.0,
        neck_centre,
        neck_reach,
        across,
    };
    let front = bodice(1374.0, [0.5, 0.55], m.bust / 8.0 + 70.0).half(m);
    let back = bodice(1448.0, [0.2, 0.52], m.bust / 8.0 + 78.0).half(m);
    let caps = [&front, &back].map(|half| half[2].length() + CAP_EASE / 2.0);
    let cuff = m.upper_arm - 60.0;
    let hem = CUFF_GATHER * cuff;
    let sleeve = Sleeve { caps, width: m.upper_arm + 110.0, hem, length: 390.0, bow: 0.0, steps: 32 };
    let neckline = 2.0 * (front[4].length() + back[4].length());
    let stand = curved(
        "STAND",
        ["neck", "end", "top", "end-2"],
        Curved { low: neckline, top: neckline - STAND * STAND_CURVE.to_radians(), height: STAND },
    );
    let top = stand.edges[2].length();
    let collar = curved(
        "COLLAR",
        ["edge", "end", "stand", "end-2"],
        Curved { low: top + COLLAR * COLLAR_CURVE.to_radians(), top, height: COLLAR },
    );
    vec![
        half_front(&front),
        torso("BACK", &back, &BACK_NOTCH, 700.0),
        sleeve.draft("SLEEVE", &BACK_NOTCH, &[FRONT_NOTCH], at(1400.0, 1200.0)),
        Draft {
            quantity: Quantity { plain: 1, mirrored: 1 },
            annotation: "CUT 1 PAIR",
            shift: at(1300.0, 700.0),
            ..Draft::strip("CUFF", ["low", "join", "sleeve", "join-2"], cuff, CUFF)
        },
        Draft { shift: at(2000.0, 1400.0), ..stand },
        Draft { shift: at(2000.0, 1250.0), ..collar },
    ]
}

/// The left front, with its extension at the centre: hem, side, armhole, shoulder, neck, edge.
fn half_front(half: &[Edge]) -> Draft {
    let [hem, side, armhole, shoulder, neck] = half else { unreachable!("a half has five edges") };
    let low = at(-EXTENSION, hem.first().y);
    let high = at(-EXTENSION, neck.last().y);
    let edges = vec![
        Edge::start("hem", low).line(hem.first(), 1).then(hem.clone()),
        side.clone(),
        armhole.clone(),
        shoulder.clone(),
        neck.clone().line(high, 1),
        Edge::start("edge", high).line(low, 16),
    ];
    Draft {
        name: "FRONT",
        // The centre at hem and neck, the armhole, and a balance notch above the hem.
        notches: vec![(0, EXTENSION), (4, neck.length()), (2, FRONT_NOTCH), (1, 150.0)],
        edges,
        grain: [at(60.0, 920.0), at(60.0, 1250.0)],
        quantity: Quantity { plain: 1, mirrored: 1 },
        annotation: "CUT 1 PAIR",
        ..Draft::default()
    }
}
