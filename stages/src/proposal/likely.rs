//! Parts that no name tells, by their shapes. A sleeve is one of two pieces that can be parted into cap, side, hem and side.
//! A leg has a rise. A single band goes around a waist.

use super::atoms::{Layout, Panel};
use super::bands::is_band;
use super::mirror::{ALONE, maps};
use super::propose::Names;
use super::sleeves::has_shape;
use super::tuning::{self, BandWeights};
use crate::roles::Upright;
use crate::roles::leg_shape::is_leg;
use toile_garment::Garment;

/// Pairs of pieces that may be the sleeves of a garment of few pairs and of other pieces. Of more pairs most are halves
/// of the trunk, and the search sews those better.
pub fn likely_sleeves(layout: &Layout, names: &dyn Names) -> Vec<[usize; 2]> {
    let map = maps(layout, &|_, _| false).swap_remove(0);
    let image = |p: usize| Some(map.panel[p]).filter(|q| *q != ALONE);
    let pairs: Vec<[usize; 2]> =
        (0..layout.panels.len()).filter_map(|p| Some([p, image(p).filter(|q| *q > p)?])).collect();
    if 2 * pairs.len() >= layout.panels.len() || pairs.len() > tuning::FEW_PAIRS {
        return Vec::new();
    }
    let is_other = |piece: usize| names.is_leg(piece) || names.is_told(piece);
    let is_sleeve = |p: &usize| !is_other(layout.panels[*p].piece) && has_shape(layout, &layout.panels[*p]);
    let may_be = |pair: &[usize; 2]| pair.iter().all(is_sleeve);
    pairs.into_iter().filter(may_be).map(|pair| pair.map(|p| layout.panels[p].piece)).collect()
}

/// Left and right pieces of legs: those with a rise, in a garment of which no name tells that it is a top.
fn likely_legs(garment: &Garment, layout: &Layout, names: &dyn Names) -> Vec<[usize; 2]> {
    if layout.panels.iter().any(|p| names.is_sleeve(p.piece) || names.is_at_neck(p.piece)) {
        return Vec::new();
    }
    let upright = Upright::of(&garment.pieces, &[]);
    let all: f64 = layout.panels.iter().map(|p| upright.outlines[p.piece].area()).sum();
    let may_be = |p: usize| {
        let outline = &upright.outlines[p];
        !names.is_told(p) && outline.area() > tuning::LEG_LEAST * all && is_leg(outline)
    };
    let piece = |p: usize| layout.panels[p].piece;
    let map = maps(layout, &|p, q| names.are_namesakes(piece(p), piece(q))).swap_remove(0);
    let image = |p: usize| Some(map.panel[p]).filter(|q| *q != ALONE && *q > p);
    let pairs = (0..layout.panels.len()).filter_map(|p| Some([piece(p), piece(image(p)?)]));
    pairs.filter(|pair| pair.iter().all(|p| may_be(*p))).collect()
}

/// The only band of a garment, where no name tells what it is.
fn likely_band(layout: &Layout, names: &dyn Names) -> Option<usize> {
    let bands: Vec<&Panel> = layout.panels.iter().filter(|p| is_band(layout, names, p, 0.0)).collect();
    let [band] = bands[..] else { return None };
    let is_any_told = layout.panels.iter().any(|p| names.is_whole_band(p.piece));
    let is_long = is_band(layout, names, band, BandWeights::default().waist_least);
    (is_long && !is_any_told && !names.is_told(band.piece)).then_some(band.piece)
}

/// Names, and what shapes tell beside them.
pub struct Likely<'a> {
    /// The facts that names tell.
    pub names: &'a dyn Names,
    /// The pieces of the sleeves.
    pub sleeves: Vec<usize>,
    /// Left and right pieces of legs.
    pub legs: Vec<[usize; 2]>,
    /// The band of a waist.
    pub band: Option<usize>,
}

impl<'a> Likely<'a> {
    /// Legs and a waistband that no name tells.
    pub fn lower(garment: &Garment, layout: &Layout, names: &'a dyn Names) -> Self {
        let (legs, band) = (likely_legs(garment, layout, names), likely_band(layout, names));
        Self { names, sleeves: Vec::new(), legs, band }
    }

    /// Two pieces that are sleeves.
    pub fn with_sleeves(names: &'a dyn Names, sleeves: [usize; 2]) -> Self {
        Self { names, sleeves: sleeves.to_vec(), legs: Vec::new(), band: None }
    }

    fn has_sleeve(&self, piece: usize) -> bool {
        self.sleeves.contains(&piece)
    }
}

impl Names for Likely<'_> {
    fn seam(&self, a: usize, b: usize, images: bool, length: f64) -> f64 {
        self.names.seam(a, b, images, length)
    }

    fn to_lower_edge(&self, piece: usize) -> f64 {
        self.names.to_lower_edge(piece)
    }

    fn is_set_on(&self, piece: usize, other: usize) -> bool {
        self.has_sleeve(piece) && !self.has_sleeve(other) || self.names.is_set_on(piece, other)
    }

    fn faces_front(&self, piece: usize) -> bool {
        self.names.faces_front(piece)
    }

    fn is_waistband(&self, piece: usize) -> bool {
        self.band == Some(piece) || self.names.is_waistband(piece)
    }

    fn is_whole_band(&self, piece: usize) -> bool {
        self.band == Some(piece) || self.names.is_whole_band(piece)
    }

    fn ends(&self, band: usize, other: usize) -> bool {
        self.names.ends(band, other)
    }

    fn hangs_from_waistband(&self, piece: usize) -> bool {
        self.band.is_some_and(|band| band != piece && !self.names.is_told(piece))
            || self.names.hangs_from_waistband(piece)
    }

    fn is_sleeve(&self, piece: usize) -> bool {
        self.has_sleeve(piece) || self.names.is_sleeve(piece)
    }

    fn is_leg(&self, piece: usize) -> bool {
        self.legs.iter().any(|pair| pair.contains(&piece)) || self.names.is_leg(piece)
    }

    fn is_off_arm(&self, piece: usize) -> bool {
        !self.sleeves.is_empty() && !self.has_sleeve(piece) || self.names.is_off_arm(piece)
    }

    fn are_namesakes(&self, a: usize, b: usize) -> bool {
        let is_pair = |pair: &[usize; 2]| pair.contains(&a) && pair.contains(&b);
        self.has_sleeve(a) && self.has_sleeve(b) || self.legs.iter().any(is_pair) || self.names.are_namesakes(a, b)
    }

    fn falls_over(&self, piece: usize, other: usize) -> bool {
        self.names.falls_over(piece, other)
    }

    fn is_told(&self, piece: usize) -> bool {
        self.names.is_told(piece)
    }

    fn is_at_neck(&self, piece: usize) -> bool {
        self.names.is_at_neck(piece)
    }
}
