//! Sleeves that no name tells: a left and a right piece, each of which can be parted into cap, side, hem and side.

use super::atoms::Layout;
use super::mirror::{ALONE, maps};
use super::propose::{Names, Rim};
use super::sleeves::has_shape;
use super::tuning;

/// Pairs of pieces that may be the sleeves of a garment of few pairs and of other pieces. Of more pairs most are halves
/// of the trunk, and the search sews those better.
pub fn likely_sleeves(layout: &Layout) -> Vec<[usize; 2]> {
    let map = maps(layout, &|_, _| false).swap_remove(0);
    let image = |p: usize| Some(map.panel[p]).filter(|q| *q != ALONE);
    let pairs: Vec<[usize; 2]> =
        (0..layout.panels.len()).filter_map(|p| Some([p, image(p).filter(|q| *q > p)?])).collect();
    if 2 * pairs.len() >= layout.panels.len() || pairs.len() > tuning::FEW_PAIRS {
        return Vec::new();
    }
    let may_be = |pair: &[usize; 2]| pair.iter().all(|p| has_shape(layout, &layout.panels[*p]));
    pairs.into_iter().filter(may_be).map(|pair| pair.map(|p| layout.panels[p].piece)).collect()
}

/// Names that are told two sleeves.
pub struct WithSleeves<'a> {
    /// What the names tell.
    pub names: &'a dyn Names,
    /// The pieces of the sleeves.
    pub sleeves: [usize; 2],
}

impl Names for WithSleeves<'_> {
    fn seam(&self, a: usize, b: usize, images: bool, length: f64) -> f64 {
        self.names.seam(a, b, images, length)
    }

    fn to_lower_edge(&self, piece: usize) -> f64 {
        self.names.to_lower_edge(piece)
    }

    fn is_set_on(&self, piece: usize, other: usize) -> bool {
        self.is_sleeve(piece) && !self.is_sleeve(other) || self.names.is_set_on(piece, other)
    }

    fn faces_front(&self, piece: usize) -> bool {
        self.names.faces_front(piece)
    }

    fn is_waistband(&self, piece: usize) -> bool {
        self.names.is_waistband(piece)
    }

    fn is_whole_band(&self, piece: usize) -> bool {
        self.names.is_whole_band(piece)
    }

    fn ends(&self, band: usize, other: usize) -> bool {
        self.names.ends(band, other)
    }

    fn goes_around(&self, band: usize, other: usize) -> Option<Rim> {
        self.names.goes_around(band, other)
    }

    fn hangs_from_waistband(&self, piece: usize) -> bool {
        self.names.hangs_from_waistband(piece)
    }

    fn is_sleeve(&self, piece: usize) -> bool {
        self.sleeves.contains(&piece)
    }

    fn is_leg(&self, piece: usize) -> bool {
        self.names.is_leg(piece)
    }

    fn is_off_arm(&self, piece: usize) -> bool {
        !self.is_sleeve(piece)
    }

    fn are_namesakes(&self, a: usize, b: usize) -> bool {
        self.is_sleeve(a) && self.is_sleeve(b) || self.names.are_namesakes(a, b)
    }
}
