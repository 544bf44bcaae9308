//! `[[dart]]`: declared darts and pleats, and wedges that are none.

use super::codes;
use super::keys;
use super::walk::{Table, Value, Walk};
use std::ops::Range;
use toile_garment::Vec2;
use toile_garment::dart::DartKind;
use toile_garment::sewing::{DartSpec, PleatPress};
use toile_garment::units::Length;
use toml::de::{DeTable, DeValue};

const KINDS: &[(&str, Option<DartKind>)] = &[
    ("wedge", Some(DartKind::Wedge)),
    ("fish-eye", Some(DartKind::FishEye)),
    ("pleat", Some(DartKind::Pleat)),
    ("none", None),
];

/// The words of `kind`.
pub fn kinds() -> Vec<&'static str> {
    KINDS.iter().map(|(word, _)| *word).collect()
}

const PRESSES: &[(&str, PleatPress)] =
    &[("knife", PleatPress::Knife), ("inverted", PleatPress::Inverted), ("box", PleatPress::Box)];

/// The words of `press`.
pub fn presses() -> Vec<&'static str> {
    PRESSES.iter().map(|(word, _)| *word).collect()
}

/// One declared dart.
pub fn dart(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<DartSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::DART);
    let piece = t.need("piece", walk).and_then(|v| walk.text(v, "piece"));
    let name = t.take("name").and_then(|v| walk.text(v, "name"));
    let kind = match t.take("kind") {
        Some(value) => walk.word(value, "kind", KINDS),
        None => Some(Some(DartKind::Wedge)),
    };
    let apexes = apexes(&mut t, walk);
    let mouth = t.need("mouth", walk);
    let mouth = mouth.and_then(|v| mouth_points(v, walk));
    let press = t.take("press").map(|v| walk.word(v, "press", PRESSES));
    let sewn = t.take("sewn").map(|v| walk.quantity::<Length>(v, "sewn"));
    t.finish(walk);
    let (kind, apexes) = (kind?, apexes?);
    check_count(kind, apexes.len(), at, walk)?;
    let pleated = kind == Some(DartKind::Pleat) && apexes.len() == 2;
    if sewn.flatten().is_some_and(|s| s < 0.0) {
        walk.error(codes::SEWING_PRESS, at, "`sewn` is a length of 0 or more", |d| {
            d.hint("write sewn = \"0 mm\" for a pleat that is held at its mouth alone, or a length over 0")
        });
        return None;
    }
    if (press.is_some() || sewn.is_some()) && !pleated {
        walk.error(codes::SEWING_PRESS, at, "`press` and `sewn` need a pleat with two apexes", |d| {
            d.hint("write kind = \"pleat\", apexes = [the ends of both lines], and sewn = \"80 mm\" or more")
        });
        return None;
    }
    let source = Some(walk.source(at, Some("dart")));
    Some(DartSpec {
        piece: piece?,
        name,
        apexes,
        mouth: mouth?,
        kind,
        press: press.flatten(),
        sewn: sewn.flatten(),
        source,
    })
}

fn apexes(t: &mut Table<'_>, walk: &mut Walk<'_>) -> Option<Vec<Vec2>> {
    let value = match [t.take("apex"), t.take("apexes")] {
        [Some(value), None] => return Some(vec![walk.point(value, "apex")?]),
        [None, Some(value)] => value,
        [None, None] => return Some(Vec::new()),
        [Some(_), Some(value)] => {
            walk.error(codes::SEWING_DART_APEXES, value.span().start, "a dart has `apex` or `apexes`, not both", |d| {
                d.hint("keep `apex` for a wedge, and `apexes` for a fish-eye or a pleat")
            });
            return None;
        }
    };
    let DeValue::Array(items) = value.get_ref() else {
        walk.error(codes::SEWING_WRONG_TYPE, value.span().start, "`apexes` must be a list of points", |d| d);
        return None;
    };
    let points: Vec<_> = items.iter().map(|item| walk.point(item, "apexes")).collect();
    points.into_iter().collect()
}

fn mouth_points(value: Value<'_>, walk: &mut Walk<'_>) -> Option<[Vec2; 2]> {
    let items = walk.list(value, "mouth", 2, "[[\"140 mm\", \"443 mm\"], [\"168 mm\", \"443 mm\"]]")?;
    let (a, b) = (walk.point(items[0], "mouth"), walk.point(items[1], "mouth"));
    Some([a?, b?])
}

fn check_count(kind: Option<DartKind>, apexes: usize, at: usize, walk: &mut Walk<'_>) -> Option<()> {
    let (fits, need) = match kind {
        Some(DartKind::FishEye) => (apexes == 2, "a fish-eye dart has two apexes"),
        Some(DartKind::Pleat) => (apexes <= 2, "a pleat has no apex, one, or the two ends of its lines"),
        Some(_) => (apexes == 1, "a wedge dart has one apex"),
        None => (apexes <= 2, "give the apex of the wedge that is no dart"),
    };
    if fits {
        return Some(());
    }
    let message = format!("{need}, found {apexes}");
    walk.error(codes::SEWING_DART_APEXES, at, message, |d| {
        d.hint("write apex = [\"154 mm\", \"330 mm\"], or apexes = […]")
    });
    None
}
