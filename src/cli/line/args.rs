//! Options of `toile line`.

use super::super::args::{CacheArgs, Format, PageLanguage, positive};
use crate::line::Rights;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// `line`
#[derive(Args, Debug)]
pub struct LineArgs {
    /// The verb.
    #[command(subcommand)]
    pub verb: LineVerb,
}

/// The verbs of a line.
#[derive(Debug, Subcommand)]
pub enum LineVerb {
    /// Find every mistake of every job, without work.
    Check(CheckLineArgs),
    /// Tell jobs, core hours and memory.
    Plan(PlanLineArgs),
    /// List the jobs as JSON lines: inputs, parameters, outputs, content key.
    Jobs(JobsArgs),
    /// Run the jobs on this machine; what is done is not done again.
    Run(RunLineArgs),
    /// Put the results of the jobs together anew.
    Report(ReportArgs),
}

/// Which line, and what its pipelines may do.
#[derive(Args, Debug)]
pub struct LineFileArgs {
    /// File of the line.
    #[arg(value_name = "LINE.toml")]
    pub line: PathBuf,
    /// Let the pipelines read this folder too; may be repeated.
    #[arg(long, value_name = "DIR")]
    pub allow_read: Vec<PathBuf>,
    /// Let the pipelines run the program of this plugin; may be repeated.
    #[arg(long, value_name = "NAME[=CONTENT]")]
    pub allow_run: Vec<String>,
}

impl LineFileArgs {
    /// The rights of all jobs. Folders are named from here, and not from the folder of the line.
    pub fn rights(&self) -> Rights {
        let here = |dir: &PathBuf| std::path::absolute(dir).unwrap_or_else(|_| dir.clone());
        Rights { allow_read: self.allow_read.iter().map(here).collect(), allow_run: self.allow_run.clone() }
    }
}

/// `line check`
#[derive(Args, Debug)]
pub struct CheckLineArgs {
    /// Line.
    #[command(flatten)]
    pub file: LineFileArgs,
    /// How findings are printed.
    #[arg(long, value_enum, default_value = "text")]
    pub format: Format,
}

/// `line plan`
#[derive(Args, Debug)]
pub struct PlanLineArgs {
    /// Line.
    #[command(flatten)]
    pub file: LineFileArgs,
    /// For programs.
    #[arg(long)]
    pub json: bool,
}

/// `line jobs`
#[derive(Args, Debug)]
pub struct JobsArgs {
    /// Line.
    #[command(flatten)]
    pub file: LineFileArgs,
}

/// `line run`
#[derive(Args, Debug)]
pub struct RunLineArgs {
    /// Line.
    #[command(flatten)]
    pub file: LineFileArgs,
    /// Folder of the results [default: out/LINE-line]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Language of the page: en or zh.
    #[arg(long, value_enum, default_value = "en", hide_possible_values = true)]
    pub language: PageLanguage,
    /// Jobs at once [default: one for each core]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
    /// Threads of each job [default: cores over jobs]; results never depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Most memory of all jobs together as foreseen, MB [default: 80 % of what is free]
    #[arg(long, value_name = "MB", value_parser = positive)]
    pub memory: Option<f64>,
    /// Run only jobs with this choice: an axis, style or job; may be repeated.
    #[arg(long, value_name = "AXIS=CHOICE", value_parser = choice)]
    pub only: Vec<(String, String)>,
    /// Cache.
    #[command(flatten)]
    pub cache: CacheArgs,
    /// Do finished jobs again.
    #[arg(long)]
    pub force: bool,
    /// Say nothing but errors.
    #[arg(long)]
    pub quiet: bool,
}

/// `line report`
#[derive(Args, Debug)]
pub struct ReportArgs {
    /// Line.
    #[command(flatten)]
    pub file: LineFileArgs,
    /// Folder of the results [default: out/LINE-line]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Language of the page: en or zh.
    #[arg(long, value_enum, default_value = "en", hide_possible_values = true)]
    pub language: PageLanguage,
}

fn choice(text: &str) -> Result<(String, String), String> {
    let (axis, choice) = text.split_once('=').ok_or("write AXIS=CHOICE, e.g. size=38")?;
    Ok((axis.to_owned(), choice.to_owned()))
}
