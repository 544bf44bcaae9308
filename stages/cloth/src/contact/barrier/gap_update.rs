//! Gap update: loaded contacts of the body act from farther off, so that the cloth comes to rest at its gap.
//!
//! This is an augmented Lagrangian by distance: the load stays, and no contact becomes stiffer. Cloth that starts
//! in balance gets its contact loads in the same way. `optimize/mechanisms/gap_update.rs` says when.

use crate::Vec3;
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::contact::barrier::Barrier;
use crate::contact::barrier::potential::{barrier, bisect, equivalent_activation_distance};
use crate::contact::tuning::{GAP_INCREASE_LIMIT, GAP_UPDATE_SHARE, GAP_UPDATE_SHARE_WARM, RESTING_GAP_LIMIT};
use crate::linear::hessian::FIXED;

/// A vertex that lies on the body, with distance, m, and direction from each triangle that it lies on.
type RestingVertex = (u32, Vec<(f64, Vec3)>);

impl Barrier {
    /// Enlarges the gap of the body's contacts that gave way under their load. Returns whether any gap changed.
    ///
    /// The same load then stands at the wanted gap. Otherwise cloth that is stretched round the body would have too
    /// small a girth.
    pub fn update_gaps(&mut self, x: &[Vec3], unknown: &[u32]) -> bool {
        let (cold, warm, most) = (GAP_UPDATE_SHARE.get(), GAP_UPDATE_SHARE_WARM.get(), 1.0 + GAP_INCREASE_LIMIT.get());
        let mut enlarged = vec![0.0f64; self.vertices.area.len()];
        for t in self.contacts.iter().filter(|t| t.key.0 == PairKind::VertexBodyTriangle) {
            let v = t.vertices[0] as usize;
            let gap = self.vertices.wanted_gap[v];
            let share = if self.vertices.is_warm_started[v] { warm } else { cold };
            if t.distance < share * gap && unknown[v] != FIXED {
                let new = equivalent_activation_distance(t.distance, t.activation_distance, gap);
                enlarged[v] = enlarged[v].max(new.min(most * gap));
            }
        }
        let any = enlarged.iter().any(|f| *f > 0.0);
        if any {
            self.parameters.body_gap.iter_mut().zip(&enlarged).for_each(|(g, f)| *g = g.max(*f));
            self.rebuild_lists(x);
        }
        any
    }

    /// Loads the contacts of cloth that lies on the body with what holds it in balance. Returns whether any cloth
    /// lies there.
    ///
    /// `forces` are all that act on the unknowns, N. Cloth that was draped before comes without the loads of its
    /// contacts, and would lose its friction in the first steps.
    pub fn warm_start_loads(&mut self, x: &[Vec3], forces: &[Vec3], unknown: &[u32]) -> bool {
        let mut any = false;
        for (vertex, pushes) in self.resting_vertices(x) {
            let v = vertex as usize;
            if unknown[v] == FIXED {
                continue;
            }
            let Some(up) = pushes.iter().map(|p| p.1).sum::<Vec3>().try_normalize(0.0) else { continue };
            let k = self.parameters.stiffness * self.vertices.area[v] * self.vertices.stiffening[v];
            let push = |gap: f64| {
                let of = |(d, n): &(f64, Vec3)| if *d < gap { -k * barrier(*d, gap).1 * n.dot(&up) } else { 0.0 };
                pushes.iter().map(of).sum::<f64>()
            };
            let (load, now) = (-forces[unknown[v] as usize].dot(&up), push(self.parameters.body_gap[v]));
            any = true;
            if load > 0.0 {
                let wanted = self.vertices.wanted_gap[v];
                let farthest = (1.0 + GAP_INCREASE_LIMIT.get()) * wanted;
                self.vertices.is_warm_started[v] = true;
                self.parameters.body_gap[v] = bisect([wanted, farthest], |g| push(g) < now + load);
            }
        }
        if any {
            self.rebuild_lists(x);
        }
        any
    }

    /// Undoes [`Self::warm_start_loads`].
    pub fn undo_warm_start(&mut self, x: &[Vec3]) {
        self.parameters.body_gap.clone_from(&self.vertices.wanted_gap);
        self.vertices.is_warm_started.fill(false);
        self.rebuild_lists(x);
    }

    /// Vertices that lie on the body, in ascending order.
    fn resting_vertices(&self, x: &[Vec3]) -> Vec<RestingVertex> {
        let mut list: Vec<RestingVertex> = Vec::new();
        let Some(body) = &self.body else { return list };
        let limit = RESTING_GAP_LIMIT.get();
        for (g, _) in self.lists.body.point_gaps(x, body) {
            let (v, d) = (g.vertices[0], g.separation.norm());
            if g.is_redundant || d <= 0.0 || d > limit * self.vertices.wanted_gap[v as usize] {
                continue;
            }
            match list.last_mut().filter(|l| l.0 == v) {
                Some((_, pushes)) => pushes.push((d, g.separation / d)),
                None => list.push((v, vec![(d, g.separation / d)])),
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyMesh;
    use crate::collision::body::Body;
    use crate::collision::narrow_phase::candidates::PairGeometry;
    use crate::contact::barrier::active_contact::add_if_active;
    use crate::contact::barrier::potential::resting_distance;
    use crate::contact::lagged_friction::LaggedFriction;
    use crate::contact::parameters::ContactParameters;
    use crate::scene::topology::Topology;

    const GAP: f64 = 1e-3;

    /// A triangle of cloth on a large triangle of a body, at its gap.
    fn resting_triangle() -> (Barrier, Vec<Vec3>) {
        let mesh = BodyMesh {
            positions: vec![Vec3::new(-1.0, 0.0, -1.0), Vec3::new(0.0, 0.0, 2.0), Vec3::new(1.0, 0.0, -1.0)],
            triangles: vec![[0, 1, 2]],
        };
        let parameters = ContactParameters::plain(Topology::new(3, vec![[0, 1, 2]]), vec![GAP; 3], vec![0.0; 3], 0.01);
        let parameters = ContactParameters { friction: vec![0.5; 3], ..parameters };
        let x = vec![Vec3::new(0.0, GAP, 0.0), Vec3::new(0.0, GAP, 0.01), Vec3::new(0.01, GAP, 0.0)];
        let mut barrier = Barrier::new(parameters, Body::new(&mesh), vec![2e-5; 3], None);
        barrier.update_lists(&x, &[Vec3::zeros(); 3]);
        (barrier, x)
    }

    /// Contacts and friction balance at once a force that presses on the body and pulls along it.
    #[test]
    fn cloth_in_balance_starts_with_the_loads_of_its_contacts() {
        let (mut b, x) = resting_triangle();
        let pressed = Vec3::new(1e-4, -1e-3, 0.0);
        let forces = [pressed, Vec3::new(0.0, 1e-3, 0.0), pressed];
        assert!(b.warm_start_loads(&x, &forces, &[0, 1, FIXED]));
        let mut held = [Vec3::zeros(); 3];
        b.evaluate(&x, &mut held);
        let mut friction = LaggedFriction::default();
        friction.refresh(&x, &b.contacts, b.parameters.stiffness);
        assert_eq!(
            b.contacts.iter().map(|t| t.vertices[0]).collect::<Vec<_>>(),
            [0],
            "lifted and held vertices bear nothing"
        );
        let all: Vec<Vec3> = forces.iter().zip(&held).map(|(f, h)| f + h).collect();
        friction.balance(all, &[0, 1, FIXED]);
        friction.evaluate(&x, &mut held);
        assert!((held[0] + pressed).norm() < 1e-8, "{:?}", held[0]);
        b.undo_warm_start(&x);
        b.evaluate(&x, &mut held);
        assert!(b.contacts.is_empty());
    }

    /// Cloth that presses with 400 Pa comes to rest at its gap, with the load it had.
    #[test]
    fn a_contact_that_gave_way_pushes_from_farther_off() {
        let (gap, pressure, stiffness) = (1e-3, 400.0, 2e5);
        let parameters = ContactParameters::plain(Topology::default(), vec![gap], vec![gap], 0.01);
        let mut b = Barrier::new(parameters, None, vec![1.0], None);
        let d = resting_distance(gap, pressure, stiffness);
        assert!(d < 0.7 * gap);
        let touch_at = |b: &mut Barrier, height: f64| {
            let separation = Vec3::new(0.0, height, 0.0);
            let (vertices, weights) = ([0; 4], [1.0, 0.0, 0.0, 0.0]);
            let pair = PairGeometry { vertices, weights, separation, is_redundant: false };
            let scales = b.vertices.scales(0.0);
            b.contacts.clear();
            add_if_active(&mut b.contacts, &b.parameters, scales, PairKind::VertexBodyTriangle, &pair);
        };
        touch_at(&mut b, d);
        let x = [Vec3::new(0.0, d, 0.0)];
        assert!(!b.update_gaps(&x, &[FIXED]) && b.update_gaps(&x, &[0]));
        assert!((resting_distance(b.parameters.body_gap[0], pressure, stiffness) / gap - 1.0).abs() < 1e-6);
        touch_at(&mut b, gap);
        assert!(!b.update_gaps(&x, &[0]), "it rests at its gap");
    }
}
