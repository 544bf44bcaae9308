//! The plan is judged before the first step: what cannot be sewn from its places is refused, with the names of the
//! pieces.

use super::codes;
use super::ignored_parts::lies_on;
use crate::solve::body_parts::body_parts;
use crate::solve::layer_of;
use toile_garment::seam::SeamKind;
use toile_garment::{Diagnostic, Garment, MeshVertex, PieceId, SourceRef, Vec3};

/// Distance from the middle of the body at which what a sleeve is sewn to lies on one side, m.
const ASIDE: f64 = 0.03;
/// Largest share of their threads that is left, if two pieces are exchanged that were placed at each other's place.
const EXCHANGED: f64 = 0.4;
/// Mean length of their threads from which two pieces are looked at, m.
const FAR: f64 = 0.25;
/// Mean length of the threads of a seam that are too long to be drawn together, m. The side seams of circle skirts that
/// start as flat sheets have up to 0.45 m.
const OUT_OF_REACH: f64 = 2.0;

/// Threads of a piece to other pieces: own place and that of the other end, m, and the other piece.
type Threads = Vec<(Vec3, Vec3, usize)>;

/// All that cannot be sewn from these places.
#[must_use]
pub fn faults(garment: &Garment, placed: &[Vec<Vec3>]) -> Vec<Diagnostic> {
    let threads = threads(garment, placed);
    let swapped = on_wrong_arm(garment, placed, &threads);
    let exchanged = exchanged(garment, placed, &threads, &swapped.iter().map(|(i, _)| *i).collect::<Vec<_>>());
    swapped.into_iter().map(|(_, finding)| finding).chain(exchanged).chain(out_of_reach(garment, placed)).collect()
}

fn at(placed: &[Vec<Vec3>], v: MeshVertex) -> Option<Vec3> {
    placed.get(v.piece.index())?.get(v.vertex as usize).copied()
}

fn threads(garment: &Garment, placed: &[Vec<Vec3>]) -> Vec<Threads> {
    let mut threads = vec![Threads::new(); placed.len()];
    for s in garment.seams.iter().filter(|s| matches!(s.kind, SeamKind::Seam)).flat_map(|s| &s.stitches) {
        let (i, k) = (s.a.piece.index(), s.b.piece.index());
        if let (true, Some(a), Some(b)) = (i != k, at(placed, s.a), at(placed, s.b)) {
            threads[i].push((a, b, k));
            threads[k].push((b, a, i));
        }
    }
    threads
}

/// Mean length, m, with the own piece and some other pieces moved.
fn mean(threads: &Threads, by: Vec3, others: impl Fn(usize) -> Vec3) -> f64 {
    let sum: f64 = threads.iter().map(|(a, b, k)| (a + by - b - others(*k)).norm()).sum();
    sum / threads.len().max(1) as f64
}

fn middle(x: &[Vec3]) -> Vec3 {
    x.iter().sum::<Vec3>() / x.len().max(1) as f64
}

/// Pieces on an arm that are sewn to cloth on the other side of the body.
fn on_wrong_arm(garment: &Garment, placed: &[Vec<Vec3>], threads: &[Threads]) -> Vec<(usize, Diagnostic)> {
    let Some(body) = &garment.body else { return Vec::new() };
    let parts = body_parts(body);
    let centre = body.segments.get("torso").map_or(0.0, |s| s.from.x);
    let arm_of = |i: usize| ["arm-left", "arm-right"].into_iter().find(|arm| lies_on(&placed[i], arm, &parts));
    let arms: Vec<Option<&str>> = (0..placed.len()).map(arm_of).collect();
    let mut found = Vec::new();
    for (i, arm) in arms.iter().enumerate() {
        let Some(arm) = arm else { continue };
        let ends: Vec<f64> = threads[i].iter().filter(|t| arms[t.2].is_none()).map(|t| t.1.x - centre).collect();
        let mean_end = ends.iter().sum::<f64>() / ends.len().max(1) as f64;
        let sign = if *arm == "arm-left" { 1.0 } else { -1.0 };
        if sign * mean_end >= -ASIDE {
            continue;
        }
        let other = if *arm == "arm-left" { "arm-right" } else { "arm-left" };
        let message = format!(
            "piece `{}` lies on {arm}, and it is sewn to cloth on the other side of the body: its threads are {:.0} mm long \
             on average and lead through the body",
            garment.pieces[i].name,
            mean(&threads[i], Vec3::zeros(), |_| Vec3::zeros()) * 1e3
        );
        let hint = format!("place it on {other}, or sew it to the other armhole");
        found.push((i, Diagnostic::error(codes::ARM_SWAPPED, message).at(garment.pieces[i].source.clone()).hint(hint)));
    }
    found
}

/// Pairs of pieces that would lie well at each other's place.
fn exchanged(garment: &Garment, placed: &[Vec<Vec3>], threads: &[Threads], told: &[usize]) -> Vec<Diagnostic> {
    let still = |_| Vec3::zeros();
    let far = |i: &usize| !told.contains(i) && mean(&threads[*i], Vec3::zeros(), still) > FAR;
    let far: Vec<usize> = (0..placed.len()).filter(far).collect();
    let mut found = Vec::new();
    for (n, i) in far.iter().enumerate() {
        // Exchanged layers would be as wrong as threads around the body.
        let layer = |p: &usize| layer_of(garment, &garment.pieces[*p]);
        for k in far[n + 1..].iter().filter(|k| layer(k) == layer(i)) {
            let by = middle(&placed[*k]) - middle(&placed[*i]);
            let others = |p: usize| if p == *k { -by } else { Vec3::zeros() };
            let own = |p: usize| if p == *i { by } else { Vec3::zeros() };
            let before = [*i, *k].map(|p| mean(&threads[p], Vec3::zeros(), still));
            let after = [mean(&threads[*i], by, others), mean(&threads[*k], -by, own)];
            if (0..2).all(|p| after[p] < EXCHANGED * before[p]) {
                let [a, b] = [*i, *k].map(|p| garment.pieces[p].name.as_str());
                let message = format!(
                    "pieces `{a}` and `{b}` lie at each other's place: their threads are {:.0} mm long on average, and {:.0} \
                     mm if they are exchanged",
                    500.0 * (before[0] + before[1]),
                    500.0 * (after[0] + after[1])
                );
                let finding = Diagnostic::error(codes::PIECES_EXCHANGED, message);
                found.push(
                    finding.at(garment.pieces[*i].source.clone()).hint("exchange their places in the sewing file"),
                );
            }
        }
    }
    found
}

/// Seams whose sides are too far from each other.
fn out_of_reach(garment: &Garment, placed: &[Vec<Vec3>]) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for seam in &garment.seams {
        let ends = seam.stitches.iter().filter_map(|s| Some((at(placed, s.a)? - at(placed, s.b)?).norm()));
        let pieces = seam.a.runs.iter().chain(&seam.b.runs).map(|run| run.piece);
        found.extend(beyond_reach(garment, &seam.name, pieces, &ends.collect::<Vec<_>>(), seam.source.as_ref()));
    }
    found
}

/// The finding on a seam whose threads, m, are too long.
pub fn beyond_reach(
    garment: &Garment,
    seam: &str,
    pieces: impl Iterator<Item = PieceId>,
    threads: &[f64],
    source: Option<&SourceRef>,
) -> Option<Diagnostic> {
    let mean = threads.iter().sum::<f64>() / threads.len().max(1) as f64;
    if mean <= OUT_OF_REACH {
        return None;
    }
    let longest = threads.iter().copied().fold(0.0, f64::max);
    let mut names: Vec<String> = Vec::new();
    for name in pieces.filter_map(|p| Some(format!("`{}`", garment.pieces.get(p.index())?.name))) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let message = format!(
        "seam `{seam}` of {} is out of reach: its threads are {:.0} mm long on average and {:.0} mm at most",
        names.join(" and "),
        mean * 1e3,
        longest * 1e3
    );
    let finding = Diagnostic::error(codes::SEAM_OUT_OF_REACH, message).at(source.cloned());
    Some(finding.hint("place the pieces beside each other, or leave their [[place]] out"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::body_of;
    use toile_garment::body::Body;
    use toile_garment::mesh::PieceMesh;
    use toile_garment::seam::{Seam, SeamSide, Stitch};
    use toile_garment::{Piece, SeamId, Vec2};

    fn body() -> Body {
        body_of(&[
            ("torso", [0.0, 1.4, 0.0], [0.0, 0.8, 0.0], 0.17),
            ("arm-left", [0.16, 1.39, 0.0], [0.54, 1.0, 0.0], 0.05),
            ("arm-right", [-0.16, 1.39, 0.0], [-0.54, 1.0, 0.0], 0.05),
        ])
    }

    /// Pieces of 0.2 m by 0.2 m around the middles given; each is sewn to the next along the side that faces it in the
    /// order left to right.
    fn row(names: &[&str], middles: &[[f64; 3]]) -> (Garment, Vec<Vec<Vec3>>) {
        let rest = vec![Vec2::new(-0.1, -0.1), Vec2::new(0.1, -0.1), Vec2::new(0.1, 0.1), Vec2::new(-0.1, 0.1)];
        let piece = |(id, name): (usize, &&str)| Piece {
            id: PieceId::from(id),
            name: (*name).into(),
            mesh: Some(PieceMesh { rest: rest.clone(), triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() }),
            ..Piece::default()
        };
        let seam = |i: usize| {
            let stitch = |a: u32, b: u32| Stitch {
                a: MeshVertex { piece: PieceId::from(i), vertex: a },
                b: MeshVertex { piece: PieceId::from(i + 1), vertex: b },
            };
            let side = SeamSide { runs: Vec::new(), length: 0.2 };
            Seam {
                id: SeamId::from(i),
                name: format!("seam-{i}"),
                kind: SeamKind::Seam,
                a: side.clone(),
                b: side,
                ease: 0.0,
                gather: None,
                stitches: vec![stitch(1, 0), stitch(2, 3)],
                source: None,
            }
        };
        let garment = Garment {
            pieces: names.iter().enumerate().map(piece).collect(),
            seams: (0..names.len() - 1).map(seam).collect(),
            body: Some(body()),
            ..Garment::default()
        };
        let at = |m: &[f64; 3]| rest.iter().map(|p| Vec3::new(p.x + m[0], p.y + m[1], m[2])).collect();
        (garment, middles.iter().map(at).collect())
    }

    const TRUNK: [f64; 3] = [0.1, 1.2, 0.2];
    const LEFT: [f64; 3] = [0.4, 1.1, 0.1];
    const RIGHT: [f64; 3] = [-0.4, 1.1, 0.1];

    #[test]
    fn a_sleeve_on_the_other_arm_is_named() {
        let (garment, placed) = row(&["TRUNK", "SLEEVE"], &[TRUNK, LEFT]);
        assert!(faults(&garment, &placed).is_empty());
        let (garment, placed) = row(&["TRUNK", "SLEEVE"], &[TRUNK, RIGHT]);
        let found = faults(&garment, &placed);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].code == codes::ARM_SWAPPED && found[0].message.contains("`SLEEVE` lies on arm-right"));
        assert!(found[0].hint.as_deref().is_some_and(|h| h.contains("arm-left")));
    }

    #[test]
    fn two_pieces_at_each_others_place_are_named() {
        let four = ["A", "B", "C", "D"];
        let row_of = |order: [usize; 4]| order.map(|k| [0.22 * k as f64 - 0.33, 0.9, 0.2]);
        let (garment, placed) = row(&four, &row_of([0, 1, 2, 3]));
        assert!(faults(&garment, &placed).is_empty());
        let (garment, placed) = row(&four, &row_of([0, 2, 1, 3]));
        let found = faults(&garment, &placed);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].code == codes::PIECES_EXCHANGED);
        assert!(found[0].message.contains("`B` and `C`"));
    }

    #[test]
    fn a_seam_across_the_room_is_out_of_reach() {
        let (garment, placed) = row(&["A", "B"], &[TRUNK, [3.0, 1.2, 0.2]]);
        let found = faults(&garment, &placed);
        assert!(found.iter().any(|f| f.code == codes::SEAM_OUT_OF_REACH && f.message.contains("seam-0")), "{found:?}");
    }
}
