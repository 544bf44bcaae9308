//! Triangles and lines into samples, a band of rows at a time, and samples into pixels.

use super::camera::Camera;
use super::cloth::srgb;
use super::light::Open;
use super::model::{Model, Skin, Surface};
use toile_garment::Vec3;

/// Samples along each side of a pixel.
const FINE: usize = 3;

/// Rows of pixels that are drawn at a time.
const BAND: usize = 48;

/// Lines lie this far in front of the cloth they belong to, metres.
const LINE_BEFORE: f64 = 0.004;

/// Directions to the lights and how strong they are, in the axes of the camera: right, up, towards the eye.
const KEY: [f64; 3] = [-0.50, 0.62, 0.60];
const FILL: [f64; 3] = [0.75, 0.10, 0.65];
const KEY_LIGHT: f64 = 0.72;
const FILL_LIGHT: f64 = 0.16;
const SKY: f64 = 0.50;
const GROUND: f64 = 0.26;

/// Colour behind everything, sRGB 0 to 1.
pub const PAPER: [f64; 3] = [0.957, 0.949, 0.933];

/// A picture in sRGB, 0 to 1, row by row from the top.
#[derive(Clone, Debug)]
pub struct Canvas {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Colours.
    pub pixels: Vec<[f64; 3]>,
}

/// The samples of a triangle: calls `hit` with column, row, the shares of the corners and the interpolated depth.
/// `rows` is the range that is drawn, `width` the number of columns.
pub fn cover(at: [[f64; 3]; 3], rows: [i64; 2], width: i64, mut hit: impl FnMut(usize, usize, [f64; 3], f64)) {
    let [a, b, c] = at;
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if !(area.abs() > 1e-12 && area.is_finite()) {
        return;
    }
    let span = |k: usize, low: i64, high: i64| {
        let (mut from, mut to) = (a[k], a[k]);
        for x in [b[k], c[k]] {
            from = if x < from { x } else { from };
            to = if x > to { x } else { to };
        }
        [upwards(from - 0.5).max(low), (-upwards(0.5 - to) + 1).min(high)]
    };
    let (columns, rows) = (span(0, 0, width), span(1, rows[0], rows[1]));
    for y in rows[0]..rows[1] {
        for x in columns[0]..columns[1] {
            let (px, py) = (x as f64 + 0.5, y as f64 + 0.5);
            let edge = |p: [f64; 3], q: [f64; 3]| ((q[0] - p[0]) * (py - p[1]) - (q[1] - p[1]) * (px - p[0])) / area;
            let share = [edge(b, c), edge(c, a), edge(a, b)];
            if share.iter().all(|s| *s >= 0.0) {
                let z = share[0] * a[2] + share[1] * b[2] + share[2] * c[2];
                hit(x as usize, y as usize, share, z);
            }
        }
    }
}

/// The least integer that is not smaller. It is quicker than `ceil`, which calls a function on older processors.
fn upwards(x: f64) -> i64 {
    let whole = x as i64;
    whole + i64::from(x > whole as f64)
}

/// Direction to the key light in the world, unit.
#[must_use]
pub fn key(camera: &Camera) -> Vec3 {
    direction(camera, KEY)
}

fn direction(camera: &Camera, [x, y, z]: [f64; 3]) -> Vec3 {
    (camera.right * x + camera.up * y + camera.toward * z).normalize()
}

#[derive(Clone, Copy)]
struct Sample {
    depth: f64,
    surface: u32,
    triangle: u32,
    share: [f64; 2],
    dark: f64,
}

const NOTHING: Sample = Sample { depth: f64::NEG_INFINITY, surface: u32::MAX, triangle: 0, share: [0.0; 2], dark: 0.0 };

/// Draws a model as a camera sees it. `open` is what every vertex sees of the light.
#[must_use]
pub fn draw(model: &Model, camera: &Camera, open: &[Open], width: usize, height: usize) -> Canvas {
    let fine = FINE as f64;
    let camera = Camera { scale: camera.scale * fine, middle: camera.middle.map(|m| m * fine), ..*camera };
    let at: Vec<Vec<[f64; 3]>> =
        model.surfaces.iter().map(|s| s.positions.iter().map(|p| camera.place(*p)).collect()).collect();
    let shader = Shader { model, camera: &camera, open, key: key(&camera), fill: direction(&camera, FILL) };
    let mut canvas = Canvas { width, height, pixels: vec![PAPER; width * height] };
    let mut samples = vec![NOTHING; width * FINE * BAND * FINE];
    for top in (0..height).step_by(BAND) {
        let rows = BAND.min(height - top);
        let band = [(top * FINE) as i64, ((top + rows) * FINE) as i64];
        samples.fill(NOTHING);
        for (k, surface) in model.surfaces.iter().enumerate() {
            surfaces(&mut samples, surface, k, &at[k], band, width * FINE);
        }
        lines(&mut samples, model, &camera, band, width * FINE);
        for row in 0..rows {
            for column in 0..width {
                canvas.pixels[(top + row) * width + column] = pixel(&samples, &shader, row, column, width * FINE);
            }
        }
    }
    canvas
}

fn surfaces(samples: &mut [Sample], s: &Surface, number: usize, at: &[[f64; 3]], band: [i64; 2], across: usize) {
    for (t, triangle) in s.triangles.iter().enumerate() {
        cover(triangle.map(|i| at[i as usize]), band, across as i64, |x, y, share, depth| {
            let sample = &mut samples[(y - band[0] as usize) * across + x];
            if depth > sample.depth {
                let (surface, triangle) = (number as u32, t as u32);
                *sample = Sample { depth, surface, triangle, share: [share[0], share[1]], dark: 0.0 };
            }
        });
    }
}

/// Lines darken what they lie on; they lie on cloth only.
fn lines(samples: &mut [Sample], model: &Model, camera: &Camera, band: [i64; 2], across: usize) {
    for line in &model.lines {
        let half = (0.5 * line.width * camera.scale).max(0.5 * FINE as f64);
        let at: Vec<[f64; 3]> = line.points.iter().map(|p| camera.place(*p)).collect();
        for pair in at.windows(2) {
            stroke(pair[0], pair[1], half, band, across as i64, |x, y, depth| {
                let sample = &mut samples[(y - band[0] as usize) * across + x];
                let cloth = model.surfaces.get(sample.surface as usize).is_some_and(|s| s.cloth);
                if cloth && depth + LINE_BEFORE >= sample.depth && line.dark > sample.dark {
                    sample.dark = line.dark;
                }
            });
        }
    }
}

/// The samples within half a width of a segment.
fn stroke(a: [f64; 3], b: [f64; 3], half: f64, rows: [i64; 2], width: i64, mut hit: impl FnMut(usize, usize, f64)) {
    let range = |k: usize, low: i64, high: i64| {
        let (from, to) = if a[k] < b[k] { (a[k], b[k]) } else { (b[k], a[k]) };
        [((from - half - 0.5).ceil() as i64).max(low), ((to + half - 0.5).floor() as i64 + 1).min(high)]
    };
    let (columns, rows) = (range(0, 0, width), range(1, rows[0], rows[1]));
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let long = dx * dx + dy * dy;
    for y in rows[0]..rows[1] {
        for x in columns[0]..columns[1] {
            let (px, py) = (x as f64 + 0.5 - a[0], y as f64 + 0.5 - a[1]);
            let t = if long > 0.0 { ((px * dx + py * dy) / long).clamp(0.0, 1.0) } else { 0.0 };
            let (ex, ey) = (px - t * dx, py - t * dy);
            if ex * ex + ey * ey <= half * half {
                hit(x as usize, y as usize, a[2] + t * (b[2] - a[2]));
            }
        }
    }
}

/// The mean colour of the samples of a pixel. Samples of one triangle are one colour, at their mean place.
fn pixel(samples: &[Sample], shader: &Shader<'_>, row: usize, column: usize, across: usize) -> [f64; 3] {
    let mut seen = [(NOTHING, 0_usize); FINE * FINE];
    let mut kinds = 0;
    for y in 0..FINE {
        for x in 0..FINE {
            let sample = &samples[(row * FINE + y) * across + column * FINE + x];
            let same = |(s, _): &(Sample, usize)| (s.surface, s.triangle) == (sample.surface, sample.triangle);
            let k = seen[..kinds].iter().position(same).unwrap_or(kinds);
            if k == kinds {
                seen[k] = (*sample, 1);
                kinds += 1;
            } else {
                seen[k].0.add(sample);
                seen[k].1 += 1;
            }
        }
    }
    let mut sum = [0.0; 3];
    for (sample, count) in &seen[..kinds] {
        let colour = shader.colour(&sample.over(*count as f64), *count as f64);
        (0..3).for_each(|c| sum[c] += colour[c] * *count as f64);
    }
    sum.map(|s| s / (FINE * FINE) as f64)
}

impl Sample {
    fn add(&mut self, other: &Self) {
        (0..2).for_each(|k| self.share[k] += other.share[k]);
        self.dark += other.dark;
    }

    fn over(self, count: f64) -> Self {
        Self { share: self.share.map(|s| s / count), dark: self.dark / count, ..self }
    }
}

struct Shader<'m> {
    model: &'m Model,
    camera: &'m Camera,
    open: &'m [Open],
    key: Vec3,
    fill: Vec3,
}

impl Shader<'_> {
    /// Colour at a place that stands for so many samples, sRGB.
    fn colour(&self, sample: &Sample, samples: f64) -> [f64; 3] {
        let Some(surface) = self.model.surfaces.get(sample.surface as usize) else { return PAPER };
        let corners = surface.triangles[sample.triangle as usize].map(|i| i as usize);
        let [a, b] = sample.share;
        let share = [a, b, 1.0 - a - b];
        let normal: Vec3 = (0..3).map(|k| surface.normals[corners[k]] * share[k]).sum();
        let normal = normal / normal.norm().max(1e-12);
        // The triangle itself says which side is seen: near an outline the smooth normal may already look away.
        let [p, q, r] = corners.map(|i| surface.positions[i]);
        let facing = normal.dot(&self.camera.toward);
        let side = usize::from((q - p).cross(&(r - p)).dot(&self.camera.toward) < 0.0);
        let n = if side == 0 { normal } else { -normal };
        let open = &self.open[sample.surface as usize];
        let mix = |values: &[f64]| (0..3).map(|k| values[corners[k]] * share[k]).sum::<f64>();
        let (around, key) = (mix(&open.around[side]), mix(&open.key[side]));
        let sky = GROUND + (SKY - GROUND) * (0.5 + 0.5 * n.y);
        let soft = |l: f64, wrap: f64| ((l + wrap) / (1.0 + wrap)).max(0.0);
        let wrap = if surface.cloth { 0.10 } else { 0.20 };
        let light = sky * around
            + KEY_LIGHT * key * soft(n.dot(&self.key), wrap)
            + FILL_LIGHT * around * soft(n.dot(&self.fill), 0.3);
        // Colours that stand for numbers keep more of their own light.
        let light = if matches!(surface.skin, Skin::Coloured(_)) { 0.45 + 0.55 * light } else { light };
        let rim = 1.0 - facing.abs().min(1.0);
        let sheen = if surface.cloth { 0.07 * rim * rim * rim * around } else { 0.0 };
        let base = self.base(surface, corners, share, samples.sqrt() / self.camera.scale);
        let wrong = if surface.cloth && side == 1 { 0.82 } else { 1.0 };
        std::array::from_fn(|c| srgb((base[c] * light * wrong + sheen) * (1.0 - sample.dark)))
    }

    /// Colour of the surface itself, linear, over a width in metres.
    fn base(&self, surface: &Surface, corners: [usize; 3], share: [f64; 3], width: f64) -> [f64; 3] {
        match &surface.skin {
            Skin::Plain(colour) => *colour,
            Skin::Coloured(colours) => {
                std::array::from_fn(|c| (0..3).map(|k| colours[corners[k]][c] * share[k]).sum::<f64>())
            }
            Skin::Cloth(look, uv) => {
                let at = std::array::from_fn(|c| (0..3).map(|k| uv[corners[k]][c] * share[k]).sum::<f64>());
                self.model.looks[*look].at(at, width)
            }
        }
    }
}

impl Canvas {
    /// Draws strokes over the picture.
    pub fn strokes(&mut self, lines: &[[[f64; 2]; 2]], width: f64, ink: [f64; 3]) {
        let fine = FINE as f64;
        let mut hits = std::collections::BTreeSet::new();
        let rows = [0, (self.height * FINE) as i64];
        for [a, b] in lines {
            let [a, b] = [a, b].map(|p| [p[0] * fine, p[1] * fine, 0.0]);
            stroke(a, b, 0.5 * width * fine, rows, (self.width * FINE) as i64, |x, y, _| {
                hits.insert((y, x));
            });
        }
        let share = 1.0 / (FINE * FINE) as f64;
        for (y, x) in hits {
            let pixel = &mut self.pixels[(y / FINE) * self.width + x / FINE];
            (0..3).for_each(|c| pixel[c] += (ink[c] - PAPER[c]) * share);
        }
    }

    /// Fills a rectangle: column and row of its corner, columns and rows.
    pub fn fill(&mut self, corner: [usize; 2], size: [usize; 2], colour: [f64; 3]) {
        for y in corner[1]..(corner[1] + size[1]).min(self.height) {
            for x in corner[0]..(corner[0] + size[0]).min(self.width) {
                self.pixels[y * self.width + x] = colour;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_that_share_an_edge_cover_a_square_once() {
        let corners = [[1.0, 1.0, 0.0], [9.0, 1.0, 0.0], [9.0, 9.0, 4.0], [1.0, 9.0, 4.0]];
        let mut hits = vec![0; 100];
        let mut deepest = 0.0_f64;
        for t in [[0, 1, 2], [0, 2, 3]] {
            cover(t.map(|i| corners[i]), [0, 10], 10, |x, y, _, z| {
                // The diagonal belongs to both; a depth test makes that one.
                hits[y * 10 + x] = 1;
                deepest = deepest.max(z);
            });
        }
        assert_eq!(hits.iter().sum::<i32>(), 64);
        assert!((deepest - 3.75).abs() < 1e-12);
    }
}
