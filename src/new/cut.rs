//! Which pieces of a pattern are sewn, and which are cut twice.

use toile_garment::sewing::{CopySpec, SewingPlan};
use toile_garment::{Garment, Piece};
use toile_stages::proposal::own_images;
use toile_stages::roles::{Part, Role, roles_of_names};

/// Areas of a piece and its counterpart differ by less, as a share.
const COUNTERPART: f64 = 0.03;

/// Copies and pieces that are left out, as the pattern tells them. `more` are pieces that a person leaves out.
///
/// Interlinings are fused to other pieces. A piece with the quantity 0 is not cut: it is an alternative, or only helps to
/// draw another one.
pub fn plan(garment: &Garment, more: &[String]) -> SewingPlan {
    let roles = roles_of_names(&garment.pieces);
    let is_any_cut = garment.pieces.iter().any(is_cut);
    let is_left_out = |p: &Piece| {
        let is_fused = roles[p.id.index()].part == Some(Part::Interlining);
        is_fused || (is_any_cut && !is_cut(p)) || more.contains(&p.name)
    };
    let (left_out, sewn): (Vec<&Piece>, Vec<&Piece>) = garment.pieces.iter().partition(|p| is_left_out(p));
    let mut leave_out: Vec<String> = left_out.iter().map(|p| p.name.clone()).collect();
    // A name that is not in the pattern is told later, where the plan is applied.
    leave_out.extend(more.iter().filter(|name| garment.pieces.iter().all(|p| p.name != **name)).cloned());
    let own = own_images(garment);
    let is_double = |p: &&&Piece| is_pair(p, own[p.id.index()]) || is_half_of_pair(p, &sewn, &roles);
    let copies = sewn.iter().filter(is_double).map(|p| mirrored(p)).collect();
    SewingPlan { copies, leave_out, ..SewingPlan::default() }
}

fn is_cut(piece: &Piece) -> bool {
    piece.quantity.plain + piece.quantity.mirrored > 0
}

/// Is a piece cut once as drawn and once turned over? A count of two alone means so only where the piece is not its own
/// mirror image.
fn is_pair(piece: &Piece, is_own_image: bool) -> bool {
    let both = piece.quantity.plain > 0 && piece.quantity.mirrored > 0;
    both || (piece.quantity.plain == 2 && !is_own_image)
}

/// Is a piece of an arm or a leg drawn alone, without its counterpart on the other side?
fn is_half_of_pair(piece: &Piece, sewn: &[&Piece], roles: &[Role]) -> bool {
    let role = |p: &Piece| &roles[p.id.index()];
    let is_on_limb = matches!(role(piece).part, Some(Part::Sleeve | Part::Leg));
    let area = |p: &Piece| p.outline.signed_area().abs();
    let is_counterpart =
        |p: &&Piece| p.id != piece.id && role(p).part == role(piece).part && near(area(p), area(piece));
    is_on_limb && role(piece).lateral.is_none() && !sewn.iter().any(is_counterpart)
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < COUNTERPART * a.max(b)
}

fn mirrored(piece: &Piece) -> CopySpec {
    CopySpec { piece: piece.name.clone(), name: format!("{}-M", piece.name), mirror: true, source: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::outline::{LinePoint, PieceLine, PointKind};
    use toile_garment::piece::Quantity;
    use toile_garment::{PieceId, Vec2};

    fn piece(id: usize, name: &str, width: f64, plain: u32) -> Piece {
        let corner = |x: f64, y: f64| LinePoint { at: Vec2::new(x, y), kind: PointKind::Turn };
        let points = vec![corner(0.0, 0.0), corner(width, 0.0), corner(0.8 * width, 0.3), corner(0.0, 0.2)];
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        let quantity = Quantity { plain, mirrored: 0 };
        Piece { id: PieceId::from(id), name: name.to_owned(), outline, quantity, ..Piece::default() }
    }

    fn plan_of(pieces: Vec<Piece>) -> (Vec<String>, Vec<String>) {
        let plan = plan(&Garment { pieces, ..Garment::default() }, &[]);
        (plan.copies.iter().map(|c| c.name.clone()).collect(), plan.leave_out)
    }

    #[test]
    fn a_sleeve_that_is_drawn_once_is_cut_twice() {
        let body = || vec![piece(0, "front", 0.5, 1), piece(1, "back", 0.5, 1)];
        let with = |more: Vec<Piece>| plan_of(body().into_iter().chain(more).collect()).0;
        assert_eq!(with(vec![piece(2, "sleeve", 0.4, 1)]), ["sleeve-M"]);
        // Two sleeves of one size are the left and the right one.
        assert!(with(vec![piece(2, "sleeve", 0.4, 1), piece(3, "sleeve 1", 0.4, 1)]).is_empty());
        assert!(with(vec![piece(2, "left sleeve", 0.4, 1)]).is_empty());
    }

    #[test]
    fn pieces_of_quantity_zero_are_left_out() {
        let both = |long: u32| plan_of(vec![piece(0, "short sleeve", 0.4, 2), piece(1, "long sleeve", 0.7, long)]);
        assert_eq!(both(0).1, ["long sleeve"]);
        assert!(both(2).1.is_empty());
        // A file in which no quantity is over 0 says nothing.
        assert!(plan_of(vec![piece(0, "front", 0.5, 0), piece(1, "back", 0.5, 0)]).1.is_empty());
    }
}
