//! Where in the garment a finding is: its words name pieces, edges, seams, darts and coordinates.
//!
//! Names stand in backticks after the word for their kind, such as ``seam `side-left` ``. An edge may also be written
//! ``edge 3 of `FRONT` `` or `` `FRONT.3` ``. A notch is `` `FRONT.n3` ``. Three coordinates are a place in space, two
//! a place on a piece.

use super::notches::pick_name;
use crate::svg::Spot;
use toile_garment::mesh::PieceMesh;
use toile_garment::seam::{SeamKind, SeamSide};
use toile_garment::sewing::RunSpec;
use toile_garment::{Diagnostic, Garment, Piece, Severity, Vec2, Vec3};

/// A place on a piece that lies this far beside its box is none on it, metres.
const BESIDE_PIECE: f64 = 0.02;
/// A place this near to a notch is the notch: messages round to a tenth of a millimetre.
const AT_NOTCH: f64 = 2e-4;

/// The place of one finding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// Its name in the page, `finding:NUMBER` by the order of the findings.
    pub pick: String,
    /// The number that drawing, view and list show, from 1; empty for notes.
    pub number: String,
    /// Points on pieces, in their coordinates, metres.
    pub points: Vec<(usize, Vec2)>,
    /// Lines on pieces, in their coordinates, metres.
    pub lines: Vec<(usize, Vec<Vec2>)>,
    /// The piece or seam that it is about, by the name that picks it.
    pub target: Option<String>,
    /// The place in space, metres.
    pub space: Option<Vec3>,
}

/// A thing of the garment that a finding names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Thing {
    Piece(usize),
    /// Piece, and index in its list of edges.
    Edge(usize, usize),
    Seam(usize),
    /// A seam of the sewing file that is not sewn yet.
    Planned(usize),
    /// Piece, and index in its list of darts.
    Dart(usize, usize),
    /// Piece, and index in its list of notches.
    Notch(usize, usize),
}

/// The name by which the page picks a finding, by its number among all.
#[must_use]
pub fn finding_name(number: usize) -> String {
    format!("finding:{number}")
}

/// The places of all findings that have one. Errors and warnings are numbered, in the order of the list.
#[must_use]
pub fn places(garment: &Garment, findings: &[Diagnostic]) -> Vec<Place> {
    let mut order: Vec<(usize, &Diagnostic)> = findings.iter().enumerate().collect();
    order.sort_by_key(|(_, f)| std::cmp::Reverse(f.severity));
    let mut count = 0;
    let placed = |(k, finding): (usize, &Diagnostic)| {
        let mut place = place(garment, &finding.message)?;
        place.pick = finding_name(k);
        if finding.severity > Severity::Info {
            count += 1;
            place.number = count.to_string();
        }
        Some(place)
    };
    order.into_iter().filter_map(placed).collect()
}

impl Place {
    /// The place as the drawing marks it.
    #[must_use]
    pub fn spot(&self) -> Spot<'_> {
        Spot { pick: &self.pick, label: &self.number, points: &self.points, lines: &self.lines }
    }

    /// Where the view shows it: a piece, and the point worn and flat in the coordinates of the piece. `None` without
    /// positions in 3D.
    #[must_use]
    pub fn in_view(&self, garment: &Garment) -> Option<(usize, Vec3, Vec2)> {
        let (piece, flat) = *self.points.first()?;
        let worn = self.space.or_else(|| worn(garment, piece, flat))?;
        worn.iter().all(|x| x.is_finite()).then_some((piece, worn, flat))
    }
}

fn place(garment: &Garment, message: &str) -> Option<Place> {
    let things = things(garment, message);
    let pieces: Vec<usize> = things.iter().filter_map(|t| t.piece()).collect();
    let mut place = Place { target: things.iter().find_map(|t| t.target(garment)), ..Place::default() };
    place.lines = things.iter().flat_map(|t| t.lines(garment)).collect();
    place.points = things.iter().filter_map(|t| t.point(garment)).collect();
    match coordinates(message).as_deref() {
        Some([x, y, z]) => {
            let at = Vec3::new(*x, *y, *z);
            place.space = Some(at);
            place.points = on_cloth(garment, at, &place.lines, &pieces);
        }
        Some([x, y]) => {
            let at = Vec2::new(*x, *y);
            place.points =
                pieces.iter().copied().filter(|p| is_near(&garment.pieces[*p], at)).map(|p| (p, at)).collect();
            place.points.dedup();
            place.target = place.points.first().and_then(|p| notch_at(garment, *p)).or(place.target);
        }
        _ => {}
    }
    // A point says more than the outline of a whole piece.
    if !place.points.is_empty() {
        let whole = |t: &&Thing| !matches!(t, Thing::Piece(_));
        place.lines = things.iter().filter(whole).flat_map(|t| t.lines(garment)).collect();
    }
    if place.points.is_empty() {
        place.points = place.lines.iter().filter_map(|(p, line)| Some((*p, middle(line)?))).collect();
    }
    (!place.points.is_empty()).then_some(place)
}

/// The name of a notch at a place.
fn notch_at(garment: &Garment, (piece, at): (usize, Vec2)) -> Option<String> {
    let is_there = |n: &toile_garment::notch::Notch| (n.at - at).norm() < AT_NOTCH;
    garment.pieces[piece].notches.iter().position(is_there).map(|k| pick_name((piece, k)))
}

impl Thing {
    /// The point that it is.
    fn point(self, garment: &Garment) -> Option<(usize, Vec2)> {
        match self {
            Self::Notch(p, k) => Some((p, garment.pieces[p].notches.get(k)?.at)),
            _ => None,
        }
    }

    fn piece(self) -> Option<usize> {
        match self {
            Self::Piece(p) | Self::Edge(p, _) | Self::Dart(p, _) | Self::Notch(p, _) => Some(p),
            Self::Seam(_) | Self::Planned(_) => None,
        }
    }

    /// The name by which the page picks it.
    fn target(self, garment: &Garment) -> Option<String> {
        match self {
            Self::Seam(k) => Some(format!("seam:{k}")),
            Self::Planned(_) => None,
            Self::Notch(p, k) => Some(pick_name((p, k))),
            Self::Piece(p) | Self::Edge(p, _) => Some(format!("piece:{p}")),
            Self::Dart(p, d) => {
                let is_it = |kind: &SeamKind| matches!(kind, SeamKind::Dart { piece, dart } if (piece.index(), dart.index()) == (p, d));
                let sewn = garment.seams.iter().position(|s| is_it(&s.kind));
                Some(sewn.map_or_else(|| format!("piece:{p}"), |k| format!("seam:{k}")))
            }
        }
    }

    /// Its lines on the pieces. Those of a whole piece are its outline.
    fn lines(self, garment: &Garment) -> Vec<(usize, Vec<Vec2>)> {
        match self {
            Self::Piece(p) => {
                let mut ring: Vec<Vec2> = garment.pieces[p].outline.points.iter().map(|q| q.at).collect();
                ring.extend(ring.first().copied());
                vec![(p, ring)]
            }
            Self::Edge(p, e) => vec![(p, edge_line(&garment.pieces[p], e))],
            Self::Dart(p, d) => garment.pieces[p].darts[d].legs.iter().map(|leg| (p, leg.clone())).collect(),
            Self::Seam(k) => {
                [&garment.seams[k].a, &garment.seams[k].b].into_iter().flat_map(|s| sewn(garment, s)).collect()
            }
            Self::Planned(k) => {
                let seam = &garment.plan.seams[k];
                seam.a.iter().chain(&seam.b).filter_map(|run| planned(garment, run)).collect()
            }
            Self::Notch(..) => Vec::new(),
        }
    }
}

fn sewn(garment: &Garment, side: &SeamSide) -> Vec<(usize, Vec<Vec2>)> {
    let line = |piece: usize, vertices: &[u32]| {
        let mesh = garment.pieces.get(piece)?.mesh.as_ref()?;
        Some((piece, vertices.iter().filter_map(|v| mesh.rest.get(*v as usize)).copied().collect()))
    };
    side.runs.iter().filter_map(|r| line(r.piece.index(), &r.vertices)).collect()
}

/// The line of a run in the sewing file; of a part of an edge, the whole edge.
fn planned(garment: &Garment, run: &RunSpec) -> Option<(usize, Vec<Vec2>)> {
    match run {
        RunSpec::Edge { piece, edge } | RunSpec::Part { piece, edge, .. } => {
            let p = piece_named(garment, piece)?;
            let e = edge_named(&garment.pieces[p], edge)?;
            Some((p, edge_line(&garment.pieces[p], e)))
        }
        RunSpec::Points { piece, from, to, .. } => Some((piece_named(garment, piece)?, vec![*from, *to])),
        _ => None,
    }
}

fn edge_line(piece: &Piece, edge: usize) -> Vec<Vec2> {
    piece.outline.edge_points(&piece.edges[edge])
}

fn piece_named(garment: &Garment, name: &str) -> Option<usize> {
    garment.pieces.iter().position(|p| p.name.eq_ignore_ascii_case(name))
}

fn edge_named(piece: &Piece, name: &str) -> Option<usize> {
    piece.edges.iter().position(|e| e.name.as_deref() == Some(name) || name.parse() == Ok(e.index))
}

/// All things that a message names, the most particular ones where there are any: an edge says more than its piece.
fn things(garment: &Garment, message: &str) -> Vec<Thing> {
    let mut out: Vec<Thing> = Vec::new();
    let parts: Vec<&str> = message.split('`').collect();
    for pair in parts.chunks_exact(2) {
        let (before, name) = (pair[0], pair[1]);
        let found = thing(garment, before, name, out.iter().rev().find_map(|t| t.piece()));
        if let Some(found) = found.filter(|f| !out.contains(f)) {
            out.push(found);
        }
    }
    let is_particular = |t: &Thing| !matches!(t, Thing::Piece(_));
    let particular: Vec<usize> = out.iter().filter(|t| is_particular(t)).filter_map(|t| t.piece()).collect();
    out.retain(|t| is_particular(t) || t.piece().is_some_and(|p| !particular.contains(&p)));
    out
}

/// The thing of a name, by the words before it; `last` is the piece that was named last.
fn thing(garment: &Garment, before: &str, name: &str, last: Option<usize>) -> Option<Thing> {
    let mut words = before.split(|c: char| !c.is_alphanumeric() && c != '-').filter(|w| !w.is_empty()).rev();
    let word = words.next().unwrap_or_default().to_lowercase();
    let in_piece = || name.rsplit_once('.').and_then(|(p, inner)| Some((piece_named(garment, p)?, inner)));
    let edge = || {
        let (piece, edge) = in_piece().or_else(|| Some((last?, name)))?;
        Some(Thing::Edge(piece, edge_named(&garment.pieces[piece], edge)?))
    };
    match word.trim_end_matches('s') {
        "seam" => seam(garment, name),
        "edge" => edge(),
        // A fold is named by its piece and by the pleat that it belongs to, with a number.
        "fold" => {
            let (piece, fold) = name.rsplit_once(' ')?;
            let piece = piece_named(garment, piece)?;
            let pleat = fold.rsplit_once('-').and_then(|(pleat, _)| dart(garment, (Some(piece), pleat)));
            Some(pleat.unwrap_or(Thing::Piece(piece)))
        }
        "dart" => dart(garment, in_piece().map_or((last, name), |(p, inner)| (Some(p), inner))),
        "notch" | "notche" => notch(garment, in_piece()?),
        "of" => {
            let number = words.next().and_then(|n| n.parse::<u32>().ok());
            let piece = piece_named(garment, name)?;
            let edge = number.filter(|_| words.next() == Some("edge"));
            let edge = edge.and_then(|n| garment.pieces[piece].edges.iter().position(|e| e.index == n));
            Some(edge.map_or(Thing::Piece(piece), |e| Thing::Edge(piece, e)))
        }
        _ => piece_named(garment, name)
            .map(Thing::Piece)
            .or_else(|| in_piece().and_then(|at| edge().or_else(|| notch(garment, at)))),
    }
}

fn notch(garment: &Garment, (piece, label): (usize, &str)) -> Option<Thing> {
    garment.pieces[piece].notch_of(label).map(|k| Thing::Notch(piece, k))
}

fn seam(garment: &Garment, name: &str) -> Option<Thing> {
    let sewn = garment.seams.iter().position(|s| s.name == name).map(Thing::Seam);
    sewn.or_else(|| garment.plan.seams.iter().position(|s| s.name == name).map(Thing::Planned))
}

fn dart(garment: &Garment, (piece, name): (Option<usize>, &str)) -> Option<Thing> {
    let inside = |p: usize| garment.pieces[p].darts.iter().position(|d| d.name == name).map(|d| Thing::Dart(p, d));
    piece.and_then(inside).or_else(|| (0..garment.pieces.len()).find_map(inside))
}

/// The first coordinates of a message, metres: two or three numbers in brackets, before their unit.
fn coordinates(message: &str) -> Option<Vec<f64>> {
    message.match_indices('(').find_map(|(at, _)| {
        let (inside, after) = message[at + 1..].split_once(')')?;
        let unit = match after.split(|c: char| !c.is_alphabetic()).nth(1)? {
            "mm" => 1e-3,
            "m" => 1.0,
            _ => return None,
        };
        let numbers: Option<Vec<f64>> = inside.split(',').map(|x| x.trim().parse::<f64>().ok()).collect();
        numbers.filter(|n| matches!(n.len(), 2 | 3)).map(|n| n.iter().map(|x| x * unit).collect())
    })
}

fn is_near(piece: &Piece, at: Vec2) -> bool {
    let points = || piece.outline.points.iter().map(|p| p.at);
    let far = Vec2::repeat(f64::INFINITY);
    let (low, high) = points().fold((far, -far), |(low, high), p| (low.inf(&p), high.sup(&p)));
    let beside = (low - at).sup(&(at - high)).max();
    beside <= BESIDE_PIECE
}

/// Pieces with a mesh and positions in 3D.
fn worn_pieces(garment: &Garment) -> impl Iterator<Item = (usize, &PieceMesh, &Vec<Vec3>)> {
    let shape = garment.drape.as_ref().or(garment.stitched.as_ref());
    let placed = garment.pieces.iter().zip(shape.map_or(&[][..], |s| &s.positions)).enumerate();
    placed.filter_map(|(k, (piece, at))| Some((k, piece.mesh.as_ref().filter(|m| m.rest.len() == at.len())?, at)))
}

/// Points of the pieces whose cloth is nearest to a place in space: one on each line, else one on the nearest piece of
/// those that are named, else of all.
fn on_cloth(garment: &Garment, at: Vec3, lines: &[(usize, Vec<Vec2>)], pieces: &[usize]) -> Vec<(usize, Vec2)> {
    if pieces.is_empty() && !lines.is_empty() {
        let nearest = |(p, line): &(usize, Vec<Vec2>)| {
            let (_, mesh, worn) = worn_pieces(garment).find(|(k, ..)| k == p)?;
            let far = |q: &Vec2| vertex_at(mesh, *q).map_or(f64::INFINITY, |v| (worn[v] - at).norm_squared());
            line.iter().min_by(|a, b| far(a).total_cmp(&far(b))).map(|q| (*p, *q))
        };
        return lines.iter().filter_map(nearest).collect();
    }
    let named = worn_pieces(garment).filter(|(k, ..)| pieces.is_empty() || pieces.contains(k));
    let vertices = named.flat_map(|(k, mesh, worn)| worn.iter().zip(&mesh.rest).map(move |(x, flat)| (k, x, flat)));
    let far = |x: &Vec3| (x - at).norm_squared();
    vertices.min_by(|a, b| far(a.1).total_cmp(&far(b.1))).map(|(k, _, flat)| (k, *flat)).into_iter().collect()
}

/// The vertex of a mesh that lies nearest to a place on its piece.
fn vertex_at(mesh: &PieceMesh, at: Vec2) -> Option<usize> {
    let far = |v: &usize| (mesh.rest[*v] - at).norm_squared();
    (0..mesh.rest.len()).min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// Where a place on a piece is worn.
fn worn(garment: &Garment, piece: usize, at: Vec2) -> Option<Vec3> {
    let (_, mesh, worn) = worn_pieces(garment).find(|(k, ..)| *k == piece)?;
    worn.get(vertex_at(mesh, at)?).copied()
}

/// The middle of an edge, where it is worn and where it lies on its piece.
pub fn middle_of_edge(garment: &Garment, piece: usize, edge: usize) -> Option<Place> {
    let at = middle(&edge_line(&garment.pieces[piece], edge))?;
    Some(Place { points: vec![(piece, at)], ..Place::default() })
}

/// The point half way along a line; of a closed one, the middle of its points.
fn middle(line: &[Vec2]) -> Option<Vec2> {
    let (first, last) = (line.first()?, line.last()?);
    if first == last {
        let far = Vec2::repeat(f64::INFINITY);
        let (low, high) = line.iter().fold((far, -far), |(low, high), p| (low.inf(p), high.sup(p)));
        return Some((low + high) * 0.5);
    }
    let whole: f64 = line.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let mut left = 0.5 * whole;
    for w in line.windows(2) {
        let step = (w[1] - w[0]).norm();
        if left <= step && step > 0.0 {
            return Some(w[0] + (w[1] - w[0]) * (left / step));
        }
        left -= step;
    }
    Some(*last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::OUT_OF_RANGE;
    use toile_garment::garment::Shape;
    use toile_garment::notch::{Notch, NotchKind};
    use toile_garment::outline::OutlineEdge;
    use toile_garment::outline::{LinePoint, PieceLine, PointKind};
    use toile_garment::seam::{Seam, SeamRun};

    fn square(name: &str, right: f64) -> (Piece, Vec<Vec3>) {
        let rest: Vec<Vec2> = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.0, 0.1]].map(Vec2::from).to_vec();
        let worn = rest.iter().map(|p| Vec3::new(p.x + right, 1.0 + p.y, 0.1)).collect();
        let points = rest.iter().map(|p| LinePoint { at: *p, kind: PointKind::Turn }).collect();
        let edge = |index: u32| OutlineEdge {
            index,
            name: (index == 2).then(|| "hem".into()),
            from: index,
            to: (index + 1) % 4,
        };
        let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() };
        let outline = PieceLine { points, closed: true, ..PieceLine::default() };
        let edges = (0..4).map(edge).collect();
        (Piece { name: name.into(), outline, edges, mesh: Some(mesh), ..Piece::default() }, worn)
    }

    fn garment() -> Garment {
        let [(mut a, at), (mut b, beside)] = [square("FRONT", 0.0), square("BACK", 0.2)];
        (a.id, b.id) = (0.into(), 1.into());
        let side = |piece, vertices| SeamSide { runs: vec![SeamRun { piece, vertices }], length: 0.1 };
        let seam = Seam {
            id: 0.into(),
            name: "side".into(),
            kind: SeamKind::Seam,
            a: side(a.id, vec![1, 2]),
            b: side(b.id, vec![0, 3]),
            ease: 0.0,
            gather: None,
            stitches: Vec::new(),
            source: None,
        };
        Garment {
            pieces: vec![a, b],
            seams: vec![seam],
            stitched: Some(Shape { positions: vec![at, beside], ..Shape::default() }),
            ..Garment::default()
        }
    }

    fn of(message: &str) -> Option<Place> {
        place(&garment(), message)
    }

    #[test]
    fn a_place_in_space_is_found_on_the_piece_that_is_named() {
        let place =
            of("piece `BACK`: the start is not free, first near (190, 1000, 100) mm, at the front").expect("place");
        assert_eq!((place.points, place.target.as_deref()), (vec![(1, Vec2::zeros())], Some("piece:1")));
        assert_eq!(place.space, Some(Vec3::new(0.19, 1.0, 0.1)));
        let unnamed = of("the body cannot go on: it catches the cloth near (0.000, 1.100, 0.100) m").expect("place");
        assert_eq!(unnamed.points, [(0, Vec2::new(0.0, 0.1))]);
    }

    #[test]
    fn seams_and_edges_are_lines_and_a_piece_is_its_outline() {
        let seam = of("seam `side` is still 4.0 mm open, widest at (200, 1090, 100) mm").expect("place");
        assert_eq!(seam.points, [(0, Vec2::new(0.2, 0.1)), (1, Vec2::new(0.0, 0.1))]);
        assert_eq!((seam.lines.len(), seam.target.as_deref()), (2, Some("seam:0")));
        for words in ["edge `FRONT.hem` is not sewn", "piece `FRONT`: edge `2` is short", "edge 2 of `FRONT` is short"]
        {
            let edge = of(words).expect(words);
            assert_eq!(edge.lines, [(0, vec![Vec2::new(0.2, 0.1), Vec2::new(0.0, 0.1)])], "{words}");
            assert_eq!(edge.points, [(0, Vec2::new(0.1, 0.1))], "{words}");
        }
        assert_eq!(of("fold `FRONT pleat-1-2`: it lies open").expect("place").target.as_deref(), Some("piece:0"));
        let piece = of("nothing says where piece `BACK` starts in 3D").expect("place");
        assert_eq!((piece.lines[0].1.len(), piece.points), (5, vec![(1, Vec2::new(0.1, 0.05))]));
    }

    #[test]
    fn a_notch_is_found_by_its_label_and_by_its_place() {
        let mut garment = garment();
        let (kind, at, on) = (NotchKind::Slit, Vec2::new(0.2, 0.05), "sew".to_owned());
        let notch = Notch { kind, at, depth: 4e-3, width: 0.0, angle: None, on, name: None, source: None };
        garment.pieces[0].notches = vec![notch];
        for words in ["seam `side`: without a partner: `FRONT.n1`", "notch `FRONT.n1` moved"] {
            let place = place(&garment, words).expect(words);
            assert_eq!((place.points, place.space), (vec![(0, at)], None), "{words}");
        }
        let target = |words: &str| place(&garment, words).expect(words).target;
        assert_eq!(target("notch `FRONT.n1` moved").as_deref(), Some("notch:0:0"));
        let off = target("a notch of `FRONT` at (200.0, 50.0) mm lies off the boundary");
        assert_eq!(off.as_deref(), Some("notch:0:0"));
        assert_eq!(place(&garment, "edge `FRONT.n9` is short"), None);
    }

    #[test]
    fn a_place_on_a_piece_is_worn_where_its_cloth_is() {
        let place = of("piece `FRONT`: its outline crosses itself at (200.0, 100.0) mm").expect("place");
        assert_eq!(place.in_view(&garment()), Some((0, Vec3::new(0.2, 1.1, 0.1), Vec2::new(0.2, 0.1))));
        assert_eq!(of("piece `FRONT`: drawn at (9000, 100) mm").expect("place").points, [(0, Vec2::new(0.1, 0.05))]);
    }

    #[test]
    fn findings_without_a_place_have_none_and_notes_have_no_number() {
        assert_eq!(of("the fabric `FRONT-ish` is not known (1, 2)"), None);
        let findings = [
            Diagnostic::info(OUT_OF_RANGE, "piece `FRONT` was moved"),
            Diagnostic::warning(OUT_OF_RANGE, "seam `side` is open"),
            Diagnostic::error(OUT_OF_RANGE, "piece `BACK` is not placed"),
        ];
        let numbers: Vec<(String, String)> =
            places(&garment(), &findings).into_iter().map(|p| (p.pick, p.number)).collect();
        let want = [("finding:2", "1"), ("finding:1", "2"), ("finding:0", "")];
        assert_eq!(numbers, want.map(|(pick, number)| (pick.to_owned(), number.to_owned())));
    }
}
