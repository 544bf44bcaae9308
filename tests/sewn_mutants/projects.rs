//! Small garments around a coarse trunk, which are sewn within 50 ms.

use super::damage::Dice;
use std::fmt::Write as _;
use std::path::Path;

/// Files of a project that are damaged.
const FILES: [&str; 6] = ["pattern.dxf", "sewing.toml", "body.obj", "body.toml", "fabric.toml", "pipeline.toml"];
/// Rings of the trunk from below: height, half width and half depth, mm.
const RINGS: [[f64; 3]; 8] = [
    [600.0, 150.0, 100.0],
    [770.0, 172.0, 108.0],
    [840.0, 177.0, 110.0],
    [950.0, 150.0, 100.0],
    [1050.0, 124.0, 92.0],
    [1220.0, 140.0, 105.0],
    [1385.0, 120.0, 80.0],
    [1450.0, 60.0, 60.0],
];
/// Vertices of a ring.
const AROUND: usize = 20;

/// A project of its own, with the undamaged bytes of its files.
pub struct Project {
    pub name: &'static str,
    dir: tempfile::TempDir,
    files: Vec<Vec<u8>>,
}

impl Project {
    /// A skirt on elastic, a skirt with darts, and the same skirt whose pieces find their places by themselves.
    pub fn all() -> Vec<Self> {
        vec![
            Self::new("gathered", "gathered-skirt", 60, |sewing| sewing),
            Self::new("darted", "long-skirt", 80, |sewing| sewing),
            Self::new("arranged", "long-skirt", 80, without_places),
        ]
    }

    fn new(name: &'static str, pattern: &str, triangles: u32, sewing: fn(String) -> String) -> Self {
        let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
        let sample = |file: String| std::fs::read_to_string(samples.join(file)).expect("sample");
        let files = vec![
            sample(format!("patterns/{pattern}.aama.dxf")),
            sewing(sample(format!("patterns/{pattern}.sewing.toml"))),
            trunk(),
            sample("bodies/size-38.toml".into()),
            sample("fabrics/wool-suiting.toml".into()),
            pipeline(triangles),
        ];
        let project = Self {
            name,
            dir: tempfile::tempdir().expect("folder"),
            files: files.into_iter().map(String::into_bytes).collect(),
        };
        std::fs::write(project.folder().join("toile.root"), "").expect("mark");
        project.restore();
        project
    }

    pub fn folder(&self) -> &Path {
        self.dir.path()
    }

    /// Damages one of the files as it lies there.
    pub fn change(&self, dice: &mut Dice, damage: fn(&[u8], &mut Dice) -> Vec<u8>) {
        let path = self.folder().join(FILES[dice.below(FILES.len())]);
        let bytes = std::fs::read(&path).expect("file");
        std::fs::write(path, damage(&bytes, dice)).expect("file");
    }

    /// Writes all files as they were.
    pub fn restore(&self) {
        for (name, bytes) in FILES.iter().zip(&self.files) {
            std::fs::write(self.folder().join(name), bytes).expect("file");
        }
    }
}

/// The sewing file up to its first `[[place]]`, and what follows the last one.
fn without_places(text: String) -> String {
    let blocks = text.split("\n[[").enumerate();
    blocks
        .filter(|(_, b)| !b.starts_with("place]]"))
        .fold(String::new(), |all, (i, block)| all + if i == 0 { "" } else { "\n[[" } + block)
}

fn pipeline(triangles: u32) -> String {
    format!(
        "toile = 1\n[pipeline]\nline = \"mutant\"\nversion = 1\n\
         [[stage]]\nuse = \"import-dxf\"\nwith.file = \"pattern.dxf\"\nwith.sewing = \"sewing.toml\"\nwith.size = \"38\"\n\
         [[stage]]\nuse = \"triangulate\"\nwith.triangles = {triangles}\nwith.angle = \"15 deg\"\n\
         [[stage]]\nuse = \"assemble\"\n\
         [[stage]]\nuse = \"stitch\"\nwith.body = \"body.obj\"\nwith.fabric = \"fabric.toml\"\nwith.clearance = \"2 mm\"\n\
         with.max_time = \"3 s\"\n\
         [[stage]]\nuse = \"export-gltf\"\nwith.file = \"{{out}}/sewn.glb\"\n\
         [[stage]]\nuse = \"export-obj\"\nwith.file = \"{{out}}/sewn.obj\"\n"
    )
}

/// A closed trunk of ellipses, in metres.
fn trunk() -> String {
    let mut text = String::new();
    for [height, width, depth] in RINGS {
        for i in 0..AROUND {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * i as f64 / AROUND as f64);
            let _ = writeln!(text, "v {:.6} {:.6} {:.6}", 1e-3 * width * sin, 1e-3 * height, 1e-3 * depth * cos);
        }
    }
    let (bottom, top) = (RINGS.len() * AROUND + 1, RINGS.len() * AROUND + 2);
    let _ = writeln!(text, "v 0 {:.6} 0\nv 0 {:.6} 0", 1e-3 * RINGS[0][0], 1e-3 * RINGS[RINGS.len() - 1][0]);
    for i in 0..AROUND {
        let [a, b] = [i, (i + 1) % AROUND].map(|i| i + 1);
        let last = (RINGS.len() - 1) * AROUND;
        let _ = writeln!(text, "f {bottom} {b} {a}\nf {top} {} {}", last + a, last + b);
        for ring in 0..RINGS.len() - 1 {
            let [a, b] = [a, b].map(|i| i + ring * AROUND);
            let _ = writeln!(text, "f {a} {b} {}\nf {a} {} {}", b + AROUND, b + AROUND, a + AROUND);
        }
    }
    text
}
