//! Stitches of a file as seams: those that follow each other along the borders of both sides.

use super::borders::Borders;
use crate::sewing::turned::Lengths;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::{Diagnostic, SourceRef};

type Stitch = (u32, u32);

/// Findings on seams of `file` that are named the wrong way round, as the cloth lies.
pub fn turned(borders: &Borders<'_>, stitches: &[Stitch], file: &str) -> Vec<Diagnostic> {
    let place = |v: u32| borders.at[v as usize];
    let told = seams(borders, stitches).into_iter().filter_map(|seam| {
        let ends: Vec<_> = seam.iter().map(|(a, b)| [place(*a), place(*b)]).collect();
        let ((a, b), (c, d)) = (seam.first()?, seam.last()?);
        let name = format!("`{file}`: the seam from the stitch {a} {b} to {c} {d}");
        Some(Lengths::of_turned(&ends)?.finding(&name).at(SourceRef::file(file)))
    });
    told.collect()
}

/// Stitches in sewing order, seam by seam; rings are left out.
fn seams(borders: &Borders<'_>, stitches: &[Stitch]) -> Vec<Vec<Stitch>> {
    let beside = borders.neighbours();
    let of = |v: u32| beside.get(&v).map_or(&[][..], Vec::as_slice);
    let named: BTreeSet<Stitch> = stitches.iter().copied().collect();
    let near = |(a, b): Stitch| {
        let pairs = of(a).iter().flat_map(|c| of(b).iter().map(|d| (*c, *d)));
        pairs.filter(|s| named.contains(s)).collect::<Vec<Stitch>>()
    };
    let mut left: BTreeMap<Stitch, Vec<Stitch>> = named.iter().map(|s| (*s, near(*s))).collect();
    let ends: Vec<Stitch> = left.iter().filter(|(_, near)| near.len() == 1).map(|(s, _)| *s).collect();
    let mut seams = Vec::new();
    for end in ends {
        let (mut seam, mut next) = (Vec::new(), Some(end));
        while let Some(s) = next {
            let near = left.remove(&s).unwrap_or_default();
            seam.push(s);
            next = near.into_iter().find(|n| left.contains_key(n));
        }
        seams.push(seam);
    }
    seams
}
