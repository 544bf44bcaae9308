//! A bitmap and a normal map of a cloth, drawn from its weave: the same bytes on every machine.
//!
//! A weave is a table of which yarn lies on top. Every yarn is round across and rises in the middle of its float, so
//! the heights of the cloth follow, and from them its normals and how much light reaches each point.

use image::ImageEncoder as _;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use toile_garment::fabric::{FabricLook, Weave};
use toile_garment::texture::Image;

/// Pixels across one yarn.
const YARN: usize = 8;
/// Height of a yarn over its width: how steep the cloth looks.
const ROUNDNESS: f64 = 0.55;
/// Share of the light that the lowest point of a cloth loses.
const DEPTH: f64 = 0.35;

/// Bitmaps of a cloth.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Grey tones that the colour of the cloth is multiplied by.
    pub image: Image,
    /// Normals: red along the weft, green along the warp, blue outwards.
    pub normal: Image,
    /// Size of the bitmaps on the cloth: along the weft, along the warp, metres.
    pub repeat: [f64; 2],
}

/// Heights of a cloth over one repeat, in widths of a yarn, row by row from the top.
struct Relief {
    columns: usize,
    rows: usize,
    heights: Vec<f64>,
}

/// Draws a cloth. `None` where its numbers of yarns are not above 0 or a bitmap cannot be encoded.
#[must_use]
pub fn draw(look: &FabricLook) -> Option<Drawn> {
    let sound = |n: f64| n.is_finite() && n > 0.0;
    if !sound(look.ends) || !sound(look.picks) {
        return None;
    }
    let relief = relief(look.weave);
    let repeat = [relief.columns as f64 / YARN as f64 / look.ends, relief.rows as f64 / YARN as f64 / look.picks];
    let (low, high) = relief.heights.iter().fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(*x), h.max(*x)));
    let grey = |h: &f64| byte(1.0 - DEPTH * (high - h) / (high - low).max(1e-9));
    let tones: Vec<u8> = relief.heights.iter().map(grey).collect();
    let image = encode(&tones, &relief, image::ExtendedColorType::L8)?;
    let normal = encode(&relief.normals(), &relief, image::ExtendedColorType::Rgb8)?;
    Some(Drawn { image, normal, repeat })
}

fn encode(pixels: &[u8], relief: &Relief, kind: image::ExtendedColorType) -> Option<Image> {
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::NoFilter);
    let (width, height) = (relief.columns as u32, relief.rows as u32);
    encoder.write_image(pixels, width, height, kind).ok()?;
    Some(Image { mime: "image/png".to_owned(), width, height, bytes })
}

fn byte(x: f64) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0).round() as u8
}

impl Relief {
    fn of(yarns: [usize; 2], height: impl Fn(usize, usize) -> f64) -> Self {
        let [columns, rows] = yarns.map(|n| n * YARN);
        let heights = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))).map(|(x, y)| height(x, y)).collect();
        Self { columns, rows, heights }
    }

    /// Unit normals as bytes. The bitmap tiles, so neighbours are taken around its edges.
    fn normals(&self) -> Vec<u8> {
        let at = |x: usize, y: usize| self.heights[y % self.rows * self.columns + x % self.columns];
        let mut out = Vec::with_capacity(3 * self.heights.len());
        for y in 0..self.rows {
            for x in 0..self.columns {
                let slope = 0.5 * YARN as f64 * ROUNDNESS;
                let dx = slope * (at(x + 1, y) - at(x + self.columns - 1, y));
                // Rows run downwards, the warp upwards.
                let dy = slope * (at(x, y + self.rows - 1) - at(x, y + 1));
                let length = libm::sqrt(dx * dx + dy * dy + 1.0);
                out.extend([-dx / length, -dy / length, 1.0 / length].map(|n| byte(0.5 + 0.5 * n)));
            }
        }
        out
    }
}

fn relief(weave: Weave) -> Relief {
    match weave {
        Weave::Plain => woven([2, 2], |end, pick| (end + pick) % 2 == 0),
        Weave::Basket => woven([4, 4], |end, pick| (end / 2 + pick / 2) % 2 == 0),
        Weave::Twill => woven([4, 4], |end, pick| (end + pick) % 4 < 2),
        Weave::WarpTwill => woven([4, 4], |end, pick| (end + pick) % 4 < 3),
        Weave::Satin => woven([5, 5], |end, pick| (2 * end + pick) % 5 != 0),
        Weave::Crepe => woven([8, 8], |end, pick| CREPE[pick % 8] >> (end % 8) & 1 == 1),
        Weave::Jersey => Relief::of([2, 2], loops),
        Weave::Pile => Relief::of([8, 8], fibres),
        Weave::Cord => Relief::of([8, 8], |x, y| {
            let across = (x as f64 + 0.5) / (8 * YARN) as f64;
            3.0 * libm::sin(std::f64::consts::PI * across) + 0.5 * fibres(x, y)
        }),
    }
}

/// Which end lies on top of which pick in a crepe, a bit for each end: no line of it can be followed.
const CREPE: [u8; 8] =
    [0b0101_1010, 0b1010_0101, 0b0011_1001, 0b1101_0110, 0b1010_1100, 0b0101_0011, 0b1100_1010, 0b0110_0101];

/// Heights of a weave, of which `warp_up` tells which yarn lies on top.
fn woven(yarns: [usize; 2], warp_up: impl Fn(usize, usize) -> bool) -> Relief {
    let up = |end: usize, pick: usize| warp_up(end % yarns[0], pick % yarns[1]);
    Relief::of(yarns, |x, y| {
        let (end, pick) = (x / YARN, y / YARN);
        let [across, along] = [x, y].map(|i| (2 * (i % YARN) + 1) as f64 / YARN as f64 - 1.0);
        let warp = up(end, pick);
        let (width, length) = if warp { (across, along) } else { (along, across) };
        // A yarn dives at the end of its float and stays up where the float goes on.
        let next = |forward: bool| {
            let step = |i: usize, n: usize| if forward { (i + 1) % n } else { (i + n - 1) % n };
            if warp { up(end, step(pick, yarns[1])) } else { !up(step(end, yarns[0]), pick) }
        };
        let fall = if next(length > 0.0) { 0.0 } else { length * length };
        libm::sqrt((1.0 - width * width).max(0.0)) - 0.6 * fall
    })
}

/// Loops of a plain knit: two legs that lean towards the middle of their wale.
fn loops(x: usize, y: usize) -> f64 {
    let wale = 2 * YARN;
    let across = (x % wale) as f64 / wale as f64;
    let lean = 0.5 * (across - 0.5).abs();
    let [row, leg] = [y as f64 / YARN as f64 - 2.0 * lean, 4.0 * (across % 0.5) - 1.0];
    let along = 2.0 * (row - row.floor()) - 1.0;
    0.7 * libm::sqrt((1.0 - leg * leg).max(0.0)) + 0.5 * libm::sqrt((1.0 - along * along).max(0.0))
}

/// Ends of fibres without an order that the eye could follow, the same everywhere.
fn fibres(x: usize, y: usize) -> f64 {
    let mut state = (x as u32).wrapping_mul(0x9e37_79b1) ^ (y as u32).wrapping_mul(0x85eb_ca77);
    for shift in [15, 13, 16] {
        state = (state ^ state >> shift).wrapping_mul(0x2c1b_3c6d);
    }
    f64::from(state >> 16) / 65_536.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Weave; 9] = [
        Weave::Plain,
        Weave::Basket,
        Weave::Twill,
        Weave::WarpTwill,
        Weave::Satin,
        Weave::Crepe,
        Weave::Jersey,
        Weave::Pile,
        Weave::Cord,
    ];

    fn look(weave: Weave) -> FabricLook {
        FabricLook { weave, ends: 3000.0, picks: 2400.0, color: [0.5; 3], sheen: 0.2, roughness: 0.8 }
    }

    #[test]
    fn every_weave_is_small_and_has_its_true_size() {
        for weave in ALL {
            let drawn = draw(&look(weave)).expect("drawn");
            assert_eq!(draw(&look(weave)), Some(drawn.clone()), "{weave:?} is drawn the same twice");
            let size = drawn.image.bytes.len() + drawn.normal.bytes.len();
            assert!(size < 24_000, "{weave:?} takes {size} bytes");
            let pixels = image::load_from_memory(&drawn.normal.bytes).expect("PNG").to_rgb8();
            assert_eq!((pixels.width(), pixels.height()), (drawn.normal.width, drawn.normal.height));
            let yarns = f64::from(drawn.image.width) / YARN as f64;
            assert!((drawn.repeat[0] * 3000.0 - yarns).abs() < 1e-9, "{weave:?}");
            let mean: [f64; 3] = std::array::from_fn(|c| {
                pixels.pixels().map(|p| f64::from(p.0[c]) / 127.5 - 1.0).sum::<f64>()
                    / f64::from(pixels.width() * pixels.height())
            });
            assert!(
                mean[0].abs() < 0.02 && mean[1].abs() < 0.02 && mean[2] > 0.4,
                "{weave:?} looks outwards: {mean:?}"
            );
        }
        assert_eq!(draw(&FabricLook { ends: 0.0, ..look(Weave::Plain) }), None);
    }

    /// A plain weave has as many warp as weft crossings on top; a warp twill three of four.
    #[test]
    fn a_twill_runs_on_a_diagonal() {
        let plain = relief(Weave::Plain);
        let twill = relief(Weave::Twill);
        let step = |r: &Relief, by: [usize; 2]| {
            let at = |x: usize, y: usize| r.heights[y % r.rows * r.columns + x % r.columns];
            (0..r.rows).all(|y| (0..r.columns).all(|x| (at(x, y) - at(x + by[0], y + by[1])).abs() < 1e-9))
        };
        assert!(step(&plain, [YARN, YARN]) && !step(&plain, [YARN, 0]));
        assert!(step(&twill, [YARN, twill.rows - YARN]) && !step(&twill, [YARN, YARN]));
    }
}
