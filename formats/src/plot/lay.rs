//! Pieces side by side on a sheet, with a square of known size to measure.

use super::strokes::{label, strokes};
use super::{Label, Layer, Letters, Stroke};
use crate::svg::canvas::Bounds;
use toile_garment::{Piece, Vec2};

/// Side of the square to measure, mm.
pub const SQUARE: f64 = 50.0;

/// A sheet, millimetres from its lower left corner, y upwards.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Width and height.
    pub size: Vec2,
    /// Lines.
    pub strokes: Vec<Stroke>,
    /// Texts.
    pub labels: Vec<Label>,
    /// Texts as outlines of their letters.
    pub letters: Vec<Letters>,
}

impl Sheet {
    /// The strokes of a layer.
    pub fn on(&self, layer: Layer) -> impl Iterator<Item = &Stroke> {
        self.strokes.iter().filter(move |s| s.layer == layer)
    }
}

/// Lays pieces on shelves, `gap` mm apart and from the edge. Without a width the sheet is about as wide as high.
#[must_use]
pub fn lay(pieces: &[Piece], gap: f64, width: Option<f64>) -> Sheet {
    let drawn: Vec<(Vec<Stroke>, Bounds, &Piece)> = pieces
        .iter()
        .filter_map(|p| {
            let strokes = strokes(p);
            let bounds = Bounds::of(strokes.iter().flat_map(|s| s.points.iter().copied()))?;
            Some((strokes, bounds, p))
        })
        .collect();
    let sizes = || drawn.iter().map(|d| d.1.size()).chain([Vec2::new(SQUARE, SQUARE)]);
    let area: f64 = sizes().map(|s| (s.x + gap) * (s.y + gap)).sum();
    let widest = sizes().map(|s| s.x).fold(0.0, f64::max) + 2.0 * gap;
    let width = width.unwrap_or(libm::sqrt(1.3 * area)).max(widest);
    let mut sheet = Sheet::default();
    // The square stands first, on the lowest shelf.
    let (mut corner, mut shelf) = (Vec2::new(gap, gap), 0.0_f64);
    let mut right = 0.0_f64;
    let mut place = |size: Vec2| {
        if corner.x > gap && corner.x + size.x + gap > width {
            corner = Vec2::new(gap, corner.y + shelf + gap);
            shelf = 0.0;
        }
        let at = corner;
        corner.x += size.x + gap;
        shelf = shelf.max(size.y);
        right = right.max(corner.x);
        (at, corner.y + shelf + gap, right)
    };
    let (at, mut top, _) = place(Vec2::new(SQUARE, SQUARE));
    square(&mut sheet, at);
    for (strokes, bounds, piece) in drawn {
        let size = bounds.size();
        let (at, height, _) = place(size);
        top = height;
        let by = at - bounds.min;
        sheet.labels.push(label(piece, at + size * 0.5, 0.8 * size.x));
        sheet.strokes.extend(strokes.into_iter().map(|mut s| {
            s.points.iter_mut().for_each(|p| *p += by);
            s
        }));
    }
    sheet.size = Vec2::new(right.min(width), top);
    sheet
}

fn square(sheet: &mut Sheet, at: Vec2) {
    let corner = |x: f64, y: f64| at + Vec2::new(x, y);
    let points = vec![at, corner(SQUARE, 0.0), corner(SQUARE, SQUARE), corner(0.0, SQUARE)];
    sheet.strokes.push(Stroke { layer: Layer::Text, points, closed: true });
    let text = format!("{SQUARE:.0} × {SQUARE:.0} mm");
    sheet.labels.push(Label { at: corner(0.5 * SQUARE, 0.5 * SQUARE), height: 4.0, text });
}
