//! What a chain is expected to need, told before it runs: size of the mesh, effects, seconds, memory.
//!
//! Only files are read: pattern, sewing file, fabrics, body. Whatever a stage of another maker does is not foreseen.

mod cost;
mod effects;

use crate::import_dxf::ImportDxf;
use crate::import_mesh::ImportMesh;
use crate::stitch::{StitchParams, load};
use crate::triangulate;
use serde::de::DeserializeOwned;
use serde_json::Value;
use toile_garment::garment::EffectRecord;
use toile_garment::{Garment, Piece};
use toile_stage_api::{Stage, StageContext, StageError};

/// What one stage is expected to need; about, on two cores that do nothing else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Wall-clock seconds.
    pub seconds: f64,
    /// Memory of the whole program while the stage runs, MB.
    pub mb: f64,
}

/// The size of the mesh to come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshSize {
    /// Triangles.
    pub triangles: f64,
    /// Length of a mesh edge, metres.
    pub edge: f64,
}

/// Looks ahead along a chain, one stage after the other.
#[derive(Debug, Default)]
pub struct Outlook {
    /// What the files say: pieces, fabrics, body; never a result of work.
    garment: Garment,
    mesh: Option<MeshSize>,
    effects: Vec<EffectRecord>,
    mb: f64,
}

impl Outlook {
    /// Takes the next stage into account. `None` where nothing can be said: a stage of another maker, or no mesh before
    /// it.
    ///
    /// # Errors
    /// When a file of the stage cannot be read or is wrong.
    pub fn stage(
        &mut self,
        name: &str,
        params: &Value,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Expected>, StageError> {
        match name {
            "import-dxf" => self.garment = ImportDxf.run(&parse(params)?, Garment::default(), cx)?,
            "import-mesh" => {
                self.garment = ImportMesh.run(&parse(params)?, Garment::default(), cx)?;
                self.mesh = measure(&self.garment);
            }
            "triangulate" => self.mesh = foresee(&parse(params)?, &self.garment),
            "stitch" => {
                let params: StitchParams = parse(params)?;
                load::fabrics(&params, &mut self.garment, cx)?;
                if let Some(body) = &params.body {
                    self.garment.body = Some(load::body(body, cx)?);
                }
            }
            "drape" => self.effects = effects::effects(params, &self.garment, self.mesh),
            _ => {}
        }
        let expected = cost::of(name, self.mesh, &self.garment);
        self.mb = expected.map_or(self.mb, |e| self.mb.max(e.mb));
        // Memory that was needed once stays with the program.
        Ok(expected.map(|e| Expected { mb: self.mb, ..e }))
    }

    /// The mesh, as soon as a stage has said it.
    #[must_use]
    pub fn mesh(&self) -> Option<MeshSize> {
        self.mesh
    }

    /// The effects of the drape, each on or off, by which rule and on what evidence.
    #[must_use]
    pub fn effects(&self) -> &[EffectRecord] {
        &self.effects
    }
}

fn parse<P: DeserializeOwned>(params: &Value) -> Result<P, StageError> {
    serde_json::from_value(params.clone()).map_err(|e| StageError::Internal(format!("parameters read back: {e}")))
}

/// Triangles from the area of the cloth: a triangle of edge h covers √3/4 h².
fn foresee(params: &triangulate::Params, garment: &Garment) -> Option<MeshSize> {
    let area: f64 = garment.pieces.iter().map(cloth_area).sum();
    let share = 0.25 * 3_f64.sqrt();
    let size = match (params.triangles, params.edge_length) {
        (Some(n), _) => {
            let triangles = f64::from(n);
            MeshSize { triangles, edge: (area / (share * triangles)).sqrt() }
        }
        (None, length) => {
            let edge = length.map_or(triangulate::DEFAULT_EDGE, |l| l.0);
            MeshSize { triangles: area / (share * edge * edge), edge }
        }
    };
    (size.triangles.is_finite() && size.edge.is_finite() && size.triangles > 0.0).then_some(size)
}

fn cloth_area(piece: &Piece) -> f64 {
    let holes: f64 = piece.cutouts.iter().map(|c| c.signed_area().abs()).sum();
    (piece.outline.signed_area().abs() - holes).max(0.0)
}

/// The mesh that is there already.
fn measure(garment: &Garment) -> Option<MeshSize> {
    let meshes = || garment.pieces.iter().filter_map(|p| p.mesh.as_ref());
    let triangles: usize = meshes().map(|m| m.triangles.len()).sum();
    let area: f64 = meshes()
        .flat_map(|m| (0..m.triangles.len()).filter_map(|t| m.rest_triangle(t)))
        .map(|[a, b, c]| 0.5 * (b - a).perp(&(c - a)).abs())
        .sum();
    let triangles = triangles as f64;
    (triangles > 0.0).then(|| MeshSize { triangles, edge: (area / (0.25 * 3_f64.sqrt() * triangles)).sqrt() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::Vec2;
    use toile_garment::outline::{LinePoint, PieceLine, PointKind};
    use toile_garment::units::Length;

    fn square(side: f64) -> PieceLine {
        let corners = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]];
        let points = corners.map(|[x, y]| LinePoint { at: Vec2::new(x, y), kind: PointKind::Turn });
        PieceLine { points: points.to_vec(), closed: true, ..PieceLine::default() }
    }

    #[test]
    fn triangles_cover_the_cloth_without_its_holes() {
        let piece = Piece { outline: square(1.0), cutouts: vec![square(0.5)], ..Piece::default() };
        let garment = Garment { pieces: vec![piece], ..Garment::default() };
        let ask = |edge_length: Option<f64>, triangles| {
            let params = triangulate::Params {
                edge_length: edge_length.map(Length),
                triangles,
                ..triangulate::Params::default()
            };
            foresee(&params, &garment).expect("a size")
        };
        let by_length = ask(Some(0.01), None);
        assert!((by_length.triangles * 0.25 * 3_f64.sqrt() * 1e-4 - 0.75).abs() < 1e-12);
        let by_count = ask(None, Some(1000));
        assert!((ask(Some(by_count.edge), None).triangles - 1000.0).abs() < 1e-6);
        assert_eq!(foresee(&triangulate::Params::default(), &Garment::default()), None);
    }
}
