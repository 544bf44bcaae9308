//! Codes of pattern files: DXF and grade rule tables.

use super::{Code, code};

/// Codes of pattern files: DXF and grade rule tables.
pub(super) const CODES: &[Code] = &[
    code(
        "bad-group-code",
        "A DXF is pairs of lines, a group code and its value, and here the code is no whole number. The file is damaged or was edited by hand; export it again. Exit code 3.",
    ),
    code(
        "bad-number",
        "A value that must be a number is none, or is not finite. Export the file again, or correct the line. Exit code 3.",
    ),
    code(
        "binary-dxf",
        "The file is a binary DXF whose pieces cannot be read: its data are damaged where the message says. Export it as text (ASCII) DXF. Exit code 3.",
    ),
    code(
        "binary-dxf-damaged",
        "A part of a binary DXF outside the pieces (header, tables) cannot be read, as some programs write it wrong. It was passed over to the next section.",
    ),
    code(
        "binary-dxf-read",
        "The file is a binary DXF. Lines in messages are counted as in its text form, two for each pair.",
    ),
    code(
        "blank-line",
        "A blank line stands where a group code belongs. It was skipped; the pairs after it were read as if it were not there.",
    ),
    code(
        "block-missing",
        "An INSERT names a block that the file does not hold, so a piece is missing. Export the file again.",
    ),
    code("block-name-repeats", "Two blocks have the same name. Both pieces are kept and told apart by a number."),
    code("block-not-closed", "A block has no ENDBLK. The file is cut short or damaged. Exit code 3."),
    code("block-without-name", "A block has no name, so no INSERT can refer to it."),
    code(
        "block-without-outline",
        "A block holds nothing on the boundary layers (1, or 14), so it is no piece and was left out. Check the layers, or map them with `layers` of `import-dxf`.",
    ),
    code(
        "code-page-unknown",
        "The `code_page` asked for is none this program knows. The hint gives examples. Exit code 3.",
    ),
    code(
        "coordinate-missing",
        "A vertex or point has no x or no y. The file is damaged; export it again. Exit code 3.",
    ),
    code(
        "coordinate-twice",
        "One entity gives the same coordinate twice. The first or the last could be meant, so the file is refused. Exit code 3.",
    ),
    code(
        "curve-interpolated",
        "Curve points were joined by a smooth curve, as the standard asks; the message says how far the curve leaves the chords.",
    ),
    code(
        "curve-not-smoothed",
        "Curve points were left as straight chords, because the smooth curve would leave them too far or cross itself.",
    ),
    code(
        "cutout-crosses-itself",
        "The line of a cutout crosses itself, so what falls out of it is not defined. It was kept as drawn; correct it on layer 11.",
    ),
    code(
        "cutout-open",
        "The line of a cutout on layer 11 does not close. It was kept as drawn; close it in the pattern program.",
    ),
    code(
        "cutout-outside",
        "A cutout lies outside its piece, crosses its outline or repeats it, so it cannot be cut. It was kept as drawn; correct it on layer 11.",
    ),
    code(
        "cutouts-overlap",
        "Two cutouts of a piece overlap, so they would fall out as one. Both were kept as drawn; draw their common outline instead.",
    ),
    code(
        "dart-apex-blunt",
        "The apex of a dart is drawn as two vertices side by side, up to 2 mm apart. Their middle is its apex.",
    ),
    code(
        "dart-candidate",
        "Lines inside the piece look like a dart but do not close to one. Declare it with [[dart]] in the sewing file if it is one.",
    ),
    code(
        "dart-legs-differ",
        "The two legs of a dart differ in length, so its mouth does not close flush. The difference is eased over the leg; correct the pattern if it is not meant.",
    ),
    code("data-after-eof", "Something follows the EOF mark. It was not read."),
    code(
        "decimal-comma",
        "A number is written with a decimal comma. DXF has points only; export with another locale. Exit code 3.",
    ),
    code(
        "dxf-profile",
        "Which program wrote the file, and why that is thought. Set `profile` of `import-dxf` to overrule it.",
    ),
    code(
        "encoding-guessed",
        "The file does not say how its texts are encoded, or says it wrongly, and they are no plain ASCII. The guess touches names only, never geometry; set `code_page` of `import-dxf` if names look wrong.",
    ),
    code("endblk-without-block", "An ENDBLK closes nothing. The file is damaged. Exit code 3."),
    code("endsec-without-section", "An ENDSEC closes nothing. The file is damaged. Exit code 3."),
    code(
        "entities-left-out",
        "Entities of the file are nothing this program can place: unknown kinds or layers. The message counts them by kind and layer; no outline was among them unless other findings say so.",
    ),
    code("entity-outside-block", "An entity stands where none may stand. The file is damaged. Exit code 3."),
    code(
        "entity-too-large",
        "One entity has more values than any pattern needs. The file is damaged or hostile. Exit code 3.",
    ),
    code(
        "eof-missing",
        "The file ends without its EOF mark. All sections were whole, so it was read; make sure that it was copied completely.",
    ),
    code("file-empty", "The file has no bytes; copy or export it again. Exit code 3."),
    code(
        "file-truncated",
        "The file ends in the middle of a pair, section or entity: it was cut short. Copy or export it again. Exit code 3.",
    ),
    code(
        "fold-off-boundary",
        "The fold line does not lie on a straight edge of the half piece, so the piece was not unfolded. Put the fold on the edge, or draw the whole piece.",
    ),
    code(
        "fold-second",
        "A piece has more than one fold line (layer 6). Only the longest counts; draw a piece that is folded twice unfolded once.",
    ),
    code(
        "grade-line-missing",
        "A grade rule names an alternate grade reference line that layer 5 does not have; the reference line was taken.",
    ),
    code("grain-missing", "The piece has no grain line. The y axis of the file is taken as the warp."),
    code("insert-array", "An INSERT repeats its block in rows and columns; one piece was made of it."),
    code(
        "insert-mirrored",
        "An INSERT mirrors its block, and the piece was mirrored with it. `inserts = \"ignored\"` of `import-dxf` takes the pieces as their blocks draw them.",
    ),
    code("insert-not-expanded", "A nested INSERT could not be expanded; what it refers to is missing in the piece."),
    code("insert-recursive", "A block contains itself. It was not expanded further."),
    code(
        "insert-repeated",
        "A block is inserted several times with other scales or mirrored. One piece was made of it, as the first INSERT has it, and the others were only counted. Give each shape a block of its own.",
    ),
    code("insert-too-deep", "INSERTs are nested deeper than the limit. They were not expanded further."),
    code(
        "insert-too-many",
        "INSERTs of blocks in blocks would make more entities than the limit, so the file is refused. Export the pieces as blocks of their own. Exit code 3.",
    ),
    code(
        "insert-transformed",
        "An INSERT scales or turns its block. Its scale changes the piece and is applied; its place and turn only lay the piece out. `inserts` of `import-dxf` can say otherwise.",
    ),
    code(
        "ledger",
        "How many entities of the file were accepted, interpreted by a rule, and refused. `toile inspect` lists the rules.",
    ),
    code(
        "library-census-differs",
        "The library that reads curves (arcs, ellipses, splines, light polylines) gave back less than stands in the file, so the file is refused. Draw the curve anew, or export it as a polyline. Exit code 3.",
    ),
    code(
        "line-not-flat",
        "The vertices of a line have different heights (z). It was read as seen from above, so lengths along the slope are lost; lay the pattern flat before the export.",
    ),
    code(
        "line-too-long",
        "A line of the file is longer than any DXF line. The file is no DXF or is damaged. Exit code 3.",
    ),
    code(
        "lines-outside-blocks",
        "Lines on piece layers stand outside all blocks. They belong to no piece and were left out.",
    ),
    code(
        "mark-outside",
        "Drill holes or internal lines lie far outside the piece whose block holds them. They were kept as drawn; perhaps they belong to another piece.",
    ),
    code("more-findings", "More findings of this kind were made than are listed."),
    code(
        "name-from-block",
        "No text names pieces and sizes, so they were taken from the names of the blocks, as `FRONT_38`.",
    ),
    code(
        "no-pieces",
        "The file holds no closed boundary on the layers of the standards, so there is no piece. Check the layers, or map them with `layers` of `import-dxf`. Exit code 3.",
    ),
    code("not-dxf", "The file does not begin as a DXF does. Exit code 3."),
    code(
        "notch-cut-in",
        "Notches are cut into the outline. They are read as notches, and the sewn line runs over them.",
    ),
    code(
        "notch-off-boundary",
        "A notch lies farther from the outline than a notch can. It was kept, but it is no mark on an edge.",
    ),
    code(
        "notch-too-large",
        "A notch is deeper or wider than any notch is cut, so its numbers or the unit of the file are wrong. It was kept as drawn.",
    ),
    code("number-out-of-range", "A number is too large or too small for a pattern. Exit code 3."),
    code(
        "outline-crosses-itself",
        "The outline of a piece crosses itself, so inside and outside are not defined. Correct the pattern at the place named. Exit code 3.",
    ),
    code("outline-doubled", "Lines of the outline stand in the file twice. They were read once."),
    code(
        "outline-gap-closed",
        "The ends of an outline missed each other by a little and were joined; the message says by how much.",
    ),
    code("outline-missing", "A piece has lines on the boundary layer but none that closes. Exit code 3."),
    code(
        "outline-open",
        "The outline of a piece is open by more than a gap that may be closed. Close it in the pattern program. Exit code 3.",
    ),
    code(
        "outline-second",
        "A second closed line on the boundary layer: one inside the piece is taken as a cutout, one beside it was left out.",
    ),
    code(
        "outline-spike",
        "The outline runs out to a point and back on the same line, so a spike without width stands out of the piece. It was read as drawn; take it out in the pattern program.",
    ),
    code("outline-stray-line", "A line on the boundary layer is no part of the outline and was left out."),
    code(
        "outline-too-entangled",
        "The outline is too long and winding for its crossings to be searched within the limit. Simplify it. Exit code 3.",
    ),
    code(
        "outline-too-large",
        "The piece is larger than any cloth. The unit of the file is probably wrong; set `units` of `import-dxf`. Exit code 3.",
    ),
    code("outline-too-long", "The outline has more points than the limit. Exit code 3."),
    code(
        "outline-touches-itself",
        "The outline comes back to a place that it has passed, so two parts of the piece hang together at a point or not at all. It was read as drawn; draw the parts as pieces, or leave a gap.",
    ),
    code(
        "outline-vertices-doubled",
        "Vertices of an outline that stand within 0.06 mm of the one before tangled it; they were left out.",
    ),
    code("outline-without-area", "The outline encloses nothing, e.g. a line drawn forth and back. Exit code 3."),
    code("outside-section", "A pair stands outside all sections. It was not read."),
    code(
        "piece-lacks-size",
        "A piece is not drawn in all sizes of the file and has no grade rules to make them. A garment in a missing size is refused; export the piece in every size.",
    ),
    code("piece-name-missing", "No text of the file says `Piece Name`. The pieces have the names of their blocks."),
    code(
        "piece-repeats",
        "Two blocks have the same piece name and size. Both were read, the later one under a numbered name; if one is a leftover, take it out of the file.",
    ),
    code(
        "pieces-from-entities",
        "The file has no blocks with pieces. The outermost closed lines in ENTITIES were taken as the pieces.",
    ),
    code(
        "pleat-candidate",
        "Two lines look like the folds of a pleat or dart-pleat. It is not made one unless the sewing file declares it with `[[dart]]`.",
    ),
    code(
        "points-off-vertices",
        "Most points of layers 2 and 3, which mark corners and curve points, stand at no vertex. Some programs put drill holes and notches on these layers; map them with `layers` of `import-dxf`.",
    ),
    code("polyline-too-long", "A polyline has more vertices than the limit. Exit code 3."),
    code("polyline-without-seqend", "A polyline has no SEQEND. It ends where the next entity begins."),
    code(
        "profile-unknown",
        "The `profile` asked for is no writer this program knows; the hint lists them. Exit code 2.",
    ),
    code(
        "quantity-unclear",
        "The text `Quantity` of a piece is no number and no pair of numbers, so 1 was taken. Write `2`, or `1,1` for one as drawn and one mirrored.",
    ),
    code("rule-bad-number", "A growth in the rule table is no number. Exit code 3."),
    code("rule-count-differs", "A rule has not two growths for each size. Exit code 3."),
    code(
        "rule-end-missing",
        "The rule table ends without END. What is there was read, but rules may be missing; make sure that it was copied completely.",
    ),
    code(
        "rule-growth-doubtful",
        "A grade rule moves a point from one size to the next farther than any garment grows. The unit of the rule table, or of the pattern, is probably wrong.",
    ),
    code(
        "rule-missing",
        "A graded point names a rule that the table does not hold, so the size cannot be made. Give the rule table that belongs to the pattern, or a size that is drawn.",
    ),
    code(
        "rule-sample-moves",
        "A rule moves points in the sample size, which should stay as drawn. The growth of other sizes is taken relative to the table's own sample.",
    ),
    code("rule-sample-unknown", "The sample size is not in the list of sizes. Exit code 3."),
    code("rule-sizes-differ", "The number of sizes and the list of sizes differ. Exit code 3."),
    code(
        "rule-table-broken",
        "The rule table beside the pattern is wrong, as the findings after this one say. The pieces were read without it; a run that needs it is refused.",
    ),
    code(
        "rule-table-differs",
        "The rule table has another name or another sample size than the pattern says. It was used; make sure that it belongs to the pattern.",
    ),
    code("rule-too-many", "The rule table is larger than the limit. Exit code 3."),
    code("rule-twice", "A rule stands in the table twice; the last one counts."),
    code("rule-unknown", "A line of the rule table is no key, rule or growth. Exit code 3."),
    code("rule-without-sizes", "The rule table lists no sizes, so its growths belong to none. Exit code 3."),
    code(
        "rules-missing",
        "Pieces name grade rules that the rule table does not hold, so sizes that are not drawn cannot be made. Give the whole table that belongs to the pattern.",
    ),
    code(
        "sample-size-missing",
        "The sample size that the file names is not drawn, or the file holds several sizes and names none as the sample size. Ask for a size by name.",
    ),
    code("section-not-closed", "A section has no ENDSEC. The file is cut short or damaged."),
    code("section-without-name", "A section has no name, so what it holds is unknown. Exit code 3."),
    code(
        "sew-line-crosses",
        "The sew line leaves the cut line, so a part of it has no cloth. It was taken as drawn; correct layer 14 or layer 1 at the place named.",
    ),
    code(
        "sew-line-far",
        "The sew line lies much farther inside the cut line than an allowance is wide. It was taken as drawn; make sure that layer 14 holds the sew line of this piece.",
    ),
    code(
        "sew-line-outside",
        "The line on layer 14 runs outside the cut line, where there is no cloth, so it is no sew line. The cut line is sewn; if the two layers are exchanged, map them with `layers` of `import-dxf`.",
    ),
    code("size-chosen", "No size was asked for; the message names the one taken and why."),
    code(
        "size-not-found",
        "The size asked for is neither drawn nor graded. The message lists the sizes that are there. Exit code 2.",
    ),
    code(
        "sizes-differ-in-vertices",
        "The sizes of a piece have different numbers of points. Each is read on its own, but names of edges may not carry over.",
    ),
    code("sizes-with-sewing", "A sewing file belongs to one size, and `size` of `import-dxf` is a list. Exit code 2."),
    code(
        "sizes-without-rules",
        "The sizes of a piece have different vertices, so no grade rules lead from one to the other. All sizes are written as drawn.",
    ),
    code("spline-damaged", "A spline has knots, weights or points that do not fit each other. Exit code 3."),
    code(
        "stitch-line",
        "A line on layer 14 inside the outline is no closed sew line. It was kept as an internal line.",
    ),
    code("stray-pair", "A pair stands before the first entity of its section and means nothing there."),
    code("stray-seqend", "A SEQEND closes nothing. The file is damaged. Exit code 3."),
    code("stray-vertex", "A VERTEX belongs to no polyline. The file is damaged. Exit code 3."),
    code(
        "text-contradicts",
        "Two texts of a piece give the same key different values. The first one counts; take the wrong one out of the block.",
    ),
    code("too-many-entities", "The file has more entities than the limit. Exit code 3."),
    code("too-many-errors", "The file has so many mistakes that reading it was given up. Exit code 3."),
    code("too-many-notches", "A piece has more marks than the limit. Exit code 3."),
    code("too-many-pairs", "The file has more pairs than the limit. Exit code 3."),
    code("too-many-pieces", "The file has more pieces than the limit. Exit code 3."),
    code(
        "units-contradict",
        "Two statements of the file name different units. The text `Units` counts before the header; set `units` of `import-dxf` if that is wrong.",
    ),
    code(
        "units-doubtful",
        "The unit in the file gives pieces of a size that no garment has, or two statements differ. Set `units` of `import-dxf` if the message's choice is wrong.",
    ),
    code(
        "units-guessed",
        "The file does not state its unit. It was taken from the size of the pieces; set `units` of `import-dxf` to be sure.",
    ),
    code(
        "units-unknown",
        "The file states a unit that is neither metric nor English, and the pieces fit none. Set `units` of `import-dxf`. Exit code 3.",
    ),
    code("unknown-section", "A section of the file is unknown. It was not read."),
    code("utf-16-text", "The file is UTF-16 text, which was read as such."),
    code(
        "validation-curve-differs",
        "The dense curve that the file carries on layer 84 or 87 lies more than 2 mm off the outline, or misses one of its corners. It was not used; the curve through the drawn points is.",
    ),
    code(
        "vertex-count-differs",
        "An entity says how many points it has, and has another number. The points that are there were read.",
    ),
    code(
        "wedge-not-a-dart",
        "A wedge in the outline has the shape of a dart, but its legs or its angle do not fit one. Declare it with [[dart]] in the sewing file if it is one.",
    ),
];
