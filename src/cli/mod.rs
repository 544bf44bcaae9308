//! The command line: one file per verb. stdout carries results only; progress and findings go to stderr.

mod args;
mod bench;
mod body;
mod bundle;
mod check;
pub(crate) mod codes;
mod compare;
mod completions;
mod console;
mod deps;
mod diff;
mod explain;
mod fabric;
mod fit;
mod flatten;
mod inspect;
mod line;
mod new;
mod plan;
mod results;
mod run;
mod schema;
mod stages;
mod study;
mod test;
mod validate;
mod watch;

use crate::engine::{Exit, Stop};
use args::{Cli, Verb};
use clap::Parser as _;
use console::Console;
use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;
use std::sync::Arc;
use toile_stage_api::Registry;

/// The whole program: an own binary with own stages is `fn main() -> ExitCode { cli::main(builtin().with(Mine)) }`.
#[must_use]
pub fn main(registry: Registry) -> ExitCode {
    crate::engine::quiet_panics();
    let stop = Stop::new();
    stop.listen();
    let code = run_from(std::env::args_os(), registry, &stop, &mut std::io::stdout(), &mut std::io::stderr());
    ExitCode::from(code)
}

/// The program with given arguments and writers; gives the exit code.
pub fn run_from(
    arguments: impl IntoIterator<Item = OsString>,
    registry: Registry,
    stop: &Arc<Stop>,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> u8 {
    let mut console = Console::new(out, err);
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => {
            let text = error.render().to_string();
            if error.use_stderr() {
                console.say(&text)
            } else {
                console.result(&text)
            }
            return u8::try_from(error.exit_code()).unwrap_or(Exit::Usage.code());
        }
    };
    let registry = match registry.checked() {
        Ok(registry) => registry,
        Err(error) => {
            console.say(&format!("internal error: {error}\n"));
            return Exit::System.code();
        }
    };
    let work = std::panic::AssertUnwindSafe(|| dispatch(cli, registry, stop, &mut console));
    match std::panic::catch_unwind(work) {
        Ok(exit) => exit.code(),
        Err(panic) => {
            let said = crate::engine::panic_text(panic.as_ref());
            console.say(&format!("error[internal-error] internal error: {said}; please report it\n"));
            Exit::System.code()
        }
    }
}

fn dispatch(cli: Cli, mut registry: Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    match cli.verb {
        Verb::Run(args) => run::run(&args, &mut registry, stop, console),
        Verb::Watch(args) => watch::run(&args, &mut registry, stop, console),
        Verb::New(args) => new::run(&args, console),
        Verb::Check(args) => check::run(&args, &mut registry, stop, console),
        Verb::Plan(args) => plan::run(&args, &mut registry, stop, console),
        Verb::Diff(args) => diff::run(&args, console),
        Verb::Deps(args) => deps::run(&args, &mut registry, stop, console),
        Verb::Test(args) => test::run(&args, &mut registry, stop, console),
        Verb::Bundle(args) => bundle::run(&args, &mut registry, stop, console),
        Verb::Line(args) => line::run(&args, &mut registry, stop, console),
        Verb::Inspect(args) => inspect::run(&args, console),
        Verb::Fit(args) => fit::run(&args, &mut registry, stop, console),
        Verb::Flatten(args) => flatten::run(&args, &registry, stop, console),
        Verb::Validate(args) => validate::run(&args, stop, console),
        Verb::Compare(args) => compare::run(&args, &mut registry, stop, console),
        Verb::Study(args) => study::run(&args, &mut registry, stop, console),
        Verb::Body(args) => body::run(&args, console),
        Verb::Fabric(args) => fabric::run(&args, stop, console),
        Verb::Stages(args) => stages::run(&args, &registry, console),
        Verb::Schema(args) => schema::run(&args, &registry, console),
        Verb::Explain(args) => explain::run(&args, console),
        Verb::Completions(args) => completions::run(&args, console),
    }
}
