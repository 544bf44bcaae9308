//! `[[place]]`, `[[layer]]`, `[[attach]]`, `[[copy]]`.

use super::codes;
use super::keys;
use super::walk::{Table, Value, Walk};
use crate::codes::OUT_OF_RANGE;
use std::ops::Range;
use toile_garment::Vec3;
use toile_garment::sewing::{Around, AttachSpec, AttachStrength, CopySpec, LayerSpec, PlaceSpec, Placement, WholeSpec};
use toile_garment::units::{Angle, Length};
use toml::de::{DeTable, DeValue};

const SEGMENTS: &[&str] = &["torso", "arm-left", "arm-right", "leg-left", "leg-right", "neck"];
const SIDES: &[&str] = &["front", "back", "left", "right"];
/// Largest distance of a start from the body or along it, m.
const ROOM: f64 = 10.0;

/// The segments of a body that a piece may be wrapped around.
pub fn segments() -> Vec<&'static str> {
    SEGMENTS.to_vec()
}

/// Parts of the body that a piece may ignore while it is sewn: the segments, and the forearms with their hands.
const PARTS: &[&str] =
    &["torso", "arm-left", "arm-right", "forearm-left", "forearm-right", "leg-left", "leg-right", "neck"];

/// A list of parts of the body.
fn parts(value: Value<'_>, walk: &mut Walk<'_>) -> Vec<String> {
    let words: Vec<_> = PARTS.iter().map(|w| (*w, *w)).collect();
    let DeValue::Array(items) = value.get_ref() else {
        walk.wrong_type(value, "ignores", "a list of parts of the body, e.g. [\"forearm-left\"]");
        return Vec::new();
    };
    items.iter().filter_map(|item| walk.word(item, "ignores", &words)).map(str::to_owned).collect()
}

/// The sides of a segment.
pub fn sides() -> Vec<&'static str> {
    SIDES.to_vec()
}

/// Where a piece starts in 3D.
pub fn place(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<PlaceSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::PLACE);
    let piece = t.need("piece", walk).and_then(|v| walk.text(v, "piece"));
    let placement = match [t.take("move"), t.take("around"), t.take("rotation")] {
        [Some(by), None, None] => {
            t.keys = &keys::PLACE_MOVED;
            vector(by, "move", walk).map(|by| Placement::Moved { by })
        }
        [None, Some(around), None] => {
            t.keys = &keys::PLACE_AROUND;
            wrapped(around, &mut t, walk)
        }
        [None, None, Some(rotation)] => {
            t.keys = &keys::PLACE_EXPLICIT;
            explicit(rotation, &mut t, walk)
        }
        found => {
            let words = match found.iter().flatten().count() {
                0 => "none of `move`, `around` and `rotation`",
                _ => "more than one of `move`, `around` and `rotation`",
            };
            walk.error(codes::SEWING_PLACE, at, format!("a place has {words}"), |d| {
                d.hint("give move; or around, side and height; or rotation and translation")
            });
            return None;
        }
    };
    let ignores = t.take("ignores").map(|value| parts(value, walk));
    t.finish(walk);
    Some(PlaceSpec { piece: piece?, placement: placement?, ignores, source: Some(walk.source(at, Some("place"))) })
}

fn wrapped(around: Value<'_>, t: &mut Table<'_>, walk: &mut Walk<'_>) -> Option<Placement> {
    let words = |list: &'static [&'static str]| list.iter().map(|w| (*w, *w)).collect::<Vec<_>>();
    let segment = walk.word(around, "around", &words(SEGMENTS));
    let side = t.need("side", walk).and_then(|v| walk.word(v, "side", &words(SIDES)));
    let on_arm = segment.is_some_and(|s| s.starts_with("arm"));
    let height = match t.take("height") {
        Some(value) => in_room(value, "height", walk),
        // On an arm the height counts from the joint: zero is a sound default. Elsewhere there is none.
        None if on_arm => Some(0.0),
        None => t.need("height", walk).map(|_| 0.0),
    };
    let turn = match t.take("turn") {
        Some(value) => walk.quantity::<Angle>(value, "turn"),
        None => Some(0.0),
    };
    let shift = match t.take("shift") {
        Some(value) => in_room(value, "shift", walk),
        None => Some(0.0),
    };
    let (segment, side) = (segment?.to_owned(), side?.to_owned());
    Some(Placement::Around(Around { segment, side, height: height?, turn: turn?, shift: shift? }))
}

fn explicit(rotation: Value<'_>, t: &mut Table<'_>, walk: &mut Walk<'_>) -> Option<Placement> {
    let translation = t.need("translation", walk).and_then(|v| vector(v, "translation", walk));
    let rotation = rows(rotation, walk);
    Some(Placement::Explicit { rotation: rotation?, translation: translation? })
}

fn vector(value: Value<'_>, key: &str, walk: &mut Walk<'_>) -> Option<Vec3> {
    let items = walk.list(value, key, 3, "[\"0 mm\", \"914 mm\", \"250 mm\"]")?;
    let parts: Vec<_> = items.iter().map(|i| in_room(i, key, walk)).collect();
    Some(Vec3::new(parts[0]?, parts[1]?, parts[2]?))
}

/// A length that leaves a piece in the room around the body.
fn in_room(value: Value<'_>, key: &str, walk: &mut Walk<'_>) -> Option<f64> {
    let length = walk.quantity::<Length>(value, key)?;
    if length.abs() <= ROOM {
        return Some(length);
    }
    let message = format!("`{key}` is {length} m; a piece starts within {ROOM} m of the body");
    walk.error(OUT_OF_RANGE, value.span().start, message, |d| d.hint("look at the unit: mm, cm or m"));
    None
}

fn rows(value: Value<'_>, walk: &mut Walk<'_>) -> Option<[[f64; 3]; 3]> {
    let example = "[[1,0,0],[0,1,0],[0,0,1]]";
    let mut out = [[0.0; 3]; 3];
    for (row, item) in out.iter_mut().zip(walk.list(value, "rotation", 3, example)?) {
        for (x, entry) in row.iter_mut().zip(walk.list(item, "rotation", 3, "[1, 0, 0]")?) {
            *x = walk.number(entry, "rotation")?;
        }
    }
    if is_rotation(&out) {
        return Some(out);
    }
    walk.error(codes::SEWING_NO_ROTATION, value.span().start, "`rotation` is no rotation matrix", |d| {
        d.hint("its rows must be perpendicular, of length 1, and right-handed (determinant +1, no mirror)")
    });
    None
}

fn is_rotation(r: &[[f64; 3]; 3]) -> bool {
    let [a, b, c] = r.map(|row| Vec3::new(row[0], row[1], row[2]));
    let near = |x: f64, y: f64| (x - y).abs() < 1e-3;
    near(a.norm(), 1.0)
        && near(b.norm(), 1.0)
        && near(c.norm(), 1.0)
        && near(a.dot(&b), 0.0)
        && near(a.dot(&c), 0.0)
        && near(b.dot(&c), 0.0)
        && near(a.cross(&b).dot(&c), 1.0)
}

/// A layer order.
pub fn layer(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<LayerSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::LAYER);
    let pieces = t.need("pieces", walk).and_then(|v| walk.names(v, "pieces"));
    let order = t.need("order", walk).and_then(|v| walk.integer(v, "order"));
    t.finish(walk);
    Some(LayerSpec { pieces: pieces?, order: order?, source: Some(walk.source(at, Some("layer"))) })
}

/// A piece that was cut apart.
pub fn whole(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<WholeSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::WHOLE);
    let name = t.need("name", walk).and_then(|v| walk.text(v, "name"));
    let pieces = t.need("pieces", walk).and_then(|v| walk.names(v, "pieces"));
    t.finish(walk);
    let (name, pieces) = (name?, pieces?);
    Some(WholeSpec { source: Some(walk.source(at, Some(&format!("whole `{name}`")))), name, pieces })
}

/// An edge tied to the body.
pub fn attach(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<AttachSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::ATTACH);
    let piece = t.need("piece", walk).and_then(|v| walk.text(v, "piece"));
    let edge = t.need("edge", walk).and_then(|v| walk.label(v, "edge"));
    let to = t.need("to", walk).and_then(|v| walk.text(v, "to"));
    let strength = match t.take("strength") {
        Some(value) => strength(value, walk),
        None => Some(AttachStrength::Hold),
    };
    t.finish(walk);
    let source = Some(walk.source(at, Some("attach")));
    Some(AttachSpec { piece: piece?, edge: edge?, to: to?, strength: strength?, source })
}

fn strength(value: Value<'_>, walk: &mut Walk<'_>) -> Option<AttachStrength> {
    let text = walk.text(value, "strength")?;
    let mut words = text.split_whitespace();
    let parsed = match (words.next(), words.next(), words.next()) {
        (Some("hold"), None, _) => Some(AttachStrength::Hold),
        (Some("while-sewing"), None, _) => Some(AttachStrength::WhileSewing),
        (Some("elastic"), Some(n), None) => {
            n.parse::<f64>().ok().filter(|n| *n > 0.0 && *n <= 10.0).map(AttachStrength::Elastic)
        }
        _ => None,
    };
    if parsed.is_none() {
        walk.error(codes::SEWING_STRENGTH, value.span().start, format!("`strength` cannot be `{text}`"), |d| {
            d.hint("write \"hold\", \"while-sewing\" or \"elastic 0.9\" (length of the band over the girth, over 0)")
        });
    }
    parsed
}

/// A second copy of a piece.
pub fn copy(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<CopySpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::COPY);
    let piece = t.need("piece", walk).and_then(|v| walk.text(v, "piece"));
    let name = t.need("name", walk).and_then(|v| walk.text(v, "name"));
    let mirror = match t.take("mirror") {
        Some(value) => walk.flag(value, "mirror"),
        None => Some(false),
    };
    t.finish(walk);
    let source = Some(walk.source(at, Some("copy")));
    Some(CopySpec { piece: piece?, name: name?, mirror: mirror?, source })
}
