//! One file with all that a run read, which reproduces the run elsewhere.
//!
//! The file is a tar archive of plain files with fixed dates and no owners. `toile-bundle.json` comes first: pipeline,
//! overrides, every file with size and hash, and the hashes of the outputs. Files stand to each other as they stood on
//! the machine of the run, so the pipeline runs from the unpacked folder. Files that were named by `--set` stand below
//! `given`.

mod archive;
mod check;
pub(crate) mod codes;
mod manifest;
mod pack;
mod replay;

pub use check::{Bundle, open};
pub use manifest::{MANIFEST_NAME, Manifest, PackedFile};
pub use pack::{Order, Packed, pack};
pub use replay::replay;
