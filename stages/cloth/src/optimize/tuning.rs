//! Tuned numbers and mechanisms of the optimisation.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "optimize";

    /// Pairs of a step and its change of the gradient that the L-BFGS history keeps.
    LBFGS_PAIRS: usize = 6, {
        unit: "pairs",
        larger: "Directions use more of the past, and every solve costs two more passes over all vertices for each pair.",
        smaller: "Directions rest on the preconditioner alone, and more steps are needed between two factorisations.",
        tried: "0 to 20",
        evidence: "Six was best of those tried on the comparison scenes (docs/lab, static solver).",
    }
}

mechanisms! {
    room "optimize";
}
