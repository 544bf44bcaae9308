//! Options of `toile fabric`.

use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;
use toile_garment::units::{Angle, Length, Share};
use toile_stages::fabric_test::Direction;

/// `fabric`
#[derive(Args, Debug)]
pub struct FabricArgs {
    /// The thing to do with a fabric file.
    #[command(subcommand)]
    pub verb: FabricVerb,
}

/// The things that can be done with a fabric file.
#[derive(Debug, Subcommand)]
pub enum FabricVerb {
    /// Do a laboratory's test on the solver and read it as the instrument does.
    #[command(subcommand)]
    Test(Test),
}

/// The tests.
#[derive(Debug, Subcommand)]
pub enum Test {
    /// Drape coefficient and nodes of a disc of cloth (BS 5058, ISO 9073-9).
    Cusick(CusickArgs),
    /// Bending length and flexural rigidity of strips at 41.5 degrees (BS 3356, ASTM D1388, FAST-2).
    Cantilever(CantileverArgs),
    /// Force and shear angle of a strip cut on the bias and pulled; EB5 as FAST-3 reads it.
    Bias(BiasArgs),
    /// Force and shear stress over the shear angle in a hinged frame.
    PictureFrame(FrameArgs),
}

/// The options that all tests share.
#[derive(Args, Debug)]
pub struct Common {
    /// Fabric file.
    #[arg(value_name = "FABRIC.toml")]
    pub fabric: PathBuf,
    /// For programs.
    #[arg(long)]
    pub json: bool,
    /// Draw the result.
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Replace FILE if it is there.
    #[arg(long)]
    pub force: bool,
    /// Say nothing but findings.
    #[arg(long)]
    pub quiet: bool,
}

/// `fabric test cusick`
#[derive(Args, Debug)]
pub struct CusickArgs {
    /// The options that all tests share.
    #[command(flatten)]
    pub common: Common,
    /// Diameter of the specimen: "24 cm" for limp, "30 cm" for usual, "36 cm" for stiff cloth.
    #[arg(long, value_name = "LENGTH", default_value = "30 cm")]
    pub specimen: Length,
    /// Edge of the mesh.
    #[arg(long, value_name = "LENGTH", default_value = "4 mm")]
    pub edge: Length,
    /// Readings, each from another start; their mean is the result, as in a laboratory.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=12))]
    pub repeats: u32,
    /// Lay the wrong side upwards: cloth that curls without load drapes differently then.
    #[arg(long)]
    pub wrong_side: bool,
    /// The laboratory's drape coefficient, e.g. "62 %", to compare with.
    #[arg(long, value_name = "SHARE")]
    pub lab: Option<Share>,
}

/// `fabric test cantilever`
#[derive(Args, Debug)]
pub struct CantileverArgs {
    /// The options that all tests share.
    #[command(flatten)]
    pub common: Common,
    /// Cut the strip in this direction only [default: all three]
    #[arg(long, value_enum)]
    pub direction: Option<DirectionName>,
    /// Edge of the mesh [default: 2 mm, shorter for limp cloth]
    #[arg(long, value_name = "LENGTH")]
    pub edge: Option<Length>,
}

/// `fabric test bias`
#[derive(Args, Debug)]
pub struct BiasArgs {
    /// The options that all tests share.
    #[command(flatten)]
    pub common: Common,
    /// Largest extension.
    #[arg(long, value_name = "SHARE", default_value = "10 %")]
    pub extension: Share,
    /// Edge of the mesh.
    #[arg(long, value_name = "LENGTH", default_value = "4 mm")]
    pub edge: Length,
}

/// `fabric test picture-frame`
#[derive(Args, Debug)]
pub struct FrameArgs {
    /// The options that all tests share.
    #[command(flatten)]
    pub common: Common,
    /// Largest shear angle.
    #[arg(long, value_name = "ANGLE", default_value = "40 deg")]
    pub angle: Angle,
    /// Edge of the mesh.
    #[arg(long, value_name = "LENGTH", default_value = "4 mm")]
    pub edge: Length,
}

/// Along which yarns a strip is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DirectionName {
    /// Along the grain line.
    Warp,
    /// Across it.
    Weft,
    /// At 45 degrees to both.
    Bias,
}

impl From<DirectionName> for Direction {
    fn from(name: DirectionName) -> Self {
        match name {
            DirectionName::Warp => Self::Warp,
            DirectionName::Weft => Self::Weft,
            DirectionName::Bias => Self::Bias,
        }
    }
}
