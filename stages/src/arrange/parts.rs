//! Parts of a piece that was cut apart. They are laid against one another along their seams, and one piece is arranged for
//! all of them: parts start where the whole piece would.

use super::pull::GAP;
use super::{Arrangement, Given, Held, ON_EDGE, arrange, distance};
use crate::roles::outline::{Polygon, turned};
use crate::roles::{Join, roles};
use toile_garment::body::Body;
use toile_garment::outline::{LinePoint, PieceLine};
use toile_garment::{Piece, PieceId, Vec2};

/// A piece that was cut apart: its name, and its parts.
#[derive(Clone, Debug)]
pub struct Whole {
    /// Its name.
    pub name: String,
    /// The numbers of its parts.
    pub parts: Vec<usize>,
}

/// How a piece lies in the plane of the whole piece.
#[derive(Clone, Copy, Debug, Default)]
pub struct Laid {
    /// Its turn, rad.
    turn: f64,
    /// Its move after the turn, m.
    by: Vec2,
}

impl Laid {
    /// A point of the piece in the plane of the whole piece, m.
    #[must_use]
    pub fn at(&self, p: Vec2) -> Vec2 {
        turned(p, self.turn) + self.by
    }

    /// The motion that brings points to others, in the sense of least squares.
    fn onto(points: &[[Vec2; 2]]) -> Self {
        let middle = |k: usize| points.iter().map(|p| p[k]).sum::<Vec2>() / points.len() as f64;
        let [from, to] = [middle(0), middle(1)];
        let (sin, cos) = points.iter().fold((0.0, 0.0), |(sin, cos), [p, q]| {
            let (p, q) = (p - from, q - to);
            (sin + p.perp(&q), cos + p.dot(&q))
        });
        let turn = libm::atan2(sin, cos);
        Self { turn, by: to - turned(from, turn) }
    }

    fn moved(self, by: Vec2) -> Self {
        Self { by: self.by + by, ..self }
    }
}

/// The pieces that are arranged: whole ones, and the others as they are.
struct Gathered {
    pieces: Vec<Piece>,
    joins: Vec<Join>,
    /// The piece here that a piece of the garment is a part of, or is.
    of: Vec<usize>,
    /// How the pieces of the garment lie in those.
    laid: Vec<Laid>,
    /// The same, with gaps between parts: there they start.
    starts: Vec<Laid>,
    /// See [`Arranged::apart`].
    apart: Vec<String>,
}

/// Pieces that were arranged, and those that were cut apart as one.
#[derive(Clone, Debug)]
pub struct Arranged {
    /// The places.
    pub arrangement: Arrangement,
    /// How every piece lies in the sheet of its place.
    pub starts: Vec<Laid>,
    /// Names of whole pieces whose parts are not sewn to one another side by side.
    pub apart: Vec<String>,
}

/// Arranges pieces, and those that were cut apart as one.
#[must_use]
pub fn arrange_wholes(
    pieces: &[Piece],
    joins: &[Join],
    wholes: &[Whole],
    body: Option<&Body>,
    given: Given,
) -> Arranged {
    let Gathered { pieces: gathered, joins, of, laid, starts, apart } = gather(pieces, joins, wholes);
    let first = |k: usize| of.iter().position(|o| *o == k).unwrap_or(0);
    let given = Given {
        sheets: (0..gathered.len()).map(|k| given.sheets[first(k)].clone()).collect(),
        layers: (0..gathered.len()).map(|k| given.layers[first(k)]).collect(),
    };
    let found = arrange(&gathered, &roles(&gathered, &joins), &joins, body, given);
    let why = |k: usize| found.unplaced.iter().find(|(u, _)| *u == k).map(|(_, why)| why.clone());
    let held = found.held.iter().flat_map(|h| held_edges(*h, &gathered, pieces, &of, &laid)).collect();
    let arrangement = Arrangement {
        places: of.iter().map(|k| found.places[*k].clone()).collect(),
        unplaced: of.iter().enumerate().filter_map(|(i, k)| Some((i, why(*k)?))).collect(),
        held,
        ..found
    };
    Arranged { arrangement, starts, apart }
}

/// The edges of parts that lie on a held edge of their whole piece.
fn held_edges(held: Held, gathered: &[Piece], pieces: &[Piece], of: &[usize], laid: &[Laid]) -> Vec<Held> {
    let whole = &gathered[held.piece];
    let Some(edge) = whole.edges.iter().find(|e| e.index == held.edge) else { return Vec::new() };
    let line = whole.outline.edge_points(edge);
    let is_on = |p: Vec2| line.windows(2).any(|w| distance(p, w[0], w[1]) < ON_EDGE);
    let parts = (0..pieces.len()).filter(|i| of[*i] == held.piece);
    let edges = parts.flat_map(|i| pieces[i].edges.iter().map(move |e| (i, e)));
    let lies = edges.filter(|(i, e)| pieces[*i].outline.edge_points(e).iter().all(|p| is_on(laid[*i].at(*p))));
    lies.map(|(piece, e)| Held { piece, edge: e.index }).collect()
}

fn gather(pieces: &[Piece], joins: &[Join], wholes: &[Whole]) -> Gathered {
    let mut g = Gathered {
        pieces: Vec::new(),
        joins: Vec::new(),
        of: vec![usize::MAX; pieces.len()],
        laid: vec![Laid::default(); pieces.len()],
        starts: vec![Laid::default(); pieces.len()],
        apart: Vec::new(),
    };
    let mut closed: Vec<usize> = Vec::new();
    for i in 0..pieces.len() {
        if g.of[i] != usize::MAX {
            continue;
        }
        let spec = wholes.iter().find(|w| w.parts.contains(&i));
        let whole = spec.and_then(|w| Growing::grown(pieces, joins, w));
        let fails = spec.filter(|w| whole.is_none() && !g.apart.contains(&w.name));
        g.apart.extend(fails.map(|w| w.name.clone()));
        let number = g.pieces.len();
        g.of[i] = number;
        let id = PieceId::from(number);
        let Some(whole) = whole else {
            g.pieces.push(Piece { id, ..pieces[i].clone() });
            continue;
        };
        for part in &whole.parts {
            (g.of[part.piece], g.laid[part.piece], g.starts[part.piece]) = (number, part.laid, part.start);
        }
        closed.extend(&whole.closed);
        g.pieces.push(Piece { id, ..whole.piece(pieces) });
    }
    let open = joins.iter().enumerate().filter(|(k, _)| !closed.contains(k));
    g.joins = open.map(|(_, join)| join.clone()).collect();
    for point in g.joins.iter_mut().flat_map(|j| &mut j.pairs).flatten() {
        (point.at, point.piece) = (g.laid[point.piece].at(point.at), g.of[point.piece]);
    }
    g
}

/// A part that is laid.
struct LaidPart {
    piece: usize,
    laid: Laid,
    start: Laid,
}

/// A whole piece while its parts are laid against one another.
struct Growing<'a> {
    name: &'a str,
    parts: Vec<LaidPart>,
    /// The outline so far, counter-clockwise.
    outline: Vec<LinePoint>,
    /// The seams along which parts were laid.
    closed: Vec<usize>,
}

/// A part that can be laid, and how.
struct Next {
    join: usize,
    piece: usize,
    /// The part that it is laid against.
    against: usize,
    /// Points of the part and of the outline that meet, in sewing order.
    points: Vec<[Vec2; 2]>,
    laid: Laid,
    /// How far its middle moves from where it is drawn, m.
    way: f64,
}

impl<'a> Growing<'a> {
    /// `None` where the parts are not all sewn to each other side by side.
    fn grown(pieces: &[Piece], joins: &[Join], whole: &'a Whole) -> Option<Self> {
        let first = *whole.parts.first().filter(|_| whole.parts.len() > 1)?;
        let part = LaidPart { piece: first, laid: Laid::default(), start: Laid::default() };
        let outline = pieces[first].outline.points.clone();
        let mut growing = Self { name: &whole.name, parts: vec![part], outline, closed: Vec::new() };
        while growing.parts.len() < whole.parts.len() {
            let next = whole.parts.iter().filter(|p| !growing.has(**p));
            let next = next.flat_map(|p| growing.ways_to_lay(pieces, joins, *p));
            // Parts are drawn where they lay. Of several seams between two parts that one was cut which moves them least.
            let next = next.min_by(|a, b| a.way.total_cmp(&b.way))?;
            growing.lay(pieces, &next)?;
        }
        Some(growing)
    }

    fn has(&self, piece: usize) -> bool {
        self.parts.iter().any(|p| p.piece == piece)
    }

    fn ways_to_lay(&self, pieces: &[Piece], joins: &[Join], piece: usize) -> Vec<Next> {
        let each = joins.iter().enumerate().flat_map(|(join, j)| self.parts.iter().map(move |p| (join, j, p)));
        let way = |(join, j, against): (usize, &Join, &LaidPart)| {
            let between = j.pairs.iter().filter_map(|[a, b]| {
                let (own, other) = if a.piece == piece { (a, b) } else { (b, a) };
                (own.piece == piece && other.piece == against.piece).then(|| [own.at, against.laid.at(other.at)])
            });
            let points: Vec<[Vec2; 2]> = between.collect();
            if points.len() < 2 {
                return None;
            }
            let laid = Laid::onto(&points);
            let middle = Polygon { points: pieces[piece].outline.positions() }.centroid();
            let way = (laid.at(middle) - middle).norm();
            Some(Next { join, piece, against: against.piece, points, laid, way })
        };
        each.filter_map(way).collect()
    }

    /// Lays a part against the outline, and takes it in.
    fn lay(&mut self, pieces: &[Piece], next: &Next) -> Option<()> {
        let moved = |p: &LinePoint| LinePoint { at: next.laid.at(p.at), ..*p };
        let own: Vec<LinePoint> = pieces[next.piece].outline.points.iter().map(moved).collect();
        let polygon = |line: &[LinePoint]| Polygon { points: line.iter().map(|p| p.at).collect() };
        let before = polygon(&self.outline);
        let normals = next.points.iter().map(|[_, at]| before.outwards(*at).0);
        let outwards = normals.sum::<Vec2>().try_normalize(1e-9)?;
        let apart = next.points.iter().map(|[p, at]| (next.laid.at(*p) - at).dot(&outwards)).fold(0.0, f64::min);
        let by = outwards * (GAP - apart);
        let of_seam = |k: usize| {
            let point = |at: &[Vec2; 2]| if k == 0 { next.laid.at(at[0]) } else { at[1] };
            next.points.iter().map(point).collect::<Vec<_>>()
        };
        let mut outline = beyond(&self.outline, &of_seam(1))?;
        outline.extend(beyond(&own, &of_seam(0))?);
        let [sum, area] = [before.area() + polygon(&own).area(), polygon(&outline).area()];
        if area < 0.5 * sum {
            return None;
        }
        self.outline = outline;
        self.closed.push(next.join);
        let beside = self.parts.iter().find(|p| p.piece == next.against)?;
        let start = next.laid.moved(beside.start.by - beside.laid.by + by);
        self.parts.push(LaidPart { piece: next.piece, laid: next.laid, start });
        Some(())
    }

    /// The whole piece. What it is made of is that of its first part.
    fn piece(&self, pieces: &[Piece]) -> Piece {
        let first = &pieces[self.parts[0].piece];
        let outline = PieceLine { points: self.outline.clone(), closed: true, ..PieceLine::default() };
        let edges = outline.edges();
        let darts = self.parts.iter().flat_map(|p| pieces[p.piece].darts.iter().cloned()).collect();
        let name = self.name.to_owned();
        Piece { name, outline, edges, darts, grain: first.grain, mirrored: first.mirrored, ..Piece::default() }
    }
}

/// The part of a closed line beyond a seam on it, in the sense of the line, with both ends of the seam.
fn beyond(line: &[LinePoint], seam: &[Vec2]) -> Option<Vec<LinePoint>> {
    let n = line.len();
    let nearest = |p: &Vec2| (0..n).min_by(|a, b| (line[*a].at - p).norm().total_cmp(&(line[*b].at - p).norm()));
    let (first, last, middle) = (nearest(seam.first()?)?, nearest(seam.last()?)?, seam[seam.len() / 2]);
    let walk =
        |from: usize, to: usize| (0..=(to + n - from) % n).map(|k| line[(from + k) % n].clone()).collect::<Vec<_>>();
    let away =
        |walk: &[LinePoint]| walk.windows(2).map(|w| distance(middle, w[0].at, w[1].at)).fold(f64::INFINITY, f64::min);
    let [ahead, back] = [walk(first, last), walk(last, first)];
    (first != last).then(|| if away(&ahead) < away(&back) { back } else { ahead })
}
