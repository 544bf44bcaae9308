//! `toile compare` drapes one garment by the paper's method, by its neighbours and by this program's own, on one mesh.
//!
//! `methods` lists them. `rows` runs them and measures what came out, all by one law of the cloth. `table` and `page` show
//! it.

pub(crate) mod codes;
pub mod methods;
pub mod page;
pub mod rows;
pub mod table;

pub use methods::{METHODS, Method, Way};
pub use rows::{Comparison, Listener, Row, Shown, compare};
