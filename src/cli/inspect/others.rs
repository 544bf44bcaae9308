//! Files that other commands read: what they are, and which command that is.

use crate::cli::codes::NO_READER;
use crate::engine::{RECORD_NAME, clean};
use crate::line::RESULTS_NAME;
use serde_json::Value;
use std::path::Path;
use toile_garment::Diagnostic;

/// A kind of file: its name in words, one of its keys and all that must stand beside it, and what reads it.
struct Kind {
    words: &'static str,
    /// Any of these tells the kind.
    any: &'static [&'static str],
    /// All of these, too.
    all: &'static [&'static str],
    reader: &'static str,
}

/// TOML files. The first one that fits decides.
const TEXTS: &[Kind] = &[
    Kind {
        words: "a pipeline",
        any: &["pipeline", "stage"],
        all: &["toile"],
        reader: "`toile check` finds its mistakes, and `toile plan` tells what it will do",
    },
    Kind {
        words: "a product line",
        any: &["line", "style"],
        all: &["toile"],
        reader: "`toile line check` finds its mistakes, and `toile line plan` tells what it will take",
    },
    Kind { words: "a file of golden cases", any: &["case"], all: &["toile"], reader: "`toile test` runs it" },
    Kind {
        words: "the side file of a body",
        any: &["measures", "landmarks", "segments"],
        all: &[],
        reader: "inspect the mesh beside it: both are read together",
    },
    Kind {
        words: "a sewing file",
        any: &[
            "seam",
            "dart",
            "place",
            "layer",
            "attach",
            "elastic",
            "fold",
            "interlining",
            "copy",
            "edge",
            "leave_out",
        ],
        all: &[],
        reader: "it is read with its pattern by a pipeline: `toile check PIPELINE.toml` finds its mistakes",
    },
];

/// JSON files.
const RECORDS: &[Kind] = &[
    Kind {
        words: "the record of a run",
        any: &["exit_code"],
        all: &["toile", "stages", "outputs"],
        reader: "`toile diff` compares it, and `toile bundle` packs its run",
    },
    Kind {
        words: "the results of a line",
        any: &["toile_line"],
        all: &[],
        reader: "index.html beside it shows them, and `toile diff` compares two folders",
    },
    Kind {
        words: "a study",
        any: &["toile_study"],
        all: &[],
        reader: "study.html beside it shows it; as NAME.study.json beside a pipeline it is what `accuracy` chooses from",
    },
];

/// Tells of a file or a folder that another command reads; nothing for other files.
pub fn told(path: &Path, bytes: &[u8]) -> Option<Diagnostic> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let kind = match ending.as_str() {
        "toml" => {
            let table: toml::Table = std::str::from_utf8(bytes).ok()?.parse().ok()?;
            find(TEXTS, |key| table.contains_key(key))
        }
        "json" => {
            let table: Value = serde_json::from_slice(bytes).ok()?;
            find(RECORDS, |key| table.get(key).is_some())
        }
        _ => None,
    }?;
    Some(finding(path, kind.words, kind.reader))
}

/// Tells what a folder is.
pub fn folder(path: &Path) -> Diagnostic {
    let (words, reader) = if path.join(RESULTS_NAME).is_file() {
        ("the folder of a line", "index.html in it shows the line, and `toile diff` compares two of them")
    } else if path.join(RECORD_NAME).is_file() {
        ("the folder of a run", "inspect a garment in it (FILE.glb); `toile diff` compares two of them")
    } else {
        ("a folder", "name a file in it")
    };
    finding(path, words, reader)
}

fn find(kinds: &'static [Kind], has: impl Fn(&str) -> bool) -> Option<&'static Kind> {
    kinds.iter().find(|k| k.any.iter().any(|key| has(key)) && k.all.iter().all(|key| has(key)))
}

fn finding(path: &Path, words: &str, reader: &str) -> Diagnostic {
    Diagnostic::error(NO_READER, format!("`{}` is {words}, which is not inspected", clean(path))).hint(reader)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_other_commands_are_named_with_what_reads_them() {
        let words = |name: &str, text: &str| told(Path::new(name), text.as_bytes()).map(|f| f.message);
        let is = |name: &str, text: &str, wanted: &str| {
            let found = words(name, text);
            assert!(found.as_ref().is_some_and(|w| w.contains(wanted)), "{wanted}: {found:?}");
        };
        is("p.toml", "toile = 1\n[pipeline]\nline = \"x\"\n", "a pipeline");
        is("p.toml", "toile = 1\n[line]\nname = \"x\"\n", "a product line");
        is("p.toml", "toile = 1\n[[case]]\nname = \"x\"\n", "golden cases");
        is("p.toml", "name = \"x\"\n[measures]\nstature = \"1 m\"\n", "side file of a body");
        is("p.toml", "[[seam]]\na = \"x\"\n", "a sewing file");
        is("r.json", "{\"toile\":\"1\",\"stages\":[],\"outputs\":[],\"exit_code\":0}", "record of a run");
        assert_eq!(words("f.toml", "name = \"x\"\nareal_mass = \"1 kg/m2\"\n"), None, "a fabric");
        assert_eq!(words("g.json", "{\"kind\":\"toile-garment\"}"), None);
        let dir = tempfile::tempdir().expect("folder");
        assert!(folder(dir.path()).message.contains("is a folder"));
        std::fs::write(dir.path().join("run.json"), "{}").expect("file");
        assert!(folder(dir.path()).message.contains("the folder of a run"));
    }
}
