//! A panel becomes a piece: edges in order, curves as points, right side up.

use super::edges;
use super::spec::{Panel, Spec};
use toile_garment::outline::{LinePoint, OutlineEdge, PieceLine, PointKind};
use toile_garment::{Diagnostic, Piece, Vec2};

/// A piece and how it came about.
#[derive(Debug)]
pub struct Built {
    pub piece: Piece,
    /// Position in the outline of each edge of the file.
    pub place: Vec<usize>,
    /// Was the panel drawn from its wrong side?
    pub mirrored: bool,
    pub rotation: [f64; 3],
    pub translation: [f64; 3],
}

/// Builds the piece, metres.
pub fn piece(panel: &Panel, spec: &Spec, flatness: f64) -> Result<Built, Diagnostic> {
    let fail = |what: String| super::wrong(format!("panel `{}`: {what}", panel.name));
    let order = chained(panel).ok_or_else(|| fail("its edges make no single closed loop".into()))?;
    let mut points: Vec<LinePoint> = Vec::new();
    let mut starts = Vec::new();
    for i in &order {
        let edge = &panel.edges[*i];
        let [a, b] = edge.ends.map(|v| panel.vertices[v]);
        let run = edges::points(a, b, &edge.curve, spec.relative, flatness / spec.unit);
        let run = run.map_err(|why| fail(format!("edge {i}: {why}")))?;
        starts.push(points.len() as u32);
        points.extend(run.into_iter().enumerate().map(|(k, p)| LinePoint {
            at: p * spec.unit,
            kind: if k == 0 { PointKind::Turn } else { PointKind::Plain },
        }));
    }
    let mut outline = PieceLine { points, closed: true, ..PieceLine::default() };
    let area = outline.signed_area();
    if area.abs() < 1e-7 {
        return Err(fail("its outline encloses no area".into()));
    }
    // Mirroring turns the sense of the loop, so the order of its edges stays.
    let mirrored = area < 0.0;
    if mirrored {
        outline.points.iter_mut().for_each(|p| p.at = Vec2::new(-p.at.x, p.at.y));
    }
    let n = order.len();
    let edges = (0..n)
        .map(|k| OutlineEdge {
            index: k as u32,
            name: panel.edges[order[k]].label.clone().filter(|l| unique(panel, l)),
            from: starts[k],
            to: starts[(k + 1) % n],
        })
        .collect();
    let mut place = vec![0; n];
    for (k, i) in order.iter().enumerate() {
        place[*i] = k;
    }
    let piece = Piece {
        name: panel.name.clone(),
        block: panel.name.clone(),
        category: panel.label.clone(),
        edges,
        outline,
        // GarmentCode's y axis is the height of the wearer, and the warp runs along it.
        grain: None,
        ..Piece::default()
    };
    Ok(Built { piece, place, mirrored, rotation: panel.rotation, translation: panel.translation })
}

fn unique(panel: &Panel, label: &str) -> bool {
    panel.edges.iter().filter(|e| e.label.as_deref() == Some(label)).count() == 1
}

/// The edges one after the other round the panel, starting with the first.
fn chained(panel: &Panel) -> Option<Vec<usize>> {
    let n = panel.edges.len();
    let mut next: Vec<Option<usize>> = vec![None; panel.vertices.len()];
    for (i, edge) in panel.edges.iter().enumerate() {
        if next[edge.ends[0]].replace(i).is_some() {
            return None;
        }
    }
    let mut order = vec![0];
    while order.len() < n {
        let at = panel.edges[*order.last()?].ends[1];
        order.push(next[at].filter(|i| *i != 0)?);
    }
    (panel.edges[*order.last()?].ends[1] == panel.edges[0].ends[0]).then_some(order)
}
