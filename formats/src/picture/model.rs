//! The surfaces and lines of a picture.

use super::cloth::{Look, linear};
use super::field::Field;
use crate::normals;
use std::collections::BTreeMap;
use toile_garment::mesh::PieceMesh;
use toile_garment::{Garment, Piece, Vec2, Vec3};

/// Where the colour of a surface comes from.
pub enum Skin {
    /// One colour, linear RGB.
    Plain([f64; 3]),
    /// A material by its number, with metres along weft and warp per vertex.
    Cloth(usize, Vec<[f64; 2]>),
    /// A linear colour per vertex.
    Coloured(Vec<[f64; 3]>),
}

/// A surface.
pub struct Surface {
    /// Vertices, metres.
    pub positions: Vec<Vec3>,
    /// Unit normals.
    pub normals: Vec<Vec3>,
    /// Triangles, counter-clockwise seen from the right side.
    pub triangles: Vec<[u32; 3]>,
    /// Colour.
    pub skin: Skin,
    /// True for cloth, which has a wrong side and takes the light softly; false for the body.
    pub cloth: bool,
}

/// A line on the cloth.
pub struct Line {
    /// Its points, metres.
    pub points: Vec<Vec3>,
    /// Width, metres.
    pub width: f64,
    /// Share of the light that it takes away, 0 to 1.
    pub dark: f64,
}

/// All that is drawn.
pub struct Model {
    /// Surfaces.
    pub surfaces: Vec<Surface>,
    /// Lines.
    pub lines: Vec<Line>,
    /// Materials.
    pub looks: Vec<Look>,
}

/// Colour of the body, linear RGB.
const BODY: [f64; 3] = [0.60, 0.56, 0.52];

/// A line that is as wide as a seam looks, metres.
const SEAM: f64 = 0.0022;

impl Model {
    /// The garment as it hangs, with or without its body. `None` without positions in 3D.
    #[must_use]
    pub fn worn(garment: &Garment, with_body: bool, field: Option<&Field>) -> Option<Self> {
        let shape = garment.drape.as_ref().or(garment.stitched.as_ref())?;
        let pieces = pieces(garment, |k, mesh| shape.positions.get(k).filter(|x| x.len() == mesh.rest.len()).cloned());
        let mut model = Self::of(garment, &pieces, field);
        if let Some(body) = garment.body.as_ref().filter(|b| with_body && !b.triangles.is_empty()) {
            let normals = normals::smooth(&[(&body.positions, &body.triangles)]).remove(0);
            model.surfaces.push(Surface {
                positions: body.positions.clone(),
                normals,
                triangles: body.triangles.clone(),
                skin: Skin::Plain(BODY),
                cloth: false,
            });
        }
        (!pieces.is_empty()).then_some(model)
    }

    /// The pieces side by side in the plane. `None` without a meshed piece.
    #[must_use]
    pub fn laid(garment: &Garment, field: Option<&Field>) -> Option<Self> {
        let places = lay(garment);
        let pieces = pieces(garment, |k, mesh| {
            let by = places.get(k).copied()?;
            Some(mesh.rest.iter().map(|p| Vec3::new(p.x + by.x, p.y + by.y, 0.0)).collect())
        });
        (!pieces.is_empty()).then(|| Self::of(garment, &pieces, field))
    }

    fn of(garment: &Garment, pieces: &[Placed<'_>], field: Option<&Field>) -> Self {
        let meshes: Vec<(&[Vec3], &[[u32; 3]])> =
            pieces.iter().map(|p| (p.positions.as_slice(), p.mesh.triangles.as_slice())).collect();
        let normals = normals::smooth(&meshes);
        let surface = |(p, normals): (&Placed<'_>, Vec<Vec3>)| Surface {
            positions: p.positions.clone(),
            normals,
            triangles: p.mesh.triangles.clone(),
            skin: skin(garment, p, field),
            cloth: true,
        };
        let surfaces = pieces.iter().zip(normals).map(surface).collect();
        let materials = garment.textures.iter().flat_map(|t| &t.materials);
        let looks = std::iter::once(Look::plain()).chain(materials.map(Look::of)).collect();
        Self { surfaces, lines: lines(garment, pieces), looks }
    }
}

/// Places of the pieces in the plane, side by side on shelves: what is added to their coordinates, metres.
#[must_use]
pub fn lay(garment: &Garment) -> Vec<Vec2> {
    crate::svg::pattern::places(&garment.pieces).into_iter().map(|p| p.unwrap_or_else(Vec2::zeros)).collect()
}

struct Placed<'g> {
    piece: &'g Piece,
    index: usize,
    mesh: &'g PieceMesh,
    positions: Vec<Vec3>,
}

fn pieces<'g>(garment: &'g Garment, at: impl Fn(usize, &PieceMesh) -> Option<Vec<Vec3>>) -> Vec<Placed<'g>> {
    let placed = |(index, piece): (usize, &'g Piece)| {
        let mesh = piece.mesh.as_ref()?;
        let positions = at(index, mesh)?;
        let n = positions.len();
        let sound = positions.iter().all(|p| p.iter().all(|x| x.is_finite()))
            && mesh.triangles.iter().flatten().all(|v| (*v as usize) < n);
        sound.then_some(Placed { piece, index, mesh, positions })
    };
    garment.pieces.iter().enumerate().filter_map(placed).collect()
}

fn skin(garment: &Garment, p: &Placed<'_>, field: Option<&Field>) -> Skin {
    if let Some(field) = field {
        let values = field.values.get(p.index).map_or(&[][..], Vec::as_slice);
        let value = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
        return Skin::Coloured((0..p.positions.len()).map(|i| field.colour(value(i)).map(linear)).collect());
    }
    let texture = garment.textures.as_ref().and_then(|t| Some((t.pieces.get(p.index)?, t.materials.len())));
    match texture {
        Some((t, materials)) if t.uv_cloth.len() == p.positions.len() && (t.material as usize) < materials => {
            Skin::Cloth(t.material as usize + 1, t.uv_cloth.clone())
        }
        _ => Skin::Cloth(0, vec![[0.0; 2]; p.positions.len()]),
    }
}

/// Seams and darts, and the free edges of the cloth.
fn lines(garment: &Garment, pieces: &[Placed<'_>]) -> Vec<Line> {
    let by_index: BTreeMap<usize, &Placed<'_>> = pieces.iter().map(|p| (p.index, p)).collect();
    let mut out = Vec::new();
    for seam in &garment.seams {
        for run in [&seam.a, &seam.b].into_iter().flat_map(|s| &s.runs) {
            let Some(p) = by_index.get(&run.piece.index()) else { continue };
            let points = run.vertices.iter().filter_map(|v| p.positions.get(*v as usize)).copied().collect();
            out.push(Line { points, width: SEAM, dark: 0.5 });
        }
    }
    for p in pieces {
        for chain in p.mesh.chains.iter().filter(|c| c.closed) {
            let ring = chain.vertices.iter().chain(chain.vertices.first());
            let points = ring.filter_map(|v| p.positions.get(*v as usize)).copied().collect();
            out.push(Line { points, width: 0.6 * SEAM, dark: 0.3 });
        }
        for line in p.piece.darts.iter().filter_map(|d| d.mesh.as_ref()).flat_map(|m| &m.legs) {
            let points = line.iter().filter_map(|v| p.positions.get(*v as usize)).copied().collect();
            out.push(Line { points, width: SEAM, dark: 0.5 });
        }
    }
    out
}
