//! Differences of the pattern in mm: pieces, darts, seams; and measures of pattern, cloth and body.

use super::change::{Change, Group};
use std::collections::BTreeMap;
use toile_garment::dart::Dart;
use toile_garment::outline::PieceLine;
use toile_garment::{Garment, Piece, Vec2};
use toile_stages::fit;

/// Lengths and moves below this are the rounding of files, mm.
const LEAST_MM: f64 = 1e-3;

pub fn changes(a: &Garment, b: &Garment) -> Vec<Change> {
    let name = |p: &Piece| p.name.clone();
    let mut found = both(Group::Pieces, &by_name(&a.pieces, name), &by_name(&b.pieces, name), piece);
    let name = |s: &toile_garment::seam::Seam| s.name.clone();
    found.extend(both(Group::Seams, &by_name(&a.seams, name), &by_name(&b.seams, name), |name, a, b| {
        let sides = [("side a", a.a.length, b.a.length), ("side b", a.b.length, b.b.length), ("ease", a.ease, b.ease)];
        sides.into_iter().filter_map(|(what, a, b)| length(Group::Seams, format!("{name}, {what}"), a, b)).collect()
    }));
    found.extend(measures(a, b));
    found
}

fn by_name<T>(all: &[T], name: impl Fn(&T) -> String) -> BTreeMap<String, &T> {
    all.iter().map(|t| (name(t), t)).collect()
}

/// Names that stand on one side only, and the differences of what stands on both.
fn both<T>(
    group: Group,
    a: &BTreeMap<String, &T>,
    b: &BTreeMap<String, &T>,
    differ: impl Fn(&str, &T, &T) -> Vec<Change>,
) -> Vec<Change> {
    let mut found = Vec::new();
    let there = || Some("there".to_owned());
    for (name, one) in a {
        match b.get(name) {
            Some(other) => found.extend(differ(name, one, other)),
            None => found.extend(Change::of_words(group, name.clone(), there(), None)),
        }
    }
    let new = b.keys().filter(|name| !a.contains_key(*name));
    found.extend(new.filter_map(|name| Change::of_words(group, name.clone(), None, there())));
    found
}

fn length(group: Group, what: String, a: f64, b: f64) -> Option<Change> {
    Change::of_number(group, what, [1e3 * a, 1e3 * b], "mm", LEAST_MM)
}

fn piece(name: &str, a: &Piece, b: &Piece) -> Vec<Change> {
    let lines =
        [("outline", Some(&a.outline), Some(&b.outline)), ("cut line", a.cut_line.as_ref(), b.cut_line.as_ref())];
    let mut found = Vec::new();
    for (what, a, b) in lines {
        let (Some(a), Some(b)) = (a, b) else { continue };
        let moved = 1e3 * apart(a, b).max(apart(b, a));
        found.extend(Change::moved(Group::Pieces, format!("{name}, {what} moved by at most"), moved, "mm", LEAST_MM));
        found.extend(length(Group::Pieces, format!("{name}, length of the {what}"), a.length(), b.length()));
    }
    let areas = [a, b].map(|p| 1e4 * p.outline.signed_area().abs());
    found.extend(Change::of_number(Group::Pieces, format!("{name}, area"), areas, "cm²", 1e-3));
    let counts = [a, b].map(|p| Some(p.notches.len().to_string()));
    let [before, after] = counts;
    found.extend(Change::of_words(Group::Pieces, format!("{name}, notches"), before, after));
    let own = |d: &Dart| format!("{name}, {}", d.name);
    found.extend(both(Group::Darts, &by_name(&a.darts, own), &by_name(&b.darts, own), dart));
    found
}

fn dart(name: &str, a: &Dart, b: &Dart) -> Vec<Change> {
    let moved = |what: &str, a: Vec2, b: Vec2| {
        Change::moved(Group::Darts, format!("{name}, {what} moved by"), 1e3 * (b - a).norm(), "mm", LEAST_MM)
    };
    let apexes = a.apexes.iter().zip(&b.apexes).filter_map(|(a, b)| moved("apex", *a, *b));
    let middle = |d: &Dart| 0.5 * (d.mouth[0] + d.mouth[1]);
    let mut found: Vec<Change> = apexes.collect();
    found.extend(moved("mouth", middle(a), middle(b)));
    found.extend(length(Group::Darts, format!("{name}, intake"), a.intake(), b.intake()));
    for leg in [0, 1] {
        found.extend(length(Group::Darts, format!("{name}, leg {}", leg + 1), a.leg_length(leg), b.leg_length(leg)));
    }
    found
}

/// Largest distance from a vertex of one line to another line, metres.
fn apart(from: &PieceLine, to: &PieceLine) -> f64 {
    let points = to.positions();
    let ends = |k: usize| (points[k], points[(k + 1) % points.len()]);
    let count = if to.closed { points.len() } else { points.len().saturating_sub(1) };
    let distance = |p: Vec2| (0..count).map(|k| to_stretch(p, ends(k))).fold(f64::INFINITY, f64::min);
    from.positions().into_iter().map(distance).fold(0.0, f64::max)
}

fn to_stretch(p: Vec2, (a, b): (Vec2, Vec2)) -> f64 {
    let along = b - a;
    let whole = along.norm_squared();
    let share = if whole > 0.0 { ((p - a).dot(&along) / whole).clamp(0.0, 1.0) } else { 0.0 };
    (p - a - along * share).norm()
}

fn measures(a: &Garment, b: &Garment) -> Vec<Change> {
    let all = |g: &Garment| -> BTreeMap<String, f64> {
        let measures = fit::measure(g).measures();
        measures.into_iter().map(|m| (format!("{} on {}, {}", m.name, m.on, m.method), m.length)).collect()
    };
    let (a, b) = (all(a), all(b));
    let both = a.iter().filter_map(|(name, x)| Some((name, *x, *b.get(name)?)));
    both.filter_map(|(name, x, y)| length(Group::Measures, name.clone(), x, y)).collect()
}
