//! Patterns of pieces, seams and places as files that the program reads (a GarmentCode specification), and the whole
//! pipeline over them.

use crate::support::cloth::Cloth;
use serde_json::{Map, Value, json};
use std::path::Path;

/// A piece with straight edges; edge k goes from corner k to the next.
#[derive(Clone)]
pub struct Drawn {
    pub name: &'static str,
    /// mm.
    pub corners: Vec<[f64; 2]>,
    /// Coordinates from the drawing's origin, mm; y is up.
    pub translation: [f64; 3],
    /// Degrees about x, y, z.
    pub rotation: [f64; 3],
}

impl Drawn {
    pub fn at(name: &'static str, corners: &[[f64; 2]], translation: [f64; 3]) -> Self {
        Self { name, corners: corners.to_vec(), translation, rotation: [0.0; 3] }
    }

    pub fn facing(self, y_degrees: f64) -> Self {
        Self { rotation: [0.0, y_degrees, 0.0], ..self }
    }
}

/// Corners of a rectangle, mm.
pub fn rectangle(w: f64, h: f64) -> [[f64; 2]; 4] {
    [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]
}

/// The pipeline over a pattern: import, mesh (edges in mm), seams, sewing, drape, what comes `after` it, OBJ and GLB.
pub fn pipeline([import, stitch, after]: [&str; 3], edge: f64, accuracy: Option<&str>, drape: &[String]) -> String {
    let accuracy = accuracy.map(|a| format!("accuracy = \"{a}\""));
    let drape: String = accuracy.iter().chain(drape).map(|k| format!("with.{k}\n")).collect();
    format!(
        "toile = 1\n[pipeline]\nline = \"pattern\"\nversion = 1\n[[stage]]\n{import}\
         [[stage]]\nuse = \"triangulate\"\nwith.edge_length = \"{edge} mm\"\n[[stage]]\nuse = \"assemble\"\n\
         [[stage]]\nuse = \"stitch\"\n{stitch}[[stage]]\nuse = \"drape\"\n{drape}{after}\
         [[stage]]\nuse = \"export-obj\"\nwith.file = \"{{out}}/final.obj\"\n\
         [[stage]]\nuse = \"export-gltf\"\nwith.file = \"{{out}}/final.glb\"\n"
    )
}

/// A garment of pieces.
#[derive(Clone)]
pub struct Pattern {
    pub pieces: Vec<Drawn>,
    /// Piece and edge of both sides.
    pub seams: Vec<[(&'static str, usize); 2]>,
    pub fabric: Cloth,
    /// OBJ of the body, y up.
    pub body: Option<String>,
    /// Length of a mesh edge, mm.
    pub edge: f64,
    /// Keys of the drape as TOML.
    pub drape: Vec<String>,
    /// A sewing file.
    pub sewing: String,
    /// File units in a metre.
    pub per_metre: f64,
}

impl Pattern {
    pub fn new(pieces: Vec<Drawn>, seams: Vec<[(&'static str, usize); 2]>, fabric: Cloth) -> Self {
        let (body, edge, drape, sewing) = (None, 20.0, Vec::new(), String::new());
        Self { pieces, seams, fabric, body, edge, drape, sewing, per_metre: 1000.0 }
    }

    pub fn set(mut self, key: &str) -> Self {
        self.drape.push(key.to_owned());
        self
    }

    fn specification(&self) -> String {
        let panel = |p: &Drawn| {
            let n = p.corners.len();
            let edges: Vec<Value> = (0..n).map(|k| json!({ "endpoints": [k, (k + 1) % n] })).collect();
            json!({ "vertices": p.corners, "edges": edges, "translation": p.translation, "rotation": p.rotation })
        };
        let panels: Map<String, Value> = self.pieces.iter().map(|p| (p.name.to_owned(), panel(p))).collect();
        let order: Vec<&str> = self.pieces.iter().map(|p| p.name).collect();
        let side = |s: &(&str, usize)| json!({ "panel": s.0, "edge": s.1 });
        let stitches: Vec<Value> = self.seams.iter().map(|[a, b]| json!([side(a), side(b)])).collect();
        json!({ "pattern": { "panels": panels, "panel_order": order, "stitches": stitches },
                "properties": { "units_in_meter": self.per_metre } })
        .to_string()
    }

    /// Writes the project: pieces, mesh, seams, sewing, drape, OBJ and GLB.
    pub fn write(&self, folder: &Path, accuracy: Option<&str>) -> std::io::Result<()> {
        std::fs::write(folder.join("toile.root"), "")?;
        std::fs::write(folder.join("pattern.json"), self.specification())?;
        std::fs::write(folder.join("fabric.toml"), self.fabric.text())?;
        let mut import = "use = \"import-garmentcode\"\nwith.file = \"pattern.json\"\n".to_owned();
        if !self.sewing.is_empty() {
            std::fs::write(folder.join("sewing.toml"), &self.sewing)?;
            import += "with.sewing = \"sewing.toml\"\n";
        }
        let mut stitch = "with.fabric = \"fabric.toml\"\n".to_owned();
        if let Some(body) = &self.body {
            std::fs::write(folder.join("body.obj"), body)?;
            stitch += "with.body = \"body.obj\"\n";
        }
        let text = pipeline([&import, &stitch, ""], self.edge, accuracy, &self.drape);
        std::fs::write(folder.join("pipeline.toml"), text)
    }
}
