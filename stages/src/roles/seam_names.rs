//! Names of seams as a workroom has them, from the parts that they join and from where they lie on the body.

use super::{Facing, Join, Lateral, Part, PiecePoint, Role};
use toile_garment::Vec3;

/// A seam whose middle lies nearer to the middle of the body belongs to neither side, m.
const CENTRE_HALF_WIDTH: f64 = 0.02;
/// A seam that rises by this share of its width or more runs down the body.
const UPRIGHT_RISE: f64 = 1.0;
/// Share of the widest seam's distance from the middle, beyond which a seam lies on the outside of a leg or trunk.
const OUTSIDE_SHARE: f64 = 0.5;

/// One side of a seam: the role of most of its points.
#[derive(Clone, Copy, PartialEq)]
struct Kind {
    part: Part,
    facing: Option<Facing>,
    lateral: Option<Lateral>,
}

/// Where a seam lies on the body.
#[derive(Clone, Copy)]
struct Course {
    /// Distance from the middle of the body to the wearer's left, m.
    left: f64,
    is_upright: bool,
    /// Does it lie on the outside of the body, as side seams do?
    is_outside: bool,
}

impl Course {
    fn lateral(self) -> Option<Lateral> {
        (self.left.abs() > CENTRE_HALF_WIDTH).then_some(if self.left > 0.0 { Lateral::Left } else { Lateral::Right })
    }
}

/// The names of all seams, such as `side seam left`; no two are the same. `at` tells where a point lies on the body.
/// Seams of pieces without a role, and of pieces that lie nowhere, have none.
#[must_use]
pub fn seam_names(roles: &[Role], joins: &[Join], at: impl Fn(PiecePoint) -> Option<Vec3>) -> Vec<Option<String>> {
    let spans: Vec<Option<[Vec3; 3]>> = joins.iter().map(|j| span(j, &at)).collect();
    let kinds: Vec<[Option<Kind>; 2]> = joins.iter().map(|j| [0, 1].map(|side| kind(roles, j, side))).collect();
    let is_on_arm = |k: &Option<Kind>| k.is_some_and(|k| matches!(k.part, Part::Sleeve | Part::Cuff));
    let trunk = spans.iter().zip(&kinds).filter(|(_, kinds)| !kinds.iter().any(is_on_arm));
    let widest = trunk.filter_map(|(s, _)| Some(s.as_ref()?[0].x.abs())).fold(0.0, f64::max);
    let named = |k: usize| {
        let (join, [a, b], [middle, low, high]) = (&joins[k], kinds[k], spans[k]?);
        let (a, b) = (a?, b?);
        let width = libm::hypot(high.x - low.x, high.z - low.z);
        let is_upright = high.y - low.y >= UPRIGHT_RISE * width;
        let course = Course { left: middle.x, is_upright, is_outside: middle.x.abs() > OUTSIDE_SHARE * widest };
        let facing = a.facing.or(b.facing).filter(|f| [a, b].iter().all(|k| k.facing.is_none_or(|g| g == *f)));
        let lateral = a.lateral.filter(|l| *l != Lateral::Centre && b.lateral == Some(*l));
        Some((word(a, b, join.is_own(), course)?, lateral.or_else(|| course.lateral()), facing))
    };
    apart(&(0..joins.len()).map(named).collect::<Vec<_>>())
}

/// Middle, lowest and highest coordinates of a seam; the two sides may still lie apart.
fn span(join: &Join, at: &impl Fn(PiecePoint) -> Option<Vec3>) -> Option<[Vec3; 3]> {
    let middles: Option<Vec<Vec3>> = join.pairs.iter().map(|[a, b]| Some((at(*a)? + at(*b)?) * 0.5)).collect();
    let middles = middles.filter(|m| !m.is_empty())?;
    let mean = middles.iter().sum::<Vec3>() / middles.len() as f64;
    let far = Vec3::repeat(f64::INFINITY);
    let (low, high) = middles.iter().fold((far, -far), |(low, high), p| (low.inf(p), high.sup(p)));
    Some([mean, low, high])
}

/// Part and facing of most points of a side; the first of several that have as many.
fn kind(roles: &[Role], join: &Join, side: usize) -> Option<Kind> {
    let mut counts: Vec<(Kind, usize)> = Vec::new();
    for pair in &join.pairs {
        let role = roles.get(pair[side].piece)?;
        let kind = Kind { part: role.part?, facing: role.facing, lateral: role.lateral };
        match counts.iter_mut().find(|(k, _)| *k == kind) {
            Some((_, n)) => *n += 1,
            None => counts.push((kind, 1)),
        }
    }
    counts.into_iter().rev().max_by_key(|(_, n)| *n).map(|(kind, _)| kind)
}

/// The name of a seam without its side.
fn word(a: Kind, b: Kind, is_own: bool, course: Course) -> Option<&'static str> {
    let (first, second) = (a.part.min(b.part), a.part.max(b.part));
    Some(match (first, second) {
        (Part::Lining, _) => "lining",
        (Part::Interlining, _) => "interlining",
        (Part::Facing, _) => "facing",
        (Part::Pocket, _) => "pocket",
        (Part::Placket, _) => "placket",
        (Part::BeltLoop, _) => "belt loop",
        (Part::Binding, _) => "binding",
        (Part::Strap, _) => "strap",
        (Part::Godet, _) => "godet",
        (Part::Cuff, Part::Cuff) => "cuff seam",
        (Part::Cuff, _) => "cuff",
        (Part::Stand, Part::Collar) => "collar to stand",
        (Part::Stand | Part::Collar, Part::Stand | Part::Collar) => "collar seam",
        (Part::Hood, Part::Hood) => "hood seam",
        (Part::Stand | Part::Collar | Part::Hood, _) => "neckline",
        (Part::Waistband, Part::Waistband) => "waistband seam",
        (Part::Waistband, _) => "waist seam",
        (Part::Sleeve, Part::Sleeve) => "sleeve seam",
        (_, Part::Sleeve) | (Part::Sleeve, Part::Bodice) => "armhole",
        (Part::Leg | Part::Skirt, Part::Bodice) => "waist seam",
        (Part::Leg, Part::Leg) => leg(a, b, is_own, course),
        (Part::Yoke, Part::Bodice | Part::Skirt | Part::Leg) => "yoke seam",
        (Part::Tier, _) if !course.is_upright => "tier seam",
        (p, q) if p == q => trunk(a, b, is_own, course)?,
        _ => return None,
    })
}

/// Seams between pieces of trousers.
fn leg(a: Kind, b: Kind, is_own: bool, course: Course) -> &'static str {
    // Legs in one piece face nowhere, and meet in the middle.
    let is_crotch = a.facing == b.facing && (a.facing.is_some() || course.lateral().is_none());
    if is_crotch && !is_own {
        "crotch seam"
    } else if course.is_outside && !is_own {
        "outseam"
    } else {
        "inseam"
    }
}

/// Seams between pieces of the trunk, of a skirt, a yoke or a tier.
fn trunk(a: Kind, b: Kind, is_own: bool, course: Course) -> Option<&'static str> {
    let faces = |f: Facing| a.facing == Some(f) && b.facing == Some(f);
    let differs = a.facing != b.facing;
    Some(match course.lateral() {
        _ if a.part == Part::Bodice && differs && !course.is_upright => "shoulder",
        None if faces(Facing::Front) => "centre front",
        None if faces(Facing::Back) => "centre back",
        Some(_) if differs && course.is_outside => "side seam",
        Some(_) if !is_own && course.is_upright => "panel seam",
        _ => return None,
    })
}

/// A name without its side, the side of the wearer, and where both sides face.
type Parts = (&'static str, Option<Lateral>, Option<Facing>);

/// Whole names. Where they meet, the facing tells seams apart, and then a number.
fn apart(names: &[Option<Parts>]) -> Vec<Option<String>> {
    let whole = |words: &[Option<&str>]| words.iter().copied().flatten().collect::<Vec<_>>().join(" ");
    let short = |n: &Parts| whole(&[Some(n.0), n.1.map(Lateral::word)]);
    let long = |n: &Parts| whole(&[n.2.map(Facing::word), Some(n.0), n.1.map(Lateral::word)]);
    let told = |n: &Parts| {
        let meets = names.iter().flatten().filter(|o| short(o) == short(n)).count() > 1;
        if meets { long(n) } else { short(n) }
    };
    let texts: Vec<Option<String>> = names.iter().map(|n| n.as_ref().map(told)).collect();
    let numbered = |(k, text): (usize, &Option<String>)| {
        let text = text.as_ref()?;
        let same = |list: &[Option<String>]| list.iter().flatten().filter(|t| *t == text).count();
        Some(if same(&texts) > 1 { format!("{text} {}", same(&texts[..=k])) } else { text.clone() })
    };
    texts.iter().enumerate().map(numbered).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::Vec2;

    /// Front, back, two sleeves and a rib. Points are told on the body: x to the left and y up.
    fn roles() -> Vec<Role> {
        let role = |part, facing| Role { part: Some(part), facing, ..Role::default() };
        vec![
            role(Part::Bodice, Some(Facing::Front)),
            role(Part::Bodice, Some(Facing::Back)),
            role(Part::Sleeve, None),
            role(Part::Collar, None),
            role(Part::Leg, Some(Facing::Front)),
            role(Part::Leg, Some(Facing::Back)),
            role(Part::Leg, None),
            role(Part::Leg, None),
        ]
    }

    fn join(a: usize, b: usize, from: [f64; 2], to: [f64; 2]) -> Join {
        let at = |t: f64| Vec2::new(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]));
        let pair = |t: f64| [a, b].map(|piece| PiecePoint { piece, at: at(t), is_inside: false });
        Join { name: String::new(), pairs: [0.1, 0.5, 0.9].map(pair).to_vec(), length: 0.3 }
    }

    fn names(joins: &[Join]) -> Vec<String> {
        let on_body = |p: PiecePoint| Some(Vec3::new(p.at.x, p.at.y, 0.0));
        seam_names(&roles(), joins, on_body).into_iter().map(Option::unwrap_or_default).collect()
    }

    #[test]
    fn seams_of_a_shirt_have_their_names() {
        let joins = [
            join(0, 1, [0.25, 0.9], [0.24, 1.3]),
            join(1, 0, [-0.25, 0.9], [-0.24, 1.3]),
            join(0, 1, [0.07, 1.44], [0.19, 1.4]),
            join(0, 2, [0.2, 1.3], [0.2, 1.4]),
            join(2, 2, [0.45, 1.2], [0.65, 1.0]),
            join(3, 0, [-0.07, 1.42], [0.07, 1.42]),
            join(0, 0, [0.0, 0.9], [0.0, 1.3]),
        ];
        let want = ["side seam left", "side seam right", "shoulder left", "armhole left", "sleeve seam left"];
        assert_eq!(names(&joins)[..5], want);
        assert_eq!(names(&joins)[5..], ["neckline", "centre front"]);
    }

    #[test]
    fn seams_of_trousers_have_their_names() {
        let joins = [
            join(4, 5, [0.2, 0.1], [0.2, 1.0]),
            join(4, 5, [0.05, 0.1], [0.05, 0.8]),
            join(4, 4, [0.0, 0.8], [0.0, 1.0]),
            join(5, 5, [0.0, 0.8], [0.0, 1.0]),
        ];
        assert_eq!(names(&joins)[..2], ["outseam left", "inseam left"]);
        // Legs in one piece are sewn to themselves, and to each other in the middle.
        let whole = [
            join(6, 6, [0.05, 0.1], [0.05, 0.8]),
            join(7, 7, [-0.05, 0.1], [-0.05, 0.8]),
            join(6, 7, [0.0, 0.8], [0.0, 1.0]),
        ];
        assert_eq!(names(&whole), ["inseam left", "inseam right", "crotch seam"]);
    }

    #[test]
    fn facing_and_number_tell_seams_of_one_name_apart() {
        let armholes = [join(0, 2, [0.2, 1.3], [0.2, 1.4]), join(1, 2, [0.2, 1.3], [0.2, 1.4])];
        assert_eq!(names(&armholes), ["front armhole left", "back armhole left"]);
        let panels = [join(0, 0, [0.1, 0.9], [0.1, 1.3]), join(1, 1, [0.1, 0.9], [0.1, 1.3])];
        // A seam of a piece with itself, off the middle, is no panel seam.
        assert_eq!(names(&panels), ["", ""]);
    }
}
