//! The point of a dart moved.

use super::build::{ALLOWANCE, Altered, Gone, Part};
use super::contour::{Contour, Vertex};
use super::marks::Region;
use super::motion::Motion;
use super::params::MovePoint;
use super::pivot::{LEGS_DIFFER, wedge};
use super::{ALTER_DART, ALTER_LEGS_DIFFER, ALTER_LINE_LEAVES_PIECE, spot};
use crate::sewing::shapes::{Shapes, mm};
use toile_formats::dxf::geom::inside;
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Garment, PieceId, Vec2};

/// Moves the point of a wedge dart. Its mouth stays, and its legs become straight.
pub fn point(garment: &Garment, shapes: &Shapes, id: PieceId, p: &MovePoint) -> Result<Altered, Diagnostic> {
    let piece = &garment.pieces[id.index()];
    let ring = &shapes[id.index()].rings[0];
    let (number, dart, gap) = spot::wedge(garment, shapes, id, &p.dart)?;
    let to = spot::point(garment, shapes, id, &p.to)?;
    let contour = Contour::of(piece, ring);
    let Some([first, _, second]) = contour.dart(ring, gap) else {
        return Err(Diagnostic::error(ALTER_DART, format!("dart `{}` is not on the outline of its piece", p.dart)));
    };
    let mouth = [first, second].map(|k| contour.vertices[k].at);
    let mut vertices = contour.chain(second, first);
    vertices.push(Vertex::new(to, PointKind::Turn));
    // The outline begins where it began, so that its edges keep their numbers.
    let start = vertices.iter().position(|v| v.at == contour.vertices[0].at).unwrap_or(0);
    vertices.rotate_left(start);
    let outline = Contour { vertices };
    let filled: Vec<Vec2> = contour.chain(second, first).iter().map(|v| v.at).collect();
    if !inside(to, &filled) || outline.crossing().is_some() {
        let message = format!("the point of dart `{}` cannot lie at {} on piece `{}`", p.dart, mm(to), piece.name);
        return Err(Diagnostic::error(ALTER_LINE_LEAVES_PIECE, message).hint("both legs must run inside the piece"));
    }
    let apart = ((mouth[0] - to).norm() - (mouth[1] - to).norm()).abs();
    let differ = (apart > LEGS_DIFFER).then(|| {
        let message =
            format!("the legs of dart `{}` of piece `{}` differ by {:.1} mm now", p.dart, piece.name, 1e3 * apart);
        Diagnostic::warning(ALTER_LEGS_DIFFER, message)
            .hint("move the point along the middle of the dart, or `pivot` the dart to a mouth that fits")
    });
    let darts = vec![wedge(dart, dart.name.clone(), mouth, to)];
    Ok(Altered {
        parts: vec![Part { name: piece.name.clone(), contour: outline, darts, notches: Vec::new(), holes: Vec::new() }],
        regions: vec![Region { polygon: contour.points(), motion: Motion::NONE, part: 0 }],
        gone: vec![Gone::new(number, false)],
        ring: ring.clone(),
        seams: Vec::new(),
        allowance: ALLOWANCE,
        told: format!("the point of dart `{}` of piece `{}` lies at {} now", p.dart, piece.name, mm(to)),
        findings: differ.into_iter().collect(),
    })
}
