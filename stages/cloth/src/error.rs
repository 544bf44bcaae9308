//! Errors: the reasons why a run was refused or failed.

use crate::Vec3;

/// A place where something is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// A cloth triangle there.
    pub triangle: u32,
    /// World position, m.
    pub at: Vec3,
}

/// Kinds of scenes that the solver cannot take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneFault {
    /// There is no cloth triangle.
    NoCloth,
    /// There are more vertices or triangles than the solver can number.
    TooLarge,
    /// A vertex of cloth or body is at a place that is not finite.
    Position,
    /// A triangle names a vertex that is not there, or one vertex twice.
    Triangle,
    /// A rest triangle has no area.
    FlatTriangle,
    /// A material has values that no cloth has, or a triangle names one that is not there.
    Material,
    /// A pin names a vertex that is not there, or a place that is not finite.
    Pin,
    /// A load is not finite or acts on a vertex that is not there.
    Load,
    /// A stitch names a vertex that is not there.
    Stitch,
    /// An elastic band names a vertex that is not there, or has a length or stiffness that is not over 0.
    Band,
    /// A fold names a vertex that is not there, or has an angle over 180° or a stiffness below 0.
    Fold,
    /// Layer numbers and vertices differ in count.
    Layers,
    /// The contact filter speaks of another number of vertices.
    ContactFilter,
    /// Gravity is not finite or absurdly large.
    Gravity,
    /// A triangle of the body names a vertex that is not there.
    Body,
    /// The start velocities do not fit the cloth.
    Velocities,
    /// There are frames of a body, but no body.
    NoBody,
    /// A frame of the body has other vertices than the body.
    FrameVertices,
    /// A vertex of a frame of the body is not finite.
    FrameNotFinite,
}

/// Failures of the solver.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClothError {
    /// The scene is not usable: an index out of range, a number not finite, a triangle without area …
    #[error("{what}")]
    BadScene {
        /// The kind of fault.
        fault: SceneFault,
        /// The fault and its place, with numbers.
        what: String,
    },
    /// The setting cannot be used.
    #[error("setting `{name}`: {what}")]
    BadSetting {
        /// Name of the setting.
        name: &'static str,
        /// Allowed range.
        what: String,
    },
    /// The scene calls for an effect that is not in this build.
    #[error("this build has no {effect}")]
    NotBuilt {
        /// Name of its switch and of its feature.
        effect: &'static str,
    },
    /// The cloth crosses itself or the body before the first step and could not be freed.
    #[error("the start is not free: cloth goes through cloth at {self_crossings} places and through the body at {body_crossings}, {inside} vertices lie in the body, first near ({:.0}, {:.0}, {:.0}) mm", 1e3 * .place.at.x, 1e3 * .place.at.y, 1e3 * .place.at.z)]
    StartCrosses {
        /// Crossing pairs of cloth triangles.
        self_crossings: usize,
        /// Crossing pairs of a cloth and a body triangle.
        body_crossings: usize,
        /// Vertices inside the body.
        inside: usize,
        /// The first of them.
        place: Place,
    },
    /// The numbers left the finite range although the step was halved again and again.
    #[error("unstable at step {step}: {what}")]
    Unstable {
        /// Step at which it happened.
        step: u64,
        /// The observation.
        what: String,
    },
    /// The body moves where cloth has no way out: between two parts of it, or between it and what is held.
    #[error("the body cannot go on {seconds:.3} s after the first frame: it catches the cloth near ({:.3}, {:.3}, {:.3}) m", .place.at.x, .place.at.y, .place.at.z)]
    Caught {
        /// Time from the first frame on, s; negative on the way to it.
        seconds: f64,
        /// Place of the cloth that is caught.
        place: Place,
    },
    /// The watch asked to stop.
    #[error("stopped on request at step {step}")]
    Cancelled {
        /// Step at which it happened.
        step: u64,
    },
}

impl ClothError {
    /// The error with its place mapped.
    pub(crate) fn placed(mut self, told: impl FnOnce(Place) -> Place) -> Self {
        if let Self::StartCrosses { place, .. } | Self::Caught { place, .. } = &mut self {
            *place = told(*place);
        }
        self
    }
}
