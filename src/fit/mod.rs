//! `toile fit`: the pattern of a garment for another body, with the ease that it has or that is asked for.
//!
//! The garment is draped on its own body once. Each round moves this drape to the other body (`transfer`), lays it flat
//! (`flatten`), writes the pattern, and sews and drapes the pattern on the body. The ease that is missing there is added
//! in the next round. The result is a working folder: pattern, sewing file, body, fabric and a pipeline that sews them.
//! A pattern of several sizes is also written in all of them.

pub mod changes;
pub(crate) mod codes;
mod folder;
mod hem;
mod levels;
mod page;
mod pipeline;
mod report;
mod response;
mod rounds;
mod sizes;
mod trial;
mod wearing;

pub use changes::changes;
pub use folder::put;
pub use levels::{Level, Round};
pub use page::html;
pub use report::{json, text};
pub use rounds::fit;

use crate::load::Request;
use crate::new::Body;
use changes::Change;
use hem::Hem;
use std::collections::BTreeMap;
use std::path::PathBuf;
use toile_garment::{Diagnostic, Garment};

/// The pattern of the folder.
pub const PATTERN_NAME: &str = "pattern.dxf";
/// Its sewing file.
pub const SEWING_NAME: &str = "pattern.sewing.toml";
/// The new pattern in all sizes of the old one, where it has several.
pub const ALL_SIZES_NAME: &str = "all-sizes.dxf";
/// Its grade rules.
pub const ALL_SIZES_RULES_NAME: &str = "all-sizes.rul";
/// The pipeline of the folder.
pub const PIPELINE_NAME: &str = "pipeline.toml";

/// Folder of the first drape, on the garment's own body.
pub const OWN_NAME: &str = "own";

/// The wishes of a person.
pub struct Order {
    /// The pipeline.
    pub request: Request,
    /// The working folder.
    pub out: PathBuf,
    /// The body that the garment shall fit.
    pub body: Body,
    /// Ease that is asked for, by the name of its height; elsewhere the garment keeps its own. Metres.
    pub ease: BTreeMap<String, f64>,
    /// Largest difference of an ease from what is asked, metres.
    pub within: f64,
    /// Rounds after which it ends in any case.
    pub rounds: u32,
    /// Parameters of `flatten`, as a TOML value.
    pub flatten: String,
    /// Threads.
    pub threads: usize,
}

/// A garment that was fitted.
pub struct Fitted {
    /// Ease by height, from above to below.
    pub levels: Vec<Level>,
    /// The rounds.
    pub rounds: Vec<Round>,
    /// Changes of the pattern.
    pub changes: Vec<Change>,
    /// Heights of the hem.
    pub hems: Vec<Hem>,
    /// The garment on its own body, moved and laid flat: the new pattern over the old one.
    pub flat: Garment,
    /// The new pattern, sewn and draped on the body.
    pub worn: Garment,
    /// Findings.
    pub findings: Vec<Diagnostic>,
    /// True if the ease is within the bounds and the last drape passed.
    pub passed: bool,
}
