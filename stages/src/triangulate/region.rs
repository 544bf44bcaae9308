//! Which triangles are cloth: a flood fill from the boundary chains, which know on which side the cloth lies.

use std::collections::BTreeSet;

/// Why the fill failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leak {
    /// An edge of the triangle that would be cloth and not cloth.
    pub edge: [u32; 2],
}

/// Keeps the triangles that lie to the left of the directed boundary edges, and all they can reach.
///
/// # Errors
/// When one triangle is on both sides: the boundary touches itself.
pub fn cloth(triangles: &[[u32; 3]], boundary: &[[u32; 2]]) -> Result<Vec<[u32; 3]>, Leak> {
    let wall: BTreeSet<[u32; 2]> = boundary.iter().copied().collect();
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(triangles.len() * 3);
    for (i, t) in triangles.iter().enumerate() {
        for k in 0..3 {
            sides.push(([t[k], t[(k + 1) % 3]], i as u32));
        }
    }
    sides.sort_unstable();
    let owner = |edge: [u32; 2]| {
        let at = sides.partition_point(|(e, _)| *e < edge);
        sides.get(at).filter(|(e, _)| *e == edge).map(|(_, t)| *t as usize)
    };
    // 1 cloth, -1 not.
    let mut mark = vec![0_i8; triangles.len()];
    let mut queue = Vec::new();
    for [a, b] in boundary {
        for (edge, value) in [([*a, *b], 1), ([*b, *a], -1)] {
            let Some(t) = owner(edge) else { continue };
            if mark[t] == -value {
                return Err(Leak { edge });
            }
            if mark[t] == 0 {
                mark[t] = value;
                queue.push(t);
            }
        }
    }
    while let Some(i) = queue.pop() {
        let t = triangles[i];
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            if wall.contains(&[a, b]) || wall.contains(&[b, a]) {
                continue;
            }
            let Some(next) = owner([b, a]) else { continue };
            if mark[next] == -mark[i] {
                return Err(Leak { edge: [a, b] });
            }
            if mark[next] == 0 {
                mark[next] = mark[i];
                queue.push(next);
            }
        }
    }
    Ok(triangles.iter().zip(&mark).filter(|(_, m)| **m == 1).map(|(t, _)| *t).collect())
}
