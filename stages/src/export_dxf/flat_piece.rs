//! A piece at its flattened place: the same structure, every point moved.

use super::carry::{Ride, by_nearest, by_triangle, chain_rides};
use super::codes;
use super::outline_map::{Follow, moved_outline};
use toile_garment::dart::{Dart, DartKind};
use toile_garment::flat::FlatPiece;
use toile_garment::mesh::{ChainKind, PieceMesh};
use toile_garment::notch::Notch;
use toile_garment::outline::PieceLine;
use toile_garment::{Diagnostic, Piece, Vec2};

/// The outline of a piece where its flattened mesh says.
///
/// # Errors
/// When the piece has no mesh, or mesh and outline do not belong together.
pub fn flat_outline(piece: &Piece, flat: &FlatPiece) -> Result<Vec<Vec2>, Box<Diagnostic>> {
    mesh_of(piece, flat)?;
    moved_outline(piece, &flat.positions).ok_or_else(|| fault(piece, "its mesh does not follow its outline"))
}

/// Moves outline, cut line, darts and all marks of a piece to where its flattened mesh says.
///
/// # Errors
/// When the piece has no mesh, or mesh and outline do not belong together.
pub fn flat_piece(piece: &Piece, flat: &FlatPiece) -> Result<Piece, Box<Diagnostic>> {
    with_outline(piece, flat, &flat_outline(piece, flat)?)
}

/// Moves all that belongs to a piece behind its outline.
///
/// The outline goes with the mesh, through its darts. The cut line keeps its allowance. Notches follow the line they
/// sit on; internal lines and cutouts their mesh chains; drill holes, grain and texts the triangle they lie in.
///
/// # Errors
/// When the piece has no mesh, or mesh and outline do not belong together.
pub fn with_outline(piece: &Piece, flat: &FlatPiece, moved: &[Vec2]) -> Result<Piece, Box<Diagnostic>> {
    let (mesh, to) = (mesh_of(piece, flat)?, &flat.positions);
    let cloth = |p: Vec2| by_triangle(mesh, to, p).unwrap_or(p);
    let follow = Follow::new(piece, moved);
    let mut out = piece.clone();
    out.mesh = None;
    set(&mut out.outline, moved);
    if let Some(cut) = &mut out.cut_line {
        each(cut, |p| follow.carry(p).0);
    }
    for notch in &mut out.notches {
        carry_notch(notch, &follow, &cloth);
    }
    for (k, line) in out.internal_lines.iter_mut().enumerate() {
        by_chain(line, mesh, to, ChainKind::InternalLine, k);
    }
    for (k, line) in out.cutouts.iter_mut().enumerate() {
        by_chain(line, mesh, to, ChainKind::Cutout, k);
    }
    for dart in &mut out.darts {
        carry_dart(dart, mesh, to, (&piece.outline.positions(), moved));
    }
    for hole in &mut out.drill_holes {
        hole.at = cloth(hole.at);
    }
    for text in &mut out.texts {
        text.at = cloth(text.at);
    }
    out.grain = piece.grain.map(|g| g.map(cloth));
    out.fold = None;
    Ok(out)
}

/// The mesh of a piece, whose vertices were flattened.
fn mesh_of<'p>(piece: &'p Piece, flat: &FlatPiece) -> Result<&'p PieceMesh, Box<Diagnostic>> {
    let mesh = piece.mesh.as_ref().ok_or_else(|| fault(piece, "it was flattened without a mesh"))?;
    let (m, f) = (mesh.rest.len(), flat.positions.len());
    if m == f { Ok(mesh) } else { Err(fault(piece, &format!("the mesh has {m} vertices, the flattened piece {f}"))) }
}

fn fault(piece: &Piece, what: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::error(codes::FLAT_DOES_NOT_FIT, format!("piece `{}`: {what}", piece.name)))
}

fn set(line: &mut PieceLine, moved: &[Vec2]) {
    for (point, at) in line.points.iter_mut().zip(moved) {
        point.at = *at;
    }
}

fn each(line: &mut PieceLine, carry: impl Fn(Vec2) -> Vec2) {
    for point in &mut line.points {
        point.at = carry(point.at);
    }
}

/// A notch on an outer line turns with it; any other goes with the cloth.
fn carry_notch(notch: &mut Notch, follow: &Follow, cloth: &impl Fn(Vec2) -> Vec2) {
    if !notch.is_on_edge() {
        notch.at = cloth(notch.at);
        return;
    }
    let (at, turn) = follow.carry(notch.at);
    notch.at = at;
    notch.angle = notch.angle.map(|a| a + turn);
}

/// An internal line or cutout rides on the mesh chains it became, else on the triangles.
fn by_chain(line: &mut PieceLine, mesh: &PieceMesh, to: &[Vec2], kind: ChainKind, index: usize) {
    let chains = mesh.chains.iter().filter(|c| c.kind == kind && c.index as usize == index);
    let rides: Vec<Ride> = chains.flat_map(|c| chain_rides(mesh, to, &c.vertices, c.closed)).collect();
    each(line, |p| by_nearest(&rides, p).or_else(|| by_triangle(mesh, to, p)).unwrap_or(p));
}

/// Legs ride on their own mesh chains, so that both sides of a closed dart open again.
fn carry_dart(dart: &mut Dart, mesh: &PieceMesh, to: &[Vec2], outline: (&[Vec2], &[Vec2])) {
    let legs = dart.mesh.as_ref().map(|m| m.legs.clone());
    let rides: [Vec<Ride>; 2] = match &legs {
        Some(legs) => [0, 1].map(|k| chain_rides(mesh, to, &legs[k], false)),
        None => [Vec::new(), Vec::new()],
    };
    let on_outline = |p: Vec2| outline.0.iter().zip(outline.1).find(|(a, _)| (*a - p).norm() < 1e-9).map(|(_, b)| *b);
    let carry = |leg: usize, p: Vec2| {
        let exact = if dart.kind == DartKind::Wedge { on_outline(p) } else { None };
        exact.or_else(|| by_nearest(&rides[leg], p)).or_else(|| by_triangle(mesh, to, p)).unwrap_or(p)
    };
    let moved_legs = [0, 1].map(|leg| dart.legs[leg].iter().map(|p| carry(leg, *p)).collect::<Vec<_>>());
    let mouth = [0, 1].map(|leg| carry(leg, dart.mouth[leg]));
    // Ends of a pleat lie on the cloth, and its legs may be sewn for a shorter way.
    let apex = |p: Vec2| match dart.kind {
        DartKind::Pleat => by_triangle(mesh, to, p).unwrap_or(p),
        _ => carry(0, p),
    };
    let apexes = dart.apexes.iter().map(|p| apex(*p)).collect();
    (dart.legs, dart.mouth, dart.apexes, dart.mesh) = (moved_legs, mouth, apexes, None);
}
