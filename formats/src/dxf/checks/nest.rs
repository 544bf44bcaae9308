//! Sizes of a nest that do not fit each other, and pieces that stand in a file twice.

use super::codes;
use crate::dxf::codes::{PIECES_FROM_ENTITIES, SIZES_DIFFER_IN_VERTICES};
use crate::dxf::desk::Desk;
use crate::dxf::piece::{DrawnPiece, RefusedPiece};
use std::collections::BTreeMap;
use toile_garment::Diagnostic;
use toile_garment::outline::PointKind;

type Group = BTreeMap<String, Vec<usize>>;

fn tidy(text: &str) -> String {
    text.trim().to_ascii_lowercase()
}

pub(super) fn check(pieces: &[DrawnPiece], refused: &[RefusedPiece], sample: Option<&str>, desk: &mut Desk<'_>) {
    let mut named = Group::new();
    for (i, piece) in pieces.iter().enumerate() {
        if let Some(name) = &piece.name {
            named.entry(name.clone()).or_default().push(i);
        }
    }
    let mut sizes: Vec<&str> = Vec::new();
    let mut seen = std::collections::BTreeSet::new();
    let others = refused.iter().filter_map(|p| p.size.as_deref());
    for size in pieces.iter().filter_map(|p| p.size.as_deref()).chain(others) {
        if seen.insert(tidy(size)) {
            sizes.push(size);
        }
    }
    sample_size(pieces, &sizes, sample, desk);
    names(pieces, desk);
    alike_names(&named, pieces, desk);
    for list in named.values() {
        let group: Vec<&DrawnPiece> = list.iter().map(|i| &pieces[*i]).collect();
        twice(&group, desk);
        vertices(&group, sample, desk);
        corners_and_notches(&group, sample, desk);
        let spoilt: Vec<&RefusedPiece> = refused.iter().filter(|r| r.name == group[0].name).collect();
        lacking(&group, &spoilt, &sizes, desk);
        without_sample(&group, &spoilt, desk);
    }
}

fn sample_size(pieces: &[DrawnPiece], sizes: &[&str], sample: Option<&str>, desk: &mut Desk<'_>) {
    if sizes.is_empty() || sample.is_some_and(|s| sizes.iter().any(|d| tidy(d) == tidy(s))) {
        return;
    }
    let drawn = sizes.join(", ");
    let text = match sample {
        Some(sample) => format!("the sample size `{sample}` is not drawn; the file holds {drawn}"),
        None if sizes.len() > 1 => format!("no text `Sample Size` says which of the sizes {drawn} is the sample size"),
        None => return,
    };
    let place = desk.findings.place(pieces.first().map_or(1, |p| p.line));
    let hint = "without a size that is asked for, one of those that are drawn is taken; give size = \"…\"";
    desk.findings.push(Diagnostic::warning(codes::SAMPLE_SIZE_MISSING, text).at(place).hint(hint));
}

/// No piece has a name, and the names of the blocks say none either.
fn names(pieces: &[DrawnPiece], desk: &mut Desk<'_>) {
    let unnamed = pieces.iter().all(|p| p.name.is_none()) && !desk.findings.said(PIECES_FROM_ENTITIES);
    let Some(first) = pieces.first().filter(|_| unnamed) else { return };
    let text = format!(
        "no text `Piece Name` names the {} piece(s); they have the names of their blocks, as `{}`",
        pieces.len(),
        first.block
    );
    let place = desk.findings.place_in(&first.block, Some("1"), first.line);
    desk.findings.push(Diagnostic::info(codes::PIECE_NAME_MISSING, text).at(place));
}

/// Pieces whose names differ in the case of their letters alone.
fn alike_names(named: &Group, pieces: &[DrawnPiece], desk: &mut Desk<'_>) {
    let mut first: BTreeMap<String, &str> = BTreeMap::new();
    for (name, list) in named {
        let Some(other) = first.insert(name.to_lowercase(), name) else { continue };
        let text = format!("the names of the pieces `{other}` and `{name}` differ in the case of their letters alone");
        let hint = "give them names of their own: other systems, and names of files, may not tell them apart";
        let second = &pieces[list[0]];
        desk.say(Diagnostic::warning(codes::PIECE_NAMES_ALIKE, text).hint(hint), &second.block, "1", second.line);
    }
}

/// Two pieces of one name and size.
fn twice(group: &[&DrawnPiece], desk: &mut Desk<'_>) {
    let mut by_size: BTreeMap<Option<String>, Vec<&DrawnPiece>> = BTreeMap::new();
    for piece in group {
        by_size.entry(piece.size.as_deref().map(tidy)).or_default().push(piece);
    }
    for list in by_size.values().filter(|l| l.len() > 1) {
        let (first, second) = (list[0], list[1]);
        let same = list[1..].iter().all(|p| alike(first, p));
        let size = first.size.as_ref().map_or_else(String::new, |s| format!(" in size {s}"));
        let text = format!(
            "{} blocks are called `{}`{size}, as `{}` and `{}`, with {}; all were read, the later ones under a numbered name",
            list.len(),
            first.label(),
            first.block,
            second.block,
            if same { "the same outline" } else { "different outlines" }
        );
        let hint = "give the pieces names of their own, or take the one too many out of the file";
        desk.say(Diagnostic::warning(codes::PIECE_REPEATS, text).hint(hint), &second.block, "1", second.line);
    }
}

fn alike(a: &DrawnPiece, b: &DrawnPiece) -> bool {
    let (p, q) = (&a.boundary.drawn, &b.boundary.drawn);
    let (Some(first), Some(other)) = (p.first(), q.first()) else { return p.len() == q.len() };
    // Pieces that lie apart on the table may still be the same.
    let shift = other.at - first.at;
    p.len() == q.len() && p.iter().zip(q).all(|(a, b)| (a.at + shift - b.at).norm() <= 0.05)
}

/// Sizes with corners of their own need not have the vertices of the sample size; then nothing leads from one to the
/// other.
fn vertices(group: &[&DrawnPiece], sample: Option<&str>, desk: &mut Desk<'_>) {
    let is_sample = |p: &&&DrawnPiece| is_in_size(p, sample);
    let marked = || group.iter().filter(|p| p.points.marked && p.size.is_some());
    let Some(base) = marked().find(is_sample).or_else(|| marked().next()) else { return };
    let n = base.boundary.drawn.len();
    let other: Vec<String> = marked()
        .filter(|p| p.size != base.size && p.boundary.drawn.len() != n)
        .map(|p| format!("{} ({})", p.size.clone().unwrap_or_default(), p.boundary.drawn.len()))
        .collect();
    if other.is_empty() {
        return;
    }
    let text = format!(
        "the sizes {} of `{}` have another number of vertices than size {} ({n}); each was read on its own",
        other.join(", "),
        base.label(),
        base.size.clone().unwrap_or_default()
    );
    let hint = "names and numbers of edges may differ between these sizes; export the nest again if they should not";
    desk.say(Diagnostic::warning(SIZES_DIFFER_IN_VERTICES, text).hint(hint), &base.block, "1", base.line);
}

/// Corners and notches of all sizes should be as many as in the sample size. Sizes with other vertices are told
/// already.
fn corners_and_notches(group: &[&DrawnPiece], sample: Option<&str>, desk: &mut Desk<'_>) {
    let sized = || group.iter().copied().filter(|p| p.size.is_some());
    let Some(base) = sized().find(|p| is_in_size(p, sample)).or_else(|| sized().next()) else { return };
    let is_marked = sized().any(|p| p.points.marked);
    let is_told = |p: &DrawnPiece| is_marked && p.boundary.drawn.len() != base.boundary.drawn.len();
    let corners = |p: &DrawnPiece| p.sewn().work.iter().filter(|n| n.kind == PointKind::Turn).count();
    if let Some((text, hint)) = uneven(base, sized().filter(|p| !is_told(p)), "corners", corners) {
        desk.say(Diagnostic::warning(SIZES_DIFFER_IN_VERTICES, text).hint(hint), &base.block, "1", base.line);
    }
    // A notch that stands on both lines of a piece is one.
    let notches = |p: &DrawnPiece| p.notches.iter().filter(|n| n.twin.is_none()).count();
    if let Some((text, hint)) = uneven(base, sized(), "notches", notches) {
        desk.say(Diagnostic::warning(codes::SIZES_DIFFER_IN_NOTCHES, text).hint(hint), &base.block, "4", base.line);
    }
}

/// Which sizes have another number of something than the base has, with the remedy.
fn uneven<'a>(
    base: &DrawnPiece,
    sizes: impl Iterator<Item = &'a DrawnPiece>,
    what: &str,
    count: impl Fn(&DrawnPiece) -> usize,
) -> Option<(String, &'static str)> {
    let wanted = count(base);
    let other: Vec<String> = sizes
        .filter(|p| count(p) != wanted)
        .map(|p| format!("{} ({})", p.size.as_deref().unwrap_or_default(), count(p)))
        .collect();
    let text = format!(
        "the sizes {} of `{}` have another number of {what} than size {} ({wanted}); each was read on its own",
        other.join(", "),
        base.label(),
        base.size.as_deref().unwrap_or_default()
    );
    let hint = "numbers of edges and notches may differ between these sizes; export the nest again if they should not";
    (!other.is_empty()).then_some((text, hint))
}

fn is_in_size(piece: &DrawnPiece, size: Option<&str>) -> bool {
    piece.size.as_deref().zip(size).is_some_and(|(a, b)| tidy(a) == tidy(b))
}

/// A piece that is not drawn in all sizes of the nest, and has no rules to make them.
fn lacking(group: &[&DrawnPiece], spoilt: &[&RefusedPiece], sizes: &[&str], desk: &mut Desk<'_>) {
    let Some(first) = group.first().filter(|_| group.iter().all(|p| p.size.is_some() && p.texts.rules.is_empty()))
    else {
        return;
    };
    let drawn = || group.iter().map(|p| &p.size).chain(spoilt.iter().map(|p| &p.size));
    let has = |size: &str| drawn().any(|s| s.as_deref().is_some_and(|s| tidy(s) == tidy(size)));
    let missing: Vec<&str> = sizes.iter().copied().filter(|s| !has(s)).collect();
    if missing.is_empty() {
        return;
    }
    let text = format!(
        "`{}` is not drawn in {} of the {} sizes of this file ({}) and has no grade rules",
        first.label(),
        missing.len(),
        sizes.len(),
        missing.join(", ")
    );
    let hint = "export the piece in every size; a garment in one that is missing is made without it";
    desk.say(Diagnostic::warning(codes::PIECE_LACKS_SIZE, text).hint(hint), &first.block, "1", first.line);
}

/// The size that says the corners and notches cannot be used, so that the others have none.
fn without_sample(group: &[&DrawnPiece], spoilt: &[&RefusedPiece], desk: &mut Desk<'_>) {
    let Some(sample) = spoilt.iter().find(|r| r.marked) else { return };
    if group.iter().any(|p| p.points.marked) {
        return;
    }
    let text = format!(
        "size {} of `{}` cannot be used, and only it says the corners: those of the other sizes were found by angle, and notches may be missing there",
        sample.size.as_deref().unwrap_or("-"),
        sample.label()
    );
    let place = desk.findings.place_in(&sample.block, Some("2"), sample.line);
    let hint = "correct that size in the pattern program";
    desk.findings.push(Diagnostic::warning(codes::SIZES_WITHOUT_SAMPLE, text).at(place).hint(hint));
}
