//! The draft mesh: lyon's tessellation of a layout, with the layout's own vertices by their ids.

use super::super::layout::Layout;
use super::super::regular::{FillError, Filled, middle};
use super::super::smooth::cross;
use super::Frame;
use super::fill_rule::RULE;
use crate::sewing::ring::snap;
use lyon::path::Path;
use lyon::tessellation::{
    FillGeometryBuilder, FillOptions, FillTessellator, FillVertex, GeometryBuilder, GeometryBuilderError, VertexId,
};

/// The closed boundary of a layout as a path, and the vertex of every endpoint in path order.
fn path(layout: &Layout) -> (Path, Vec<u32>) {
    let frame = Frame(snap(middle(&layout.points)));
    let mut builder = Path::builder();
    let mut ids = Vec::new();
    for (k, _) in layout.kinds.iter().enumerate().filter(|(_, (kind, _))| kind.bounds_cloth()) {
        for (i, v) in layout.chains[k].iter().enumerate() {
            let p = frame.to(layout.points[*v as usize]);
            if i == 0 {
                builder.begin(p);
            } else {
                builder.line_to(p);
            }
            ids.push(*v);
        }
        builder.end(true);
    }
    (builder.build(), ids)
}

/// Takes triangles with the layout's own vertices; lyon's positions are never used.
struct Collector {
    of_endpoint: std::collections::BTreeMap<u32, u32>,
    vertices: Vec<Option<u32>>,
    triangles: Vec<[u32; 3]>,
}

impl GeometryBuilder for Collector {
    fn add_triangle(&mut self, a: VertexId, b: VertexId, c: VertexId) {
        self.triangles.push([a.0, b.0, c.0]);
    }
}

impl FillGeometryBuilder for Collector {
    fn add_fill_vertex(&mut self, vertex: FillVertex<'_>) -> Result<VertexId, GeometryBuilderError> {
        let id = VertexId(u32::try_from(self.vertices.len()).map_err(|_| GeometryBuilderError::TooManyVertices)?);
        let found = vertex.as_endpoint_id().and_then(|e| self.of_endpoint.get(&e.0).copied()).or_else(|| {
            vertex.sources().find_map(|s| match s {
                lyon::tessellation::VertexSource::Endpoint { id } => self.of_endpoint.get(&id.0).copied(),
                lyon::tessellation::VertexSource::Edge { .. } => None,
            })
        });
        self.vertices.push(found);
        Ok(id)
    }
}

/// The draft mesher: lyon's triangles, halved until their inner edges are about `h` long, metres. Inner lines are not
/// kept.
///
/// # Errors
/// When lyon finds a crossing.
pub fn fill(layout: &Layout, h: f64) -> Result<Filled, FillError> {
    let (path, ids) = path(layout);
    let of_endpoint = path
        .id_iter()
        .filter_map(|event| match event {
            lyon::path::IdEvent::Begin { at } => Some(at.0),
            lyon::path::IdEvent::Line { to, .. } => Some(to.0),
            _ => None,
        })
        .zip(ids)
        .collect();
    let mut out = Collector { of_endpoint, vertices: Vec::new(), triangles: Vec::new() };
    let options = FillOptions::default().with_fill_rule(RULE).with_tolerance(1e-3);
    FillTessellator::new()
        .tessellate_with_ids(path.id_iter(), &path, None, &options, &mut out)
        .map_err(|_| FillError::Points)?;
    let mut triangles = Vec::with_capacity(out.triangles.len());
    for t in &out.triangles {
        let [Some(a), Some(b), Some(c)] = t.map(|v| out.vertices.get(v as usize).copied().flatten()) else {
            return Err(FillError::Points);
        };
        if a == b || b == c || c == a {
            continue;
        }
        // lyon winds as it likes.
        let [pa, pb, pc] = [a, b, c].map(|v| layout.points[v as usize]);
        triangles.push(if cross(pa, pb, pc) < 0.0 { [a, c, b] } else { [a, b, c] });
    }
    let mut points = layout.points.clone();
    super::flips::refine(&mut points, &layout.all_edges().0, &mut triangles, h);
    Ok((points, triangles))
}
