//! `toile run`

use super::args::RunArgs;
use super::console::Console;
use crate::engine::codes::OUTPUTS_COLLIDE;
use crate::engine::{self, Allow, Exit, Outcome, RunOptions, Stop, clean, default_out, output_below};
use crate::engine::{Content, Watchdog, known_inputs, of_file_error, refuse_input, unwritten};
use crate::load::{self, Loaded};
use crate::pipeline::{Pipeline, ProgramContent};
use crate::progress::{Teller, Voice};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_garment::Diagnostic;
use toile_stage_api::Registry;

pub(super) fn run(args: &RunArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let loaded = load::load(&args.accuracy.request(&args.pipeline), stop, registry);
    if loaded.report.has_errors() {
        console.findings(&loaded.report.findings, loaded.text());
        return loaded.exit();
    }
    let Loaded { source: Some(source), pipeline: Some(pipeline), gate: Some(gate), report } = loaded else {
        return Exit::Usage;
    };
    if args.tied {
        stop.leave_with_parent();
    }
    let limits = args.limits.limits();
    let content = Content::of(&pipeline, &gate, stop);
    if let Some(finding) = limits.refuse(&content.foresight, Allow::Options) {
        console.findings(&[finding], None);
        return Exit::System;
    }
    let forecast = forecast(content.foresight.seconds(), content.foresight.mb());
    let inputs = known_inputs(&pipeline, &gate, &args.pipeline.pipeline);
    let out = args.out.clone().unwrap_or_else(|| default_out(&pipeline));
    let events = match refuse_output(args, &out, &pipeline).and_then(|()| open_events(args, &inputs)) {
        Ok(events) => events,
        Err(findings) => {
            console.findings(&findings, None);
            return Exit::Usage;
        }
    };
    let threads = pool(args.threads);
    let options = RunOptions {
        out: out.clone(),
        force: args.force,
        preview: args.preview,
        threads,
        allow_write: args.allow_write.clone(),
        set: args.pipeline.set.clone(),
        accuracy: args.accuracy.accuracy.clone(),
        repeats: args.accuracy.repeats,
        pipeline_file: (source.file().to_owned(), source.text().as_bytes().to_vec()),
        foreseen: Some(content.into_foreseen(&pipeline)),
        cache: args.cache.options(),
    };
    let mut teller = Teller::new(if args.quiet { Voice::Quiet } else { Voice::Auto }, events);
    for words in forecast.into_iter().chain(pipeline.contents.iter().filter_map(unstated)) {
        teller.note(&words);
    }
    let watchdog = Watchdog::watch(limits, stop);
    let outcome = engine::run(&pipeline, gate, &options, stop, &mut teller, report);
    drop((teller, watchdog));
    console.result(&summary(&outcome, &out));
    if let Some(page) = page(&outcome).filter(|_| !args.quiet) {
        console.say(&format!("look at {}\n", crate::render::safe(&out.join(page).to_string_lossy())));
    }
    outcome.exit
}

/// Words for a program that runs on its name alone.
fn unstated(program: &ProgramContent) -> Option<String> {
    let ProgramContent { plugin, content, is_stated } = program;
    let words = "was allowed by its name alone; to be refused whenever its files change, write";
    (!is_stated).then(|| format!("plugin `{plugin}` {words} content = \"{}\" in [plugin.{plugin}]", &content[..16]))
}

/// Foreseen seconds from which a run tells its forecast before it begins.
const TELL_SECONDS: f64 = 20.0;

/// Words for work that takes its time, so that nobody waits for a mesh that is finer than meant.
fn forecast(seconds: f64, mb: f64) -> Option<String> {
    (seconds >= TELL_SECONDS).then(|| {
        format!(
            "this is foreseen to take about {seconds:.0} s and {mb:.0} MB; `toile plan` shows what each stage takes"
        )
    })
}

/// Makes the pool of threads, and says how many it has.
pub(super) fn pool(asked: Option<u16>) -> usize {
    let threads = threads(asked);
    // A pool that is there already (a library user's) is taken as it is: results do not depend on it.
    drop(rayon::ThreadPoolBuilder::new().num_threads(threads).build_global());
    threads
}

/// How many threads: as asked, else as the environment says, else one for each core.
pub(super) fn threads(asked: Option<u16>) -> usize {
    let asked = asked.map(usize::from);
    let from_environment = || std::env::var("TOILE_THREADS").ok()?.parse().ok().filter(|n| (1..=1024).contains(n));
    let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    asked.or_else(from_environment).unwrap_or_else(cores)
}

/// Refuses events under the name of an output of the run, which would take their place.
fn refuse_output(args: &RunArgs, out: &Path, pipeline: &Pipeline<'_>) -> Result<(), Vec<Diagnostic>> {
    let Some(events) = args.events.as_deref() else { return Ok(()) };
    let at_rest = |path: &Path| {
        let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some(folder.canonicalize().ok()?.join(path.file_name()?))
    };
    let outputs = engine::planned_outputs(&pipeline.steps).into_iter().filter_map(|o| output_below(&o).ok());
    let mut outputs = outputs.chain([PathBuf::from(engine::RECORD_NAME)]).map(|output| out.join(output));
    if outputs.any(|output| at_rest(&output).is_some_and(|output| at_rest(events) == Some(output))) {
        let message = format!("events and an output of the run are both called `{}`", clean(events));
        let finding = Diagnostic::error(OUTPUTS_COLLIDE, message);
        return Err(vec![finding.hint("give --events another name")]);
    }
    Ok(())
}

fn open_events(args: &RunArgs, inputs: &[PathBuf]) -> Result<Option<Box<dyn Write + Send>>, Vec<Diagnostic>> {
    let Some(path) = &args.events else { return Ok(None) };
    refuse_input(path, inputs).map_err(|error| of_file_error(&error).0)?;
    let mut options = std::fs::File::options();
    options.write(true);
    if args.force {
        options.create(true).truncate(true)
    } else {
        options.create_new(true)
    };
    match options.open(path) {
        Ok(file) => Ok(Some(Box::new(file))),
        Err(error) => Err(vec![unwritten(path, &error)]),
    }
}

/// The result: one line per output.
/// The page among the outputs, if there is one.
fn page(outcome: &Outcome) -> Option<&str> {
    let outputs = outcome.record.as_ref()?.outputs.iter();
    outputs.map(|o| o.path.as_str()).find(|path| path.ends_with(".html"))
}

fn summary(outcome: &Outcome, out: &Path) -> String {
    let Some(record) = &outcome.record else { return String::new() };
    let mut text = String::new();
    for output in &record.outputs {
        text.push_str(&format!("{}\n", crate::render::safe(&out.join(&output.path).to_string_lossy())));
    }
    text.push_str(&format!("{}\n", crate::render::safe(&out.join(engine::RECORD_NAME).to_string_lossy())));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_work_is_told_before_it_begins() {
        assert_eq!(forecast(3.0, 5000.0), None);
        assert!(forecast(87.4, 12_941.0).is_some_and(|words| words.contains("about 87 s and 12941 MB")));
    }
}
