//! The file of points of measure: what a house measures on its garments, and how far each may be off.
//!
//! ```toml
//! [[measure]]
//! name = "hem"
//! on = "pattern"                       # pattern, drape or body
//! edges = ["FRONT.0", "BACK.hem"]      # edges by number or name, summed up
//!
//! expected = "2590 mm"
//! tolerance = "6 mm"                   # both ways; without it nothing passes or fails
//!
//! [[measure]]
//! name = "bust"
//! on = "drape"
//! around = "torso"                     # a segment of the body
//! at = "bust-left"                     # the height of a landmark, or height = "1220 mm"
//! below = "10 mm"
//! method = "tape"                      # surface: along every fold; tape: bridges hollows
//!
//! [[measure]]
//! name = "back length"
//! on = "body"
//! from = "neck-back"                   # a landmark, an edge's point, or a height
//! to = "waist-back"                    # { edge = "BACK.0", share = 0.5 }, { height = "0 mm" }
//! method = "surface"                   # straight, surface, tape
//! ```

use crate::toml_text::TomlText;
use serde::Deserialize;
use toile_garment::units::Length;
use toile_garment::{Code, Diagnostic};

codes! {
    pub(crate) list CODES;

    /// A file of points of measure is not written as it must be. Exit code 3.
    MEASURES_FILE = "measures-file";
}

/// The thing that is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum On {
    /// The cloth at rest.
    Pattern,
    /// The worn cloth.
    Drape,
    /// The body.
    Body,
}

/// The way of measuring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Along the surface, every fold included.
    #[default]
    Surface,
    /// The way a tape lies, which bridges hollows.
    Tape,
    /// A straight line.
    Straight,
}

/// An end of a measure.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum End {
    /// A landmark of the body.
    Landmark(String),
    /// A point on an edge: `PIECE.EDGE`, and its share of the edge from the start.
    Edge {
        /// `PIECE.EDGE`.
        edge: String,
        /// 0 (start) to 1 (end), counter-clockwise.
        share: f64,
    },
    /// A height above the floor.
    Height {
        /// The height.
        height: Length,
    },
}

/// A point of measure as the file tells it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointOfMeasure {
    /// Name.
    pub name: String,
    /// The thing that is measured.
    pub on: On,
    /// The way of measuring.
    #[serde(default)]
    pub method: Method,
    /// Edges that are summed up.
    #[serde(default)]
    pub edges: Vec<String>,
    /// A segment of the body that is measured around.
    #[serde(default)]
    pub around: Option<String>,
    /// A landmark whose height it is measured at.
    #[serde(default)]
    pub at: Option<String>,
    /// The height it is measured at.
    #[serde(default)]
    pub height: Option<Length>,
    /// How far below that height.
    #[serde(default)]
    pub below: Option<Length>,
    /// One end.
    #[serde(default)]
    pub from: Option<End>,
    /// The other end.
    #[serde(default)]
    pub to: Option<End>,
    /// The length that it should have.
    #[serde(default)]
    pub expected: Option<Length>,
    /// How far it may be off, both ways.
    #[serde(default)]
    pub tolerance: Option<Length>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    measure: Vec<PointOfMeasure>,
}

/// Reads a file of points of measure. `file` is its name for messages.
///
/// # Errors
/// What is wrong, with line and column.
pub fn read(text: &str, file: &str) -> Result<Vec<PointOfMeasure>, Vec<Diagnostic>> {
    let toml = TomlText::new(text, file);
    toml.parse(MEASURES_FILE)?;
    let found: File = toml::from_str(text).map_err(|e| {
        let message = e.message().lines().collect::<Vec<_>>().join("; ");
        let place = e.span().map_or_else(|| toml.whole(), |s| toml.at(s.start));
        vec![Diagnostic::error(MEASURES_FILE, message).at(place)]
    })?;
    let wrong: Vec<Diagnostic> = found
        .measure
        .iter()
        .filter_map(|m| mistake(m).map(|why| (m, why)))
        .map(|(m, why)| {
            let finding = Diagnostic::error(MEASURES_FILE, format!("the measure `{}` {why}", m.name)).at(toml.whole());
            finding.hint("give `edges`, or `around` with `at` or `height`, or `from` and `to`")
        })
        .collect();
    if wrong.is_empty() { Ok(found.measure) } else { Err(wrong) }
}

/// The reason why a measure is none.
fn mistake(m: &PointOfMeasure) -> Option<&'static str> {
    let ways = [!m.edges.is_empty(), m.around.is_some(), m.from.is_some() || m.to.is_some()];
    if m.name.trim().is_empty() {
        return Some("has no name");
    }
    if ways.iter().filter(|w| **w).count() != 1 {
        return Some("does not tell in one way what is measured");
    }
    if ways[1] && m.at.is_some() == m.height.is_some() {
        return Some("goes around the body at no height, or at two");
    }
    if ways[2] && (m.from.is_none() || m.to.is_none()) {
        return Some("has one end only");
    }
    if ways[0] && m.on == On::Body {
        return Some("names edges, and the body has none");
    }
    (m.tolerance.is_some() && m.expected.is_none()).then_some("has a tolerance about no expected length")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_and_mistakes_have_a_place() {
        let text = "[[measure]]\nname = \"hem\"\non = \"pattern\"\nedges = [\"FRONT.0\"]\nexpected = \"1 m\"\n\n\
            [[measure]]\nname = \"back\"\non = \"body\"\nfrom = \"neck-back\"\nto = { height = \"0 mm\" }\n\
            method = \"straight\"\n";
        let all = read(text, "m.toml").expect("measures");
        assert_eq!((all.len(), all[0].method, all[1].method), (2, Method::Surface, Method::Straight));
        assert_eq!(all[1].to, Some(End::Height { height: Length(0.0) }));
        for (from, to, word) in [
            ("edges", "edge", "edge"),
            ("\"pattern\"", "\"body\"", "body has none"),
            ("to = { height = \"0 mm\" }\n", "", "one end"),
            ("\"1 m\"", "1", "1"),
            ("expected = \"1 m\"", "tolerance = \"1 mm\"", "tolerance"),
            ("\"hem\"", "\" \"", "no name"),
        ] {
            let found = read(&text.replacen(from, to, 1), "m.toml").expect_err(from);
            assert!(found[0].message.contains(word) && found[0].source.is_some(), "{from}: {found:?}");
        }
    }
}
