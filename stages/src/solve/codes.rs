//! Codes of calling the solver: the reasons why it refuses a scene or stops.

use crate::codes::BODY_FRAME_VERTICES;
use toile_cloth::SceneFault;
use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// An elastic band names a vertex that is not there, or has a length or stiffness that is not over 0. Exit code 3.
    BAD_BAND = "bad-band";

    /// A fold names a vertex that is not there, or has an angle over 180° or a stiffness below 0. Exit code 3.
    BAD_FOLD = "bad-fold";

    /// A triangle of the body names a vertex that is not there. Exit code 3.
    BAD_BODY = "bad-body";

    /// Gravity is not finite or absurdly large. Exit code 3.
    BAD_GRAVITY = "bad-gravity";

    /// The parts of the body that vertices ignore are given for another number of vertices. Exit code 3.
    BAD_CONTACT_FILTER = "bad-contact-filter";

    /// Layer numbers and vertices differ in count. Exit code 3.
    BAD_LAYERS = "bad-layers";

    /// A load is not finite or acts on a vertex that is not there. Exit code 3.
    BAD_LOAD = "bad-load";

    /// A material has values that no cloth has, or a triangle names one that is not there. Exit code 3.
    BAD_MATERIAL = "bad-material";

    /// A pin names a vertex that is not there, or a place that is not finite. Exit code 3.
    BAD_PIN = "bad-pin";

    /// A vertex is at a place that is not finite. Exit code 3.
    BAD_POSITION = "bad-position";

    /// A stitch names a vertex that is not there. Exit code 3.
    BAD_STITCH = "bad-stitch";

    /// A triangle names a vertex that is not there, or one vertex twice. Exit code 3.
    BAD_TRIANGLE = "bad-triangle";

    /// The start velocities do not fit the cloth. Exit code 3.
    BAD_VELOCITIES = "bad-velocities";

    /// Cloth is caught between two parts of the moving body, or between it and what is held, and has no way out;
    /// nothing may cross, so the body cannot go on. Give it more room there, shorten with.step, or lessen
    /// with.body_gap. Exit code 3.
    BODY_CATCHES_CLOTH = "body-catches-cloth";

    /// A vertex of a frame of the moving body is no number. Exit code 3.
    BODY_FRAME_NOT_FINITE = "body-frame-not-finite";

    /// The run calls for an effect that was left out when this program was built. Nothing is passed over in silence:
    /// switch the effect off, or take a build with it. Exit code 2.
    EFFECT_NOT_BUILT = "effect-not-built";

    /// There is no fabric. Give `with.fabric`. Exit code 2.
    FABRIC_MISSING = "fabric-missing";

    /// A triangle of the rest shape has no area, so its cloth has no stiffness. Exit code 3.
    FLAT_TRIANGLE = "flat-triangle";

    /// There are frames of a body, but the scene has none. Exit code 3.
    NO_BODY = "no-body";

    /// The scene has no cloth, so there is nothing to drape. Exit code 3.
    NO_CLOTH = "no-cloth";

    /// The cloth crosses itself or the body before the first step, so contact cannot keep them apart. Move the pieces
    /// apart with [[place]]. Exit code 3.
    START_CROSSES = "start-crosses";

    /// The scene has more vertices or triangles than the limit. Exit code 3.
    TOO_LARGE = "too-large";
}

/// The code of a scene that the solver refuses.
pub(super) fn of(fault: SceneFault) -> Code {
    match fault {
        SceneFault::NoCloth => NO_CLOTH,
        SceneFault::TooLarge => TOO_LARGE,
        SceneFault::Position => BAD_POSITION,
        SceneFault::Triangle => BAD_TRIANGLE,
        SceneFault::FlatTriangle => FLAT_TRIANGLE,
        SceneFault::Material => BAD_MATERIAL,
        SceneFault::Pin => BAD_PIN,
        SceneFault::Load => BAD_LOAD,
        SceneFault::Stitch => BAD_STITCH,
        SceneFault::Band => BAD_BAND,
        SceneFault::Fold => BAD_FOLD,
        SceneFault::Layers => BAD_LAYERS,
        SceneFault::ContactFilter => BAD_CONTACT_FILTER,
        SceneFault::Gravity => BAD_GRAVITY,
        SceneFault::Body => BAD_BODY,
        SceneFault::Velocities => BAD_VELOCITIES,
        SceneFault::NoBody => NO_BODY,
        SceneFault::FrameVertices => BODY_FRAME_VERTICES,
        SceneFault::FrameNotFinite => BODY_FRAME_NOT_FINITE,
    }
}
