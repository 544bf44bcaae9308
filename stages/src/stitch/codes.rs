//! Codes of placing pieces around a body and sewing them together.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A sleeve or cuff lies on one arm and is sewn to cloth on the other side of the body. Place it on the other
    /// arm, or sew it to the other armhole. Exit code 2.
    ARM_SWAPPED = "arm-swapped";

    /// Pieces without a [[place]] were arranged by their roles and seams. The message tells how long the threads are
    /// at the start, and which places are least sure.
    ARRANGED = "arranged";

    /// Attached edges go only part of the way round the body: what is sewn to their ends is not attached. Attach it,
    /// too. Exit code 2.
    ATTACH_PART_OF_RING = "attach-part-of-ring";

    /// An [[attach]] names a part of an edge, or a line inside a piece. Whole edges alone can be held. Exit code 2.
    ATTACH_NO_EDGE = "attach-no-edge";

    /// Two [[attach]] tables name one edge. Keep one. Exit code 2.
    ATTACHED_TWICE = "attached-twice";

    /// An [[attach]] names a landmark on an arm or a leg. Edges are held around trunk and neck alone. Exit code 2.
    ATTACH_TO_LIMB = "attach-to-limb";

    /// An elastic band is sewn to edges that are held on the body for good, so it draws nothing in. Attach them with
    /// `strength = "while-sewing"`.
    BAND_HELD = "band-held";

    /// An [[attach]] names an edge that is a leg of a dart. The leg is sewn to the other one, so it cannot be held. Exit
    /// code 2.
    ATTACH_DART_LEG = "attach-dart-leg";

    /// The body does not go all the way round at the height an edge is attached to: its mesh ends or is torn there.
    /// Exit code 2.
    ATTACH_TARGET_EMPTY = "attach-target-empty";

    /// The body has no landmark or height of this name. The message lists them. Exit code 2.
    ATTACH_TARGET_UNKNOWN = "attach-target-unknown";

    /// The body has no side file that names its segments. They and the waist were found on the mesh, because pieces
    /// had to be arranged.
    BODY_SEGMENTS_FOUND = "body-segments-found";

    /// The axis of a body segment has no length, so nothing can be placed around it. Exit code 3.
    BODY_SEGMENT_FLAT = "body-segment-flat";

    /// A [[place]] names a segment that the body does not have. The message lists them. Exit code 2.
    BODY_SEGMENT_UNKNOWN = "body-segment-unknown";

    /// `fabrics` names neither a material nor a piece of the pattern, so this fabric is not used. The hint lists the
    /// materials of the pattern.
    FABRIC_UNUSED = "fabric-unused";

    /// A skirt or trousers without shoulders and without an [[attach]] would fall: the upper edges are held at the
    /// waist.
    HELD_AT_WAIST = "held-at-waist";

    /// Nothing says where a piece starts in 3D, and no seam does. Add a [[place]] for it to the sewing file, sew it to
    /// another piece, or leave it out. Exit code 2.
    PIECE_NOT_PLACED = "piece-not-placed";

    /// The body segment of a [[place]] lies level, so a height says nothing along it. Exit code 2.
    PLACE_HEIGHT = "place-height";

    /// Two pieces lie at each other's place: exchanged, their threads are much shorter. Exit code 2.
    PIECES_EXCHANGED = "pieces-exchanged";

    /// A [[place]] names a side that is none of front, back, left, right. Exit code 2.
    PLACE_SIDE_UNKNOWN = "place-side-unknown";

    /// A seam did not close, though its threads pulled with their full force. Most such seams are wrong or turned round:
    /// look at it in the sewing file first. Else something is in the way, or the pieces do not reach; place them nearer to
    /// where they are sewn. The drape joins what it can; its certificate tells the gap of what stays open.
    SEAM_OPEN = "seam-open";

    /// The sides of a seam are farther apart than threads can draw them together. Place the pieces beside each other,
    /// or leave their [[place]] out. Exit code 2.
    SEAM_OUT_OF_REACH = "seam-out-of-reach";

    /// A wide ring of cloth starts on a common cone around the torso instead of the flat sheets that the sewing file
    /// places.
    START_ON_CONE = "start-on-cone";

    /// A piece started in the body or in another piece, or lay there when the others were sewn. It was moved along one of
    /// its axes until it was free.
    START_MOVED = "start-moved";

    /// A waist seam started where the body is wider than it. All pieces that lie on no arm were raised or lowered.
    START_RAISED = "start-raised";

    /// The parts of a [[whole]] start one by one: one of them has a [[place]], or they are not sewn to one another side by
    /// side. The message tells which.
    WHOLE_UNUSED = "whole-unused";

    /// Pieces were sewn without meeting a forearm that stood in their way. The drape meets the whole body. A list
    /// `ignores` in a [[place]] says otherwise.
    SEWN_PAST_LIMB = "sewn-past-limb";

    /// Vertices started inside the body and were pushed out before the first step.
    START_REPAIRED = "start-repaired";
}
