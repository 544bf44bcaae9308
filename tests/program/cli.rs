//! The terminal as a person sees it.

use crate::support;
use serde_json::Value;
use std::ffi::OsString;
use std::process::{Command, Stdio};
use support::bench::{Bench, Said, command};

fn toile(arguments: &[&str]) -> Said {
    command(arguments.iter().map(OsString::from).collect())
}

#[test]
fn help_and_version_are_results() {
    let help = toile(&["--help"]);
    assert_eq!((help.code, help.err.as_str()), (0, ""));
    for verb in [
        "run",
        "check",
        "plan",
        "study",
        "inspect",
        "test",
        "bundle",
        "flatten",
        "body",
        "fabric",
        "stages",
        "schema",
        "explain",
        "completions",
    ] {
        assert!(help.out.contains(&format!("\n  {verb} ")), "{verb} is missing in\n{}", help.out);
    }
    assert_eq!(toile(&["--version"]).out, format!("toile {}\n", env!("CARGO_PKG_VERSION")));
    let wrong = toile(&["inspct"]);
    assert_eq!((wrong.code, wrong.out.as_str()), (2, ""));
    assert!(wrong.err.contains("'inspect'"), "{}", wrong.err);
}

#[test]
fn an_error_shows_place_line_and_remedy() {
    let bench = Bench::new();
    let said = bench.stages("[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\nwith.nmae = \"x\"\n").check(&[]);
    let file = bench.pipeline_file();
    let expected = format!(
        "error[unknown-key] unknown key `nmae` of `test-sheet`\n  at {}:8:6\n    | with.nmae = \"x\"\n    |      ^\n  help: did you mean `name`?\n",
        file.display()
    );
    assert_eq!((said.code, said.out.as_str()), (2, ""));
    assert_eq!(said.err, expected);
}

#[test]
fn a_sound_chain_is_said_so() {
    let bench = Bench::new();
    bench.stages("[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n");
    let said = bench.check(&[]);
    assert_eq!((said.code, said.out.as_str(), said.err.as_str()), (0, "nothing wrong was found: 1 stages\n", ""));
    let json: Value = serde_json::from_str(&bench.check(&["--format", "json"]).out).expect("JSON");
    assert_eq!(json["errors"], 0);
}

#[test]
fn a_plan_runs_nothing() {
    let bench = Bench::new();
    bench.stages("[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n[[stage]]\nuse = \"test-write\"\nwith.file = \"{out}/a.txt\"\n");
    let file = bench.pipeline_file();
    let said = toile(&["plan", file.to_str().expect("text")]);
    assert_eq!(said.code, 0);
    assert_eq!(
        said.out,
        "test v1\n  1 test-sheet         gives pieces, mesh                         not foreseen\n  2 test-write         leaves the garment as it is                not foreseen\nwrites {out}/a.txt\n"
    );
    let json: Value =
        serde_json::from_str(&toile(&["plan", file.to_str().expect("text"), "--json"]).out).expect("JSON");
    assert_eq!(json["stages"][0]["params"]["name"], "front");
    assert!(!bench.out().exists());
}

#[test]
fn the_manual_comes_from_the_parameter_types() {
    let all = toile(&["stages"]);
    assert!(all.out.contains("test-sheet       one square piece\n"), "{}", all.out);
    let one = toile(&["stages", "test-sheet"]);
    assert!(one.out.contains("  with.side: string, required\n      Length of a side.\n"), "{}", one.out);
    let unknown = toile(&["stages", "test-shet"]);
    assert_eq!(unknown.code, 2);
    assert!(unknown.err.contains("did you mean `test-sheet`?"));
}

#[test]
fn every_code_can_be_explained() {
    for code in toile(&["explain"]).out.lines() {
        let said = toile(&["explain", code]);
        assert_eq!(said.code, 0);
        assert!(said.out.len() > code.len() + 40, "{code} is hardly explained");
    }
    assert!(toile(&["explain", "unknown-kye"]).err.contains("did you mean `unknown-key`?"));
}

#[test]
fn every_code_is_explained_in_full_sentences() {
    for code in toile::codes::all() {
        let text = code.text();
        let first = text.chars().next().expect("a text");
        assert!(first.is_uppercase() || "`[".contains(first) || text.starts_with("with."), "{}: {text}", code.name());
        assert!(text.ends_with('.') && text.split_whitespace().count() >= 5, "{}: {text}", code.name());
        assert!(!text.contains("  ") && !text.contains('\\'), "{}: {text}", code.name());
    }
}

#[test]
fn no_two_codes_are_alike() {
    let codes: Vec<&str> = toile::codes::all().iter().map(|c| c.name()).collect();
    assert!(codes.windows(2).all(|pair| pair[0] < pair[1]), "a code stands in the table twice");
}

#[test]
fn the_schema_holds_every_stage() {
    let schema: Value = serde_json::from_str(&toile(&["schema"]).out).expect("JSON");
    let uses = schema["properties"]["stage"]["items"]["oneOf"].as_array().expect("stages");
    let sheet = uses.iter().find(|u| u["title"] == "test-sheet").expect("test-sheet");
    assert_eq!(sheet["properties"]["use"]["const"], "test-sheet");
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
}

#[test]
fn completions_name_the_verbs() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        assert!(toile(&["completions", shell]).out.contains("inspect"), "{shell}");
    }
}

#[test]
fn a_closed_pipe_is_a_quiet_end() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_toile"))
        .arg("schema")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("toile");
    drop(child.stdout.take());
    let ended = child.wait_with_output().expect("end");
    assert_eq!(ended.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&ended.stderr), "");
}

#[test]
fn looks_into_a_garment_document() {
    let bench = Bench::new();
    bench.stages("[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n[[stage]]\nuse = \"test-write\"\nwith = { file = \"{out}/g.json\", document = true }\n");
    assert_eq!(bench.run(&[]).code, 0);
    let file = bench.out().join("g.json");
    let said = toile(&["inspect", file.to_str().expect("text"), "--json"]);
    let json: Value = serde_json::from_str(&said.out).expect("JSON");
    assert_eq!((said.code, &json["counts"]["triangles"], &json["pieces"][0]["name"]), (0, &2.into(), &"front".into()));
    let wrong = toile(&["inspect", bench.pipeline_file().to_str().expect("text")]);
    assert_eq!(wrong.code, 3);
    assert!(wrong.err.contains("no-reader"));
}

/// The table of edges names them as a sewing file does, with notches from their start and the edges that are as long.
#[test]
fn inspect_lists_the_edges_of_a_pattern() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/patterns/fitted-bodice.aama.dxf");
    let said = toile(&["inspect", file, "--json"]);
    let found: Value = serde_json::from_str(&said.out).expect("JSON");
    let edges = found["edges"].as_array().expect("edges");
    let edge = |name: &str| edges.iter().find(|e| e["edge"] == name).unwrap_or_else(|| panic!("{name}: {edges:?}"));
    assert_eq!(edge("BACK.7")["length_mm"], edge("BACK.1")["length_mm"]);
    assert_eq!(edge("FRONT.9")["as_long"], serde_json::json!(["BACK.5", "BACK.3"]));
    let [down, up] = ["BACK.7", "BACK.1"].map(|e| edge(e)["notches_mm"][0].as_f64().expect("notch"));
    assert!((down + up - edge("BACK.7")["length_mm"].as_f64().expect("length")).abs() < 0.01, "{down} {up}");
    // The legs of a dart are sewn to each other, and no seam names them.
    assert!(edges.iter().all(|e| e["edge"] != "FRONT.1" && e["edge"] != "FRONT.2"));
    let table = toile(&["inspect", file]).out;
    assert!(table.contains("BACK.7") && table.contains("186.8"), "{table}");
}
