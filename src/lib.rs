//! The engine and command line of toile: reads a pipeline, checks the whole chain, runs it, writes outputs and the
//! record of the run. It knows stages only through a [`Registry`](toile_stage_api::Registry).

#[macro_use]
#[path = "../formats/garment/src/code_list.rs"]
mod code_list;

pub mod acceptance;
pub mod bundle;
pub mod cli;
pub mod codes;
pub mod compare;
pub mod diff;
pub mod engine;
pub mod external;
pub mod figure;
pub mod figures;
pub mod fit;
pub mod halt;
pub mod junit;
pub mod line;
pub mod load;
pub mod new;
pub mod pipeline;
pub mod progress;
pub mod render;
pub mod rerun;
pub mod schema;
pub mod study;
pub mod table;
pub mod validate;
pub mod watch;
