//! `toile line plan` and `toile line jobs`.

use super::args::{JobsArgs, PlanLineArgs};
use super::sound;
use crate::cli::console::Console;
use crate::engine::{Exit, Stop};
use crate::line::{Line, Planned, Survey};
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use toile_stage_api::Registry;

pub(super) fn plan(args: &PlanLineArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let (line, survey) = match sound(&args.file, registry, stop, console) {
        Ok(both) => both,
        Err(exit) => return exit,
    };
    let sums = Sums::of(&line, &survey);
    if args.json {
        console.json(&sums.json(&line))
    } else {
        console.result(&crate::render::safe(&sums.text(&line)))
    }
    Exit::Good
}

pub(super) fn jobs(args: &JobsArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let (line, survey) = match sound(&args.file, registry, stop, console) {
        Ok(both) => both,
        Err(exit) => return exit,
    };
    for (job, surveyed) in line.jobs.iter().zip(&survey.jobs) {
        let Some(planned) = &surveyed.planned else { continue };
        console.result(&format!("{}\n", toile_garment::text::json(&planned.json(&line, job).to_string())));
    }
    Exit::Good
}

/// Jobs, time and memory of a whole line.
struct Sums {
    /// Jobs and CPU seconds of each style.
    styles: BTreeMap<String, (usize, f64)>,
    /// Jobs with different contents.
    contents: usize,
    seconds: f64,
    longest: f64,
    mb: f64,
    files: usize,
}

impl Sums {
    fn of(line: &Line, survey: &Survey) -> Self {
        let planned = || line.jobs.iter().zip(&survey.jobs).filter_map(|(job, s)| Some((job, s.planned.as_ref()?)));
        let mut styles: BTreeMap<String, (usize, f64)> = BTreeMap::new();
        for (job, plan) in planned() {
            let sum = styles.entry(job.style.clone()).or_default();
            *sum = (sum.0 + 1, sum.1 + plan.seconds);
        }
        let largest = |of: &dyn Fn(&Planned) -> f64| planned().map(|(_, p)| of(p)).fold(0.0, f64::max);
        Self {
            contents: planned().map(|(_, p)| &p.key).collect::<BTreeSet<_>>().len(),
            seconds: planned().map(|(_, p)| p.seconds).sum(),
            longest: largest(&|p| p.seconds),
            mb: largest(&|p| p.mb),
            // The record, beside the outputs.
            files: planned().map(|(_, p)| p.outputs.len() + 1).sum(),
            styles,
        }
    }

    fn json(&self, line: &Line) -> serde_json::Value {
        let style = |(name, (jobs, seconds)): (&String, &(usize, f64))| json!({ "style": name, "jobs": jobs, "cpu_seconds": milli(*seconds) });
        json!({
            "line": line.file.name,
            "jobs": line.jobs.len(),
            "different": self.contents,
            "styles": self.styles.iter().map(style).collect::<Vec<_>>(),
            "cpu_seconds": milli(self.seconds),
            "core_hours": milli(self.seconds / 3600.0),
            "longest_seconds": milli(self.longest),
            "mb_per_job": milli(self.mb),
            "files": self.files,
        })
    }

    fn text(&self, line: &Line) -> String {
        let mut text = format!("{}: {} jobs, {} of them different\n", line.file.name, line.jobs.len(), self.contents);
        for (style, (jobs, seconds)) in &self.styles {
            text.push_str(&format!("{style:<24} {jobs:>7} jobs {:>10}\n", in_words(*seconds)));
        }
        text.push_str(&format!(
            "in all {} of one core, the longest job {}, at most {:.0} MB a job, {} files\n",
            in_words(self.seconds),
            in_words(self.longest),
            self.mb,
            self.files
        ));
        text
    }
}

fn milli(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}

fn in_words(seconds: f64) -> String {
    match seconds {
        s if s < 120.0 => format!("{s:.1} s"),
        s if s < 7200.0 => format!("{:.1} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
