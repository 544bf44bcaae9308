//! The working folder.

use super::codes::FIT_BODY;
use super::pipeline::{Copied, copied};
use super::{Order, PIPELINE_NAME};
use crate::engine::{Exit, unwritten, write_whole};
use crate::halt::Halt;
use std::path::Path;
use toile_garment::Diagnostic;
use toile_garment::body::Body;
use toile_stage_api::Registry;

/// Files of the working folder that no round changes.
pub struct Folder {
    /// The new body.
    pub body: Body,
    /// Findings on the body.
    pub findings: Vec<Diagnostic>,
}

impl Folder {
    /// Writes body, pipeline and the files that it reads.
    ///
    /// # Errors
    /// When the body cannot be read, the pipeline cannot be copied, or the disk refuses.
    pub fn write(order: &Order, registry: &Registry) -> Result<Self, Halt> {
        let opened = order.body.open().map_err(|findings| Halt::new(findings, Exit::Input))?;
        let Some(body) = opened.model else {
            let message = format!("`{}` cannot be read as a body", order.body.file_name());
            let finding = Diagnostic::error(FIT_BODY, message).hint("`toile body measure` says what is wrong with it");
            return Err(Halt::new(vec![finding], Exit::Input));
        };
        let Copied { text, files } = copied(&order.request, &order.body.file_name(), registry)?;
        for (name, bytes) in opened.files.iter().chain(&files) {
            put(&order.out.join(name), bytes)?;
        }
        put(&order.out.join(PIPELINE_NAME), text.as_bytes())?;
        Ok(Self { body, findings: opened.findings })
    }
}

/// Writes one file.
///
/// # Errors
/// When the disk refuses.
pub fn put(path: &Path, bytes: &[u8]) -> Result<(), Halt> {
    write_whole(path, bytes).map_err(|e| Halt::new(vec![unwritten(path, &e)], Exit::System))
}
