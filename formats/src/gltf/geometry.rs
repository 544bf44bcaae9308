//! The meshes of a GLB in world coordinates.

use super::{ReadError, check, container, squeeze};
use gltf_json as json;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use toile_garment::Vec3;

/// Most vertices of all meshes together.
const MAX_VERTICES: usize = 20_000_000;

/// A sound GLB.
pub struct Sound<'a> {
    pub document: gltf::Document,
    pub bin: &'a [u8],
}

/// A node with a mesh.
#[derive(Clone, Debug, Default)]
pub struct Placed {
    pub node: String,
    pub mesh: String,
    /// `extras.piece` of the node, else of the mesh.
    pub piece: Option<String>,
    /// World positions, metres.
    pub positions: Vec<Vec3>,
    /// TEXCOORD_0, where every part of the mesh has it.
    pub uv: Option<Vec<[f64; 2]>>,
    pub triangles: Vec<[u32; 3]>,
}

/// Container, JSON and every index checked.
pub fn open(bytes: &[u8]) -> Result<Sound<'_>, ReadError> {
    let chunks = container::split(bytes)?;
    let root: json::Root = serde_json::from_slice(chunks.json).map_err(|e| ReadError::Damaged(e.to_string()))?;
    if root.extensions_required.iter().any(|e| e == squeeze::EXTENSION) {
        let message = "its vertices are packed (EXT_meshopt_compression), which this program writes and does not read; \
                       use the GLB without `compression`, or unpack it with another program";
        return Err(ReadError::Geometry(message.to_owned()));
    }
    check::check(&root, chunks.bin)?;
    let document =
        guarded(|| gltf::Document::from_json(root).map_err(|e| ReadError::Damaged(one_line(&e.to_string()))))?;
    Ok(Sound { document, bin: chunks.bin.unwrap_or_default() })
}

fn one_line(text: &str) -> String {
    text.lines().map(str::trim).collect::<Vec<_>>().join(" ").chars().take(500).collect()
}

/// The last net under the `gltf` crate: what it panics on is a damaged file, and a mistake of our checks.
pub fn guarded<T>(work: impl FnOnce() -> Result<T, ReadError>) -> Result<T, ReadError> {
    catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|_| Err(ReadError::Damaged("it holds values that the glTF reader cannot take".to_owned())))
}

type Matrix = [[f64; 4]; 4];

/// All meshes that hang on the scene, in the order of their nodes.
pub fn placed(sound: &Sound<'_>) -> Result<Vec<Placed>, ReadError> {
    guarded(|| {
        let mut found: BTreeMap<usize, Placed> = BTreeMap::new();
        let mut vertices = 0usize;
        let scene = sound.document.default_scene().or_else(|| sound.document.scenes().next());
        let mut stack: Vec<(gltf::Node<'_>, Option<Matrix>)> =
            scene.iter().flat_map(|s| s.nodes()).map(|n| (n, None)).collect();
        while let Some((node, above)) = stack.pop() {
            let world = combine(above, &node)?;
            if let Some(mesh) = node.mesh() {
                let placed = read_mesh(&node, &mesh, world, sound.bin)?;
                vertices = vertices.saturating_add(placed.positions.len());
                if vertices > MAX_VERTICES {
                    return Err(ReadError::Damaged(format!("more than {MAX_VERTICES} vertices")));
                }
                found.insert(node.index(), placed);
            }
            stack.extend(node.children().map(|c| (c, world)));
        }
        Ok(found.into_values().collect())
    })
}

/// The world matrix of a node, columns first; `None` is the identity.
fn combine(above: Option<Matrix>, node: &gltf::Node<'_>) -> Result<Option<Matrix>, ReadError> {
    let own = node.transform().matrix().map(|c| c.map(f64::from));
    let identity: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    if own == identity {
        return Ok(above);
    }
    let world = match above {
        None => own,
        Some(a) => std::array::from_fn(|c| std::array::from_fn(|r| (0..4).map(|k| a[k][r] * own[c][k]).sum())),
    };
    if world.iter().flatten().all(|x: &f64| x.is_finite()) {
        Ok(Some(world))
    } else {
        Err(ReadError::Damaged(format!("the transform of node {} is not finite", node.index())))
    }
}

fn apply(world: Option<Matrix>, p: [f32; 3]) -> Vec3 {
    let p = p.map(f64::from);
    match world {
        None => Vec3::new(p[0], p[1], p[2]),
        Some(m) => Vec3::from_fn(|r, _| m[0][r] * p[0] + m[1][r] * p[1] + m[2][r] * p[2] + m[3][r]),
    }
}

fn read_mesh(
    node: &gltf::Node<'_>,
    mesh: &gltf::Mesh<'_>,
    world: Option<Matrix>,
    bin: &[u8],
) -> Result<Placed, ReadError> {
    let name = |n: Option<&str>| n.unwrap_or_default().to_owned();
    let mut out = Placed {
        node: name(node.name()),
        mesh: name(mesh.name()),
        piece: piece_of(node.extras()).or_else(|| piece_of(mesh.extras())),
        uv: Some(Vec::new()),
        ..Placed::default()
    };
    let damaged = |what: &str| ReadError::Damaged(format!("mesh `{}`: {what}", out.mesh));
    let (mut positions, mut triangles, mut uv) = (Vec::new(), Vec::new(), Some(Vec::new()));
    for primitive in mesh.primitives() {
        if primitive.mode() != gltf::mesh::Mode::Triangles {
            continue;
        }
        let reader = primitive.reader(|buffer| (buffer.index() == 0).then_some(bin));
        let base = positions.len();
        let read = reader.read_positions().ok_or_else(|| damaged("it has no positions"))?;
        positions.extend(read.map(|p| apply(world, p)));
        match (reader.read_tex_coords(0), &mut uv) {
            (Some(read), Some(uv)) => uv.extend(read.into_f32().map(|uv| uv.map(f64::from))),
            _ => uv = None,
        }
        let count = positions.len() - base;
        let corners: Vec<u32> = match reader.read_indices() {
            Some(read) => read.into_u32().collect(),
            None => (0..count as u32).collect(),
        };
        if !corners.len().is_multiple_of(3) || corners.iter().any(|i| *i as usize >= count) {
            return Err(damaged("its indices are no whole triangles or leave the vertices"));
        }
        let base = u32::try_from(base).map_err(|_| damaged("it is too large"))?;
        triangles.extend(corners.chunks_exact(3).map(|t| [base + t[0], base + t[1], base + t[2]]));
    }
    if positions.iter().any(|p: &Vec3| !p.iter().all(|x| x.is_finite())) {
        return Err(damaged("a position is not finite"));
    }
    (out.positions, out.triangles, out.uv) = (positions, triangles, uv);
    Ok(out)
}

fn piece_of(extras: &json::Extras) -> Option<String> {
    #[derive(serde::Deserialize)]
    struct Extras {
        piece: String,
    }
    serde_json::from_str::<Extras>(extras.as_ref()?.get()).ok().map(|e| e.piece)
}
