//! A scene of our own making, as the files that the program reads.

use super::cloth::Cloth;
use super::mesh::Mesh;
use std::fmt::Write as _;
use std::path::Path;
use toile_garment::Vec3;

/// A scene: everything that the program reads. z is up.
#[derive(Clone)]
pub struct Trial {
    pub cloth: Mesh,
    pub fabric: Cloth,
    pub pins: Vec<(usize, Vec3)>,
    pub loads: Vec<(usize, Vec3)>,
    pub stitches: Vec<[usize; 2]>,
    pub body: Option<Mesh>,
    /// m/s².
    pub gravity: f64,
    /// More keys of the stage `drape`, as TOML: `effects.friction = "off"`.
    pub drape: Vec<String>,
    /// Stages between `drape` and the export, as TOML.
    pub stages: String,
    /// Files whose text is not what the scene says: name, text.
    pub texts: Vec<(String, String)>,
}

impl Trial {
    pub fn new(cloth: Mesh, fabric: Cloth) -> Self {
        let (pins, loads, stitches, drape) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (stages, texts, gravity) = (String::new(), Vec::new(), 9.81);
        Self { cloth, fabric, pins, loads, stitches, body: None, gravity, drape, stages, texts }
    }

    pub fn weightless(mut self) -> Self {
        self.gravity = 0.0;
        self
    }

    /// Holds vertices where they are.
    pub fn hold(mut self, vertices: impl IntoIterator<Item = usize>) -> Self {
        self.pins.extend(vertices.into_iter().map(|v| (v, self.cloth.at[v])));
        self
    }

    /// Leads vertices to places.
    pub fn lead(mut self, vertices: impl IntoIterator<Item = usize>, to: impl Fn(Vec3) -> Vec3) -> Self {
        self.pins.extend(vertices.into_iter().map(|v| (v, to(self.cloth.at[v]))));
        self
    }

    pub fn set(mut self, key: &str) -> Self {
        self.drape.push(key.to_owned());
        self
    }

    pub fn over(mut self, body: Mesh) -> Self {
        self.body = Some(body);
        self
    }

    /// Puts this text in the place of a file.
    pub fn text(mut self, file: impl Into<String>, text: String) -> Self {
        self.texts.push((file.into(), text));
        self
    }

    /// Writes the project: a pipeline of `import-mesh`, `drape` with these keys besides its own, and `export-obj`.
    pub fn write(&self, folder: &Path, more: &[String]) -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        std::fs::write(folder.join("toile.root"), "")?;
        std::fs::write(folder.join("cloth.obj"), self.cloth.obj())?;
        std::fs::write(folder.join("fabric.toml"), self.fabric.text())?;
        let import = self.import(folder)?;
        let mut drape = format!("with.gravity = \"{} m/s2\"\n", self.gravity);
        more.iter().chain(&self.drape).for_each(|key| drape += &format!("with.{key}\n"));
        let export = "with.file = \"{out}/final.obj\"\nwith.reactions = \"{out}/reactions.json\"\n";
        let text = format!(
            "toile = 1\n[pipeline]\nline = \"trial\"\nversion = 1\n[[stage]]\nuse = \"import-mesh\"\n{import}\
             [[stage]]\nuse = \"drape\"\n{drape}{}[[stage]]\nuse = \"export-obj\"\n{export}",
            self.stages
        );
        std::fs::write(folder.join("pipeline.toml"), text)?;
        self.texts.iter().try_for_each(|(file, text)| std::fs::write(folder.join(file), text))
    }

    /// Writes what `import-mesh` reads beside the cloth; gives its keys.
    fn import(&self, folder: &Path) -> std::io::Result<String> {
        let mut keys = "with.cloth = \"cloth.obj\"\nwith.fabric = \"fabric.toml\"\nwith.up = \"z\"\n".to_owned();
        if !self.cloth.rest.is_empty() {
            keys += "with.rest = \"uv\"\n";
        }
        let mut list = |name: &str, text: String| {
            if text.is_empty() {
                return Ok(());
            }
            let _ = writeln!(keys, "with.{name} = \"{name}.txt\"");
            std::fs::write(folder.join(format!("{name}.txt")), text)
        };
        let point = |v: &usize, p: &Vec3| format!("{v} {} {} {}\n", p.x, p.y, p.z);
        list("pins", self.pins.iter().map(|(v, p)| point(v, p)).collect())?;
        list("loads", self.loads.iter().map(|(v, f)| point(v, f)).collect())?;
        list("stitches", self.stitches.iter().map(|[a, b]| format!("{a} {b}\n")).collect())?;
        if let Some(body) = &self.body {
            std::fs::write(folder.join("body.obj"), body.obj())?;
            keys += "with.body = \"body.obj\"\n";
        }
        Ok(keys)
    }
}
