//! Stiffness of contact pairs.

use crate::explicit::contact::pair::ContactPair;
use crate::explicit::tuning::{CONTACT_CROWD, CROWD_SOFTENING};

/// How the stiffness of contacts is chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ContactStiffness {
    /// Stiffness per effective mass, 1/s²: as stiff as the time step bears.
    PerMass(f64),
    /// One stiffness for all contacts, N/m: a penalty.
    Fixed(f64),
}

/// Sets the stiffness of all pairs.
///
/// Where many contacts meet on one vertex each is softened, so that together they stay under the step's limit.
/// `crowd` is a work array of one number per vertex.
pub(crate) fn set_stiffness(
    pairs: &mut [ContactPair],
    stiffness: ContactStiffness,
    inverse_mass: &[f64],
    crowd: &mut Vec<f64>,
) {
    let allowed = if CROWD_SOFTENING.is_on() { CONTACT_CROWD.get() } else { f64::INFINITY };
    count_contacts(pairs, inverse_mass.len(), crowd);
    for p in pairs {
        let most = (0..4).map(|k| crowd[p.vertices[k] as usize]).fold(0.0, f64::max);
        let mobility: f64 = (0..4).map(|k| p.weights[k] * p.weights[k] * inverse_mass[p.vertices[k] as usize]).sum();
        p.stiffness = match stiffness {
            _ if mobility <= 0.0 => 0.0,
            ContactStiffness::Fixed(stiffness) => stiffness,
            ContactStiffness::PerMass(rate) => rate / mobility * softening(allowed, most),
        };
    }
}

/// The factor on the stiffness of a pair at a vertex with `contacts` contacts, where `allowed` are allowed.
fn softening(allowed: f64, contacts: f64) -> f64 {
    if allowed.is_finite() { allowed / contacts.max(allowed) } else { 1.0 }
}

/// Sums the weights of all pairs at every vertex.
fn count_contacts(pairs: &[ContactPair], vertices: usize, crowd: &mut Vec<f64>) {
    crowd.clear();
    crowd.resize(vertices, 0.0);
    for p in pairs {
        for k in 0..4 {
            if p.weights[k] != 0.0 {
                crowd[p.vertices[k] as usize] += p.weights[k].abs();
            }
        }
    }
}
