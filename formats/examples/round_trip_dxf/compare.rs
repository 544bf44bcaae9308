//! The facts of a piece that must come back.

use std::fmt;
use toile_formats::dxf::write::{Dialect, drawn_vertices};
use toile_formats::dxf::{Pattern, geom};
use toile_garment::dart::Dart;
use toile_garment::notch::{Notch, NotchKind};
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::{Diagnostic, Garment, Piece, Vec2};

/// Places that are one, metres: files hold 0.0001 mm.
const SAME: f64 = 2e-7;
/// A curve that is read back keeps this near, mm: the chords of both are up to 0.05 mm off.
const CURVE: f64 = 0.11;
/// Angles that are one, radians.
const ANGLE: f64 = 2e-6;

/// The kinds of differences that findings tell: kind and code.
const TOLD: [(&str, &str); 19] = [
    ("quantity", "quantity-without-sides"),
    ("notch", "notch-shape-lost"),
    ("notch", "mark-on-fold-as-line"),
    ("internal lines", "mark-on-fold-as-line"),
    ("curve", "curve-copy-lost"),
    ("vertices", "curve-points-lost"),
    ("curve", "curve-points-lost"),
    ("curve points", "curve-points-lost"),
    ("curve points", "curve-points-unused"),
    ("turn points", "points-off-vertices"),
    ("turn points", "notch-cut-in"),
    ("dart", "dart-undecided"),
    ("style texts", "style-text-not-kept"),
    ("fold", "fold-not-symmetric"),
    ("name", "piece-name-changed"),
    ("name", "text-not-ascii"),
    ("size", "size-name-changed"),
    ("text", "text-not-ascii"),
    ("style", "text-not-ascii"),
];

/// A fact that did not come back.
pub struct Difference {
    pub kind: &'static str,
    piece: String,
    text: String,
}

impl Difference {
    pub fn new(kind: &'static str, piece: &str, text: String) -> Self {
        Self { kind, piece: piece.to_owned(), text }
    }

    pub fn refused(faults: &[Diagnostic]) -> Self {
        let list: Vec<String> = faults.iter().take(3).map(|f| format!("{} {}", f.code.as_str(), f.message)).collect();
        Self::new("refused", "", list.join("; "))
    }

    /// Does a finding about the piece tell it? Findings about names and texts hold the text itself.
    pub fn is_told(&self, findings: &[Diagnostic]) -> bool {
        let names_piece = |f: &Diagnostic| {
            f.message.contains(&format!("`{}`", self.piece))
                || matches!(self.kind, "name" | "text" | "style" | "style texts" | "size")
        };
        TOLD.iter().any(|(kind, code)| {
            *kind == self.kind && findings.iter().any(|f| f.code.as_str() == *code && names_piece(f))
        })
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of `{}`: {}", self.kind, self.piece, self.text)
    }
}

/// Texts of the style.
pub fn styles(first: &Pattern, second: &Pattern) -> Vec<Difference> {
    let mut out = Vec::new();
    if first.style.clone().unwrap_or_default() != second.style.clone().unwrap_or_default() {
        out.push(Difference::new("style", "", format!("{:?} against {:?}", first.style, second.style)));
    }
    for (key, value) in first.style_texts.iter().filter(|(_, value)| !value.is_empty()) {
        let is_of_dialect = key.contains("version") || key.contains("tolerance");
        if !is_of_dialect && !second.style_texts.contains_key(key) {
            out.push(Difference::new("style texts", "", format!("{key}: {value}")));
        }
    }
    out
}

pub fn garments(a: &Garment, b: &Garment, dialect: Dialect, half_on_fold: bool) -> Vec<Difference> {
    if a.pieces.len() != b.pieces.len() {
        let text = format!("{} pieces against {}", a.pieces.len(), b.pieces.len());
        return vec![Difference::new("pieces", "", text)];
    }
    a.pieces.iter().zip(&b.pieces).flat_map(|(a, b)| pieces(a, b, dialect, half_on_fold)).collect()
}

fn pieces(a: &Piece, b: &Piece, dialect: Dialect, half_on_fold: bool) -> Vec<Difference> {
    let mut out = Vec::new();
    let mut say = |kind: &'static str, text: String| out.push(Difference::new(kind, &a.name, text));
    let pairs = [
        ("name", Some(&a.name), Some(&b.name)),
        ("size", a.size.as_ref(), b.size.as_ref()),
        ("text", a.material.as_ref(), b.material.as_ref()),
        ("text", a.category.as_ref(), b.category.as_ref()),
        ("text", a.annotation.as_ref(), b.annotation.as_ref()),
    ];
    for (kind, x, y) in pairs.into_iter().filter(|(_, x, y)| x != y) {
        say(kind, format!("{x:?} against {y:?}"));
    }
    if a.quantity != b.quantity {
        say("quantity", format!("{:?} against {:?}", a.quantity, b.quantity));
    }
    if half_on_fold && a.fold.is_some() != b.fold.is_some() {
        say("fold", format!("{:?} against {:?}", a.fold, b.fold));
    }
    lines(a, b, &mut say);
    if let Some((name, off)) = curves(a, b).into_iter().find(|(_, off)| *off > CURVE) {
        say("curve", format!("{name} is {off:.3} mm off ({dialect:?})"));
    }
    if a.edges.len() != b.edges.len() {
        say("edges", format!("{} against {}", a.edges.len(), b.edges.len()));
    }
    if let Some((x, y)) = unmatched(&a.notches, &b.notches, same_notch) {
        say("notch", format!("{x:?} against {y:?}"));
    }
    if let Some((x, y)) = unmatched(&a.drill_holes, &b.drill_holes, |x, y| {
        near(x.at, y.at) && x.diameter.is_some() == y.diameter.is_some()
    }) {
        say("drill hole", format!("{x:?} against {y:?}"));
    }
    if let Some((x, y)) = unmatched(&a.darts, &b.darts, same_dart) {
        say("dart", format!("{x:?} against {y:?}"));
    }
    // The half of a piece says `NM` at the lines that have no mirror image.
    let texts = |p: &Piece| p.texts.iter().filter(|t| t.text != "NM").cloned().collect::<Vec<_>>();
    let (texts_a, texts_b) = (texts(a), texts(b));
    if let Some((x, y)) =
        unmatched(&texts_a, &texts_b, |x, y| near(x.at, y.at) && x.layer == y.layer && x.text == y.text)
    {
        say("text", format!("{x:?} against {y:?}"));
    }
    let grain = |p: &Piece| p.grain.map(|g| g.to_vec()).unwrap_or_default();
    if grain(a).len() != grain(b).len() || !grain(a).iter().zip(grain(b)).all(|(p, q)| near(*p, q)) {
        say("grain", format!("{:?} against {:?}", a.grain, b.grain));
    }
    out
}

fn near(p: Vec2, q: Vec2) -> bool {
    (p - q).norm() <= SAME
}

/// The first entry that only the one list has, and the first that only the other has.
fn unmatched<'a, T>(a: &'a [T], b: &'a [T], same: impl Fn(&T, &T) -> bool) -> Option<(Option<&'a T>, Option<&'a T>)> {
    let mut rest: Vec<&T> = b.iter().collect();
    let mut missing = None;
    for x in a {
        match rest.iter().position(|y| same(x, y)) {
            Some(i) => drop(rest.remove(i)),
            None => missing = missing.or(Some(x)),
        }
    }
    (missing.is_some() || !rest.is_empty()).then(|| (missing, rest.first().copied()))
}

fn same_notch(x: &Notch, y: &Notch) -> bool {
    let angle = match (x.angle, y.angle) {
        (Some(x), Some(y)) => {
            let turn = std::f64::consts::TAU;
            let off = (x - y).rem_euclid(turn);
            off.min(turn - off) <= ANGLE
        }
        (None, None) => true,
        _ => false,
    };
    let is_wide = |n: &Notch| if n.kind == NotchKind::Slit { 0.0 } else { n.width };
    let size = (x.depth - y.depth).abs() <= SAME && (is_wide(x) - is_wide(y)).abs() <= SAME;
    near(x.at, y.at) && x.kind == y.kind && x.on == y.on && size && angle
}

fn same_dart(x: &Dart, y: &Dart) -> bool {
    let all = |a: &[Vec2], b: &[Vec2]| a.len() == b.len() && a.iter().all(|p| b.iter().any(|q| near(*p, *q)));
    x.kind == y.kind && x.line == y.line && all(&x.apexes, &y.apexes) && all(&x.mouth, &y.mouth)
}

/// The vertices as drawn: every line must come back with the same places, kinds and direction.
fn lines(a: &Piece, b: &Piece, say: &mut impl FnMut(&'static str, String)) {
    let (da, db) = (a.drawn.clone().unwrap_or_default(), b.drawn.clone().unwrap_or_default());
    let told =
        |line: &PieceLine, drawn: &[LinePoint]| PieceLine { points: drawn_vertices(line, drawn), ..line.clone() };
    let (x, y) = (told(&a.outline, &da.outline), told(&b.outline, &db.outline));
    if let Some(text) = differs(&x, &y) {
        say("vertices", format!("outline: {text}"));
    }
    match (&a.cut_line, &b.cut_line) {
        (Some(x), Some(y)) => {
            if let Some(text) = differs(&told(x, &da.cut_line), &told(y, &db.cut_line)) {
                say("vertices", format!("cut line: {text}"));
            }
        }
        (None, None) => {}
        _ => say("sew line", format!("{} against {}", a.cut_line.is_some(), b.cut_line.is_some())),
    }
    // A point of layer 2 or 3 says the kind of every vertex at its place. Where lines meet, outer lines decide, and a
    // corner of any inner line before a plain vertex.
    let outer: Vec<&LinePoint> = std::iter::once(&b.outline).chain(&b.cut_line).flat_map(|l| &l.points).collect();
    let inner = b.internal_lines.iter().chain(&b.cutouts).chain(&b.match_lines).flat_map(|l| &l.points);
    let marked: Vec<&LinePoint> = inner.filter(|p| p.kind != PointKind::Plain).collect();
    let settled = |line: &PieceLine| {
        let mut line = line.clone();
        for point in &mut line.points {
            let at = point.at;
            let met = outer.iter().find(|p| near(p.at, at));
            let met = met.or_else(|| marked.iter().find(|p| near(p.at, at) && point.kind == PointKind::Plain));
            point.kind = met.map_or(point.kind, |p| p.kind);
        }
        line
    };
    let same = |x: &PieceLine, y: &PieceLine| x.name == y.name && differs(&settled(x), &settled(y)).is_none();
    let lists = [
        ("internal lines", &a.internal_lines, &b.internal_lines),
        ("cutouts", &a.cutouts, &b.cutouts),
        ("stripes", &a.match_lines, &b.match_lines),
    ];
    for (kind, list_a, list_b) in lists {
        if let Some((x, y)) = unmatched(list_a, list_b, same) {
            let why = x.zip(y).and_then(|(x, y)| differs(x, y)).unwrap_or_default();
            say(kind, format!("{} against {}: {why}", list_a.len(), list_b.len()));
        }
    }
}

/// Why two lines are not the same, wherever a closed one begins.
fn differs(x: &PieceLine, y: &PieceLine) -> Option<String> {
    let n = x.points.len();
    if n != y.points.len() || x.closed != y.closed {
        let lost = |a: &PieceLine, b: &PieceLine| {
            a.points.iter().find(|p| b.points.iter().all(|q| !near(p.at, q.at))).map(|p| (p.at * 1e3, p.kind))
        };
        let (one, other) = (lost(x, y), lost(y, x));
        return Some(format!("{n} vertices against {}: {one:?}, {other:?}", y.points.len()));
    }
    let at = |shift: usize| (0..n).all(|i| near(x.points[i].at, y.points[(i + shift) % n].at));
    let shifts = if x.closed { n } else { 1 };
    let Some(shift) = (0..shifts).find(|s| at(*s)) else {
        let far = x.points.iter().find(|p| y.points.iter().all(|q| !near(p.at, q.at)));
        return Some(format!("another way around, or a vertex moved: {far:?}"));
    };
    let kind = (0..n).find(|i| x.points[*i].kind != y.points[(i + shift) % n].kind)?;
    let (p, q) = (&x.points[kind], &y.points[(kind + shift) % n]);
    Some(format!("{:?} mm was {:?} and is {:?}", p.at * 1e3, p.kind, q.kind))
}

/// How far the working lines are apart, mm.
fn curves(a: &Piece, b: &Piece) -> Vec<(&'static str, f64)> {
    let apart = |x: &PieceLine, y: &PieceLine| {
        let (p, q) = (x.positions(), y.positions());
        geom::deviation(&p, &q, true).max(geom::deviation(&q, &p, true)) * 1e3
    };
    let mut out = vec![("the outline", apart(&a.outline, &b.outline))];
    if let (Some(x), Some(y)) = (&a.cut_line, &b.cut_line) {
        out.push(("the cut line", apart(x, y)));
    }
    out
}
