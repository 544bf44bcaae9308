//! Names and sizes from `PIECE_SIZE` block names, where a file has no texts that say them.

use super::codes;
use crate::dxf::desk::Desk;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::Diagnostic;

/// A piece to be named: its block and the line of it, and what its texts say.
pub(super) struct Named<'a> {
    pub block: &'a str,
    pub line: u64,
    pub name: &'a mut Option<String>,
    pub size: &'a mut Option<String>,
}

/// Splits the block names of pieces that have neither `Piece Name` nor `Size`, when their tails are sizes: the sample
/// size is among them, or one piece has several, or several pieces have the same.
pub(super) fn fill(mut pieces: Vec<Named<'_>>, sample: Option<&str>, desk: &mut Desk<'_>) {
    let parts: Vec<Option<(String, String)>> =
        pieces.iter().map(|p| if p.name.is_none() && p.size.is_none() { split(p.block) } else { None }).collect();
    let mut tails: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let mut heads: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (head, tail) in parts.iter().flatten() {
        tails.entry(tail).or_default().insert(head);
        heads.entry(head).or_default().insert(tail);
    }
    let sure = parts.iter().flatten().any(|(head, tail)| {
        sample.is_some_and(|s| s.trim().eq_ignore_ascii_case(tail))
            || tails.get(tail.as_str()).is_some_and(|h| h.len() > 1)
            || heads.get(head.as_str()).is_some_and(|t| t.len() > 1)
    });
    let Some(first) = parts.iter().position(Option::is_some).filter(|_| sure) else { return };
    let text = format!(
        "no text names pieces and sizes; they were taken from the block names, as `{}`",
        pieces.get(first).map_or("", |p| p.block)
    );
    let place = desk.findings.place(pieces.get(first).map_or(1, |p| p.line));
    desk.findings.push(Diagnostic::info(codes::NAME_FROM_BLOCK, text).at(place));
    for (piece, part) in pieces.iter_mut().zip(&parts) {
        if let Some((head, tail)) = part {
            (*piece.name, *piece.size) = (Some(head.clone()), Some(tail.clone()));
        }
    }
}

/// `FRONT_38` and `FRONT_XL`, not `SLEEVE_2`.
fn split(block: &str) -> Option<(String, String)> {
    let (head, tail) = block.trim().rsplit_once('_').filter(|(h, _)| !h.is_empty())?;
    let number = tail.len() <= 3 && tail.parse::<u32>().is_ok_and(|n| (20..=200).contains(&n));
    let letters = tail.trim_start_matches(|c: char| c.is_ascii_digit()).to_ascii_uppercase();
    let known = ["XS", "XXS", "S", "M", "L", "XL", "XXL", "XXXL"].contains(&letters.as_str()) && tail.len() <= 4;
    (number || known).then(|| (head.to_owned(), tail.to_owned()))
}
