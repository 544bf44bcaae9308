//! Notches: boundary marks that say what meets what.

use crate::outline::{OutlineEdge, PieceLine};
use crate::{Piece, SourceRef, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shape of a notch (layers 4 and 80 to 83).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum NotchKind {
    /// Cut straight in.
    #[serde(rename = "slit")]
    Slit,
    /// V notch.
    V,
    /// T notch (layer 80).
    T,
    /// Castle notch (layer 81).
    #[serde(rename = "castle")]
    Castle,
    /// Check notch (layer 82).
    #[serde(rename = "check")]
    Check,
    /// U notch (layer 83).
    U,
}

/// A notch of a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Notch {
    /// Shape.
    pub kind: NotchKind,
    /// Position as in the file, metres, piece plane.
    #[schemars(with = "[f64; 2]")]
    pub at: Vec2,
    /// Depth into the cloth, metres.
    pub depth: f64,
    /// Width at the line, metres.
    pub width: f64,
    /// Inward direction, radians from +x, where the file gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// Which line it sits on: `boundary`, `sew`, `internal`, `fold` for a mark on the fold of a piece that was
    /// unfolded, or `off` when none is near.
    pub on: String,
    /// Name, e.g. the matching label of the sewing file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

impl Notch {
    /// Does it sit on the edge of the cloth, or on the line that is sewn?
    #[must_use]
    pub fn is_on_edge(&self) -> bool {
        !matches!(self.on.as_str(), "internal" | "fold" | "off")
    }
}

impl Piece {
    /// Labels of the notches, in the order of the list. `n1` is the first one along the outline from the start of its
    /// first edge, counter-clockwise. Those that lie on no edge follow, in the order of the list. Drawings, tables,
    /// findings and the view name a notch by its piece and its label, such as `FRONT.n1`.
    #[must_use]
    pub fn notch_labels(&self) -> Vec<String> {
        let start = self.edges.first().map_or(0, |e| e.from as usize);
        let key = |n: &Notch| (!n.is_on_edge(), if n.is_on_edge() { way_to(&self.outline, start, n.at) } else { 0.0 });
        let keys: Vec<(bool, f64)> = self.notches.iter().map(key).collect();
        let mut order: Vec<usize> = (0..keys.len()).collect();
        order.sort_by(|a, b| keys[*a].0.cmp(&keys[*b].0).then(keys[*a].1.total_cmp(&keys[*b].1)));
        let mut labels = vec![String::new(); keys.len()];
        order.into_iter().zip(1..).for_each(|(k, number)| labels[k] = format!("n{number}"));
        labels
    }

    /// The notch of a label.
    #[must_use]
    pub fn notch_of(&self, label: &str) -> Option<usize> {
        self.notch_labels().iter().position(|l| l == label)
    }

    /// The edge that a notch lies on, and its way from the start of the edge along the outline, metres.
    #[must_use]
    pub fn edge_of_notch(&self, notch: &Notch) -> Option<(&OutlineEdge, f64)> {
        let start = self.edges.first()?.from as usize;
        let way = if notch.is_on_edge() { way_to(&self.outline, start, notch.at) } else { return None };
        let mut begun = 0.0;
        for (k, edge) in self.edges.iter().enumerate() {
            let length: f64 = self.outline.edge_points(edge).windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            if way < begun + length || k + 1 == self.edges.len() {
                return Some((edge, way - begun));
            }
            begun += length;
        }
        None
    }
}

/// The way along a closed line from one of its points to the place that is nearest to another point, metres.
fn way_to(line: &PieceLine, start: usize, at: Vec2) -> f64 {
    let n = line.points.len();
    let (mut walked, mut best) = (0.0, (f64::INFINITY, 0.0));
    for k in 0..n {
        let [a, b] = [k, k + 1].map(|i| line.points[(start + i) % n].at);
        let step = b - a;
        let share = ((at - a).dot(&step) / step.norm_squared().max(1e-24)).clamp(0.0, 1.0);
        let off = (at - a - step * share).norm();
        if off < best.0 {
            best = (off, walked + share * step.norm());
        }
        walked += step.norm();
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::{LinePoint, PointKind};

    fn notch(on: &str, x: f64, y: f64) -> Notch {
        let (kind, at) = (NotchKind::Slit, Vec2::new(x, y));
        Notch { kind, at, depth: 4e-3, width: 0.0, angle: None, on: on.into(), name: None, source: None }
    }

    /// A square of 1 m whose first edge begins at its second corner. Two of its notches lie on a cut line 10 mm outside.
    fn square() -> Piece {
        let corner = |[x, y]: [f64; 2]| LinePoint { at: Vec2::new(x, y), kind: PointKind::Turn };
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(corner).to_vec();
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        let edge = |k: u32| OutlineEdge { index: k, name: None, from: (k + 1) % 4, to: (k + 2) % 4 };
        let notches = vec![
            notch("boundary", 0.3, -0.01),
            notch("internal", 0.5, 0.5),
            notch("boundary", 1.01, 0.75),
            notch("sew", 0.0, 0.4),
            notch("sew", 1.0, 0.25),
        ];
        Piece { outline, edges: (0..4).map(edge).collect(), notches, ..Piece::default() }
    }

    #[test]
    fn labels_count_along_the_outline_and_those_without_an_edge_come_last() {
        assert_eq!(square().notch_labels(), ["n4", "n5", "n2", "n3", "n1"]);
        assert_eq!((square().notch_of("n3"), square().notch_of("n6")), (Some(3), None));
        assert!(Piece { notches: square().notches, ..Piece::default() }.notch_labels().contains(&"n1".to_owned()));
    }

    #[test]
    fn a_notch_lies_on_an_edge_at_its_way_from_the_start() {
        let piece = square();
        let found = |k: usize| piece.edge_of_notch(&piece.notches[k]).map(|(e, way)| (e.index, (way * 1e6).round()));
        assert_eq!([found(0), found(2), found(3)], [Some((3, 3e5)), Some((0, 7.5e5)), Some((2, 6e5))]);
        assert_eq!(found(1), None);
    }
}
