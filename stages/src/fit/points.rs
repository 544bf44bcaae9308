//! Points of measure of a house: edges, girths, and ways between two ends.
//!
//! A way along the surface lies in the plane through both ends and the normal of the surface between them. So lies a
//! tape that is laid straight. A tape goes along the convex hull of that way.

use super::rings::rings;
use super::surface::Surface;
use crate::body::{hull, sections};
use crate::sewing::nearest;
use std::collections::{BTreeMap, BTreeSet};
use toile_formats::measures::{End, Method, On, PointOfMeasure};
use toile_formats::report::Point;
use toile_garment::outline::OutlineEdge;
use toile_garment::{Garment, Piece, Vec2, Vec3};

/// Measures a point; the error says why it cannot be.
///
/// # Errors
/// What is not there, in words.
pub fn point(m: &PointOfMeasure, garment: &Garment) -> Result<Point, String> {
    let (length, height) = if !m.edges.is_empty() {
        edges(m, garment)?
    } else if let Some(segment) = &m.around {
        girth(m, garment, segment)?
    } else {
        way(m, garment)?
    };
    let expected = m.expected.map(|l| l.0);
    let tolerance = m.tolerance.map(|l| l.0);
    let passed = expected.zip(tolerance).map(|(wanted, off)| (length - wanted).abs() <= off);
    let on = match m.on {
        On::Pattern => "pattern",
        On::Drape => "drape",
        On::Body => "body",
    };
    let method = match m.method {
        Method::Surface => "surface",
        Method::Tape => "tape",
        Method::Straight => "straight",
    };
    Ok(Point { name: m.name.clone(), on, method, length, height, expected, tolerance, passed })
}

/// Sum of the lengths of edges, and their mean height; 0 on the pattern.
fn edges(m: &PointOfMeasure, garment: &Garment) -> Result<(f64, f64), String> {
    let (mut length, mut height) = (0.0, 0.0);
    for name in &m.edges {
        let line = edge(name, garment, m.on)?;
        for pair in line.windows(2) {
            let part = (pair[1] - pair[0]).norm();
            length += part;
            height += part * 0.5 * (pair[0].y + pair[1].y);
        }
    }
    Ok((length, if m.on == On::Pattern || length <= 0.0 { 0.0 } else { height / length }))
}

/// A name that is not there: what is wrong, and the remedy.
type Unknown = (String, String);

/// All names of a measure that neither the pattern nor the body has, and that are not `unread` names of the body. Nothing is
/// known of a pattern without pieces, nor of a body that is not there.
pub fn unknown_names(m: &PointOfMeasure, garment: &Garment, unread: &BTreeSet<String>) -> Vec<Unknown> {
    let ends = [&m.from, &m.to].into_iter().flatten();
    let of_ends = ends.clone().filter_map(|end| if let End::Edge { edge, .. } = end { Some(edge) } else { None });
    let edges = m.edges.iter().chain(of_ends).filter(|_| !garment.pieces.is_empty());
    let wrong_edges = edges.filter_map(|name| named_edge(name, garment).err());
    let Some(body) = &garment.body else { return wrong_edges.collect() };
    let of_ends = ends.filter_map(|end| if let End::Landmark(name) = end { Some(name) } else { None });
    let is_read = |name: &&String| !unread.contains(*name);
    let landmarks =
        m.at.iter().chain(of_ends).filter(is_read).filter_map(|name| named(&body.landmarks, name, "landmark").err());
    let segments = m.around.iter().filter(is_read).filter_map(|name| named(&body.segments, name, "segment").err());
    wrong_edges.chain(landmarks).chain(segments).collect()
}

/// A landmark or a segment of the body.
fn named<'b, T>(all: &'b BTreeMap<String, T>, name: &str, kind: &str) -> Result<&'b T, Unknown> {
    let known = || nearest(name, &all.keys().map(String::as_str).collect::<Vec<_>>());
    all.get(name).ok_or_else(|| (format!("the body has no {kind} `{name}`"), known()))
}

/// The number of the piece, and the edge, of a name `PIECE.EDGE`.
fn named_edge<'g>(name: &str, garment: &'g Garment) -> Result<(usize, &'g OutlineEdge), Unknown> {
    let not_written = || (format!("`{name}` is not written PIECE.EDGE"), "write e.g. `FRONT.0`".to_owned());
    let (piece_name, edge_name) = name.rsplit_once('.').ok_or_else(not_written)?;
    let pieces = || garment.pieces.iter().map(|p| p.name.as_str());
    let number = pieces().position(|p| p == piece_name).ok_or_else(|| {
        (format!("there is no piece `{piece_name}`"), nearest(piece_name, &pieces().collect::<Vec<_>>()))
    })?;
    let edges = &garment.pieces[number].edges;
    let is_meant = |e: &&OutlineEdge| e.name.as_deref() == Some(edge_name) || edge_name.parse() == Ok(e.index);
    let edge = edges.iter().find(is_meant).ok_or_else(|| {
        let names: Vec<&str> = edges.iter().filter_map(|e| e.name.as_deref()).collect();
        let numbers = format!("its edges are numbered 0 to {}", edges.len().saturating_sub(1));
        let remedy = if names.is_empty() { numbers } else { format!("{}; {numbers}", nearest(edge_name, &names)) };
        (format!("`{piece_name}` has no edge `{edge_name}`"), remedy)
    })?;
    Ok((number, edge))
}

/// The line of an edge `PIECE.EDGE`: as drawn on the pattern, else the worn mesh.
fn edge(name: &str, garment: &Garment, on: On) -> Result<Vec<Vec3>, String> {
    let (number, edge) = named_edge(name, garment).map_err(|(why, _)| why)?;
    let piece = &garment.pieces[number];
    if on == On::Pattern {
        let points = &piece.outline.points;
        let run = around(points.len(), edge.from as usize, edge.to as usize);
        return Ok(run.map(|i| Vec3::new(points[i].at.x, points[i].at.y, 0.0)).collect());
    }
    let shape = garment.drape.as_ref().ok_or("the garment is not draped")?;
    let vertices = mesh_run(piece, edge.from, edge.to).ok_or_else(|| format!("`{name}` is no line of the mesh"))?;
    let at = shape.positions.get(number).map_or(&[][..], Vec::as_slice);
    Ok(vertices.iter().filter_map(|v| at.get(*v as usize)).copied().collect())
}

/// Numbers from one point of a ring to another, both included; the whole ring where they are one.
fn around(count: usize, from: usize, to: usize) -> impl Iterator<Item = usize> {
    let steps = if count == 0 { 0 } else { (to + count - from - 1) % count + 2 };
    (0..steps).map(move |k| (from + k) % count)
}

/// Mesh vertices of the outline between two points of the drawn line.
fn mesh_run(piece: &Piece, from: u32, to: u32) -> Option<Vec<u32>> {
    let mesh = piece.mesh.as_ref()?;
    let ring = &mesh.outline()?.vertices;
    let place = |point: u32| {
        let vertex = (*mesh.outline_vertex.get(point as usize)?)?;
        ring.iter().position(|v| *v == vertex)
    };
    Some(around(ring.len(), place(from)?, place(to)?).map(|i| ring[i]).collect())
}

/// A girth around a segment of the body, and its height.
fn girth(m: &PointOfMeasure, garment: &Garment, segment: &str) -> Result<(f64, f64), String> {
    let body = garment.body.as_ref().ok_or("there is no body")?;
    let told = match &m.at {
        Some(name) => landmark(garment, name)?.y,
        None => m.height.map_or(0.0, |h| h.0),
    };
    let height = told - m.below.map_or(0.0, |l| l.0);
    let axis = named(&body.segments, segment, "segment").map_err(|(why, _)| why)?;
    let share = (height - axis.from.y) / (axis.to.y - axis.from.y);
    let middle = axis.from + (axis.to - axis.from) * if share.is_finite() { share } else { 0.0 };
    let surface = match m.on {
        On::Body => Surface::of_body(body),
        On::Pattern | On::Drape => Surface::of(garment).ok_or("the garment is not draped")?,
    };
    let found = rings(&surface, height).into_iter().filter(|r| r.closed && r.holds(Vec2::new(middle.x, middle.z)));
    let ring = found.max_by(|a, b| a.tape().total_cmp(&b.tape())).ok_or("nothing closed lies at that height")?;
    let length = match (m.on, m.method) {
        (On::Pattern, _) => super::measures::rest_around(garment, &surface, &ring, height),
        (_, Method::Tape) => ring.tape(),
        _ => ring.along(),
    };
    Ok((length, height))
}

fn landmark(garment: &Garment, name: &str) -> Result<Vec3, String> {
    let body = garment.body.as_ref().ok_or("there is no body")?;
    named(&body.landmarks, name, "landmark").copied().map_err(|(why, _)| why)
}

/// The way between two ends, and the height of the first.
fn way(m: &PointOfMeasure, garment: &Garment) -> Result<(f64, f64), String> {
    let (Some(from), Some(to)) = (&m.from, &m.to) else { return Err("an end is missing".to_owned()) };
    let (a, b) = match (end(from, m.on, garment)?, end(to, m.on, garment)?) {
        (At::Point(a), At::Point(b)) => (a, b),
        (At::Point(a), At::Height(h)) | (At::Height(h), At::Point(a)) => return Ok(((a.y - h).abs(), a.y)),
        (At::Height(a), At::Height(b)) => return Ok(((a - b).abs(), a)),
    };
    if m.method == Method::Straight || m.on == On::Pattern {
        return Ok(((b - a).norm(), a.y));
    }
    let surface = match m.on {
        On::Body => Surface::of_body(garment.body.as_ref().ok_or("there is no body")?),
        On::Pattern | On::Drape => Surface::of(garment).ok_or("the garment is not draped")?,
    };
    let path = path(&surface, a, b).ok_or("no way along the surface joins the ends")?;
    let along: f64 = path.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    Ok((if m.method == Method::Tape { taut(&path) } else { along }, a.y))
}

enum At {
    Point(Vec3),
    Height(f64),
}

fn end(end: &End, on: On, garment: &Garment) -> Result<At, String> {
    Ok(match end {
        End::Landmark(name) => At::Point(landmark(garment, name)?),
        End::Height { height } => At::Height(height.0),
        End::Edge { edge: name, share } => {
            let line = edge(name, garment, on)?;
            let whole: f64 = line.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            let mut left = share.clamp(0.0, 1.0) * whole;
            let mut at = line.first().copied().ok_or("the edge is empty")?;
            for pair in line.windows(2) {
                let part = (pair[1] - pair[0]).norm();
                at = if left <= part && part > 0.0 { pair[0] + (pair[1] - pair[0]) * (left / part) } else { pair[1] };
                if left <= part {
                    break;
                }
                left -= part;
            }
            At::Point(at)
        }
    })
}

/// Length of the shorter way along a surface between two points on it, metres.
pub(super) fn surface_way(surface: &Surface, a: Vec3, b: Vec3) -> Option<f64> {
    path(surface, a, b).map(|way| way.windows(2).map(|w| (w[1] - w[0]).norm()).sum())
}

/// The shorter way along a surface between two points on it, in the plane through them and the surface's normal.
fn path(surface: &Surface, a: Vec3, b: Vec3) -> Option<Vec<Vec3>> {
    let out = normal_near(surface, a) + normal_near(surface, b);
    let across = (b - a).cross(&out);
    let across = if across.norm() > 1e-9 { across.normalize() } else { return None };
    let mut best: Option<(f64, Vec<Vec3>)> = None;
    for section in sections(&surface.points, &surface.triangles, a, across) {
        let points = &section.points;
        let near =
            |p: Vec3| (0..points.len()).min_by(|i, j| (points[*i] - p).norm().total_cmp(&(points[*j] - p).norm()));
        let (Some(i), Some(j)) = (near(a), near(b)) else { continue };
        let off = (points[i] - a).norm() + (points[j] - b).norm();
        let ways = [(i, j), (j, i)].map(|(i, j)| {
            let mut way: Vec<Vec3> = around(points.len(), i, j).map(|k| points[k]).collect();
            if i == j {
                way.truncate(1);
            }
            way
        });
        let closed = section.gap() == 0.0;
        for (k, way) in ways.into_iter().enumerate() {
            // An open outline is walked in its order only.
            if !closed && ((i <= j) != (k == 0)) {
                continue;
            }
            let mut whole = if k == 0 { way } else { way.into_iter().rev().collect() };
            whole.insert(0, a);
            whole.push(b);
            let length: f64 = whole.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            // Outlines that pass the ends by are other layers.
            if best.as_ref().is_none_or(|(least, _)| length + 10.0 * off < *least) {
                best = Some((length + 10.0 * off, whole));
            }
        }
    }
    best.map(|(_, way)| way)
}

/// Unit normal of the triangle nearest to a point.
fn normal_near(surface: &Surface, p: Vec3) -> Vec3 {
    let far = |t: &usize| {
        let [a, b, c] = surface.corners(*t);
        ((a + b + c) / 3.0 - p).norm_squared()
    };
    let nearest = (0..surface.triangles.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
    let Some([a, b, c]) = nearest.map(|t| surface.corners(t)) else { return Vec3::z() };
    let n = (b - a).cross(&(c - a));
    if n.norm() > 0.0 { n.normalize() } else { Vec3::z() }
}

/// Length of a tape along a way: the shorter side of its convex hull, seen across its plane.
fn taut(path: &[Vec3]) -> f64 {
    let (Some(a), Some(b)) = (path.first(), path.last()) else { return 0.0 };
    let along = (b - a).normalize();
    let off = |p: &Vec3| (p - a) - along * (p - a).dot(&along);
    let Some(most) = path.iter().max_by(|p, q| off(p).norm().total_cmp(&off(q).norm())) else { return 0.0 };
    if off(most).norm() < 1e-12 {
        return (b - a).norm();
    }
    let side = off(most).normalize();
    let flat = |p: &Vec3| Vec2::new((p - a).dot(&along), (p - a).dot(&side).max(0.0));
    let ring = hull(path.iter().map(flat).collect());
    let around: f64 = (0..ring.len()).map(|i| (ring[(i + 1) % ring.len()] - ring[i]).norm()).sum();
    // The hull closes along the straight line between the ends.
    around - (b - a).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_formats::measures::read;
    use toile_garment::body::Body;
    use toile_garment::garment::Shape;
    use toile_garment::mesh::{ChainKind, MeshChain, PieceMesh};
    use toile_garment::outline::{LinePoint, PieceLine, PointKind};

    /// A strip of 0.3 by 0.1 m, worn as a roof: its long edges rise by 30° to the middle and fall again.
    fn roof() -> Garment {
        let corners = [[0.0, 0.0], [0.15, 0.0], [0.3, 0.0], [0.3, 0.1], [0.15, 0.1], [0.0, 0.1]];
        let rest: Vec<Vec2> = corners.map(Vec2::from).to_vec();
        let worn = |p: &Vec2| {
            let from_end = 0.15 - (p.x - 0.15).abs();
            Vec3::new(p.x * 0.75_f64.sqrt(), 1.0 + 0.5 * from_end, p.y)
        };
        let mesh = PieceMesh {
            triangles: vec![[0, 1, 4], [0, 4, 5], [1, 2, 3], [1, 3, 4]],
            chains: vec![MeshChain { kind: ChainKind::Outline, index: 0, vertices: (0..6).collect(), closed: true }],
            outline_vertex: (0..6).map(Some).collect(),
            rest: rest.clone(),
            ..PieceMesh::default()
        };
        let points = rest.iter().map(|p| LinePoint { at: *p, kind: PointKind::Turn }).collect();
        let edge = |index, name: Option<&str>, from, to| OutlineEdge { index, name: name.map(Into::into), from, to };
        let piece = Piece {
            name: "strip".into(),
            outline: PieceLine { points, closed: true, ..PieceLine::default() },
            edges: vec![edge(0, Some("hem"), 0, 2), edge(1, None, 2, 3), edge(2, None, 3, 5), edge(3, None, 5, 0)],
            mesh: Some(mesh),
            ..Piece::default()
        };
        let landmarks =
            [("left".to_owned(), Vec3::new(0.0, 1.0, 0.05)), ("knee".to_owned(), Vec3::new(0.0, 0.45, 0.0))];
        Garment {
            pieces: vec![piece],
            drape: Some(Shape { positions: vec![rest.iter().map(worn).collect()], ..Shape::default() }),
            body: Some(Body { landmarks: landmarks.into(), ..Body::default() }),
            ..Garment::default()
        }
    }

    fn length(keys: &str) -> Result<f64, String> {
        let read = read(&format!("[[measure]]\nname = \"m\"\n{keys}"), "m.toml").expect("a measure");
        point(&read[0], &roof()).map(|p| p.length)
    }

    #[test]
    fn edges_and_ways_have_their_lengths() {
        let near = |keys: &str, want: f64| {
            let got = length(keys).expect(keys);
            assert!((got - want).abs() < 1e-9, "{keys}: {got}, not {want}");
        };
        near("on = \"pattern\"\nedges = [\"strip.hem\", \"strip.1\"]", 0.4);
        near("on = \"drape\"\nedges = [\"strip.0\"]", 0.3);
        let ends = "from = { edge = \"strip.3\", share = 0.5 }\nto = { edge = \"strip.1\", share = 0.5 }\n";
        let straight = 0.3 * 0.75_f64.sqrt();
        near(&format!("on = \"drape\"\n{ends}method = \"straight\""), straight);
        near(&format!("on = \"pattern\"\n{ends}method = \"straight\""), 0.3);
        // A tape lies over the ridge as the cloth does.
        near(&format!("on = \"drape\"\n{ends}method = \"surface\""), 0.3);
        near(&format!("on = \"drape\"\n{ends}method = \"tape\""), 0.3);
        near("on = \"body\"\nfrom = \"knee\"\nto = { height = \"50 mm\" }\nmethod = \"straight\"", 0.4);
    }

    #[test]
    fn what_is_not_there_is_told() {
        for (keys, word) in [
            ("on = \"drape\"\nedges = [\"strip.top\"]", "no edge `top`"),
            ("on = \"drape\"\nedges = [\"belt.0\"]", "no piece `belt`"),
            ("on = \"body\"\nfrom = \"nose\"\nto = \"knee\"", "no landmark `nose`"),
            ("on = \"drape\"\naround = \"torso\"\nat = \"knee\"", "no segment `torso`"),
        ] {
            assert!(length(keys).expect_err(keys).contains(word), "{keys}");
        }
    }

    #[test]
    fn a_tolerance_passes_or_fails() {
        let passed = |expected: &str| {
            let text = format!(
                "[[measure]]\nname = \"m\"\non = \"pattern\"\nedges = [\"strip.hem\"]\nexpected = \"{expected}\"\n\
                 tolerance = \"2 mm\"\n"
            );
            point(&read(&text, "m.toml").expect("a measure")[0], &roof()).expect("measured").passed
        };
        assert_eq!([passed("301 mm"), passed("303 mm")], [Some(true), Some(false)]);
    }
}
