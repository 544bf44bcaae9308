//! Codes of placing, sewing and draping.

use super::{Code, code};

/// Codes of placing, sewing and draping.
pub(super) const CODES: &[Code] = &[
    code("attach-strength", "The elastic share of an [[attach]] is not between 0 and 1.5. Exit code 2."),
    code("attach-target-empty", "The body has no section at the height an edge is attached to. Exit code 2."),
    code(
        "attach-target-unknown",
        "The body has no landmark or height of this name. The message lists them. Exit code 2.",
    ),
    code("bad-body", "A triangle of the body names a vertex that is not there. Exit code 3."),
    code("bad-gravity", "Gravity is not finite or absurdly large. Exit code 3."),
    code("bad-layers", "Layer numbers and vertices differ in count. Exit code 3."),
    code("bad-load", "A load is not finite or acts on a vertex that is not there. Exit code 3."),
    code(
        "bad-material",
        "A material has values that no cloth has, or a triangle names one that is not there. Exit code 3.",
    ),
    code("bad-pin", "A pin names a vertex that is not there, or a place that is not finite. Exit code 3."),
    code("bad-position", "A vertex is at a place that is not finite. Exit code 3."),
    code("bad-stitch", "A stitch names a vertex that is not there. Exit code 3."),
    code("bad-triangle", "A triangle names a vertex that is not there, or one vertex twice. Exit code 3."),
    code("bad-velocities", "The start velocities do not fit the cloth. Exit code 3."),
    code(
        "body-catches-cloth",
        "Cloth is caught between two parts of the moving body, or between it and what is held, and has no way out; nothing may cross, so the body cannot go on. Give it more room there, shorten with.step, or lessen with.body_gap. Exit code 3.",
    ),
    code(
        "body-frame-faces",
        "A frame of the moving body has other faces than the body the garment was draped on. Exit code 3.",
    ),
    code(
        "body-frame-jumps",
        "The body moves faster than 50 m/s between two frames: other units than metres, frames in disorder, or a wrong with.fps. Exit code 3.",
    ),
    code("body-frame-not-finite", "A vertex of a frame of the moving body is no number. Exit code 3."),
    code(
        "body-frame-vertices",
        "A frame of the moving body has other vertices than the body the garment was draped on. Export every frame from the same mesh. Exit code 3.",
    ),
    code("body-frames-name", "with.body of `animate` names an OBJ without a number to count up from. Exit code 2."),
    code("body-glb", "The GLB that should move the body cannot be read or holds no animation. Exit code 3."),
    code(
        "body-led",
        "The first frame of the body is far from the pose the garment was draped on; the body is led there before the first frame is given.",
    ),
    code(
        "body-missing",
        "A placement or attachment refers to the body, and none was given. Give `with.body` to `stitch`. Exit code 2.",
    ),
    code(
        "body-segment-flat",
        "The axis of a body segment has no length, so nothing can be placed around it. Exit code 3.",
    ),
    code(
        "body-segment-unknown",
        "A [[place]] names a segment that the body does not have. The message lists them. Exit code 2.",
    ),
    code(
        "drape-not-settled",
        "The drape did not come to rest within its steps or its time, nothing holds it, or something holds it back from where it is led. The message says which and what helps; the certificate says how far it was.",
    ),
    code(
        "edges-tiny",
        "Edges are so short beside the others of their triangles that no step could be taken: their ends were draped as one vertex, and parted again afterwards.",
    ),
    code(
        "effect-not-built",
        "The run calls for an effect that was left out when this program was built. Nothing is passed over in silence: switch the effect off, or take a build with it. Exit code 2.",
    ),
    code("fabric-missing", "There is no fabric. Give `with.fabric`. Exit code 2."),
    code("flat-triangle", "A triangle of the rest shape has no area, so its cloth has no stiffness. Exit code 3."),
    code(
        "frames-cross",
        "In some frame triangles cross. Either the body's motion crosses itself or a step was too long.",
    ),
    code(
        "frames-overstretched",
        "In some frame the cloth is stretched along warp or weft by more than the certificate allows the drape. The message says by how much and in which frame: a body that jerks, or too little cloth that holds all the rest.",
    ),
    code("motion-not-settled", "with.until_settled was asked for, but the cloth still moved in the last frame."),
    code(
        "motion-not-solved",
        "Some time steps were not solved to the asked accuracy. Nothing crosses, but the motion is less exact there.",
    ),
    code("no-body", "There are frames of a body, but the scene has none. Exit code 3."),
    code("no-cloth", "The scene has no cloth, so there is nothing to drape. Exit code 3."),
    code(
        "piece-not-placed",
        "Nothing says where a piece starts in 3D. Add a [[place]] for it to the sewing file. Exit code 2.",
    ),
    code("place-height", "The body segment of a [[place]] lies level, so a height says nothing along it. Exit code 2."),
    code("place-side-unknown", "A [[place]] names a side that is none of front, back, left, right. Exit code 2."),
    code(
        "seam-open",
        "A seam did not close: something is in the way, or the pieces do not reach. Place them nearer to where they are sewn. The drape joins what is open; its certificate says whether the cloth bears it.",
    ),
    code("sequence-name", "with.sequence has no number to count up from. Exit code 2."),
    code(
        "setting-out-of-range",
        "A setting of the solver or of a test is outside the range in which it works. Exit code 2.",
    ),
    code(
        "start-crosses",
        "The cloth crosses itself or the body before the first step, so contact cannot keep them apart. Move the pieces apart with [[place]]. Exit code 3.",
    ),
    code(
        "springs-unused",
        "The fabric gives constants of springs ([springs]), and the model of the drape is not `springs`: it went by the fabric's laws.",
    ),
    code("start-repaired", "Vertices started inside the body and were pushed out before the first step."),
    code("too-large", "The scene has more vertices or triangles than the limit. Exit code 3."),
];
