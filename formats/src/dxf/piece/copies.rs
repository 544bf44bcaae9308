//! Lines on the layers of dense copies (85 to 87) that copy nothing.

use super::codes;
use super::{Desk, DrawnPiece, mm};
use crate::dxf::chain::Path;
use crate::dxf::geom;
use std::collections::BTreeMap;
use toile_garment::{Diagnostic, Vec2};

/// A copy lies this near to the line that it copies, mm. Chords of few points leave a curve by some millimetres.
const COPIES: f64 = 5.0;
/// Places of a copy that are looked at.
const PLACES: usize = 50;

impl DrawnPiece {
    /// Says which lines on the layers of dense copies have no original in the piece: they are left out.
    pub(super) fn say_copies_of_nothing(&self, copies: &[(String, Path)], desk: &mut Desk<'_>) {
        let originals = if copies.is_empty() { Vec::new() } else { self.originals() };
        let has_original = |path: &Path| {
            let places = path.points.iter().step_by(path.points.len() / PLACES + 1);
            let near = |p: Vec2| originals.iter().any(|(line, closed)| geom::distance(p, line, *closed) <= COPIES);
            places.into_iter().all(|p| near(p.0))
        };
        let mut alone: BTreeMap<&str, Vec<Vec2>> = BTreeMap::new();
        for (layer, path) in copies.iter().filter(|(_, path)| !has_original(path)) {
            alone.entry(layer.trim()).or_default().extend(path.points.first().map(|p| p.0));
        }
        if let Some(sew) = self.unfinished.dense_sew.as_ref().filter(|_| self.sew.is_none()) {
            alone.entry("87").or_default().extend(sew.drawn.first().map(|n| n.at));
        }
        for (layer, places) in alone {
            self.say_copy(layer, &places, desk);
        }
    }

    /// All lines of the piece that can be copied, and whether they are closed.
    fn originals(&self) -> Vec<(Vec<Vec2>, bool)> {
        let closed = std::iter::once(&self.boundary).chain(&self.sew).map(|o| (o.positions(), true));
        let inside = self.inside.internal.iter().chain(&self.inside.cutouts);
        let inside = inside.chain(self.inside.stripes.iter().map(|s| &s.1));
        closed.chain(inside.map(|p| (p.positions(), p.closed))).collect()
    }

    fn say_copy(&self, layer: &str, places: &[Vec2], desk: &mut Desk<'_>) {
        let original = match layer {
            "87" => "14",
            "86" => "11",
            _ => "8",
        };
        let text = format!(
            "{} line(s) on layer {layer} of `{}`, for dense copies of layer {original}, copy no line of the piece, the first at {}; left out",
            places.len(),
            self.label(),
            places.first().map_or_else(String::new, |p| mm(*p))
        );
        let hint = format!(
            "if they are lines of their own, draw them on layer {original}, or map it: layers = {{ \"{layer}\" = \"{original}\" }}"
        );
        let finding = Diagnostic::warning(codes::COPY_WITHOUT_ORIGINAL, text).hint(hint);
        desk.say(finding, &self.block, layer, self.line);
    }
}
