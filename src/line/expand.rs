//! From the matrix to single jobs.

use super::codes;
use super::document::{Axis, Choice, Include, LineFile, Rule, Style};
use super::value::Set;
use crate::pipeline::{SourceText, remedy};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::PathBuf;
use toile_garment::{Diagnostic, Report};

/// Most jobs of one line.
const MAX_JOBS: usize = 1_000_000;

/// One garment of a line: one folder, one `toile run`.
#[derive(Clone, Debug)]
pub struct Job {
    /// Name, which is that of its folder: style and choices, joined by `_`.
    pub name: String,
    /// Style.
    pub style: String,
    /// Choice by axis.
    pub choices: BTreeMap<String, String>,
    /// Pipeline file, from the folder of the line.
    pub pipeline: PathBuf,
    /// Overrides; a later one of the same key wins.
    pub sets: Vec<Set>,
    /// The place in the file that makes it.
    pub span: Range<usize>,
}

/// All jobs of a line, without those that are excluded.
pub fn expand(file: &LineFile, source: &SourceText, report: &mut Report) -> Vec<Job> {
    let before = report.findings.len();
    let mut plan = Plan { file, source, report, jobs: Vec::new() };
    plan.check_rules();
    file.styles.iter().for_each(|style| plan.style(style));
    plan.exclude();
    file.includes.iter().for_each(|include| plan.include(include));
    plan.check_names();
    let mut jobs = std::mem::take(&mut plan.jobs);
    if jobs.is_empty() && report.findings.len() == before {
        let message = "the line has no job";
        report.push(source.error(codes::LINE_EMPTY, &(0..0), message).hint("add a [[style]] with name and pipeline"));
    }
    jobs.iter_mut().for_each(|job| last_wins(&mut job.sets));
    jobs
}

/// Keeps the last override of each key, at the place of the first.
fn last_wins(sets: &mut Vec<Set>) {
    let mut kept: Vec<Set> = Vec::with_capacity(sets.len());
    for set in sets.drain(..) {
        match kept.iter_mut().find(|k| k.key() == set.key()) {
            Some(before) => *before = set,
            None => kept.push(set),
        }
    }
    *sets = kept;
}

struct Plan<'a> {
    file: &'a LineFile,
    source: &'a SourceText,
    report: &'a mut Report,
    jobs: Vec<Job>,
}

impl<'a> Plan<'a> {
    /// The axes of a style: those of the matrix, with its own in their place.
    fn axes(&self, style: &'a Style) -> Vec<&'a Axis> {
        let own = |name: &str| style.axes.iter().find(|a| a.name == name);
        let common = self.file.axes.iter().map(|axis| own(&axis.name).unwrap_or(axis));
        let is_new = |a: &&Axis| !self.file.axes.iter().any(|common| common.name == a.name);
        common.chain(style.axes.iter().filter(is_new)).collect()
    }

    fn style(&mut self, style: &'a Style) {
        let axes = self.axes(style);
        let count = axes.iter().try_fold(self.jobs.len(), |n, axis| n.checked_mul(axis.choices.len().max(1)));
        if count.is_none_or(|n| n > MAX_JOBS) {
            let message = format!("the line has more than {MAX_JOBS} jobs");
            let finding = self.source.error(codes::LINE_TOO_LARGE, &style.span, message);
            self.report.push(finding.hint("divide it into several files"));
            return;
        }
        let mut rows: Vec<Vec<&Choice>> = vec![Vec::new()];
        for axis in &axes {
            let grown = |row: &Vec<&'a Choice>| -> Vec<Vec<&'a Choice>> {
                axis.choices.iter().map(|choice| row.iter().copied().chain([choice]).collect()).collect()
            };
            rows = rows.iter().flat_map(grown).collect();
        }
        for row in rows {
            let cells = axes.iter().map(|a| a.name.as_str()).zip(row);
            self.jobs.push(job(style, cells, style.span.clone()));
        }
    }

    fn exclude(&mut self) {
        for rule in &self.file.excludes {
            let before = self.jobs.len();
            self.jobs.retain(|job| !is_excluded(job, rule));
            if before == self.jobs.len() {
                let place = self.source.place(&rule.span);
                let finding = Diagnostic::warning(codes::LINE_RULE_UNUSED, "this exclude leaves out no job");
                self.report.push(finding.at(place).hint("correct it, or take it out"));
            }
        }
    }

    /// Names in excludes that stand nowhere.
    fn check_rules(&mut self) {
        for rule in &self.file.excludes {
            for (axis, choices) in &rule.cells {
                let Some(known) = self.known(axis, &rule.span) else { continue };
                for choice in choices.iter().filter(|c| !known.contains(c.label.as_str())) {
                    self.unknown(&format!("`{axis}` has no `{}`", choice.label), &choice.label, &known, &choice.span);
                }
            }
        }
    }

    /// The labels of an axis over all styles; an unknown axis is a finding.
    fn known(&mut self, axis: &str, span: &Range<usize>) -> Option<BTreeSet<&'a str>> {
        let file = self.file;
        if axis == "style" {
            return Some(file.styles.iter().map(|s| s.name.as_str()).collect());
        }
        let all = || file.axes.iter().chain(file.styles.iter().flat_map(|s| &s.axes));
        if all().all(|a| a.name != axis) {
            let names: BTreeSet<&str> = all().map(|a| a.name.as_str()).chain(["style"]).collect();
            self.unknown(&format!("the matrix has no `{axis}`"), axis, &names, span);
            return None;
        }
        Some(all().filter(|a| a.name == axis).flat_map(|a| &a.choices).map(|c| c.label.as_str()).collect())
    }

    fn unknown(&mut self, message: &str, name: &str, known: &BTreeSet<&str>, span: &Range<usize>) {
        let finding = self.source.error(codes::LINE_CHOICE_UNKNOWN, span, message);
        self.report.push(finding.hint(remedy(name, known.iter().copied())));
    }

    fn include(&mut self, include: &'a Include) {
        let wanted = include.style.get_ref();
        let Some(style) = self.file.styles.iter().find(|s| s.name == *wanted) else {
            let known = self.file.styles.iter().map(|s| s.name.as_str()).collect();
            self.unknown(&format!("there is no style `{wanted}`"), wanted, &known, &include.style.span());
            return;
        };
        let axes = self.axes(style);
        let choice_of = |axis: &str, plain: &'a Choice| {
            let known = axes.iter().find(|a| a.name == axis).into_iter().flat_map(|a| &a.choices);
            known.into_iter().find(|c| c.label == plain.label).unwrap_or(plain)
        };
        let cells = include.cells.iter().map(|(axis, plain)| (axis.as_str(), choice_of(axis, plain)));
        let mut job = job(style, cells, include.span.clone());
        job.sets.extend(include.sets.iter().cloned());
        if let Some(name) = &include.name {
            job.name = format!("{}_{name}", job.name);
        }
        self.jobs.push(job);
    }

    fn check_names(&mut self) {
        let mut seen: BTreeSet<String> = BTreeSet::new();
        for job in &self.jobs {
            if !seen.insert(job.name.to_lowercase()) {
                let message = format!("two jobs are called `{}`", job.name);
                let finding = self.source.error(codes::LINE_JOB_TWICE, &job.span, message);
                self.report.push(finding.hint("give styles, choices or included jobs names of their own"));
            }
        }
    }
}

fn job<'c>(style: &Style, cells: impl Iterator<Item = (&'c str, &'c Choice)>, span: Range<usize>) -> Job {
    let mut job = Job {
        name: style.name.clone(),
        style: style.name.clone(),
        choices: BTreeMap::new(),
        pipeline: style.pipeline.clone(),
        sets: style.sets.clone(),
        span,
    };
    for (axis, choice) in cells {
        job.name = format!("{}_{}", job.name, choice.label);
        job.choices.insert(axis.to_owned(), choice.label.clone());
        job.sets.extend(choice.sets.iter().cloned());
    }
    job
}

fn is_excluded(job: &Job, rule: &Rule) -> bool {
    let agrees = |(axis, choices): &(String, Vec<Choice>)| {
        let own = if axis == "style" { Some(&job.style) } else { job.choices.get(axis) };
        own.is_some_and(|own| choices.iter().any(|c| c.label == *own))
    };
    !rule.cells.is_empty() && rule.cells.iter().all(agrees)
}
