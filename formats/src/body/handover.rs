//! The body that was read last, kept until the same files are read again: a forecast reads it, and then the run.
//!
//! A scan of a million triangles takes seconds to read. It is told by the content of its files, so what is handed over
//! is what reading them again would give.

use super::ReadBody;
use std::sync::{Mutex, PoisonError};

/// The files of a body: digest of the mesh, its name for messages, and the text beside it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Files {
    pub digest: String,
    pub name: String,
    pub side: Option<String>,
}

static LAST: Mutex<Option<(Files, ReadBody)>> = Mutex::new(None);

/// Keeps a body that was read, in place of the one before.
pub fn keep(files: Files, read: &ReadBody) {
    *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Some((files, read.clone()));
}

/// Hands over the body of these files, if they were the last to be read. It is no longer kept then.
pub fn take(files: &Files) -> Option<ReadBody> {
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    last.take_if(|(kept, _)| kept == files).map(|(_, read)| read)
}
