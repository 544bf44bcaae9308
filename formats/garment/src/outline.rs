//! Closed outlines and open lines of a piece, with corners and numbered edges.

use crate::{SourceRef, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The kind of a vertex of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PointKind {
    /// A corner, or the end of a run (layer 2).
    Turn,
    /// A point on a smooth curve (layer 3).
    Curve,
    /// A vertex of a dense curve or a plain polygon, not marked in the file.
    Plain,
}

/// One vertex of a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LinePoint {
    /// Position in the piece plane, metres.
    #[schemars(with = "[f64; 2]")]
    pub at: Vec2,
    /// Corner, curve point or plain vertex.
    pub kind: PointKind,
}

/// A line of a piece: closed (outline, cutout, contour dart) or open (internal line, pocket line).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PieceLine {
    /// Vertices in order; a closed line does not repeat its first vertex.
    pub points: Vec<LinePoint>,
    /// Is the last vertex joined to the first?
    pub closed: bool,
    /// Name where the file or the sewing file gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// A run of a closed outline between two neighbouring corners, counter-clockwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OutlineEdge {
    /// Number between corners, from 0, as `toile inspect --svg` draws them.
    pub index: u32,
    /// Name where one was given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Outline vertex at which the edge starts.
    pub from: u32,
    /// Outline vertex at which the edge ends (counter-clockwise from `from`).
    pub to: u32,
}

impl PieceLine {
    /// Positions only.
    #[must_use]
    pub fn positions(&self) -> Vec<Vec2> {
        self.points.iter().map(|p| p.at).collect()
    }

    /// Signed area of a closed line, square metres; positive when counter-clockwise.
    #[must_use]
    pub fn signed_area(&self) -> f64 {
        let n = self.points.len();
        let origin = match self.points.first() {
            Some(p) => p.at,
            None => return 0.0,
        };
        (0..n)
            .map(|i| {
                let a = self.points[i].at - origin;
                let b = self.points[(i + 1) % n].at - origin;
                0.5 * (a.x * b.y - a.y * b.x)
            })
            .sum()
    }

    /// Edges of a closed line between its corners, from the first corner on. A line without a corner is one edge.
    #[must_use]
    pub fn edges(&self) -> Vec<OutlineEdge> {
        let corners: Vec<u32> =
            (0_u32..).zip(&self.points).filter(|(_, p)| p.kind == PointKind::Turn).map(|(i, _)| i).collect();
        let corners = if corners.is_empty() { vec![0] } else { corners };
        let n = corners.len();
        (0..n)
            .map(|i| OutlineEdge { index: i as u32, name: None, from: corners[i], to: corners[(i + 1) % n] })
            .collect()
    }

    /// Points of an edge of a closed line, both ends included. An edge that ends where it begins is the whole line. Empty
    /// where the line lacks its ends.
    #[must_use]
    pub fn edge_points(&self, edge: &OutlineEdge) -> Vec<Vec2> {
        let (n, from, to) = (self.points.len(), edge.from as usize, edge.to as usize);
        if from.max(to) >= n {
            return Vec::new();
        }
        let steps = (to + n - from - 1) % n + 1;
        (0..=steps).map(|k| self.points[(from + k) % n].at).collect()
    }

    /// Length of the line, metres, the closing segment included when closed.
    #[must_use]
    pub fn length(&self) -> f64 {
        let n = self.points.len();
        let segments = if self.closed { n } else { n.saturating_sub(1) };
        (0..segments).map(|i| (self.points[(i + 1) % n].at - self.points[i].at).norm()).sum()
    }
}
