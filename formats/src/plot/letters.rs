//! Labels drawn as the outlines of a font's letters, for scripts a printer or plotter has no letters of.

use super::codes;
use super::{Label, Sheet};
use toile_garment::{Diagnostic, Vec2};
use ttf_parser::{Face, OutlineBuilder};

/// Chords of a curve of a letter.
const CHORDS: usize = 6;

/// The outlines of one label, mm: closed rings, filled by their winding.
pub type Letters = Vec<Vec<Vec2>>;

/// A TrueType or OpenType font.
pub struct Font<'a>(Face<'a>);

impl<'a> Font<'a> {
    /// Reads a font file, or the first font of a collection.
    ///
    /// # Errors
    /// The bytes are no font.
    pub fn read(bytes: &'a [u8], name: &str) -> Result<Self, Diagnostic> {
        Face::parse(bytes, 0).map(Self).map_err(|error| {
            let text = format!("`{name}` is no font that can be read: {error}");
            Diagnostic::error(codes::FONT_UNREADABLE, text).hint("give a TrueType or OpenType file (.ttf, .otf, .ttc)")
        })
    }

    /// The outlines of a label. `None` when the font has not all of its letters.
    fn letters(&self, label: &Label) -> Option<Letters> {
        let glyphs: Vec<_> = label.text.chars().map(|c| self.0.glyph_index(c)).collect::<Option<_>>()?;
        // A capital is as high as the label asks; without that measure it is some 0.7 of the em.
        let em = f64::from(self.0.units_per_em());
        let high = self.0.capital_height().map(f64::from).filter(|h| *h > 0.0).unwrap_or(0.7 * em);
        let scale = label.height / high;
        let step = |g| self.0.glyph_hor_advance(g).map_or(0.5 * em, f64::from) * scale;
        let width: f64 = glyphs.iter().map(|g| step(*g)).sum();
        let mut pen = Pen { at: label.at - Vec2::new(0.5 * width, 0.0), scale, rings: Vec::new() };
        for glyph in glyphs {
            self.0.outline_glyph(glyph, &mut pen);
            pen.at.x += step(glyph);
        }
        Some(pen.rings)
    }
}

/// Draws the labels with the letters of a font. Labels with letters it lacks stay texts, and are told.
pub fn spell(sheet: &mut Sheet, font: &Font<'_>) -> Vec<Diagnostic> {
    let mut findings = Vec::new();
    let labels = std::mem::take(&mut sheet.labels);
    for label in labels {
        if let Some(letters) = font.letters(&label) {
            sheet.letters.push(letters);
            continue;
        }
        let lacking = label.text.chars().filter(|c| font.0.glyph_index(*c).is_none()).collect::<String>();
        let text = format!("the font has no letters `{lacking}` of the label `{}`", label.text);
        findings.push(Diagnostic::info(codes::TEXT_NOT_IN_FONT, text).hint("give a `font` that has them"));
        sheet.labels.push(label);
    }
    findings
}

/// Collects the rings of letters, in units of the font, at a place.
struct Pen {
    at: Vec2,
    scale: f64,
    rings: Letters,
}

impl Pen {
    fn to(&self, x: f32, y: f32) -> Vec2 {
        self.at + Vec2::new(f64::from(x), f64::from(y)) * self.scale
    }

    fn ring(&mut self) -> (&mut Vec<Vec2>, Vec2) {
        if self.rings.is_empty() {
            self.rings.push(vec![self.at]);
        }
        let last = self.rings.len() - 1;
        let ring = &mut self.rings[last];
        let from = ring.last().copied().unwrap_or(self.at);
        (ring, from)
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let p = self.to(x, y);
        self.rings.push(vec![p]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let p = self.to(x, y);
        self.ring().0.push(p);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (b, c) = (self.to(x1, y1), self.to(x, y));
        let (ring, a) = self.ring();
        ring.extend((1..=CHORDS).map(|k| {
            let t = k as f64 / CHORDS as f64;
            let s = 1.0 - t;
            a * (s * s) + b * (2.0 * s * t) + c * (t * t)
        }));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (b, c, d) = (self.to(x1, y1), self.to(x2, y2), self.to(x, y));
        let (ring, a) = self.ring();
        ring.extend((1..=CHORDS).map(|k| {
            let t = k as f64 / CHORDS as f64;
            let s = 1.0 - t;
            a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
        }));
    }

    /// The way back to the first point needs no point of its own.
    fn close(&mut self) {
        if let Some(ring) = self.rings.last_mut().filter(|r| r.len() > 1 && r.first() == r.last()) {
            ring.pop();
        }
    }
}
