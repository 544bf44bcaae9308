//! One difference.

use serde::Serialize;

/// A kind of thing that differs; the order is that of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// Files that were read.
    Inputs,
    /// Stages and their parameters.
    Parameters,
    /// Fabrics.
    Fabric,
    /// Pieces of the pattern.
    Pieces,
    /// Darts.
    Darts,
    /// Seams.
    Seams,
    /// Measures of pattern, cloth and body.
    Measures,
    /// Strain and the rest of the certificate.
    Strain,
    /// The draped surface.
    Shape,
    /// Findings.
    Findings,
}

impl Group {
    /// Its word in reports and tolerance files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Inputs => "inputs",
            Self::Parameters => "parameters",
            Self::Fabric => "fabric",
            Self::Pieces => "pieces",
            Self::Darts => "darts",
            Self::Seams => "seams",
            Self::Measures => "measures",
            Self::Strain => "strain",
            Self::Shape => "shape",
            Self::Findings => "findings",
        }
    }
}

/// Is a number further from zero than allowed? One that is no number is.
pub fn exceeds(by: f64, most: f64) -> bool {
    by.is_nan() || by.abs() > most
}

/// A difference: a number that changed by so much, or words.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Kind.
    pub group: Group,
    /// The thing that differs.
    pub what: String,
    /// How it was; nothing if it was not there.
    pub before: Option<String>,
    /// How it is; nothing if it is gone.
    pub after: Option<String>,
    /// By how much, in its unit; nothing for words.
    pub by: Option<f64>,
    /// Unit of `by`.
    pub unit: &'static str,
}

/// A line in a table of a page.
pub(super) struct Line {
    /// The table in which it stands.
    pub group: Group,
    /// The thing that differs.
    pub what: String,
    /// The difference in words.
    pub words: String,
    /// True where the difference is larger than its tolerance.
    pub is_over: bool,
}

impl Change {
    /// Words that differ; nothing if they are the same.
    pub fn of_words(
        group: Group,
        what: impl Into<String>,
        before: Option<String>,
        after: Option<String>,
    ) -> Option<Self> {
        (before != after).then(|| Self { group, what: what.into(), before, after, by: None, unit: "" })
    }

    /// A number that differs by more than `least`; numbers are told in `unit`.
    pub fn of_number(
        group: Group,
        what: impl Into<String>,
        [a, b]: [f64; 2],
        unit: &'static str,
        least: f64,
    ) -> Option<Self> {
        let by = b - a;
        let shown = |x: f64| Some(format!("{x:.3} {unit}").trim_end().to_owned());
        let change = Self { group, what: what.into(), before: shown(a), after: shown(b), by: Some(by), unit };
        exceeds(by, least).then_some(change)
    }

    /// Something that was moved by so much, and stands nowhere as a number itself.
    pub fn moved(group: Group, what: impl Into<String>, by: f64, unit: &'static str, least: f64) -> Option<Self> {
        let change = Self { group, what: what.into(), before: None, after: None, by: Some(by), unit };
        exceeds(by, least).then_some(change)
    }

    /// The difference in words.
    #[must_use]
    pub fn words(&self) -> String {
        let unit = self.unit;
        match (&self.before, &self.after, self.by) {
            (Some(a), Some(b), Some(by)) => format!("{a} → {b} ({by:+.3} {unit})").replace(" )", ")"),
            (Some(a), Some(b), None) => format!("{a} → {b}"),
            (None, None, by) => format!("{:.3} {unit}", by.unwrap_or(0.0)),
            (Some(a), None, _) => format!("{a}, and is gone"),
            (None, Some(b), _) => format!("{b}, and is new"),
        }
    }
}
