//! Two versions of a product line: the jobs that both have, by name, and what differs in them.

use super::change::{Change, Group, Line};
use super::tolerance::Tolerance;
use super::{Side, codes, diff, open};
use crate::engine::{clean, read_limited};
use crate::line::{RESULTS_NAME, Results, Row};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use toile_garment::{Diagnostic, SourceRef};

/// Largest results of a line, bytes.
const MAX_RESULTS: u64 = 1 << 30;

/// The results of a line, and its folder.
pub struct LineSide {
    folder: PathBuf,
    results: Results,
}

impl LineSide {
    /// Name for reports.
    #[must_use]
    pub fn name(&self) -> String {
        clean(&self.folder)
    }

    fn by_name(&self) -> BTreeMap<&str, &Row> {
        self.results.jobs.iter().map(|r| (r.job.as_str(), r)).collect()
    }
}

/// Returns `true` if a path is the folder of a line.
#[must_use]
pub fn is_line(path: &Path) -> bool {
    path.join(RESULTS_NAME).is_file()
}

/// Opens the folder of a line.
///
/// # Errors
/// When its results are damaged.
pub fn open_line(folder: &Path) -> Result<LineSide, Diagnostic> {
    let path = folder.join(RESULTS_NAME);
    let wrong = |why: String| {
        let finding =
            Diagnostic::error(codes::DIFF_NO_RESULT, format!("`{}` is no result of a line: {why}", clean(&path)));
        finding.at(SourceRef::file(clean(&path))).hint("`toile line report` puts it together anew")
    };
    let bytes = read_limited(&path, &path, MAX_RESULTS).map_err(|e| wrong(e.to_string()))?;
    let results = serde_json::from_slice(&bytes).map_err(|e| wrong(e.to_string()))?;
    Ok(LineSide { folder: folder.to_path_buf(), results })
}

/// The fate of a job.
pub struct JobDiff {
    /// Name.
    pub job: String,
    /// How it ended in both versions; nothing where it is not there.
    pub status: [Option<String>; 2],
    /// The differences in its results.
    pub changes: Vec<Change>,
}

impl JobDiff {
    /// Returns `true` if more differs than is allowed. A job that is new, gone, or ends otherwise is more.
    #[must_use]
    pub fn is_over(&self, tolerance: &Tolerance) -> bool {
        self.status[0] != self.status[1] || self.changes.iter().any(|c| tolerance.is_over(c))
    }

    fn differs(&self) -> bool {
        self.status[0] != self.status[1] || !self.changes.is_empty()
    }

    fn words(&self) -> String {
        let [a, b] = self.status.clone();
        let same = a.clone().unwrap_or_default();
        Change::of_words(Group::Findings, &self.job, a, b).map_or(same, |change| change.words())
    }
}

/// Compares all jobs of two lines: those of `a` in their order, then those that are new. Jobs of one content are equal.
#[must_use]
pub fn diff_lines(a: &LineSide, b: &LineSide) -> Vec<JobDiff> {
    let [of_a, of_b] = [a, b].map(LineSide::by_name);
    let known = a.results.jobs.iter().map(|r| [Some(r), of_b.get(r.job.as_str()).copied()]);
    let new = b.results.jobs.iter().filter(|r| !of_a.contains_key(r.job.as_str())).map(|r| [None, Some(r)]);
    let pairs: Vec<[Option<&Row>; 2]> = known.chain(new).collect();
    pairs.par_iter().map(|rows| job_diff([a, b], *rows)).collect()
}

fn job_diff(sides: [&LineSide; 2], rows: [Option<&Row>; 2]) -> JobDiff {
    let job = rows.iter().flatten().next().map(|r| r.job.clone()).unwrap_or_default();
    let status = rows.map(|r| r.map(|r| r.status.clone()));
    let is_same = matches!(rows, [Some(x), Some(y)] if x.key.is_some() && x.key == y.key);
    let is_in_both = rows.iter().all(Option::is_some);
    let changes = if is_same || !is_in_both { Vec::new() } else { job_changes(sides, &job) };
    JobDiff { job, status, changes }
}

/// The differences in the results of a job. A result of one side alone that cannot be opened differs as well.
fn job_changes(sides: [&LineSide; 2], job: &str) -> Vec<Change> {
    let [a, b] = sides.map(|side| open(&side.folder.join("jobs").join(job)));
    let closed = |result: &Result<Side, Diagnostic>| result.is_err().then(|| "cannot be opened".to_owned());
    match (a, b) {
        (Ok(a), Ok(b)) => diff(&a, &b),
        (a, b) => Change::of_words(Group::Findings, "result of the job", closed(&a), closed(&b)).into_iter().collect(),
    }
}

/// The differences in several jobs under one name.
struct Kind<'a> {
    group: Group,
    what: &'a str,
    /// Every job in which it differs.
    jobs: Vec<(&'a str, &'a Change)>,
    over: usize,
}

fn kinds<'a>(jobs: &'a [JobDiff], tolerance: &Tolerance) -> Vec<Kind<'a>> {
    let mut kinds: Vec<Kind<'a>> = Vec::new();
    for (job, change) in jobs.iter().flat_map(|j| j.changes.iter().map(move |c| (j.job.as_str(), c))) {
        let known = kinds.iter().position(|k| k.group == change.group && k.what == change.what);
        let at = known.unwrap_or_else(|| {
            kinds.push(Kind { group: change.group, what: &change.what, jobs: Vec::new(), over: 0 });
            kinds.len() - 1
        });
        kinds[at].jobs.push((job, change));
        kinds[at].over += usize::from(tolerance.is_over(change));
    }
    kinds.sort_by_key(|k| k.group);
    kinds
}

impl Kind<'_> {
    /// The job in which it differs most, and how.
    fn words(&self) -> String {
        let size = |c: &Change| c.by.map_or(0.0, f64::abs);
        let Some((job, most)) = self.jobs.iter().max_by(|x, y| size(x.1).total_cmp(&size(y.1))) else {
            return String::new();
        };
        let is_alike = self.jobs.iter().all(|(_, c)| c.words() == most.words());
        let where_ = if is_alike { String::new() } else { format!(", most in {job}") };
        format!("{} (jobs: {}{where_})", most.words(), self.jobs.len())
    }
}

/// The differences for people: how jobs ended, then what differs, each told once for all jobs.
#[must_use]
pub fn lines_text([a, b]: [&LineSide; 2], jobs: &[JobDiff], tolerance: &Tolerance) -> String {
    let over = jobs.iter().filter(|j| j.is_over(tolerance)).count();
    let differ = jobs.iter().filter(|j| j.differs()).count();
    let mut out =
        format!("{} against {}\n{} jobs: {differ} differ, {over} over the tolerance\n", b.name(), a.name(), jobs.len());
    // Writing to a String cannot fail.
    for job in jobs.iter().filter(|j| j.status[0] != j.status[1]) {
        let _ = writeln!(out, "  {}: {}", job.job, job.words());
    }
    for group in kinds(jobs, tolerance).chunk_by(|x, y| x.group == y.group) {
        let _ = writeln!(out, "{}", group[0].group.word());
        for kind in group {
            let over = if kind.over > 0 { format!("  over the tolerance in {}", kind.over) } else { String::new() };
            let _ = writeln!(out, "  {}: {}{over}", kind.what, kind.words());
        }
    }
    out
}

/// The differences for programs, job by job.
#[must_use]
pub fn lines_json([a, b]: [&LineSide; 2], jobs: &[JobDiff], tolerance: &Tolerance) -> Value {
    let job = |j: &JobDiff| {
        let changes: Vec<Value> = j.changes.iter().map(|c| super::change_json(c, tolerance)).collect();
        json!({ "job": j.job, "before": j.status[0], "after": j.status[1], "over": j.is_over(tolerance), "changes": changes })
    };
    json!({
        "a": a.name(),
        "b": b.name(),
        "over": jobs.iter().filter(|j| j.is_over(tolerance)).count(),
        "jobs": jobs.iter().filter(|j| j.differs()).map(job).collect::<Vec<_>>(),
    })
}

/// The differences over all jobs, as a page tells it.
pub(super) fn told(jobs: &[JobDiff], tolerance: &Tolerance) -> Vec<Line> {
    let line = |k: &Kind<'_>| Line { group: k.group, what: k.what.to_owned(), words: k.words(), is_over: k.over > 0 };
    kinds(jobs, tolerance).iter().map(line).collect()
}

/// A job on a page.
pub(super) struct ShownJob {
    /// Name.
    pub job: String,
    /// How it ended, and how much differs.
    pub words: String,
    /// True where it differs more than is allowed.
    pub is_over: bool,
    /// Its pictures in both versions, as PNG.
    pub pictures: [Option<Vec<u8>>; 2],
}

/// Jobs that a page shows in pictures, at most.
const PICTURED_MOST: usize = 48;

/// Jobs that differ, those over the tolerance first.
pub(super) fn shown([a, b]: [&LineSide; 2], jobs: &[JobDiff], tolerance: &Tolerance) -> Vec<ShownJob> {
    let mut shown: Vec<&JobDiff> = jobs.iter().filter(|j| j.differs()).collect();
    shown.sort_by_key(|j| !j.is_over(tolerance));
    let picture = |side: &LineSide, job: &str| {
        let path = side.folder.join("pictures").join(format!("{job}.png"));
        read_limited(&path, &path, MAX_RESULTS).ok()
    };
    let row = |(n, j): (usize, &JobDiff)| ShownJob {
        job: j.job.clone(),
        words: format!("{}; differences: {}", j.words(), j.changes.len()),
        is_over: j.is_over(tolerance),
        pictures: if n < PICTURED_MOST { [a, b].map(|side| picture(side, &j.job)) } else { [None, None] },
    };
    shown.into_iter().enumerate().map(row).collect()
}
