//! Options of `toile fit`.

use super::super::args::{PageLanguage, PipelineArgs};
use clap::Args;
use std::path::PathBuf;

/// `fit`
#[derive(Args, Debug)]
pub struct FitArgs {
    /// Pipeline.
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    /// The body that the garment shall fit: a mesh, or a size such as 40 or men-50.
    #[arg(long, value_name = "FILE.obj|SIZE")]
    pub body: String,
    /// Ease that is asked for, e.g. waist="30 mm"; may be repeated. Elsewhere the garment keeps its own ease.
    #[arg(long, value_name = "HEIGHT=LENGTH")]
    pub ease: Vec<String>,
    /// Largest difference of an ease from what is asked [default: 5 mm]
    #[arg(long, value_name = "LENGTH")]
    pub within: Option<String>,
    /// Rounds after which it ends.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=20))]
    pub rounds: u32,
    /// Length of cloth over which the change is averaged when the garment is laid flat [default: 40 mm]
    #[arg(long, value_name = "LENGTH")]
    pub smooth: Option<String>,
    /// How pieces that mirror each other come back: auto, always, off [default: always]
    #[arg(long, value_name = "WORD", default_value = "always")]
    pub symmetry: String,
    /// What does not change: seams, grain, straight, right-angles, pleats, darts, or none [default: all but darts]
    #[arg(long, value_name = "WORD,…", value_delimiter = ',')]
    pub lock: Vec<String>,
    /// Working folder: pattern, sewing file, body, fabric, pipeline, and the page fit.html.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Language of the page: en or zh.
    #[arg(long, value_enum, default_value = "en", hide_possible_values = true)]
    pub language: PageLanguage,
    /// Threads [default: all cores, or TOILE_THREADS]; results never depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Replace what an earlier fitting left in DIR.
    #[arg(long)]
    pub force: bool,
    /// Say nothing on the way.
    #[arg(long)]
    pub quiet: bool,
    /// For programs.
    #[arg(long)]
    pub json: bool,
}
