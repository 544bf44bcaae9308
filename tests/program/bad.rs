//! Walks `bad/`: input that must fail, with the exit code and the findings it must give, in order.
//!
//! A case is a folder with `case.toml` and `pipeline.toml`. `check` must give exactly the findings listed; with
//! `run = true` the pipeline is run and must give exactly the errors listed, and leave no output but run.json. `check`
//! must end with the same exit code then, but for cases with `only_run = true`, which only the work can find.

use crate::support;

use serde::Deserialize;
use serde_json::Value;
use std::ffi::OsString;
use std::path::Path;
use support::bench::{Said, command, list};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    about: String,
    exit: u8,
    #[serde(default)]
    run: bool,
    #[serde(default)]
    only_run: bool,
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
    block: Option<String>,
    column: Option<u64>,
    message: Option<String>,
    hint: Option<String>,
}

#[test]
fn every_bad_case_fails_as_it_must() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad");
    let cases = list(&folder);
    assert!(cases.len() >= 10);
    let wrong: Vec<String> = cases.iter().filter_map(|name| look(&folder.join(name)).err()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

fn look(folder: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(folder.join("case.toml")).map_err(|e| format!("{}: {e}", folder.display()))?;
    let case: Case = toml::from_str(&text).map_err(|e| format!("{}: {e}", folder.display()))?;
    let (said, found) = if case.run { run(folder, &case)? } else { check(folder, &case)? };
    if case.run && !case.only_run {
        let (foreseen, _) = check(folder, &case)?;
        if foreseen.code != case.exit {
            return Err(format!("{}: `check` ends with {}: {}", folder.display(), foreseen.code, foreseen.out));
        }
    }
    let fits = found.len() == case.finding.len() && case.finding.iter().zip(&found).all(|(e, f)| fits(e, f));
    if fits && said.code == case.exit {
        return Ok(());
    }
    let list: Vec<String> = found.iter().map(ToString::to_string).collect();
    Err(format!("{} ({}): exit {} for {}\n  {}", folder.display(), case.about, said.code, case.exit, list.join("\n  ")))
}

fn check(folder: &Path, case: &Case) -> Result<(Said, Vec<Value>), String> {
    let mut arguments: Vec<OsString> = vec!["check".into(), folder.join("pipeline.toml").into()];
    arguments.extend(["--format", "json"].map(OsString::from));
    arguments.extend(case.set.iter().flat_map(|s| ["--set".into(), s.into()]));
    let said = command(arguments);
    let found: Value = serde_json::from_str(&said.out).map_err(|e| format!("{}: {e}", folder.display()))?;
    let found = found["findings"].as_array().cloned().unwrap_or_default();
    Ok((said, found))
}

fn run(folder: &Path, case: &Case) -> Result<(Said, Vec<Value>), String> {
    let out = tempfile::tempdir().map_err(|e| e.to_string())?;
    let mut arguments: Vec<OsString> = vec!["run".into(), folder.join("pipeline.toml").into(), "--quiet".into()];
    arguments.extend(["--out".into(), out.path().into()]);
    arguments.extend(case.set.iter().flat_map(|s| ["--set".into(), s.into()]));
    let said = command(arguments);
    let left = list(out.path());
    if left != ["run.json"] {
        return Err(format!("{}: left {left:?}, said {said:?}", folder.display()));
    }
    let record = std::fs::read_to_string(out.path().join("run.json")).map_err(|e| e.to_string())?;
    let record: Value = serde_json::from_str(&record).map_err(|e| e.to_string())?;
    let findings = record["findings"].as_array().cloned().unwrap_or_default();
    let errors: Vec<Value> = findings.into_iter().filter(|f| f["severity"] == "error").collect();
    Ok((said, errors))
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
        && holds(&expected.block, &source["block"])
        && holds(&expected.file, &source["file"])
        && holds(&expected.message, &found["message"])
        && holds(&expected.hint, &found["hint"])
}
