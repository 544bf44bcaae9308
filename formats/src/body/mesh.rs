//! The body's mesh made sound: merged, without flat triangles, facing outwards.

use super::codes;
use super::place;
use crate::codes::BODY_SIZE;
use crate::obj::ObjMesh;
use std::collections::BTreeMap;
use toile_garment::{Code, Diagnostic, Severity, Tally, Vec3};

/// Height of a body that needs no question, metres: a doll to a giant.
const HEIGHT: std::ops::RangeInclusive<f64> = 0.2..=3.0;

pub type Mesh = (Vec<Vec3>, Vec<[u32; 3]>);

/// Cleans the mesh; what was done stands in the findings.
pub fn clean(raw: &ObjMesh, file: &str, findings: &mut Vec<Diagnostic>) -> Result<Mesh, Box<Diagnostic>> {
    let mut note = |severity, code: Code, count: usize, words: &str| {
        if count > 0 {
            findings.push(Diagnostic::new(severity, code, format!("`{file}`: {count} {words}")).at(place(file)));
        }
    };
    // A body that is closed as it stands keeps its vertices, also where two of them touch.
    let given = edges(raw.positions.len(), &raw.triangles);
    let closed = count(&given).0 == 0;
    let (positions, mapped, merged, unused) = merge(raw, !closed);
    note(Severity::Info, codes::BODY_VERTICES_MERGED, merged, "vertices at the place of another were merged");
    note(Severity::Info, codes::BODY_VERTICES_UNUSED, unused, "vertices belong to no face and were left out");
    let (mut triangles, flat, double) = sound(&positions, mapped);
    for (code, which, words) in [
        (codes::BODY_TRIANGLES_FLAT, flat, "triangles without area were left out"),
        (codes::BODY_TRIANGLES_DOUBLE, double, "triangles that stand twice were left out"),
    ] {
        note(Severity::Warning, code, which.count(), &format!("{words}: number {which}"));
    }
    if triangles.is_empty() {
        let finding = Diagnostic::error(codes::BODY_EMPTY, format!("`{file}` has no triangle with area"));
        return Err(Box::new(finding.at(place(file))));
    }
    let edges = if triangles == raw.triangles { given } else { edges(positions.len(), &triangles) };
    let (open, crowded, mixed) = count(&edges);
    if mixed > 0 {
        let message = format!("`{file}`: along {mixed} edges the two triangles face opposite ways");
        let finding = Diagnostic::error(codes::BODY_FACES_MIXED, message).at(place(file));
        return Err(Box::new(finding.hint("make all faces point outwards (recalculate the normals) and export again")));
    }
    note(
        Severity::Warning,
        codes::BODY_OPEN,
        open,
        "open edges: the body is not closed, inside and outside are guessed",
    );
    note(Severity::Warning, codes::BODY_NOT_MANIFOLD, crowded, "edges belong to more than two triangles");
    let turned = turn_outwards(&positions, &mut triangles, &edges);
    note(Severity::Warning, codes::BODY_INSIDE_OUT, turned, "triangles faced inwards and were turned");
    Ok((positions, triangles))
}

/// Vertices at bit-equal places become one, if asked; those of no face go.
fn merge(raw: &ObjMesh, together: bool) -> (Vec<Vec3>, Vec<[u32; 3]>, usize, usize) {
    let mut used = vec![false; raw.positions.len()];
    for i in raw.triangles.iter().flatten() {
        used[*i as usize] = true;
    }
    let mut first: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let mut target = vec![0u32; raw.positions.len()];
    let mut positions = Vec::new();
    let mut merged = 0;
    for (i, p) in raw.positions.iter().enumerate().filter(|(i, _)| used[*i]) {
        let next = positions.len() as u32;
        let key = [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
        let id = if together { *first.entry(key).or_insert(next) } else { next };
        if id == next {
            positions.push(*p);
        } else {
            merged += 1;
        }
        target[i] = id;
    }
    let triangles = raw.triangles.iter().map(|t| t.map(|i| target[i as usize])).collect();
    let unused = used.iter().filter(|u| !**u).count();
    (positions, triangles, merged, unused)
}

/// Without flat triangles and doubles, and which those were.
fn sound(positions: &[Vec3], triangles: Vec<[u32; 3]>) -> (Vec<[u32; 3]>, Tally, Tally) {
    let key = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| positions[i as usize]);
        let mut sorted = *t;
        sorted.sort_unstable();
        let flat = sorted[0] == sorted[1] || sorted[1] == sorted[2] || (b - a).cross(&(c - a)).norm() == 0.0;
        (!flat).then_some(sorted)
    };
    let keys: Vec<_> = triangles.iter().map(key).collect();
    let mut order: Vec<_> = keys.iter().zip(0u32..).filter_map(|(k, t)| k.map(|k| (k, t))).collect();
    order.sort_unstable();
    let mut again = vec![false; triangles.len()];
    order.windows(2).filter(|w| w[0].0 == w[1].0).for_each(|w| again[w[1].1 as usize] = true);
    let (mut flat, mut double) = (Tally::default(), Tally::default());
    let mut out = Vec::with_capacity(triangles.len());
    for (k, t) in triangles.into_iter().enumerate() {
        match keys[k] {
            None => flat.add(k),
            Some(_) if again[k] => double.add(k),
            Some(_) => out.push(t),
        }
    }
    (out, flat, double)
}

/// A triangle's side on an edge: its vertices, the smaller first, the triangle, and whether it runs from the smaller to
/// the larger.
type Side = ((u32, u32), u32, bool);

/// The sides of all triangles, edge by edge: dealt out by their smaller vertices and sorted there, as a body of a
/// million triangles has three million.
struct Edges(Vec<Side>);

impl Edges {
    fn each(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|p, q| p.0 == q.0)
    }
}

fn edges(vertices: usize, triangles: &[[u32; 3]]) -> Edges {
    let of = |(t, [a, b, c]): (u32, &[u32; 3])| {
        let sides = [(*a, *b), (*b, *c), (*c, *a)];
        sides.map(|(from, to)| ((from.min(to), from.max(to)), t, from < to)).into_iter().filter(|s| s.0.0 != s.0.1)
    };
    let each = || (0u32..).zip(triangles).flat_map(of);
    let mut next = vec![0usize; vertices + 1];
    each().for_each(|s| next[s.0.0 as usize + 1] += 1);
    (0..vertices).for_each(|v| next[v + 1] += next[v]);
    let mut sides = vec![((0, 0), 0, false); next[vertices]];
    for s in each() {
        let place = &mut next[s.0.0 as usize];
        sides[*place] = s;
        *place += 1;
    }
    sides.chunk_by_mut(|p, q| p.0.0 == q.0.0).for_each(<[Side]>::sort_unstable);
    Edges(sides)
}

/// Open edges, edges of more than two triangles, edges whose two triangles disagree.
fn count(edges: &Edges) -> (usize, usize, usize) {
    let mut counts = (0, 0, 0);
    for users in edges.each() {
        match users {
            [_] => counts.0 += 1,
            [(_, _, a), (_, _, b)] => counts.2 += usize::from(a == b),
            _ => counts.1 += 1,
        }
    }
    counts
}

/// Turns every connected part of negative volume; gives the number of turned triangles.
fn turn_outwards(positions: &[Vec3], triangles: &mut [[u32; 3]], edges: &Edges) -> usize {
    let part = parts(triangles.len(), edges);
    let mut volume: BTreeMap<u32, f64> = BTreeMap::new();
    let mut origin: BTreeMap<u32, Vec3> = BTreeMap::new();
    for (t, p) in triangles.iter().zip(&part) {
        let [a, b, c] = t.map(|i| positions[i as usize]);
        // A point of the part itself: the volume of an open part depends on it least.
        let o = *origin.entry(*p).or_insert(a);
        *volume.entry(*p).or_insert(0.0) += (a - o).dot(&(b - o).cross(&(c - o)));
    }
    let mut turned = 0;
    for (t, p) in triangles.iter_mut().zip(&part) {
        if volume.get(p).is_some_and(|v| *v < 0.0) {
            t.swap(1, 2);
            turned += 1;
        }
    }
    turned
}

/// Number of the connected part of each triangle (its lowest triangle).
fn parts(count: usize, edges: &Edges) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..count as u32).collect();
    fn root(parent: &mut [u32], mut i: u32) -> u32 {
        while parent[i as usize] != i {
            parent[i as usize] = parent[parent[i as usize] as usize];
            i = parent[i as usize];
        }
        i
    }
    for users in edges.each() {
        for pair in users.windows(2) {
            let (a, b) = (root(&mut parent, pair[0].1), root(&mut parent, pair[1].1));
            parent[a.max(b) as usize] = a.min(b);
        }
    }
    (0..count as u32).map(|i| root(&mut parent, i)).collect()
}

/// A finding when the height is not one of a person in metres. An error for a body with measures, else a warning: a
/// test scene may hold a ball.
pub fn size(raw: &ObjMesh, file: &str, person: bool) -> Option<Diagnostic> {
    let [low, high] = raw.bounds()?;
    let height = high.y - low.y;
    if HEIGHT.contains(&height) {
        return None;
    }
    let units = [("millimetres", 1e-3), ("centimetres", 1e-2), ("inches", 0.0254), ("decimetres", 0.1)];
    let guess = units.iter().find(|(_, f)| (1.0..=2.4).contains(&(height * f)));
    let severity = if person { Severity::Error } else { Severity::Warning };
    let message = format!("`{file}` is {:.3} m high; a body is between 0.2 m and 3 m", height);
    let hint = guess.map_or_else(
        || "a body file holds metres, y up".to_owned(),
        |(unit, _)| format!("the file looks like {unit}; a body file holds metres, y up"),
    );
    Some(Diagnostic::new(severity, BODY_SIZE, message).at(place(file)).hint(hint))
}
