//! Turns the figure until the mesh meets the measures, then states what it measures.

use super::figure::{Figure, Tune};
use super::landmarks;
use super::measures::BodyMeasures;
use super::net::Net;
use super::polygonise::{Grid, polygonise};
use super::remesh::{relax, remesh, settle};
use super::section::section_near;
use toile_garment::Vec3;

/// How far under the crotch the thigh is measured, metres.
pub const THIGH_BELOW: f64 = 0.035;
/// Where on its axis the neck is measured, metres above its base.
pub const NECK_AT: f64 = 0.055;
/// How far under the bust points the rib cage is measured, metres.
pub const UNDER_BUST_BELOW: f64 = 0.075;

/// A figure with its half mesh.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The field.
    pub figure: Figure,
    /// Its mesh over x ≥ 0.
    pub net: Net,
}

/// The measures of a mesh, in the order of [`Tune`].
pub struct Taken {
    /// Hip, waist, under bust, bust, neck, upper arm, wrist, thigh, metres.
    pub girths: [f64; 8],
    /// Stature, crotch, shoulder, bust height, floor, metres.
    pub heights: [f64; 5],
}

/// The figure and mesh that meet the measures as well as they can be met.
pub fn fit(m: &BodyMeasures) -> Fitted {
    let mut tune = Tune::default();
    for _ in 0..2 {
        let figure = Figure::new(m, &tune);
        let mut net = rough(m, &figure, 0.020);
        settle(&mut net, &|p| figure.at(p));
        turn(m, &mut tune, &take(m, &figure, &net));
    }
    let mut figure = Figure::new(m, &tune);
    let mut net = rough(m, &figure, 0.014);
    remesh(&mut net, 8, &|p| figure.at(p), &|p| edge_length(m, p));
    for _ in 0..16 {
        turn(m, &mut tune, &take(m, &figure, &net));
        figure = Figure::new(m, &tune);
        relax(&mut net, &|p| figure.at(p));
    }
    Fitted { figure, net }
}

fn rough(m: &BodyMeasures, figure: &Figure, step: f64) -> Net {
    let low = Vec3::new(0.0, -0.0613, -0.4007);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let nodes = [0.95, m.stature + 0.2, 0.85].map(|size| (size / step) as usize);
    polygonise(Grid { low, step, nodes }, |p| figure.at(p).value)
}

/// Wanted edge length at a place: finer where the limbs are thin.
fn edge_length(m: &BodyMeasures, p: Vec3) -> f64 {
    let ramp = |x: f64, from: f64, to: f64| ((x - from) / (to - from)).clamp(0.0, 1.0);
    let arm = ramp(p.x, 0.5 * m.shoulder_width + 0.03, 0.5 * m.shoulder_width + 0.25);
    let foot = ramp(-p.y, -0.5, -0.12);
    0.0185 - 0.0065 * arm.max(foot)
}

fn turn(m: &BodyMeasures, tune: &mut Tune, taken: &Taken) {
    let wanted = wanted(m);
    for ((factor, have), want) in tune.girths.iter_mut().zip(taken.girths).zip(wanted.girths) {
        if have > 0.0 {
            *factor = (*factor * (want / have)).clamp(0.3, 3.0);
        }
    }
    for ((rise, have), want) in tune.rises.iter_mut().zip(taken.heights).zip(wanted.heights) {
        *rise = (*rise + (want - have).clamp(-0.03, 0.03)).clamp(-0.15, 0.15);
    }
}

/// The wanted measures.
pub fn wanted(m: &BodyMeasures) -> Taken {
    Taken {
        girths: [
            m.girths.hip,
            m.girths.waist,
            m.under_bust(),
            m.girths.bust,
            m.girths.neck,
            m.girths.upper_arm,
            m.girths.wrist,
            m.girths.thigh,
        ],
        heights: [m.stature, m.crotch_height, m.shoulder_height, m.bust_height, 0.0],
    }
}

/// Measures a half mesh, which is mirrored for it.
pub fn take(m: &BodyMeasures, figure: &Figure, net: &Net) -> Taken {
    let (positions, triangles) = net.whole();
    let girth = |at: Vec3, normal: Vec3| section_near(&positions, &triangles, at, normal).map_or(0.0, |s| s.girth());
    let level = |height: f64| girth(Vec3::new(0.0, height, 0.0), Vec3::y());
    let (arm, along_arm) = figure.arm_axis();
    let (neck, along_neck) = figure.neck_axis();
    let thigh = figure.leg_centre(m.crotch_height - THIGH_BELOW);
    let heights = positions.iter().map(|p| p.y);
    let crotch = positions.iter().filter(|p| p.x == 0.0).map(|p| p.y).fold(f64::INFINITY, f64::min);
    Taken {
        girths: [
            level(m.hip_height),
            level(m.waist_height),
            level(m.bust_height - UNDER_BUST_BELOW),
            level(m.bust_height),
            girth(neck + along_neck * NECK_AT, along_neck),
            girth(arm + along_arm * figure.upper_arm_at, along_arm),
            girth(arm + along_arm * figure.wrist_at, along_arm),
            girth(thigh, Vec3::y()),
        ],
        heights: [
            heights.clone().fold(f64::NEG_INFINITY, f64::max),
            crotch,
            landmarks::shoulder(figure).y,
            landmarks::bust(figure, m).y,
            heights.fold(f64::INFINITY, f64::min),
        ],
    }
}
