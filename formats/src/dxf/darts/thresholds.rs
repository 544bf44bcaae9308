//! Every number by which darts are found, weighed and denied.
//!
//! Lengths are millimetres, angles degrees, shares have no unit. Each constant says what a larger and a smaller value
//! would do. Most were chosen by hand, and no measurement of the single number is kept; where one is known it is told.
//!
//! The whole set was last tried on pieces of known truth when blunt apexes, zigzag edges and boxes were added: 355 of
//! 364 true darts were found, and 25 were invented. The tests `dart_forms` and `dart_loose` hold one drawing of every
//! form, and one of most look-alikes.

use std::ops::RangeInclusive;

// ---- The test of two legs (`legs_test.rs`), for wedges and marked darts alike.

/// Widest angle between the legs of a dart, degrees. A larger one takes necklines and vents; a smaller one loses wide
/// bust darts. No measurement is kept.
pub const ANGLE_OF_DART: f64 = 60.0;
/// Length of a leg, mm. A smaller lower end takes notches cut into the outline for darts; a larger upper end takes
/// godets and long vents. No measurement is kept.
pub const LENGTH_OF_LEG: RangeInclusive<f64> = 25.0..=400.0;
/// Shorter leg over longer leg, at least. A larger share loses darts that lean; a smaller one takes corners of
/// collars and lapels. No measurement is kept.
pub const RATIO_OF_LEGS: f64 = 0.6;
/// Width of the mouth, mm. A smaller lower end takes slivers of two lines drawn twice; a larger one loses needle darts,
/// whose narrowest known intake is 3.4 mm over 188 mm. A larger upper end takes necklines and vents; a smaller one
/// loses wide bust darts.
pub const WIDTH_OF_MOUTH: RangeInclusive<f64> = 2.0..=150.0;

// ---- Wedges in the outline (`wedge.rs`).

/// The outline turns back at an apex by this or more, degrees. A larger turn loses wide darts; a smaller one only
/// costs time, as the angle of the legs is tested later. No measurement is kept.
pub const TURN_OF_APEX: f64 = 90.0;
/// A leg ends at a corner that turns more than this, degrees. A larger turn runs past shallow mouths; a smaller one
/// ends curved legs early. No measurement is kept.
pub const TURN_OF_LEG_END: f64 = 20.0;
/// Farthest look along the outline from an apex, mm. A larger one costs time; a smaller one loses lenses that are cut
/// open down to the hem. No measurement is kept.
pub const LENGTH_OF_WALK: f64 = 1000.0;
/// Path of a leg over its chord, at most. A larger share takes armholes for legs; a smaller one loses curved darts.
/// No measurement is kept.
pub const BOW_OF_LEG: f64 = 1.15;
/// Where the mouth is probed for cloth, as the share of the way from its middle to the apex. A larger share loses
/// darts with a cap; a smaller one is lost in rounding. No measurement is kept.
pub const PLACE_OF_PROBE: f64 = 0.05;
/// Distance of the legs of an open lens at the edge over its greatest width, at most. A larger share takes bent wedges
/// for lenses; a smaller one loses lenses cut open with a wide slit. No measurement is kept.
pub const SLIT_OF_OPEN_LENS: f64 = 0.25;

// ---- Blunt apexes (`blunt.rs`, `marked/legs.rs`, `lens.rs`).

/// Two vertices at most this far apart can be one apex, mm. A larger distance takes the bottom of boxes for an apex; a
/// smaller one loses darts drawn blunt. No measurement is kept.
pub const WIDTH_OF_BLUNT_APEX: f64 = 2.0;
/// Width of a blunt apex over that of the mouth, at most. A larger share takes slits with a flat bottom for darts; a
/// smaller one loses narrow darts drawn blunt. No measurement is kept.
pub const SHARE_OF_BLUNT_APEX: f64 = 0.25;
/// Most apexes that are joined in one outline; a limit on time.
pub const COUNT_OF_BLUNT_APEXES: usize = 500;
/// Fewest vertices of an outline with a blunt apex: two for it, two for its mouth, two for the rest of the piece.
pub const VERTICES_OF_BLUNT_OUTLINE: usize = 6;
/// Vertices of a dense copy (layers 84, 87) are those of the outline within this, mm. A larger distance joins the
/// wrong vertices; a smaller one leaves the copy blunt. No measurement is kept.
pub const DISTANCE_OF_COPY_VERTEX: f64 = 0.1;
/// Turn points and grade rules stand at a vertex within this, mm. A larger distance carries rules of neighbours along;
/// a smaller one leaves them where no vertex is. No measurement is kept.
pub const DISTANCE_OF_VERTEX_MARK: f64 = 0.02;

// ---- Zigzag edges (`zigzag.rs`).

/// Mouth points this near each other are one, mm. A larger distance makes rows of separate darts; a smaller one misses
/// teeth with a flat between them. No measurement is kept.
pub const DISTANCE_OF_SHARED_MOUTH: f64 = 0.5;
/// Teeth of a row differ by at most this share, in width and in the length of their sides. A larger share makes rows
/// of unlike darts; a smaller one misses teeth drawn by hand. No measurement is kept.
pub const DIFFERENCE_OF_TEETH: f64 = 0.15;
/// Points of the teeth of a row differ by at most this, degrees. Larger and smaller do as for the widths. No
/// measurement is kept.
pub const ANGLE_OF_TEETH: f64 = 15.0;
/// So many wedges side by side, or more, are a row. A larger count takes short zigzags for darts; a smaller one loses
/// two darts that share a mouth point. No measurement is kept.
pub const COUNT_OF_TEETH: usize = 3;

// ---- Darts marked by internal lines (`marked/`).

/// Two drawings of one dart differ by at most this, mm. A larger distance merges neighbours; a smaller one counts a
/// dart twice. No measurement is kept.
pub const DISTANCE_OF_SAME_DART: f64 = 1.0;
/// Most internal lines that are looked at, and most darts; a limit on time.
pub const COUNT_OF_MARKED_LINES: usize = 2000;
/// Ends of legs lie on the outline within this, mm. A larger distance takes pocket lines near the edge for legs; a
/// smaller one loses legs drawn short. No measurement is kept.
pub const DISTANCE_OF_LEG_END: f64 = 1.0;
/// Leg ends nearer to the outline than this are left where they are, mm. A larger distance leaves gaps at the mouth; a
/// smaller one moves ends by rounding alone. No measurement is kept.
pub const DISTANCE_OF_EXACT_END: f64 = 0.05;
/// A leg meets the outline at most this far from where it ends beside it, mm. A larger reach bends legs that run along
/// the edge; a smaller one leaves their ends off the edge. No measurement is kept.
pub const REACH_OF_LEG: f64 = 5.0;
/// Legs run at most this far past the edge, mm. A larger overrun takes lines of other pieces; a smaller one loses
/// legs. Some writers draw internal lines 20 mm longer (seen in files, not counted).
pub const OVERRUN_OF_LEG: f64 = 25.0;
/// Legs that share their apex end this near each other, mm. A larger distance mixes the legs of two darts; a smaller
/// one loses the centre line. No measurement is kept.
pub const DISTANCE_OF_SAME_APEX: f64 = 0.2;
/// Two legs may miss each other at the apex by this, mm. A larger gap pairs lines that are none; a smaller one loses
/// darts drawn loosely. The test `dart_loose` holds that lines 5 mm apart are two.
pub const GAP_OF_LEGS: f64 = 1.0;
/// A leg that ends beside the other one within this is a little short, mm. A larger gap moves the apex to the longer
/// leg more often; a smaller one puts it in the middle. No measurement is kept.
pub const GAP_OF_SHORT_LEG: f64 = 0.1;
/// Mouth points of one leg drawn twice lie this near each other, mm. A larger distance merges the legs of very narrow
/// darts; a smaller one counts a leg twice. No measurement is kept.
pub const DISTANCE_OF_SAME_LEG: f64 = 1.0;
/// The apex of a marked dart lies at least this far inside the outline, mm. A larger depth loses small darts; a smaller
/// one takes strokes along the edge. No measurement is kept.
pub const DEPTH_OF_MARKED_APEX: f64 = 5.0;
/// Two vertices side by side are one apex when they turn more than this together, degrees. A larger turn leaves blunt
/// apexes blunt; a smaller one takes bends of a leg for the apex. No measurement is kept.
pub const TURN_OF_TWIN_APEX: f64 = 60.0;
/// The angle at the point of a box is taken from the first part of the sides, mm. A larger length takes the angle of
/// whole legs; a smaller one that of a rounded tip. No measurement is kept.
pub const LENGTH_OF_TIP: f64 = 20.0;
/// A corner of a leg this near the mouth is the way over an allowance, mm. A larger distance takes plackets for darts;
/// a smaller one loses darts whose legs turn at the sew line. No measurement is kept.
pub const DISTANCE_OF_ALLOWANCE_CORNER: f64 = 15.0;
/// Shorter chords say nothing of a direction, mm. A larger length misses corners; a smaller one sees corners in
/// rounding. No measurement is kept.
pub const LENGTH_OF_CHORD: f64 = 0.5;

// ---- Fish-eye darts (`lens.rs`).

/// Length of a lens from tip to tip, mm. A smaller lower end takes buttonholes and eyelets; a larger upper end takes
/// panels. No measurement is kept.
pub const LENGTH_OF_LENS: RangeInclusive<f64> = 40.0..=600.0;
/// Width of a lens at its widest place, mm. A smaller lower end takes doubled lines; a larger upper end takes cutouts.
/// No measurement is kept.
pub const WIDTH_OF_LENS: RangeInclusive<f64> = 3.0..=100.0;
/// Length of a lens over its width, at least; also of a kite of drill holes. A larger share loses short wide darts; a
/// smaller one takes round pockets. No measurement is kept.
pub const SLIMNESS_OF_LENS: f64 = 2.5;
/// Widest angle at a tip of a lens, degrees. A larger angle takes boxes for lenses; a smaller one loses wide lenses.
/// No measurement is kept.
pub const ANGLE_OF_LENS_TIP: f64 = 75.0;
/// Where the widest place of a lens lies, as the share of its length. A wider range takes half-drops and leaves; a
/// narrower one loses lenses that are widest near a tip. No measurement is kept.
pub const PLACE_OF_LENS_WIDTH: RangeInclusive<f64> = 0.15..=0.85;
/// The sides of a lens differ in length by at most this share. A larger share takes pocket bags; a smaller one loses
/// lenses with one straight side. No measurement is kept.
pub const DIFFERENCE_OF_LENS_SIDES: f64 = 0.1;
/// Most vertices of a lens; a limit on time.
pub const VERTICES_OF_LENS: usize = 2000;
/// Most closed lines that are looked at as lenses; a limit on time.
pub const COUNT_OF_LENSES: usize = 2000;
/// The tips of a lens are sought among about as many of its vertices; a limit on time.
pub const SAMPLES_OF_LENS: usize = 400;
/// Ends of the strokes of one lens meet within this, mm. A larger gap joins lines of other parts; a smaller one loses
/// lenses drawn in strokes. No measurement is kept.
pub const GAP_OF_STROKES: f64 = 0.5;
/// Most strokes that are chained to lenses; a limit on time.
pub const COUNT_OF_STROKES: usize = 400;
/// A drill hole this near a tip makes a lens a dart without doubt, mm. A larger distance takes drills of pockets; a
/// smaller one loses drills put well inside. No measurement is kept.
pub const DISTANCE_OF_LENS_DRILL: f64 = 20.0;
/// Share of the width on the flatter side of a lens, below which it is a pocket opening. A larger share loses darts
/// with one flat side; a smaller one takes pocket openings. No measurement is kept.
pub const SHARE_OF_FLAT_SIDE: f64 = 0.2;
/// Cosine between lens and grain below which the lens lies across it: 0.5 is 60 degrees. A larger cosine loses slanted
/// darts; a smaller one takes slanted pockets. No measurement is kept.
pub const COSINE_OF_POCKET: f64 = 0.5;

// ---- Darts cut in two by the fold (`on_fold.rs`).

/// Points this near the fold lie on it, mm. A larger distance mirrors darts beside the fold into one; a smaller one
/// loses darts drawn loosely. No measurement is kept.
pub const DISTANCE_OF_FOLD_POINT: f64 = 0.5;
/// Wider wedges on a fold are necklines, mm. A larger width takes V necks; a smaller one loses wide darts at a centre.
/// No measurement is kept.
pub const WIDTH_OF_FOLD_NECKLINE: f64 = 60.0;
/// Blunter wedges on a fold are necklines, degrees. Larger and smaller do as for the width. No measurement is kept.
pub const ANGLE_OF_FOLD_NECKLINE: f64 = 30.0;
/// Most vertices of a line that is mirrored at the fold; a limit on time.
pub const VERTICES_OF_HALF_LINE: usize = 2000;

// ---- Necklines of whole pieces (`neckline.rs`).

/// A wedge in the middle of a symmetric piece is a neckline if it is wider than this, mm, and blunter than
/// [`ANGLE_OF_NECKLINE`]. A larger width takes V necks; a smaller one loses wide waist darts. The test `dart_loose`
/// holds drawings of both kinds.
pub const WIDTH_OF_NECKLINE: f64 = 80.0;
/// A wide wedge in the middle is a neckline if it is blunter than this, degrees. Larger and smaller do as for the
/// width. The test `dart_loose` holds drawings of both kinds.
pub const ANGLE_OF_NECKLINE: f64 = 30.0;
/// Between shoulders a wedge wider than this is a neckline at any angle, mm. A larger width takes narrow V necks; a
/// smaller one loses darts between slanted edges. The test `dart_loose` holds drawings of both kinds.
pub const WIDTH_OF_COLLARED_NECKLINE: f64 = 60.0;
/// Between shoulders a wedge blunter than this is a neckline, degrees, if it is wider than
/// [`WIDTH_OF_BLUNT_NECKLINE`]. Larger and smaller do as for the widths. No measurement is kept.
pub const ANGLE_OF_BLUNT_NECKLINE: f64 = 30.0;
/// Between shoulders a blunt wedge wider than this is a neckline, mm. A larger width takes small V necks; a smaller
/// one loses blunt darts. No measurement is kept.
pub const WIDTH_OF_BLUNT_NECKLINE: f64 = 40.0;
/// Shoulders fall away from the mouth by more than this, degrees. A larger angle takes flat shoulders for a waist; a
/// smaller one takes a waist that curves for shoulders. No measurement is kept.
pub const ANGLE_OF_SHOULDER: f64 = 5.0;
/// The slope of a shoulder is taken over at least this, mm. A larger length looks past short shoulders; a smaller one
/// sees only the corner. No measurement is kept.
pub const LENGTH_OF_SLOPE: f64 = 10.0;
/// A mouth point is the vertex of the outline within this, mm. A larger distance takes a neighbour; a smaller one
/// loses mouths moved by rounding. No measurement is kept.
pub const DISTANCE_OF_MOUTH_VERTEX: f64 = 0.5;
/// Fewest corners of a piece that has a neckline: fewer are a gore or a godet. No measurement is kept.
pub const CORNERS_OF_NECKED_PIECE: usize = 5;
/// A point has a mirror image where the outline passes within this, mm. A larger distance calls uneven pieces
/// symmetric; a smaller one calls a blouse front with a placket uneven. No measurement is kept.
pub const DISTANCE_OF_MIRROR_IMAGE: f64 = 2.0;
/// A piece is symmetric when this share of its points, as numerator and denominator, has a mirror image. Larger and
/// smaller do as for the distance, the other way round. No measurement is kept.
pub const SHARE_OF_MIRROR_IMAGES: (usize, usize) = (9, 10);
/// Symmetry is looked for at about as many vertices; a limit on time.
pub const SAMPLES_OF_SYMMETRY: usize = 400;

// ---- Drill holes and notches without lines (`drill.rs`): candidates, never darts.

/// A drill hole this near an apex or a mouth point belongs to a dart that was found, mm. A larger distance loses
/// candidates beside a dart; a smaller one tells a dart twice. No measurement is kept.
pub const DISTANCE_OF_TAKEN_DRILL: f64 = 30.0;
/// Most free drill holes that are looked at as corners of a lens; a limit on time.
pub const COUNT_OF_FREE_DRILLS: usize = 60;
/// Three holes of a lens run along the grain within this, degrees. A larger angle takes buttons; a smaller one loses
/// slanted darts. No measurement is kept.
pub const ANGLE_OF_DRILL_ROW: f64 = 25.0;
/// Least distance of the outer ones of three holes, mm; [`LENGTH_OF_LENS`] tells the most. A larger length loses short
/// darts; a smaller one takes buttons. No measurement is kept.
pub const LENGTH_OF_DRILL_ROW: f64 = 80.0;
/// Where the middle one of three holes lies, as the share of the length. A wider range takes holes of other meaning; a
/// narrower one loses lenses that are widest near a tip. No measurement is kept.
pub const PLACE_OF_MIDDLE_DRILL: RangeInclusive<f64> = 0.25..=0.75;
/// Length of a row of three holes over the distance of the middle one from its axis, at least. A larger share loses
/// wide lenses; a smaller one takes triangles of holes. No measurement is kept.
pub const SLIMNESS_OF_DRILL_ROW: f64 = 8.0;
/// The axes of a kite of four holes are square within this cosine. A larger cosine takes any four holes; a smaller one
/// loses kites placed by hand. No measurement is kept.
pub const COSINE_OF_KITE: f64 = 0.05;
/// The middle of the side holes of a kite lies on its axis within this share of the width. Larger and smaller do as
/// for the cosine. No measurement is kept.
pub const OFFSET_OF_KITE: f64 = 0.1;
/// Where the side holes of a kite lie, as the share of its length. Larger and smaller do as for three holes. No
/// measurement is kept.
pub const PLACE_OF_KITE_SIDES: RangeInclusive<f64> = 0.2..=0.8;
/// Most drill holes that are looked at with notches, and most notches about each; a limit on time.
pub const COUNT_OF_CANDIDATE_MARKS: usize = 200;
/// Distances from a drill hole to both notches differ by at most this share: the hole lies on the axis of the mouth. A
/// larger share takes buttons and eyelets; a smaller one loses darts that lean. No measurement is kept.
pub const DIFFERENCE_OF_CANDIDATE_LEGS: f64 = 0.02;
/// Least angle of a candidate, degrees: two notches and a hole alone say little. A larger angle loses narrow darts; a
/// smaller one takes notches of a seam. No measurement is kept.
pub const ANGLE_OF_CANDIDATE: f64 = 5.0;

// ---- Pleats (`pleat.rs`): told, never made.

/// Ends of fold lines lie on the outline within this, mm. A larger distance takes stitch lines near the edge; a
/// smaller one loses lines drawn short. No measurement is kept.
pub const DISTANCE_OF_PLEAT_END: f64 = 1.0;
/// Distance of the two fold lines at the edge, mm. A wider range takes pockets and plackets; a narrower one loses
/// small tucks and wide box pleats. No measurement is kept.
pub const WIDTH_OF_PLEAT: RangeInclusive<f64> = 5.0..=120.0;
/// Length of a fold line, mm. A wider range takes notches and whole seams; a narrower one loses short tucks and long
/// pleats. No measurement is kept.
pub const LENGTH_OF_PLEAT: RangeInclusive<f64> = 20.0..=1500.0;
/// Path of a fold line over its chord, at most. A larger share takes curves; a smaller one loses lines with rounding.
/// No measurement is kept.
pub const BOW_OF_PLEAT: f64 = 1.02;
/// Lines that converge less are a pleat, more a dart-pleat, degrees. Larger and smaller only change the word. No
/// measurement is kept.
pub const ANGLE_OF_PLEAT: f64 = 2.0;
/// Lines that converge more are neither, degrees. A larger angle takes yokes and pockets; a smaller one loses wide
/// dart-pleats. No measurement is kept.
pub const ANGLE_OF_DART_PLEAT: f64 = 40.0;
/// Shorter fold line over the longer, at least. A larger share loses pleats that run out slanted; a smaller one pairs
/// lines that do not belong together. No measurement is kept.
pub const RATIO_OF_PLEAT_LINES: f64 = 0.9;
/// Distance of the fold lines inside over that at the edge, at most. A larger share takes flares; a smaller one loses
/// parallel lines with rounding. No measurement is kept.
pub const SPREAD_OF_PLEAT: f64 = 1.1;
/// Cosine between mouth and fold line, at most: 0.5 is 60 degrees. A larger cosine pairs lines that are shifted along
/// themselves; a smaller one loses pleats at a slanted edge. No measurement is kept.
pub const COSINE_OF_PLEAT: f64 = 0.5;
/// A notch marks the end of a fold line within this, mm. A larger distance takes notches of the seam; a smaller one
/// loses notches on the cut line. No measurement is kept.
pub const DISTANCE_OF_PLEAT_NOTCH: f64 = 3.0;
/// Most lines that are paired; a limit on time.
pub const COUNT_OF_PLEAT_LINES: usize = 200;
/// Confidence of two lines side by side, 0 to 1. It is told, and decides nothing.
pub const CONFIDENCE_OF_PLEAT: f64 = 0.4;
/// Confidence that a notch at the end of each fold line adds. It is told, and decides nothing.
pub const CONFIDENCE_OF_PLEAT_NOTCHES: f64 = 0.35;
/// Confidence that a word of the trade beside the lines adds. It is told, and decides nothing.
pub const CONFIDENCE_OF_PLEAT_WORD: f64 = 0.2;

// ---- Evidence (`evidence.rs`): the table of points by which a wedge is a dart, undecided, or none.

/// A wedge with so many points, or more, is a dart. A larger count loses darts that are drawn bare; a smaller one takes
/// slits. The tests `dart_evidence` hold a drawing on either side of it.
pub const POINTS_OF_DART: i32 = 3;
/// A wedge with so many points, or more, is told as undecided; with fewer it is none. A larger count hides needle darts
/// that nothing marks; a smaller one tells of every sliver.
pub const POINTS_OF_DOUBT: i32 = 1;
/// Points for an angle that slits do not have. They carry a bare wedge over [`POINTS_OF_DART`] alone.
pub const POINTS_OF_WIDE_ANGLE: i32 = 4;
/// Points for legs drawn as lines that meet inside: somebody drew them on purpose.
pub const POINTS_OF_LINES: i32 = 2;
/// Points for a closed line, sharp at both ends and alike on both sides.
pub const POINTS_OF_LENS: i32 = 5;
/// Points for a drill hole at the apex: alone it makes a needle a dart.
pub const POINTS_OF_DRILL: i32 = 3;
/// Points for a notch at each mouth point: alone they make a needle a dart.
pub const POINTS_OF_NOTCHES: i32 = 3;
/// Points for a word of the trade beside it: "dart", "pince", "pinza", "Abnäher".
pub const POINTS_OF_WORD: i32 = 3;
/// Points for the folded cap of a mouth.
pub const POINTS_OF_CAP: i32 = 2;
/// Points for legs of one length.
pub const POINTS_OF_EQUAL_LEGS: i32 = 1;
/// Points for apex and mouth that are turn points.
pub const POINTS_OF_TURN_POINTS: i32 = 1;
/// Points for a dart of the same size that is its like or its mirror image, and is sure.
pub const POINTS_OF_SIBLING: i32 = 1;
/// Points for the same wedge of the same piece in another size, where it is a dart: a nest narrows its darts.
pub const POINTS_OF_OTHER_SIZE: i32 = 3;
/// Points against legs of different lengths.
pub const POINTS_OF_UNEQUAL_LEGS: i32 = -1;
/// Points against the shape of a slit or vent: long, narrow, and without notches and drill hole. They leave one that is
/// drawn as two lines undecided, unless its apex and mouth are turn points.
pub const POINTS_OF_SLIT: i32 = -5;
/// Points against a wedge that nothing marks, in a file that drills its darts.
pub const POINTS_OF_UNMARKED: i32 = -4;
/// Points against a word beside it that says slit, vent or pleat. It outweighs a bare wedge with notches.
pub const POINTS_OF_OTHER_WORD: i32 = -10;
/// Points against a wedge whose legs are as long as the sides of another piece's point. No evidence outweighs it.
pub const POINTS_OF_INSERT: i32 = -40;
/// So many points halve the doubt in the confidence that is told: `1 - 2^(-points / this)`.
pub const POINTS_THAT_HALVE_DOUBT: f64 = 2.5;
/// Confidence of any dart: nothing is sure and nothing impossible.
pub const RANGE_OF_CONFIDENCE: RangeInclusive<f64> = 0.05..=0.99;
/// Least angle of a wedge in the outline that no slit has, degrees. A larger angle loses bare darts; a smaller one
/// takes slits. Slits and slivers of real files stay below 3 degrees (measured); bare darts go down to 4.3.
pub const ANGLE_OF_WIDE_WEDGE: f64 = 3.5;
/// The same of legs drawn as lines, degrees: they are drawn on purpose. A larger angle loses narrow darts; a smaller
/// one takes doubled lines. No measurement is kept.
pub const ANGLE_OF_WIDE_LINES: f64 = 2.0;
/// A wedge longer than this, mm, and narrower than [`ANGLE_OF_SLIT`] has the shape of a slit. A larger length takes
/// slits; a smaller one loses long darts. Darts of skirts and trousers of four sizes reach 211 mm, slits 298 mm.
pub const LENGTH_OF_SLIT: f64 = 220.0;
/// A wedge narrower than this, degrees, and longer than [`LENGTH_OF_SLIT`] has the shape of a slit. A larger angle
/// loses long darts; a smaller one takes slits. Darts longer than 200 mm have 6.5 degrees or more, slits 3.8.
pub const ANGLE_OF_SLIT: f64 = 6.0;
/// A text belongs to a wedge if it begins in it, or at most this far from it, mm. A larger distance takes texts of
/// neighbours; a smaller one loses texts beside a needle. No measurement is kept.
pub const DISTANCE_OF_WORD: f64 = 25.0;
/// The cap of a mouth rises over both mouth points by this or more, mm, and by this share of the width or more. Larger
/// numbers lose flat caps; smaller ones take the curve of the edge. No measurement is kept.
pub const RISE_OF_CAP: (f64, f64) = (1.0, 0.05);
/// Where the top of a cap lies, as the share of the mouth. A wider range takes mouth points; a narrower one loses caps
/// of darts that are folded to one side. No measurement is kept.
pub const PLACE_OF_CAP: RangeInclusive<f64> = 0.1..=0.9;
/// The top of a cap lies at most this far from the mouth, mm, or its width, whichever is more: an allowance is between
/// them. A larger distance takes other edges; a smaller one loses caps on the cut line. No measurement is kept.
pub const DISTANCE_OF_CAP: f64 = 30.0;
/// Siblings differ by at most this share in width and in the length of both legs. A larger share makes siblings of
/// unlike darts; a smaller one loses those of uneven pieces. No measurement is kept.
pub const DIFFERENCE_OF_SIBLINGS: f64 = 0.02;
/// A turn point of layer 2 stands at a corner within this, mm. A larger distance takes points of neighbours; a smaller
/// one loses points moved by rounding. No measurement is kept.
pub const DISTANCE_OF_TURN_POINT: f64 = 0.05;
/// A hole at most this far from the apex drills a dart, mm: the trade puts it 10 to 15 mm short of the apex. A larger
/// distance takes drills of pockets; a smaller one loses some of the trade's. No measurement is kept.
pub const DISTANCE_OF_APEX_DRILL: f64 = 30.0;
/// That hole lies in the dart or this near it, mm. Larger and smaller do as for the distance. No measurement is kept.
pub const MARGIN_OF_APEX_DRILL: f64 = 20.0;
/// A notch belongs to a mouth point within this, mm, across an allowance. A larger distance takes notches of the seam;
/// a smaller one loses notches on the cut line. No measurement is kept.
pub const DISTANCE_OF_MOUTH_NOTCH: f64 = 14.0;
/// Legs are of one length when they differ by at most this share of the longer.
pub const DIFFERENCE_OF_EQUAL_LEGS: f64 = 0.01;
/// Legs are of different lengths when they differ by more than this share of the longer.
pub const DIFFERENCE_OF_UNEQUAL_LEGS: f64 = 0.1;

// ---- Evidence of the rest of the file (`decide.rs`, `insert.rs`).

/// Fewest drilled darts that make a habit, if those without are no more. A larger count keeps slits as darts; a smaller
/// one lets a single hole deny all others. No measurement is kept.
pub const COUNT_OF_HABIT: usize = 2;
/// A side of an insert is as long as a leg within this share of the leg. A larger share denies darts beside pieces of
/// like size; a smaller one keeps places for godets as darts. No measurement is kept.
pub const DIFFERENCE_OF_INSERT: f64 = 0.004;
/// A side of an insert is as long as a leg within this in any case, mm. Larger and smaller do as for the share. No
/// measurement is kept.
pub const DISTANCE_OF_INSERT: f64 = 0.5;
/// Corners of an insert turn more than this, degrees. A larger turn runs its sides past shallow corners; a smaller one
/// ends them at curve points. No measurement is kept.
pub const TURN_OF_INSERT_CORNER: f64 = 20.0;
/// The point of an insert turns more than this, degrees: 100 or less lie inside. A larger turn misses blunt godets; a
/// smaller one takes any corner. No measurement is kept.
pub const TURN_OF_INSERT_POINT: f64 = 80.0;
/// Fewest corners of an insert.
pub const CORNERS_OF_INSERT: usize = 3;
/// Most vertices of an outline that is looked at as an insert; a limit on time.
pub const VERTICES_OF_INSERT: usize = 5000;

// ---- The finding `dart-legs-differ` (`legs_differ.rs`).

/// Legs that differ by more than this, mm, and by more than [`SHARE_OF_LEG_DIFFERENCE`] are told. A larger difference
/// hides mistakes; a smaller one tells of rounding. No measurement is kept.
pub const LENGTH_OF_LEG_DIFFERENCE: f64 = 1.0;
/// Legs that differ by more than this share of the longer, and by more than [`LENGTH_OF_LEG_DIFFERENCE`], are told.
/// A larger share hides mistakes in long darts; a smaller one tells of easing on purpose. No measurement is kept.
pub const SHARE_OF_LEG_DIFFERENCE: f64 = 0.01;
