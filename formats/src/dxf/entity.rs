//! One entity from its tags. Curves are only looked at: what is wrong is told here, and `library.rs` reads them.

use super::codes;
use super::findings::Findings;
use super::groups::Group;
use super::model::{Entity, Shape, Spline, Vertex};
use super::mtext;
use super::tags::number;
use crate::encoding::{self, TextEncoding};
use toile_garment::{Diagnostic, Vec2};

/// Codes without meaning for a pattern: handles, line types, colours, sub-class marks, extents of text.
const PLAIN: [i32; 22] = [5, 6, 7, 8, 48, 60, 62, 66, 67, 100, 102, 330, 360, 370, 410, 420, 440, 71, 72, 73, 74, 75];
/// Browzwear repeats the depth of a notch here.
const ELEVATION: i32 = 38;
const KEPT: usize = 64;
/// Group code of the degree of a spline.
const DEGREE: i32 = 71;
/// Bits of a number that hold flags.
const FLAGS: i64 = 0x7FFF;

/// An entity with layer, line and unused codes, and the given shape.
pub(crate) fn shell(id: u32, group: &Group<'_>, encoding: TextEncoding, shape: Shape) -> Entity {
    let layer = group.tags.iter().find(|t| t.code == 8).map(|t| encoding.decode(t.value)).unwrap_or_default();
    let other = group
        .tags
        .iter()
        .filter(|t| !(PLAIN.contains(&t.code) || ((1..=59).contains(&t.code) && t.code != ELEVATION) || t.code == 70))
        .take(KEPT)
        .map(|t| (t.code, encoding.decode(t.value)))
        .collect();
    Entity { id, layer, line: group.head.line, shape, other }
}

/// An integer code, `None` when absent or not a number.
pub(crate) fn integer(group: &Group<'_>, code: i32) -> Option<i64> {
    let tag = group.tags.iter().find(|t| t.code == code)?;
    std::str::from_utf8(tag.value).ok()?.parse().ok()
}

/// Is the entity drawn looking from behind (extrusion along −z)?
pub(crate) fn mirrored(group: &Group<'_>) -> bool {
    group
        .tags
        .iter()
        .find(|t| t.code == 230)
        .and_then(|t| std::str::from_utf8(t.value).ok()?.parse::<f64>().ok())
        .is_some_and(|z| z < 0.0)
}

struct Reader<'a, 'f> {
    group: &'a Group<'a>,
    findings: &'f mut Findings,
    failed: bool,
}

impl Reader<'_, '_> {
    /// A number that may be absent; a second one of the same code means that a line between two entities is lost.
    fn maybe(&mut self, code: i32) -> Option<f64> {
        let mut found = None;
        for tag in self.group.tags.iter().filter(|t| t.code == code) {
            match number(tag, self.findings) {
                Ok(v) if found.is_none() => found = Some(v),
                Ok(_) => {
                    let text = format!(
                        "group code {code} stands twice in one {}: a line between two entities is lost",
                        String::from_utf8_lossy(self.group.head.value)
                    );
                    self.fail(Diagnostic::error(codes::COORDINATE_TWICE, text), tag.line);
                }
                Err(e) => {
                    self.failed = true;
                    self.findings.push(e);
                }
            }
        }
        found
    }

    fn fail(&mut self, finding: Diagnostic, line: u64) {
        self.failed = true;
        let place = self.findings.place(line);
        self.findings.push(finding.at(place));
    }

    fn need(&mut self, code: i32) -> f64 {
        let value = self.maybe(code);
        if value.is_none() && !self.failed {
            let text = format!("a {} without group code {code}", String::from_utf8_lossy(self.group.head.value));
            self.fail(Diagnostic::error(codes::COORDINATE_MISSING, text), self.group.head.line);
        }
        value.unwrap_or(0.0)
    }

    fn point(&mut self, code: i32) -> Vec2 {
        Vec2::new(self.need(code), self.need(code + 10))
    }

    fn maybe_point(&mut self, code: i32) -> Vec2 {
        Vec2::new(self.maybe(code).unwrap_or(0.0), self.maybe(code + 10).unwrap_or(0.0))
    }

    fn numbers(&mut self, code: i32) -> Vec<f64> {
        let mut list = Vec::new();
        for tag in self.group.tags.iter().filter(|t| t.code == code) {
            match number(tag, self.findings) {
                Ok(v) => list.push(v),
                Err(e) => {
                    self.failed = true;
                    self.findings.push(e);
                }
            }
        }
        list
    }

    fn points(&mut self, code: i32) -> Vec<Vec2> {
        let (x, y) = (self.numbers(code), self.numbers(code + 10));
        if x.len() != y.len() && !self.failed {
            let text = format!("{} x but {} y coordinates", x.len(), y.len());
            self.fail(Diagnostic::error(codes::COORDINATE_MISSING, text), self.group.head.line);
        }
        x.into_iter().zip(y).map(|(x, y)| Vec2::new(x, y)).collect()
    }

    fn positive(&mut self, code: i32, what: &str) -> f64 {
        let value = self.need(code);
        if value <= 0.0 && !self.failed {
            let text = format!("{what} is {value}, it must be above 0");
            self.fail(Diagnostic::error(codes::NUMBER_OUT_OF_RANGE, text), self.group.head.line);
        }
        value
    }
}

/// A VERTEX and its z.
pub(crate) fn vertex(group: &Group<'_>, findings: &mut Findings) -> Option<(Vertex, f64)> {
    let mut r = Reader { group, findings, failed: false };
    let at = r.point(10);
    let z = r.maybe(30).unwrap_or(0.0);
    let bulge = r.maybe(42).unwrap_or(0.0);
    (!r.failed).then_some((Vertex { at, bulge }, z))
}

/// Any entity but POLYLINE and VERTEX; `None` when a number in it is bad (which is then a finding).
pub(crate) fn read(id: u32, group: &Group<'_>, encoding: TextEncoding, findings: &mut Findings) -> Option<Entity> {
    let name = String::from_utf8_lossy(group.head.value).to_ascii_uppercase();
    let mut r = Reader { group, findings, failed: false };
    let mirror = mirrored(group);
    let shape = match name.as_str() {
        "LINE" => Shape::Line([r.point(10), r.point(11)]),
        "POINT" => point(&mut r),
        "TEXT" => Shape::Text { at: r.maybe_point(10), value: text_value(group, encoding), height: height(group) },
        // Releases of 2018 and later repeat code 10 in an embedded object: only the first one counts.
        "MTEXT" => {
            let first = |code| group.tags.iter().find(|t| t.code == code).and_then(|t| number(t, r.findings).ok());
            let at = Vec2::new(first(10).unwrap_or(0.0), first(20).unwrap_or(0.0));
            Shape::Text { at, value: mtext::plain(&raw_text(group, encoding)), height: height(group) }
        }
        "INSERT" => insert(&mut r, encoding, mirror),
        "ARC" => {
            look(&mut r, &[10, 20], "the radius of an ARC");
            let _ = (r.need(50), r.need(51));
            Shape::Other(name)
        }
        "CIRCLE" => {
            look(&mut r, &[10, 20], "the radius of a CIRCLE");
            Shape::Other(name)
        }
        "ELLIPSE" => {
            look_at_ellipse(&mut r);
            Shape::Other(name)
        }
        "SPLINE" => {
            look_at_spline(&mut r);
            Shape::Other(name)
        }
        "LWPOLYLINE" => {
            look_at_light_polyline(&mut r);
            Shape::Other(name)
        }
        "ATTDEF" | "ATTRIB" => {
            let text = |code| group.tags.iter().find(|t| t.code == code).map(|t| encoding.decode(t.value));
            let [tag, value] = [2, 1].map(|code| text(code).map(|t| encoding::unescape(&t)).unwrap_or_default());
            let number = |code| group.tags.iter().find(|t| t.code == code).and_then(|t| number(t, r.findings).ok());
            Shape::Attribute { at: Vec2::new(number(10).unwrap_or(0.0), number(20).unwrap_or(0.0)), tag, value }
        }
        _ => Shape::Other(encoding.decode(group.head.value).to_ascii_uppercase()),
    };
    let failed = r.failed;
    (!failed).then(|| shell(id, group, encoding, shape))
}

fn point(r: &mut Reader<'_, '_>) -> Shape {
    let (at, depth) = (r.point(10), r.maybe(30));
    let elevation = r.maybe(ELEVATION);
    let depth = depth.filter(|d| *d != 0.0).or(elevation).or(depth);
    Shape::Point { at, depth, width: r.maybe(39), angle: r.maybe(50) }
}

/// Height of a text; only ever a hint of its writer.
fn height(group: &Group<'_>) -> Option<f64> {
    let tag = group.tags.iter().find(|t| t.code == 40)?;
    std::str::from_utf8(tag.value).ok()?.parse().ok().filter(|h: &f64| h.is_finite())
}

fn text_value(group: &Group<'_>, encoding: TextEncoding) -> String {
    encoding::unescape(&raw_text(group, encoding)).trim().to_owned()
}

/// MTEXT splits long text over codes 3 and ends with code 1.
fn raw_text(group: &Group<'_>, encoding: TextEncoding) -> String {
    let parts = group.tags.iter().filter(|t| t.code == 1 || t.code == 3);
    parts.map(|t| encoding.decode(t.value)).collect()
}

fn insert(r: &mut Reader<'_, '_>, encoding: TextEncoding, mirror: bool) -> Shape {
    let block = r.group.tags.iter().find(|t| t.code == 2);
    let block = block.map(|t| encoding::unescape(&encoding.decode(t.value))).unwrap_or_default();
    let copies = [70, 71].map(|code| integer(r.group, code).unwrap_or(1));
    if copies.iter().any(|n| *n > 1) {
        let text = format!("an INSERT repeats `{block}` {} × {} times; it was read once", copies[0], copies[1]);
        let place = r.findings.place(r.group.head.line);
        r.findings.push(Diagnostic::warning(codes::INSERT_ARRAY, text).at(place));
    }
    // Seen from behind x runs the other way: so do the scale along it and the turn.
    let side = if mirror { -1.0 } else { 1.0 };
    let at = r.maybe_point(10);
    let scale = [side * r.maybe(41).unwrap_or(1.0), r.maybe(42).unwrap_or(1.0)];
    let rotation = side * r.maybe(50).unwrap_or(0.0);
    Shape::Insert { block, at: Vec2::new(side * at.x, at.y), scale, rotation }
}

/// Coordinates that must be there, and a number that must be above 0.
fn look(r: &mut Reader<'_, '_>, codes: &[i32], above_zero: &str) {
    codes.iter().for_each(|code| {
        r.need(*code);
    });
    r.positive(40, above_zero);
}

fn look_at_ellipse(r: &mut Reader<'_, '_>) {
    let (_, major) = (r.point(10), r.point(11));
    look(r, &[], "the axis ratio of an ELLIPSE");
    let _ = (r.maybe(41), r.maybe(42));
    if major.norm() <= 0.0 && !r.failed {
        let line = r.group.head.line;
        r.fail(Diagnostic::error(codes::NUMBER_OUT_OF_RANGE, "an ELLIPSE without a major axis"), line);
    }
}

fn look_at_light_polyline(r: &mut Reader<'_, '_>) {
    let mut vertices = 0_usize;
    let mut y_missing = false;
    for tag in &r.group.tags {
        if !matches!(tag.code, 10 | 20 | 42) {
            continue;
        }
        if let Err(e) = number(tag, r.findings) {
            r.failed = true;
            r.findings.push(e);
            continue;
        }
        match tag.code {
            10 if y_missing => r.fail(Diagnostic::error(codes::COORDINATE_MISSING, "a vertex without y"), tag.line),
            10 => {
                vertices += 1;
                y_missing = true;
            }
            20 if y_missing => y_missing = false,
            42 if vertices > 0 => {}
            _ => r.fail(Diagnostic::error(codes::COORDINATE_MISSING, "a vertex without x"), tag.line),
        }
    }
    let line = r.group.head.line;
    if y_missing && !r.failed {
        r.fail(Diagnostic::error(codes::COORDINATE_MISSING, "a vertex without y"), line);
    }
    if let Some(count) = integer(r.group, 90).filter(|n| *n != vertices as i64 && !r.failed) {
        let text = format!("an LWPOLYLINE says {count} vertices and holds {vertices}");
        r.fail(Diagnostic::error(codes::VERTEX_COUNT_DIFFERS, text), line);
    }
}

/// A whole number of a curve: its flags, of which those that mean something are the lowest bits, or the degree of a
/// spline.
pub(crate) fn whole(group: &Group<'_>, code: i32) -> i64 {
    let number = integer(group, code);
    if code == DEGREE { number.filter(|d| *d >= 0).unwrap_or(3) } else { number.unwrap_or(0) & FLAGS }
}

fn look_at_spline(r: &mut Reader<'_, '_>) {
    let line = r.group.head.line;
    let spline = Spline {
        degree: usize::try_from(whole(r.group, DEGREE)).unwrap_or(usize::MAX),
        flags: whole(r.group, 70),
        knots: r.numbers(40),
        weights: r.numbers(41),
        control: r.points(10),
        fit: r.points(11),
    };
    if !r.failed
        && let Err(text) = spline.check()
    {
        r.fail(Diagnostic::error(codes::SPLINE_DAMAGED, text), line);
    }
    for (code, have) in [(72, spline.knots.len()), (73, spline.control.len()), (74, spline.fit.len())] {
        if let Some(count) = integer(r.group, code).filter(|n| *n != have as i64 && !r.failed) {
            let text = format!("a SPLINE says {count} and holds {have} values (group code {code})");
            r.fail(Diagnostic::error(codes::VERTEX_COUNT_DIFFERS, text), line);
        }
    }
}
