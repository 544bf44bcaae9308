//! Runs golden cases, one after the other, each as `toile run` would.

use super::judge::{Verdict, judge};
use super::{GoldenCase, TestFile};
use crate::engine::Stop;
use crate::load::{self, Request};
use crate::rerun::{Means, rerun};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_garment::{Report, Severity};
use toile_stage_api::Registry;

/// The means and rights of all cases.
pub struct Bench {
    /// How they are run.
    pub means: Means,
    /// Folder of their results.
    pub out: PathBuf,
    /// Further folders that pipelines may read.
    pub allow_read: Vec<PathBuf>,
    /// Plugins that pipelines may run.
    pub allow_run: Vec<String>,
}

/// A case that was run.
pub struct Tested {
    /// Number of its file.
    pub file: usize,
    /// Number of the case in it.
    pub case: usize,
    /// Its result.
    pub verdict: Verdict,
}

impl Bench {
    fn request(&self, file: &TestFile, case: &GoldenCase) -> Request {
        Request {
            file: file.folder.join(&case.pipeline),
            set: case.sets.iter().map(|s| s.text.clone()).collect(),
            base: file.folder.clone(),
            allow_read: self.allow_read.clone(),
            allow_run: self.allow_run.iter().cloned().collect(),
            ..Request::default()
        }
    }

    /// Overrides that no pipeline knows, with their places in the file of cases. A case that expects a mistake of its
    /// pipeline may have one.
    pub fn check(&self, file: &TestFile, stop: &Arc<Stop>, registry: &mut Registry, report: &mut Report) {
        for case in file.cases.iter().filter(|c| c.exit < 2) {
            let loaded = load::load(&self.request(file, case), stop, registry);
            for finding in loaded.report.findings.into_iter().filter(|f| f.severity == Severity::Error) {
                let place = finding.source.as_ref().and_then(|s| s.file.strip_prefix("--set "));
                let set = place.and_then(|text| case.sets.iter().find(|s| s.text == text));
                if let Some(set) = set {
                    report.push(finding.at(file.source.place(&set.span)));
                }
            }
        }
    }

    /// Runs one case.
    pub fn run(
        &self,
        file: &TestFile,
        case: &GoldenCase,
        at: &Path,
        stop: &Arc<Stop>,
        registry: &mut Registry,
    ) -> Verdict {
        let folder = self.out.join(at);
        let ended = rerun(&self.request(file, case), folder.clone(), &self.means, stop, registry);
        judge(file, case, ended, &folder)
    }
}
