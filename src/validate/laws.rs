//! Ways of describing a cloth by few numbers, each set by drape coefficients alone.

use super::captures::Captured;
use super::specimen::{Numbers, Specimen};
use serde::Serialize;
use toile_stage_api::StageError;

/// A way of describing a cloth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Law {
    /// Its name.
    pub name: &'static str,
    /// Its physics beside stretch, shear and weight.
    pub about: &'static str,
    /// Coercive curvature HB/B of yarns that rub, 1/m; 0 for none.
    pub coercive_curvature: f64,
    /// The cloth may curl without load, so its faces drape differently.
    pub curls: bool,
}

/// Middle of the coercive curvatures of woven cloth, 10 to 60 per m (`stages/cloth/docs/hysteresis.md`).
const COERCIVE_CURVATURE: f64 = 30.0;

/// The laws, in the order of the table.
pub const LAWS: [Law; 3] = [
    Law { name: "elastic", about: "bending rigidity", coercive_curvature: 0.0, curls: false },
    Law {
        name: "hysteresis",
        about: "bending rigidity, and yarns that rub with HB/B = 30 per m",
        coercive_curvature: COERCIVE_CURVATURE,
        curls: false,
    },
    Law {
        name: "rest-curvature",
        about: "bending rigidity, and a curvature without load",
        coercive_curvature: 0.0,
        curls: true,
    },
];

/// Difference of the drape coefficients of two faces from which a curl is asked for: by so much single captures scatter.
const FACES_APART: f64 = 0.05;
/// Shortest and longest bending length that is tried, m.
const LENGTHS: [f64; 2] = [4e-3, 50e-3];
/// Bending length at which usual cloth would keep all of its shadow, m, if its drape coefficient grew in proportion. Searches
/// start from this line.
const LENGTH_OF_FULL_SHADOW: f64 = 31e-3;
/// First step of a search for the bending length, as a logarithm.
const LENGTH_STEP: f64 = 0.2;
/// First step of a search for a curl, as curvature at rest times bending length, and the strongest that is tried.
const CURL_STEP: f64 = 0.1;
const STRONGEST_CURL: f64 = 1.0;
/// Difference of a drape coefficient at which it counts as met.
const MET: f64 = 0.01;
/// Most readings of one search.
const READINGS_MOST: usize = 8;
/// Rounds in which curl and bending are set in turn.
const ROUNDS: usize = 2;

impl Law {
    /// Does it say more of this cloth than the elastic law? A curl takes two faces that drape differently.
    #[must_use]
    pub fn concerns(&self, cloth: &Captured) -> bool {
        let first = |k: usize| cloth.faces.get(k).map(|f| f.captures[0].coefficient);
        let apart = first(0).zip(first(1)).map_or(0.0, |(up, down)| (up - down).abs());
        !self.curls || apart >= FACES_APART
    }

    /// Number of faces whose first capture sets it.
    #[must_use]
    pub fn faces_that_set(&self) -> usize {
        if self.curls { 2 } else { 1 }
    }

    /// The numbers with which the first capture of each face that sets the law is met.
    ///
    /// # Errors
    /// When a specimen does not come to rest, or a stop on request.
    pub(super) fn set(&self, cloth: &Captured, specimen: &Specimen<'_>) -> Result<Numbers, StageError> {
        let goals: Vec<f64> =
            cloth.faces.iter().take(self.faces_that_set()).map(|f| f.captures[0].coefficient).collect();
        let mean = goals.iter().sum::<f64>() / goals.len() as f64;
        let with =
            |length: f64, curvature: f64| Numbers::new(specimen.areal_mass, length, self.coercive_curvature, curvature);
        let of_length = Search { range: LENGTHS.map(libm::log), step: LENGTH_STEP, goal: mean };
        let start = libm::log(LENGTH_OF_FULL_SHADOW * mean).clamp(of_length.range[0], of_length.range[1]);
        let mut length = of_length.solve(start, |log| specimen.coefficient(&with(libm::exp(log), 0.0)))?;
        let [first, second] = goals[..] else { return Ok(with(libm::exp(length), 0.0)) };
        let faces = |log: f64, curl: f64| -> Result<[f64; 2], StageError> {
            let length = libm::exp(log);
            let read = |sign: f64| specimen.coefficient(&with(length, sign * curl / length));
            Ok([read(1.0)?, read(-1.0)?])
        };
        let of_curl = Search { range: [-STRONGEST_CURL, STRONGEST_CURL], step: CURL_STEP, goal: first - second };
        let mut curl = 0.0;
        for _ in 0..ROUNDS {
            curl = of_curl.solve(curl, |curl| faces(length, curl).map(|[up, down]| up - down))?;
            length = of_length.solve(length, |log| faces(log, curl).map(|[up, down]| 0.5 * (up + down)))?;
        }
        let length = libm::exp(length);
        Ok(with(length, curl / length))
    }
}

/// A search for the place at which a rising function meets a goal.
struct Search {
    range: [f64; 2],
    /// First step.
    step: f64,
    goal: f64,
}

impl Search {
    /// The place, or the end of the range that is nearest to it. Steps grow until the goal is passed; then follows regula
    /// falsi with the Illinois rule.
    fn solve(&self, start: f64, mut read: impl FnMut(f64) -> Result<f64, StageError>) -> Result<f64, StageError> {
        let mut off = |place: f64| read(place).map(|value| value - self.goal);
        let mut last = (start, off(start)?);
        if last.1.abs() < MET {
            return Ok(start);
        }
        let way = if last.1 < 0.0 { 1.0 } else { -1.0 };
        let mut step = self.step;
        let mut next = last;
        for _ in 0..READINGS_MOST {
            if next.1.abs() < MET {
                break;
            }
            if next.1 * last.1 < 0.0 {
                let place = (last.0 * next.1 - next.0 * last.1) / (next.1 - last.1);
                let new = (place, off(place)?);
                last = if new.1 * next.1 < 0.0 { next } else { (last.0, 0.5 * last.1) };
                next = new;
            } else {
                let place = (next.0 + way * step).clamp(self.range[0], self.range[1]);
                if place == next.0 {
                    break;
                }
                (last, next) = (next, (place, off(place)?));
                step *= 2.0;
            }
        }
        Ok(next.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_goal_is_met_or_the_nearest_end_is_taken() {
        let search = |goal: f64| Search { range: [0.0, 10.0], step: 0.5, goal };
        for start in [0.1, 2.9, 3.1, 9.0] {
            let mut readings = 0;
            let place = search(9.0).solve(start, |x| {
                readings += 1;
                Ok(x * x)
            });
            let place = place.expect("a place");
            assert!((place * place - 9.0).abs() < 0.05 && readings < 10, "{place} after {readings} readings");
        }
        assert_eq!(search(-1.0).solve(1.0, |x| Ok(x * x)).expect("an end"), 0.0);
        assert_eq!(search(200.0).solve(8.0, |x| Ok(x * x)).expect("an end"), 10.0);
    }
}
