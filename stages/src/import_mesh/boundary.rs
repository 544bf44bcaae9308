//! The edges of an imported mesh as closed chains: the longest is the outline, the others are cutouts.

use super::codes;
use std::collections::BTreeMap;
use toile_garment::mesh::{ChainKind, MeshChain, PieceMesh};
use toile_garment::{Diagnostic, SourceRef, Vec2};

/// The triangles at an edge: how many, and its ends as the first of them runs, its length at rest.
pub struct Users {
    pub count: u32,
    ends: [u32; 2],
    length: f64,
}

/// The triangles at every edge, by its ends, the lower first.
pub fn users(mesh: &PieceMesh) -> BTreeMap<[u32; 2], Users> {
    let mut users: BTreeMap<[u32; 2], Users> = BTreeMap::new();
    for (t, corners) in mesh.triangles.iter().enumerate() {
        let rest = mesh.rest_triangle(t).unwrap_or([Vec2::zeros(); 3]);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let entry = users.entry([a.min(b), a.max(b)]).or_insert(Users { count: 0, ends: [a, b], length: 0.0 });
            entry.count += 1;
            entry.length = (rest[(k + 1) % 3] - rest[k]).norm();
        }
    }
    users
}

/// Chains of boundary edges, the cloth on their left. Where they cannot be told apart (two corners that touch), the
/// walk takes the edge of the lowest vertex; edges of three triangles are a warning.
pub fn chains(mesh: &PieceMesh, file: &str, findings: &mut Vec<Diagnostic>) -> Vec<MeshChain> {
    let users = users(mesh);
    let crowded = users.values().filter(|u| u.count > 2).count();
    if crowded > 0 {
        let message = format!("`{file}`: {crowded} edges belong to more than two triangles");
        findings.push(Diagnostic::warning(codes::MESH_NOT_MANIFOLD, message).at(SourceRef::file(file)));
    }
    let mut next: BTreeMap<u32, Vec<(u32, f64)>> = BTreeMap::new();
    for u in users.into_values().filter(|u| u.count == 1) {
        next.entry(u.ends[0]).or_default().push((u.ends[1], u.length));
    }
    for out in next.values_mut() {
        out.sort_by_key(|(v, _)| std::cmp::Reverse(*v));
    }
    let mut loops: Vec<(f64, Vec<u32>)> = Vec::new();
    while let Some(start) = next.keys().next().copied() {
        let (mut at, mut length, mut vertices) = (start, 0.0, Vec::new());
        while let Some(out) = next.get_mut(&at) {
            let Some((to, l)) = out.pop() else { break };
            if out.is_empty() {
                next.remove(&at);
            }
            vertices.push(at);
            length += l;
            at = to;
            if at == start {
                break;
            }
        }
        // A walk that does not come home stems from triangles of mixed winding; it bounds nothing.
        if at == start && vertices.len() > 2 {
            loops.push((length, vertices));
        }
    }
    loops.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
    let kind = |i: usize| if i == 0 { ChainKind::Outline } else { ChainKind::Cutout };
    loops
        .into_iter()
        .enumerate()
        .map(|(i, (_, vertices))| MeshChain {
            kind: kind(i),
            index: i.saturating_sub(1) as u32,
            vertices,
            closed: true,
        })
        .collect()
}
