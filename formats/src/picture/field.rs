//! A quantity on the cloth as colours, with one scale for all pieces.

/// How colours follow the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Blue below zero, pale at zero, red above; both ends alike.
    Signed,
    /// Red at zero, over yellow to blue at the end.
    FromZero,
    /// Pale at zero, over orange to dark red at the end.
    Rising,
}

/// A quantity per piece and mesh vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Short name: a word for parameters and for programs.
    pub key: &'static str,
    /// Name for people, in lower-case letters.
    pub name: &'static str,
    /// Unit for people.
    pub unit: &'static str,
    /// Colours.
    pub scale: Scale,
    /// Values per piece and vertex, in the unit; not a number where nothing is known.
    pub values: Vec<Vec<f64>>,
    /// End of the scale, in the unit.
    pub limit: f64,
}

/// Colour where nothing is known, sRGB 0 to 1.
const UNKNOWN: [f64; 3] = [0.62, 0.62, 0.62];

/// From the lower to the upper end, sRGB 0 to 255.
const SIGNED: [[f64; 3]; 5] =
    [[33.0, 102.0, 172.0], [146.0, 197.0, 222.0], [247.0, 246.0, 243.0], [244.0, 165.0, 130.0], [178.0, 24.0, 43.0]];
const FROM_ZERO: [[f64; 3]; 5] =
    [[165.0, 0.0, 38.0], [244.0, 109.0, 67.0], [254.0, 224.0, 144.0], [116.0, 173.0, 209.0], [49.0, 54.0, 149.0]];

const RISING: [[f64; 3]; 5] =
    [[247.0, 246.0, 243.0], [253.0, 212.0, 158.0], [252.0, 141.0, 89.0], [215.0, 48.0, 31.0], [127.0, 0.0, 0.0]];

impl Field {
    /// The meaning of this quantity for the fit, in the words of ISO 20947-2.
    #[must_use]
    pub fn heading(key: &str) -> &'static str {
        match key {
            "ease" => "gap",
            "tension" | "pressure" => "tension",
            "bending" => "wrinkles",
            _ => "surface strain",
        }
    }

    /// Values at the lower and the upper end of the scale.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [if self.scale == Scale::Signed { -self.limit } else { 0.0 }, self.limit]
    }

    /// Colour of a value, sRGB 0 to 1.
    #[must_use]
    pub fn colour(&self, value: f64) -> [f64; 3] {
        let [low, high] = self.ends();
        let share = (value - low) / (high - low);
        if !share.is_finite() {
            return UNKNOWN;
        }
        let stops = self.stops();
        let at = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let k = (at as usize).min(stops.len() - 2);
        let t = at - k as f64;
        std::array::from_fn(|c| (stops[k][c] + (stops[k + 1][c] - stops[k][c]) * t) / 255.0)
    }

    /// Colours at even steps from the lower to the upper end, sRGB 0 to 255.
    #[must_use]
    pub fn stops(&self) -> &'static [[f64; 3]; 5] {
        match self.scale {
            Scale::Signed => &SIGNED,
            Scale::FromZero => &FROM_ZERO,
            Scale::Rising => &RISING,
        }
    }

    /// The smallest of some round ends that covers 98 % of the known values; the last one when none does.
    #[must_use]
    pub fn round_limit(values: &[Vec<f64>], ends: &[f64]) -> f64 {
        let mut sizes: Vec<f64> = values.iter().flatten().map(|v| v.abs()).filter(|v| v.is_finite()).collect();
        sizes.sort_unstable_by(f64::total_cmp);
        let most = sizes.get(sizes.len() * 98 / 100).copied().unwrap_or(0.0);
        ends.iter().copied().find(|e| *e >= most).or(ends.last().copied()).unwrap_or(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_ends_where_it_says() {
        let values = vec![vec![0.4, -1.9, f64::NAN]];
        let limit = Field::round_limit(&values, &[1.0, 2.0, 5.0]);
        let field = Field { key: "warp", name: "strain", unit: "%", scale: Scale::Signed, values, limit };
        assert_eq!((field.limit, field.ends()), (2.0, [-2.0, 2.0]));
        assert_eq!(field.colour(9.0), SIGNED[4].map(|c| c / 255.0));
        assert_eq!(field.colour(0.0), SIGNED[2].map(|c| c / 255.0));
        assert_eq!(field.colour(f64::NAN), UNKNOWN);
    }
}
