//! Seams that sew two corners of one triangle to one point: no cloth can be that narrow.

use crate::sewing::sewn_points::SewnPoints;
use crate::sewing::shapes::mm;
use toile_garment::seam::Seam;
use toile_garment::{Diagnostic, Garment, Piece, Vec2};

/// A line ends at a mesh vertex within this, metres.
const AT_VERTEX: f64 = 1e-3;

/// One error for each piece with such a triangle. The usual cause is a dart that is neither found nor declared: seams
/// end at both of its mouth points, and the cloth between them goes nowhere.
pub fn check(garment: &Garment, seams: &[Seam]) -> Vec<Diagnostic> {
    let mut points = SewnPoints::new(garment, seams);
    garment.pieces.iter().filter_map(|piece| collapsed(piece, &mut points)).collect()
}

fn collapsed(piece: &Piece, points: &mut SewnPoints) -> Option<Diagnostic> {
    let rest = &piece.mesh.as_ref()?.rest;
    let [p, q] = points.collapsed_side(piece)?.map(|v| rest.get(v as usize).copied().unwrap_or_default());
    let message = format!(
        "piece `{}`: seams sew {} and {}, {:.1} mm apart, to one point, and nothing takes the cloth between them away",
        piece.name,
        mm(p),
        mm(q),
        (p - q).norm() * 1e3
    );
    let text = |p: Vec2| format!("[\"{:.3} mm\", \"{:.3} mm\"]", p.x * 1e3, p.y * 1e3);
    let apex = apex(piece, [p, q]).map_or_else(|| "[\"… mm\", \"… mm\"]".to_owned(), text);
    let hint = format!(
        "if a dart lies there, write in the sewing file:\n[[dart]]\npiece = \"{}\"\napex = {apex}\nmouth = [{}, {}]\n\
         else end both seams at one place",
        piece.name,
        text(p),
        text(q)
    );
    Some(Diagnostic::error(super::codes::SEAMS_CLOSE_CLOTH, message).at(piece.source.clone()).hint(hint))
}

/// The point where internal lines from both places meet: the end farthest away that lines from each have.
fn apex(piece: &Piece, mouth: [Vec2; 2]) -> Option<Vec2> {
    let ends = |m: Vec2| {
        let through = move |line: &Vec<Vec2>| line.iter().any(|p| (p - m).norm() <= AT_VERTEX);
        piece.internal_lines.iter().map(|l| l.positions()).filter(through).flatten()
    };
    let far = |p: &Vec2| mouth.iter().map(|m| (p - m).norm()).fold(f64::INFINITY, f64::min);
    let shared = |p: &Vec2| ends(mouth[1]).any(|q| (p - q).norm() <= AT_VERTEX);
    ends(mouth[0]).filter(shared).filter(|p| far(p) > AT_VERTEX).max_by(|a, b| far(a).total_cmp(&far(b)))
}
