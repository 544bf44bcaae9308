//! Walks `golden/`: runs each case's pipeline and compares a summary with `expected.json`.
//!
//! `case.toml` says which pipeline, with which overrides and tolerances:
//!
//! - `pipeline`: relative to the case; `set`: overrides; `exit`: expected exit code (0);
//! - `tolerance`: relative tolerance of the certificate's figures by name, `default` for the rest (0: exact);
//! - `hashes = false`: do not compare the digests of outputs (they are compared by default);
//! - `figures`: numbers, or whole tables, out of JSON outputs: `{ file, pointer, tolerance, absolute }`;
//! - `inspect`: pattern files by name, as `toile inspect --json` sees them; `{out}/` begins an output;
//! - a case without `expected.json` fails until it was blessed.
//!
//! The structure of every GLB (nodes, meshes, counts, bounds in mm) is compared too. `TOILE_BLESS=1` writes
//! `expected.json`; a failing case leaves `actual.json` beside it.

mod support;

use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use support::bench::{command, list};
use support::glb;
use support::parallel::side_by_side;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    about: String,
    pipeline: PathBuf,
    #[serde(default)]
    set: Vec<String>,
    #[serde(default)]
    exit: u8,
    #[serde(default)]
    tolerance: BTreeMap<String, f64>,
    #[serde(default = "yes")]
    hashes: bool,
    #[serde(default)]
    figures: Vec<Figure>,
    #[serde(default)]
    inspect: BTreeMap<String, String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Figure {
    file: String,
    pointer: String,
    tolerance: f64,
    #[serde(default)]
    absolute: f64,
}

fn yes() -> bool {
    true
}

#[test]
fn every_golden_case_gives_what_it_gave() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let wrong = side_by_side(&list(&folder), |name| look(&folder.join(name)).err());
    let wrong: Vec<String> = wrong.into_iter().flatten().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

fn look(folder: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(folder.join("case.toml")).map_err(|e| format!("{}: {e}", folder.display()))?;
    let case: Case = toml::from_str(&text).map_err(|e| format!("{}: {e}", folder.display()))?;
    let actual = summary(folder, &case)?;
    let (expected_file, actual_file) = (folder.join("expected.json"), folder.join("actual.json"));
    let text = format!("{}\n", serde_json::to_string_pretty(&actual).expect("JSON"));
    if std::env::var_os("TOILE_BLESS").is_some() {
        std::fs::write(&expected_file, &text).expect("expected");
    }
    let expected = std::fs::read_to_string(&expected_file).unwrap_or_else(|_| "null".to_owned());
    let expected: Value = serde_json::from_str(&expected).map_err(|e| format!("{}: {e}", expected_file.display()))?;
    let mut differences = Vec::new();
    compare("", &expected, &actual, &case, &mut differences);
    if differences.is_empty() {
        drop(std::fs::remove_file(actual_file));
        return Ok(());
    }
    std::fs::write(&actual_file, text).expect("actual");
    Err(format!("{} ({}):\n  {}", folder.display(), case.about, differences.join("\n  ")))
}

fn summary(folder: &Path, case: &Case) -> Result<Value, String> {
    let out = tempfile::tempdir().expect("folder");
    let mut arguments: Vec<OsString> = vec!["run".into(), folder.join(&case.pipeline).into()];
    arguments.extend(["--out".into(), out.path().into(), "--quiet".into()]);
    for set in &case.set {
        arguments.extend(["--set", set].map(OsString::from));
    }
    let said = command(arguments);
    let record =
        std::fs::read(out.path().join("run.json")).map_err(|e| format!("{}: {e}: {said:?}", folder.display()))?;
    let record: Value = serde_json::from_slice(&record).expect("run.json");
    if said.code != case.exit {
        return Err(format!("{}: exit {}: {}", folder.display(), said.code, record["findings"]));
    }
    let mut codes: BTreeMap<String, u64> = BTreeMap::new();
    for finding in record["findings"].as_array().into_iter().flatten() {
        *codes.entry(finding["code"].as_str().unwrap_or("").to_owned()).or_default() += 1;
    }
    let outputs = record["outputs"].as_array().cloned().unwrap_or_default();
    let names = || outputs.iter().filter_map(|o| o["path"].as_str());
    let digests: Map<String, Value> = outputs
        .iter()
        .filter_map(|o| {
            Some((o["path"].as_str()?.to_owned(), if case.hashes { o["blake3"].clone() } else { Value::Null }))
        })
        .collect();
    let glbs: Map<String, Value> = names()
        .filter(|n| n.ends_with(".glb"))
        .map(|n| (n.to_owned(), glb::structure(&std::fs::read(out.path().join(n)).expect("GLB"))))
        .collect();
    Ok(json!({
        "exit": said.code,
        "findings": codes,
        "garment": record["garment"],
        "certificate": record["certificate"],
        "outputs": digests,
        "glb": glbs,
        "inspect": case.inspect.iter().map(|i| facts(folder, out.path(), i)).collect::<Result<Map<_, _>, _>>()?,
        "figures": case.figures.iter().map(|f| figure(out.path(), f)).collect::<Result<Map<_, _>, _>>()?,
    }))
}

/// The contents of a pattern file: counts exactly, lengths to 0.1 mm, so that the file of expectations stays readable.
fn facts(folder: &Path, out: &Path, (name, file): (&String, &String)) -> Result<(String, Value), String> {
    let path = file.strip_prefix("{out}/").map_or_else(|| folder.join(file), |below| out.join(below));
    let said = command(vec!["inspect".into(), path.into(), "--json".into()]);
    let json: Value = serde_json::from_str(&said.out).map_err(|_| format!("{file}: {said:?}"))?;
    let tenth = |v: &Value| v.as_f64().map(|v| (v * 10.0).round() / 10.0);
    let count = |v: &Value| v.as_array().map(Vec::len);
    let pieces: Vec<Value> = json["pieces"].as_array().into_iter().flatten().map(|p| json!({
        "name": p["name"], "size": p["size"], "area_cm2": tenth(&p["area_cm2"]), "perimeter_mm": tenth(&p["perimeter_mm"]),
        "net_perimeter_mm": tenth(&p["net_perimeter_mm"]), "darts": count(&p["darts"]), "notches": p["notch_count"],
        "drills": p["drill_count"], "internal_lines": p["internal_line_count"], "edges": count(&p["edges"]),
    })).collect();
    let ledger = &json["ledger"];
    let facts = json!({
        "units": json["units"], "sizes": json["sizes"], "sample_size": json["sample_size"], "pieces": pieces,
        "ledger": [ledger["accepted"], ledger["interpreted"], ledger["refused"]], "findings": count(&json["findings"]),
    });
    Ok((name.clone(), facts))
}

fn figure(out: &Path, figure: &Figure) -> Result<(String, Value), String> {
    let name = format!("{}{}", figure.file, figure.pointer);
    let bytes = std::fs::read(out.join(&figure.file)).map_err(|e| format!("{name}: {e}"))?;
    let json: Value = serde_json::from_slice(&bytes).map_err(|e| format!("{name}: {e}"))?;
    let value = json.pointer(&figure.pointer).cloned().ok_or_else(|| format!("{name} is not there"))?;
    Ok((name, value))
}

fn compare(path: &str, expected: &Value, actual: &Value, case: &Case, differences: &mut Vec<String>) {
    match (expected, actual) {
        (Value::Object(a), Value::Object(b)) => {
            let keys: std::collections::BTreeSet<&String> = a.keys().chain(b.keys()).collect();
            for key in keys {
                let at = format!("{path}/{key}");
                compare(&at, a.get(key).unwrap_or(&Value::Null), b.get(key).unwrap_or(&Value::Null), case, differences);
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (i, (a, b)) in a.iter().zip(b).enumerate() {
                compare(&format!("{path}/{i}"), a, b, case, differences);
            }
        }
        _ if expected == actual || within(path, expected, actual, case) => {}
        _ => differences.push(format!("{path}: expected {expected}, got {actual}")),
    }
}

fn within(path: &str, expected: &Value, actual: &Value, case: &Case) -> bool {
    let (Some(a), Some(b)) = (expected.as_f64(), actual.as_f64()) else { return false };
    let figure = case.figures.iter().find(|f| path.starts_with(&format!("/figures/{}{}", f.file, f.pointer)));
    let named = path.strip_prefix("/certificate/").and_then(|name| case.tolerance.get(name));
    let other = || if path.starts_with("/certificate/") { case.tolerance.get("default").copied() } else { None };
    let tolerance = figure.map(|f| f.tolerance).or(named.copied()).or_else(other).unwrap_or(0.0);
    let absolute = figure.map_or(0.0, |f| f.absolute);
    (a - b).abs() <= (tolerance * a.abs().max(b.abs())).max(absolute)
}
