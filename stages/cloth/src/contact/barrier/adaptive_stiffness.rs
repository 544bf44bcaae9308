//! Adaptive barrier stiffness: contacts that are pressed nearly shut become stiffer.
//!
//! A load of tens of kPa, as of tight cloth over a sharp bend, would close a gap to a micrometre. There no step is
//! short enough.

use crate::contact::barrier::Barrier;
use crate::contact::barrier::potential::barrier;
use crate::contact::tuning::{STIFFENING_LIMIT, STIFFENING_PER_CALL, STIFFENING_TARGET, STIFFENING_TRIGGER};
use crate::linear::hessian::FIXED;

impl Barrier {
    /// Stiffens the contacts of unknown vertices that were pressed nearly shut at the last evaluation.
    ///
    /// Such a contact becomes as stiff as holds its load at a larger share of its gap. Returns whether any became
    /// stiffer.
    pub fn stiffen_contacts(&mut self, unknown: &[u32]) -> bool {
        let (trigger, target) = (STIFFENING_TRIGGER.get(), STIFFENING_TARGET.get());
        let mut any = false;
        for t in self.contacts.iter().filter(|t| t.distance < trigger * t.activation_distance) {
            let gap = t.activation_distance;
            let factor = (barrier(t.distance, gap).1 / barrier(target * gap, gap).1).min(STIFFENING_PER_CALL.get());
            let stiffening = (t.stiffening * factor).min(STIFFENING_LIMIT.get());
            for (v, w) in t.vertices.iter().zip(&t.weights) {
                let v = *v as usize;
                if *w != 0.0 && unknown[v] != FIXED && self.vertices.stiffening[v] < stiffening {
                    self.vertices.stiffening[v] = stiffening;
                    any = true;
                }
            }
        }
        any
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec3;
    use crate::collision::narrow_phase::candidates::PairGeometry;
    use crate::collision::narrow_phase::pair_kind::PairKind;
    use crate::contact::barrier::active_contact::add_if_active;
    use crate::contact::barrier::potential::resting_distance;
    use crate::contact::parameters::ContactParameters;

    /// A vertex pressed on the body with 45 kPa stands off it in the end, not at a micrometre.
    #[test]
    fn a_contact_under_high_pressure_stiffens_until_it_stands_off() {
        let (gap, pressure, stiffness) = (5e-4, 45e3, 2e5);
        let parameters = ContactParameters::plain(Default::default(), vec![gap], vec![gap], 0.01);
        let mut b = Barrier::new(parameters, None, vec![1.0], None);
        assert!(resting_distance(gap, pressure, stiffness) < 2e-6);
        for round in 0..8 {
            let d = resting_distance(gap, pressure / b.vertices.stiffening[0], stiffness);
            b.contacts.clear();
            let pair = PairGeometry {
                vertices: [0; 4],
                weights: [1.0, 0.0, 0.0, 0.0],
                separation: Vec3::new(0.0, d, 0.0),
                is_redundant: false,
            };
            let scales = b.vertices.scales(0.0);
            let found = add_if_active(&mut b.contacts, &b.parameters, scales, PairKind::VertexBodyTriangle, &pair);
            assert_eq!(found, d);
            if !b.stiffen_contacts(&[0]) {
                assert!(round > 0 && d > STIFFENING_TRIGGER.get() * gap, "{round} {d}");
                return;
            }
        }
        panic!("never stiff enough");
    }
}
