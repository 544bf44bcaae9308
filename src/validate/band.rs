//! Mean and scatter of readings, and whether two of them agree.

use serde::{Deserialize, Serialize};

/// Several readings of one thing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// Number of readings.
    pub count: usize,
    /// Their mean.
    pub mean: f64,
    /// Their standard deviation, of a sample; unknown for a single one.
    pub scatter: Option<f64>,
    /// The least.
    pub least: f64,
    /// The largest.
    pub largest: f64,
}

impl Band {
    /// The band of some readings; `None` without any.
    #[must_use]
    pub fn of(readings: &[f64]) -> Option<Self> {
        let count = readings.len();
        if count == 0 {
            return None;
        }
        let mean = readings.iter().sum::<f64>() / count as f64;
        let square: f64 = readings.iter().map(|r| (r - mean) * (r - mean)).sum();
        let scatter = (count > 1).then(|| (square / (count - 1) as f64).sqrt());
        let least = readings.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = readings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Some(Self { count, mean, scatter, least, largest })
    }

    /// Mean ± scatter of both overlap; unknown where a scatter is.
    #[must_use]
    pub fn agrees_with(&self, other: &Self) -> Option<bool> {
        Some((self.mean - other.mean).abs() <= self.scatter? + other.scatter?)
    }

    /// The mean of `other` lies between the least and the largest reading; unknown for a single reading.
    #[must_use]
    pub fn holds(&self, other: &Self) -> Option<bool> {
        (self.count > 1).then(|| (self.least..=self.largest).contains(&other.mean))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_is_mean_and_scatter_of_a_sample() {
        let band = Band::of(&[1.0, 2.0, 3.0, 6.0]).expect("readings");
        assert_eq!((band.count, band.mean, band.least, band.largest), (4, 3.0, 1.0, 6.0));
        assert!((band.scatter.expect("a sample") - (14.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        let one = Band::of(&[5.0]).expect("a reading");
        assert_eq!((one.mean, one.scatter), (5.0, None));
        assert_eq!((band.agrees_with(&one), one.agrees_with(&band), one.holds(&band)), (None, None, None));
        let far = Band::of(&[9.0, 9.5]).expect("readings");
        assert_eq!((band.agrees_with(&band), band.agrees_with(&far)), (Some(true), Some(false)));
        assert_eq!((band.holds(&one), band.holds(&far)), (Some(true), Some(false)));
        assert!(Band::of(&[]).is_none());
    }
}
