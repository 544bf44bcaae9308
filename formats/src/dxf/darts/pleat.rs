//! Pleats and dart-pleats: pairs of fold lines that run in from the edge and do not meet. They are told, not made: how
//! deep a pleat is sewn and to which side it lies stands in no DXF.

use super::codes;
use super::thresholds::{
    ANGLE_OF_DART_PLEAT, ANGLE_OF_PLEAT, BOW_OF_PLEAT, CONFIDENCE_OF_PLEAT, CONFIDENCE_OF_PLEAT_NOTCHES,
    CONFIDENCE_OF_PLEAT_WORD, COSINE_OF_PLEAT, COUNT_OF_PLEAT_LINES, DISTANCE_OF_PLEAT_END, DISTANCE_OF_PLEAT_NOTCH,
    LENGTH_OF_PLEAT, RATIO_OF_PLEAT_LINES, SPREAD_OF_PLEAT, WIDTH_OF_PLEAT,
};
use crate::dxf::chain::Path;
use crate::dxf::desk::Desk;
use crate::dxf::geom;
use crate::dxf::notches::DrawnNotch;
use crate::dxf::piece::{DrawnPiece, mm};
use toile_garment::{Diagnostic, Vec2};

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
    /// Reasons that speak for it.
    pub evidence: Vec<&'static str>,
    /// Line in the file.
    pub line: u64,
}

impl DrawnPiece {
    /// Tells the pairs of fold lines among the internal lines that are no legs.
    pub(super) fn find_pleats(&mut self, line: &[Vec2], desk: &mut Desk<'_>) {
        let legs = |p: &&Path| self.darts.iter().any(|d| d.ids.iter().any(|id| p.ids.contains(id)));
        let free: Vec<&Path> = self.inside.internal.iter().filter(|p| !legs(p)).collect();
        let texts: Vec<(Vec2, String)> = self.texts.others.iter().map(|(at, _, text)| (*at, text.clone())).collect();
        self.doubts.pleats = find(&free, line, &self.notches, &texts);
        for pleat in &self.doubts.pleats {
            let [a, b] = pleat.lines.map(|l| mm(l[0]));
            let what = if pleat.converging { "dart-pleat" } else { "pleat" };
            let text = format!(
                "the lines from {a} and {b} of `{}`, {:.1} mm apart, look like a {what} ({}); it was not made one",
                self.label(),
                pleat.width,
                pleat.evidence.join(", ")
            );
            let hint = "declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"pleat\"";
            desk.say(Diagnostic::info(codes::PLEAT_CANDIDATE, text).hint(hint), &self.block, "8", pleat.line);
        }
    }
}

/// All pairs among the internal lines that have a notch or a word of the trade beside them.
fn find(internal: &[&Path], outline: &[Vec2], notches: &[DrawnNotch], texts: &[(Vec2, String)]) -> Vec<Pleat> {
    let lines: Vec<([Vec2; 2], &Path)> =
        internal.iter().take(COUNT_OF_PLEAT_LINES).filter_map(|p| fold_line(p, outline)).collect();
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
    if path.closed || !LENGTH_OF_PLEAT.contains(&chord) || geom::length(&points, false) > BOW_OF_PLEAT * chord {
        return None;
    }
    let on = [first, last].map(|p| geom::distance(p, outline, true) <= DISTANCE_OF_PLEAT_END);
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
    let square = ((b0 - a0).dot(&u).abs() / (width * u.norm()).max(1e-9)) < COSINE_OF_PLEAT;
    if !WIDTH_OF_PLEAT.contains(&width)
        || angle > ANGLE_OF_DART_PLEAT
        || short < RATIO_OF_PLEAT_LINES * long
        || inner > width * SPREAD_OF_PLEAT
        || !square
    {
        return None;
    }
    let mut evidence = vec!["two lines of like length run in from the edge side by side"];
    let mut confidence = CONFIDENCE_OF_PLEAT;
    let notched = [a0, b0].map(|p| notches.iter().any(|n| (n.at - p).norm() <= DISTANCE_OF_PLEAT_NOTCH));
    if notched == [true, true] {
        evidence.push("a notch at the end of each");
        confidence += CONFIDENCE_OF_PLEAT_NOTCHES;
    }
    const WORDS: [&str; 8] = ["pleat", "plait", "tuck", "falte", "pli ", "plissee", "piega", "褶"];
    let middle = (a0 + a1 + b0 + b1) * 0.25;
    let said = texts.iter().any(|(at, text)| {
        let text = text.to_lowercase();
        (at - middle).norm() <= long && WORDS.iter().any(|w| text.contains(w))
    });
    if said {
        evidence.push("a text beside it says so");
        confidence += CONFIDENCE_OF_PLEAT_WORD;
    }
    // Side by side alone is a pocket or a stitch line as well.
    (evidence.len() > 1).then_some(Pleat {
        lines: [a.0, b.0],
        converging: angle > ANGLE_OF_PLEAT,
        width,
        confidence,
        evidence,
        line: a.1.line,
    })
}
