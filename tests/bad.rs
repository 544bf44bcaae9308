//! Walks `bad/`: input that must fail, with the exit code and the findings it must give, in order.
//!
//! A case is a folder with `case.toml` and `pipeline.toml`. All findings must be listed: one too many fails as well.

mod support;

use serde::Deserialize;
use serde_json::Value;
use std::ffi::OsString;
use std::path::Path;
use support::bench::command;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    about: String,
    exit: u8,
    #[serde(default)]
    set: Vec<String>,
    finding: Vec<Expected>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Expected {
    code: String,
    file: Option<String>,
    line: Option<u64>,
    column: Option<u64>,
    message: Option<String>,
    hint: Option<String>,
}

#[test]
fn every_bad_case_fails_as_it_must() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad");
    let cases = support::bench::list(&folder);
    assert!(cases.len() >= 10);
    let wrong: Vec<String> = cases.iter().filter_map(|name| look(&folder.join(name)).err()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

fn look(folder: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(folder.join("case.toml")).map_err(|e| format!("{}: {e}", folder.display()))?;
    let case: Case = toml::from_str(&text).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut arguments: Vec<OsString> = vec!["check".into(), folder.join("pipeline.toml").into()];
    arguments.extend(["--format", "json"].map(OsString::from));
    for set in &case.set {
        arguments.extend(["--set", set].map(OsString::from));
    }
    let said = command(arguments);
    let found: Value = serde_json::from_str(&said.out).map_err(|e| format!("{}: {e}", folder.display()))?;
    let found = found["findings"].as_array().cloned().unwrap_or_default();
    let fits = found.len() == case.finding.len() && case.finding.iter().zip(&found).all(|(e, f)| fits(e, f));
    if fits && said.code == case.exit {
        return Ok(());
    }
    let list: Vec<String> = found.iter().map(ToString::to_string).collect();
    Err(format!("{} ({}): exit {} for {}\n  {}", folder.display(), case.about, said.code, case.exit, list.join("\n  ")))
}

fn fits(expected: &Expected, found: &Value) -> bool {
    let source = &found["source"];
    let number = |wanted: Option<u64>, key: &str| wanted.is_none_or(|w| source[key] == w);
    let holds = |wanted: &Option<String>, value: &Value| {
        wanted.as_ref().is_none_or(|w| value.as_str().is_some_and(|v| v.contains(w.as_str())))
    };
    found["code"] == expected.code
        && number(expected.line, "line")
        && number(expected.column, "column")
        && holds(&expected.file, &source["file"])
        && holds(&expected.message, &found["message"])
        && holds(&expected.hint, &found["hint"])
}
