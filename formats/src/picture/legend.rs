//! The colours of a quantity with their values, under a picture.

use super::field::{Field, Scale};
use super::letters::{spell, width};
use super::raster::{Canvas, PAPER};

const INK: [f64; 3] = [0.12, 0.12, 0.12];

/// Height of the legend for a picture of some width, pixels.
#[must_use]
pub fn height(picture: usize) -> usize {
    (letter(picture) * 6.4) as usize
}

fn letter(picture: usize) -> f64 {
    (picture as f64 / 42.0).clamp(8.0, 20.0)
}

/// The legend as a picture of its own.
#[must_use]
pub fn legend(field: &Field, picture: usize) -> Canvas {
    let (size, rows) = (letter(picture), height(picture));
    let mut canvas = Canvas { width: picture, height: rows, pixels: vec![PAPER; picture * rows] };
    let (left, wide) = (picture / 8, picture - 2 * (picture / 8));
    let (top, tall) = ((2.4 * size) as usize, (1.2 * size) as usize);
    let [low, high] = field.ends();
    for x in 0..wide {
        let value = low + (high - low) * x as f64 / (wide.max(2) - 1) as f64;
        canvas.fill([left + x, top], [1, tall], field.colour(value));
    }
    let title = format!("{}, {}", field.name, field.unit);
    let mut words = spell(&title, [left as f64, 1.7 * size], size);
    for k in 0..=4 {
        let share = f64::from(k) / 4.0;
        let text = mark(field, low + (high - low) * share, k);
        let x = left as f64 + share * wide as f64;
        words.extend(spell(&text, [x - 0.5 * width(&text, size), top as f64 + 2.9 * size], size));
    }
    canvas.strokes(&words, (0.13 * size).max(1.2), INK);
    canvas
}

/// A value beside the colours; the end stands for all that is beyond.
fn mark(field: &Field, value: f64, k: i32) -> String {
    let text = crate::svg::canvas::fixed(value, 2);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match (field.scale, k) {
        (Scale::Signed, 3 | 4) => format!("+{text}"),
        (Scale::FromZero, 4) => format!("≥{text}"),
        _ => text.to_owned(),
    }
}
