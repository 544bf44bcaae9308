//! Faces into triangles.

use super::codes;
use super::scan::{Corner, Scan};
use super::{MAX_ITEMS, ObjGroup, ObjMesh};
use toile_garment::{Diagnostic, SourceRef, Vec3};

/// Largest polygon that is cut by ears when a fan would fold over itself.
const MAX_EARS: usize = 1000;

/// The mesh of a scan.
pub fn mesh(scan: Scan, file: &str) -> Result<ObjMesh, Box<Diagnostic>> {
    let whole_uv = !scan.corners.is_empty() && scan.corners.iter().all(|c| c.vt.is_some());
    let mut out = ObjMesh { uv_triangles: whole_uv.then(Vec::new), ..ObjMesh::default() };
    let mut first_triangle = Vec::with_capacity(scan.faces.len());
    for face in &scan.faces {
        first_triangle.push(out.triangles.len());
        let corners = scan.corners.get(face.corners.clone()).unwrap_or_default();
        out.polygons += usize::from(corners.len() > 3);
        let points: Vec<Vec3> = corners.iter().filter_map(|c| scan.positions.get(c.v as usize).copied()).collect();
        let Some(cut) = triangles(&points) else {
            let message = format!("the face with {} corners has no simple shape to cut into triangles", corners.len());
            let finding = Diagnostic::error(codes::OBJ_POLYGON, message).at(SourceRef::file(file).at_line(face.line));
            return Err(Box::new(finding.hint("triangulate the mesh before export")));
        };
        for t in cut {
            push(&mut out, t, corners);
        }
        if out.triangles.len() > MAX_ITEMS {
            let message = format!("more than {MAX_ITEMS} triangles");
            return Err(Box::new(Diagnostic::error(codes::OBJ_TOO_MANY, message).at(SourceRef::file(file))));
        }
    }
    let end = out.triangles.len();
    out.groups = scan
        .groups
        .into_iter()
        .map(|(name, face)| ObjGroup { name, first: first_triangle.get(face).copied().unwrap_or(end) })
        .collect();
    out.faces = scan.faces.len();
    (out.positions, out.texcoords) = (scan.positions, scan.texcoords);
    (out.materials, out.ignored) = (scan.materials, scan.ignored);
    Ok(out)
}

fn push(out: &mut ObjMesh, t: [usize; 3], corners: &[Corner]) {
    let [Some(a), Some(b), Some(c)] = t.map(|i| corners.get(i)) else { return };
    out.triangles.push([a.v, b.v, c.v]);
    if let (Some(uv), Some(a), Some(b), Some(c)) = (&mut out.uv_triangles, a.vt, b.vt, c.vt) {
        uv.push([a, b, c]);
    }
}

/// Indices into the polygon: a fan from a corner from which no triangle turns over, else ears.
fn triangles(p: &[Vec3]) -> Option<Vec<[usize; 3]>> {
    let n = p.len();
    if n == 3 {
        return Some(vec![[0, 1, 2]]);
    }
    let normal = newell(p);
    // Quads try both diagonals; larger faces the fan from their first corner only.
    let starts = if n == 4 { 2 } else { 1 };
    let mut fans = (0..starts).map(|s| (1..n - 1).map(|i| [s, (s + i) % n, (s + i + 1) % n]).collect::<Vec<_>>());
    if let Some(fan) = fans.find(|fan| fan.iter().all(|t| turn(p, *t).dot(&normal) > 0.0)) {
        return Some(fan);
    }
    if normal.norm() == 0.0 {
        // No area at all: the fan is as good as anything, its triangles are dropped by whoever uses them.
        return Some((1..n - 1).map(|i| [0, i, i + 1]).collect());
    }
    if n > MAX_EARS { None } else { ears(p, normal) }
}

fn newell(p: &[Vec3]) -> Vec3 {
    let origin = p[0];
    (0..p.len()).map(|i| (p[i] - origin).cross(&(p[(i + 1) % p.len()] - origin))).sum()
}

fn turn(p: &[Vec3], [a, b, c]: [usize; 3]) -> Vec3 {
    (p[b] - p[a]).cross(&(p[c] - p[a]))
}

/// Ear cutting in the plane of the polygon's own normal.
fn ears(p: &[Vec3], normal: Vec3) -> Option<Vec<[usize; 3]>> {
    let mut ring: Vec<usize> = (0..p.len()).collect();
    let mut out = Vec::with_capacity(p.len() - 2);
    while ring.len() > 3 {
        let n = ring.len();
        let ear = (0..n).find(|i| {
            let t = [ring[(i + n - 1) % n], ring[*i], ring[(i + 1) % n]];
            turn(p, t).dot(&normal) > 0.0 && ring.iter().all(|k| t.contains(k) || !inside(p, t, *k, normal))
        })?;
        out.push([ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]]);
        ring.remove(ear);
    }
    out.push([ring[0], ring[1], ring[2]]);
    Some(out)
}

fn inside(p: &[Vec3], [a, b, c]: [usize; 3], k: usize, normal: Vec3) -> bool {
    [[a, b, k], [b, c, k], [c, a, k]].iter().all(|t| turn(p, *t).dot(&normal) >= 0.0)
}
