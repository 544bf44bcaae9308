//! The lined jacket: fronts with lapels that are folded over their roll lines, a collar on a stand, and a lining inside.
//!
//! Neck and lapel are the same in all sizes, so that one sewing file names the roll lines of all.

use crate::body::{Measures, WAIST_HEIGHT};
use crate::curved_band::{Curved, curved};
use crate::draft::{Edge, at, left, solve, towards};
use crate::loose::{Loose, SLOPE, torso};
use crate::sheet::Draft;
use crate::sleeve::Sleeve;
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// Ease of the bust, all round.
pub const BUST_EASE: f64 = 150.0;
/// Ease of the sleeve cap over the armhole.
pub const CAP_EASE: f64 = 6.0;
/// How far each front goes beyond the centre.
const EXTENSION: f64 = 20.0;
/// Height at which the lapel begins to roll.
const BREAK: f64 = 1150.0;
/// Where the roll line meets the neckline.
const GORGE: [f64; 2] = [46.0, 1413.0];
/// Width of the lapel at its notch and at its tip, and how far the tip lies below the notch, along the roll line.
const LAPEL: [f64; 3] = [62.0, 88.0, 17.0];
/// Height of the stand of the collar at the centre back, and of its fall.
const STAND: f64 = 26.0;
const FALL: f64 = 48.0;
/// Angle of the ring that the fall is cut from, degrees: its free edge is longer than the roll line.
const FLARE: f64 = 54.0;
/// Angle of the arc of the roll line on the stand, degrees.
const ROLL: f64 = 54.0;
/// How far the hem of the lining lies above that of the jacket.
const LINING_SHORTER: f64 = 40.0;
/// Where the front edge of the lining begins on the shoulder, from the neck, and where it ends, from the centre.
const FACING: [f64; 2] = [34.0, 60.0];
/// How far the neckline of the lining lies below that of the back.
const BACK_FACING: f64 = 45.0;
/// Notches from the underarm, along armhole and cap.
const FRONT_NOTCH: f64 = 85.0;
const BACK_NOTCH: [f64; 2] = [95.0, 103.0];

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let bodice = |neck: Vec2, neck_centre, neck_reach, across, hem| Loose {
        bust_ease: BUST_EASE,
        hip_ease: 110.0,
        hem,
        underarm: 1215.0,
        neck,
        shoulder: 204.0,
        neck_centre,
        neck_reach,
        across,
    };
    let hem = WAIST_HEIGHT - 230.0;
    let neck = at(82.0, 1468.0);
    let front = |hem| bodice(neck, 1374.0, [0.5, 0.55], m.bust / 8.0 + 74.0, hem).half(m);
    let back = |neck, centre, hem| bodice(neck, centre, [0.2, 0.52], m.bust / 8.0 + 80.0, hem).half(m);
    let (shell_front, shell_back) = (front(hem), back(neck, 1448.0, hem));
    let lining_neck = neck + towards(-SLOPE) * FACING[0];
    let lining_back = back(lining_neck, 1448.0 - BACK_FACING, hem + LINING_SHORTER);
    let caps = [&shell_front, &shell_back].map(|half| half[2].length() + CAP_EASE / 2.0);
    let sleeve =
        Sleeve { caps, width: m.upper_arm + 110.0, hem: m.upper_arm - 20.0, length: 430.0, bow: 0.0, steps: 32 };
    let front_piece = half_front(&shell_front);
    let neckline = 2.0 * (front_piece.edges[4].length() + shell_back[4].length());
    let stand = stand(neckline);
    let roll = stand.edges[1].length();
    let collar = Curved { low: roll + FALL * FLARE.to_radians(), top: roll, height: FALL };
    let collar = curved("COLLAR", ["edge", "end", "stand", "end-2"], collar);
    vec![
        front_piece,
        torso("BACK", &shell_back, &BACK_NOTCH, 700.0),
        sleeve.draft("SLEEVE", &BACK_NOTCH, &[FRONT_NOTCH], at(1400.0, 1200.0)),
        Draft { shift: at(2000.0, 1400.0), ..stand },
        Draft { shift: at(2000.0, 1250.0), ..collar },
        lining_front(&front(hem + LINING_SHORTER)),
        Draft { material: "LINING", ..torso("LINING-BACK", &lining_back, &BACK_NOTCH, 3000.0) },
    ]
}

/// The left front: hem, side, armhole, shoulder, neck, gorge, top of the lapel, its edge, front edge.
fn half_front(half: &[Edge]) -> Draft {
    let [hem, side, armhole, shoulder, neck] = half else { unreachable!("a half has five edges") };
    let (low, fold, gorge) = (at(-EXTENSION, hem.first().y), at(-EXTENSION, BREAK), at(GORGE[0], GORGE[1]));
    let roll = (gorge - fold).normalize();
    let [at_notch, at_tip, lower] = LAPEL;
    let notch = gorge + left(roll) * at_notch - roll * 5.0;
    let tip = gorge + left(roll) * at_tip - roll * (5.0 + lower);
    let edges = vec![
        Edge::start("hem", low).line(hem.first(), 1).then(hem.clone()),
        side.clone(),
        armhole.clone(),
        shoulder.clone(),
        Edge::straight("neck", neck.first(), gorge),
        Edge::straight("gorge", gorge, notch),
        Edge::straight("lapel-top", notch, tip),
        Edge::start("lapel", tip).curve(at(0.05, -1.0), fold, at(0.3, -1.0), [0.35; 2], 16),
        Edge::start("edge", fold).line(low, 12),
    ];
    Draft {
        name: "FRONT",
        notches: vec![(0, EXTENSION), (2, FRONT_NOTCH), (1, 150.0)],
        edges,
        grain: [at(60.0, 920.0), at(60.0, 1250.0)],
        quantity: Quantity { plain: 1, mirrored: 1 },
        annotation: "CUT 1 PAIR",
        ..Draft::default()
    }
}

/// The stand of the collar, which runs out at both ends: neckline and roll line, two arcs.
fn stand(neckline: f64) -> Draft {
    let (sin, cos) = libm::sincos((0.5 * ROLL).to_radians());
    // An arc from the left corner to the right one, which bulges upwards by so much.
    let arc = |name, radius: f64, bulge: f64| {
        let half_chord = radius * sin;
        let around = (half_chord * half_chord + bulge * bulge) / (2.0 * bulge);
        let angle = 2.0 * libm::asin(half_chord / around).to_degrees();
        Edge::start(name, at(-half_chord, 0.0)).arc(at(0.0, bulge - around), -angle, 24)
    };
    let bulge = |radius: f64| radius * (1.0 - cos);
    let neck = |radius: f64| arc("neck", radius, bulge(radius) - STAND);
    let radius = solve(0.7 * neckline, 1.6 * neckline, |radius| neck(radius).length() - neckline);
    let roll = arc("roll", radius, bulge(radius)).reversed();
    let middle = bulge(radius) - 0.5 * STAND;
    Draft {
        name: "STAND",
        // The centre back.
        notches: vec![(0, 0.5 * neckline), (1, 0.5 * roll.length())],
        edges: vec![neck(radius), roll],
        grain: [at(-60.0, middle), at(60.0, middle)],
        quantity: Quantity { plain: 1, mirrored: 0 },
        ..Draft::default()
    }
}

/// The left front of the lining: it begins where a facing would end.
fn lining_front(half: &[Edge]) -> Draft {
    let [hem, side, armhole, shoulder, _] = half else { unreachable!("a half has five edges") };
    let [along_shoulder, from_centre] = FACING;
    let [shoulder, _] = shoulder.cut(shoulder.length() - along_shoulder, ["shoulder", "rest"], [1, 1]);
    let [_, hem] = hem.cut(from_centre, ["rest", "hem"], [2, 8]);
    let edge = Edge::start("edge", shoulder.last()).line(hem.first(), 24);
    Draft {
        name: "LINING-FRONT",
        notches: vec![(2, FRONT_NOTCH), (1, 110.0)],
        edges: vec![hem, side.clone(), armhole.clone(), shoulder, edge],
        grain: [at(120.0, 950.0), at(120.0, 1250.0)],
        quantity: Quantity { plain: 1, mirrored: 1 },
        material: "LINING",
        annotation: "CUT 1 PAIR",
        shift: at(2400.0, 0.0),
        ..Draft::default()
    }
}
