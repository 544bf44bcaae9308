//! Pleats that a pattern draws: two notches on an edge between which the cloth is folded away.
//!
//! Where a line starts at both notches, the lines are folds. Without lines the lengths tell it: an edge across the grain
//! is longer than a whole edge of another piece by just what lies between such notches. So the back of a shirt is longer
//! than its yoke, and the end of a sleeve longer than its cuff.

use super::atoms::{Atom, Layout, Mark};
use super::layout::drawn;
use super::mirror::is_own_image;
use super::profile::{bow, profile};
use super::tuning::{self, PleatWeights};
use crate::roles::outline::Polygon;
use crate::sewing::ring::{arcs, nearest_on};
use crate::sewing::shapes::shapes;
use std::f64::consts::PI;
use toile_garment::dart::DartKind;
use toile_garment::sewing::{DartSpec, PleatPress};
use toile_garment::{Garment, Piece, Vec2};

/// Places on a line at which it is asked whether it lies on the cloth.
const CLIP_STEPS: u32 = 1000;

/// The pleats of a garment, in the order of its pieces. Pieces in `left_out` have none.
#[must_use]
pub fn pleats(garment: &Garment, left_out: &[String]) -> Vec<DartSpec> {
    let Ok(shapes) = shapes(garment) else { return Vec::new() };
    let layout = drawn(garment, &shapes, left_out);
    let sides: Vec<Side> = (0..layout.panels.len()).flat_map(|panel| sides(&layout, panel)).collect();
    let weights = PleatWeights::default();
    let of_side = |side: &Side| {
        let piece = &garment.pieces[layout.panels[side.panel].piece];
        let found = side.drawn(piece, &weights).or_else(|| side.longer(&layout, &sides, &weights)).unwrap_or_default();
        found.into_iter().map(|pleat| (piece.name.clone(), pleat)).collect::<Vec<_>>()
    };
    let pleats: Vec<(String, Pleat)> = sides.iter().flat_map(of_side).collect();
    let spec = |(k, (piece, pleat)): (usize, (String, Pleat))| DartSpec {
        piece,
        name: Some(format!("pleat {}", k + 1)),
        apexes: pleat.ends.map_or_else(Vec::new, |ends| ends.to_vec()),
        mouth: pleat.mouth,
        kind: Some(DartKind::Pleat),
        // Lines are pressed folds. They are sewn at the edge alone.
        press: pleat.ends.map(|_| PleatPress::Knife),
        sewn: pleat.ends.map(|_| 0.0),
        source: None,
    };
    pleats.into_iter().enumerate().map(spec).collect()
}

/// A pleat: its mouth, and the ends of its lines where it has some.
struct Pleat {
    mouth: [Vec2; 2],
    ends: Option<[Vec2; 2]>,
}

/// An edge between two corners.
struct Side {
    panel: usize,
    length: f64,
    is_straight: bool,
    is_across: bool,
    /// Its notches: distance from its start, and place.
    notches: Vec<(f64, Vec2)>,
}

/// The edges of a panel.
fn sides(layout: &Layout, panel: usize) -> Vec<Side> {
    let atoms: Vec<usize> = layout.panels[panel].atoms.clone().collect();
    let is_corner = |a: &usize| {
        let joint = layout.atoms[*a].joint;
        joint.mark == Mark::Dart || (joint.angle - PI).abs() > tuning::CLEAR_CORNER
    };
    let n = atoms.len();
    let Some(first) = (0..n).find(|k| is_corner(&atoms[*k])) else { return Vec::new() };
    let turned: Vec<usize> = (0..n).map(|k| atoms[(first + k) % n]).collect();
    turned.chunk_by(|_, b| !is_corner(b)).map(|run| Side::of(layout, panel, run)).collect()
}

impl Side {
    fn of(layout: &Layout, panel: usize, run: &[usize]) -> Self {
        let atoms = || run.iter().map(|a| &layout.atoms[*a]);
        let points: Vec<Vec2> = atoms().flat_map(|a| a.points.iter().copied()).collect();
        let chord = (points[points.len() - 1] - points[0]).try_normalize(1e-9).unwrap_or_default();
        let weights = PleatWeights::default();
        let mut notches = Vec::new();
        let mut way = 0.0;
        for (k, atom) in atoms().enumerate() {
            if k > 0 && atom.joint.is_notched {
                notches.push((way, atom.points[0]));
            }
            way += atom.length;
        }
        Self {
            panel,
            length: way,
            is_straight: bow(&profile(&points)) < weights.straight,
            is_across: chord.dot(&layout.panels[panel].warp).abs() < weights.across,
            notches,
        }
    }

    /// Pleats by the lines that start at their notches. All such notches are of pleats, in their order by twos.
    fn drawn(&self, piece: &Piece, weights: &PleatWeights) -> Option<Vec<Pleat>> {
        let lined: Vec<(f64, Vec2, Vec2)> =
            self.notches.iter().filter_map(|(way, at)| Some((*way, *at, line_from(piece, *at, weights)?))).collect();
        let is_pleat = |two: &[(f64, Vec2, Vec2)]| {
            let [(from, _, end), (to, _, other)] = two else { return false };
            let width = to - from;
            weights.width.contains(&width) && ((other - end).norm() / width - 1.0).abs() < weights.parallel
        };
        let are_pleats = !lined.is_empty() && lined.chunks(2).all(is_pleat);
        let pleat = |two: &[(f64, Vec2, Vec2)]| Pleat { mouth: [two[0].1, two[1].1], ends: Some([two[0].2, two[1].2]) };
        are_pleats.then(|| lined.chunks(2).map(pleat).collect())
    }

    /// Pleats by lengths: equal widths between notches that follow one another make just what the edge has more than
    /// another one.
    fn longer(&self, layout: &Layout, sides: &[Self], weights: &PleatWeights) -> Option<Vec<Pleat>> {
        if !self.is_straight || !self.is_across || layout.panels[self.panel].slenderness < tuning::BAND {
            return None;
        }
        let length = |panel: usize| layout.panels[panel].perimeter;
        let is_other = |s: &&Self| (length(s.panel) / length(self.panel) - 1.0).abs() > tuning::SAME_PIECE;
        let others: Vec<f64> = sides.iter().filter(is_other).filter(|s| s.is_straight).map(|s| s.length).collect();
        let has = |wanted: f64| others.iter().any(|l| (l - wanted).abs() < weights.exact);
        if has(self.length) {
            return None;
        }
        // A stretch between marks that is as long as one of another piece is sewn to it.
        let is_sewn = |width: f64| {
            let is_marked = |a: &Atom| !a.joint.is_corner() && !layout.atoms[a.next].joint.is_corner();
            let is_even = |a: &Atom| is_marked(a) && (a.length - width).abs() < weights.exact;
            let mut others =
                layout.atoms.iter().filter(|a| (length(a.panel) / length(self.panel) - 1.0).abs() > tuning::SAME_PIECE);
            width > weights.narrow && others.any(is_even)
        };
        // A pleat alone on a piece that is its own mirror image lies in its middle.
        let is_symmetric = is_own_image(layout, &layout.panels[self.panel]);
        let widths = self.notches.windows(2).map(|two| two[1].0 - two[0].0).filter(|width| !is_sewn(*width));
        let sets = widths.map(|width| self.as_wide(width, weights));
        let fits = sets.filter(|set| {
            let width: f64 = set.iter().map(|[from, to]| to.0 - from.0).sum();
            let is_placed = set.len() > 1 || !is_symmetric || set.iter().all(|pleat| self.is_in_the_middle(pleat));
            !set.is_empty() && is_placed && width < weights.most * self.length && has(self.length - width)
        });
        let best = fits.max_by_key(Vec::len)?;
        Some(best.iter().map(|[from, to]| Pleat { mouth: [from.1, to.1], ends: None }).collect())
    }

    fn is_in_the_middle(&self, [from, to]: &[(f64, Vec2); 2]) -> bool {
        (from.0 + to.0 - self.length).abs() < tuning::SAME_PLACE
    }

    /// All places of one width between neighbouring notches, each notch used once.
    fn as_wide(&self, width: f64, weights: &PleatWeights) -> Vec<[(f64, Vec2); 2]> {
        let mut out: Vec<[(f64, Vec2); 2]> = Vec::new();
        if !weights.width.contains(&width) {
            return out;
        }
        for two in self.notches.windows(2) {
            let is_free = out.last().is_none_or(|last| last[1].0 < two[0].0);
            if is_free && (two[1].0 - two[0].0 - width).abs() < weights.exact {
                out.push([two[0], two[1]]);
            }
        }
        out
    }
}

/// The far end of a line inside a piece that starts at a notch, or passes it on its way to the cut line.
fn line_from(piece: &Piece, at: Vec2, weights: &PleatWeights) -> Option<Vec2> {
    let lines = piece.internal_lines.iter().filter(|l| !l.closed).map(|l| l.positions());
    let starts = lines.filter(|points| points.len() > 1).filter_map(|points| {
        let off = nearest_on(&points, &arcs(&points, false), false, at).1;
        let (first, last) = (points[0], points[points.len() - 1]);
        let far = if (first - at).norm() > (last - at).norm() { first } else { last };
        (off < weights.beside && (far - at).norm() > weights.line_least).then_some(far)
    });
    let far = starts.max_by(|p, q| (p - at).norm().total_cmp(&(q - at).norm()))?;
    Some(on_cloth(&Polygon::of(piece), at, far))
}

/// The end of a line that may go on to the cut line, on the cloth that is sewn.
fn on_cloth(outline: &Polygon, from: Vec2, to: Vec2) -> Vec2 {
    let way = |share: f64| from + (to - from) * share;
    let is_on = |share: &f64| outline.contains(way(*share));
    let mut shares = (1..=CLIP_STEPS).rev().map(|k| f64::from(k) / f64::from(CLIP_STEPS));
    shares.find(is_on).map_or(to, way)
}
