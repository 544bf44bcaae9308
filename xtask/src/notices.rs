//! Notices of third parties: every package that the program is built of, with its licence and its texts.

use crate::dependencies::{self, Dependency};
use crate::run::{Done, root};
use std::fmt::Write as _;

/// Writes `target/THIRD-PARTY.md`, which goes with a shipped program.
pub fn write(_: &[String]) -> Done {
    let all = dependencies::all(Some("toile"))?;
    let mut text = String::from("# Third-party notices\n\nThe program `toile` is built of these packages.\n\n");
    for of in &all {
        let _ = writeln!(text, "- {} {}: {}", of.name, of.version, of.licence);
    }
    for of in &all {
        let _ = write!(text, "\n## {} {}\n\nLicence: {}\n", of.name, of.version, of.licence);
        let texts = texts(of);
        if texts.is_empty() {
            text.push_str("\nThe package carries no text of its licence.\n");
        }
        for (name, body) in texts {
            let _ = write!(text, "\n### {name}\n\n~~~text\n{}\n~~~\n", body.trim_end());
        }
    }
    let file = root().join("target/THIRD-PARTY.md");
    std::fs::write(&file, text).map_err(|e| format!("{}: {e}", file.display()))?;
    println!("{} packages in target/THIRD-PARTY.md", all.len());
    Ok(())
}

/// Licences, notices and lists of authors in the folder of a package, by name.
fn texts(of: &Dependency) -> Vec<(String, String)> {
    let Ok(entries) = std::fs::read_dir(&of.folder) else { return Vec::new() };
    let mut found: Vec<(String, String)> = entries
        .flatten()
        .filter_map(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            let upper = name.to_uppercase();
            let wanted = ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE", "UNLICENSE"];
            let fits = wanted.iter().any(|w| upper.starts_with(w)) && entry.path().is_file();
            fits.then(|| std::fs::read_to_string(entry.path()).ok().map(|body| (name, body))).flatten()
        })
        .collect();
    found.sort();
    found
}
