//! Colours of seams: those that follow one another are far apart on the circle of hues.

/// Red, green and blue from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour(pub [f64; 3]);

impl std::fmt::Display for Colour {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [r, g, b] = self.0.map(|x| (x * 255.0).round() as u8);
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

/// The colour of a seam by its number.
pub fn colour(k: usize) -> Colour {
    let lightness = if k.is_multiple_of(2) { 0.42 } else { 0.54 };
    from_hsl(((k * 137) % 360) as f64, 0.75, lightness)
}

/// A colour from hue in degrees, saturation and lightness (CSS Color 4, section 7.1).
fn from_hsl(hue: f64, saturation: f64, lightness: f64) -> Colour {
    let range = saturation * lightness.min(1.0 - lightness);
    let part = |n: f64| {
        let k = (n + hue / 30.0) % 12.0;
        lightness - range * (k - 3.0).min(9.0 - k).clamp(-1.0, 1.0)
    };
    Colour([part(0.0), part(8.0), part(4.0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_are_those_of_the_web() {
        assert_eq!(from_hsl(0.0, 1.0, 0.5).to_string(), "#ff0000");
        assert_eq!(from_hsl(120.0, 1.0, 0.25).to_string(), "#008000");
        assert_eq!(from_hsl(240.0, 1.0, 0.5).to_string(), "#0000ff");
        assert_ne!(colour(0), colour(1));
    }
}
