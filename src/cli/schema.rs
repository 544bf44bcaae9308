//! `toile schema [KIND]`

use super::args::{FileKind, SchemaArgs};
use super::console::Console;
use crate::engine::Exit;
use crate::schema::pipeline_schema;
use toile_stage_api::Registry;

pub(super) fn run(args: &SchemaArgs, registry: &Registry, console: &mut Console<'_>) -> Exit {
    console.json(&match args.kind {
        FileKind::Pipeline => pipeline_schema(registry),
        FileKind::Sewing => toile_formats::sewing::schema(),
        FileKind::Fabric => toile_formats::fabric::schema(),
        FileKind::Body => toile_formats::body::schema(),
        FileKind::Line => crate::line::schema(),
        FileKind::Test => crate::acceptance::schema(),
    });
    Exit::Good
}
