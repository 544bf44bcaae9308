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
use serde_spanned::Spanned;
use std::borrow::Cow;
use toile_garment::units::Length;
use toile_garment::{Code, Diagnostic, SourceRef};
use toml::de::{DeValue, ValueDeserializer};

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
#[serde(
    untagged,
    deny_unknown_fields,
    expecting = "an end is a landmark, as `\"neck-back\"`, or `{ edge = \"BACK.0\", share = 0.5 }`, or `{ height = \"1 m\" }`"
)]
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
    /// Where its table stands.
    #[serde(skip)]
    pub place: Option<SourceRef>,
}

/// Reads a file of points of measure. `file` is its name for messages.
///
/// # Errors
/// All that is wrong, each with line and column.
pub fn read(text: &str, file: &str) -> Result<Vec<PointOfMeasure>, Vec<Diagnostic>> {
    let toml = TomlText::new(text, file);
    let (mut found, mut wrong) = (Vec::<PointOfMeasure>::new(), Vec::new());
    for (key, value) in toml.parse(MEASURES_FILE)?.into_inner() {
        let DeValue::Array(tables) = value.into_inner() else {
            wrong.push(not_known(&key, &toml));
            continue;
        };
        if key.get_ref() != "measure" {
            wrong.push(not_known(&key, &toml));
            continue;
        }
        for table in tables {
            match measure(table, &toml) {
                Ok(measure) if found.iter().any(|m| m.name == measure.name) => {
                    let message = format!("two measures have the name `{}`", measure.name);
                    wrong.extend(measure.place.map(|at| Diagnostic::error(MEASURES_FILE, message).at(at)));
                }
                Ok(measure) => found.push(measure),
                Err(finding) => wrong.push(finding),
            }
        }
    }
    if wrong.is_empty() { Ok(found) } else { Err(wrong) }
}

fn not_known(key: &Spanned<Cow<'_, str>>, toml: &TomlText<'_>) -> Diagnostic {
    let message = format!("`{}` is no list of measures", key.get_ref());
    Diagnostic::error(MEASURES_FILE, message).at(toml.place(key)).hint("write each measure below `[[measure]]`")
}

/// One table of the file.
fn measure(table: Spanned<DeValue<'_>>, toml: &TomlText<'_>) -> Result<PointOfMeasure, Diagnostic> {
    let at = toml.place(&table);
    let mut measure = PointOfMeasure::deserialize(ValueDeserializer::from(table)).map_err(|e| {
        let message = e.message().lines().collect::<Vec<_>>().join("; ");
        Diagnostic::error(MEASURES_FILE, message).at(e.span().map_or_else(|| at.clone(), |s| toml.at(s.start)))
    })?;
    if let Some((why, remedy)) = mistake(&measure) {
        let finding = Diagnostic::error(MEASURES_FILE, format!("the measure `{}` {why}", measure.name));
        return Err(finding.at(at).hint(remedy));
    }
    measure.place = Some(at);
    Ok(measure)
}

/// The reason why a measure is none, and its remedy.
fn mistake(m: &PointOfMeasure) -> Option<(&'static str, &'static str)> {
    let [edges, girth, way] = [!m.edges.is_empty(), m.around.is_some(), m.from.is_some() || m.to.is_some()];
    let has_height = m.at.is_some() || m.height.is_some() || m.below.is_some();
    let is_outside = |end: &Option<End>| matches!(end, Some(End::Edge { share, .. }) if !(0.0..=1.0).contains(share));
    let wrong = [
        (m.name.trim().is_empty(), "has no name", "write `name = \"hem\"`"),
        (
            u8::from(edges) + u8::from(girth) + u8::from(way) != 1,
            "does not tell in one way what is measured",
            "give `edges`, or `around` with `at` or `height`, or `from` and `to`",
        ),
        (
            girth && m.at.is_some() == m.height.is_some(),
            "goes around the body at no height, or at two",
            "give `at`, a landmark, or `height`",
        ),
        (!girth && has_height, "has a height and no girth", "`at`, `height` and `below` stand beside `around`"),
        (way && (m.from.is_none() || m.to.is_none()), "has one end only", "give `from` and `to`"),
        (edges && m.on == On::Body, "names edges, and the body has none", "measure it on the pattern or the drape"),
        (
            m.method == Method::Tape && (edges || m.on == On::Pattern),
            "is taken with a tape, and a tape goes around worn cloth or the body",
            "leave out `method`, or measure a girth or a way on the drape",
        ),
        (is_outside(&m.from) || is_outside(&m.to), "ends outside its edge", "a `share` is 0 to 1"),
        (
            m.tolerance.is_some() && m.expected.is_none(),
            "has a tolerance about no expected length",
            "give `expected` too, or leave out `tolerance`",
        ),
        (
            m.tolerance.is_some_and(|t| t.0 < 0.0) || m.expected.is_some_and(|l| l.0 < 0.0),
            "expects a length below 0, or has a tolerance below 0",
            "write lengths from 0",
        ),
    ];
    wrong.into_iter().find(|(is_wrong, ..)| *is_wrong).map(|(_, why, remedy)| (why, remedy))
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
            ("\"back\"", "\"hem\"", "two measures"),
            ("edges =", "below = \"1 mm\"\nedges =", "no girth"),
            ("edges =", "method = \"tape\"\nedges =", "tape"),
            ("\"neck-back\"", "{ edge = \"BACK.0\", share = 1.5 }", "outside its edge"),
            ("\"neck-back\"", "{ edge = \"BACK.0\", share = 0.5, at = 1 }", "an end is"),
            ("expected = \"1 m\"", "expected = \"-1 m\"", "below 0"),
            ("[[measure]]", "colour = 1\n[[measure]]", "`colour`"),
        ] {
            let found = read(&text.replacen(from, to, 1), "m.toml").expect_err(from);
            let line = found[0].source.as_ref().and_then(|at| at.line);
            assert!(found[0].message.contains(word) && line.is_some(), "{from}: {found:?}");
        }
        let two = text.replacen("\"hem\"", "\" \"", 1).replace("method =", "methods =");
        assert_eq!(read(&two, "m.toml").expect_err("two mistakes").len(), 2);
    }
}
