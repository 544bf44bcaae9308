//! A project folder of its own with samples and quick pipelines, and the program itself run in it.

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A chain that prints a pattern and drapes nothing.
pub const PRINTED: &str = "toile = 1\n[pipeline]\nline = \"printed\"\nversion = 1\n\
    [input]\nsize = { kind = \"text\", default = \"38\" }\npattern = { kind = \"path\", default = \"long-skirt.astm.dxf\" }\n\
    [[stage]]\nuse = \"import-dxf\"\nwith.file = \"{pattern}\"\nwith.sewing = \"long-skirt.sewing.toml\"\nwith.size = \"{size}\"\n\
    [[stage]]\nuse = \"export-print\"\nwith.file = \"{out}/pieces.svg\"\n";

/// A chain that drapes the skirt on a very coarse mesh.
pub const DRAPED: &str = "toile = 1\n[pipeline]\nline = \"draped\"\nversion = 1\n\
    [input]\nfabric = { kind = \"text\", default = \"wool-suiting\" }\nimage = { kind = \"text\", default = \"twill-stripe\" }\n\
    [[stage]]\nuse = \"import-dxf\"\nwith.file = \"long-skirt.astm.dxf\"\nwith.sewing = \"long-skirt.sewing.toml\"\nwith.size = \"38\"\n\
    [[stage]]\nuse = \"triangulate\"\nwith.triangles = 400\n[[stage]]\nuse = \"assemble\"\n\
    [[stage]]\nuse = \"stitch\"\nwith.body = \"size-38.obj\"\nwith.fabric = \"{fabric}.toml\"\n\
    [[stage]]\nuse = \"drape\"\n\
    [[stage]]\nuse = \"texture\"\nwith.image = \"{image}.png\"\nwith.repeat = [\"24 mm\", \"24 mm\"]\n\
    [[stage]]\nuse = \"export-gltf\"\nwith.file = \"{out}/skirt.glb\"\n\
    [[stage]]\nuse = \"export-report\"\n";

/// A project.
pub struct Project {
    pub dir: tempfile::TempDir,
}

impl Project {
    /// A folder with the files of the samples that the chains read.
    pub fn new() -> Self {
        let dir = tempfile::tempdir().expect("folder");
        std::fs::write(dir.path().join("toile.root"), "").expect("mark");
        let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
        for name in [
            "patterns/long-skirt.astm.dxf",
            "patterns/long-skirt.sewing.toml",
            "bodies/size-38.obj",
            "bodies/size-38.toml",
            "fabrics/wool-suiting.toml",
            "fabrics/linen-plain.toml",
            "textures/twill-stripe.png",
            "textures/plain-weave.png",
        ] {
            let file = Path::new(name).file_name().expect("name");
            std::fs::copy(samples.join(name), dir.path().join(file)).expect("sample");
        }
        let project = Self { dir };
        project.write("printed.toml", PRINTED);
        project.write("draped.toml", DRAPED);
        project
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("written");
    }

    /// Changes a text of a file.
    pub fn change(&self, name: &str, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.path(name)).expect("text");
        assert!(text.contains(from), "{name} has no `{from}`");
        self.write(name, &text.replace(from, to));
    }

    /// The program with these words, in the folder of the project.
    pub fn command(&self, words: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_toile"));
        command.current_dir(self.dir.path()).args(words.split(' '));
        command
    }

    /// Runs the program; gives its exit code, stdout and stderr.
    pub fn toile(&self, words: &str) -> (i32, String, String) {
        let Output { status, stdout, stderr } = self.command(words).output().expect("the program");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
        (status.code().unwrap_or(-1), text(stdout), text(stderr))
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&std::fs::read(self.path(name)).expect(name)).expect("JSON")
    }

    /// Digests of all files below a folder, without records and messages of the runs.
    pub fn digests(&self, folder: &str) -> BTreeMap<String, String> {
        let mut found = BTreeMap::new();
        walk(&self.path(folder), &mut |path| {
            let name = path.strip_prefix(self.path(folder)).expect("below").to_string_lossy().into_owned();
            if !name.ends_with("run.json") {
                found.insert(name, blake3::hash(&std::fs::read(path).expect("file")).to_hex().to_string());
            }
        });
        found
    }
}

fn walk(folder: &Path, see: &mut dyn FnMut(&Path)) {
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() { walk(&path, see) } else { see(&path) }
    }
}
