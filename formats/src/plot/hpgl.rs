//! The sheet as HPGL for plotters: 40 units to the millimetre, one pen per layer.

use super::codes;
use super::{Layer, Sheet};
use crate::codes::TEXT_NOT_ASCII;
use std::fmt::Write as _;
use toile_garment::{Diagnostic, Vec2};

/// Plotter units per millimetre.
const UNITS: f64 = 40.0;
/// Largest coordinate, plotter units.
const MOST: f64 = 8_388_607.0;
/// Ends a label (ASCII ETX).
const END: char = '\u{3}';

/// The file. Labels are ASCII; other letters become `?`, with a finding.
///
/// # Errors
/// The sheet is larger than a plotter's numbers.
pub fn hpgl(sheet: &Sheet) -> Result<(String, Vec<Diagnostic>), Diagnostic> {
    if sheet.size.x.max(sheet.size.y) * UNITS > MOST {
        let text = format!("a sheet of {:.0} × {:.0} mm is larger than HPGL can say", sheet.size.x, sheet.size.y);
        return Err(Diagnostic::error(codes::SHEET_TOO_LARGE, text).hint("write fewer pieces, or give a width"));
    }
    let mut out = String::from("IN;\nPA;\n");
    let mut findings = Vec::new();
    for (pen, layer) in (1..).zip(Layer::ALL) {
        let labels = if layer == Layer::Text { sheet.labels.as_slice() } else { &[] };
        let letters = if layer == Layer::Text { sheet.letters.as_slice() } else { &[] };
        if labels.is_empty() && letters.is_empty() && sheet.on(layer).next().is_none() {
            continue;
        }
        let _ = writeln!(out, "SP{pen};");
        let strokes = sheet.on(layer).map(|s| (&s.points, s.closed));
        for (points, closed) in strokes.chain(letters.iter().flatten().map(|ring| (ring, true))) {
            let Some((first, rest)) = points.split_first() else { continue };
            let closing = closed.then_some(first);
            let line: Vec<String> = rest.iter().chain(closing).map(|p| xy(*p)).collect();
            let _ = writeln!(out, "PU{};PD{};", xy(*first), line.join(","));
        }
        for label in labels {
            let text: String = label.text.chars().map(|c| if c == '×' { 'x' } else { c }).collect();
            let plain: String = text.chars().map(|c| if (' '..='~').contains(&c) { c } else { '?' }).collect();
            if plain != text {
                let text = format!("the label `{}` is plotted as `{plain}`", label.text);
                findings.push(
                    Diagnostic::info(TEXT_NOT_ASCII, text)
                        .hint("HPGL holds 7-bit ASCII only; with a `font` its letters are drawn"),
                );
            }
            // Height of the letters in cm; a letter is as wide as two thirds of it.
            let height = label.height / 10.0;
            let start = label.at - Vec2::new(0.5 * plain.len() as f64 * label.height, 0.0);
            let _ = writeln!(out, "PU{};SI{:.3},{:.3};LB{plain}{END}", xy(start), height / 1.5, height);
        }
    }
    out.push_str("PU0,0;\nSP0;\n");
    Ok((out, findings))
}

fn xy(p: Vec2) -> String {
    let unit = |v: f64| (v * UNITS).round().clamp(-MOST, MOST) as i64;
    format!("{},{}", unit(p.x), unit(p.y))
}
