//! Roles of pieces: what part of a garment a piece is, which way it faces, on which side it lies.
//!
//! Names tell it where they say something. Where they are silent, the shape of a piece and what it is sewn to do.

mod drawn;
mod joins;
pub(crate) mod leg_shape;
mod names;
pub(crate) mod outline;
mod seam_names;
mod seams;
mod words;

pub use drawn::Upright;
pub use joins::{Join, PiecePoint, joins_of_meshes, joins_of_plan};
pub use names::{folded, role_of_text, roles_of_names};
pub use seam_names::seam_names;
pub use words::{Meaning, WORDS};

use toile_garment::Piece;

/// A part of a garment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Cloth inside that follows the outer pieces.
    Lining,
    /// A layer that stiffens another piece.
    Interlining,
    /// A piece that finishes an edge on the inside.
    Facing,
    /// Pocket, welt or flap.
    Pocket,
    /// Strip at an opening.
    Placket,
    /// Loop for a belt, or a belt that is tied.
    BeltLoop,
    /// Strip that is folded around an edge.
    Binding,
    /// Shoulder strap.
    Strap,
    /// Wedge let into a seam.
    Godet,
    /// Band at the end of a sleeve or leg.
    Cuff,
    /// Band between neckline and collar.
    Stand,
    /// Collar, lapel or neckband.
    Collar,
    /// Hood.
    Hood,
    /// Band at the waist.
    Waistband,
    /// Piece over the shoulders, or at the top of a skirt.
    Yoke,
    /// Strip that hangs from the edge of another piece.
    Tier,
    /// Sleeve.
    Sleeve,
    /// Piece of trousers.
    Leg,
    /// Piece of a skirt.
    Skirt,
    /// Piece of the trunk above the waist.
    Bodice,
}

impl Part {
    /// All parts; where a name tells two, the earlier one is meant: a sleeve placket is a placket.
    pub const ALL: [Self; 20] = [
        Self::Lining,
        Self::Interlining,
        Self::Facing,
        Self::Pocket,
        Self::Placket,
        Self::BeltLoop,
        Self::Binding,
        Self::Strap,
        Self::Godet,
        Self::Cuff,
        Self::Stand,
        Self::Collar,
        Self::Hood,
        Self::Waistband,
        Self::Yoke,
        Self::Tier,
        Self::Sleeve,
        Self::Leg,
        Self::Skirt,
        Self::Bodice,
    ];

    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Lining => "lining",
            Self::Interlining => "interlining",
            Self::Facing => "facing",
            Self::Pocket => "pocket",
            Self::Placket => "placket",
            Self::BeltLoop => "belt loop",
            Self::Binding => "binding",
            Self::Strap => "strap",
            Self::Godet => "godet",
            Self::Cuff => "cuff",
            Self::Stand => "stand",
            Self::Collar => "collar",
            Self::Hood => "hood",
            Self::Waistband => "waistband",
            Self::Yoke => "yoke",
            Self::Tier => "tier",
            Self::Sleeve => "sleeve",
            Self::Leg => "leg",
            Self::Skirt => "skirt",
            Self::Bodice => "bodice",
        }
    }
}

/// Which way a piece faces on the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Facing {
    /// To the front.
    Front,
    /// To the back.
    Back,
    /// To a side.
    Side,
    /// The outer one of two, of sleeves and collars.
    Upper,
    /// The inner one of two, of sleeves and collars.
    Under,
}

impl Facing {
    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Side => "side",
            Self::Upper => "upper",
            Self::Under => "under",
        }
    }
}

/// Which side of the wearer a piece lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Lateral {
    /// The wearer's left.
    Left,
    /// The wearer's right.
    Right,
    /// The middle.
    Centre,
}

impl Lateral {
    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Centre => "centre",
        }
    }
}

/// The role of a piece, as far as it is known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Role {
    /// Part of the garment.
    pub part: Option<Part>,
    /// Which way it faces.
    pub facing: Option<Facing>,
    /// Side of the wearer.
    pub lateral: Option<Lateral>,
    /// How sure this is, from 0 to 1: the least sure of what is told.
    pub confidence: f64,
    /// Why, in words.
    pub evidence: Vec<String>,
}

impl Role {
    /// The role in words, such as `front bodice left`; empty where nothing is known.
    #[must_use]
    pub fn words(&self) -> String {
        let words = [self.facing.map(Facing::word), self.part.map(Part::word), self.lateral.map(Lateral::word)];
        words.into_iter().flatten().collect::<Vec<_>>().join(" ")
    }
}

/// Roles of all pieces, in their order. `joins` tells who is sewn to whom, as far as it is known. Pieces may be
/// drawn lying ([`Upright`]).
#[must_use]
pub fn roles(pieces: &[Piece], joins: &[Join]) -> Vec<Role> {
    seams::complete(pieces, roles_of_names(pieces), joins)
}
