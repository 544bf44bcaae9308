//! Which effects this build has. Each of these is a feature of the crate; what is left out is refused by name where a scene
//! calls for it, and never passed over.

use crate::energy::hysteresis;
use crate::{ClothError, Scene, Settings, Switch};

#[cfg(not(feature = "bending-hysteresis"))]
pub(crate) use crate::absent::Hysteresis;
#[cfg(not(feature = "self-contact"))]
pub(crate) use crate::absent::Own;
#[cfg(not(feature = "pressure"))]
pub(crate) use crate::absent::Pressure;
#[cfg(feature = "self-contact")]
pub(crate) use crate::collide::own::Own;
#[cfg(feature = "bending-hysteresis")]
pub(crate) use crate::energy::hysteresis::held::Hysteresis;
#[cfg(feature = "pressure")]
pub(crate) use crate::energy::pressure::Pressure;

/// An effect, is it in the build, and does a scene call for it?
type Part = (&'static str, bool, fn(&Scene, &Settings) -> bool);

const PARTS: [Part; 3] = [
    ("self-contact", cfg!(feature = "self-contact"), |_, s| s.effects.self_contact != Switch::Off),
    ("bending-hysteresis", cfg!(feature = "bending-hysteresis"), hysteresis::called_for),
    ("pressure", cfg!(feature = "pressure"), |_, s| s.pressure != 0.0),
];

/// Is an effect of this name in the build? Those that no build leaves out are.
#[must_use]
pub fn is_built(effect: &str) -> bool {
    PARTS.iter().all(|(name, there, _)| *there || *name != effect)
}

/// Refuses what is called for and is not there.
pub(crate) fn check(scene: &Scene, settings: &Settings) -> Result<(), ClothError> {
    match PARTS.iter().find(|(_, there, called_for)| !there && called_for(scene, settings)) {
        Some((effect, ..)) => Err(ClothError::NotBuilt { effect }),
        None => Ok(()),
    }
}
