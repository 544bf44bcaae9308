//! Codes of opening a pipeline and choosing its accuracy.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// `accuracy` of the pipeline's head, or --accuracy, chose this setting, with this error. A study of this garment
    /// that lies beside the pipeline estimates the error (`toile study`). Without one the error is the preset's bound.
    ACCURACY_CHOSEN = "accuracy-chosen";

    /// An accuracy chooses the mesh and the drape together, so the chain must have `triangulate` and `drape`. For a
    /// mesh from a file, `with.accuracy` of `drape` says how near to rest it is led. Exit code 2.
    ACCURACY_NO_STAGE = "accuracy-no-stage";

    /// Nothing that is known is as exact as asked. `toile study` measures finer meshes of this garment; its study.json,
    /// put beside the pipeline as NAME.study.json, is then chosen from. Exit code 2.
    ACCURACY_OUT_OF_REACH = "accuracy-out-of-reach";

    /// `--accuracy` or `--repeats` chose a value, and the chain has another one, which `--set` gave. `--set` has the last
    /// word. An accuracy promises nothing then. Leave out one of both.
    CHOICE_OVERRULED = "choice-overruled";

    /// `--repeats` was given for a chain in which no stage can be repeated. Exit code 2.
    REPEATS_NO_STAGE = "repeats-no-stage";

    /// The study beside the pipeline cannot be used, so the accuracy comes from the presets: it is damaged, of another
    /// version, or of another pipeline. Make it anew with `toile study`.
    STUDY_UNFIT = "study-unfit";
}
