//! One contact for each plane of a body: over the edge between two coplanar faces a cloth vertex is held by the face it is over.
//! Held by both it would stand higher there, and what slides across would catch on an edge that is none.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::culling::coplanar_faces::NONE;
use crate::collision::narrow_phase::distance::point_triangle;

/// Squares of distances that differ by less than this share are the same place, reckoned from two faces.
const SAME: f64 = 1e-12;

impl Body {
    /// Does the plane of face `g` go on where a point comes nearest to it (the place in `g`, told by the corners' weights), to
    /// a face that is nearer? Of two that share the place the first one holds. So a plane pushes once, and without a jump
    /// when a vertex goes from over one face to over the next, also beyond its rim.
    pub fn goes_on(&self, g: u32, weights: &[f64; 3], p: &Vec3, d: &Vec3) -> bool {
        if self.planes.is_empty() {
            return false;
        }
        let square = d.norm_squared();
        let nearer = |h: u32| {
            let [a, b, c] = self.triangle(h);
            let w = point_triangle(p, &a, &b, &c);
            let other = (p - (a * w[0] + b * w[1] + c * w[2])).norm_squared();
            other < square * (1.0 - SAME) || (other <= square * (1.0 + SAME) && h < g)
        };
        let zero = |k: usize| weights[k] == 0.0;
        match (0..3).filter(|k| zero(*k)).count() {
            0 => false,
            1 => {
                let side = (0..3).find(|k| zero(*k)).map_or(0, |k| (k + 1) % 3);
                Some(self.planes[g as usize][side]).filter(|h| *h != NONE).is_some_and(nearer)
            }
            _ => {
                let corner = (0..3).find(|k| !zero(*k)).unwrap_or(0);
                self.around(g, corner, 1).any(nearer) || self.around(g, corner, 2).any(nearer)
            }
        }
    }

    /// The faces of its plane round a corner of face `g`, from one of the two sides there on.
    fn around(&self, g: u32, corner: usize, turn: usize) -> impl Iterator<Item = u32> + '_ {
        let vertex = self.topology.faces[g as usize][corner];
        let side = move |f: u32| {
            let k = self.topology.faces[f as usize].iter().position(|v| *v == vertex).unwrap_or(0);
            // A side runs from its corner to the next.
            let through = if turn == 1 { k } else { (k + 2) % 3 };
            Some(self.planes[f as usize][through]).filter(|h| *h != NONE && *h != g)
        };
        std::iter::successors(side(g), move |f| side(*f)).take(self.topology.faces.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyMesh;

    /// A level square of two faces beside a third that rises from it.
    fn body() -> Body {
        let at = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0], [2.0, 0.5, 0.5]];
        let mesh = BodyMesh {
            positions: at.map(|[x, y, z]| Vec3::new(x, y, z)).to_vec(),
            triangles: vec![[0, 2, 1], [0, 3, 2], [1, 2, 4]],
        };
        Body::new(&mesh).unwrap()
    }

    fn holds(body: &Body, p: Vec3) -> Vec<u32> {
        let goes_on = |g: u32| {
            let [a, b, c] = body.triangle(g);
            let w = point_triangle(&p, &a, &b, &c);
            body.goes_on(g, &w, &p, &(p - (a * w[0] + b * w[1] + c * w[2])))
        };
        (0..3).filter(|g| !goes_on(*g)).collect()
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
