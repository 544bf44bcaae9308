//! `toile schema`

use super::console::Console;
use crate::engine::Exit;
use crate::schema::pipeline_schema;
use toile_stage_api::Registry;

pub(super) fn run(registry: &Registry, console: &mut Console<'_>) -> Exit {
    console.json(&pipeline_schema(registry));
    Exit::Good
}
