//! The look of a material: its bitmap in linear light, in sizes that halve, so that a far look does not flicker.

use toile_garment::texture::Material;

/// One size of a bitmap, linear RGB.
struct Level {
    width: usize,
    height: usize,
    pixels: Vec<[f64; 3]>,
}

/// A material as the picture needs it.
pub struct Look {
    colour: [f64; 3],
    repeat: [f64; 2],
    levels: Vec<Level>,
}

/// Colour of cloth that has no material: unbleached calico, linear RGB.
const CALICO: [f64; 3] = [0.68, 0.63, 0.54];

impl Look {
    /// Calico.
    #[must_use]
    pub fn plain() -> Self {
        Self { colour: CALICO, repeat: [1.0; 2], levels: Vec::new() }
    }

    /// A material of the garment. A bitmap that cannot be decoded is left out: the colour remains.
    #[must_use]
    pub fn of(material: &Material) -> Self {
        let repeat = material.repeat.map(|m| if m.is_finite() && m > 1e-6 { m } else { 1.0 });
        let colour = material.color.map(|c| if c.is_finite() { c.clamp(0.0, 1.0) } else { 1.0 });
        let bytes = material.image.as_ref().map(|i| i.bytes.as_slice()).unwrap_or_default();
        let first = image::load_from_memory(bytes).ok().map(|i| level(&i.to_rgb8()));
        let mut levels: Vec<Level> = first.into_iter().collect();
        while let Some(next) = levels.last().filter(|l| l.width > 1 || l.height > 1).map(halved) {
            levels.push(next);
        }
        Self { colour, repeat, levels }
    }

    /// Linear colour at a place on the cloth, metres along weft and warp, where a sample covers `footprint` metres.
    #[must_use]
    pub fn at(&self, [u, v]: [f64; 2], footprint: f64) -> [f64; 3] {
        let Some(first) = self.levels.first() else { return self.colour };
        let texel = (self.repeat[0] / first.width as f64).min(self.repeat[1] / first.height as f64);
        let mut k = 0;
        let mut covered = texel;
        while covered < footprint && k + 1 < self.levels.len() {
            covered *= 2.0;
            k += 1;
        }
        let texture = self.levels[k].bilinear([u / self.repeat[0], v / self.repeat[1]]);
        std::array::from_fn(|c| texture[c] * self.colour[c])
    }
}

fn level(bitmap: &image::RgbImage) -> Level {
    let table: Vec<f64> = (0..=255u8).map(|b| linear(f64::from(b) / 255.0)).collect();
    let pixels = bitmap.pixels().map(|p| p.0.map(|b| table[usize::from(b)])).collect();
    Level { width: bitmap.width() as usize, height: bitmap.height() as usize, pixels }
}

fn halved(level: &Level) -> Level {
    let (width, height) = ((level.width / 2).max(1), (level.height / 2).max(1));
    let pixel = |x: usize, y: usize| level.pixels[y.min(level.height - 1) * level.width + x.min(level.width - 1)];
    let mean = |i: usize| {
        let (x, y) = (2 * (i % width), 2 * (i / width));
        let four = [pixel(x, y), pixel(x + 1, y), pixel(x, y + 1), pixel(x + 1, y + 1)];
        std::array::from_fn(|c| 0.25 * (four[0][c] + four[1][c] + four[2][c] + four[3][c]))
    };
    Level { width, height, pixels: (0..width * height).map(mean).collect() }
}

impl Level {
    /// Repeats without end; v runs upwards, the rows of the bitmap downwards.
    fn bilinear(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        let (x, y) = (u * self.width as f64 - 0.5, -v * self.height as f64 - 0.5);
        let ((fx, fy), wrap) = ((x.floor(), y.floor()), |i: f64, n: usize| (i as i64).rem_euclid(n as i64) as usize);
        let (tx, ty) = (x - fx, y - fy);
        let row = [wrap(fy, self.height), wrap(fy + 1.0, self.height)].map(|r| r * self.width);
        let column = [wrap(fx, self.width), wrap(fx + 1.0, self.width)];
        std::array::from_fn(|c| {
            let at = |r: usize, k: usize| self.pixels[row[r] + column[k]][c];
            let line = |r: usize| at(r, 0) + (at(r, 1) - at(r, 0)) * tx;
            line(0) + (line(1) - line(0)) * ty
        })
    }
}

/// sRGB 0 to 1 to linear light.
#[must_use]
pub fn linear(s: f64) -> f64 {
    if s <= 0.040_45 { s / 12.92 } else { libm::pow((s + 0.055) / 1.055, 2.4) }
}

/// Linear light to sRGB 0 to 1.
#[must_use]
pub fn srgb(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_far_look_at_a_check_is_its_mean() {
        let bitmap = image::RgbImage::from_fn(4, 4, |x, y| image::Rgb([if (x + y) % 2 == 0 { 255 } else { 0 }; 3]));
        let mut levels = vec![level(&bitmap)];
        levels.push(halved(&levels[0]));
        let look = Look { colour: [1.0; 3], repeat: [0.04, 0.04], levels };
        assert!((look.at([0.005, -0.005], 1e-4)[0] - 1.0).abs() < 1e-12);
        assert!((look.at([0.013, 0.021], 0.02)[0] - 0.5).abs() < 1e-12);
        for s in [0.0, 0.01, 0.3, 1.0] {
            assert!((srgb(linear(s)) - s).abs() < 1e-6);
        }
    }
}
