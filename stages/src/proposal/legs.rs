//! Where the edges of trouser legs lie. A leg meets the other one on the rise alone: from the crotch up to the waist.
//! A waistband meets its waist alone.

use super::atoms::{Layout, Panel};
use super::pairs::Pair;
use super::propose::Names;
use super::tuning::{self, LegWeights};
use std::f64::consts::FRAC_1_SQRT_2;
use toile_garment::Vec2;

/// The part of a leg on which an edge lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Zone {
    Hem,
    BelowCrotch,
    Rise,
    Waist,
}

/// For every atom of a leg its zone; none where that is not known, and on other pieces.
pub struct Legs {
    zones: Vec<Option<Zone>>,
}

impl Legs {
    /// `up` tells which way is up on a piece, as a unit vector.
    pub fn new(layout: &Layout, names: &dyn Names, up: &dyn Fn(usize) -> Vec2) -> Self {
        let mut zones = vec![None; layout.atoms.len()];
        for panel in layout.panels.iter().filter(|p| names.is_leg(p.piece)) {
            let Some(rise) = Rise::of(layout, panel, up(panel.piece)) else { continue };
            panel.atoms.clone().for_each(|a| zones[a] = Some(rise.zone(&layout.atoms[a].points)));
        }
        Self { zones }
    }

    /// Added to the score of a pair. `are_images` tells whether the middle of the garment may lie between the two.
    pub fn score(&self, layout: &Layout, names: &dyn Names, pair: Pair, are_images: bool) -> f64 {
        let weights = LegWeights::default();
        let [p, q] = [pair.a, pair.b].map(|a| layout.panels[layout.atoms[a].panel].piece);
        let gather = libm::log(layout.atoms[pair.a].length / layout.atoms[pair.b].length).abs();
        let fits = |zone: Zone| zone == Zone::Waist && gather < tuning::SET_ON_GATHER;
        match [self.zones[pair.a], self.zones[pair.b]] {
            [Some(zone), None] if names.is_waistband(q) && !fits(zone) => weights.off_waist,
            [None, Some(zone)] if names.is_waistband(p) && !fits(zone) => weights.off_waist,
            // A hem is open, but for what goes on below it.
            [Some(Zone::Hem), Some(zone)] | [Some(zone), Some(Zone::Hem)] if zone != Zone::Waist => weights.hem_closed,
            [Some(a), Some(b)] if names.are_namesakes(p, q) => match [a, b] {
                [Zone::Rise, Zone::Rise] if are_images => weights.rise,
                [Zone::Rise, Zone::Rise] => 0.0,
                _ => weights.off_rise,
            },
            _ => 0.0,
        }
    }
}

/// The part of a leg between the crotch and the waist.
struct Rise {
    up: Vec2,
    /// Heights of the hem, of the crotch and of the waist, metres along `up`.
    hem: f64,
    crotch: f64,
    waist: f64,
}

impl Rise {
    /// The crotch is the widest place of a leg, on the side that is not flared. A leg that is flared on both sides is widest
    /// at the hem, and tells nothing.
    fn of(layout: &Layout, panel: &Panel, up: Vec2) -> Option<Self> {
        let right = Vec2::new(up.y, -up.x);
        let points = || panel.atoms.clone().flat_map(|a| layout.atoms[a].points.iter().copied());
        let height = |p: &Vec2| p.dot(&up);
        let farthest = |way: Vec2| points().max_by(|p, q| p.dot(&way).total_cmp(&q.dot(&way)));
        let [hem, waist] = [-up, up].map(|way| farthest(way).map(|p| height(&p)));
        let (hem, waist) = (hem?, waist?);
        let is_flared = |at: &f64| at - hem < LegWeights::default().flared * (waist - hem);
        let sides = [height(&farthest(right)?), height(&farthest(-right)?)];
        let crotch = sides.into_iter().filter(|at| !is_flared(at)).min_by(f64::total_cmp)?;
        Some(Self { up, hem, crotch, waist })
    }

    /// The zone of an edge, by its middle and its slope.
    fn zone(&self, points: &[Vec2]) -> Zone {
        let (start, end) = (points[0], points[points.len() - 1]);
        let middle = 0.5 * (start + end).dot(&self.up);
        let is_level = (end - start).dot(&self.up).abs() < FRAC_1_SQRT_2 * (end - start).norm();
        if is_level && middle < self.hem + LegWeights::default().hem * (self.waist - self.hem) {
            Zone::Hem
        } else if middle <= self.crotch {
            Zone::BelowCrotch
        } else if is_level && middle > 0.5 * (self.crotch + self.waist) {
            Zone::Waist
        } else {
            Zone::Rise
        }
    }
}
