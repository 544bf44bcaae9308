//! The outlines of a garment, cut at the marks that count.

use super::atoms::Layout;
use super::cuts::{Outline, without_alone, without_unpaired};
use super::missing::missing_marks;
use crate::roles::Upright;
use crate::roles::outline::turned;
use crate::sewing::shapes::Shapes;
use toile_garment::{Garment, Piece, Vec2};

/// The outlines, cut at all marks that are drawn. Pieces in `left_out` get no panel.
pub fn drawn(garment: &Garment, shapes: &Shapes, left_out: &[String]) -> Layout {
    Layout::of(&outlines(garment, shapes, left_out))
}

/// The same, cut at the marks that both sides of a seam have or need.
pub fn marked(garment: &Garment, shapes: &Shapes, left_out: &[String]) -> Layout {
    let mut outlines = outlines(garment, shapes, left_out);
    without_unpaired(&mut outlines);
    without_alone(&mut outlines);
    let layout = Layout::of(&outlines);
    let missing = missing_marks(&layout);
    missing.iter().for_each(|(panel, at)| outlines[*panel].mark(*at));
    if missing.is_empty() { layout } else { Layout::of(&outlines) }
}

fn outlines<'a>(garment: &'a Garment, shapes: &'a Shapes, left_out: &[String]) -> Vec<Outline<'a>> {
    let is_sewn = |piece: &Piece| !left_out.iter().any(|n| n.eq_ignore_ascii_case(&piece.name));
    let all = garment.pieces.iter().zip(shapes).enumerate();
    let sewn = all.filter(|(_, (piece, shape))| is_sewn(piece) && !shape.rings.is_empty());
    let turns = Upright::of(&garment.pieces, &[]).turns;
    let up = |index: usize| turned(Vec2::y(), -turns[index]);
    sewn.map(|(index, (piece, shape))| Outline::new(index, piece, shape, up(index))).collect()
}
