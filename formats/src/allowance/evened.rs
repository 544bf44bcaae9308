//! Cut lines that were made in every size apart get the same vertices in each. The curves of a larger size have more
//! chords, and a grade rule leads from a vertex of one size to the same vertex of another.

use crate::dxf::write::begun_like;
use std::collections::BTreeMap;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::{Piece, Vec2};

/// Gives the cut lines that were made of some pieces as many vertices in each of their sizes, where they have the same
/// corners. The curve between two corners gets the vertices of the size that has most of them, at the same shares of its
/// length.
pub fn even_sizes(pieces: &mut [Piece], made: &[usize]) {
    let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for i in made.iter().filter(|i| pieces[**i].size.is_some()) {
        groups.entry(pieces[*i].base_name().to_owned()).or_default().push(*i);
    }
    for group in groups.values().filter(|group| group.len() > 1) {
        let lines: Vec<&PieceLine> = group.iter().filter_map(|i| pieces[*i].cut_line.as_ref()).collect();
        let Some(evened) = even(&lines) else { continue };
        for (i, points) in group.iter().zip(evened) {
            if let Some(line) = &mut pieces[*i].cut_line {
                line.points = points;
            }
        }
    }
}

/// The points of closed lines with as many vertices in each; `None` where they are the same already, or have other corners.
fn even(lines: &[&PieceLine]) -> Option<Vec<Vec<LinePoint>>> {
    let corners = |l: &PieceLine| l.points.iter().filter(|p| p.kind == PointKind::Turn).cloned().collect::<Vec<_>>();
    let own = corners(lines.first()?);
    let begun = lines.iter().map(|l| begun_like(&own, &corners(l), l.points.clone())).collect::<Option<Vec<_>>>()?;
    let runs: Vec<Vec<Vec<LinePoint>>> = begun.iter().map(|points| runs(points)).collect();
    let count = |run: usize| runs.iter().map(move |of| of[run].len());
    let is_even = |run: &usize| count(*run).all(|n| n == runs[0][*run].len());
    if (0..own.len()).all(|run| is_even(&run)) {
        return None;
    }
    let mut out = vec![Vec::new(); lines.len()];
    for run in 0..own.len() {
        let longest = runs.iter().map(|of| &of[run]).max_by_key(|run| run.len())?;
        let shares = shares(longest);
        for (points, of) in out.iter_mut().zip(&runs) {
            let last = of[run].len() - 1;
            let as_it_is = is_even(&run);
            points.extend(if as_it_is { of[run][..last].to_vec() } else { placed(&of[run], &shares) });
        }
    }
    Some(out)
}

/// The runs from corner to corner of a line that begins at one, both ends in each.
fn runs(points: &[LinePoint]) -> Vec<Vec<LinePoint>> {
    let mut out: Vec<Vec<LinePoint>> = Vec::new();
    for p in points.iter().chain(points.first()) {
        if let Some(run) = out.last_mut() {
            run.push(p.clone());
        }
        if p.kind == PointKind::Turn {
            out.push(vec![p.clone()]);
        }
    }
    out.pop();
    out
}

/// The way to each vertex of a run, as a share of its length.
fn shares(run: &[LinePoint]) -> Vec<f64> {
    let mut way = 0.0;
    let mut out = vec![0.0];
    for pair in run.windows(2) {
        way += (pair[1].at - pair[0].at).norm();
        out.push(way);
    }
    out.iter().map(|s| if way > 0.0 { s / way } else { 0.0 }).collect()
}

/// A run with its vertices at shares of its length, without its end.
fn placed(run: &[LinePoint], at: &[f64]) -> Vec<LinePoint> {
    let own = shares(run);
    let place = |share: &f64| -> Vec2 {
        let k = own.partition_point(|s| s <= share).clamp(1, own.len() - 1);
        let step = own[k] - own[k - 1];
        let t = if step > 0.0 { (share - own[k - 1]) / step } else { 0.0 };
        run[k - 1].at + (run[k].at - run[k - 1].at) * t
    };
    let inner = at[1..at.len() - 1].iter().map(|share| LinePoint { at: place(share), kind: PointKind::Plain });
    std::iter::once(run[0].clone()).chain(inner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::allowance::{Allowance, cut_line};

    /// A half disc of this radius, its arc in chords of this number, with an allowance of 10 mm.
    fn sized(size: &str, radius: f64, chords: u32) -> Piece {
        let at = |k: u32| {
            let (s, c) = libm::sincos(std::f64::consts::PI * f64::from(k) / f64::from(chords));
            Vec2::new(radius * c, radius * s)
        };
        let kind = |k| if k == 0 || k == chords { PointKind::Turn } else { PointKind::Plain };
        let points = (0..=chords).map(|k| LinePoint { at: at(k), kind: kind(k) }).collect();
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        let mut piece = Piece { name: format!("CUP@{size}"), size: Some(size.to_owned()), outline, ..Piece::default() };
        let allowance = Allowance { width: 0.01, ..Allowance::default() };
        piece.cut_line = Some(cut_line(&piece, &allowance).expect("cut line").0);
        piece
    }

    #[test]
    fn every_size_has_the_vertices_of_the_one_with_most() {
        let made = [sized("36", 0.05, 21), sized("38", 0.06, 24), sized("40", 0.07, 26)];
        let mut pieces = made.clone();
        even_sizes(&mut pieces, &[0, 1, 2]);
        let kinds = |p: &Piece| p.cut_line.iter().flat_map(|l| &l.points).map(|q| q.kind).collect::<Vec<_>>();
        assert!(made.iter().map(kinds).collect::<Vec<_>>().windows(2).all(|w| w[0] != w[1]));
        assert!(pieces.iter().all(|p| kinds(p) == kinds(&pieces[2])));
        for (before, after) in made.iter().zip(&pieces) {
            let [before, after] = [before, after].map(|p| p.cut_line.as_ref().expect("cut line").positions());
            let off = crate::dxf::geom::deviation(&before, &after, true);
            let back = crate::dxf::geom::deviation(&after, &before, true);
            // The chords themselves are up to 0.15 mm off the arc.
            assert!(off.max(back) < 3e-4, "{off} {back}");
        }
        let again = pieces.clone();
        even_sizes(&mut pieces, &[0, 1, 2]);
        assert_eq!(pieces, again);
    }
}
