//! The sheet as SVG in millimetres, one group per layer as drawing programs name them.

use super::{Layer, Sheet};
use crate::svg::canvas::{escape, fixed};
use std::fmt::Write as _;
use toile_garment::Vec2;

/// The drawing. One unit is one millimetre, and the page is as large as the sheet.
#[must_use]
pub fn svg(sheet: &Sheet, title: &str) -> String {
    let (w, h) = (fixed(sheet.size.x, 3), fixed(sheet.size.y, 3));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
         width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\">\n<title>{}</title>\n",
        escape(title)
    );
    for layer in Layer::ALL {
        let name = layer.name();
        let dashes: Vec<String> = layer.dashes().iter().map(|d| fixed(*d, 1)).collect();
        let dashes =
            if dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{}\"", dashes.join(" ")) };
        let _ = writeln!(
            out,
            "<g id=\"{name}\" inkscape:groupmode=\"layer\" inkscape:label=\"{name}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{dashes}>",
            color(layer),
            fixed(layer.width(), 2)
        );
        for stroke in sheet.on(layer) {
            let _ = writeln!(out, "<path d=\"{}\"/>", path(sheet, &stroke.points, stroke.closed));
        }
        if layer == Layer::Text {
            for letters in &sheet.letters {
                let rings: String = letters.iter().map(|r| path(sheet, r, true)).collect();
                let _ = writeln!(out, "<path d=\"{rings}\" fill=\"#333\" stroke=\"none\"/>");
            }
            for label in &sheet.labels {
                let _ = writeln!(
                    out,
                    "<text x=\"{}\" y=\"{}\" font-size=\"{}\" font-family=\"sans-serif\" text-anchor=\"middle\" fill=\"#333\" stroke=\"none\">{}</text>",
                    fixed(label.at.x, 3),
                    fixed(sheet.size.y - label.at.y, 3),
                    fixed(label.height, 2),
                    escape(&label.text)
                );
            }
        }
        out.push_str("</g>\n");
    }
    out.push_str("</svg>\n");
    out
}

fn path(sheet: &Sheet, points: &[Vec2], closed: bool) -> String {
    let mut d = String::new();
    for (k, p) in points.iter().enumerate() {
        let letter = if k == 0 { 'M' } else { 'L' };
        let _ = write!(d, "{letter}{} {}", fixed(p.x, 3), fixed(sheet.size.y - p.y, 3));
    }
    d + if closed { "Z" } else { "" }
}

fn color(layer: Layer) -> &'static str {
    match layer {
        Layer::Cut | Layer::Text => "#000",
        Layer::Sew => "#1a56b0",
        Layer::Internal => "#2c7a4b",
        Layer::Dart => "#c0261c",
        Layer::Notch => "#7a1fa2",
        Layer::Drill => "#b05a00",
        Layer::Grain => "#555",
    }
}
