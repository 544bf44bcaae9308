//! Codes of looking for darts in outlines and inner lines.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The apex of a dart is drawn as two vertices side by side, up to 2 mm apart. Their middle is its apex.
    DART_APEX_BLUNT = "dart-apex-blunt";

    /// Drill holes and notches may mark a dart that no line draws. Declare it with [[dart]] in the sewing file if it is
    /// one.
    DART_CANDIDATE = "dart-candidate";

    /// The two legs of a dart differ in length, so its mouth does not close flush. The difference is eased over the
    /// leg; correct the pattern if it is not meant.
    DART_LEGS_DIFFER = "dart-legs-differ";

    /// Two lines look like the folds of a pleat or dart-pleat. It is not made one unless the sewing file declares it
    /// with `[[dart]]`.
    PLEAT_CANDIDATE = "pleat-candidate";

    /// A wedge has the shape of a dart, but the evidence is against it: an insert fits into it, it is unmarked among
    /// marked darts, a text calls it a slit, its legs differ. Declare it with [[dart]] in the sewing file if it is one.
    WEDGE_NOT_A_DART = "wedge-not-a-dart";
}
