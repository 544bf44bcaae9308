//! Codes of making a body from measures.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// No figure of this kind has these measures together; the message names the nearest. Exit code 2.
    BODY_MEASURE_NOT_MET = "body-measure-not-met";

    /// A measure is none that a body has; the message gives the range. Exit code 2; 3 where a side file says it.
    BODY_MEASURE_OUT_OF_RANGE = "body-measure-out-of-range";

    /// Two measures do not go with each other, e.g. a hip above the waist. Exit code 2.
    BODY_MEASURES_CONTRADICT = "body-measures-contradict";

    /// What the side file of a body says is not on its mesh: another girth, a height over its top, a landmark beside it.
    BODY_NOT_AS_SAID = "body-not-as-said";

    /// The measures give a surface that folds or grows together. Bring them closer to a usual size. Exit code 2.
    BODY_NOT_CLEAN = "body-not-clean";
}
