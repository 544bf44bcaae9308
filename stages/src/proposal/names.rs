//! Names of pieces, as they speak against a seam.
//!
//! Names only speak against seams. Bonuses for names that agree made proposals worse.

use super::propose::Names;
use super::tuning::NameWeights;
use crate::roles::{Facing, Lateral, Part, Role, roles_of_names};
use toile_garment::Garment;

/// Names that are read for roles.
pub struct RoleNames {
    roles: Vec<Role>,
    /// Pieces and their mirrored copies.
    twins: Vec<[usize; 2]>,
    weights: NameWeights,
}

impl RoleNames {
    /// The names of a garment's pieces, and its mirrored copies.
    #[must_use]
    pub fn new(garment: &Garment) -> Self {
        let find = |name: &str| garment.pieces.iter().position(|p| p.name == name);
        let mirrored = garment.plan.copies.iter().filter(|c| c.mirror);
        let twins = mirrored.filter_map(|c| Some([find(&c.piece)?, find(&c.name)?])).collect();
        let roles = roles_of_names(&garment.pieces);
        Self { roles, twins, weights: NameWeights::default() }
    }

    /// Is there a piece that lies so?
    fn has(&self, at: Height) -> bool {
        self.roles.iter().any(|r| r.part.and_then(height) == Some(at))
    }

    /// Is one of two pieces the mirrored copy of the other?
    fn are_twins(&self, a: usize, b: usize) -> bool {
        self.twins.contains(&[a, b]) || self.twins.contains(&[b, a])
    }
}

impl Names for RoleNames {
    fn seam(&self, a: usize, b: usize, images: bool, length: f64) -> f64 {
        let are_twins = self.are_twins(a, b);
        let (w, a, b) = (&self.weights, &self.roles[a], &self.roles[b]);
        let mut sum = 0.0;
        let hangs_beside = |r: &Role| matches!(r.part, Some(Part::Sleeve | Part::Cuff));
        if (are_twins || crosses(a.lateral, b.lateral)) && (!images || hangs_beside(a) || hangs_beside(b)) {
            sum += w.left_to_right;
        }
        if let (Some(p), Some(q)) = (a.part, b.part) {
            let other_way = turned(a.facing, b.facing);
            let beside = a.lateral.is_some() && b.lateral.is_some();
            if p == q && beside && a.facing.is_some() && a.facing == b.facing && !images {
                sum += w.same_part_and_facing;
            }
            if p != q && other_way && length > w.short {
                sum += w.other_part_and_facing;
            }
            if never_meet(p, q) {
                sum += w.never_meet;
            }
        }
        sum
    }

    fn to_lower_edge(&self, piece: usize) -> f64 {
        let is_at_neck = self.roles[piece].part.and_then(height) == Some(Height::Neck);
        if is_at_neck { self.weights.never_meet } else { 0.0 }
    }

    fn is_set_on(&self, piece: usize, other: usize) -> bool {
        let height = |p: usize| self.roles[p].part.and_then(height);
        use Height::{Arm, Neck, Trunk, Wrist};
        matches!((height(piece), height(other)), (Some(Arm | Neck), Some(Trunk)) | (Some(Wrist), Some(Arm)))
    }

    fn is_whole_band(&self, piece: usize) -> bool {
        let role = &self.roles[piece];
        let is_part = |part: Part| self.roles.iter().any(|r| r.part == Some(part));
        let is_band = match role.part {
            Some(Part::Cuff | Part::Waistband | Part::Binding) => true,
            // A collar on a stand goes around no neckline.
            Some(Part::Collar) => !is_part(Part::Stand),
            _ => false,
        };
        is_band && !matches!(role.facing, Some(Facing::Front | Facing::Back | Facing::Side))
    }

    fn ends(&self, band: usize, other: usize) -> bool {
        let height = |p: usize| self.roles[p].part.and_then(height);
        let is_leg = self.roles[other].part == Some(Part::Leg);
        let hangs_below = || self.has(Height::Below);
        match (height(band), height(other)) {
            (Some(Height::Wrist), over) => over == Some(Height::Arm) || is_leg,
            (Some(Height::Waist), Some(Height::Trunk)) => !hangs_below(),
            _ => false,
        }
    }

    fn hangs_from_waistband(&self, piece: usize) -> bool {
        let role = &self.roles[piece];
        match role.part {
            // The yoke of trousers or a skirt.
            Some(Part::Yoke) => {
                let is_bodice = |r: &Role| r.part == Some(Part::Bodice);
                !self.has(Height::Arm) && !self.has(Height::Neck) && !self.roles.iter().any(is_bodice)
            }
            Some(part) => height(part) == Some(Height::Below),
            // The name of a front or a back does not tell trousers from a skirt.
            None => matches!(role.facing, Some(Facing::Front | Facing::Back)),
        }
    }

    fn faces_front(&self, piece: usize) -> bool {
        self.roles[piece].facing == Some(Facing::Front)
    }

    fn is_waistband(&self, piece: usize) -> bool {
        self.roles[piece].part == Some(Part::Waistband)
    }

    fn is_sleeve(&self, piece: usize) -> bool {
        self.roles[piece].part == Some(Part::Sleeve)
    }

    fn is_leg(&self, piece: usize) -> bool {
        self.roles[piece].part == Some(Part::Leg)
    }

    fn falls_over(&self, piece: usize, other: usize) -> bool {
        let part = |p: usize| self.roles[p].part;
        (part(piece), part(other)) == (Some(Part::Collar), Some(Part::Stand))
    }

    fn is_told(&self, piece: usize) -> bool {
        self.roles[piece].part.is_some()
    }

    fn is_at_neck(&self, piece: usize) -> bool {
        self.roles[piece].part.and_then(height) == Some(Height::Neck)
    }

    fn is_off_arm(&self, piece: usize) -> bool {
        self.roles[piece].part.and_then(height).is_some_and(|h| !matches!(h, Height::Arm | Height::Wrist))
    }

    fn are_namesakes(&self, a: usize, b: usize) -> bool {
        if self.are_twins(a, b) {
            return true;
        }
        let (a, b) = (&self.roles[a], &self.roles[b]);
        a.part.is_some() && a.part == b.part && a.facing == b.facing && crosses(a.lateral, b.lateral)
    }
}

fn crosses(a: Option<Lateral>, b: Option<Lateral>) -> bool {
    matches!((a, b), (Some(Lateral::Left), Some(Lateral::Right)) | (Some(Lateral::Right), Some(Lateral::Left)))
}

fn turned(a: Option<Facing>, b: Option<Facing>) -> bool {
    matches!((a, b), (Some(Facing::Front), Some(Facing::Back)) | (Some(Facing::Back), Some(Facing::Front)))
}

/// The part of the body that a part of the garment lies on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Height {
    Neck,
    Trunk,
    Arm,
    Wrist,
    Waist,
    Below,
}

fn height(part: Part) -> Option<Height> {
    Some(match part {
        // A binding goes around an opening of the trunk, as a collar does.
        Part::Collar | Part::Stand | Part::Hood | Part::Binding => Height::Neck,
        Part::Bodice | Part::Yoke => Height::Trunk,
        Part::Sleeve => Height::Arm,
        Part::Waistband => Height::Waist,
        Part::Skirt | Part::Leg | Part::Tier => Height::Below,
        Part::Cuff => Height::Wrist,
        _ => return None,
    })
}

/// Are two parts never sewn to each other?
fn never_meet(a: Part, b: Part) -> bool {
    use Height::{Arm, Below, Neck, Trunk, Waist, Wrist};
    let (Some(x), Some(y)) = (height(a), height(b)) else { return false };
    let is = |p: Height, q: Height| (x, y) == (p, q) || (x, y) == (q, p);
    is(Neck, Arm)
        || is(Neck, Waist)
        || is(Neck, Below)
        || is(Neck, Wrist)
        || is(Wrist, Trunk)
        || is(Wrist, Waist)
        || is(Arm, Waist)
        || is(Arm, Below)
        || (is(Wrist, Below) && !matches!((a, b), (Part::Leg, _) | (_, Part::Leg)))
}

#[cfg(test)]
mod tests {
    use super::super::propose::Rim;
    use super::*;
    use toile_garment::Piece;

    fn named(names: &[&str]) -> RoleNames {
        let pieces: Vec<Piece> = names.iter().map(|n| Piece { name: (*n).to_owned(), ..Piece::default() }).collect();
        RoleNames::new(&Garment { pieces, ..Garment::default() })
    }

    #[test]
    fn names_speak_against_seams_from_left_to_right_but_not_on_the_middle() {
        let names = named(&["left front bodice", "right front bodice", "left sleeve", "right sleeve"]);
        assert_eq!(names.seam(0, 1, true, 0.3), 0.0);
        assert!(names.seam(0, 1, false, 0.3) < -4.0);
        assert!(names.seam(2, 3, true, 0.3) < -4.0);
        assert!(names.are_namesakes(0, 1) && !names.are_namesakes(0, 2));
    }

    #[test]
    fn a_waistband_goes_around_what_hangs_from_it() {
        let names = named(&["waistband", "front", "skirt back", "sleeve", "pocket"]);
        let around: Vec<usize> = (1..5).filter(|other| names.goes_around(0, *other) == Some(Rim::Upper)).collect();
        assert_eq!(around, [1, 2]);
        assert_eq!(names.goes_around(1, 2), None);
        // On a garment that ends at the hips it is a hem band, and a cuff ends a sleeve.
        let names = named(&["hem rib", "front", "back", "sleeve", "cuff", "neckband"]);
        assert_eq!([1, 2, 3].map(|p| names.goes_around(0, p)), [Some(Rim::Lower), Some(Rim::Lower), None]);
        assert_eq!([1, 2, 3].map(|p| names.goes_around(4, p)), [None, None, Some(Rim::Lower)]);
        assert_eq!([1, 2, 3].map(|p| names.goes_around(5, p)), [Some(Rim::Upper), Some(Rim::Upper), None]);
    }

    #[test]
    fn a_collar_is_not_sewn_to_a_skirt_but_a_cuff_is_sewn_to_a_leg() {
        let names = named(&["collar", "skirt", "cuff", "leg"]);
        assert!(names.seam(0, 1, false, 0.3) < -4.0);
        assert_eq!(names.seam(2, 3, false, 0.3), 0.0);
    }
}
