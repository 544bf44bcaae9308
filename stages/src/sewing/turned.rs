//! A seam whose sides lie one way and are named the other: sewn so, the cloth between them is twisted by half a turn.

use super::codes;
use toile_garment::{Diagnostic, Vec3};

/// The most that is left of the length of all stitches together, where they are those of a seam named the wrong way
/// round and one side is turned. So little that a seam named right between pieces placed askew is never meant.
const SHORTER: f64 = 0.7;
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
        let named = stitches.iter().map(|[a, b]| (a - b).norm()).sum();
        let turned = stitches.iter().zip(stitches.iter().rev()).map(|(s, t)| (s[0] - t[1]).norm()).sum();
        (turned < SHORTER * named).then_some(Self { named, turned })
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
    fn far_from_each_other_sides_tell_nothing_and_rings_never() {
        assert_eq!(Lengths::of_turned(&seam(0.5, true)), None);
        let mut ring = seam(0.05, true);
        ring.push(ring[0]);
        assert_eq!(Lengths::of_turned(&ring), None);
        assert_eq!(Lengths::of_turned(&seam(0.05, true)[..2]), None);
    }
}
