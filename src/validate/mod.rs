//! `toile validate drape` predicts measured drapes of real cloth, and tells where it fails.
//!
//! `captures` reads what a laboratory measured. `laws` are ways of describing a cloth; each is set by one capture of a face.
//! `rows` lets the cloth fall and judges it by all other captures. `table` and `chart` show the result.

pub mod band;
pub mod captures;
pub mod chart;
pub(crate) mod codes;
pub mod laws;
pub mod rows;
pub mod specimen;
pub mod table;

pub use captures::{Captured, captured};
pub use laws::{LAWS, Law};
pub use rows::{Row, Validation, validate};
