//! Stitches: seams between edges, and darts where the two legs of a wedge are sewn together.

use super::codes;
use super::panel::Built;
use super::spec::{Spec, Stitch};
use crate::dxf::geom::{cross, length};
use std::collections::BTreeSet;
use toile_garment::dart::{Dart, DartEvidence, DartKind};
use toile_garment::sewing::{RunSpec, SeamSpec};
use toile_garment::{Diagnostic, Vec2};

/// Sides of a seam that differ less are equal, metres.
const EQUAL: f64 = 1e-4;
/// Sides that differ more, longer over shorter, are gathered.
const GATHERED: f64 = 1.15;

/// The meaning of the stitches.
#[derive(Debug, Default)]
pub struct Sewn {
    pub seams: Vec<SeamSpec>,
    /// Piece and dart.
    pub darts: Vec<(usize, Dart)>,
}

/// Seams and darts of all stitches.
pub fn seams(spec: &Spec, panels: &[Built], findings: &mut Vec<Diagnostic>) -> Result<Sewn, Vec<Diagnostic>> {
    let mut out = Sewn::default();
    let mut taken = BTreeSet::new();
    let mut errors = Vec::new();
    for (i, stitch) in spec.stitches.iter().enumerate() {
        for (panel, edge) in stitch.sides {
            if !taken.insert((panel, edge)) {
                let name = &spec.panels[panel].name;
                let text = format!("stitch {i}: edge {edge} of panel `{name}` is sewn twice");
                errors.push(super::wrong(text));
            }
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let mut used = vec![false; spec.stitches.len()];
    for i in 0..spec.stitches.len() {
        if !used[i]
            && let Some((piece, dart)) = dart(spec, panels, i, &mut used)
        {
            out.darts.push((piece, dart));
        }
    }
    for (i, stitch) in spec.stitches.iter().enumerate().filter(|(i, _)| !used[*i]) {
        out.seams.push(seam(panels, stitch, i, findings));
    }
    Ok(out)
}

/// Places of both sides in the outline of one piece.
fn places(panels: &[Built], stitch: &Stitch) -> Option<(usize, [usize; 2])> {
    let [(p, a), (q, b)] = stitch.sides;
    (p == q && !stitch.same).then(|| (p, [panels[p].place[a], panels[p].place[b]]))
}

/// A dart around the stitch whose edges meet in its apex; further stitches along its legs belong to it.
fn dart(spec: &Spec, panels: &[Built], first: usize, used: &mut [bool]) -> Option<(usize, Dart)> {
    let (p, [a, b]) = places(panels, &spec.stitches[first])?;
    let piece = &panels[p].piece;
    let n = piece.edges.len();
    // Counter-clockwise the edge towards the apex comes first.
    let (mut inward, mut outward) = match ((a + 1) % n == b, (b + 1) % n == a) {
        (true, false) => (a, b),
        (false, true) => (b, a),
        _ => return None,
    };
    let run = |k: usize| edge_points(piece, k);
    let (before, after) = (run(inward), run(outward));
    let apex = *after.first()?;
    let (u, v) = (apex - before[before.len() - 2], after[1] - apex);
    // Only a reflex vertex is the tip of a wedge cut out of the cloth.
    if cross(u, v) >= 0.0 {
        return None;
    }
    used[first] = true;
    let mut legs = [before, after.iter().rev().copied().collect::<Vec<_>>()];
    loop {
        let wider = ((inward + n - 1) % n, (outward + 1) % n);
        let next = (0..spec.stitches.len()).find(|i| {
            !used[*i]
                && places(panels, &spec.stitches[*i])
                    .is_some_and(|(q, ends)| q == p && (ends == [wider.0, wider.1] || ends == [wider.1, wider.0]))
        });
        let Some(next) = next.filter(|_| wider.0 != wider.1) else { break };
        used[next] = true;
        (inward, outward) = wider;
        let mut left = run(inward);
        left.pop();
        legs[0].splice(0..0, left);
        let mut right: Vec<Vec2> = run(outward).into_iter().rev().collect();
        right.pop();
        legs[1].splice(0..0, right);
    }
    let mouth = [legs[0][0], legs[1][0]];
    let dart = Dart {
        name: String::new(),
        kind: DartKind::Wedge,
        evidence: DartEvidence::Declared,
        apexes: vec![apex],
        mouth,
        legs,
        line: "cut".into(),
        depth: None,
        mesh: None,
        source: None,
    };
    Some((p, dart))
}

/// Points of an edge, both ends included.
fn edge_points(piece: &toile_garment::Piece, edge: usize) -> Vec<Vec2> {
    let points = &piece.outline.points;
    let (from, to) = (piece.edges[edge].from as usize, piece.edges[edge].to as usize);
    let steps = (to + points.len() - from) % points.len();
    (0..=steps).map(|k| points[(from + k) % points.len()].at).collect()
}

fn seam(panels: &[Built], stitch: &Stitch, number: usize, findings: &mut Vec<Diagnostic>) -> SeamSpec {
    let side = |(p, e): (usize, usize)| (&panels[p].piece, panels[p].place[e]);
    let [(a, i), (b, j)] = stitch.sides.map(side);
    let (la, lb) = (length(&edge_points(a, i), false), length(&edge_points(b, j), false));
    let ratio = la.max(lb) / la.min(lb).max(1e-9);
    let (ease, gather) = match (la - lb).abs() {
        d if d <= EQUAL => (None, None),
        _ if ratio > GATHERED => (None, Some(ratio)),
        _ => (Some(la - lb), None),
    };
    if let Some(ratio) = gather {
        let text = format!(
            "stitch {number}: `{}.{i}` is {:.1} mm long and `{}.{j}` {:.1} mm; sewn as a gather of {ratio:.2}",
            a.name,
            la * 1e3,
            b.name,
            lb * 1e3
        );
        findings.push(Diagnostic::info(codes::GARMENTCODE_GATHERS, text));
    }
    let run =
        |piece: &toile_garment::Piece, k: usize| vec![RunSpec::Edge { piece: piece.name.clone(), edge: k.to_string() }];
    let reverse = Some(!stitch.same);
    SeamSpec {
        name: format!("stitch-{number}"),
        a: run(a, i),
        b: run(b, j),
        reverse,
        ease,
        gather,
        proposed: None,
        source: None,
    }
}
