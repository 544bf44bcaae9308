//! Patterns as DXF files: pieces with a grain line and a material, which a GarmentCode specification does not have.

use crate::pattern::pipeline;
use crate::support::cloth::Cloth;
use std::fmt::Write as _;
use std::path::Path;

/// A piece of straight edges; edge k goes from corner k to the next.
pub struct Sheet {
    pub name: &'static str,
    /// mm.
    pub corners: Vec<[f64; 2]>,
    /// A line in the middle of the piece, degrees from +x: the warp.
    pub grain: f64,
    pub material: &'static str,
    /// Coordinates from the drawing's origin, mm; y is up.
    pub translation: [f64; 3],
    /// Faces backwards.
    pub back: bool,
}

/// A pattern of such pieces, its fabrics and its body.
pub struct Drawing {
    pub sheets: Vec<Sheet>,
    /// Seams and what else the sewing file says.
    pub sewing: String,
    /// By material; the first is that of pieces without one.
    pub fabrics: Vec<(&'static str, Cloth)>,
    /// A body as OBJ, y up, and its side file.
    pub body: Option<(String, String)>,
    /// Length of a mesh edge, mm.
    pub edge: f64,
    /// Keys of the drape as TOML.
    pub drape: Vec<String>,
}

impl Drawing {
    /// Writes the project: pieces, mesh, seams, sewing, drape, texture, OBJ and GLB.
    pub fn write(&self, folder: &Path, accuracy: Option<&str>) -> std::io::Result<()> {
        std::fs::write(folder.join("toile.root"), "")?;
        std::fs::write(folder.join("pattern.dxf"), self.dxf())?;
        std::fs::write(folder.join("sewing.toml"), format!("{}{}", self.sewing, self.places()))?;
        let mut stitch = format!("with.fabric = \"{}.toml\"\n", self.fabrics[0].0);
        for (name, fabric) in &self.fabrics {
            std::fs::write(folder.join(format!("{name}.toml")), fabric.text())?;
            stitch += &format!("with.fabrics.{name} = \"{name}.toml\"\n");
        }
        if let Some((body, side)) = &self.body {
            std::fs::write(folder.join("body.obj"), body)?;
            std::fs::write(folder.join("body.toml"), side)?;
            stitch += "with.body = \"body.obj\"\n";
        }
        let import = "use = \"import-dxf\"\nwith.file = \"pattern.dxf\"\nwith.sewing = \"sewing.toml\"\n";
        let after = "[[stage]]\nuse = \"texture\"\n";
        let text = pipeline([import, &stitch, after], self.edge, accuracy, &self.drape);
        std::fs::write(folder.join("pipeline.toml"), text)
    }

    fn places(&self) -> String {
        let place = |s: &Sheet| {
            let turn = if s.back { "[[-1, 0, 0], [0, 1, 0], [0, 0, -1]]" } else { "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]" };
            let [x, y, z] = s.translation;
            format!(
                "[[place]]\npiece = \"{}\"\nrotation = {turn}\ntranslation = [\"{x} mm\", \"{y} mm\", \"{z} mm\"]\n",
                s.name
            )
        };
        self.sheets.iter().map(place).collect()
    }

    fn dxf(&self) -> String {
        let mut text = pairs(&["0 SECTION", "2 BLOCKS"]);
        self.sheets.iter().for_each(|s| text += &s.block());
        text += &pairs(&["0 ENDSEC", "0 SECTION", "2 ENTITIES"]);
        self.sheets.iter().for_each(|s| text += &pairs(&["0 INSERT", "8 1", &format!("2 {}", s.name), "10 0", "20 0"]));
        for words in ["Style Name: DRAWING", "Sample Size: 38", "Units: METRIC"] {
            text += &label([0.0, -50.0], words);
        }
        text + &pairs(&["0 ENDSEC", "0 EOF"])
    }
}

impl Sheet {
    fn block(&self) -> String {
        let mut text = pairs(&["0 BLOCK", "8 1", &format!("2 {}", self.name), "70 0", "10 0", "20 0"]);
        text += &pairs(&["0 POLYLINE", "8 1", "66 1", "70 1"]);
        for [x, y] in &self.corners {
            text += &pairs(&["0 VERTEX", "8 1", &format!("10 {x}"), &format!("20 {y}")]);
        }
        text += &pairs(&["0 SEQEND", "8 1", "0 LINE", "8 7"]);
        let [x, y] = self.middle();
        let (s, c) = libm::sincos(self.grain.to_radians());
        for (code, d) in [(10, -20.0), (11, 20.0)] {
            let _ = writeln!(text, "{code}\n{}\n{}\n{}", x + d * c, code + 10, y + d * s);
        }
        for (name, value) in [("Piece Name", self.name), ("Size", "38"), ("Quantity", "1"), ("Material", self.material)]
        {
            text += &label([x, y], &format!("{name}: {value}"));
        }
        text + &pairs(&["0 ENDBLK", "8 1"])
    }

    fn middle(&self) -> [f64; 2] {
        let n = self.corners.len() as f64;
        [0, 1].map(|k| self.corners.iter().map(|c| c[k]).sum::<f64>() / n)
    }
}

/// Group codes and values, each on a line of its own.
fn pairs(list: &[&str]) -> String {
    list.iter().map(|p| format!("{}\n", p.replacen(' ', "\n", 1))).collect()
}

fn label([x, y]: [f64; 2], words: &str) -> String {
    pairs(&["0 TEXT", "8 1", &format!("10 {x}"), &format!("20 {y}"), "40 5", &format!("1 {words}")])
}
