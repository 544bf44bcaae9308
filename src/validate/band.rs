//! Mean and scatter of readings, and whether two of them agree.

use serde::{Deserialize, Serialize};

/// Several readings of one thing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// Number of readings.
    pub count: usize,
    /// Their mean.
    pub mean: f64,
    /// Their standard deviation, of a sample; 0 for a single one.
    pub scatter: f64,
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
        let scatter = if count > 1 { (square / (count - 1) as f64).sqrt() } else { 0.0 };
        let least = readings.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = readings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Some(Self { count, mean, scatter, least, largest })
    }

    /// Mean ± scatter of both overlap.
    #[must_use]
    pub fn agrees_with(&self, other: &Self) -> bool {
        (self.mean - other.mean).abs() <= self.scatter + other.scatter
    }

    /// The mean of `other` lies between the least and the largest reading.
    #[must_use]
    pub fn holds(&self, other: &Self) -> bool {
        (self.least..=self.largest).contains(&other.mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_is_mean_and_scatter_of_a_sample() {
        let band = Band::of(&[1.0, 2.0, 3.0, 6.0]).expect("readings");
        assert_eq!((band.count, band.mean, band.least, band.largest), (4, 3.0, 1.0, 6.0));
        assert!((band.scatter - (14.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        let one = Band::of(&[5.0]).expect("a reading");
        assert_eq!((one.mean, one.scatter), (5.0, 0.0));
        assert!(band.agrees_with(&one) && !one.agrees_with(&Band::of(&[5.1]).expect("a reading")));
        assert!(band.holds(&one) && !band.holds(&Band::of(&[6.5]).expect("a reading")));
        assert!(Band::of(&[]).is_none());
    }
}
