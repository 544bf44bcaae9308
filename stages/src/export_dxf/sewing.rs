//! The sewing file of pieces that were flattened.
//!
//! Seams come from the stitches: their ends are mesh vertices, and the mesh went with the outline. So the points lie on
//! the new outline wherever it is. Copies of pieces are drawn as pieces of their own.

use super::outline_map::Follow;
use crate::sewing::{copies, darts, folds};
use toile_garment::dart::{Dart, DartKind};
use toile_garment::mesh::{ChainKind, PieceMesh};
use toile_garment::seam::{Seam, SeamKind, SeamRun, SeamSide};
use toile_garment::sewing::{
    AttachSpec, DartSpec, EdgeNameSpec, ElasticSpec, FoldSpec, RunSpec, RunWay, SeamSpec, SewingPlan,
};
use toile_garment::{Garment, Piece, Vec2};

/// The comment that stands above the file.
pub const HEAD: &str = "The seams of the pieces that were written beside this file. Points are in the coordinates of \
                        their piece.";
/// Difference of two sides that is no ease, metres.
const NO_EASE: f64 = 5e-5;
/// How near a point of the sewing file lies to the dart it means, metres.
const SAME_DART: f64 = 1e-3;

/// The plan of a sewing file for `pieces`, which are the garment's pieces at their new places.
pub fn plan(garment: &Garment, pieces: &[Piece]) -> SewingPlan {
    let declared = garment.seams.iter().filter(|s| s.kind == SeamKind::Seam);
    let plan = &garment.plan;
    let names = edge_names(garment, pieces);
    SewingPlan {
        seams: declared.filter_map(|s| seam(garment, pieces, s)).collect(),
        darts: copies::darts(plan).iter().filter_map(|d| dart(garment, pieces, d)).collect(),
        folds: copies::folds(plan).iter().filter_map(|f| fold(garment, pieces, f)).collect(),
        elastics: plan.elastics.iter().map(|e| elastic(garment, pieces, e)).collect(),
        interlinings: plan.interlinings.clone(),
        wholes: plan.wholes.clone(),
        places: plan.places.clone(),
        layers: plan.layers.clone(),
        attachments: plan.attachments.iter().map(|a| attachment(a, garment)).collect(),
        copies: Vec::new(),
        edge_names: names,
        leave_out: Vec::new(),
        leave_out_source: None,
    }
}

/// The plan of a sewing file for the pieces of a garment that is not assembled yet. Copies are pieces of their own.
pub fn unsewn(garment: &Garment) -> SewingPlan {
    let edge_names = edge_names(garment, &garment.pieces);
    let attachments = garment.plan.attachments.iter().map(|a| attachment(a, garment)).collect();
    let plan = garment.plan.clone();
    let (darts, folds) = (copies::darts(&plan), copies::folds(&plan));
    SewingPlan { edge_names, attachments, darts, folds, copies: Vec::new(), leave_out: Vec::new(), ..plan }
}

/// A piece by its name, before and after.
fn named<'p>(garment: &'p Garment, pieces: &'p [Piece], name: &str) -> Option<(&'p Piece, &'p Piece)> {
    let k = garment.pieces.iter().position(|p| p.name.eq_ignore_ascii_case(name))?;
    Some((&garment.pieces[k], pieces.get(k)?))
}

fn seam(garment: &Garment, pieces: &[Piece], seam: &Seam) -> Option<SeamSpec> {
    let (a, length_a) = side(garment, pieces, &seam.a)?;
    let (b, length_b) = side(garment, pieces, &seam.b)?;
    let reverse = faces(&a, &b).then(|| said_reverse(garment, &seam.name)).flatten();
    let gather = seam.gather.filter(|_| length_a.min(length_b) > 0.0);
    let ease = (gather.is_none() && (length_a - length_b).abs() > NO_EASE).then_some(length_a - length_b);
    Some(SeamSpec {
        name: seam.name.clone(),
        a,
        b,
        reverse,
        ease,
        gather: gather.map(|_| length_a.max(length_b) / length_a.min(length_b)),
        proposed: None,
        source: None,
    })
}

/// Are both sides one run, walked in the same sense? Then the pieces lie face to face.
fn faces(a: &[RunSpec], b: &[RunSpec]) -> bool {
    match (a, b) {
        ([RunSpec::Points { way: x, .. }], [RunSpec::Points { way: y, .. }]) => x == y,
        _ => false,
    }
}

/// Where a person said how two sides meet, the written file says it, too. Both sides are written as they meet, so the
/// second one is not reversed.
fn said_reverse(garment: &Garment, name: &str) -> Option<bool> {
    garment.plan.seams.iter().find(|s| s.name == name)?.reverse.map(|_| false)
}

/// The runs of a side and their length together.
fn side(garment: &Garment, pieces: &[Piece], side: &SeamSide) -> Option<(Vec<RunSpec>, f64)> {
    let mut runs = Vec::new();
    let mut length = 0.0;
    for run in &side.runs {
        let (before, after) = (garment.pieces.get(run.piece.index())?, pieces.get(run.piece.index())?);
        let mesh = before.mesh.as_ref()?;
        let follow = Follow::new(before, &after.outline.positions());
        let at = |v: u32| mesh.rest.get(v as usize).map(|p| follow.carry(*p).0);
        if on_seam_line(mesh, run) {
            let line = run.vertices.iter().map(|v| at(*v)).collect::<Option<Vec<Vec2>>>()?;
            length += line.windows(2).map(|w| (w[1] - w[0]).norm()).sum::<f64>();
            runs.push(RunSpec::Line { piece: before.name.clone(), line });
            continue;
        }
        for part in connected(mesh, run) {
            let (from, to) = (at(*part.first()?)?, at(*part.last()?)?);
            let places = part.iter().map(|v| at(*v)).collect::<Option<Vec<Vec2>>>()?;
            length += places.windows(2).map(|w| (w[1] - w[0]).norm()).sum::<f64>();
            runs.push(RunSpec::Points { piece: before.name.clone(), from, to, way: way(mesh, &part) });
        }
    }
    (!runs.is_empty()).then_some((runs, length))
}

/// Does a run follow a line inside the piece?
fn on_seam_line(mesh: &PieceMesh, run: &SeamRun) -> bool {
    let mut lines = mesh.chains.iter().filter(|c| c.kind == ChainKind::SeamLine);
    lines.any(|c| run.vertices.iter().all(|v| c.vertices.contains(v)))
}

/// The parts of a run that follow a chain of the mesh without a jump over a dart.
fn connected(mesh: &PieceMesh, run: &SeamRun) -> Vec<Vec<u32>> {
    let mut parts: Vec<Vec<u32>> = Vec::new();
    for v in &run.vertices {
        match parts.last_mut() {
            Some(part) if part.last().is_some_and(|u| step(mesh, *u, *v).is_some()) => part.push(*v),
            _ => parts.push(vec![*v]),
        }
    }
    parts.retain(|p| p.len() > 1);
    parts
}

/// The direction in which a closed chain of the mesh leads from one vertex to the next: `true` with the chain.
fn step(mesh: &PieceMesh, from: u32, to: u32) -> Option<bool> {
    mesh.chains.iter().filter(|c| c.closed).find_map(|c| {
        let n = c.vertices.len();
        let k = c.vertices.iter().position(|v| *v == from)?;
        match to {
            _ if c.vertices[(k + 1) % n] == to => Some(true),
            _ if c.vertices[(k + n - 1) % n] == to => Some(false),
            _ => None,
        }
    })
}

fn way(mesh: &PieceMesh, part: &[u32]) -> RunWay {
    match part.windows(2).next().and_then(|w| step(mesh, w[0], w[1])) {
        Some(false) => RunWay::Right,
        _ => RunWay::Left,
    }
}

/// A declared dart where it is now; a denied one where its points went with the outline.
fn dart(garment: &Garment, pieces: &[Piece], spec: &DartSpec) -> Option<DartSpec> {
    let (before, after) = named(garment, pieces, &spec.piece)?;
    let follow = Follow::new(before, &after.outline.positions());
    let carry = |p: &Vec2| follow.carry(*p).0;
    let found = spec.kind.and_then(|_| meant(before, spec));
    let found = found.and_then(|(k, is_turned)| Some((after.darts.get(k)?, is_turned)));
    let (apexes, mouth) = match found {
        Some((d, is_turned)) if d.apexes.len() == spec.apexes.len() => {
            let [a, b] = d.mouth;
            (d.apexes.clone(), if is_turned { [b, a] } else { [a, b] })
        }
        _ => (spec.apexes.iter().map(carry).collect(), [carry(&spec.mouth[0]), carry(&spec.mouth[1])]),
    };
    Some(DartSpec { apexes, mouth, source: None, ..spec.clone() })
}

/// The dart of a piece that a table means, and whether its mouth points stand the other way round there. Pleats beside
/// each other share a mouth point, so the nearest counts.
fn meant(piece: &Piece, spec: &DartSpec) -> Option<(usize, bool)> {
    let is_meant = |d: &Dart| {
        d.apexes.iter().zip(&spec.apexes).any(|(a, b)| (a - b).norm() < SAME_DART)
            || d.mouth.iter().any(|m| spec.mouth.iter().any(|n| (m - n).norm() < SAME_DART))
    };
    let [m, n] = spec.mouth;
    let off = |d: &Dart| {
        let [a, b] = d.mouth;
        let (same, turned) = ((a - m).norm() + (b - n).norm(), (a - n).norm() + (b - m).norm());
        if turned < same { (turned, true) } else { (same, false) }
    };
    let candidates = piece.darts.iter().enumerate().filter(|(_, d)| is_meant(d)).map(|(k, d)| (k, off(d)));
    candidates.min_by(|(_, a), (_, b)| a.0.total_cmp(&b.0)).map(|(k, (_, is_turned))| (k, is_turned))
}

/// Draws pleats where the sewing file will have them: their legs, and the lines along which they are pressed. So lines
/// of the old pleats do not stand beside the new ones.
pub fn redraw_pleats(garment: &Garment, pieces: &mut [Piece]) {
    let is_pleat = |d: &DartSpec| d.kind == Some(DartKind::Pleat);
    for old in copies::darts(&garment.plan).into_iter().filter(is_pleat) {
        let Some(new) = dart(garment, pieces, &old) else { continue };
        let Some(k) = garment.pieces.iter().position(|p| p.name.eq_ignore_ascii_case(&old.piece)) else { continue };
        let (Some(before), Some(after)) = (garment.pieces.get(k), pieces.get_mut(k)) else { continue };
        if let Some((k, is_turned)) = meant(before, &old)
            && let Some(drawn) = after.darts.get_mut(k)
        {
            let [a, b] = darts::pleat(&new).legs;
            drawn.legs = if is_turned { [b, a] } else { [a, b] };
        }
        let lines = |piece: &Piece, spec: &DartSpec| folds::drawn_for(&piece.outline.positions(), spec);
        for (from, to) in lines(before, &old).iter().zip(lines(after, &new)) {
            if let (Some(from), Some(to)) = (from, to)
                && let Some((line, is_turned)) = folds::find(before, from)
                && let Some(line) = after.internal_lines.get_mut(line)
            {
                folds::put(line, &to, is_turned);
            }
        }
    }
}

/// A fold where its line is drawn now, else where it went with the outline.
fn fold(garment: &Garment, pieces: &[Piece], spec: &FoldSpec) -> Option<FoldSpec> {
    let (before, after) = named(garment, pieces, &spec.piece)?;
    let drawn = folds::find(before, &spec.line).and_then(|(k, is_turned)| {
        let mut line = after.internal_lines.get(k)?.positions();
        if is_turned {
            line.reverse();
        }
        Some(line)
    });
    let line = drawn.unwrap_or_else(|| carried(garment, pieces, &spec.piece, &spec.line));
    Some(FoldSpec { line, source: None, ..spec.clone() })
}

/// A band along the edges where they are now.
fn elastic(garment: &Garment, pieces: &[Piece], spec: &ElasticSpec) -> ElasticSpec {
    let along = spec.along.iter().map(|run| match run {
        RunSpec::Edge { piece, edge } => RunSpec::Edge { piece: piece.clone(), edge: edge_name(garment, piece, edge) },
        RunSpec::Part { piece, edge, from, to } => {
            let edge = edge_name(garment, piece, edge);
            RunSpec::Part { piece: piece.clone(), edge, from: *from, to: *to }
        }
        RunSpec::Points { piece, from, to, way } => {
            let ends = carried(garment, pieces, piece, &[*from, *to]);
            RunSpec::Points { piece: piece.clone(), from: ends[0], to: ends[1], way: *way }
        }
        RunSpec::Line { piece, line } => {
            RunSpec::Line { piece: piece.clone(), line: carried(garment, pieces, piece, line) }
        }
    });
    ElasticSpec { along: along.collect(), source: None, ..spec.clone() }
}

/// The points of a line where they went with the outline of their piece.
fn carried(garment: &Garment, pieces: &[Piece], piece: &str, line: &[Vec2]) -> Vec<Vec2> {
    let Some((before, after)) = named(garment, pieces, piece) else { return line.to_vec() };
    let follow = Follow::new(before, &after.outline.positions());
    line.iter().map(|p| follow.carry(*p).0).collect()
}

/// Names of edges as runs between points, since numbers may change.
fn edge_names(garment: &Garment, pieces: &[Piece]) -> Vec<EdgeNameSpec> {
    let mut out: Vec<EdgeNameSpec> = Vec::new();
    let mut parts: Vec<EdgeNameSpec> = Vec::new();
    let mut add = |piece: &str, name: &str, from: Vec2, to: Vec2, way: RunWay| {
        let is_same = |e: &EdgeNameSpec| e.run.piece().eq_ignore_ascii_case(piece) && e.name.eq_ignore_ascii_case(name);
        if !out.iter().any(is_same) {
            let run = RunSpec::Points { piece: piece.to_owned(), from, to, way };
            out.push(EdgeNameSpec { run, name: name.to_owned(), source: None });
        }
    };
    for (before, after) in garment.pieces.iter().zip(pieces) {
        let attached = |label: &str| {
            let same = |a: &&AttachSpec| a.piece.eq_ignore_ascii_case(&before.name) && a.edge == label;
            let has = |run: &RunSpec| {
                let (RunSpec::Edge { piece, edge } | RunSpec::Part { piece, edge, .. }) = run else { return false };
                piece.eq_ignore_ascii_case(&before.name) && edge == label
            };
            garment.plan.attachments.iter().any(|a| same(&a))
                || garment.plan.elastics.iter().any(|e| e.along.iter().any(has))
                || garment.plan.edge_names.iter().any(|n| matches!(n.run, RunSpec::Part { .. }) && has(&n.run))
        };
        for edge in &before.edges {
            let number = edge.index.to_string();
            let name = match &edge.name {
                Some(name) => name.clone(),
                None if attached(&number) => by_number(&number),
                None => continue,
            };
            let at = |i: u32| after.outline.points.get(i as usize).map(|p| p.at);
            if let (Some(from), Some(to)) = (at(edge.from), at(edge.to)) {
                add(&before.name, &name, from, to, RunWay::Left);
            }
        }
    }
    for spec in &garment.plan.edge_names {
        if let RunSpec::Part { piece, edge, from, to } = &spec.run {
            let run =
                RunSpec::Part { piece: piece.clone(), edge: edge_name(garment, piece, edge), from: *from, to: *to };
            parts.push(EdgeNameSpec { run, name: spec.name.clone(), source: None });
        }
        if let RunSpec::Points { piece, from, to, way } = &spec.run
            && let Some((before, after)) = named(garment, pieces, piece)
        {
            let follow = Follow::new(before, &after.outline.positions());
            add(piece, &spec.name, follow.carry(*from).0, follow.carry(*to).0, *way);
        }
        if let RunSpec::Line { piece, line } = &spec.run {
            let run = RunSpec::Line { piece: piece.clone(), line: carried(garment, pieces, piece, line) };
            parts.push(EdgeNameSpec { run, name: spec.name.clone(), source: None });
        }
    }
    out.extend(parts);
    out
}

/// The name that an edge gets which was meant by its number.
fn by_number(number: &str) -> String {
    format!("edge-{number}")
}

fn attachment(spec: &AttachSpec, garment: &Garment) -> AttachSpec {
    AttachSpec { edge: edge_name(garment, &spec.piece, &spec.edge), source: None, ..spec.clone() }
}

/// The name of an edge that was meant by its name or its number.
fn edge_name(garment: &Garment, piece: &str, label: &str) -> String {
    let piece = garment.pieces.iter().find(|p| p.name.eq_ignore_ascii_case(piece));
    let edge = piece.and_then(|p| p.edges.iter().find(|e| e.index.to_string() == label));
    let name = edge.map(|e| e.name.clone().unwrap_or_else(|| by_number(label)));
    name.unwrap_or_else(|| label.to_owned())
}
