//! `toile completions SHELL`

use super::args::{Cli, CompletionsArgs};
use super::console::Console;
use crate::engine::Exit;
use clap::CommandFactory as _;

pub(super) fn run(args: &CompletionsArgs, console: &mut Console<'_>) -> Exit {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "toile", &mut script);
    console.result(&String::from_utf8_lossy(&script));
    Exit::Good
}
