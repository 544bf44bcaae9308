//! The methods that are compared.

use crate::study::Setting;
use toile_stages::drape::{AccuracyName, CorrectionName, IntegratorName, ModelName, PenaltyName};

/// How a method comes to a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The pieces are sewn, and that is all.
    SewnOnly,
    /// A model of the cloth, a way to the rest, a correction of over-elongation, and a law of contact.
    Draped(ModelName, IntegratorName, CorrectionName, PenaltyName),
}

/// A method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Method {
    /// Its name in the table.
    pub name: &'static str,
    /// Its source in the literature.
    pub source: &'static str,
    /// A sentence about it.
    pub about: &'static str,
    /// Its settings.
    pub way: Way,
}

/// A method that drapes.
const fn draped(
    name: &'static str,
    source: &'static str,
    about: &'static str,
    (model, integrator, correction, penalty): (ModelName, IntegratorName, CorrectionName, PenaltyName),
) -> Method {
    Method { name, source, about, way: Way::Draped(model, integrator, correction, penalty) }
}

/// All methods, in the order of the table.
pub const METHODS: [Method; 8] = [
    draped(
        "toile",
        "this program",
        "Coupled triangles, and a descent to the least energy without time.",
        (ModelName::Coupled, IntegratorName::Static, CorrectionName::Kang, PenaltyName::Linear),
    ),
    draped(
        "springs",
        "Liu, Chen, Shi 2003, equations 2 and 3",
        "Springs on the mesh edges as in the paper, and the descent of this program.",
        (ModelName::Springs, IntegratorName::Static, CorrectionName::Kang, PenaltyName::Linear),
    ),
    draped(
        "paper",
        "Liu, Chen, Shi 2003",
        "Springs, sewing forces and central differences as in the paper; over-long yarns are corrected after Kang 2000.",
        (ModelName::Springs, IntegratorName::CentralDifference, CorrectionName::Kang, PenaltyName::Linear),
    ),
    draped(
        "penalty",
        "Liu, Chen, Shi 2003, equation 6",
        "As `paper`, but contacts push by c exp(1/d) as it is written.",
        (ModelName::Springs, IntegratorName::CentralDifference, CorrectionName::Kang, PenaltyName::Exponential),
    ),
    draped(
        "provot",
        "Provot 1995",
        "As `paper`, but over-long springs are corrected once a step in their order.",
        (ModelName::Springs, IntegratorName::CentralDifference, CorrectionName::Provot, PenaltyName::Linear),
    ),
    draped(
        "explicit-triangles",
        "this program",
        "As `paper`, but with coupled triangles instead of springs.",
        (ModelName::Coupled, IntegratorName::CentralDifference, CorrectionName::Kang, PenaltyName::Linear),
    ),
    draped(
        "implicit",
        "Baraff, Witkin 1998",
        "Coupled triangles, and implicit steps in time until nothing moves.",
        (ModelName::Coupled, IntegratorName::Implicit, CorrectionName::Kang, PenaltyName::Linear),
    ),
    Method {
        name: "sewn-only",
        source: "as systems for 2D to 3D alone",
        about: "The garment of `paper` as it is sewn round the body, without weight.",
        way: Way::SewnOnly,
    },
];

/// The setting by whose drape the others are measured: the program's own method, twenty times nearer to rest.
#[must_use]
pub fn reference() -> Setting {
    Setting { accuracy: AccuracyName::Reference, ..Setting::plain(None) }
}

impl Method {
    /// It runs where no methods are named. The force of equation 6 jumps at the gap, so cloth in contact never comes to rest,
    /// and minutes pass.
    #[must_use]
    pub fn runs_by_default(&self) -> bool {
        !matches!(self.way, Way::Draped(.., PenaltyName::Exponential))
    }

    /// The setting that is run for it, on the mesh of the pipeline.
    #[must_use]
    pub fn setting(&self) -> Setting {
        let plain = Setting::plain(None);
        match self.way {
            Way::SewnOnly => {
                Setting { model: ModelName::Springs, integrator: IntegratorName::CentralDifference, ..plain }
            }
            Way::Draped(model, integrator, correction, penalty) => {
                Setting { model, integrator, correction, penalty, ..plain }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_drape_has_a_folder_of_its_own() {
        let draped = METHODS.iter().filter(|m| m.way != Way::SewnOnly).map(Method::setting);
        let names: BTreeSet<String> = draped.chain([reference()]).map(|s| s.name()).collect();
        assert_eq!(names.len(), METHODS.len());
    }
}
