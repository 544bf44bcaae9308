//! Options of `toile validate`.

use clap::{Args, Subcommand};
use std::path::PathBuf;
use toile_garment::units::Length;

/// `validate`
#[derive(Args, Debug)]
pub struct ValidateArgs {
    /// The thing to validate.
    #[command(subcommand)]
    pub verb: ValidateVerb,
}

/// The things that can be validated.
#[derive(Debug, Subcommand)]
pub enum ValidateVerb {
    /// Cusick drapes of cloth, each law of bending set by one capture and judged by the others.
    Drape(ValidatedDrapeArgs),
}

/// `validate drape`
#[derive(Args, Debug)]
pub struct ValidatedDrapeArgs {
    /// Table of captures: fabric, dc_percent, and where known face, rim_z_mean_mm, areal_mass_gsm.
    #[arg(value_name = "CAPTURES.csv")]
    pub captures: PathBuf,
    /// Longest edge of the mesh; limp cloth gets a finer one, down to 4 mm.
    #[arg(long, value_name = "LENGTH", default_value = "8 mm")]
    pub edge: Length,
    /// Falls of each specimen.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=12))]
    pub falls: u32,
    /// Folder of the results [default: out/CAPTURES-validate].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace an earlier validation.
    #[arg(long)]
    pub force: bool,
    /// For programs.
    #[arg(long)]
    pub json: bool,
    /// Threads [default: TOILE_THREADS, else one for each core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Say nothing but findings.
    #[arg(long)]
    pub quiet: bool,
}
