//! Every link of every Markdown page leads to a file and a heading, and every chapter stands in the summary.

use crate::root;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

#[test]
fn no_link_is_dead() {
    crate::energies::chapters();
    let pages = pages();
    assert!(pages.len() > 20, "{} pages", pages.len());
    let mut dead = Vec::new();
    for page in &pages {
        let text = std::fs::read_to_string(page).expect("page");
        for target in targets(&text) {
            if let Some(why) = wrong(page, &target) {
                dead.push(format!("{}: {target}: {why}", page.display()));
            }
        }
    }
    assert!(dead.is_empty(), "{}", dead.join("\n"));
}

#[test]
fn every_chapter_stands_in_the_summary() {
    crate::energies::chapters();
    let book = root().join("docs/book/src");
    let summary = std::fs::read_to_string(book.join("SUMMARY.md")).expect("summary");
    let listed: BTreeSet<PathBuf> = targets(&summary).iter().map(|t| book.join(t)).collect();
    let mut chapters = Vec::new();
    walk(&book, &mut chapters);
    chapters.retain(|path| path.file_name().is_some_and(|name| name != "SUMMARY.md"));
    for chapter in &chapters {
        assert!(listed.contains(chapter), "{} stands in no summary", chapter.display());
    }
    for path in &listed {
        assert!(chapters.contains(path), "the summary names {}, which is not there", path.display());
    }
}

/// The pages about the solver name its files by paths; each of them is there.
#[test]
fn the_solver_pages_name_real_files() {
    let rooms = root().join("stages/cloth/src");
    let mut sources = Vec::new();
    list(&rooms, &mut sources);
    let mut pages = vec![root().join("docs/book/src/solver.md"), root().join("docs/book/src/glossary.md")];
    walk(&root().join("stages/cloth/docs"), &mut pages);
    for page in pages {
        let text = std::fs::read_to_string(&page).expect("page");
        for name in text.split('`').skip(1).step_by(2).filter(|name| !name.contains([' ', '<'])) {
            let known = |path: &PathBuf| path.ends_with(name.trim_end_matches('/'));
            let is_path = name.ends_with(".rs") || name.ends_with('/');
            let found = sources.iter().any(known) || root().join(name).exists();
            assert!(!is_path || found, "{} names `{name}`, which is not there", page.display());
        }
    }
}

/// All files and folders below a folder.
fn list(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("folder") {
        let path = entry.expect("entry").path();
        if path.is_dir() {
            list(&path, found);
        }
        found.push(path);
    }
}

/// All pages that are part of the repository.
fn pages() -> Vec<PathBuf> {
    let mut pages = Vec::new();
    for folder in ["docs", "stages", "formats", "samples", "tests", "fuzz", "src", "examples"] {
        walk(&root().join(folder), &mut pages);
    }
    for entry in std::fs::read_dir(root()).expect("root") {
        let path = entry.expect("entry").path();
        if path.extension().is_some_and(|e| e == "md") {
            pages.push(path);
        }
    }
    pages.sort();
    pages
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|e| e.path()) {
        let skipped = path.file_name().is_some_and(|name| name == "target" || name == "html");
        if path.is_dir() && !skipped {
            walk(&path, found);
        } else if path.extension().is_some_and(|e| e == "md") {
            found.push(path);
        }
    }
}

/// Targets of links, pictures and includes, code apart.
fn targets(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut fenced = false;
    for line in text.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
        }
        if fenced || line.starts_with("    ") && !line.trim_start().starts_with(['-', '*']) {
            continue;
        }
        let plain: String = line.split('`').step_by(2).collect::<Vec<_>>().join("`");
        let links = plain.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        found.extend(links.map(str::to_owned));
        let included = line.split("{{#include ").skip(1).filter_map(|rest| rest.split("}}").next());
        found.extend(included.map(|path| path.trim().to_owned()));
    }
    found
}

/// Why a target cannot be reached.
fn wrong(page: &Path, target: &str) -> Option<String> {
    if target.starts_with("http:") || target.starts_with("https:") {
        return None;
    }
    let (path, heading) = target.split_once('#').unwrap_or((target, ""));
    let file = if path.is_empty() { page.to_owned() } else { page.parent()?.join(path) };
    if !file.exists() {
        return Some("there is no such file".to_owned());
    }
    if heading.is_empty() {
        return None;
    }
    let text = std::fs::read_to_string(&file).ok()?;
    let known = text.lines().filter(|line| line.starts_with('#')).any(|line| anchor(line) == heading);
    (!known).then(|| "there is no such heading".to_owned())
}

/// The anchor of a heading, as mdBook and GitHub make it.
fn anchor(line: &str) -> String {
    let title = line.trim_start_matches('#').trim().to_lowercase();
    title
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}
