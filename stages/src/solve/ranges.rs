//! Parameters that drapes and motions share, in their ranges.

use crate::codes::SETTING_OUT_OF_RANGE;
use toile_garment::Diagnostic;
use toile_garment::units::Acceleration;

/// Largest gravity, m/s². Hard cases go to 1,000; 9,810 are the earth's in millimetres.
const GRAVITY_MOST: f64 = 5000.0;

/// The fault of a gravity.
pub fn gravity(gravity: Acceleration) -> Option<Diagnostic> {
    if (0.0..=GRAVITY_MOST).contains(&gravity.0) {
        return None;
    }
    let message = format!("`gravity` is {} m/s2; it must lie in 0 to {GRAVITY_MOST} m/s2", gravity.0);
    let hint = "it points downwards and has no sign: the earth's is \"9.81 m/s2\"";
    Some(Diagnostic::error(SETTING_OUT_OF_RANGE, message).hint(hint))
}
