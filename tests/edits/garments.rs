//! The garments of these tests, each draped once.

use super::dice::Dice;
use super::support::bench::Bench;
use super::support::facts;
use serde_json::Value;
use std::ffi::OsString;
use std::path::Path;
use toile_formats::gltf;
use toile_garment::{Garment, Vec3};

/// Samples: style, fabric.
pub const SAMPLES: [(&str, &str); 3] =
    [("fitted-bodice", "cotton-shirting"), ("t-shirt", "cotton-jersey"), ("long-skirt", "wool-suiting")];

/// The garment with the deepest folds, which fall differently on both sides.
pub const CIRCLE_SKIRT: (&str, &str) = ("circle-skirt", "cotton-shirting");

/// A draped garment, with the bench that holds its pattern, body and fabric.
pub struct Draped {
    pub name: String,
    pub glb: Vec<u8>,
    pub garment: Garment,
    bench: Bench,
}

/// One of the samples, size 38.
pub fn sample(&(style, fabric): &(&str, &str)) -> Draped {
    let bench = Bench::new();
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    for (from, to) in [
        (format!("patterns/{style}.astm.dxf"), "pattern.dxf"),
        (format!("patterns/{style}.sewing.toml"), "sewing.toml"),
        ("bodies/size-38.obj".to_owned(), "body.obj"),
        ("bodies/size-38.toml".to_owned(), "body.toml"),
        (format!("fabrics/{fabric}.toml"), "fabric.toml"),
    ] {
        std::fs::copy(samples.join(from), bench.path(to)).expect("copy");
    }
    Draped::new(style, bench)
}

/// Those of a folder; patterns with marked darts are the same garments again.
pub fn outside(folder: &Path, only: &str) -> Vec<Draped> {
    let names = facts::names(folder).into_iter().filter(|n| n.contains(only) && !n.ends_with(".marked"));
    names
        .map(|name| {
            let bench = Bench::new();
            facts::write_files(&bench, folder, &name, &facts::read(folder, &name));
            Draped::new(&name, bench)
        })
        .collect()
}

const SEW: &str = "[[stage]]\nuse = \"triangulate\"\nwith.edge_length = \"14 mm\"\n[[stage]]\nuse = \"assemble\"\n\
                   [[stage]]\nuse = \"stitch\"\nwith.body = \"../../body.obj\"\nwith.fabric = \"../../fabric.toml\"\n\
                   [[stage]]\nuse = \"drape\"\n[[stage]]\nuse = \"texture\"\nwith.color = \"#9aa7c7\"\n\
                   [[stage]]\nuse = \"export-gltf\"\nwith.file = \"{out}/garment.glb\"\n";

fn chain(pattern: &str, sewing: &str) -> String {
    format!("[[stage]]\nuse = \"import-dxf\"\nwith.file = \"../../{pattern}\"\nwith.sewing = \"../../{sewing}\"\n{SEW}")
}

impl Draped {
    fn new(name: &str, bench: Bench) -> Self {
        bench.stages(&chain("pattern.dxf", "sewing.toml"));
        let said = bench.run(&[]);
        assert_eq!(said.code, 0, "{name}: {said:?}");
        let glb = std::fs::read(bench.out().join("garment.glb")).expect("GLB");
        let garment = gltf::read_stored_garment(&glb).expect("garment");
        println!(
            "{name}: {} triangles",
            garment.pieces.iter().filter_map(|p| Some(p.mesh.as_ref()?.triangles.len())).sum::<usize>()
        );
        Self { name: name.to_owned(), glb, garment, bench }
    }

    fn places(&self) -> impl Iterator<Item = &Vec3> {
        self.garment.drape.iter().flat_map(|d| d.positions.iter().flatten())
    }

    /// The lowest and the highest cloth, metres.
    pub fn heights(&self) -> [f64; 2] {
        self.places().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p.y), high.max(p.y)])
    }

    /// A place on the cloth.
    pub fn place(&self, dice: &mut Dice) -> [f64; 3] {
        let count = self.places().count();
        let p = self.places().nth(dice.below(count)).expect("a vertex");
        [p.x, p.y, p.z]
    }

    /// Puts the body of the garment and one of another size into a bench.
    pub fn copy_bodies(&self, to: &Bench, size: &str) {
        for name in ["body.obj", "body.toml"] {
            std::fs::copy(self.bench.path(name), to.path(name)).expect("copy");
        }
        let out = to.path("other.obj");
        let words: [OsString; 5] = ["body".into(), "--size".into(), size.into(), "--out".into(), out.into()];
        assert_eq!(super::support::bench::command(words.into()).code, 0);
    }

    /// Sews and drapes the pattern that was written into the results of a bench.
    pub fn sewn_again(&self, from: &Bench) -> Result<String, String> {
        let again = Bench::new();
        for name in ["body.obj", "body.toml", "fabric.toml"] {
            std::fs::copy(self.bench.path(name), again.path(name)).expect("copy");
        }
        for name in ["new.dxf", "new.sewing.toml"] {
            std::fs::copy(from.out().join(name), again.path(name)).expect("copy");
        }
        again.stages(&chain("new.dxf", "new.sewing.toml"));
        let said = again.run(&[]);
        if said.code != 0 {
            return Err(format!("exit {}: {}", said.code, said.err));
        }
        let certificate = &again.record()["certificate"];
        let words = format!("passed {}, residual {}", certificate["passed"], certificate["residual_rel"]);
        if certificate["passed"] == Value::Bool(true) { Ok(words) } else { Err(words) }
    }
}

/// CPU seconds of a stage in the record of a bench.
pub fn seconds(bench: &Bench, stage: &str) -> f64 {
    let record: Value = serde_json::from_str(&bench.output("run.json").unwrap_or_default()).unwrap_or_default();
    let all = record["stages"].as_array().into_iter().flatten();
    all.filter(|s| s["use"] == stage).filter_map(|s| s["cpu_seconds"].as_f64()).sum()
}
