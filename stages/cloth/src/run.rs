//! The loops.

use crate::{ClothError, Outcome, Scene, Settings, Watch};

/// Closes the stitches: the paper's dynamic system with sewing forces, until every pair is closer than the sewing
/// distance and the elastic energy rests. Pairs that came close are joined exactly (gap 0).
///
/// # Errors
/// An unusable scene or setting, a start that crosses, instability, or a stop on request.
pub fn sew(_scene: &Scene, _settings: &Settings, _watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    Err(ClothError::BadScene { code: "not-yet", what: "not built yet".into() })
}

/// Settles the cloth: the same system without sewing force. Stitches still in the scene are held where they are
/// closed; weld first.
///
/// # Errors
/// As [`sew`].
pub fn drape(_scene: &Scene, _settings: &Settings, _watch: &mut dyn Watch) -> Result<Outcome, ClothError> {
    Err(ClothError::BadScene { code: "not-yet", what: "not built yet".into() })
}
