//! `toile line`: a product line is checked, planned, listed and run.

mod args;
mod plan;
mod run;

pub use args::LineArgs;

use super::args::Format;
use super::console::Console;
use crate::engine::{Exit, Stop};
use crate::line::{Line, Survey, open, survey};
use crate::render::findings_json;
use args::{CheckLineArgs, LineFileArgs, LineVerb};
use std::sync::Arc;
use toile_stage_api::Registry;

pub(super) fn run(args: &LineArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    match &args.verb {
        LineVerb::Check(args) => check(args, registry, stop, console),
        LineVerb::Plan(args) => plan::plan(args, registry, stop, console),
        LineVerb::Jobs(args) => plan::jobs(args, registry, stop, console),
        LineVerb::Run(args) => run::run(args, registry, stop, console),
        LineVerb::Report(args) => run::report(args, console),
    }
}

fn check(args: &CheckLineArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let opened = open(&args.file.line);
    let mut findings = opened.report.findings;
    let mut exit = Exit::of_findings(&findings);
    let Some(line) = opened.line else {
        tell(args, &findings, None, console);
        return exit;
    };
    // The jobs are looked at also where the file itself has mistakes: all are found at once.
    let survey = survey(&line, &args.file.rights(), stop, registry);
    findings.extend(survey.findings(&line).findings);
    exit = if exit == Exit::Good { survey.exit() } else { exit };
    tell(args, &findings, Some(&line), console);
    if exit == Exit::Good && args.format == Format::Text {
        console.result(&format!("the line is sound: {} jobs\n", line.jobs.len()));
    }
    exit
}

fn tell(args: &CheckLineArgs, findings: &[toile_garment::Diagnostic], line: Option<&Line>, console: &mut Console<'_>) {
    if args.format == Format::Json {
        console.json(&findings_json(findings));
    } else {
        console.findings(findings, line.map(|l| (l.source.file(), l.source.text())));
    }
}

/// Opens a line and looks at all its jobs; with mistakes there is only an exit.
fn sound(
    args: &LineFileArgs,
    registry: &mut Registry,
    stop: &Arc<Stop>,
    console: &mut Console<'_>,
) -> Result<(Line, Survey), Exit> {
    let line = opened(args, console)?;
    let survey = survey(&line, &args.rights(), stop, registry);
    console.findings(&survey.findings(&line).findings, Some((line.source.file(), line.source.text())));
    match survey.exit() {
        Exit::Good => Ok((line, survey)),
        exit => Err(exit),
    }
}

/// Opens a line; its jobs are not looked at.
fn opened(args: &LineFileArgs, console: &mut Console<'_>) -> Result<Line, Exit> {
    let opened = open(&args.line);
    let exit = Exit::of_findings(&opened.report.findings);
    let source = opened.line.as_ref().map(|l| (l.source.file(), l.source.text()));
    console.findings(&opened.report.findings, source);
    opened.line.filter(|_| exit == Exit::Good).ok_or(exit)
}
