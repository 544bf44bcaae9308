//! Codes of moving a body under a garment.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A frame of the moving body has other faces than the body the garment was draped on. Exit code 3.
    BODY_FRAME_FACES = "body-frame-faces";

    /// The body moves faster than 50 m/s between two frames: other units than metres, frames in disorder, or a wrong
    /// with.fps. Exit code 3.
    BODY_FRAME_JUMPS = "body-frame-jumps";

    /// with.body of `animate` names an OBJ without a number to count up from. Exit code 2.
    BODY_FRAMES_NAME = "body-frames-name";

    /// The GLB that should move the body cannot be read or holds no animation. Exit code 3.
    BODY_GLB = "body-glb";

    /// The first frame of the body is far from the pose the garment was draped on; the body is led there before the
    /// first frame is given.
    BODY_LED = "body-led";

    /// In some frame triangles cross. Either the body's motion crosses itself or a step was too long.
    FRAMES_CROSS = "frames-cross";

    /// In some frame the cloth is stretched along warp or weft by more than the certificate allows the drape. The
    /// message says by how much and in which frame: a body that jerks, or too little cloth that holds all the rest.
    FRAMES_OVERSTRETCHED = "frames-overstretched";

    /// A figure of the motion's certificate is beyond its gate: stretch, crossings, energy from nothing, or a free fall
    /// that is none. Exit code 1. `motion` in run.json holds all figures and gates.
    MOTION_GATE = "motion-gate";

    /// with.until_settled was asked for, but the cloth still moved in the last frame.
    MOTION_NOT_SETTLED = "motion-not-settled";

    /// Some time steps were not solved to the asked accuracy. Nothing crosses, but the motion is less exact there.
    MOTION_NOT_SOLVED = "motion-not-solved";

    /// with.sequence has no number to count up from. Exit code 2.
    SEQUENCE_NAME = "sequence-name";
}
