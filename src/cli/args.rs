//! Verbs and their options.

use super::bundle::BundleArgs;
use super::fabric::FabricArgs;
use super::fit::FitArgs;
use super::line::LineArgs;
use super::test::TestArgs;
use super::validate::ValidateArgs;
use crate::engine::{CacheOptions, Limits};
use crate::load::Request;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use toile_formats::dxf::layers::Layers;
use toile_formats::report::Language;
use toile_stages::import_dxf::FileUnit;

/// The virtual trial garment: DXF patterns sewn and draped in 3D, and flattened back to 2D.
#[derive(Debug, Parser)]
#[command(name = "toile", version, max_term_width = 100, after_help = HELP)]
pub struct Cli {
    /// The verb.
    #[command(subcommand)]
    pub verb: Verb,
}

const HELP: &str = "\
The usual thing:  toile run pipelines/long-skirt/v1.toml
Exit codes: 0 good, 1 a gate of the certificate failed, 2 usage or configuration, 3 an input file is wrong,
4 did not converge or unstable, 5 disk, memory, rights or an internal error, 130 stopped.";

/// The verbs.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Run a pipeline; outputs and run.json go into one folder.
    Run(RunArgs),
    /// Make a working folder from a pattern, with proposed seams, or from a sample: skirt, bodice, t-shirt.
    New(NewArgs),
    /// Check everything that can be checked without work, all errors at once.
    Check(CheckArgs),
    /// Show what a run would do and need: stages, effects, seconds, memory, files.
    Plan(PlanArgs),
    /// Run a pipeline after every change of a file that it reads; the page of the last run loads itself anew.
    Watch(WatchArgs),
    /// List the files that a pipeline reads and writes, and the key of its content.
    Deps(DepsArgs),
    /// Tell what differs between two results: folders, records or GLBs. Exit code 1 if it is more than the tolerance.
    Diff(DiffArgs),
    /// Run golden cases of your own: figures with tolerances, outputs, findings. Exit code 1 if one differs.
    Test(TestArgs),
    /// Pack all that a run read into one file, or verify such a file.
    Bundle(BundleArgs),
    /// Sew a product line: styles in sizes, fabrics and other choices.
    Line(LineArgs),
    /// Show what is in a file.
    Inspect(InspectArgs),
    /// Make the pattern of a garment for another body, with its ease.
    Fit(FitArgs),
    /// Flatten a garment back to 2D, from its file alone.
    Flatten(FlattenArgs),
    /// Show what accuracy costs in time for one garment: error against seconds and memory.
    Study(StudyArgs),
    /// Drape one garment by the paper's method, by its neighbours and by this program's own, side by side.
    Compare(CompareArgs),
    /// Predict measured drapes of real cloth, and tell where that fails.
    Validate(ValidateArgs),
    /// Make a body of a size or from measures, or measure a mesh; without options: list sizes and measures.
    Body(BodyArgs),
    /// Do a laboratory's test of a fabric on the solver.
    Fabric(FabricArgs),
    /// List the stages, or explain one with all its parameters.
    Stages(StagesArgs),
    /// Print the JSON schema of pipeline files, or of another kind of file.
    Schema(SchemaArgs),
    /// Explain the code of a finding.
    Explain(ExplainArgs),
    /// Print the completion script of a shell.
    Completions(CompletionsArgs),
}

/// Options of `schema`.
#[derive(Args, Debug)]
pub struct SchemaArgs {
    /// Kind of file.
    #[arg(value_name = "KIND", value_enum, default_value = "pipeline")]
    pub kind: FileKind,
}

/// Kinds of files that a person writes.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum FileKind {
    /// The chain of stages.
    Pipeline,
    /// Seams, darts and places beside a pattern.
    Sewing,
    /// Measured figures of a cloth.
    Fabric,
    /// Measures, landmarks and segments beside the mesh of a body.
    Body,
    /// A product line.
    Line,
    /// Golden cases.
    Test,
}

/// Which pipeline, and what it may do.
#[derive(Args, Debug)]
pub struct PipelineArgs {
    /// Pipeline file.
    #[arg(value_name = "PIPELINE.toml")]
    pub pipeline: PathBuf,
    /// Set an input (name=value) or a parameter (stage-id.key=value); may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Let the pipeline read this folder too; may be repeated.
    #[arg(long, value_name = "DIR")]
    pub allow_read: Vec<PathBuf>,
    /// Let the pipeline run the program of this plugin, with =CONTENT only if its files have this digest; may be repeated.
    #[arg(long, value_name = "NAME[=CONTENT]")]
    pub allow_run: Vec<String>,
}

impl PipelineArgs {
    /// The request in the form of the loader.
    pub fn request(&self) -> Request {
        Request {
            file: self.pipeline.clone(),
            set: self.set.clone(),
            allow_read: self.allow_read.clone(),
            allow_run: self.allow_run.iter().cloned().collect(),
            ..Request::default()
        }
    }
}

/// How exact.
#[derive(Args, Debug)]
pub struct AccuracyArgs {
    /// Accuracy: a length such as "10 mm", less than 6 mm only with a study, or draft, normal, fine, reference; as
    /// `accuracy` in [pipeline].
    #[arg(long, value_name = "LENGTH")]
    pub accuracy: Option<String>,
    /// Drape again from so many starts moved by up to 1 µm; the certificate tells how far the rests lie apart.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=20))]
    pub repeats: Option<u32>,
}

impl AccuracyArgs {
    /// A request with this accuracy.
    pub fn request(&self, pipeline: &PipelineArgs) -> Request {
        Request { accuracy: self.accuracy.clone(), repeats: self.repeats, ..pipeline.request() }
    }
}

/// `run`
#[derive(Args, Debug)]
pub struct RunArgs {
    /// Pipeline.
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    /// How exact.
    #[command(flatten)]
    pub accuracy: AccuracyArgs,
    /// Output folder [default: out/LINE-vVERSION]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads [default: all cores, or TOILE_THREADS]; results never depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Write events as JSON lines to this file.
    #[arg(long, value_name = "FILE")]
    pub events: Option<PathBuf>,
    /// Keep preview.glb in the output folder: the garment while it is sewn and draped, new whenever a coarser mesh is
    /// done.
    #[arg(long)]
    pub preview: bool,
    /// Let the pipeline write into this folder too; may be repeated.
    #[arg(long, value_name = "DIR")]
    pub allow_write: Vec<PathBuf>,
    /// How long and how much.
    #[command(flatten)]
    pub limits: LimitArgs,
    /// Cache.
    #[command(flatten)]
    pub cache: CacheArgs,
    /// Remove the outputs of an earlier run before the work, and replace files that are there, but never an input.
    #[arg(long)]
    pub force: bool,
    /// Say nothing but errors.
    #[arg(long)]
    pub quiet: bool,
    /// End as soon as the standard input is closed.
    #[arg(long, hide = true)]
    pub tied: bool,
}

/// Limits of a run.
#[derive(Args, Debug)]
pub struct LimitArgs {
    /// Longest time of the run, s: refused when more is foreseen [500], stopped when it takes more.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub max_seconds: Option<f64>,
    /// Most memory of the run, MB: refused when more is foreseen [half of what the system can give], stopped when it
    /// takes more.
    #[arg(long, value_name = "MB", value_parser = positive)]
    pub max_memory: Option<f64>,
}

impl LimitArgs {
    /// The limits that are asked for.
    pub fn limits(&self) -> Limits {
        Limits { seconds: self.max_seconds, mb: self.max_memory }
    }
}

/// Where results of stages are kept.
#[derive(Args, Debug)]
pub struct CacheArgs {
    /// Keep results of stages in this folder and take them from there; it may be shared by many programs.
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
    /// Most size of the cache, MB [default: 4000]
    #[arg(long, value_name = "MB", requires = "cache", value_parser = positive)]
    pub cache_size: Option<f64>,
}

impl CacheArgs {
    /// Most bytes.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive size in MB")]
    pub fn limit(&self) -> u64 {
        (1e6 * self.cache_size.unwrap_or(4000.0)) as u64
    }

    /// The cache that is asked for.
    pub fn options(&self) -> Option<CacheOptions> {
        self.cache.as_ref().map(|folder| CacheOptions { folder: folder.clone(), limit: self.limit() })
    }
}

/// A layer of a file, and the one that it stands for.
fn layer(text: &str) -> Result<(String, String), String> {
    let (own, target) = text.split_once('=').ok_or("write the layer of the file first, such as 21=1")?;
    if Layers::is_target(target) {
        Ok((own.to_owned(), target.to_owned()))
    } else {
        Err(format!("`{target}` is no layer of the standard; write the layer of the file first, such as 21=1"))
    }
}

fn unit(text: &str) -> Result<FileUnit, String> {
    let word = serde_json::Value::from(text.to_lowercase());
    serde_json::from_value(word).map_err(|_| "a unit is mm, cm, inch or m".to_owned())
}

pub(super) fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
    number.ok_or_else(|| "write a number above 0".to_owned())
}

/// How findings are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people, on stderr.
    Text,
    /// For programs, on stdout.
    Json,
}

/// `check`
#[derive(Args, Debug)]
pub struct CheckArgs {
    /// Pipeline.
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    /// How exact.
    #[command(flatten)]
    pub accuracy: AccuracyArgs,
    /// How findings are printed.
    #[arg(long, value_enum, default_value = "text")]
    pub format: Format,
}

/// `plan`
#[derive(Args, Debug)]
pub struct PlanArgs {
    /// Pipeline.
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    /// How exact.
    #[command(flatten)]
    pub accuracy: AccuracyArgs,
    /// How long and how much.
    #[command(flatten)]
    pub limits: LimitArgs,
    /// For programs.
    #[arg(long)]
    pub json: bool,
}

/// `watch`
#[derive(Args, Debug)]
pub struct WatchArgs {
    /// Pipeline.
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    /// How exact.
    #[command(flatten)]
    pub accuracy: AccuracyArgs,
    /// Output folder; what an earlier run wrote there is replaced [default: out/LINE-vVERSION]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads [default: all cores, or TOILE_THREADS]; results never depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Cache.
    #[command(flatten)]
    pub cache: CacheArgs,
    /// End after so many runs [default: go on]
    #[arg(long, value_name = "N")]
    pub runs: Option<usize>,
    /// Say nothing but errors.
    #[arg(long)]
    pub quiet: bool,
}

/// `diff`
#[derive(Args, Debug)]
pub struct DiffArgs {
    /// Folder of a run, its run.json, a GLB, or the folder of a line.
    pub a: PathBuf,
    /// The one to compare with it.
    pub b: PathBuf,
    /// Differences that are allowed, as TOML: pieces, darts, seams, measures and shape as lengths, strain as a number,
    /// inputs, parameters, fabric and findings as "same" or "any". Without it nothing may differ.
    #[arg(long, value_name = "FILE")]
    pub tolerance: Option<PathBuf>,
    /// How the differences are printed.
    #[arg(long, value_enum, default_value = "text")]
    pub format: DiffFormat,
    /// Language of the page: en or zh.
    #[arg(long, value_enum, default_value = "en", hide_possible_values = true)]
    pub language: PageLanguage,
}

/// Languages of pages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum PageLanguage {
    /// English.
    #[default]
    En,
    /// Chinese, in simplified letters.
    Zh,
}

impl PageLanguage {
    /// The language of the catalogue.
    pub fn language(self) -> Language {
        match self {
            Self::En => Language::English,
            Self::Zh => Language::Chinese,
        }
    }
}

/// Forms of the differences.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DiffFormat {
    /// For people.
    Text,
    /// For programs.
    Json,
    /// One page with pictures side by side.
    Html,
}

/// Limits of runs that nobody watches.
#[derive(Args, Debug)]
pub struct ForeseenArgs {
    /// Longest time of a run, s: refused when more is foreseen [default: 500]
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub max_seconds: Option<f64>,
    /// Most memory of a run, MB: refused when more is foreseen [default: half of what the system can give]
    #[arg(long, value_name = "MB", value_parser = positive)]
    pub max_memory: Option<f64>,
}

impl ForeseenArgs {
    /// The limits that are asked for.
    pub fn limits(&self) -> Limits {
        Limits { seconds: self.max_seconds, mb: self.max_memory }
    }
}

/// `deps`
#[derive(Args, Debug)]
pub struct DepsArgs {
    /// Pipeline.
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    /// How exact.
    #[command(flatten)]
    pub accuracy: AccuracyArgs,
    /// For programs.
    #[arg(long)]
    pub json: bool,
}

/// `study`
#[derive(Args, Debug)]
pub struct StudyArgs {
    /// Pipeline.
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    /// For programs.
    #[arg(long)]
    pub json: bool,
    /// Folder of the study [default: out/LINE-vVERSION-study]; a study goes on where it was stopped.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Leave out what would take more CPU seconds than this in all.
    #[arg(long, value_name = "SECONDS")]
    pub budget: Option<f64>,
    /// Error that the recommended setting must reach.
    #[arg(long, value_name = "LENGTH", default_value = "5 mm")]
    pub want: String,
    /// Further drapes of every mesh from starts moved by up to 1 µm, which tell how far apart its rests lie; 0 for none
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(0..=20))]
    pub starts: u32,
    /// Edge lengths [default: 32, 22, 16, 11 and 8 mm]
    #[arg(long, value_name = "LENGTH,…", value_delimiter = ',')]
    pub edges: Vec<String>,
    /// Tolerances of the rest [default: normal; also draft, fine, reference]
    #[arg(long, value_name = "WORD,…", value_delimiter = ',')]
    pub accuracies: Vec<String>,
    /// In-plane models [default: coupled,springs]
    #[arg(long, value_name = "WORD,…", value_delimiter = ',')]
    pub models: Vec<String>,
    /// Integrators [default: static,central-difference]
    #[arg(long, value_name = "WORD,…", value_delimiter = ',')]
    pub integrators: Vec<String>,
    /// Cloth against cloth [default: auto,off]
    #[arg(long, value_name = "WORD,…", value_delimiter = ',')]
    pub self_contact: Vec<String>,
    /// Run every combination, not only a ladder of meshes with departures from it.
    #[arg(long)]
    pub full: bool,
    /// Language of the page: en or zh.
    #[arg(long, value_enum, default_value = "en", hide_possible_values = true)]
    pub language: PageLanguage,
    /// Threads [default: all cores, or TOILE_THREADS]; results never depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Do finished runs again.
    #[arg(long)]
    pub force: bool,
    /// Say nothing but errors.
    #[arg(long)]
    pub quiet: bool,
}

/// `compare`
#[derive(Args, Debug)]
pub struct CompareArgs {
    /// Pipeline.
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    /// For programs.
    #[arg(long)]
    pub json: bool,
    /// Folder of the comparison [default: out/LINE-vVERSION-compare].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Methods: toile, springs, paper, penalty, provot, explicit-triangles, implicit, sewn-only [default: all but penalty]
    #[arg(long, value_name = "WORD,…", value_delimiter = ',')]
    pub methods: Vec<String>,
    /// Language of the page: en or zh.
    #[arg(long, value_enum, default_value = "en", hide_possible_values = true)]
    pub language: PageLanguage,
    /// Replace an earlier comparison.
    #[arg(long)]
    pub force: bool,
    /// Threads [default: all cores, or TOILE_THREADS]; results never depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Say nothing but errors.
    #[arg(long)]
    pub quiet: bool,
}

/// `inspect`
#[derive(Args, Debug)]
pub struct InspectArgs {
    /// File.
    pub file: PathBuf,
    /// For programs.
    #[arg(long)]
    pub json: bool,
    /// Draw the pieces with edge numbers, darts and notches.
    #[arg(long, value_name = "OUT")]
    pub svg: Option<PathBuf>,
    /// Replace OUT if it is there.
    #[arg(long)]
    pub force: bool,
}

/// `new`
#[derive(Args, Debug)]
pub struct NewArgs {
    /// Pattern, or the name of a sample: skirt, bodice, t-shirt.
    #[arg(value_name = "PATTERN.dxf")]
    pub pattern: PathBuf,
    /// Folder to write; what lies there already is kept.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Body: an OBJ file, or a size to make one of, such as 38, men-50 or child-128; `toile body` lists all [default: by
    /// the size of the pattern, else 38]
    #[arg(long, value_name = "FILE|SIZE")]
    pub body: Option<String>,
    /// Fabric: a file, or one of those that come with the program [default: cotton-shirting]
    #[arg(long, value_name = "FILE|NAME")]
    pub fabric: Option<String>,
    /// Size of the pattern, and of the body unless one is named [default: the sample size of the file]
    #[arg(long, value_name = "SIZE")]
    pub size: Option<String>,
    /// A piece that is not sewn, such as a facing or a second sleeve; may be given more than once.
    #[arg(long, value_name = "PIECE")]
    pub leave_out: Vec<String>,
    /// A layer of the file that stands for one of the standard, such as CUT=1 or FRAME=ignore; may be given more than once.
    #[arg(long, value_name = "LAYER=LAYER", value_parser = layer)]
    pub layer: Vec<(String, String)>,
    /// Unit of the coordinates, overruling the file: mm, cm, inch or m.
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    pub units: Option<FileUnit>,
    /// Propose from the shapes alone, as if the pieces had no names.
    #[arg(long)]
    pub anonymous: bool,
    /// Language of the page: en or zh.
    #[arg(long, value_enum, default_value = "en", hide_possible_values = true)]
    pub language: PageLanguage,
    /// For programs: print the proposal.
    #[arg(long)]
    pub json: bool,
}

/// `flatten`
#[derive(Args, Debug)]
pub struct FlattenArgs {
    /// Garment: a GLB, also as an editor saved it again, or a garment document.
    #[arg(value_name = "GARMENT.glb")]
    pub garment: PathBuf,
    /// The GLB that was edited, or its garment document, when the editor left the document out of GARMENT.glb.
    #[arg(long, value_name = "ORIGINAL")]
    pub document: Option<PathBuf>,
    /// Which lengths the pieces shall have: auto, carried, surface [default: auto]
    #[arg(long, value_name = "WORD")]
    pub metric: Option<String>,
    /// Length of cloth over which a rough surface is averaged, e.g. "20 mm" [default: 0 mm]
    #[arg(long, value_name = "LENGTH")]
    pub smooth: Option<String>,
    /// How pieces that mirror each other come back: auto, always, off [default: auto]
    #[arg(long, value_name = "WORD")]
    pub symmetry: Option<String>,
    /// What does not change: seams, grain, straight, right-angles, pleats, darts, or none [default: all but darts]
    #[arg(long, value_name = "WORD,…", value_delimiter = ',')]
    pub lock: Vec<String>,
    /// Changes that pass without a warning: a TOML file with the keys of `tolerance` of the stage `flatten`.
    #[arg(long, value_name = "FILE")]
    pub tolerance: Option<PathBuf>,
    /// Write the flat pieces as DXF.
    #[arg(long, value_name = "OUT")]
    pub dxf: Option<PathBuf>,
    /// Write a sewing file whose points lie on the new outlines.
    #[arg(long, value_name = "OUT", requires = "dxf")]
    pub sewing: Option<PathBuf>,
    /// Carry the change to all sizes of the pattern that the garment was made of. Its rule table is the file of the same
    /// name with `.rul`; the new one is written beside the DXF.
    #[arg(long, value_name = "PATTERN.dxf", requires = "dxf")]
    pub grade_from: Option<PathBuf>,
    /// Write the figures and the verdict on every piece as JSON.
    #[arg(long, value_name = "OUT")]
    pub json: Option<PathBuf>,
    /// Replace OUT if it is there.
    #[arg(long)]
    pub force: bool,
}

/// `body`
#[derive(Args, Debug)]
#[command(args_conflicts_with_subcommands = true)]
pub struct BodyArgs {
    /// The other things to do.
    #[command(subcommand)]
    pub verb: Option<BodyVerb>,
    /// Size to start from, such as 38, men-50 or child-128 [default: 38]
    #[arg(long, value_name = "SIZE", requires = "out")]
    pub size: Option<String>,
    /// Set a measure, e.g. waist_girth="700 mm"; may be repeated.
    #[arg(long = "set", value_name = "MEASURE=LENGTH", requires = "out")]
    pub set: Vec<String>,
    /// Write the mesh here, and measures, landmarks and segments beside it as TOML.
    #[arg(long, value_name = "FILE.obj")]
    pub out: Option<PathBuf>,
    /// Replace files that are there.
    #[arg(long, requires = "out")]
    pub force: bool,
}

/// Verbs of `body`.
#[derive(Debug, Subcommand)]
pub enum BodyVerb {
    /// Find unit, pose, segments, landmarks, girths and heights on a mesh, and write its side file.
    Measure(BodyMeasureArgs),
}

/// `body measure`
#[derive(Args, Debug)]
pub struct BodyMeasureArgs {
    /// The mesh; what a side file beside it names stays.
    #[arg(value_name = "FILE.obj")]
    pub mesh: PathBuf,
    /// Write the side file here; with FILE.obj, the mesh upright in metres, and its side file beside it [default: beside
    /// the mesh]
    #[arg(long, value_name = "FILE.toml|FILE.obj")]
    pub out: Option<PathBuf>,
    /// Draw what was found, for checking.
    #[arg(long, value_name = "FILE.svg")]
    pub picture: Option<PathBuf>,
    /// Unit of the mesh: mm, cm, inch or m [default: the one that makes it as high as a person]
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    pub units: Option<FileUnit>,
    /// Replace files that are there.
    #[arg(long)]
    pub force: bool,
}

/// `stages`
#[derive(Args, Debug)]
pub struct StagesArgs {
    /// Stage to explain.
    pub name: Option<String>,
}

/// `explain`
#[derive(Args, Debug)]
pub struct ExplainArgs {
    /// Code, e.g. unknown-key; without it all codes are listed.
    pub code: Option<String>,
}

/// `completions`
#[derive(Args, Debug)]
pub struct CompletionsArgs {
    /// Shell.
    pub shell: clap_complete::Shell,
}
