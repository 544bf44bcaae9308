//! Options of `toile test`.

use super::super::args::{CacheArgs, ForeseenArgs};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// `test`
#[derive(Args, Debug)]
pub struct TestArgs {
    /// Files of golden cases, or folders with files called toile-test.toml.
    #[arg(value_name = "FILE|FOLDER", default_value = ".")]
    pub paths: Vec<PathBuf>,
    /// Write the figures of these runs into the files; bounds, exit codes and findings stay.
    #[arg(long)]
    pub bless: bool,
    /// Why they change; kept in the history of the file.
    #[arg(long, value_name = "TEXT", requires = "bless")]
    pub reason: Option<String>,
    /// Run only the case of this name; may be repeated.
    #[arg(long, value_name = "CASE")]
    pub only: Vec<String>,
    /// How the results are printed.
    #[arg(long, value_enum, default_value = "text")]
    pub format: TestFormat,
    /// Write the verdicts as JUnit, too.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Keep the outputs of all cases in this folder.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads [default: all cores, or TOILE_THREADS]; results never depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// How long and how much.
    #[command(flatten)]
    pub limits: ForeseenArgs,
    /// Cache.
    #[command(flatten)]
    pub cache: CacheArgs,
    /// Let the pipelines read this folder too; may be repeated.
    #[arg(long, value_name = "DIR")]
    pub allow_read: Vec<PathBuf>,
    /// Let the pipelines run the program of this plugin; may be repeated.
    #[arg(long, value_name = "NAME[=CONTENT]")]
    pub allow_run: Vec<String>,
    /// Say nothing but results and errors.
    #[arg(long)]
    pub quiet: bool,
}

/// Forms of the results of golden cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TestFormat {
    /// For people.
    Text,
    /// For programs.
    Json,
    /// Lines that GitHub shows beside the file.
    Github,
}
