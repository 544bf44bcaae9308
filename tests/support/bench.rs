//! A project folder of its own for one test, and the command line run in it.

use super::stages::registry;
use serde_json::Value;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use toile::engine::Stop;

/// Head of a small pipeline.
pub const HEAD: &str = "toile = 1\n[pipeline]\nline = \"test\"\nversion = 1\n";

/// The stages that sew the sample skirt, from its files beside the pipeline.
pub const SKIRT_STAGES: &str = "[[stage]]
use = \"import-dxf\"
with.file = \"skirt.dxf\"
with.sewing = \"skirt.sewing.toml\"
with.size = \"38\"
[[stage]]
use = \"triangulate\"
with.triangles = 150
[[stage]]
use = \"assemble\"
[[stage]]
use = \"stitch\"
with.body = \"body.obj\"
with.fabric = \"fabric.toml\"
";

/// A project: its root holds `toile.root`, the pipeline lies two folders below it.
pub struct Bench {
    pub dir: tempfile::TempDir,
}

/// The output of a command.
#[derive(Debug)]
pub struct Said {
    pub code: u8,
    pub out: String,
    pub err: String,
}

impl Bench {
    pub fn new() -> Self {
        let dir = tempfile::tempdir().expect("folder");
        std::fs::write(dir.path().join("toile.root"), "").expect("mark");
        std::fs::create_dir_all(dir.path().join("pipelines/test")).expect("folder");
        Self { dir }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    pub fn pipeline_file(&self) -> PathBuf {
        self.path("pipelines/test/v1.toml")
    }

    pub fn out(&self) -> PathBuf {
        self.path("result")
    }

    /// Copies a file of the samples beside the pipeline.
    pub fn sample(&self, from: &str, name: &str) -> &Self {
        let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
        std::fs::copy(samples.join(from), self.path("pipelines/test").join(name)).expect("copy");
        self
    }

    /// Copies the pattern, the sewing file, the fabric and the side file of the body of the sample skirt.
    pub fn sample_skirt(&self) -> &Self {
        self.sample("patterns/long-skirt.astm.dxf", "skirt.dxf")
            .sample("patterns/long-skirt.sewing.toml", "skirt.sewing.toml")
            .sample("bodies/size-38.toml", "body.toml")
            .sample("fabrics/wool-suiting.toml", "fabric.toml")
    }

    /// Writes the pipeline: the head and these stages.
    pub fn stages(&self, stages: &str) -> &Self {
        self.text(&format!("{HEAD}{stages}"))
    }

    /// Writes a file beside the pipeline.
    pub fn file(&self, name: &str, text: &str) -> &Self {
        std::fs::write(self.path("pipelines/test").join(name), text).expect("file");
        self
    }

    pub fn text(&self, text: &str) -> &Self {
        std::fs::write(self.pipeline_file(), text).expect("pipeline");
        self
    }

    pub fn run(&self, more: &[&str]) -> Said {
        let (file, out) = (self.pipeline_file(), self.out());
        let mut arguments: Vec<OsString> =
            vec!["run".into(), file.into(), "--out".into(), out.into(), "--quiet".into()];
        arguments.extend(more.iter().map(OsString::from));
        command(arguments)
    }

    pub fn check(&self, more: &[&str]) -> Said {
        let mut arguments: Vec<OsString> = vec!["check".into(), self.pipeline_file().into()];
        arguments.extend(more.iter().map(OsString::from));
        command(arguments)
    }

    /// Codes and places of what `check` finds.
    pub fn findings(&self, more: &[&str]) -> Vec<(String, u64, u64, String)> {
        let said = self.check(&[&["--format", "json"], more].concat());
        let value: Value = serde_json::from_str(&said.out).expect("JSON");
        let list = value["findings"].as_array().expect("findings").clone();
        list.iter()
            .map(|f| {
                let number = |k: &str| f["source"][k].as_u64().unwrap_or(0);
                let text = format!("{} {}", f["message"].as_str().unwrap_or(""), f["hint"].as_str().unwrap_or(""));
                (f["code"].as_str().unwrap_or("").to_owned(), number("line"), number("column"), text)
            })
            .collect()
    }

    pub fn record(&self) -> Value {
        let text = std::fs::read_to_string(self.out().join("run.json")).expect("run.json");
        serde_json::from_str(&text).expect("JSON")
    }

    pub fn output(&self, name: &str) -> Option<String> {
        std::fs::read_to_string(self.out().join(name)).ok()
    }

    /// All files of the output folder.
    pub fn left(&self) -> Vec<String> {
        list(&self.out())
    }
}

pub fn list(folder: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut names: Vec<String> = entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The command line in this process, with the stages for tests.
pub fn command(arguments: Vec<OsString>) -> Said {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let arguments = std::iter::once(OsString::from("toile")).chain(arguments);
    let code = toile::cli::run_from(arguments, registry(), &Stop::new(), &mut out, &mut err);
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    Said { code, out: text(out), err: text(err) }
}
