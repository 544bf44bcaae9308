//! `toile study` shows for one garment how the error falls as the time grows.
//!
//! `grid` says which settings are run, `runs` runs them into folders and takes up where an earlier study ended.
//! `carried` puts the finest drape onto coarser meshes, so that the error of the mesh is told apart from other folds.
//! `measure` compares what came out with the finest, `estimate` tells the error from two levels, `front` finds what is
//! worth its price. `table`, `chart`, `pictures` and `page` show it. `presets` are the points with names, `choose` picks one for
//! `accuracy = "2 mm"`.

pub mod carried;
pub mod chart;
pub mod choose;
pub(crate) mod codes;
pub mod estimate;
pub mod front;
pub mod grid;
pub mod measure;
pub mod page;
pub mod pictures;
pub mod presets;
pub mod report;
pub mod runs;
pub mod table;

pub use grid::{Axes, Setting};
pub use presets::{PRESETS, Preset};
pub use report::{Row, Study, finest, report};
pub use runs::{Bench, Done, Ran};
