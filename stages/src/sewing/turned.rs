//! A seam whose sides lie one way and are named the other: sewn so, the cloth between them is twisted by half a turn.

use super::codes;
use toile_garment::{Diagnostic, Vec3};

/// Two sides lie against each other where, with one side turned round, this share of their distances is left at most. The
/// distances are those after one side is moved onto the other, so that they do not depend on how far the pieces lie apart.
const LEFT_AFTER_TURN: f64 = 0.5;
/// Fewest stitches that have a direction.
const FEWEST: usize = 3;

/// Lengths of all stitches of an open seam together, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lengths {
    /// It runs as named.
    pub named: f64,
    /// With one side turned round.
    pub turned: f64,
}

impl Lengths {
    /// Of a seam that is named the wrong way round, as far as its stitches tell, which lie in sewing order; else `None`.
    #[must_use]
    pub fn of_turned(stitches: &[[Vec3; 2]]) -> Option<Self> {
        let (first, last) = (stitches.first()?, stitches.last()?);
        // A ring begins anywhere.
        if stitches.len() < FEWEST || first[0] == last[0] || first[1] == last[1] {
            return None;
        }
        let turned: Vec<[Vec3; 2]> = stitches.iter().zip(stitches.iter().rev()).map(|(s, t)| [s[0], t[1]]).collect();
        let is_turned = mismatch(&turned) < LEFT_AFTER_TURN * mismatch(stitches);
        is_turned.then(|| Self { named: total(stitches), turned: total(&turned) })
    }

    /// The finding of the seam called so.
    #[must_use]
    pub fn finding(self, seam: &str) -> Diagnostic {
        let message = format!(
            "{seam} is sewn the other way round than its sides lie, so the cloth is twisted: its stitches are {:.0} mm long \
             together, and {:.0} mm if one side is turned round",
            self.named * 1e3,
            self.turned * 1e3
        );
        Diagnostic::warning(codes::SEAM_REVERSED, message)
            .hint("swap the two ends of one side, unless the twist is meant")
    }
}

/// Sum of the lengths of stitches, m.
fn total(stitches: &[[Vec3; 2]]) -> f64 {
    stitches.iter().map(|[a, b]| (a - b).norm()).sum()
}

/// Sum of the lengths of stitches after the second side is moved, without a turn, onto the first one, m.
fn mismatch(stitches: &[[Vec3; 2]]) -> f64 {
    let mean = stitches.iter().map(|[a, b]| a - b).sum::<Vec3>() / stitches.len() as f64;
    stitches.iter().map(|[a, b]| (a - b - mean).norm()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two sides of 0.2 m, so far apart, the second one named from its top where `turned`.
    fn seam(apart: f64, turned: bool) -> Vec<[Vec3; 2]> {
        let height = |k: u32| 0.02 * f64::from(k);
        (0..=10)
            .map(|k| [Vec3::new(0.0, height(k), 0.0), Vec3::new(apart, height(if turned { 10 - k } else { k }), 0.0)])
            .collect()
    }

    #[test]
    fn a_seam_named_the_wrong_way_round_is_told_with_its_lengths() {
        let told = Lengths::of_turned(&seam(0.05, true)).expect("turned");
        assert!((told.turned - 11.0 * 0.05).abs() < 1e-12 && told.named > 2.0 * told.turned, "{told:?}");
        assert_eq!(Lengths::of_turned(&seam(0.05, false)), None);
    }

    #[test]
    fn a_short_seam_between_pieces_far_apart_is_told_too() {
        assert!(Lengths::of_turned(&seam(0.5, true)).is_some());
        assert_eq!(Lengths::of_turned(&seam(0.5, false)), None);
    }

    #[test]
    fn sides_across_each_other_and_rings_tell_nothing() {
        let across: Vec<[Vec3; 2]> =
            seam(0.05, false).iter().map(|[a, b]| [*a, Vec3::new(b.x, 0.1, b.y - 0.1)]).collect();
        assert_eq!(Lengths::of_turned(&across), None);
        let mut ring = seam(0.05, true);
        ring.push(ring[0]);
        assert_eq!(Lengths::of_turned(&ring), None);
        assert_eq!(Lengths::of_turned(&seam(0.05, true)[..2]), None);
    }
}
