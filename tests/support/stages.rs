//! Small stages that do one thing each, so that the engine is tested without cloth.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use toile_garment::garment::{Certificate, EffectRecord, Shape};
use toile_garment::mesh::PieceMesh;
use toile_garment::units::Length;
use toile_garment::{Aspect, Code, Diagnostic, Garment, Piece, PieceId, Vec2, Vec3};
use toile_stage_api::{Registry, Stage, StageContext, StageError, StageInfo};

toile_garment::codes! {
    pub(crate) list CODES;

    /// There are many of these.
    TEST_MANY = "test-many";

    /// It is wrong on purpose.
    TEST_WRONG = "test-wrong";
}

pub fn registry() -> Registry {
    toile_stages::builtin().with(Sheet).with(Drape).with(Slow).with(Fail).with(Write).with(Read)
}

/// Makes one square piece of two triangles.
pub struct Sheet;

#[derive(Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SheetParams {
    /// Length of a side.
    pub side: Length,
    /// Name of the piece.
    #[serde(default = "front")]
    pub name: String,
    /// How many pieces.
    #[serde(default = "one")]
    pub count: u8,
    /// Nested settings.
    #[serde(default)]
    pub mark: Option<Mark>,
}

/// A mark on the piece.
#[derive(Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// How deep.
    pub depth: Length,
}

fn front() -> String {
    "front".to_owned()
}

fn one() -> u8 {
    1
}

impl Stage for Sheet {
    type Params = SheetParams;
    const INFO: StageInfo = StageInfo::new("test-sheet", "one square piece", &[], &[Aspect::Pieces, Aspect::Mesh], 3);

    fn run(&self, p: &SheetParams, mut garment: Garment, _: &mut StageContext<'_>) -> Result<Garment, StageError> {
        for i in 0..usize::from(p.count) {
            let s = p.side.0;
            let rest = vec![Vec2::new(0.0, 0.0), Vec2::new(s, 0.0), Vec2::new(s, s), Vec2::new(0.0, s)];
            let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() };
            let name = p.name.clone();
            garment.pieces.push(Piece { id: PieceId::from(i), name, mesh: Some(mesh), ..Piece::default() });
        }
        Ok(garment)
    }
}

/// Puts the mesh into space with a given certificate.
pub struct Drape;

#[derive(Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DrapeParams {
    /// Does the certificate pass?
    pub passed: bool,
}

impl Default for DrapeParams {
    fn default() -> Self {
        Self { passed: true }
    }
}

impl Stage for Drape {
    type Params = DrapeParams;
    const INFO: StageInfo = StageInfo::new("test-drape", "lifts it into space", &[Aspect::Mesh], &[Aspect::Drape], 1);

    fn run(&self, p: &DrapeParams, mut garment: Garment, _: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let lift = |m: &PieceMesh| m.rest.iter().map(|v| Vec3::new(v.x, v.y, 0.0)).collect();
        let positions = garment.pieces.iter().filter_map(|p| p.mesh.as_ref()).map(lift).collect();
        garment.drape = Some(Shape { positions, sewn: true, welded: true, ..Shape::default() });
        garment.certificate = Some(Certificate { passed: p.passed, settled: true, ..Certificate::default() });
        let cpu_seconds = Instant::now().elapsed().as_secs_f64() + 0.25;
        let (rule, evidence) = ("always".to_owned(), "test".to_owned());
        garment.effects = vec![EffectRecord { name: "gravity".to_owned(), on: true, rule, evidence, cpu_seconds }];
        Ok(garment)
    }
}

/// Takes its time.
pub struct Slow;

#[derive(Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlowParams {
    /// Milliseconds.
    pub ms: u64,
    /// Does it look at the stop flag?
    #[serde(default)]
    pub deaf: bool,
}

impl Stage for Slow {
    type Params = SlowParams;
    const INFO: StageInfo = StageInfo::new("test-slow", "waits", &[], &[], 1);

    fn run(&self, p: &SlowParams, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let until = Instant::now() + Duration::from_millis(p.ms);
        while Instant::now() < until {
            if cx.cancelled() && !p.deaf {
                return Err(StageError::Cancelled);
            }
            cx.progress.update(1, 2, "waiting");
            std::thread::sleep(Duration::from_millis(5));
        }
        Ok(garment)
    }
}

/// Fails in a chosen way.
pub struct Fail;

/// Ways to fail.
#[derive(Clone, Copy, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Way {
    Input,
    Parameter,
    Unsupported,
    Limit,
    Unstable,
    Internal,
    Panic,
    Finding,
    Flood,
}

#[derive(Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FailParams {
    /// Which way.
    pub way: Way,
}

impl Stage for Fail {
    type Params = FailParams;
    const INFO: StageInfo = StageInfo::new("test-fail", "fails", &[], &[], 1);

    fn run(&self, p: &FailParams, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let finding = || Diagnostic::error(TEST_WRONG, "it is wrong");
        match p.way {
            Way::Input => Err(StageError::input(finding())),
            Way::Parameter => Err(StageError::parameter(finding())),
            Way::Unsupported => Err(StageError::Unsupported("this".into())),
            Way::Limit => Err(StageError::Limit("too many pieces: 3000, over the limit of 2000".into())),
            Way::Unstable => Err(StageError::Unstable("residual grows".into())),
            Way::Internal => Err(StageError::Internal("oops".into())),
            Way::Panic => panic!("index out of thin air"),
            Way::Finding => {
                cx.report.push(finding());
                Ok(garment)
            }
            Way::Flood => {
                (0..100).for_each(|i| cx.report.push(Diagnostic::warning(TEST_MANY, format!("number {i}"))));
                Ok(garment)
            }
        }
    }
}

/// Writes a text.
pub struct Write;

#[derive(Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WriteParams {
    /// Where.
    #[schemars(extend("format" = "output-file"))]
    pub file: PathBuf,
    /// The text that is written.
    #[serde(default)]
    pub text: String,
    /// Write the whole garment document instead.
    #[serde(default)]
    pub document: bool,
}

impl Stage for Write {
    type Params = WriteParams;
    const INFO: StageInfo = StageInfo::new("test-write", "writes a text", &[], &[], 1);

    fn run(&self, p: &WriteParams, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let document = || toile_garment::bundle::to_text(&garment).map_err(|e| StageError::Internal(e.to_string()));
        let text = if p.document { document()? } else { p.text.clone() };
        cx.files.write(&p.file, text.as_bytes())?;
        Ok(garment)
    }
}

/// Reads a file into the style's name.
pub struct Read;

#[derive(Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReadParams {
    /// Which.
    #[schemars(extend("format" = "input-file"))]
    pub file: String,
}

impl Stage for Read {
    type Params = ReadParams;
    const INFO: StageInfo = StageInfo::new("test-read", "reads a file", &[], &[], 1);

    fn run(&self, p: &ReadParams, mut garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        garment.style = String::from_utf8_lossy(&cx.files.read(Path::new(&p.file))?).into_owned();
        Ok(garment)
    }
}
