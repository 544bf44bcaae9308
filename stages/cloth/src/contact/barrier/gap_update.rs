//! Contacts that bear a load: where cloth comes to lie under it, and with what load it starts.

use crate::Vec3;
use crate::collision::narrow_phase::pair_kind::PairKind;
use crate::contact::barrier::{Barrier, barrier};
use crate::linear::hessian::FIXED;

/// At rest, a vertex that the body's contact lets nearer than this share of its gap is felt from farther off …
const GAVE_WAY: f64 = 0.8;
/// … one that began with its load: nearer than this. Moved out in every drape, a strip that is pulled round a cylinder little by
/// little is stretched and slips each time, and loses up to 7 % of its tension.
const GAVE_WAY_AGAIN: f64 = 0.6;
/// They are so by at most so many gaps.
const FARTHEST: f64 = 1.5;
/// Nearer than so many gaps, cloth that starts in balance lies on the body.
const LIES: f64 = 1.02;

impl Barrier {
    /// Lets the body's contacts push from farther off where they gave way under their load, so that the cloth comes to lie
    /// where its gap says: what is stretched round the body would have too small a girth. The load is the same as here, and
    /// nothing gets stiffer. Says whether any did.
    pub fn bear(&mut self, x: &[Vec3], unknown: &[u32]) -> bool {
        let mut farther = vec![0.0f64; self.area.len()];
        for t in self.touches.iter().filter(|t| t.key.0 == PairKind::VertexBodyTriangle) {
            let v = t.vertices[0] as usize;
            let gap = self.wanted[v];
            let share = if self.loaded[v] { GAVE_WAY_AGAIN } else { GAVE_WAY };
            if t.distance < share * gap && unknown[v] != FIXED {
                farther[v] = farther[v].max(reaching(t.distance, t.gap, gap).min((1.0 + FARTHEST) * gap));
            }
        }
        let any = farther.iter().any(|f| *f > 0.0);
        if any {
            self.frame.body_gap.iter_mut().zip(&farther).for_each(|(g, f)| *g = g.max(*f));
            self.relist(x);
        }
        any
    }

    /// Loads the contacts of cloth that lies on the body at the start with what holds it in balance, `forces` on the unknowns
    /// being all that acts: cloth that was draped before comes without the loads of its contacts, and would lose its
    /// friction in the first steps. Says whether any of it lies there.
    pub fn preload(&mut self, x: &[Vec3], forces: &[Vec3], unknown: &[u32]) -> bool {
        let mut any = false;
        for (vertex, pushes) in self.lying(x) {
            let v = vertex as usize;
            if unknown[v] == FIXED {
                continue;
            }
            let Some(up) = pushes.iter().map(|p| p.1).sum::<Vec3>().try_normalize(0.0) else { continue };
            let k = self.frame.press * self.area[v] * self.hard[v];
            let push = |gap: f64| {
                let of = |(d, n): &(f64, Vec3)| if *d < gap { -k * barrier(*d, gap).1 * n.dot(&up) } else { 0.0 };
                pushes.iter().map(of).sum::<f64>()
            };
            let (pressed, now) = (-forces[unknown[v] as usize].dot(&up), push(self.frame.body_gap[v]));
            any = true;
            if pressed > 0.0 {
                let farthest = (1.0 + FARTHEST) * self.wanted[v];
                self.loaded[v] = true;
                self.frame.body_gap[v] = halved([self.wanted[v], farthest], |g| push(g) < now + pressed);
            }
        }
        if any {
            self.relist(x);
        }
        any
    }

    /// Takes back what [`Self::preload`] did.
    pub fn unload(&mut self, x: &[Vec3]) {
        self.frame.body_gap.clone_from(&self.wanted);
        self.loaded.fill(false);
        self.relist(x);
    }

    /// Vertices that lie on the body, ascending, with the distance and direction of every triangle that they lie on.
    fn lying(&self, x: &[Vec3]) -> Vec<(u32, Vec<(f64, Vec3)>)> {
        let mut list: Vec<(u32, Vec<(f64, Vec3)>)> = Vec::new();
        let Some(body) = &self.body else { return list };
        for (g, _) in self.against.point_gaps(x, body) {
            let (v, d) = (g.vertices[0], g.d.norm());
            if g.aside || d <= 0.0 || d > LIES * self.wanted[v as usize] {
                continue;
            }
            match list.last_mut().filter(|l| l.0 == v) {
                Some((_, pushes)) => pushes.push((d, g.d / d)),
                None => list.push((v, vec![(d, g.d / d)])),
            }
        }
        list
    }
}

/// The gap whose barrier pushes at `to` as that of `gap` does at `d`.
fn reaching(d: f64, gap: f64, to: f64) -> f64 {
    let push = -barrier(d, gap).1;
    halved([to, 4.0 * to.max(gap)], |g| -barrier(to, g).1 < push)
}

/// The place between two up to which something is `less`.
pub(crate) fn halved([mut low, mut high]: [f64; 2], less: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if less(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BodyMesh;
    use crate::collision::body::Body;
    use crate::contact::lagged_friction::Stick;
    use crate::contact::parameters::Frame;
    use crate::scene::topology::Topology;

    const GAP: f64 = 1e-3;

    /// A triangle of cloth on a large one of a body, at its gap.
    fn lying() -> (Barrier, Vec<Vec3>) {
        let mesh = BodyMesh {
            positions: vec![Vec3::new(-1.0, 0.0, -1.0), Vec3::new(0.0, 0.0, 2.0), Vec3::new(1.0, 0.0, -1.0)],
            triangles: vec![[0, 1, 2]],
        };
        let frame = Frame::plain(Topology::new(3, vec![[0, 1, 2]]), vec![GAP; 3], vec![0.0; 3], 0.01);
        let frame = Frame { friction: vec![0.5; 3], ..frame };
        let x = vec![Vec3::new(0.0, GAP, 0.0), Vec3::new(0.0, GAP, 0.01), Vec3::new(0.01, GAP, 0.0)];
        let mut barrier = Barrier::new(frame, Body::new(&mesh), vec![2e-5; 3], None);
        barrier.cover(&x, &[Vec3::zeros(); 3]);
        (barrier, x)
    }

    /// What presses on the body and pulls along it is held at once, by contacts and by friction.
    #[test]
    fn cloth_in_balance_starts_with_the_loads_of_its_contacts() {
        let (mut b, x) = lying();
        let pressed = Vec3::new(1e-4, -1e-3, 0.0);
        let forces = [pressed, Vec3::new(0.0, 1e-3, 0.0), pressed];
        assert!(b.preload(&x, &forces, &[0, 1, FIXED]));
        let mut held = [Vec3::zeros(); 3];
        b.evaluate(&x, &mut held);
        let mut stick = Stick::default();
        stick.refresh(&x, &b.touches, b.frame.press);
        assert_eq!(
            b.touches.iter().map(|t| t.vertices[0]).collect::<Vec<_>>(),
            [0],
            "lifted and held ones bear nothing"
        );
        let all: Vec<Vec3> = forces.iter().zip(&held).map(|(f, h)| f + h).collect();
        stick.take_up(all, &[0, 1, FIXED]);
        stick.evaluate(&x, &mut held);
        assert!((held[0] + pressed).norm() < 1e-8, "{:?}", held[0]);
        b.unload(&x);
        b.evaluate(&x, &mut held);
        assert!(b.touches.is_empty());
    }
}
