//! Watching a pipeline: a run after every change of a file that it reads, and a page that shows the last one.

mod files;
mod page;

pub use files::Watched;
pub use page::{PAGE_NAME, show};
