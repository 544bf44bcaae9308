//! Marks of vertices and keys of texts, as the file has them.

use crate::compare::Difference;
use toile_formats::dxf::Pattern;
use toile_formats::dxf::piece::DrawnPiece;
use toile_garment::Vec2;

/// A point that comes back lies this near, mm.
const SAME: f64 = 0.001;
/// A point says the kind of a vertex within this, mm.
const AT: f64 = 0.05;

/// Points of layers 2 and 3, and texts with keys, that do not come back.
pub fn lost(first: &Pattern, second: &Pattern, size: Option<&str>) -> Vec<Difference> {
    let in_size = |p: &&DrawnPiece| p.size.is_none() || size.is_none() || p.size.as_deref() == size;
    let mut out = Vec::new();
    let mut taken = vec![false; second.pieces.len()];
    for piece in first.pieces.iter().filter(in_size) {
        let twin = (0..taken.len()).find(|i| !taken[*i] && second.pieces[*i].name.as_deref() == Some(piece.label()));
        let Some(twin) = twin else { continue };
        taken[twin] = true;
        let twin = &second.pieces[twin];
        let gone = |a: &[Vec2], b: &[Vec2]| {
            a.iter().filter(|p| b.iter().all(|q| (*p - q).norm() > SAME)).copied().collect::<Vec<_>>()
        };
        // Ends of the grain line and of the fold, and drill holes, stand in the line or the hole itself.
        let axes = [piece.axes.grain, piece.axes.fold, piece.axes.reference];
        let themselves = axes.into_iter().flatten().flatten().chain(piece.inside.drills.iter().map(|d| d.at));
        let there: Vec<Vec2> = twin.points.turn_list.iter().copied().chain(themselves).collect();
        // A point says the kind of the vertices around it: where another point stands beside it, that one does.
        let marks = &twin.points;
        let beside = |p: &Vec2| marks.turn_list.iter().chain(&marks.curve_list).any(|q| (p - q).norm() <= AT);
        let turns: Vec<Vec2> = gone(&piece.points.turn_list, &there).into_iter().filter(|p| !beside(p)).collect();
        if let Some(at) = turns.first() {
            let text = format!("{} of {}, the first at {at:?}", turns.len(), piece.points.turn_list.len());
            out.push(Difference::new("turn points", piece.label(), text));
        }
        let curves = gone(&piece.points.curve_list, &twin.points.curve_list);
        if let Some(at) = curves.first() {
            let text = format!("{} of {}, the first at {at:?}", curves.len(), piece.points.curve_list.len());
            out.push(Difference::new("curve points", piece.label(), text));
        }
        for (key, value) in piece.texts.keys.iter().filter(|(_, value)| !value.is_empty()) {
            let key = if key == "fabric" { "material" } else { key };
            if twin.texts.keys.get(key) != Some(value) {
                out.push(Difference::new("keys", piece.label(), format!("{key}: {value}")));
            }
        }
    }
    out
}
