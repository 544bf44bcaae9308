//! Fronts that are closed by buttons: both lie over each other, with the buttons on a line inside.
//!
//! A front that is cut twice has the centre line drawn as an inner line, and holes along it. What lies beyond that line
//! laps under or over, and is sewn to nothing.

use super::tuning::ButtonWeights;
use crate::sewing::ring::{arcs, nearest_on};
use toile_garment::{Garment, Piece, Vec2};

/// A front with its buttons.
#[derive(Clone, Debug, PartialEq)]
pub struct ButtonFront {
    /// Index of the piece in the garment.
    pub piece: usize,
    /// The places of the buttons, along the line.
    pub buttons: Vec<Vec2>,
    /// Unit direction of the line.
    pub along: Vec2,
    /// Unit direction from the line to the edge of the front.
    pub beyond: Vec2,
    /// The line at which what is drawn beyond is folded in as a facing.
    pub fold: Option<[Vec2; 2]>,
}

impl ButtonFront {
    /// Does a stretch of outline lie beyond the buttons?
    pub fn is_beyond(&self, points: &[Vec2]) -> bool {
        let off = |p: &Vec2| (p - self.buttons[0]).dot(&self.beyond);
        points.iter().all(|p| off(p) > ButtonWeights::default().on_line)
    }
}

/// The fronts of a garment that are closed by buttons. They are pieces with a mirrored copy, and the copies.
#[must_use]
pub fn button_fronts(garment: &Garment) -> Vec<ButtonFront> {
    let copies = || garment.plan.copies.iter().filter(|c| c.mirror);
    let is_pair = |name: &str| copies().any(|c| c.piece == name || c.name == name);
    let all = garment.pieces.iter().enumerate().filter(|(_, p)| is_pair(&p.name));
    all.filter_map(|(index, piece)| front(index, piece)).collect()
}

fn front(index: usize, piece: &Piece) -> Option<ButtonFront> {
    let weights = ButtonWeights::default();
    let outline = piece.outline.positions();
    let warp = piece.warp();
    let height = |points: &[Vec2]| {
        let ways = points.iter().map(|p| p.dot(&warp));
        let (low, high) = ways.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), way| (l.min(way), h.max(way)));
        high - low
    };
    let least = weights.height * height(&outline);
    let is_upright = |line: &[Vec2]| {
        let chord = line[line.len() - 1] - line[0];
        chord.dot(&warp).abs() > weights.upright * chord.norm() && height(line) > least
    };
    let lines: Vec<Vec<Vec2>> = piece.internal_lines.iter().filter(|l| !l.closed).map(|l| l.positions()).collect();
    let lines: Vec<&Vec<Vec2>> = lines.iter().filter(|l| l.len() > 1 && is_upright(l)).collect();
    let holes = |line: &Vec<Vec2>| -> Vec<Vec2> {
        let is_on = |at: &Vec2| nearest_on(line, &arcs(line, false), false, *at).1 < weights.on_line;
        piece.drill_holes.iter().map(|d| d.at).filter(is_on).collect()
    };
    let (line, buttons) = lines.iter().map(|l| (*l, holes(l))).max_by_key(|(_, holes)| holes.len())?;
    let along = (line[line.len() - 1] - line[0]).try_normalize(1e-9)?;
    let across = Vec2::new(-along.y, along.x);
    let off = |p: &Vec2| (p - line[0]).dot(&across);
    let (left, right) = outline.iter().map(&off).fold((0.0, 0.0), |(l, r), d| (f64::max(l, d), f64::max(r, -d)));
    let (beyond, reach) = if left < right { (across, left) } else { (-across, right) };
    if buttons.len() < weights.least || !weights.reach.contains(&reach) {
        return None;
    }
    let out = |p: &Vec2| (p - line[0]).dot(&beyond);
    let is_fold = |l: &&&Vec<Vec2>| {
        let ends = [out(&l[0]), out(&l[l.len() - 1])];
        ends.iter().all(|off| *off > weights.on_line && *off < reach - weights.on_line)
    };
    let fold = lines.iter().find(is_fold).map(|l| [l[0], l[l.len() - 1]]);
    Some(ButtonFront { piece: index, buttons, along, beyond, fold })
}
