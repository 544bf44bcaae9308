//! The turn that makes a piece upright: its upper end towards the neck, or towards the shoulder on an arm.

use super::dresser::Dresser;
use crate::roles::Part;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use toile_garment::Vec2;

/// Share of the height of a piece by which its seam lies off its middle at least, where the seam tells what is up.
const OFF_MIDDLE: f64 = 0.2;

/// The turn of a piece in its plane, rad, counter-clockwise.
#[must_use]
pub fn turn_of(d: &Dresser<'_>, i: usize) -> f64 {
    match d.part(i) {
        Some(Part::Sleeve) => up_of_sleeve(d, i).map_or(0.0, turn_to_up),
        Some(Part::Cuff) => towards_seam(d, i, 1.0).unwrap_or(0.0),
        // A collar that is folded over its stand hangs from its seam.
        Some(Part::Collar) if d.stands_under(i).next().is_some() => half_turn(towards_seam(d, i, 1.0)),
        Some(Part::Collar | Part::Stand | Part::Hood) => half_turn(towards_seam(d, i, -1.0)),
        // A band at the hem hangs from its seam.
        Some(Part::Waistband) if !d.has_below() => towards_seam(d, i, 1.0).unwrap_or(0.0),
        Some(Part::Waistband) if is_upright_strip(d, i) => FRAC_PI_2,
        _ => 0.0,
    }
}

/// A half turn, or none: bands around the neck are drawn level.
fn half_turn(turn: Option<f64>) -> f64 {
    turn.filter(|t| t.abs() > 3.0).unwrap_or(0.0)
}

/// The turn that brings a direction upwards.
fn turn_to_up(up: Vec2) -> f64 {
    let turn = FRAC_PI_2 - libm::atan2(up.y, up.x);
    turn - TAU * ((turn + PI) / TAU).floor()
}

/// A strip that is drawn upright: a band is worn level.
fn is_upright_strip(d: &Dresser<'_>, i: usize) -> bool {
    let size = d.outlines[i].size();
    size.y > 2.0 * size.x
}

/// From the end of a sleeve to its cap: along the seams between the pieces of the arm where there are some.
fn up_of_sleeve(d: &Dresser<'_>, i: usize) -> Option<Vec2> {
    let is_sleeve = |k: usize| matches!(d.part(k), Some(Part::Sleeve | Part::Cuff));
    let cap = d.seam_middle(i, |k| !is_sleeve(k))?;
    let rough = (cap - d.outlines[i].centroid()).try_normalize(1e-6)?;
    let mut along = Vec2::zeros();
    for (k, join) in d.joins.iter().enumerate() {
        let is_along = |t: &&super::dresser::Thread| t.join == k && d.part(t.other.piece) == Some(Part::Sleeve);
        // Both sides of a seam of the sleeve with itself count.
        let on: Vec<Vec2> = d.threads[i].iter().filter(is_along).map(|t| t.at).collect();
        let sides: Vec<Vec<Vec2>> = if join.is_own() && !on.is_empty() {
            [0, 1].map(|side| join.pairs.iter().map(|p| p[side].at).collect()).to_vec()
        } else {
            vec![on]
        };
        for side in sides {
            let (Some(first), Some(last)) = (side.first(), side.last()) else { continue };
            let chord = last - first;
            along += if chord.dot(&rough) < 0.0 { -chord } else { chord };
        }
    }
    // Seams across the sleeve, as of a sleeve in two lengths, tell nothing.
    along.try_normalize(1e-6).filter(|a| a.dot(&rough) > 0.7).or(Some(rough))
}

/// The quarter turn that brings the seam of a band up (`sign` 1) or down (−1), towards what it is sewn to.
fn towards_seam(d: &Dresser<'_>, i: usize, sign: f64) -> Option<f64> {
    let is_band = |k: usize| d.part(k) == d.part(i);
    let seam = d.seam_middle(i, |k| !is_band(k))?;
    let off = seam - d.outlines[i].centroid();
    let size = d.outlines[i].size();
    if off.norm() < OFF_MIDDLE * size.x.min(size.y) {
        return None;
    }
    let turn = turn_to_up(off * sign);
    Some((turn / FRAC_PI_2).round() * FRAC_PI_2)
}
