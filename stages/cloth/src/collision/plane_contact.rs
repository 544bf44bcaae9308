//! One contact for each plane of a body.
//!
//! Over the edge between two coplanar faces one face holds a cloth vertex, the one it is over. If both faces held it,
//! it would stand higher there. Cloth that slides across would then catch on an edge that does not exist.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::culling::coplanar_faces::NO_FACE;
use crate::collision::narrow_phase::distance::point_triangle;

/// Squares of distances that differ by less than this share are one place, computed from two faces. It bounds
/// rounding.
const SAME_PLACE_TOLERANCE: f64 = 1e-12;

impl Body {
    /// Is another face of the same plane nearer to a point than face `g`? Of two faces at the same distance the lower
    /// number counts as nearer.
    ///
    /// `weights` are the barycentric weights of the nearest place in `g`, and `d` is the vector from that place to
    /// `p`. A plane then pushes once, also beyond its rim, and without a jump when a vertex passes from one face to
    /// the next.
    pub fn has_nearer_coplanar_face(&self, g: u32, weights: &[f64; 3], p: &Vec3, d: &Vec3) -> bool {
        if self.coplanar.is_empty() {
            return false;
        }
        let square = d.norm_squared();
        let nearer = |h: u32| {
            let [a, b, c] = self.triangle(h);
            let w = point_triangle(p, &a, &b, &c);
            let other = (p - (a * w[0] + b * w[1] + c * w[2])).norm_squared();
            other < square * (1.0 - SAME_PLACE_TOLERANCE) || (other <= square * (1.0 + SAME_PLACE_TOLERANCE) && h < g)
        };
        let zero = |k: usize| weights[k] == 0.0;
        match (0..3).filter(|k| zero(*k)).count() {
            0 => false,
            1 => {
                let side = (0..3).find(|k| zero(*k)).map_or(0, |k| (k + 1) % 3);
                Some(self.coplanar[g as usize][side]).filter(|h| *h != NO_FACE).is_some_and(nearer)
            }
            _ => {
                let corner = (0..3).find(|k| !zero(*k)).unwrap_or(0);
                self.coplanar_around(g, corner, 1).any(nearer) || self.coplanar_around(g, corner, 2).any(nearer)
            }
        }
    }

    /// The coplanar faces around a corner of face `g`, in the order from one of its two sides.
    fn coplanar_around(&self, g: u32, corner: usize, turn: usize) -> impl Iterator<Item = u32> + '_ {
        let vertex = self.topology.faces[g as usize][corner];
        let side = move |f: u32| {
            let k = self.topology.faces[f as usize].iter().position(|v| *v == vertex).unwrap_or(0);
            // A side runs from its corner to the next.
            let through = if turn == 1 { k } else { (k + 2) % 3 };
            Some(self.coplanar[f as usize][through]).filter(|h| *h != NO_FACE && *h != g)
        };
        std::iter::successors(side(g), move |f| side(*f)).take(self.topology.faces.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyMesh;

    /// A level square of two faces beside a third face that rises from it.
    fn body() -> Body {
        let at = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0], [2.0, 0.5, 0.5]];
        let mesh = BodyMesh {
            positions: at.map(|[x, y, z]| Vec3::new(x, y, z)).to_vec(),
            triangles: vec![[0, 2, 1], [0, 3, 2], [1, 2, 4]],
        };
        Body::new(&mesh).unwrap()
    }

    fn holds(body: &Body, p: Vec3) -> Vec<u32> {
        let is_elsewhere = |g: u32| {
            let [a, b, c] = body.triangle(g);
            let w = point_triangle(&p, &a, &b, &c);
            body.has_nearer_coplanar_face(g, &w, &p, &(p - (a * w[0] + b * w[1] + c * w[2])))
        };
        (0..3).filter(|g| !is_elsewhere(*g)).collect()
    }

    #[test]
    fn over_an_edge_in_a_plane_one_face_holds() {
        let body = body();
        assert_eq!(holds(&body, Vec3::new(0.501, 1e-3, 0.499)), [0, 2]);
        assert_eq!(holds(&body, Vec3::new(0.499, 1e-3, 0.501)), [1, 2]);
    }

    #[test]
    fn on_the_edge_itself_its_owner_holds() {
        assert_eq!(holds(&body(), Vec3::new(0.5, 1e-3, 0.5)), [0, 2]);
    }

    #[test]
    fn a_plane_holds_once_also_beyond_its_rim() {
        let body = body();
        for i in -10..=110 {
            for k in -10..=110 {
                let p = Vec3::new(0.01 * f64::from(i) + 1e-4, 1e-3, 0.01 * f64::from(k) - 2e-4);
                let held = holds(&body, p);
                assert_eq!(held.iter().filter(|g| **g < 2).count(), 1, "{p}: {held:?}");
            }
        }
    }
}
