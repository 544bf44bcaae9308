//! Edges that stay open until a band goes around them: the ends of sleeves and legs, and the hem above a hem rib. Edges
//! beyond buttons stay open for good.

use super::atoms::Layout;
use super::buttons::ButtonFront;
use super::propose::Names;
use super::tuning::LegWeights;
use std::f64::consts::FRAC_1_SQRT_2;
use toile_garment::Vec2;

/// For every atom whether it stays open in the search.
pub struct Hems {
    is_open: Vec<bool>,
}

impl Hems {
    /// `bands` are the pieces of bands that are sewn last. `up` tells which way is up on a piece, as a unit vector.
    pub fn new(layout: &Layout, names: &dyn Names, bands: &[usize], up: &dyn Fn(usize) -> Vec2) -> Self {
        let mut is_open = vec![false; layout.atoms.len()];
        let low = LegWeights::default().hem;
        for panel in layout.panels.iter().filter(|p| bands.iter().any(|band| names.ends(*band, p.piece))) {
            let up = up(panel.piece);
            let heights = || panel.atoms.clone().flat_map(|a| &layout.atoms[a].points).map(|p| p.dot(&up));
            let (lowest, highest) = (heights().fold(f64::INFINITY, f64::min), heights().fold(-f64::INFINITY, f64::max));
            for a in panel.atoms.clone() {
                let points = &layout.atoms[a].points;
                let (start, end) = (points[0], points[points.len() - 1]);
                let is_level = (end - start).dot(&up).abs() < FRAC_1_SQRT_2 * (end - start).norm();
                let middle = 0.5 * (start + end).dot(&up);
                is_open[a] = is_level && layout.atoms[a].is_across() && middle < lowest + low * (highest - lowest);
            }
        }
        Self { is_open }
    }

    /// The same, and what lies beyond the buttons of fronts.
    pub fn with_buttons(mut self, layout: &Layout, fronts: &[ButtonFront]) -> Self {
        for (a, atom) in layout.atoms.iter().enumerate() {
            let piece = layout.panels[atom.panel].piece;
            self.is_open[a] |= fronts.iter().any(|f| f.piece == piece && f.is_beyond(&atom.points));
        }
        self
    }

    /// Does an atom stay open?
    pub fn has(&self, atom: usize) -> bool {
        self.is_open[atom]
    }
}
