//! The vertices of a surface as attributes: places, normals, texture coordinates and the frame of a normal map.

use super::material;
use super::write::{Buffer, WriteError, floats};
use gltf_json as json;
use json::accessor::Type;
use json::mesh::Semantic;
use json::validation::Checked::{self, Valid};
use std::collections::BTreeMap;
use toile_garment::texture::{Material, PieceTexture};
use toile_garment::{Piece, Vec3};

/// Attributes of a primitive.
pub type Attributes = BTreeMap<Checked<Semantic>, json::Index<json::Accessor>>;

/// A surface of triangles, and how cloth lies on it.
pub struct Surface<'a> {
    /// Places of the vertices.
    pub positions: &'a [Vec3],
    /// Unit normals of the vertices.
    pub normals: &'a [Vec3],
    /// Triangles.
    pub triangles: &'a [[u32; 3]],
    /// How the cloth lies, if it is textured.
    pub texture: Option<&'a PieceTexture>,
    /// Material of the surface.
    pub material: Option<&'a Material>,
    /// Are texture coordinates in repeats of the bitmap, and not in metres?
    pub repeats: bool,
}

impl Surface<'_> {
    /// Writes the attributes. `piece` is named where a number is not finite.
    ///
    /// A material with bitmaps finds the texture coordinates it names, and one with a normal map finds tangents.
    pub fn attributes(
        &self,
        root: &mut json::Root,
        buffer: &mut Buffer,
        piece: &Piece,
    ) -> Result<Attributes, WriteError> {
        let mut out = Attributes::new();
        let p = floats(piece, "the position", self.positions.iter().map(|p| [p.x, p.y, p.z]))?;
        out.insert(Valid(Semantic::Positions), buffer.floats(root, &p, Type::Vec3, true));
        let n = floats(piece, "the normal", self.normals.iter().map(|n| [n.x, n.y, n.z]))?;
        out.insert(Valid(Semantic::Normals), buffer.floats(root, &n, Type::Vec3, false));
        let Some(texture) = self.texture else { return Ok(out) };
        let count = self.positions.len();
        if texture.uv_cloth.len() != count || texture.uv_packed.len() != count {
            let message = format!("piece `{}` has texture coordinates for another mesh", piece.name);
            return Err(WriteError::Damaged(message));
        }
        // glTF counts v downwards from the top of the image.
        let repeat =
            self.material.filter(|m| self.repeats && (m.image.is_some() || m.normal.is_some())).map(|m| m.repeat);
        let [along, up] = repeat.map_or([1.0; 2], |r| material::scale(r).map(f64::from));
        let cloth = texture.uv_cloth.iter().map(|[u, v]| [u * along, -v * up]);
        let cloth = floats(piece, "the texture coordinate", cloth)?;
        out.insert(Valid(Semantic::TexCoords(0)), buffer.floats(root, &cloth, Type::Vec2, false));
        let packed = floats(piece, "the packed coordinate", texture.uv_packed.iter().map(|[u, v]| [*u, 1.0 - v]))?;
        out.insert(Valid(Semantic::TexCoords(1)), buffer.shares(root, &packed, Type::Vec2));
        if self.material.is_some_and(|m| m.normal.is_some()) {
            let tangents = self.tangents(&texture.uv_cloth);
            let tangents = floats(piece, "the tangent", tangents.into_iter())?;
            out.insert(Valid(Semantic::Tangents), buffer.floats(root, &tangents, Type::Vec4, false));
        }
        Ok(out)
    }

    /// The direction of the weft at every vertex, and on which side of it the warp lies: +1 on the right side of cloth.
    fn tangents(&self, cloth: &[[f64; 2]]) -> Vec<[f64; 4]> {
        let mut along = vec![[Vec3::zeros(); 2]; self.positions.len()];
        for corners in self.triangles {
            let [weft, warp] = self.threads(corners.map(|i| i as usize), cloth);
            for i in corners {
                along[*i as usize][0] += weft;
                along[*i as usize][1] += warp;
            }
        }
        along.iter().zip(self.normals).map(|([weft, warp], normal)| frame(weft, warp, normal)).collect()
    }

    /// Weft and warp on a triangle in 3D, as long as its area on the cloth weighs.
    fn threads(&self, [a, b, c]: [usize; 3], cloth: &[[f64; 2]]) -> [Vec3; 2] {
        let [e, f] = [b, c].map(|i| self.positions[i] - self.positions[a]);
        let [[eu, ev], [fu, fv]] = [b, c].map(|i| [cloth[i][0] - cloth[a][0], cloth[i][1] - cloth[a][1]]);
        let turn = eu * fv - ev * fu;
        let sign = if turn < 0.0 { -1.0 } else { 1.0 };
        [(e * fv - f * ev) * sign, (f * eu - e * fu) * sign]
    }
}

/// A unit tangent across the normal, and the side of the warp.
fn frame(weft: &Vec3, warp: &Vec3, normal: &Vec3) -> [f64; 4] {
    let across = |v: &Vec3| (v - normal * v.dot(normal)).try_normalize(1e-12);
    // A rim has no width on the cloth: any direction across its normal will do.
    let any = || {
        let axis = if normal.x.abs() < 0.5 { Vec3::x() } else { Vec3::y() };
        across(&axis).unwrap_or(axis)
    };
    let t = across(weft).unwrap_or_else(any);
    let side = if normal.cross(&t).dot(warp) < 0.0 { -1.0 } else { 1.0 };
    [t.x, t.y, t.z, side]
}
