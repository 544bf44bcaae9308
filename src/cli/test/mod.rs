//! `toile test`: golden cases of a house.

mod args;

pub use args::TestArgs;

use super::console::Console;
use crate::acceptance::{self, Bench, TestFile, Tested, Verdict, bless};
use crate::codes::{PATH_REFUSED, WRITE_FAILED};
use crate::engine::{Exit, Stop, clean, read_limited, unwritten, write_whole};
use crate::pipeline::remedy;
use crate::render::findings_json;
use crate::rerun::Means;
use args::TestFormat;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_garment::{Diagnostic, Report, Severity};
use toile_stage_api::Registry;

pub(super) fn run(args: &TestArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    match tested(args, registry, stop, console) {
        Ok(exit) | Err(exit) => exit,
    }
}

fn tested(args: &TestArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Result<Exit, Exit> {
    let reason = reason(args).map_err(|finding| refuse(args, &[finding], None, Exit::Usage, console))?;
    let junit = args.junit.as_deref().map_or(Ok(()), may_replace);
    junit.map_err(|finding| refuse(args, &[finding], None, Exit::Usage, console))?;
    let temporary = tempfile::tempdir().map_err(|e| {
        let finding = Diagnostic::error(WRITE_FAILED, format!("there is no folder for temporary files: {e}"));
        refuse(args, &[finding], None, Exit::System, console)
    })?;
    let bench = bench(args, temporary.path());
    let files = files(args, &bench, registry, stop, console)?;
    let unknown = unknown(args, &files);
    if !unknown.is_empty() {
        return Err(refuse(args, &unknown, None, Exit::Usage, console));
    }
    let mut results = Vec::new();
    for (file, case) in wanted(args, &files) {
        if !args.quiet && args.format == TestFormat::Text {
            console.say(&format!("{} …\n", files[file].cases[case].name));
        }
        let one = &files[file];
        let folder = if files.len() > 1 { PathBuf::from((file + 1).to_string()) } else { PathBuf::new() };
        let verdict = bench.run(one, &one.cases[case], &folder.join(&one.cases[case].name), stop, registry);
        if stop.asked() {
            return Err(Exit::Stopped);
        }
        results.push(Tested { file, case, verdict });
    }
    if let Some(path) = &args.junit {
        write(path, &acceptance::junit(&files, &results))
            .map_err(|f| refuse(args, &[f], None, Exit::System, console))?;
    }
    if let Some(reason) = reason {
        return bless_all(args, &files, results, reason, console);
    }
    match args.format {
        TestFormat::Text => console.result(&crate::render::safe(&acceptance::text(&files, &results))),
        TestFormat::Json => console.json(&acceptance::to_json(&files, &results)),
        TestFormat::Github => console.result(&acceptance::github(&files, &results)),
    }
    Ok(if results.iter().all(|r| r.verdict.has_passed()) { Exit::Good } else { Exit::Gate })
}

/// The reason, where figures are to be blessed.
fn reason(args: &TestArgs) -> Result<Option<&str>, Diagnostic> {
    let reason = args.reason.as_deref().map(str::trim).filter(|r| !r.is_empty());
    if args.bless && reason.is_none() {
        let message = "golden figures are not written without a reason";
        let finding = Diagnostic::error(acceptance::codes::TEST_NO_REASON, message);
        return Err(finding.hint("say why they change: --bless --reason \"another wool\""));
    }
    Ok(reason.filter(|_| args.bless))
}

fn bench(args: &TestArgs, temporary: &Path) -> Bench {
    let threads = super::run::pool(args.threads);
    let here = |dir: &PathBuf| std::path::absolute(dir).unwrap_or_else(|_| dir.clone());
    Bench {
        means: Means { threads, limits: args.limits.limits(), cache: args.cache.options() },
        out: args.out.clone().unwrap_or_else(|| temporary.to_path_buf()),
        // Folders are named from here, and not from the folder of the cases.
        allow_read: args.allow_read.iter().map(here).collect(),
        allow_run: args.allow_run.clone(),
    }
}

/// All files, with their mistakes told at once.
fn files(
    args: &TestArgs,
    bench: &Bench,
    registry: &mut Registry,
    stop: &Arc<Stop>,
    console: &mut Console<'_>,
) -> Result<Vec<TestFile>, Exit> {
    let paths = acceptance::find(&args.paths).map_err(|wrong| refuse(args, &wrong, None, Exit::Usage, console))?;
    let mut files: Vec<TestFile> = Vec::new();
    let mut all = Vec::new();
    for path in &paths {
        let mut report = Report::default();
        let file = acceptance::open(path, &mut report);
        if let Some(file) = &file {
            bench.check(file, stop, registry, &mut report);
        }
        let source = file.as_ref().map(|f| (f.source.file(), f.source.text()));
        if args.format == TestFormat::Text {
            console.findings(&report.findings, source);
        }
        all.extend(report.findings);
        files.extend(file);
    }
    if args.format == TestFormat::Text {
        let is_error = |f: &Diagnostic| f.severity == Severity::Error;
        return if all.iter().any(is_error) { Err(Exit::Usage) } else { Ok(files) };
    }
    if all.is_empty() { Ok(files) } else { Err(refuse(args, &all, None, Exit::Usage, console)) }
}

/// A case that is asked for and stands in no file.
fn unknown(args: &TestArgs, files: &[TestFile]) -> Vec<Diagnostic> {
    let names: Vec<&str> = files.iter().flat_map(|f| &f.cases).map(|c| c.name.as_str()).collect();
    let unknown = args.only.iter().filter(|name| !names.contains(&name.as_str()));
    let finding = |name: &String| {
        let finding = Diagnostic::error(acceptance::codes::TEST_EMPTY, format!("no case is called `{name}`"));
        finding.hint(remedy(name, names.iter().copied()))
    };
    unknown.map(finding).collect()
}

/// Numbers of the files and cases that are asked for.
fn wanted(args: &TestArgs, files: &[TestFile]) -> Vec<(usize, usize)> {
    let is_wanted = |name: &String| args.only.is_empty() || args.only.contains(name);
    let cases =
        files.iter().enumerate().flat_map(|(f, file)| file.cases.iter().enumerate().map(move |(c, case)| (f, c, case)));
    cases.filter(|(.., case)| is_wanted(&case.name)).map(|(f, c, _)| (f, c)).collect()
}

/// Writes the values of these runs into the files, or into none of them.
fn bless_all(
    args: &TestArgs,
    files: &[TestFile],
    results: Vec<Tested>,
    reason: &str,
    console: &mut Console<'_>,
) -> Result<Exit, Exit> {
    let mut verdicts: Vec<Vec<Option<Verdict>>> =
        files.iter().map(|f| f.cases.iter().map(|_| None).collect()).collect();
    for tested in results {
        verdicts[tested.file][tested.case] = Some(tested.verdict);
    }
    let (mut blessed, mut wrong) = (Vec::new(), Vec::new());
    for (file, verdicts) in files.iter().zip(&verdicts) {
        match bless(file, verdicts, reason) {
            Ok(one) => blessed.push((file, one)),
            Err(findings) => wrong.extend(findings),
        }
    }
    if !wrong.is_empty() {
        return Err(refuse(args, &wrong, None, Exit::Gate, console));
    }
    let mut text = String::new();
    for (file, blessed) in blessed {
        if blessed.changed.is_empty() {
            text.push_str(&format!("{}: nothing changed\n", clean(&file.path)));
            continue;
        }
        blessed.write(&file.path).map_err(|f| refuse(args, &[f], None, Exit::System, console))?;
        text.push_str(&format!("{}: {} values written\n", clean(&file.path), blessed.changed.len()));
        blessed.changed.iter().for_each(|words| text.push_str(&format!("  {words}\n")));
    }
    console.result(&crate::render::safe(&text));
    Ok(Exit::Good)
}

/// A file that is there is replaced only if it is such a report.
fn may_replace(path: &Path) -> Result<(), Diagnostic> {
    const MAX: u64 = 64 << 20;
    let is_report = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).contains("<testsuite ");
    if !path.exists() || read_limited(path, path, MAX).is_ok_and(is_report) {
        return Ok(());
    }
    let message = format!("`{}` is there already and is no JUnit report", clean(path));
    Err(Diagnostic::error(PATH_REFUSED, message).hint("choose another name for --junit"))
}

fn write(path: &Path, text: &str) -> Result<(), Diagnostic> {
    write_whole(path, text.as_bytes()).map_err(|error| unwritten(path, &error))
}

fn refuse(
    args: &TestArgs,
    findings: &[Diagnostic],
    source: Option<(&str, &str)>,
    exit: Exit,
    console: &mut Console<'_>,
) -> Exit {
    match args.format {
        TestFormat::Text => console.findings(findings, source),
        TestFormat::Json => console.json(&findings_json(findings)),
        TestFormat::Github => console.result(&acceptance::github_findings(findings)),
    }
    exit
}
