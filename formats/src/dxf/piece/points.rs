//! Points of layers 2 and 3 that lie on no line of their block.

use super::codes;
use super::{Desk, DrawnPiece, mm};
use crate::dxf::geom::PointIndex;
use crate::dxf::sheet::Sheet;
use toile_garment::{Diagnostic, Vec2};

/// A point classifies a vertex within this, mm.
const AT: f64 = 0.05;

/// Points of layers 2 and 3 classify vertices: where few of them stand at one, they are something else.
pub(super) fn check(block: &str, line: u64, sheet: &Sheet, desk: &mut Desk<'_>) {
    let (met, all) = at_vertices(sheet);
    if all == 0 || met * 2 >= all {
        return;
    }
    let text = format!("{} of the {all} points on layers 2 and 3 of block `{block}` stand at no vertex", all - met);
    let hint = "other programs put drill holes on 2 and notches on 3; then map them: layers = { \"2\" = \"13\", \"3\" = \"4\" }";
    desk.say(Diagnostic::warning(codes::POINTS_OFF_VERTICES, text).hint(hint), block, "2", line);
}

/// How many of the points of layers 2 and 3 stand at a vertex of a line, and how many there are.
fn at_vertices(sheet: &Sheet) -> (usize, usize) {
    let points: Vec<Vec2> = sheet.turn.iter().chain(&sheet.curve).copied().collect();
    if points.is_empty() {
        return (0, 0);
    }
    let index = PointIndex::new(AT, points.iter().enumerate().map(|(i, p)| (*p, i)));
    let mut met = vec![false; points.len()];
    let mut look = |p: Vec2| {
        if index.has(p, AT) {
            index.near(p, AT).into_iter().for_each(|(_, i)| met[i] = true);
        }
    };
    let lines = [&sheet.boundary, &sheet.dense, &sheet.sew, &sheet.dense_sew, &sheet.internal, &sheet.cutouts];
    let paths = lines.into_iter().flatten().chain(sheet.stripes.iter().map(|s| &s.1));
    paths.flat_map(|p| &p.points).for_each(|p| look(p.0));
    let strokes = [&sheet.axes.reference, &sheet.axes.mirror, &sheet.axes.grain, &sheet.notch_strokes];
    strokes.into_iter().flatten().flat_map(|s| s.ends).for_each(look);
    (met.iter().filter(|m| **m).count(), points.len())
}

impl DrawnPiece {
    /// Curve points classify vertices of the lines that are kept, unless a turn point does. Others have no meaning here
    /// and are not written again.
    pub(super) fn say_unused_curve_points(&self, desk: &mut Desk<'_>) {
        let outlines = std::iter::once(&self.boundary).chain(&self.sew).flat_map(|o| o.drawn.iter().map(|n| n.at));
        let inner = self.inside.internal.iter().chain(&self.inside.cutouts);
        let inner = inner.chain(self.inside.stripes.iter().map(|s| &s.1)).flat_map(|p| p.points.iter().map(|q| q.0));
        let kept = PointIndex::new(AT, outlines.chain(inner).enumerate().map(|(i, p)| (p, i)));
        let turns = PointIndex::new(AT, self.points.turn_list.iter().enumerate().map(|(i, p)| (*p, i)));
        let is_unused = |p: &&Vec2| !kept.has(**p, AT) || turns.has(**p, AT);
        let unused: Vec<&Vec2> = self.points.curve_list.iter().filter(is_unused).collect();
        let Some(first) = unused.first() else { return };
        let text = format!(
            "{} of the {} curve points of `{}` stand at no vertex of a line that is kept, or where a turn point \
             stands, the first at {}; they are not used and not written again",
            unused.len(),
            self.points.curve_list.len(),
            self.label(),
            mm(**first)
        );
        let hint = "such points often belong to the dense copy of an outline (layer 84 or 87)";
        desk.say(Diagnostic::info(codes::CURVE_POINTS_UNUSED, text).hint(hint), &self.block, "3", self.line);
    }
}
