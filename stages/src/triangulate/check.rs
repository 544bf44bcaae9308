//! Checks of a mesh before it leaves the stage.

use super::codes;
use super::edge_use::triangles_at;
use super::layout::Layout;
use super::smooth::{cross, least_angle};
use crate::sewing::shapes::mm;
use toile_garment::{Diagnostic, Piece, Vec2};

/// Angles the mesh promises away from drawn angles.
const PROMISED: f64 = 30.0;
/// Triangles of less height than this part of their longest edge have no area for the solver.
const FLAT: f64 = 2e-9;
/// Lines that meet at less than this make sharp triangles whatever is done.
const SHARP: f64 = 62.0;

/// Figures of one piece's mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Least angle away from drawn angles, degrees.
    pub least_angle: f64,
    /// Triangles below 30° away from drawn angles.
    pub below: usize,
    /// Middle of the worst such triangle, metres.
    pub worst_at: Option<Vec2>,
    /// Triangles that are turned over or have no area.
    pub reversed: usize,
    /// Drawn edges that bound the cloth and have not exactly one triangle.
    pub lost: usize,
    /// Mesh area over the area of the sampled outline, minus one.
    pub area_error: f64,
}

/// Measures a mesh.
pub fn quality(layout: &Layout, points: &[Vec2], triangles: &[[u32; 3]]) -> Quality {
    let sharp = sharp_vertices(layout);
    let mut out = Quality { least_angle: 180.0, ..Quality::default() };
    let mut area = 0.0;
    for t in triangles {
        let [a, b, c] = t.map(|v| points[v as usize]);
        let double = cross(a, b, c);
        area += 0.5 * double;
        let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
        out.reversed += usize::from(double <= FLAT * longest);
        if t.iter().any(|v| sharp.binary_search(v).is_ok()) {
            continue;
        }
        let angle = least_angle(a, b, c).to_degrees();
        out.below += usize::from(angle < PROMISED);
        if angle < out.least_angle {
            out.least_angle = angle;
            out.worst_at = Some((a + b + c) / 3.0);
        }
    }
    let drawn = layout.area();
    out.area_error = if drawn > 0.0 { area / drawn - 1.0 } else { 0.0 };
    out.lost = triangles_at(triangles, &layout.boundary()).into_iter().filter(|count| *count != 1).count();
    out
}

/// Vertices at which two lines leave at a small angle.
pub fn sharp_vertices(layout: &Layout) -> Vec<u32> {
    let mut ways: Vec<(u32, f64)> = Vec::new();
    for k in 0..layout.chains.len() {
        for [a, b] in layout.edges(k) {
            let d = layout.points[b as usize] - layout.points[a as usize];
            ways.push((a, libm::atan2(d.y, d.x)));
            ways.push((b, libm::atan2(-d.y, -d.x)));
        }
    }
    ways.sort_by(|x, y| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)));
    let mut out = Vec::new();
    for group in ways.chunk_by(|x, y| x.0 == y.0) {
        let n = group.len();
        let sharp = (0..n).any(|i| {
            let turn =
                if i + 1 < n { group[i + 1].1 - group[i].1 } else { group[0].1 + std::f64::consts::TAU - group[i].1 };
            turn < SHARP.to_radians() && n > 1 && turn > 0.0
        });
        if sharp {
            out.push(group[0].0);
        }
    }
    out
}

/// Findings for a piece's mesh; an error where the mesh is wrong.
pub fn findings(piece: &Piece, q: &Quality, draft: bool) -> Vec<Diagnostic> {
    let mut out = Vec::new();
    if q.reversed > 0 || q.lost > 0 || q.area_error.abs() > 1e-9 {
        let message = format!(
            "piece `{}`: the mesh has {} triangles without area, lacks {} drawn edges, and its area is {:.1e} off",
            piece.name, q.reversed, q.lost, q.area_error
        );
        let wrong = if draft {
            Diagnostic::error(codes::DRAFT_MESH_WRONG, message).hint("take with.mesher = \"regular\" for this pattern")
        } else {
            Diagnostic::error(codes::MESH_WRONG, message)
        };
        out.push(wrong.at(piece.source.clone()));
    }
    if !draft && q.below > 0 {
        let at = q.worst_at.map_or(String::new(), |p| format!(" at {}", mm(p)));
        let message = format!(
            "piece `{}`: {} triangles below {PROMISED}°, least angle {:.1}°{at}: short edges or narrow strips",
            piece.name, q.below, q.least_angle
        );
        out.push(Diagnostic::info(codes::MESH_ANGLE_LOW, message).at(piece.source.clone()));
    }
    out
}
