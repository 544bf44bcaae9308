//! `toile line run` and `toile line report`.

use super::args::{ReportArgs, RunLineArgs};
use super::{opened, sound};
use crate::cli::console::Console;
use crate::codes::{FILE_MISSING, PATH_REFUSED, WRITE_FAILED};
use crate::engine::{CacheOptions, Exit, Stop, available_mb, clean, unwritten, write_whole};
use crate::line::{Job, Line, Lock, Order, RESULTS_NAME, Ran, Results, Survey, draw, only, page, was_run};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_formats::report::Language;
use toile_garment::Diagnostic;
use toile_stage_api::Registry;

/// Part of the free memory that the jobs may have together.
const SHARE_OF_MEMORY: f64 = 0.8;

pub(super) fn run(args: &RunLineArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let (line, survey) = match sound(&args.file, registry, stop, console) {
        Ok(both) => both,
        Err(exit) => return exit,
    };
    let wanted = match only(&line.jobs, &args.only) {
        Ok(wanted) => wanted,
        Err(error) => return refuse(&error, console),
    };
    let out = match made(&folder(args.out.as_ref(), &line)) {
        Ok(out) => out,
        Err(error) => return refuse(&error, console),
    };
    let _lock = match Lock::take(&out) {
        Ok(lock) => lock,
        Err(error) => return refuse(&error, console),
    };
    let order = match order(args, &line, &survey, out.clone()) {
        Ok(order) => order,
        Err(error) => return refuse(&error, console),
    };
    let mut told = |done: usize, job: &Job, ran: &Ran| {
        if !args.quiet && !ran.kept {
            let status = ran.record.as_ref().and_then(|r| r["status"].as_str()).unwrap_or("no-record");
            let seconds = ran.record.as_ref().and_then(|r| r["seconds"].as_f64()).unwrap_or(0.0);
            let text = format!("{done}/{} {} {status} {seconds:.1} s\n", wanted.len(), job.name);
            console.say(&crate::render::safe(&text));
        }
    };
    let ran = order.run(&wanted, stop, &mut told);
    if stop.asked() {
        console.say("stopped; what is done is kept, and the same command goes on from there\n");
        return Exit::Stopped;
    }
    let kept = ran.iter().flatten().filter(|r| r.kept).count();
    // What was not wanted this time may be done all the same. It is shown and not judged.
    let ran = (0..line.jobs.len()).map(|k| ran[k].clone().or_else(|| was_run(&order.folder(&line.jobs[k])))).collect();
    let before = format!("{kept} of {} were done before; ", wanted.len());
    finish(&line, &out, ran, (&wanted, &before), args.language.language(), console)
}

/// The records tell all, so no job is looked at: that would take longer than many a job.
pub(super) fn report(args: &ReportArgs, console: &mut Console<'_>) -> Exit {
    let line = match opened(&args.file, console) {
        Ok(line) => line,
        Err(exit) => return exit,
    };
    let out = folder(args.out.as_ref(), &line);
    if !out.join("jobs").is_dir() {
        let message = format!("there are no results of a line in `{}`", clean(&out));
        let hint = "`toile line run` makes them; name their folder with --out";
        return refuse(&Diagnostic::error(FILE_MISSING, message).hint(hint), console);
    }
    let all: Vec<usize> = (0..line.jobs.len()).collect();
    let ran = line.jobs.par_iter().map(|job| was_run_and_drawn(&out, job)).collect();
    finish(&line, &out, ran, (&all, ""), args.language.language(), console)
}

/// How a job ended that another program may have run. Such programs draw no picture.
fn was_run_and_drawn(out: &Path, job: &Job) -> Option<Ran> {
    let folder = out.join("jobs").join(&job.name);
    let ran = was_run(&folder)?;
    let picture = out.join("pictures").join(format!("{}.png", job.name));
    if let Some(record) = ran.record.as_ref().filter(|_| !picture.exists()) {
        // The page does without where nothing can be drawn.
        let _ = draw(&folder, record, &picture);
    }
    Some(ran)
}

/// The folder of the results.
fn folder(asked: Option<&PathBuf>, line: &Line) -> PathBuf {
    asked.cloned().unwrap_or_else(|| PathBuf::from("out").join(format!("{}-line", line.file.name)))
}

/// Makes the folder of the results with the folders that all jobs share.
fn made(out: &Path) -> Result<PathBuf, Diagnostic> {
    let failed = |e: std::io::Error| {
        let message = format!("cannot write into `{}`: {e}", clean(out));
        Diagnostic::error(WRITE_FAILED, message).hint("choose another folder with --out")
    };
    for name in ["jobs", "logs"] {
        std::fs::create_dir_all(out.join(name)).map_err(failed)?;
    }
    out.canonicalize().map_err(failed)
}

fn order<'a>(args: &RunLineArgs, line: &'a Line, survey: &'a Survey, out: PathBuf) -> Result<Order<'a>, Diagnostic> {
    let program = std::env::current_exe().map_err(|e| {
        let message = format!("the program cannot find its own file: {e}");
        Diagnostic::error(PATH_REFUSED, message).hint("run it by its full path")
    })?;
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let processes = args.jobs.map_or(cores, usize::from);
    let here = |dir: &Path| std::path::absolute(dir).unwrap_or_else(|_| dir.to_path_buf());
    Ok(Order {
        line,
        survey,
        out,
        program,
        rights: args.file.rights(),
        processes,
        threads: args.threads.map_or((cores / processes).max(1), usize::from),
        mb: args.memory.or_else(|| available_mb().map(|mb| SHARE_OF_MEMORY * mb)).unwrap_or(f64::INFINITY),
        cache: args.cache.options().map(|c| CacheOptions { folder: here(&c.folder), ..c }),
        force: args.force,
    })
}

/// Writes the results of all jobs. The exit is that of the judged ones.
fn finish(
    line: &Line,
    out: &Path,
    ran: Vec<Option<Ran>>,
    (judged, before): (&[usize], &str),
    language: Language,
    console: &mut Console<'_>,
) -> Exit {
    let results = Results::collect(line, &ran, out);
    let texts = [
        (RESULTS_NAME, results.to_text()),
        ("index.html", page::html(&results, language)),
        ("line.csv", page::csv(&results)),
        ("line.xml", page::junit(&results)),
    ];
    for (name, text) in texts {
        let path = out.join(name);
        if let Err(error) = write_whole(&path, text.as_bytes()) {
            return refuse(&unwritten(&path, &error), console);
        }
    }
    let counts: Vec<String> = results.counts().iter().map(|(status, count)| format!("{count} {status}")).collect();
    let page = out.join("index.html");
    let text = format!("{} jobs: {before}{}\n{}\n", line.jobs.len(), counts.join(", "), page.to_string_lossy());
    console.result(&crate::render::safe(&text));
    results.exit(judged)
}

fn refuse(finding: &Diagnostic, console: &mut Console<'_>) -> Exit {
    console.findings(std::slice::from_ref(finding), None);
    if finding.code == WRITE_FAILED { Exit::System } else { Exit::Usage }
}
