//! `toile watch`

use super::args::WatchArgs;
use super::console::Console;
use crate::engine::{Allow, CacheOptions, Content, Exit, Limits, RunOptions, Stop, default_out};
use crate::load::{self, Loaded};
use crate::progress::{Teller, Voice};
use crate::watch::{PAGE_NAME, Watched, show};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use toile_stage_api::Registry;

/// How often the files are looked at.
const TICK: Duration = Duration::from_millis(150);

pub(super) fn run(args: &WatchArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let threads = super::run::pool(args.threads);
    let mut number = 0;
    let mut last = Exit::Good;
    let mut watched = Watched::default();
    while !stop.asked() && args.runs.is_none_or(|most| number < most) {
        number += 1;
        let (seen, exit) = once(args, registry, stop, console, (number, threads));
        // Nothing will come of a name that no file has. A file that goes later comes again: editors save so.
        if number == 1 && !args.pipeline.pipeline.is_file() {
            return exit;
        }
        last = exit;
        // A pipeline with mistakes tells of no files: those of the run before are watched on.
        watched = seen.unwrap_or_else(|| watched.now());
        console.say(&format!("run {number}: {}\n", exit.word()));
        while !stop.asked() && args.runs.is_none_or(|most| number < most) {
            std::thread::sleep(TICK);
            let now = watched.now();
            let changed = watched.changed(&now);
            // A file that is still being written changes again within a tick.
            if !changed.is_empty() && now == watched.now() {
                let names: Vec<String> = changed.iter().map(|p| p.to_string_lossy().into_owned()).collect();
                console.say(&crate::render::safe(&format!("changed: {}\n", names.join(", "))));
                break;
            }
        }
    }
    if stop.asked() { Exit::Stopped } else { last }
}

/// One run; the files that it read, and how it ended.
fn once(
    args: &WatchArgs,
    registry: &mut Registry,
    stop: &Arc<Stop>,
    console: &mut Console<'_>,
    (number, threads): (usize, usize),
) -> (Option<Watched>, Exit) {
    let file = &args.pipeline.pipeline;
    let loaded = load::load(&args.accuracy.request(&args.pipeline), stop, registry);
    if loaded.report.has_errors() {
        console.findings(&loaded.report.findings, loaded.text());
        let seen = (number == 1).then(|| Watched::of(file, &[], None));
        return (seen, loaded.exit());
    }
    let Loaded { source: Some(source), pipeline: Some(pipeline), gate: Some(gate), report } = loaded else {
        return (None, Exit::Usage);
    };
    let content = Content::of(&pipeline, &gate, stop);
    let watched = Watched::of(file, &content.reads, Some(&gate));
    if let Some(finding) = Limits::default().refuse(&content.foresight, Allow::Nowhere) {
        console.findings(&[finding], None);
        return (Some(watched), Exit::System);
    }
    let out = args.out.clone().unwrap_or_else(|| default_out(&pipeline));
    let options = RunOptions {
        out: out.clone(),
        force: true,
        preview: false,
        threads,
        allow_write: Vec::new(),
        set: args.pipeline.set.clone(),
        accuracy: args.accuracy.accuracy.clone(),
        repeats: args.accuracy.repeats,
        pipeline_file: (source.file().to_owned(), source.text().as_bytes().to_vec()),
        foreseen: Some(content.into_foreseen(&pipeline)),
        cache: Some(cache(args, &out)),
    };
    let mut teller = Teller::new(if args.quiet { Voice::Quiet } else { Voice::Auto }, None);
    let outcome = crate::engine::run(&pipeline, gate, &options, stop, &mut teller, report);
    drop(teller);
    let outputs = outcome.record.iter().flat_map(|r| &r.outputs).map(|o| o.path.as_str());
    let page = outputs.into_iter().find(|p| p.ends_with(".html")).unwrap_or("failure.html");
    match show(&out, number, page) {
        Ok(()) if number == 1 => {
            console.result(&crate::render::safe(&format!("{}\n", out.join(PAGE_NAME).to_string_lossy())))
        }
        Ok(()) => {}
        Err(error) => console.say(&format!("the page cannot be written: {error}\n")),
    }
    (Some(watched), outcome.exit)
}

/// The cache that is asked for, else one beside the outputs.
fn cache(args: &WatchArgs, out: &std::path::Path) -> CacheOptions {
    let own = || CacheOptions { folder: PathBuf::from(out).join("cache"), limit: args.cache.limit() };
    args.cache.options().unwrap_or_else(own)
}
