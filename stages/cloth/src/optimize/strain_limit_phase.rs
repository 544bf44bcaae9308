//! The phases of the strain-limit barrier while cloth settles.

/// How the strain-limit barrier acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StrainLimitPhase {
    /// Not decided yet.
    Undecided,
    /// The barrier is off: the cloth still falls.
    Off,
    /// The barrier is the law's own since this step, and was never widened.
    Own(u64),
    /// The barrier is widened to this share of the limits.
    Wide(f64),
    /// The barrier is the law's own again.
    OwnAgain,
}
