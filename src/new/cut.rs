//! Which pieces of a pattern are sewn, and which are cut twice.

use super::alternatives::{Known, count_told, drawn_over, is_under_layer};
use toile_garment::piece::Quantity;
use toile_garment::sewing::{CopySpec, SewingPlan};
use toile_garment::{Garment, Piece, Vec2};
use toile_stages::proposal::{own_images, pleats};
use toile_stages::roles::{Facing, Part, Role, roles_of_names};

/// Areas of a piece and its counterpart differ by less, as a share.
const COUNTERPART: f64 = 0.03;

/// Areas and lengths around differ by less between a piece and its mirror image, as a share.
const SAME_OUTLINE: f64 = 1e-3;

/// A placket of an open front is at least so long, as a share of the front. Slits of sleeves and polo shirts are shorter.
const LONG_PLACKET: f64 = 0.55;

/// The quantity of a piece that is not cut.
const NONE: Quantity = Quantity { plain: 0, mirrored: 0 };

/// The pieces that a pattern asks for twice or not at all.
#[derive(Debug, Default)]
pub struct Cut {
    /// Copies, and pieces that are left out.
    pub plan: SewingPlan,
    /// Those of them that lie on or under other pieces.
    pub inner: Vec<String>,
    /// Those of them whose quantity is 0.
    pub not_cut: Vec<String>,
    /// Those of them for which another piece stands.
    pub stood_for: Vec<String>,
    /// Plackets of a slit that is not cut.
    pub without_slit: Vec<String>,
}

/// Copies and pieces that are left out, as the pattern tells them. `more` are pieces that a person leaves out.
///
/// Interlinings, linings and facings lie inside, under outer pieces, and a lower collar lies under the upper one. Pockets
/// and belt loops lie on others. A piece with the quantity 0 is not cut: it is an alternative, or only helps to draw
/// another one. Where all quantities are 0 the file is a kit, and annotations tell them. Plackets are left out where every
/// front is whole: a slit in its middle is a drawn line at most.
pub fn plan(garment: &Garment, more: &[String]) -> Cut {
    let roles = roles_of_names(&garment.pieces);
    let is_any_cut = garment.pieces.iter().any(|p| p.quantity != NONE);
    let counts = |p: &Piece| if is_any_cut { p.quantity } else { told(p) };
    let is_not_cut = |p: &Piece| counts(p) == NONE;
    let is_inside = |p: &Piece| roles[p.id.index()].part.is_some_and(is_layer);
    // A file of a lining alone has no outer piece.
    let has_outer = garment.pieces.iter().any(|p| !is_inside(p));
    let is_inner = |p: &Piece| has_outer && is_inside(p);
    let is_left_out = |p: &Piece| is_inner(p) || is_not_cut(p) || more.contains(&p.name);
    let (left_out, sewn): (Vec<&Piece>, Vec<&Piece>) = garment.pieces.iter().partition(|p| is_left_out(p));
    let inner = left_out.iter().filter(|p| is_inner(p) && !is_not_cut(p)).map(|p| p.name.clone()).collect();
    let not_cut = left_out.iter().filter(|p| is_not_cut(p)).map(|p| p.name.clone()).collect();
    let mut leave_out: Vec<String> = left_out.iter().map(|p| p.name.clone()).collect();
    // A name that is not in the pattern is told later, where the plan is applied.
    leave_out.extend(more.iter().filter(|name| garment.pieces.iter().all(|p| p.name != **name)).cloned());
    let own = own_images(garment);
    let is_double = |p: &&&Piece| {
        let (role, is_own) = (&roles[p.id.index()], own[p.id.index()]);
        is_pair(counts(p), role, is_own) || is_half_of_pair(p, &sewn, &roles)
    };
    let known = sewn.iter().map(|p| {
        let (role, is_own_image) = (&roles[p.id.index()], own[p.id.index()]);
        Known { piece: p, role, is_double: is_double(&p), is_own_image }
    });
    let known: Vec<Known<'_>> = known.collect();
    let without_slit = plackets_without_slit(&known);
    let known: Vec<Known<'_>> = known.into_iter().filter(|k| !without_slit.contains(&k.piece.name)).collect();
    let (layers, known): (Vec<_>, Vec<_>) = known.iter().copied().partition(|k| is_under_layer(k, &known));
    let others = drawn_over(&known);
    let stood_for: Vec<String> = layers.iter().map(|k| k.piece.name.clone()).chain(others.iter().cloned()).collect();
    let kept = known.iter().filter(|k| k.is_double && !others.contains(&k.piece.name));
    let copies = kept.map(|k| mirrored(k.piece)).collect();
    leave_out.extend(stood_for.iter().chain(&without_slit).cloned());
    let darts = pleats(garment, &leave_out);
    let plan = SewingPlan { copies, leave_out, darts, ..SewingPlan::default() };
    Cut { plan, inner, not_cut, stood_for, without_slit }
}

/// Is a part a layer that lies on or under another piece, and hangs on no edge of it?
fn is_layer(part: Part) -> bool {
    matches!(part, Part::Interlining | Part::Lining | Part::Facing | Part::Pocket | Part::BeltLoop)
}

/// The plackets of a garment, but for those that are as long as the edge of an open front. Fronts that are whole, from
/// side to side, have a slit in their middle at most, and so have sleeves and trousers.
fn plackets_without_slit(known: &[Known<'_>]) -> Vec<String> {
    let is_of_trunk = |k: &&Known<'_>| matches!(k.role.part, None | Some(Part::Bodice));
    let is_front = |k: &&Known<'_>| is_of_trunk(k) && k.role.facing == Some(Facing::Front);
    let span = |p: &Piece| {
        let points = p.outline.positions();
        let far = |a: &Vec2| points.iter().map(|b| (b - a).norm()).fold(0.0, f64::max);
        points.iter().map(far).fold(0.0, f64::max)
    };
    let open = known.iter().filter(is_front).filter(|k| !k.is_own_image).map(|k| span(k.piece));
    let edge = LONG_PLACKET * open.fold(f64::INFINITY, f64::min);
    let plackets = known.iter().filter(|k| k.role.part == Some(Part::Placket));
    plackets.filter(|k| span(k.piece) < edge).map(|k| k.piece.name.clone()).collect()
}

/// The quantity that an annotation tells, else 1.
fn told(piece: &Piece) -> Quantity {
    Quantity { plain: count_told(piece).unwrap_or(1), mirrored: 0 }
}

/// Is a piece cut once as drawn and once turned over? A count of two alone means so where the piece is not its own
/// mirror image, or lies on an arm, a leg or a shoulder. Two collars are two layers, and four cuffs are two layers for two arms.
fn is_pair(counts: Quantity, role: &Role, is_own_image: bool) -> bool {
    let both = counts.plain > 0 && counts.mirrored > 0;
    let is_on_limb =
        matches!(role.part, Some(Part::Sleeve | Part::Leg | Part::Cuff | Part::Strap)) && role.lateral.is_none();
    both || counts.plain == 2 && (!is_own_image || is_on_limb) || counts.plain == 4 && is_on_limb
}

/// Is a piece of an arm or a leg drawn alone, without its counterpart on the other side?
fn is_half_of_pair(piece: &Piece, sewn: &[&Piece], roles: &[Role]) -> bool {
    let role = |p: &Piece| &roles[p.id.index()];
    let is_on_limb = matches!(role(piece).part, Some(Part::Sleeve | Part::Leg));
    let area = |p: &Piece| p.outline.signed_area().abs();
    // A counterpart has the same role, or the same outline whatever it is called.
    let is_same = |p: &Piece| {
        let [a, b] = [p, piece].map(|p| p.outline.length());
        [(area(p), area(piece)), (a, b)].iter().all(|(x, y)| (x - y).abs() < SAME_OUTLINE * x.max(*y))
    };
    let is_counterpart =
        |p: &&Piece| p.id != piece.id && (is_same(p) || role(p).part == role(piece).part && near(area(p), area(piece)));
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
    use toile_garment::PieceId;
    use toile_garment::outline::OutlineEdge;
    use toile_garment::outline::{LinePoint, PieceLine, PointKind};

    fn piece(id: usize, name: &str, width: f64, plain: u32) -> Piece {
        let corner = |x: f64, y: f64| LinePoint { at: Vec2::new(x, y), kind: PointKind::Turn };
        let points = vec![corner(0.0, 0.0), corner(width, 0.0), corner(0.8 * width, 0.3), corner(0.0, 0.2)];
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        let quantity = Quantity { plain, mirrored: 0 };
        Piece { id: PieceId::from(id), name: name.to_owned(), outline, quantity, ..Piece::default() }
    }

    fn plan_of(pieces: Vec<Piece>) -> (Vec<String>, Vec<String>) {
        let plan = plan(&Garment { pieces, ..Garment::default() }, &[]).plan;
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

    /// A piece whose edges run from corner to corner, mm, with the annotation of a kit.
    fn drawn(id: usize, name: &str, corners: &[(f64, f64)], told: &str) -> Piece {
        let corner = |(x, y): &(f64, f64)| LinePoint { at: Vec2::new(*x, *y) * 1e-3, kind: PointKind::Turn };
        let points: Vec<LinePoint> = corners.iter().map(corner).collect();
        let n = corners.len() as u32;
        let edges = (0..n).map(|k| OutlineEdge { index: k, from: k, to: (k + 1) % n, name: None }).collect();
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        let annotation = Some(told.to_owned());
        let quantity = Quantity { plain: 0, mirrored: 0 };
        Piece { id: PieceId::from(id), name: name.to_owned(), outline, edges, annotation, quantity, ..Piece::default() }
    }

    /// A sleeve with a hem at a height, mm. Its cap is the same for all.
    fn sleeve(id: usize, name: &str, hem: f64) -> Piece {
        let cap = [(200.0, 0.0), (150.0, 60.0), (90.0, 110.0), (40.0, 80.0), (-10.0, 40.0), (-180.0, 0.0)];
        let hem = [(-150.0, hem), (160.0, hem)];
        drawn(id, name, &[&cap[..], &hem[..]].concat(), "2X FABRIC")
    }

    #[test]
    fn a_sleeve_with_its_mirror_image_is_cut_once_whatever_the_other_is_called() {
        let left = Piece { quantity: Quantity { plain: 1, mirrored: 0 }, ..sleeve(0, "short sleeve", -200.0) };
        let mut right = Piece { id: PieceId::from(1usize), name: "cuff".to_owned(), ..left.clone() };
        right.outline.points.iter_mut().for_each(|p| p.at.x = -p.at.x);
        right.outline.points.reverse();
        assert!(plan_of(vec![left.clone(), right.clone()]).0.is_empty());
        assert_eq!(plan_of(vec![left.clone()]).0, ["short sleeve-M"]);
        // Both are sewn: they are a left and a right one, although they share a part of their edges.
        let named = Piece { name: "sleeve with cuff".to_owned(), ..right };
        assert_eq!(plan_of(vec![left, named]), (vec![], vec![]));
    }

    #[test]
    fn of_a_kit_one_of_the_pieces_that_are_drawn_over_each_other_is_sewn() {
        let kit = || vec![sleeve(0, "short sleeve", -200.0), sleeve(1, "long sleeve", -600.0)];
        assert_eq!(plan_of(kit()), (vec!["short sleeve-M".to_owned()], vec!["long sleeve".to_owned()]));
        // A front and a back of nearly one shape are both sewn.
        let named = |piece: Piece, name: &str| Piece { name: name.to_owned(), ..piece };
        let [front, back] = [named(sleeve(0, "", -400.0), "front"), named(sleeve(1, "", -401.0), "back")];
        assert!(plan_of(vec![front, back]).1.is_empty());
    }

    #[test]
    fn quantities_of_a_kit_stand_in_its_annotations_and_cuffs_are_cut_for_both_arms() {
        let band = [(0.0, 0.0), (220.0, 0.0), (220.0, 60.0), (0.0, 60.0)];
        let of = |name: &str, told: &str| plan_of(vec![drawn(0, name, &band, told)]).0;
        assert_eq!(of("cuff", "2XRIB"), ["cuff-M"]);
        assert_eq!(of("cuff", "10 X 2"), ["cuff-M"]);
        assert_eq!(of("cuff", "4X FABRIC"), ["cuff-M"]);
        // One band of each cuts one, and two collars are two layers.
        assert!(of("cuff", "1XRIB").is_empty() && of("collar", "2X FABRIC").is_empty());
    }

    #[test]
    fn plackets_are_left_out_where_no_front_is_cut_open() {
        let placket = || drawn(1, "placket", &[(0.0, 0.0), (30.0, 0.0), (30.0, 155.0), (0.0, 155.0)], "1X");
        let front = |right: f64| drawn(0, "front", &[(0.0, 0.0), (600.0, 0.0), (right, 700.0), (60.0, 700.0)], "1X");
        assert_eq!(plan_of(vec![front(540.0), placket()]).1, ["placket"]);
        // Half a front has an edge for a long one. A short one is that of a sleeve.
        let half = || drawn(0, "front", &[(0.0, 0.0), (300.0, 0.0), (250.0, 700.0), (0.0, 600.0)], "2X");
        let long = drawn(1, "placket", &[(0.0, 0.0), (30.0, 0.0), (30.0, 600.0), (0.0, 600.0)], "1X");
        assert_eq!(plan_of(vec![half(), placket()]).1, ["placket"]);
        assert!(plan_of(vec![half(), long]).1.is_empty());
    }

    #[test]
    fn layers_that_lie_inside_are_left_out_where_there_is_an_outer_piece() {
        let pieces =
            || vec![piece(0, "front", 0.5, 1), piece(1, "front facing", 0.1, 1), piece(2, "lining back", 0.5, 1)];
        assert_eq!(plan_of(pieces()).1, ["front facing", "lining back"]);
        assert_eq!(plan(&Garment { pieces: pieces(), ..Garment::default() }, &[]).inner.len(), 2);
        let inner = pieces().split_off(1);
        let alone = inner.iter().enumerate().map(|(k, p)| Piece { id: PieceId::from(k), ..p.clone() });
        assert!(plan_of(alone.collect()).1.is_empty());
    }

    #[test]
    fn a_lower_collar_lies_under_the_upper_one() {
        let band = |width: f64| [(0.0, 0.0), (width, 0.0), (width, 60.0), (0.0, 60.0)];
        let upper = drawn(0, "upper collar", &band(400.0), "1X");
        let lower = drawn(1, "lower collar", &band(396.0), "1X");
        assert_eq!(plan_of(vec![upper, lower.clone()]).1, ["lower collar"]);
        assert!(plan_of(vec![Piece { id: PieceId::from(0), ..lower }]).1.is_empty());
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
