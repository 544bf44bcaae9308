//! Bodies and fabrics that come with the program, or are brought along.

use super::codes;
use super::stand::{told, upright};
use crate::engine::{MAX_INPUT, of_file_error, read_limited};
use crate::pipeline::remedy;
use std::path::{Path, PathBuf};
use toile_formats::codes::SIZE_NOT_FOUND;
use toile_garment::{Diagnostic, Severity};
use toile_stages::body::{BodyMeasures, like, measured, parametric, range};

/// Name and content of files.
type Files = Vec<(String, Vec<u8>)>;

/// Names and texts of fabric files.
macro_rules! fabrics {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../samples/fabrics/", $name, ".toml")))),*]
    };
}

/// The fabrics that come with the program.
const FABRICS: &[(&str, &str)] = &fabrics![
    "acetate-lining",
    "cotton-canvas",
    "cotton-corduroy",
    "cotton-flannel",
    "cotton-fleece",
    "cotton-interlock",
    "cotton-jersey",
    "cotton-lawn",
    "cotton-poplin",
    "cotton-shirting",
    "cotton-twill",
    "cotton-velvet",
    "cotton-voile",
    "denim-11oz",
    "denim-14oz",
    "linen-plain",
    "linen-suiting",
    "polyester-faille",
    "ponte-roma",
    "silk-chiffon",
    "silk-crepe-de-chine",
    "silk-georgette",
    "silk-habotai",
    "silk-organza",
    "silk-satin",
    "silk-taffeta",
    "viscose-challis",
    "viscose-crepe",
    "viscose-jersey",
    "wool-crepe",
    "wool-flannel",
    "wool-melton",
    "wool-suiting",
    "wool-tropical",
];

/// The body of a folder.
#[derive(Clone, Debug)]
pub enum Body {
    /// Made of a size.
    Size(String),
    /// A mesh.
    File(PathBuf),
}

/// The usual size. Its body comes with the program, for drawing one takes most of the time of `toile new`. A test draws it
/// anew and compares the bytes.
const DRAWN: &str = "38";
const DRAWN_MESH: &str = include_str!("../../samples/bodies/size-38.obj");
const DRAWN_SIDE: &str = include_str!("../../samples/bodies/size-38.toml");

impl Body {
    /// The body that a text names: a file, or a size.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let path = Path::new(text);
        if path.extension().is_some() || text.contains(['/', '\\']) {
            Self::File(path.to_owned())
        } else {
            Self::Size(text.to_owned())
        }
    }

    /// Name of the mesh in the folder.
    #[must_use]
    pub fn file_name(&self) -> String {
        match self {
            Self::Size(size) => format!("body-{size}.obj"),
            Self::File(path) => name_of(path),
        }
    }

    /// The body, its files, and what there is to say of it. A mesh without a side file is measured, and stood upright in
    /// metres if it stands otherwise.
    ///
    /// # Errors
    /// There is no such size or file.
    pub fn open(&self) -> Result<Opened, Vec<Diagnostic>> {
        match self {
            Self::Size(size) if size == DRAWN => {
                let name = self.file_name();
                let model = toile_formats::body::read(DRAWN_MESH.as_bytes(), &name, Some(DRAWN_SIDE))?.body;
                let side = (toile_formats::body::sidecar_name(&name), DRAWN_SIDE.as_bytes().to_vec());
                let files = vec![(name, DRAWN_MESH.as_bytes().to_vec()), side];
                Ok(Opened { files, model: Some(model), findings: Vec::new() })
            }
            Self::Size(size) => {
                let measures = BodyMeasures::size(size).ok_or_else(|| vec![no_size(size)])?;
                let body = parametric(&measures)?;
                let files = written(&body, &self.file_name());
                Ok(Opened { files, model: Some(body), findings: Vec::new() })
            }
            Self::File(path) => {
                let mut files = vec![(name_of(path), load(path)?)];
                let side = path.with_extension("toml");
                if side.is_file() {
                    files.push((name_of(&side), load(&side)?));
                }
                Ok(Opened::of(files))
            }
        }
    }
}

/// The files of a body, with names that begin as that of its mesh.
fn written(body: &toile_garment::body::Body, name: &str) -> Files {
    let (mesh, side) = toile_formats::body::write(body);
    vec![(name.to_owned(), mesh.into_bytes()), (toile_formats::body::sidecar_name(name), side.into_bytes())]
}

/// A body that was opened.
#[derive(Debug)]
pub struct Opened {
    /// Its files.
    pub files: Files,
    /// The body itself; `None` where the mesh cannot be read as one, which a run tells.
    pub model: Option<toile_garment::body::Body>,
    /// Findings on the mesh.
    pub findings: Vec<Diagnostic>,
}

impl Opened {
    /// From a mesh and, perhaps, the side file beside it.
    fn of(mut files: Files) -> Self {
        let name = files[0].0.clone();
        let side = files.get(1).and_then(|(_, bytes)| std::str::from_utf8(bytes).ok());
        let is_named = files.len() > 1;
        let model = toile_formats::body::read(&files[0].1, &name, side).ok().map(|read| read.body);
        let (None, Some(body)) = (is_named.then_some(()), &model) else {
            return Self { files, model, findings: Vec::new() };
        };
        let (stance, body) = match upright(body.clone(), None) {
            Ok(stood) => stood,
            Err(finding) => {
                let mut finding = *finding;
                finding.severity = Severity::Warning;
                return Self { files, model, findings: vec![finding] };
            }
        };
        let found = measured(&body);
        let mut findings = Vec::new();
        let mut new = written(&found.body, &name);
        if stance.is_upright() {
            files.extend(new.pop());
        } else {
            let message = format!("`{name}` stands {}: it was stood upright, in metres", stance.words());
            findings.push(Diagnostic::warning(codes::BODY_NOT_STANDING, message).hint("look at it in start.html"));
            files = new;
        }
        findings.extend(told(&found));
        Self { files, model: Some(found.body), findings }
    }
}

/// There is no size of this name; the nearest ones are named.
pub fn no_size(size: &str) -> Diagnostic {
    let near = match like(size).as_slice() {
        [] => String::new(),
        names => format!("nearest: {}; ", names.join(", ")),
    };
    let hint = format!("{near}sizes are {}, and `toile body` lists them; a mesh is named FILE.obj", range());
    Diagnostic::error(SIZE_NOT_FOUND, format!("there is no body of size `{size}`")).hint(hint)
}

/// The fabric of a folder.
#[derive(Clone, Debug)]
pub enum Fabric {
    /// One that comes with the program.
    Stock(String),
    /// A file.
    File(PathBuf),
}

impl Fabric {
    /// The fabric that a text names: a file, or one that comes with the program.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let path = Path::new(text);
        if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
            Self::File(path.to_owned())
        } else {
            Self::Stock(text.to_owned())
        }
    }

    /// Its name, without the ending of its file.
    #[must_use]
    pub fn name(&self) -> String {
        self.file_name().trim_end_matches(".toml").to_owned()
    }

    /// Name of the file in the folder.
    #[must_use]
    pub fn file_name(&self) -> String {
        match self {
            Self::Stock(name) => format!("{name}.toml"),
            Self::File(path) => name_of(path),
        }
    }

    /// The file.
    ///
    /// # Errors
    /// There is no such fabric or file.
    pub fn files(&self) -> Result<Files, Vec<Diagnostic>> {
        let bytes = match self {
            Self::Stock(name) => {
                let found = FABRICS.iter().find(|(n, _)| n == name).map(|(_, text)| text.as_bytes().to_vec());
                found.ok_or_else(|| vec![no_fabric(name)])?
            }
            Self::File(path) => load(path)?,
        };
        Ok(vec![(self.file_name(), bytes)])
    }
}

fn no_fabric(name: &str) -> Diagnostic {
    let remedy = remedy(name, FABRICS.iter().map(|(n, _)| *n));
    Diagnostic::error(codes::FABRIC_NOT_KNOWN, format!("there is no fabric `{name}`"))
        .hint(format!("{remedy} (a file of your own is named FILE.toml)"))
}

fn name_of(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned())
}

fn load(path: &Path) -> Result<Vec<u8>, Vec<Diagnostic>> {
    read_limited(path, path, MAX_INPUT).map_err(|e| of_file_error(&e).0.into_iter().collect())
}
