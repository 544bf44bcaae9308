//! Allowed differences: a file states a tolerance for each kind.

use super::change::{Change, Group, exceeds};
use serde::Deserialize;
use toile_garment::units::Length;

/// Tolerances. Without any, every difference is over.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(try_from = "Stated")]
pub struct Tolerance(Option<Stated>);

impl TryFrom<Stated> for Tolerance {
    type Error = String;

    fn try_from(stated: Stated) -> Result<Self, String> {
        let s = &stated;
        let lengths = [
            ("pieces", s.pieces),
            ("darts", s.darts),
            ("seams", s.seams),
            ("measures", s.measures),
            ("shape", s.shape),
        ];
        let numbers = lengths.into_iter().map(|(name, l)| (name, l.map(|l| l.0))).chain([("strain", s.strain)]);
        let wrong = numbers.filter(|(_, x)| x.is_some_and(|x| x.is_nan() || x < 0.0)).map(|(name, _)| name).next();
        match wrong {
            Some(name) => Err(format!("`{name}` must be 0 or more")),
            None => Ok(Self(Some(stated))),
        }
    }
}

/// The file: lengths for what is measured in mm, `"same"` or `"any"` for words, a number for strain.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Stated {
    inputs: Option<Words>,
    parameters: Option<Words>,
    fabric: Option<Words>,
    findings: Option<Words>,
    pieces: Option<Length>,
    darts: Option<Length>,
    seams: Option<Length>,
    measures: Option<Length>,
    shape: Option<Length>,
    strain: Option<f64>,
}

/// May words differ?
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Words {
    Same,
    Any,
}

/// Reads a file of tolerances. A kind that it does not name is told and not judged.
///
/// # Errors
/// What is wrong, in words.
pub fn read_tolerance(text: &str) -> Result<Tolerance, String> {
    toml::from_str(text).map_err(|e| e.to_string())
}

impl Tolerance {
    /// Was a file read that states none at all? Then nothing is judged.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.as_ref().is_some_and(|stated| *stated == Stated::default())
    }

    /// The tolerance of a kind in words; nothing where none is stated.
    #[must_use]
    pub fn stated(&self, group: Group) -> Option<String> {
        let stated = self.0.as_ref()?;
        let length = match group {
            Group::Pieces => stated.pieces,
            Group::Darts => stated.darts,
            Group::Seams => stated.seams,
            Group::Measures => stated.measures,
            Group::Shape => stated.shape,
            Group::Strain => return stated.strain.map(|x| x.to_string()),
            Group::Inputs | Group::Parameters | Group::Fabric | Group::Findings => None,
        };
        length.map(|l| l.to_string())
    }

    /// Does it state anything?
    #[must_use]
    pub fn is_stated(&self) -> bool {
        self.0.is_some()
    }

    /// Is a difference larger than what is stated?
    #[must_use]
    pub fn is_over(&self, change: &Change) -> bool {
        let Some(stated) = &self.0 else { return true };
        let words = |w: Option<Words>| w == Some(Words::Same);
        let number = |most: Option<f64>| {
            // Something that is new or gone is over any length.
            most.is_some_and(|most| change.by.is_none_or(|by| exceeds(by, most)))
        };
        let length = |l: Option<Length>| number(l.map(|l| 1e3 * l.0));
        match change.group {
            Group::Inputs => words(stated.inputs),
            Group::Parameters => words(stated.parameters),
            Group::Fabric => words(stated.fabric),
            Group::Findings => words(stated.findings),
            // Areas and counts belong to pieces, but are no lengths.
            Group::Pieces => (change.unit == "mm" || change.by.is_none()) && length(stated.pieces),
            Group::Darts => length(stated.darts),
            Group::Seams => length(stated.seams),
            Group::Measures => length(stated.measures),
            // The alignment itself is no distance of the surfaces, and neither are they before it.
            Group::Shape => change.what.starts_with("distance of the surfaces after") && length(stated.shape),
            Group::Strain => change.what.starts_with("strain") && number(stated.strain),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stated_tolerance_judges_its_kind_alone() {
        let tolerance = read_tolerance("darts = \"2 mm\"\ninputs = \"same\"\n").expect("tolerance");
        let dart = |by| Change::moved(Group::Darts, "apex", by, "mm", 1e-3).expect("moved");
        assert!(tolerance.is_over(&dart(5.0)) && !tolerance.is_over(&dart(1.9)));
        let seam = Change::of_number(Group::Seams, "side", [1.0, 9.0], "mm", 1e-3).expect("longer");
        assert!(!tolerance.is_over(&seam) && Tolerance::default().is_over(&seam));
        let input = Change::of_words(Group::Inputs, "a", Some("1".into()), Some("2".into())).expect("other");
        assert!(tolerance.is_over(&input));
        assert!(read_tolerance("").is_ok_and(|t| t.is_empty()) && !tolerance.is_empty());
        assert!(!Tolerance::default().is_empty(), "without a file everything is judged");
        for negative in ["darts = \"-1 mm\"", "strain = -0.1"] {
            assert!(read_tolerance(negative).is_err_and(|why| why.contains("must be 0 or more")), "{negative}");
        }
        assert!(read_tolerance("dart = \"2 mm\"").is_err() && read_tolerance("darts = 2").is_err());
    }
}
