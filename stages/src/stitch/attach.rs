//! Edges tied to the body: a waist edge is laid on the ring a tape makes around the body there.

use super::{codes, part_of_ring};
use crate::body::{Section, hull, section_at};
use crate::codes::BODY_MISSING;
use crate::sewing::ring::SAME;
use crate::sewing::sewn_points::SewnPoints;
use crate::solve::layer_of;
use std::collections::BTreeMap;
use toile_formats::codes::EDGE_UNKNOWN;
use toile_garment::body::Body;
use toile_garment::dart::{DartKind, DartMesh};
use toile_garment::garment::{ElasticBand, Pin};
use toile_garment::mesh::PieceMesh;
use toile_garment::outline::OutlineEdge;
use toile_garment::sewing::{AttachSpec, AttachStrength, EdgeNameSpec, RunSpec};
use toile_garment::{Diagnostic, Garment, MeshVertex, Piece, PieceId, Vec2, Vec3};

/// Extra distance between held edges and the body, beyond the contact's own, metres.
const SLACK: f64 = 3e-4;

/// Landmarks nearer in height than this lie on one ring, m.
const SAME_HEIGHT: f64 = 1e-3;

/// A landmark this far beside a section is not on it, m.
const BESIDE: f64 = 0.02;

/// Largest gap of an open section, as a share of its girth.
const LARGEST_GAP: f64 = 0.1;

/// A tape around the body: a convex ring at one height.
struct Ring {
    points: Vec<Vec3>,
    arc: Vec<f64>,
}

/// A vertex laid on a ring, its arc position there, m, and how its edge is held.
struct Laid {
    pin: Pin,
    arc: f64,
    held: AttachStrength,
}

/// One piece's share of a ring.
struct Share {
    piece: usize,
    /// Vertices along the attached edges with their distance from the first, darts closed, metres.
    stations: Vec<(u32, f64)>,
    /// How the edge of each station is held.
    held: Vec<AttachStrength>,
    length: f64,
    /// Arc position of its middle on the ring at the start.
    middle: f64,
    /// Does it run against the ring?
    is_turned: bool,
}

/// The attachments at one height, in the order of the file.
struct Height<'g> {
    height: f64,
    section: Section,
    specs: Vec<&'g AttachSpec>,
}

/// Pins and bands that hold the attached edges.
#[derive(Debug, Default)]
pub struct Holds {
    /// Held for good.
    pub lasting: Vec<Pin>,
    /// Held until the garment is sewn.
    pub while_sewing: Vec<Pin>,
    /// Elastic bands that hold the edges then.
    pub bands: Vec<ElasticBand>,
}

impl Holds {
    fn extend(&mut self, more: Self) {
        self.lasting.extend(more.lasting);
        self.while_sewing.extend(more.while_sewing);
        self.bands.extend(more.bands);
    }
}

/// Pins and bands of the attached edges, `gap` metres off the body. Cloth is `thickness` metres thick.
///
/// # Errors
/// All attachments that cannot be made, each with the reason.
pub fn holds(garment: &Garment, placed: &[Vec<Vec3>], gap: f64, thickness: f64) -> Result<Holds, Vec<Diagnostic>> {
    let (heights, mut errors) = heights(garment);
    let mut holds = Holds::default();
    for height in &heights {
        match ring_holds(garment, placed, [gap, thickness], height) {
            Ok(more) => holds.extend(more),
            Err(finding) => errors.push(finding.at(height.specs[0].source.clone())),
        }
    }
    if errors.is_empty() { Ok(holds) } else { Err(errors) }
}

/// All attachments by their heights, and what is wrong with those that the body has no ring for.
fn heights(garment: &Garment) -> (Vec<Height<'_>>, Vec<Diagnostic>) {
    let (mut heights, mut errors): (Vec<Height<'_>>, Vec<Diagnostic>) = (Vec::new(), Vec::new());
    let specs = &garment.plan.attachments;
    for (k, spec) in specs.iter().enumerate() {
        match section(garment, &spec.to) {
            Ok((height, section)) => match heights.iter_mut().find(|h| (h.height - height).abs() < SAME_HEIGHT) {
                Some(known) => known.specs.push(spec),
                None => heights.push(Height { height, section, specs: vec![spec] }),
            },
            Err(found) if specs[..k].iter().all(|b| b.to != spec.to) => errors.push(found.at(spec.source.clone())),
            Err(_) => {}
        }
    }
    (heights, errors)
}

/// Attachments that cannot be made, whatever the mesh: on this body, or of these edges.
pub fn faults(garment: &Garment) -> Vec<Diagnostic> {
    let specs = &garment.plan.attachments;
    let (heights, mut found) = heights(garment);
    let mut known: Vec<(PieceId, usize, &AttachSpec)> = Vec::new();
    for spec in specs {
        let Some(piece) = garment.pieces.iter().find(|p| spec.piece.eq_ignore_ascii_case(&p.name)) else { continue };
        match edges_of_spec(garment, piece, spec) {
            Ok(edges) => {
                let first = known.iter().find(|(id, edge, _)| *id == piece.id && edges.contains(edge));
                found.extend(first.map(|(_, _, first)| attached_twice(piece, spec, first)));
                known.extend(edges.into_iter().map(|edge| (piece.id, edge, spec)));
            }
            // An edge that is not there is told where the sewing file is read.
            Err(fault) if fault.code == EDGE_UNKNOWN => {}
            Err(fault) => found.push(fault.at(spec.source.clone())),
        }
    }
    if found.is_empty() {
        found.extend(heights.iter().filter_map(|h| part_of_ring(garment, h)));
    }
    found
}

fn attached_twice(piece: &Piece, spec: &AttachSpec, first: &AttachSpec) -> Diagnostic {
    let line = first.source.as_ref().and_then(|s| s.line).map_or_else(String::new, |line| format!(" in line {line}"));
    let message = format!(
        "edge `{}` of `{}` is attached to `{}`, and{line} to `{}` already: it can be held once",
        spec.edge, piece.name, spec.to, first.to
    );
    Diagnostic::error(codes::ATTACHED_TWICE, message)
        .at(spec.source.clone())
        .hint("remove one of both [[attach]] tables")
}

/// The error on edges that go only part of the way round at one height.
fn part_of_ring(garment: &Garment, height: &Height<'_>) -> Option<Diagnostic> {
    let attached = |piece: &Piece| edges_of(garment, piece, &height.specs).unwrap_or_default();
    let edges = garment.pieces.iter().flat_map(|p| attached(p).into_iter().map(|(edge, _)| (p.id, edge))).collect();
    let first = height.specs.first()?;
    Some(part_of_ring::fault(garment, edges, &first.to)?.at(first.source.clone()))
}

/// Holds at one landmark. Each layer of the garment has a ring of its own, outside that of the layer below.
fn ring_holds(
    garment: &Garment,
    placed: &[Vec<Vec3>],
    [gap, thickness]: [f64; 2],
    Height { section, specs, .. }: &Height<'_>,
) -> Result<Holds, Diagnostic> {
    let mut layers: BTreeMap<i32, Vec<(&Piece, Vec<HeldEdge>)>> = BTreeMap::new();
    for piece in &garment.pieces {
        let edges = edges_of(garment, piece, specs)?;
        if !edges.is_empty() {
            layers.entry(layer_of(garment, piece)).or_default().push((piece, edges));
        }
    }
    let mut holds = Holds::default();
    let mut gap = gap;
    for pieces in layers.values() {
        let ring = Ring::around(section, gap);
        let mut pleated = false;
        let shares: Vec<Share> = pieces
            .iter()
            .map(|(piece, edges)| {
                let intake = pleat_intakes(piece);
                pleated |= edges.iter().flat_map(|e| edge_vertices(piece, e.0)).any(|v| intake.contains(&v));
                share(piece, &placed[piece.id.index()], edges, &intake, &ring)
            })
            .collect();
        // Under a pleat lie two more layers. Straight mesh edges cut the corner of the ring: it moves out until their
        // middles keep the gap as well.
        let under = if pleated { 2.0 * thickness } else { 0.0 };
        let out = gap + under + lay(&shares, &ring).1 + SLACK;
        let laid = lay(&shares, &Ring::around(section, out)).0;
        let to = specs.first().map_or("", |s| s.to.as_str());
        holds.extend(holds_of(garment, to, &laid, section.girth()));
        gap = out + thickness;
    }
    Ok(holds)
}

/// A band that grows along the ring.
struct Growing {
    band: ElasticBand,
    held: AttachStrength,
    /// Arc position of its last vertex.
    before: f64,
}

/// Pins and bands of laid stations, which stand in order around the ring.
fn holds_of(garment: &Garment, to: &str, laid: &[Laid], girth: f64) -> Holds {
    let mut holds = Holds::default();
    let mut points = SewnPoints::new(garment, &garment.seams);
    let arcs = || laid.iter().map(|l| l.arc);
    let around = arcs().fold(f64::NEG_INFINITY, f64::max) - arcs().fold(f64::INFINITY, f64::min);
    let mut growing: Option<Growing> = None;
    for l in laid {
        if growing.as_ref().is_some_and(|g| g.held != l.held) {
            holds.bands.extend(growing.take().map(|g| g.band).filter(|b| b.vertices.len() > 1));
        }
        let AttachStrength::Elastic(share) = l.held else {
            let list = if l.held == AttachStrength::Hold { &mut holds.lasting } else { &mut holds.while_sewing };
            list.push(l.pin);
            continue;
        };
        holds.while_sewing.push(l.pin);
        // The ring lies a little off the body; the file speaks of the body.
        let scale = share * girth / around.max(1e-9);
        let start = || Growing { band: ElasticBand::named(to), held: l.held, before: l.arc };
        let Growing { band, before, .. } = growing.get_or_insert_with(start);
        if band.vertices.last().is_some_and(|last| points.are_one(*last, l.pin.vertex)) {
            continue;
        }
        if !band.vertices.is_empty() {
            band.rest.push(((l.arc - *before) * scale).max(SLACK));
        }
        band.vertices.push(l.pin.vertex);
        *before = l.arc;
    }
    if let Some(Growing { mut band, .. }) = growing {
        if laid.iter().all(|l| laid[0].held == l.held) {
            close(&mut band, &mut points);
        }
        holds.bands.push(band);
    }
    for pins in [&mut holds.lasting, &mut holds.while_sewing] {
        pins.sort_by_key(|p| p.vertex);
        pins.dedup_by_key(|p| p.vertex);
    }
    // Where edges meet, what is held for good stays held.
    let lasting = &holds.lasting;
    holds.while_sewing.retain(|p| lasting.binary_search_by_key(&p.vertex, |l| l.vertex).is_err());
    holds
}

/// Joins the ends of a band that goes all the way round.
fn close(band: &mut ElasticBand, points: &mut SewnPoints) {
    let ends = [band.vertices.first().copied(), band.vertices.last().copied()];
    let [Some(first), Some(last)] = ends else { return };
    if points.are_one(first, last) {
        band.vertices.pop();
    } else {
        band.rest.push(SLACK);
    }
}

/// Vertices of the outline between the mouth points of pleats, which are folded away.
fn pleat_intakes(piece: &Piece) -> Vec<u32> {
    let Some(chain) = piece.mesh.as_ref().and_then(PieceMesh::outline) else { return Vec::new() };
    let n = chain.vertices.len();
    let at = |v: u32| chain.vertices.iter().position(|c| *c == v);
    let pleats = piece.darts.iter().filter(|d| d.kind == DartKind::Pleat).filter_map(|d| d.mesh.as_ref());
    let between = |m: &DartMesh| {
        let (i, k) = (at(*m.legs[0].first()?)?, at(*m.legs[1].first()?)?);
        let (ahead, back) = ((k + n - i) % n, (i + n - k) % n);
        let (from, steps) = if ahead <= back { (i, ahead) } else { (k, back) };
        Some((1..steps).map(move |s| chain.vertices[(from + s) % n]))
    };
    pleats.filter_map(between).flatten().collect()
}

/// Height and level section of the body at a landmark or height. An open mesh may have a gap there, but no more than a
/// share of it.
fn section(garment: &Garment, to: &str) -> Result<(f64, Section), Diagnostic> {
    let body = garment.body.as_ref().ok_or_else(|| {
        Diagnostic::error(BODY_MISSING, format!("an edge is attached to `{to}`, but there is no body"))
            .hint("give the stage `stitch` a body: with.body = \"…obj\"")
    })?;
    let known = || {
        let of_trunk =
            body.landmarks.iter().filter(|(_, p)| section_at(body, p.y).is_none_or(|s| is_round(&s, Some(**p))));
        match of_trunk.map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ") {
            names if names.is_empty() => "no side file tells its landmarks; `toile body measure` writes one".to_owned(),
            names => format!("this body has the landmarks {names}"),
        }
    };
    let landmark = body.landmarks.get(to).or_else(|| body.landmarks.get(&format!("{to}-front"))).copied();
    let height =
        landmark.map(|p| p.y).or_else(|| body.measures.get(&format!("{to}_height")).copied()).ok_or_else(|| {
            Diagnostic::error(codes::ATTACH_TARGET_UNKNOWN, format!("the body has no landmark or height `{to}`"))
                .hint(known())
        })?;
    let sound = |s: &Section| s.girth() > 0.0 && s.gap() <= LARGEST_GAP * s.girth();
    let found = section_at(body, height).filter(sound).ok_or_else(|| {
        let (low, high) = extent(body);
        let message = format!(
            "the body goes not all the way round at `{to}`, {:.0} mm: its mesh ends or is torn there",
            height * 1e3
        );
        let hint = format!(
            "the mesh reaches from {:.0} to {:.0} mm; give a whole body, or set `{to}` in its side file",
            low * 1e3 + 0.0,
            high * 1e3
        );
        Diagnostic::error(codes::ATTACH_TARGET_EMPTY, message).hint(hint)
    })?;
    if is_round(&found, landmark) {
        return Ok((height, found));
    }
    let message =
        format!("an edge is attached to `{to}`, which lies on an arm or a leg, at a height of {:.0} mm", height * 1e3);
    let remedy =
        "edges are held around the trunk or the neck: give a sleeve or a leg an [[elastic]] along its edge instead";
    Err(Diagnostic::error(codes::ATTACH_TO_LIMB, message).hint(format!("{remedy}; {}", known())))
}

/// Does a level section go round the trunk or the neck, and does a landmark lie on it? Beside the middle lies a limb.
fn is_round(section: &Section, landmark: Option<Vec3>) -> bool {
    let (low, high) = section.bounds();
    let (middle, half) = (0.5 * (low.x + high.x), 0.5 * (high.x - low.x));
    middle.abs() < 0.5 * half && landmark.is_none_or(|p| (p.x - middle).abs() < half + BESIDE)
}

/// Lowest and highest point of the triangles, metres.
fn extent(body: &Body) -> (f64, f64) {
    let heights = body.triangles.iter().flatten().filter_map(|v| Some(body.positions.get(*v as usize)?.y));
    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)))
}

impl Ring {
    /// The convex outline of a level section, moved outwards by `gap`; starts at the front, runs to the wearer's left.
    fn around(section: &Section, gap: f64) -> Self {
        let height = section.points.first().map_or(0.0, |p| p.y);
        // In the plane (z, x) a counter-clockwise hull runs from the front to the wearer's left.
        let hull = hull(section.points.iter().map(|p| Vec2::new(p.z, p.x)).collect());
        let n = hull.len();
        let outwards = |a: Vec2, b: Vec2| Vec2::new(b.y - a.y, a.x - b.x).normalize();
        let mut points = Vec::with_capacity(n);
        for i in 0..n {
            let (a, b, c) = (hull[(i + n - 1) % n], hull[i], hull[(i + 1) % n]);
            let (u, v) = (outwards(a, b), outwards(b, c));
            let mitre = (u + v) / (1.0 + u.dot(&v)).max(0.2);
            let p = b + mitre * gap;
            points.push(Vec3::new(p.y, height, p.x));
        }
        let front = (0..n).min_by(|a, b| bearing(points[*a]).abs().total_cmp(&bearing(points[*b]).abs())).unwrap_or(0);
        points.rotate_left(front);
        let mut arc = vec![0.0];
        for i in 0..n {
            arc.push(arc[i] + (points[(i + 1) % n] - points[i]).norm());
        }
        Self { points, arc }
    }

    fn girth(&self) -> f64 {
        self.arc[self.points.len()]
    }

    fn at(&self, arc: f64) -> Vec3 {
        let rest = arc.rem_euclid(self.girth());
        let n = self.points.len();
        let i = self.arc.partition_point(|a| *a <= rest).clamp(1, n) - 1;
        let share = (rest - self.arc[i]) / (self.arc[i + 1] - self.arc[i]);
        self.points[i] * (1.0 - share) + self.points[(i + 1) % n] * share
    }

    /// Arc position of the ring's point that lies in the same direction from the middle.
    fn arc_towards(&self, p: Vec3) -> f64 {
        let want = bearing(p);
        let near = |q: &Vec3| {
            let d = (bearing(*q) - want).rem_euclid(std::f64::consts::TAU);
            d.min(std::f64::consts::TAU - d)
        };
        let best = (0..self.points.len()).min_by(|a, b| near(&self.points[*a]).total_cmp(&near(&self.points[*b])));
        best.map_or(0.0, |i| self.arc[i])
    }
}

/// Direction from the body's axis: 0 at the front, growing to the wearer's left.
fn bearing(p: Vec3) -> f64 {
    libm::atan2(p.x, p.z)
}

/// An outline edge by its number, and how it is held.
type HeldEdge = (usize, AttachStrength);

/// Outline edges of a piece that are attached, in outline order.
fn edges_of(garment: &Garment, piece: &Piece, specs: &[&AttachSpec]) -> Result<Vec<HeldEdge>, Diagnostic> {
    let mut edges = Vec::new();
    for spec in specs.iter().filter(|s| s.piece.eq_ignore_ascii_case(&piece.name)) {
        edges.extend(edges_of_spec(garment, piece, spec)?.into_iter().map(|edge| (edge, spec.strength)));
    }
    edges.sort_by_key(|(edge, _)| *edge);
    edges.dedup_by_key(|(edge, _)| *edge);
    Ok(edges)
}

/// Outline edges that one attachment names, as a seam would find them: by name, else by number. A leg of a dart cannot be
/// held, because it is sewn to the other leg.
fn edges_of_spec(garment: &Garment, piece: &Piece, spec: &AttachSpec) -> Result<Vec<usize>, Diagnostic> {
    let of = |is_it: &dyn Fn(&OutlineEdge) -> bool| piece.edges.iter().filter(|e| is_it(e)).collect::<Vec<_>>();
    let mut named = of(&|e| e.name.as_deref() == Some(spec.edge.as_str()));
    if named.is_empty() {
        named = of(&|e| e.name.as_ref().is_some_and(|n| n.eq_ignore_ascii_case(&spec.edge)));
    }
    if named.is_empty()
        && let Some(fault) = no_edge(garment, piece, spec)
    {
        return Err(fault);
    }
    if named.is_empty() {
        named = of(&|e| e.index.to_string() == spec.edge);
    }
    if named.is_empty() {
        let message = format!("piece `{}` has no edge `{}` to attach", piece.name, spec.edge);
        let hint = "`toile inspect --svg` draws the numbers of all edges";
        return Err(Diagnostic::error(EDGE_UNKNOWN, message).hint(hint));
    }
    if let Some(dart) = named.iter().find_map(|e| dart_of_leg(piece, e)) {
        let message =
            format!("edge `{}` of `{}` is a leg of the dart `{dart}`, which is sewn shut", spec.edge, piece.name);
        let hint = "attach the edges beside the dart's mouth";
        return Err(Diagnostic::error(codes::ATTACH_DART_LEG, message).hint(hint));
    }
    Ok(named.iter().map(|e| e.index as usize).collect())
}

/// The error on a name of the sewing file that is no edge: a part of one, or a line inside the piece.
fn no_edge(garment: &Garment, piece: &Piece, spec: &AttachSpec) -> Option<Diagnostic> {
    let named =
        |n: &&EdgeNameSpec| n.run.piece().eq_ignore_ascii_case(&piece.name) && n.name.eq_ignore_ascii_case(&spec.edge);
    let name = garment.plan.edge_names.iter().filter(named).find(|n| !matches!(n.run, RunSpec::Edge { .. }))?;
    let what = if matches!(name.run, RunSpec::Line { .. }) { "a line inside" } else { "a part of an edge of" };
    let message = format!("`{}` is {what} `{}`, and whole edges alone can be held on the body", spec.edge, piece.name);
    let hint = "attach the whole edge, by its name or number; `toile inspect --svg` draws the numbers";
    Some(Diagnostic::error(codes::ATTACH_NO_EDGE, message).hint(hint))
}

/// The dart whose point an edge ends in.
fn dart_of_leg<'a>(piece: &'a Piece, edge: &OutlineEdge) -> Option<&'a str> {
    let ends = [edge.from, edge.to].map(|v| piece.outline.points.get(v as usize).map(|p| p.at));
    let at_end = |apex: &Vec2| ends.iter().flatten().any(|end| (apex - end).norm() < SAME);
    let mut wedges = piece.darts.iter().filter(|d| d.kind == DartKind::Wedge);
    wedges.find(|d| d.apexes.iter().any(at_end)).map(|d| d.name.as_str())
}

/// Vertices along the attached edges. Where the next attached edge starts at another vertex (a dart lies between),
/// the distance goes on from the same value: the dart is closed when sewn. So is the intake of a pleat, which hangs free.
fn share(piece: &Piece, placed: &[Vec3], edges: &[HeldEdge], intake: &[u32], ring: &Ring) -> Share {
    let (mut stations, mut held): (Vec<(u32, f64)>, Vec<AttachStrength>) = (Vec::new(), Vec::new());
    let mut length = 0.0;
    for (e, strength) in in_outline_order(piece, edges) {
        let chain = edge_vertices(piece, e);
        let rest = piece.mesh.as_ref().map_or(&[][..], |m| &m.rest);
        for (k, v) in chain.iter().enumerate() {
            if intake.contains(v) {
                continue;
            }
            if k > 0 && !intake.contains(&chain[k - 1]) {
                length += (rest[*v as usize] - rest[chain[k - 1] as usize]).norm();
            }
            stations.push((*v, length));
            held.push(strength);
        }
    }
    let turn = turn(&stations, placed);
    if turn < 0.0 {
        // The ring runs to the wearer's left; a top edge walked counter-clockwise runs to the right.
        stations.iter_mut().for_each(|(_, along)| *along = length - *along);
    }
    // The mean of an edge that goes more than half round lies near the axis, and tells no direction.
    let is_half_round = turn.abs() > std::f64::consts::PI;
    let shown = if is_half_round { &stations[stations.len() / 2..=stations.len() / 2] } else { &stations[..] };
    let sum: Vec3 = shown.iter().map(|(v, _)| placed[*v as usize]).sum();
    let middle = ring.arc_towards(sum / (shown.len().max(1) as f64));
    Share { piece: piece.id.index(), stations, held, length, middle, is_turned: turn < 0.0 }
}

/// The turn about the body's axis along stations, rad, to the wearer's left. An edge of a whole ring turns by a full circle.
fn turn(stations: &[(u32, f64)], placed: &[Vec3]) -> f64 {
    let at = |s: &(u32, f64)| bearing(placed[s.0 as usize]);
    let wrapped = |x: f64| (x + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    stations.windows(2).map(|w| wrapped(at(&w[1]) - at(&w[0]))).sum()
}

/// Attached edges from the first after a gap, so that a run over the outline's start stays together.
fn in_outline_order(piece: &Piece, edges: &[HeldEdge]) -> Vec<HeldEdge> {
    let n = piece.edges.len();
    let held = |e: usize| edges.iter().any(|(edge, _)| *edge == e % n);
    // Two attached edges with only dart legs between them belong together: the longest pause is the real one.
    let mut best = (0, edges[0].0);
    for (e, _) in edges {
        let pause = (1..=n).take_while(|k| !held(e + n - k)).count();
        if pause > best.0 {
            best = (pause, *e);
        }
    }
    (0..n).filter_map(|k| edges.iter().find(|(e, _)| *e == (best.1 + k) % n)).copied().collect()
}

/// Mesh vertices along an outline edge, counter-clockwise.
fn edge_vertices(piece: &Piece, edge: usize) -> Vec<u32> {
    let Some(mesh) = &piece.mesh else { return Vec::new() };
    let Some(chain) = mesh.outline() else { return Vec::new() };
    let end = |i: u32| mesh.outline_vertex.get(i as usize).copied().flatten();
    let (Some(from), Some(to)) = (end(piece.edges[edge].from), end(piece.edges[edge].to)) else { return Vec::new() };
    let n = chain.vertices.len();
    let Some(start) = chain.vertices.iter().position(|v| *v == from) else { return Vec::new() };
    let mut out = vec![from];
    for k in 1..=n {
        let v = chain.vertices[(start + k) % n];
        out.push(v);
        if v == to {
            break;
        }
    }
    out
}

/// Lays the shares side by side around the ring, turned so that their middles move least. Also tells how far the
/// straight line between neighbouring pins lies inside the ring at most, metres.
fn lay(shares: &[Share], ring: &Ring) -> (Vec<Laid>, f64) {
    let mut shares: Vec<&Share> = shares.iter().collect();
    shares.sort_by(|a, b| a.middle.total_cmp(&b.middle));
    let girth = ring.girth();
    let total: f64 = shares.iter().map(|s| s.length).sum();
    let scale = girth / total.max(1e-9);
    let mut start = 0.0;
    let mut starts = Vec::new();
    let mut offset = 0.0;
    for s in &shares {
        starts.push(start);
        let away = s.middle - (start + 0.5 * s.length * scale);
        let first = shares[0].middle - 0.5 * shares[0].length * scale;
        offset += first + (away - first + 0.5 * girth).rem_euclid(girth) - 0.5 * girth;
        start += s.length * scale;
    }
    offset /= shares.len().max(1) as f64;
    let mut laid: Vec<Laid> = Vec::new();
    let mut cut = 0.0_f64;
    for (s, from) in shares.iter().zip(&starts) {
        let arc = |along: f64| from + along * scale + offset;
        let first = laid.len();
        for ((v, along), held) in s.stations.iter().zip(&s.held) {
            let vertex = MeshVertex { piece: PieceId::from(s.piece), vertex: *v };
            laid.push(Laid { pin: Pin { vertex, at: ring.at(arc(*along)) }, arc: arc(*along), held: *held });
        }
        // A corner belongs to both edges that meet there; each of both is to stand beside its own edge.
        if s.is_turned {
            laid[first..].reverse();
        }
        for w in s.stations.windows(2) {
            let (a, b) = (arc(w[0].1), arc(w[1].1));
            let chord = (ring.at(a) + ring.at(b)) * 0.5;
            cut = cut.max((ring.at(0.5 * (a + b)) - chord).norm());
        }
    }
    laid.sort_by(|a, b| a.arc.total_cmp(&b.arc).then(a.pin.vertex.cmp(&b.pin.vertex)));
    (laid, cut)
}

#[cfg(test)]
mod tests;
