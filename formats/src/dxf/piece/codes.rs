//! Codes of making a piece of its lines: outline, fold, notches, grain and texts.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A line stands on a layer for dense copies (85 to 87), but the piece has no line that it is a copy of. It was left
    /// out. If it is meant as a line of its own, map its layer with `layers` of `import-dxf`.
    COPY_WITHOUT_ORIGINAL = "copy-without-original";

    /// Curve points were joined by a smooth curve, as the standard asks; the message says how far the curve leaves the
    /// chords.
    CURVE_INTERPOLATED = "curve-interpolated";

    /// Curve points were left as straight chords, because the smooth curve would leave them too far or cross itself.
    CURVE_NOT_SMOOTHED = "curve-not-smoothed";

    /// The sew line is open along one straight edge of the piece, and no fold line (layer 6) is there: this looks like half a
    /// piece. It was taken as drawn. Draw the edge as a fold line, or map the layer that has it with `layers`; if the piece
    /// is whole, close its sew line.
    FOLD_MISSING = "fold-missing";

    /// The fold line does not lie on a straight edge of the half piece, so the piece was not unfolded. Put the fold on
    /// the edge, or draw the whole piece.
    FOLD_OFF_BOUNDARY = "fold-off-boundary";

    /// A piece has more than one fold line (layer 6). Only the longest counts; draw a piece that is folded twice
    /// unfolded once.
    FOLD_SECOND = "fold-second";

    /// A grade rule names an alternate grade reference line that layer 5 does not have; the reference line was taken.
    GRADE_LINE_MISSING = "grade-line-missing";

    /// Texts of grade rules stand up to 1 mm beside a vertex, and no other is as near. They count for it.
    GRADE_RULE_BESIDE_VERTEX = "grade-rule-beside-vertex";

    /// Texts of grade rules stand at no vertex within 1 mm, or between two. They move nothing. Put them on their
    /// vertices in the pattern program.
    GRADE_RULE_OFF_VERTEX = "grade-rule-off-vertex";

    /// The piece has no grain line. The y axis of the file is taken as the warp.
    GRAIN_MISSING = "grain-missing";

    /// Notches are cut into the outline. They are read as notches, and the sewn line runs over them.
    NOTCH_CUT_IN = "notch-cut-in";

    /// A notch lies farther from the outline than a notch can. It was kept, but it is no mark on an edge.
    NOTCH_OFF_BOUNDARY = "notch-off-boundary";

    /// Lines of the outline stand in the file twice. They were read once.
    OUTLINE_DOUBLED = "outline-doubled";

    /// The ends of an outline missed each other by a little and were joined; the message says by how much.
    OUTLINE_GAP_CLOSED = "outline-gap-closed";

    /// A line crosses itself beside a corner and makes a small loop there, as programs do that offset or grade a line.
    /// The loop was cut off where the line crosses itself. `with.loops` of `import-dxf` says up to which size (15 mm);
    /// 0 refuses such pieces.
    OUTLINE_LOOP_CUT_OFF = "outline-loop-cut-off";

    /// A piece has lines on the boundary layer but none that closes. Exit code 3.
    OUTLINE_MISSING = "outline-missing";

    /// The outline of a piece is open by more than a gap that may be closed. Close it in the pattern program.
    /// Exit code 3.
    OUTLINE_OPEN = "outline-open";

    /// A second closed line on the boundary layer: one inside the piece is taken as a cutout, one beside it was left
    /// out.
    OUTLINE_SECOND = "outline-second";

    /// The outline runs out to a point and back on the same line, so a spike without width stands out of the piece. It
    /// was read as drawn; take it out in the pattern program.
    OUTLINE_SPIKE = "outline-spike";

    /// A line on the boundary layer is no part of the outline and was left out.
    OUTLINE_STRAY_LINE = "outline-stray-line";

    /// The outline is too long and winding for its crossings to be searched within the limit. Simplify it. Exit code 3.
    OUTLINE_TOO_ENTANGLED = "outline-too-entangled";

    /// The piece is larger than any cloth. The unit of the file is probably wrong; set `units` of `import-dxf`.
    /// Exit code 3.
    OUTLINE_TOO_LARGE = "outline-too-large";

    /// The outline has more points than the limit. Exit code 3.
    OUTLINE_TOO_LONG = "outline-too-long";

    /// The outline comes back to a place that it has passed, so two parts of the piece hang together at a point or not
    /// at all. It was read as drawn; draw the parts as pieces, or leave a gap.
    OUTLINE_TOUCHES_ITSELF = "outline-touches-itself";

    /// Vertices of an outline that stand within 0.06 mm of the one before tangled it; they were left out.
    OUTLINE_VERTICES_DOUBLED = "outline-vertices-doubled";

    /// The outline encloses nothing, e.g. a line drawn forth and back. Exit code 3.
    OUTLINE_WITHOUT_AREA = "outline-without-area";

    /// Most points of layers 2 and 3, which mark corners and curve points, stand at no vertex. Some programs put drill
    /// holes and notches on these layers; map them with `layers` of `import-dxf`.
    POINTS_OFF_VERTICES = "points-off-vertices";

    /// Some curve points (layer 3) stand at no vertex of a line that is kept, or where a turn point stands, so they are
    /// not used and not written again. They often belong to the dense copy of an outline.
    CURVE_POINTS_UNUSED = "curve-points-unused";

    /// The text `Quantity` of a piece is no number and no pair of numbers, so 1 was taken. Write `2`, or `1,1` for one
    /// as drawn and one mirrored.
    QUANTITY_UNCLEAR = "quantity-unclear";

    /// The sew line leaves the cut line, so a part of it has no cloth. It was taken as drawn; correct layer 14 or layer
    /// 1 at the place named.
    SEW_LINE_CROSSES = "sew-line-crosses";

    /// The sew line goes through itself, and not in a small loop at a corner. It was taken as drawn; the mesher refuses
    /// it. One that encloses next to nothing, as a bow does, was kept as an internal line, and the cut line is sewn.
    /// Correct it in the pattern program.
    SEW_LINE_CROSSES_ITSELF = "sew-line-crosses-itself";

    /// The sew line lies much farther inside the cut line than an allowance is wide. It was taken as drawn; make sure
    /// that layer 14 holds the sew line of this piece.
    SEW_LINE_FAR = "sew-line-far";

    /// The line on layer 14 runs outside the cut line, where there is no cloth, so it is no sew line. The cut line is
    /// sewn; if the two layers are exchanged, map them with `layers` of `import-dxf`.
    SEW_LINE_OUTSIDE = "sew-line-outside";

    /// A line on layer 14 inside the outline is no closed sew line. It was kept as an internal line.
    STITCH_LINE = "stitch-line";

    /// Two texts of a piece give the same key different values. The message says which one counts; take the wrong one
    /// out of the block.
    TEXT_CONTRADICTS = "text-contradicts";

    /// A piece has more marks than the limit. Exit code 3.
    TOO_MANY_NOTCHES = "too-many-notches";

    /// The dense curve that the file carries on layer 84 or 87 lies more than 2 mm off the outline, or misses one of
    /// its corners. It was not used; the curve through the drawn points is.
    VALIDATION_CURVE_DIFFERS = "validation-curve-differs";
}
