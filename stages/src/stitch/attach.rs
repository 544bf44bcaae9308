//! Edges tied to the body: a waist edge is laid on the ring a tape makes around the body there.

use super::{codes, layer_of};
use crate::body::{Section, hull, section_at};
use crate::codes::BODY_MISSING;
use crate::sewing::ring::SAME;
use crate::sewing::sewn_points::SewnPoints;
use toile_formats::codes::EDGE_UNKNOWN;
use toile_garment::body::Body;
use toile_garment::dart::{DartKind, DartMesh};
use toile_garment::garment::{ElasticBand, Pin};
use toile_garment::mesh::PieceMesh;
use toile_garment::outline::OutlineEdge;
use toile_garment::sewing::{AttachSpec, AttachStrength};
use toile_garment::{Diagnostic, Garment, MeshVertex, Piece, PieceId, Vec2, Vec3};

/// Extra distance between held edges and the body, beyond the contact's own, metres.
const SLACK: f64 = 3e-4;

/// Largest gap of an open section, as a share of its girth.
const LARGEST_GAP: f64 = 0.1;

/// A tape around the body: a convex ring at one height.
struct Ring {
    points: Vec<Vec3>,
    arc: Vec<f64>,
}

/// A vertex laid on a ring, and its arc position there, m.
struct Laid {
    pin: Pin,
    arc: f64,
}

/// One piece's share of a ring.
struct Share {
    piece: usize,
    /// Vertices along the attached edges with their distance from the first, darts closed, metres.
    stations: Vec<(u32, f64)>,
    length: f64,
    /// Arc position of its middle on the ring at the start.
    middle: f64,
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
    let mut errors = Vec::new();
    let mut targets: Vec<&str> = Vec::new();
    for spec in &garment.plan.attachments {
        if !targets.contains(&spec.to.as_str()) {
            targets.push(&spec.to);
        }
    }
    let mut holds = Holds::default();
    for to in targets {
        let specs: Vec<&AttachSpec> = garment.plan.attachments.iter().filter(|a| a.to == to).collect();
        match ring_holds(garment, placed, [gap, thickness], to, &specs) {
            Ok(more) => holds.extend(more),
            Err(finding) => errors.push(finding.at(specs[0].source.clone())),
        }
    }
    if errors.is_empty() { Ok(holds) } else { Err(errors) }
}

/// Attachments that cannot be made, whatever the mesh: on this body, or of these edges.
pub fn faults(garment: &Garment) -> Vec<Diagnostic> {
    let specs = &garment.plan.attachments;
    let first = specs.iter().enumerate().filter(|(k, a)| specs[..*k].iter().all(|b| b.to != a.to));
    let of_body = first.filter_map(|(_, a)| Some(section(garment, &a.to).err()?.at(a.source.clone())));
    let of_edges = specs.iter().filter_map(|spec| {
        let piece = garment.pieces.iter().find(|p| spec.piece.eq_ignore_ascii_case(&p.name))?;
        // An edge that is not there is told where the sewing file is read.
        let fault = edges_of_spec(piece, spec).err().filter(|f| f.code != EDGE_UNKNOWN)?;
        Some(fault.at(spec.source.clone()))
    });
    of_body.chain(of_edges).collect()
}

/// Holds at one landmark. Each layer of the garment has a ring of its own, outside that of the layer below.
fn ring_holds(
    garment: &Garment,
    placed: &[Vec<Vec3>],
    [gap, thickness]: [f64; 2],
    to: &str,
    specs: &[&AttachSpec],
) -> Result<Holds, Diagnostic> {
    let section = section(garment, to)?;
    let mut layers: std::collections::BTreeMap<i32, Vec<(&Piece, Vec<usize>)>> = std::collections::BTreeMap::new();
    for piece in &garment.pieces {
        let edges = edges_of(piece, specs)?;
        if !edges.is_empty() {
            layers.entry(layer_of(garment, piece)).or_default().push((piece, edges));
        }
    }
    let mut holds = Holds::default();
    let mut gap = gap;
    for pieces in layers.values() {
        let ring = Ring::around(&section, gap);
        let mut pleated = false;
        let shares: Vec<Share> = pieces
            .iter()
            .map(|(piece, edges)| {
                let intake = pleat_intakes(piece);
                pleated |= edges.iter().flat_map(|e| edge_vertices(piece, *e)).any(|v| intake.contains(&v));
                share(piece, &placed[piece.id.index()], edges, &intake, &ring)
            })
            .collect();
        // Under a pleat lie two more layers. Straight mesh edges cut the corner of the ring: it moves out until their
        // middles keep the gap as well.
        let under = if pleated { 2.0 * thickness } else { 0.0 };
        let out = gap + under + lay(&shares, &ring).1 + SLACK;
        let laid = lay(&shares, &Ring::around(&section, out)).0;
        holds.extend(holds_of(garment, specs, to, laid, section.girth()));
        gap = out + thickness;
    }
    Ok(holds)
}

/// How the attachments of a piece hold it; the first that names it tells.
fn strength(garment: &Garment, specs: &[&AttachSpec], piece: PieceId) -> AttachStrength {
    let name = &garment.pieces[piece.index()].name;
    specs.iter().find(|s| s.piece.eq_ignore_ascii_case(name)).map_or(AttachStrength::Hold, |s| s.strength)
}

/// Pins and bands of laid stations, which stand in order around the ring.
fn holds_of(garment: &Garment, specs: &[&AttachSpec], to: &str, laid: Vec<Laid>, girth: f64) -> Holds {
    let mut holds = Holds::default();
    let mut points = SewnPoints::new(garment, &garment.seams);
    let whole = laid.iter().all(|l| matches!(strength(garment, specs, l.pin.vertex.piece), AttachStrength::Elastic(_)));
    let around = laid.iter().map(|l| l.arc).fold(f64::NEG_INFINITY, f64::max)
        - laid.iter().map(|l| l.arc).fold(f64::INFINITY, f64::min);
    let mut band: Option<(ElasticBand, f64)> = None;
    for l in &laid {
        let held = strength(garment, specs, l.pin.vertex.piece);
        let AttachStrength::Elastic(share) = held else {
            holds.bands.extend(band.take().map(|b| b.0).filter(|b| b.vertices.len() > 1));
            let list = if held == AttachStrength::Hold { &mut holds.lasting } else { &mut holds.while_sewing };
            list.push(l.pin);
            continue;
        };
        holds.while_sewing.push(l.pin);
        // The ring lies a little off the body; the file speaks of the body.
        let scale = share * girth / around.max(1e-9);
        let (band, before) = band.get_or_insert_with(|| (ElasticBand::named(to), l.arc));
        if band.vertices.last().is_some_and(|last| points.are_one(*last, l.pin.vertex)) {
            continue;
        }
        if !band.vertices.is_empty() {
            band.rest.push(((l.arc - *before) * scale).max(SLACK));
        }
        band.vertices.push(l.pin.vertex);
        *before = l.arc;
    }
    if let Some((mut band, _)) = band {
        let ends = [band.vertices.first().copied(), band.vertices.last().copied()];
        if let ([Some(first), Some(last)], true) = (ends, whole) {
            if points.are_one(first, last) {
                band.vertices.pop();
            } else {
                band.rest.push(SLACK);
            }
        }
        holds.bands.push(band);
    }
    for pins in [&mut holds.lasting, &mut holds.while_sewing] {
        pins.sort_by_key(|p| p.vertex);
        pins.dedup_by_key(|p| p.vertex);
    }
    holds
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

/// The body's level section at a landmark or height. An open mesh may have a gap there, but no more than a share of it.
fn section(garment: &Garment, to: &str) -> Result<Section, Diagnostic> {
    let body = garment.body.as_ref().ok_or_else(|| {
        Diagnostic::error(BODY_MISSING, format!("an edge is attached to `{to}`, but there is no body"))
            .hint("give the stage `stitch` a body: with.body = \"…obj\"")
    })?;
    let known = || match body.landmarks.keys().map(String::as_str).collect::<Vec<_>>().join(", ") {
        names if names.is_empty() => "no side file tells its landmarks; `toile body measure` writes one".to_owned(),
        names => format!("this body has the landmarks {names}"),
    };
    let height = body
        .landmarks
        .get(to)
        .or_else(|| body.landmarks.get(&format!("{to}-front")))
        .map(|p| p.y)
        .or_else(|| body.measures.get(&format!("{to}_height")).copied())
        .ok_or_else(|| {
            Diagnostic::error(codes::ATTACH_TARGET_UNKNOWN, format!("the body has no landmark or height `{to}`"))
                .hint(known())
        })?;
    let sound = |s: &Section| s.girth() > 0.0 && s.gap() <= LARGEST_GAP * s.girth();
    section_at(body, height).filter(sound).ok_or_else(|| {
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
    })
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

/// Outline edges of a piece that are attached, by name or number, in outline order.
fn edges_of(piece: &Piece, specs: &[&AttachSpec]) -> Result<Vec<usize>, Diagnostic> {
    let mut edges = Vec::new();
    for spec in specs.iter().filter(|s| s.piece.eq_ignore_ascii_case(&piece.name)) {
        edges.extend(edges_of_spec(piece, spec)?);
    }
    edges.sort_unstable();
    edges.dedup();
    Ok(edges)
}

/// Outline edges that one attachment names. A leg of a dart cannot be held, because it is sewn to the other leg.
fn edges_of_spec(piece: &Piece, spec: &AttachSpec) -> Result<Vec<usize>, Diagnostic> {
    let is_named = |e: &&OutlineEdge| e.name.as_deref() == Some(spec.edge.as_str()) || e.index.to_string() == spec.edge;
    let named: Vec<&OutlineEdge> = piece.edges.iter().filter(is_named).collect();
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

/// The dart whose point an edge ends in.
fn dart_of_leg<'a>(piece: &'a Piece, edge: &OutlineEdge) -> Option<&'a str> {
    let ends = [edge.from, edge.to].map(|v| piece.outline.points.get(v as usize).map(|p| p.at));
    let at_end = |apex: &Vec2| ends.iter().flatten().any(|end| (apex - end).norm() < SAME);
    let mut wedges = piece.darts.iter().filter(|d| d.kind == DartKind::Wedge);
    wedges.find(|d| d.apexes.iter().any(at_end)).map(|d| d.name.as_str())
}

/// Vertices along the attached edges. Where the next attached edge starts at another vertex (a dart lies between),
/// the distance goes on from the same value: the dart is closed when sewn. So is the intake of a pleat, which hangs free.
fn share(piece: &Piece, placed: &[Vec3], edges: &[usize], intake: &[u32], ring: &Ring) -> Share {
    let mut stations: Vec<(u32, f64)> = Vec::new();
    let mut length = 0.0;
    for e in in_outline_order(piece, edges) {
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
    Share { piece: piece.id.index(), stations, length, middle }
}

/// The turn about the body's axis along stations, rad, to the wearer's left. An edge of a whole ring turns by a full circle.
fn turn(stations: &[(u32, f64)], placed: &[Vec3]) -> f64 {
    let at = |s: &(u32, f64)| bearing(placed[s.0 as usize]);
    let wrapped = |x: f64| (x + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    stations.windows(2).map(|w| wrapped(at(&w[1]) - at(&w[0]))).sum()
}

/// Attached edges from the first after a gap, so that a run over the outline's start stays together.
fn in_outline_order(piece: &Piece, edges: &[usize]) -> Vec<usize> {
    let n = piece.edges.len();
    let held = |e: usize| edges.contains(&(e % n));
    // Two attached edges with only dart legs between them belong together: the longest pause is the real one.
    let mut best = (0, edges[0]);
    for e in edges {
        let pause = (1..=n).take_while(|k| !held(e + n - k)).count();
        if pause > best.0 {
            best = (pause, *e);
        }
    }
    (0..n).map(|k| (best.1 + k) % n).filter(|e| edges.contains(e)).collect()
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
        for (v, along) in &s.stations {
            let vertex = MeshVertex { piece: PieceId::from(s.piece), vertex: *v };
            laid.push(Laid { pin: Pin { vertex, at: ring.at(arc(*along)) }, arc: arc(*along) });
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
mod tests {
    use super::*;

    /// Places on a circle of 0.14 m, at bearings in degrees.
    fn around(bearings: impl Iterator<Item = i32>) -> (Vec<(u32, f64)>, Vec<Vec3>) {
        let place = |b: i32| {
            let (sin, cos) = libm::sincos(f64::from(b).to_radians());
            Vec3::new(0.14 * sin, 1.05, 0.14 * cos)
        };
        let placed: Vec<Vec3> = bearings.map(place).collect();
        ((0..placed.len() as u32).map(|v| (v, f64::from(v))).collect(), placed)
    }

    #[test]
    fn an_edge_round_the_whole_body_turns_as_it_is_walked() {
        // A waistband whose ends lie 20 degrees apart at the back, walked to the right and to the left.
        let (stations, placed) = around((-17..=17).map(|k| -10 * k));
        assert!((turn(&stations, &placed).to_degrees() + 340.0).abs() < 1e-9);
        let (stations, placed) = around((-17..=17).map(|k| 10 * k));
        assert!((turn(&stations, &placed).to_degrees() - 340.0).abs() < 1e-9);
        // The upper edge of a back, over the bearing where the angle jumps.
        let (stations, placed) = around((0..=12).map(|k| 240 - 10 * k));
        assert!((turn(&stations, &placed).to_degrees() + 120.0).abs() < 1e-9);
    }
}
