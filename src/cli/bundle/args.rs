//! Options of `toile bundle`.

use super::super::args::ForeseenArgs;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// `bundle`
#[derive(Args, Debug)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct BundleArgs {
    /// It says what to do besides.
    #[command(subcommand)]
    pub verb: Option<BundleVerb>,
    /// Folder of a run, or its run.json. Give it in the folder where the run was started.
    #[arg(required = true)]
    pub run: Option<PathBuf>,
    /// Write the bundle here, e.g. skirt.toile.tar.
    #[arg(long, value_name = "FILE", required = true)]
    pub out: Option<PathBuf>,
    /// Pipeline file, if it is not where the run found it.
    #[arg(long, value_name = "PIPELINE.toml")]
    pub pipeline: Option<PathBuf>,
    /// Let the pipeline read this folder too, as the run did; may be repeated.
    #[arg(long, value_name = "DIR")]
    pub allow_read: Vec<PathBuf>,
    /// Let the pipeline run the program of this plugin, as the run did; may be repeated.
    #[arg(long, value_name = "NAME[=CONTENT]")]
    pub allow_run: Vec<String>,
    /// Replace FILE if it is there.
    #[arg(long)]
    pub force: bool,
}

/// Verbs of `bundle`.
#[derive(Debug, Subcommand)]
pub enum BundleVerb {
    /// Check the hashes of all files in a bundle; with --run, run it again and compare the outputs.
    Verify(VerifyArgs),
}

/// `bundle verify`
#[derive(Args, Debug)]
pub struct VerifyArgs {
    /// The bundle.
    pub file: PathBuf,
    /// Run it again in a temporary folder and compare exit code and outputs. Exit code 1 if they differ.
    #[arg(long)]
    pub run: bool,
    /// Threads [default: all cores, or TOILE_THREADS]; results never depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// How long and how much.
    #[command(flatten)]
    pub limits: ForeseenArgs,
    /// Let the pipeline run the program of this plugin; may be repeated.
    #[arg(long, value_name = "NAME[=CONTENT]")]
    pub allow_run: Vec<String>,
    /// For programs.
    #[arg(long)]
    pub json: bool,
}
