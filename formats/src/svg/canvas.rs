//! A small SVG writer: millimetres, +y up, fixed decimals.

use std::fmt::Write as _;
use toile_garment::Vec2;

/// Text made safe for SVG and HTML.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' | '\t' => out.push(' '),
            c if (c as u32) < 0x20 || (0x7f..0xa0).contains(&(c as u32)) || matches!(c, '\u{fffe}' | '\u{ffff}') => {
                out.push('\u{fffd}');
            }
            c if toile_garment::text::steers(c) => out.extend(c.escape_default()),
            c => out.push(c),
        }
    }
    out
}

/// A number with fixed decimals, never `-0.00`; `-` when it is not finite.
#[must_use]
pub fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let text = format!("{value:.decimals$}");
    let zero = text.trim_start_matches('-').bytes().all(|b| b == b'0' || b == b'.');
    if zero { text.trim_start_matches('-').to_owned() } else { text }
}

/// A rectangle that grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower left.
    pub min: Vec2,
    /// Upper right.
    pub max: Vec2,
}

impl Bounds {
    /// Around points in millimetres; `None` without a finite point.
    #[must_use]
    pub fn of(points: impl IntoIterator<Item = Vec2>) -> Option<Self> {
        points.into_iter().filter(|p| p.x.is_finite() && p.y.is_finite()).fold(None, |b: Option<Self>, p| {
            Some(b.map_or(Self { min: p, max: p }, |b| Self { min: b.min.inf(&p), max: b.max.sup(&p) }))
        })
    }

    /// Width and height.
    #[must_use]
    pub fn size(&self) -> Vec2 {
        self.max - self.min
    }

    /// Grown by a margin on all sides.
    #[must_use]
    pub fn grown(&self, by: f64) -> Self {
        Self { min: self.min.add_scalar(-by), max: self.max.add_scalar(by) }
    }
}

/// SVG elements in a plane of millimetres with +y up.
#[derive(Clone, Debug, Default)]
pub struct Canvas {
    body: String,
}

impl Canvas {
    /// Begins a group that a page can pick by this name.
    pub fn open(&mut self, pick: &str) {
        let _ = writeln!(self.body, r#"<g data-pick="{}">"#, escape(pick));
    }

    /// Begins a group of a style that a page can pick by this name.
    pub fn open_as(&mut self, pick: &str, class: &str) {
        let _ = writeln!(self.body, r#"<g data-pick="{}" class="{class}">"#, escape(pick));
    }

    /// Ends the group.
    pub fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// A line through points; `class` names its style.
    pub fn line(&mut self, class: &str, points: &[Vec2], closed: bool) {
        if points.len() >= 2 {
            let end = if closed { "Z" } else { "" };
            let _ = writeln!(self.body, r#"<path class="{class}" d="{}{end}"/>"#, path(points));
        }
    }

    /// Many closed shapes of one fill colour.
    pub fn shapes(&mut self, class: &str, fill: &str, shapes: &[[Vec2; 3]]) {
        let d: String = shapes.iter().map(|t| path(t) + "Z").collect();
        let _ = writeln!(self.body, r#"<path class="{class}" style="fill:{fill};stroke:{fill}" d="{d}"/>"#);
    }

    /// A dot.
    pub fn dot(&mut self, class: &str, at: Vec2, radius: f64) {
        let (x, y, r) = (fixed(at.x, 2), fixed(-at.y, 2), fixed(radius, 2));
        let _ = writeln!(self.body, r#"<circle class="{class}" cx="{x}" cy="{y}" r="{r}"/>"#);
    }

    /// A filled rectangle from its lower left corner.
    pub fn rect(&mut self, class: &str, fill: &str, at: Vec2, size: Vec2) {
        let _ = writeln!(
            self.body,
            r#"<rect class="{class}" fill="{fill}" x="{}" y="{}" width="{}" height="{}"/>"#,
            fixed(at.x, 2),
            fixed(-at.y - size.y, 2),
            fixed(size.x, 2),
            fixed(size.y, 2)
        );
    }

    /// A text, centred at `at`, `size` high. The text is escaped here.
    pub fn text(&mut self, class: &str, at: Vec2, size: f64, text: &str) {
        let _ = writeln!(
            self.body,
            r#"<text class="{class}" x="{}" y="{}" font-size="{}">{}</text>"#,
            fixed(at.x, 2),
            fixed(-at.y + 0.35 * size, 2),
            fixed(size, 2),
            escape(text)
        );
    }

    /// A scale bar of a round length that fits `room`, with its label.
    pub fn scale_bar(&mut self, at: Vec2, room: f64, size: f64) {
        let length = [1000.0, 500.0, 200.0, 100.0, 50.0, 20.0, 10.0].into_iter().find(|l| *l <= room).unwrap_or(5.0);
        let up = Vec2::new(0.0, 0.4 * size);
        let end = at + Vec2::new(length, 0.0);
        self.line("scale", &[at + up, at - up, at, end, end + up, end - up], false);
        self.text("label", at + Vec2::new(0.5 * length, 1.1 * size), size, &format!("{length:.0} mm"));
    }

    /// The whole drawing.
    #[must_use]
    pub fn finish(self, bounds: Bounds, title: &str, style: &str) -> String {
        let size = bounds.size();
        let (x, y) = (fixed(bounds.min.x, 2), fixed(-bounds.max.y, 2));
        let (w, h) = (fixed(size.x.max(1.0), 2), fixed(size.y.max(1.0), 2));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{x} {y} {w} {h}\" role=\"img\">\n\
             <title>{}</title>\n<style>{style}</style>\n{}</svg>\n",
            escape(title),
            self.body
        )
    }
}

fn path(points: &[Vec2]) -> String {
    let mut d = String::new();
    for (k, p) in points.iter().enumerate() {
        let letter = if k == 0 { "M" } else { "L" };
        let _ = write!(d, "{letter}{} {}", fixed(p.x, 2), fixed(-p.y, 2));
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_stable_and_text_is_safe() {
        assert_eq!(fixed(-0.001, 2), "0.00");
        assert_eq!(fixed(-1.5, 1), "-1.5");
        assert_eq!(fixed(f64::NAN, 2), "-");
        assert_eq!(escape("<a href='x'>&\"\u{1}"), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;\u{fffd}");
        assert_eq!(escape("a\u{202e}b"), "a\\u{202e}b");
    }

    #[test]
    fn y_is_up() {
        let mut c = Canvas::default();
        c.line("cut", &[Vec2::new(0.0, 0.0), Vec2::new(10.0, 20.0)], false);
        let svg = c.finish(Bounds { min: Vec2::zeros(), max: Vec2::new(10.0, 20.0) }, "t", "");
        assert!(svg.contains("M0.00 0.00L10.00 -20.00") && svg.contains("viewBox=\"0.00 -20.00 10.00 20.00\""));
    }
}
