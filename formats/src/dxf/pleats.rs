//! Pleats and dart-pleats: pairs of fold lines that run in from the edge and do not meet. They are told, not made: how
//! deep a pleat is sewn and to which side it lies stands in no DXF.

use super::chain::Path;
use super::geom;
use super::notches::DrawnNotch;
use toile_garment::Vec2;

/// Ends of fold lines lie on the outline within this, mm.
const ON_OUTLINE: f64 = 1.0;
/// Distance of the two lines at the edge, mm.
const MOUTH: std::ops::RangeInclusive<f64> = 5.0..=120.0;
/// Length of a fold line, mm.
const LENGTH: std::ops::RangeInclusive<f64> = 20.0..=1500.0;
/// Lines that converge less are a pleat, more a dart-pleat, degrees.
const PARALLEL: f64 = 2.0;
/// Lines that converge more are neither, degrees.
const CONVERGE: f64 = 40.0;
/// A notch marks the end of a line within this, mm.
const NOTCHED: f64 = 3.0;
/// Most lines that are paired.
const LINES: usize = 200;

/// A pair of fold lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Pleat {
    /// The lines, each from the edge inwards.
    pub lines: [[Vec2; 2]; 2],
    /// Do they converge (a dart-pleat)?
    pub converging: bool,
    /// Distance of the lines at the edge, mm.
    pub width: f64,
    /// 0 to 1.
    pub confidence: f64,
    /// What speaks for it.
    pub evidence: Vec<&'static str>,
    /// Line in the file.
    pub line: u64,
}

/// All pairs among the internal lines that have a notch or a word of the trade beside them.
#[must_use]
pub fn find(internal: &[&Path], outline: &[Vec2], notches: &[DrawnNotch], texts: &[(Vec2, String)]) -> Vec<Pleat> {
    let lines: Vec<([Vec2; 2], &Path)> = internal.iter().take(LINES).filter_map(|p| fold_line(p, outline)).collect();
    let mut found: Vec<Pleat> = Vec::new();
    let mut used = vec![false; lines.len()];
    for i in 0..lines.len() {
        let partner = (i + 1..lines.len())
            .filter(|j| !used[*j] && !used[i])
            .filter_map(|j| pair(&lines[i], &lines[j], notches, texts).map(|p| (j, p)))
            .min_by(|a, b| a.1.width.total_cmp(&b.1.width));
        if let Some((j, pleat)) = partner {
            (used[i], used[j]) = (true, true);
            found.push(pleat);
        }
    }
    found
}

/// A straight open line with one end on the outline: from there inwards.
fn fold_line<'a>(path: &'a Path, outline: &[Vec2]) -> Option<([Vec2; 2], &'a Path)> {
    let points = path.positions();
    let (first, last) = (*points.first()?, *points.last()?);
    let chord = (last - first).norm();
    if path.closed || !LENGTH.contains(&chord) || geom::length(&points, false) > 1.02 * chord {
        return None;
    }
    let on = [first, last].map(|p| geom::distance(p, outline, true) <= ON_OUTLINE);
    match on {
        [true, false] if geom::inside(last, outline) => Some(([first, last], path)),
        [false, true] if geom::inside(first, outline) => Some(([last, first], path)),
        _ => None,
    }
}

fn pair(
    a: &([Vec2; 2], &Path),
    b: &([Vec2; 2], &Path),
    notches: &[DrawnNotch],
    texts: &[(Vec2, String)],
) -> Option<Pleat> {
    let ([a0, a1], [b0, b1]) = (a.0, b.0);
    let (u, v) = (a1 - a0, b1 - b0);
    let width = (b0 - a0).norm();
    let angle = geom::angle(u, v);
    let (short, long) = (u.norm().min(v.norm()), u.norm().max(v.norm()));
    let inner = (b1 - a1).norm();
    let square = ((b0 - a0).dot(&u).abs() / (width * u.norm()).max(1e-9)) < 0.5;
    if !MOUTH.contains(&width) || angle > CONVERGE || short < 0.9 * long || inner > width * 1.1 || !square {
        return None;
    }
    let mut evidence = vec!["two lines of like length run in from the edge side by side"];
    let mut confidence = 0.4_f64;
    let notched = [a0, b0].map(|p| notches.iter().any(|n| (n.at - p).norm() <= NOTCHED));
    if notched == [true, true] {
        evidence.push("a notch at the end of each");
        confidence += 0.35;
    }
    const WORDS: [&str; 8] = ["pleat", "plait", "tuck", "falte", "pli ", "plissee", "piega", "褶"];
    let middle = (a0 + a1 + b0 + b1) * 0.25;
    let said = texts.iter().any(|(at, text)| {
        let text = text.to_lowercase();
        (at - middle).norm() <= long && WORDS.iter().any(|w| text.contains(w))
    });
    if said {
        evidence.push("a text beside it says so");
        confidence += 0.2;
    }
    // Side by side alone is a pocket or a stitch line as well.
    (evidence.len() > 1).then_some(Pleat {
        lines: [a.0, b.0],
        converging: angle > PARALLEL,
        width,
        confidence,
        evidence,
        line: a.1.line,
    })
}
