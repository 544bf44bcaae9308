//! A stage in another process: the example program, and programs that misbehave.
#![cfg(unix)]

use crate::support;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use support::bench::{Bench, HEAD, Said, command};

/// The example that `cargo test` builds beside the tests.
fn example() -> PathBuf {
    let path = Path::new(env!("CARGO_BIN_EXE_toile")).with_file_name("examples").join("external_stage");
    assert!(path.is_file(), "build it first: cargo build --release --example external_stage");
    path
}

fn pipeline(program: &Path, stages: &str) -> String {
    let sheet = "[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n";
    format!(
        "{HEAD}[plugin.acme]\ncommand = [{:?}]\ntimeout = \"5 s\"\n{sheet}{stages}",
        program.to_str().expect("text")
    )
}

const SET: &str = "[[stage]]\nuse = \"acme.set-material\"\nwith = { piece = \"front\", material = \"lining\" }\n";
const KEEP: &str = "[[stage]]\nuse = \"test-write\"\nwith = { file = \"{out}/g.json\", document = true }\n";

#[test]
fn runs_only_with_consent() {
    let bench = Bench::new();
    let marker = bench.path("ran");
    let program = script(&bench, &format!("touch {}", marker.display()));
    bench.text(&pipeline(&program, SET));
    let said = bench.run(&[]);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("plugin-needs-consent") && said.err.contains("--allow-run acme"), "{}", said.err);
    assert_eq!(bench.run(&["--allow-run", "other"]).code, 2);
    assert!(!marker.exists(), "the program ran without consent");
    assert!(!bench.out().exists());
}

#[test]
fn the_example_does_its_work() {
    let bench = Bench::new();
    let said = bench.text(&pipeline(&example(), &format!("{SET}{KEEP}"))).run(&["--allow-run", "acme"]);
    assert_eq!(said.code, 0, "{said:?}");
    let garment = toile_garment::bundle::from_text(&bench.output("g.json").expect("document")).expect("garment");
    assert_eq!(garment.pieces[0].material.as_deref(), Some("lining"));
    assert_eq!(garment.provenance.stages[1].stage, "acme.set-material");
    assert_eq!(garment.pieces[0].mesh.as_ref().map(|m| m.rest.len()), Some(4));
    let record = bench.record();
    assert_eq!(record["findings"][0]["code"], "material-set");
    assert_eq!(record["stages"][1]["params"]["material"], "lining");
}

#[test]
fn its_parameters_and_needs_are_checked_like_any_others() {
    let bench = Bench::new();
    bench.text(&pipeline(&example(), &SET.replace("piece =", "peice =")));
    let found = bench.findings(&["--allow-run", "acme"]);
    assert!(found.iter().any(|f| f.0 == "unknown-key" && f.3.contains("did you mean `piece`?")), "{found:?}");
    let alone = pipeline(&example(), SET).replace("[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n", "");
    let found = bench.text(&alone).findings(&["--allow-run", "acme"]);
    assert!(found.iter().any(|f| f.0 == "needs-not-given"), "{found:?}");
}

#[test]
fn a_rejected_garment_is_the_inputs_fault() {
    let bench = Bench::new();
    bench.text(&pipeline(&example(), &SET.replace("\"front\"", "\"sleeve\"")));
    assert_eq!(bench.run(&["--allow-run", "acme"]).code, 3);
    let finding = &bench.record()["findings"][0];
    assert_eq!(finding["code"], "unknown-piece");
    assert_eq!(finding["hint"], "the pieces are front");
    assert_eq!(bench.left(), ["run.json"]);
}

const DESCRIBE: &str =
    r#"{"protocol":1,"stages":[{"name":"acme.x","summary":"","needs":[],"gives":[],"revision":1,"params_schema":{}}]}"#;

/// A shell script that answers `describe` and does `body` on `run`.
fn script(bench: &Bench, body: &str) -> PathBuf {
    described(bench, DESCRIBE, body)
}

/// A shell script with a description of its own; `$1` tells it `run` from `forecast`.
fn described(bench: &Bench, description: &str, body: &str) -> PathBuf {
    let path = bench.path("program.sh");
    let text = format!(
        "#!/bin/sh\nif [ \"$1\" = describe ]; then echo '{description}'; exit 0; fi\ncat > request.json\n{body}\n"
    );
    std::fs::write(&path, text).expect("script");
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).expect("rights");
    path
}

/// Runs a script as the stage; gives exit code and the first error's text.
fn misbehave(body: &str) -> (u8, String) {
    let bench = Bench::new();
    let program = script(&bench, body);
    bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n"));
    let code = bench.run(&["--allow-run", "acme"]).code;
    let finding = bench.record()["findings"][0].clone();
    assert_eq!(bench.left(), ["run.json"], "{body}");
    (code, format!("{} {}", finding["code"].as_str().unwrap_or(""), finding["message"].as_str().unwrap_or("")))
}

#[test]
fn what_it_answers_is_read_as_hostile() {
    for (body, expected) in [
        ("exit 1", "plugin-failed"),
        ("echo boom >&2; exit 9", "boom"),
        ("exit 0", "wrote no garment.json"),
        ("echo not json", "not of protocol 1"),
        ("exit 2", "plugin-rejected"),
        (
            "echo '{\"kind\":\"toile-garment\",\"version\":99,\"garment\":{\"pieces\":[]}}' > out/garment.json",
            "version 99",
        ),
        (
            "echo '{\"kind\":\"toile-garment\",\"version\":1,\"garment\":{\"pieces\":7}}' > out/garment.json",
            "plugin-protocol",
        ),
        ("ln -s /etc/passwd out/garment.json", "wrote no garment.json"),
        ("mv out elsewhere; ln -s elsewhere out; cp in/garment.json out", "its output folder is gone"),
        ("yes '{\"kind\":\"progress\"}'", "wrote more than"),
        ("kill -9 $$", "plugin-failed"),
    ] {
        let (code, said) = misbehave(body);
        assert_eq!(code, 3, "{body}: {said}");
        assert!(said.contains(expected), "{body}: {said}");
    }
}

#[test]
fn it_is_ended_when_it_takes_too_long() {
    let begun = Instant::now();
    let (code, said) = misbehave("sleep 60 & sleep 60");
    assert_eq!(code, 3);
    assert!(said.contains("longer than 5 s"), "{said}");
    assert!(begun.elapsed() < Duration::from_secs(20));
}

#[test]
fn it_sees_nothing_of_the_callers_environment() {
    let bench = Bench::new();
    let seen = bench.path("environment");
    let program = script(&bench, &format!("env > {}; exit 1", seen.display()));
    bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n")).run(&["--allow-run", "acme"]);
    let environment = std::fs::read_to_string(seen).expect("environment");
    assert!(!environment.contains("HOME=") && !environment.contains("CARGO"), "{environment}");
}

#[test]
fn it_is_told_from_other_protocols() {
    let bench = Bench::new();
    let program = script(&bench, "");
    let text = std::fs::read_to_string(&program).expect("script").replace("\"protocol\":1", "\"protocol\":3");
    std::fs::write(&program, text).expect("script");
    bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n"));
    let said = bench.run(&["--allow-run", "acme"]);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("speaks protocol 3, this program speaks 1 to 2"), "{}", said.err);
}

/// The forecast of `plan`.
fn plan(bench: &Bench, more: &[&str]) -> (Said, serde_json::Value) {
    let mut arguments: Vec<std::ffi::OsString> =
        vec!["plan".into(), bench.pipeline_file().into(), "--json".into(), "--allow-run".into(), "acme".into()];
    arguments.extend(more.iter().map(std::ffi::OsString::from));
    let said = command(arguments);
    let plan = serde_json::from_str(&said.out).unwrap_or_default();
    (said, plan)
}

#[test]
fn the_example_is_foreseen() {
    let bench = Bench::new();
    bench.text(&pipeline(&example(), SET));
    let (said, plan) = plan(&bench, &[]);
    assert_eq!(said.code, 0, "{said:?}");
    assert_eq!(plan["stages"][1]["expected_seconds"], 0.01);
    assert_eq!(plan["stages"][1]["expected_mb"], 17.0, "the program's own memory is counted too");
    assert_eq!(plan["stages"][0]["expected_seconds"], serde_json::Value::Null, "a stage that foresees nothing");
}

/// A mesh maker that has knobs and foresees, in protocol 2.
const MESHER: &str = r#"{"protocol":2,"stages":[{"name":"acme.mesh","summary":"","needs":[],"gives":["mesh"],"revision":1,
"params_schema":{"type":"object","properties":{"fine":{"type":"object","properties":{"edge":{"type":"string"}}},"count":{"type":"integer"}}},
"forecast":true,"knobs":[{"meaning":"edge-length","key":"fine.edge","instead_of":"count"},{"meaning":"tolerance","key":"rest"}]}]}"#;
const MESH: &str = "[[stage]]\nuse = \"acme.mesh\"\nwith.count = 7\n[[stage]]\nuse = \"export-report\"\n";

#[test]
fn a_mesh_that_is_foreseen_is_known_to_later_stages() {
    let bench = Bench::new();
    let told = r#"{"kind":"forecast","seconds":2.5,"mb":30,"mesh":{"triangles":8000,"edge":0.01}}"#;
    let description = MESHER.replace('\n', "");
    bench.text(&pipeline(&described(&bench, &description, &format!("[ $1 = forecast ] && echo '{told}'")), MESH));
    let (said, plan) = plan(&bench, &[]);
    assert_eq!(said.code, 0, "{said:?}");
    assert_eq!(
        (&plan["stages"][1]["expected_seconds"], &plan["stages"][1]["expected_mb"]),
        (&2.5.into(), &43.0.into())
    );
    assert_eq!(plan["expected"]["triangles"], 8000.0);
    assert!(plan["stages"][2]["expected_seconds"].as_f64().is_some_and(|s| s > 0.0), "{plan}");
}

#[test]
fn its_knobs_are_turned_by_an_asked_accuracy() {
    let bench = Bench::new();
    let description = MESHER.replace('\n', "").replace(r#""count":{"#, r#""rest":{"type":"string"},"count":{"#);
    bench.text(&pipeline(&described(&bench, &description, ""), MESH));
    let (said, plan) = plan(&bench, &["--accuracy", "fine"]);
    assert_eq!(said.code, 0, "{said:?}");
    assert_eq!(plan["stages"][1]["params"], serde_json::json!({ "fine": { "edge": "16 mm" }, "rest": "normal" }));
    assert_eq!(plan["stages"][1]["expected_seconds"], serde_json::Value::Null, "it told nothing");
}

#[test]
fn protocol_1_has_neither_knobs_nor_forecast() {
    let bench = Bench::new();
    let description = MESHER.replace('\n', "").replace("\"protocol\":2", "\"protocol\":1");
    let asked = bench.path("asked");
    bench.text(&pipeline(&described(&bench, &description, &format!("touch {}", asked.display())), MESH));
    let (said, plan) = plan(&bench, &[]);
    assert_eq!((said.code, asked.exists()), (0, false), "{said:?}");
    assert_eq!(plan["stages"][1]["expected_seconds"], serde_json::Value::Null);
    let found = bench.findings(&["--allow-run", "acme", "--accuracy", "fine"]);
    assert!(found.iter().any(|f| f.0 == "accuracy-no-stage"), "{found:?}");
}

#[test]
fn a_request_speaks_the_programs_own_protocol() {
    for (description, version) in [(DESCRIBE.to_owned(), 1), (DESCRIBE.replace(":1,\"stages", ":2,\"stages"), 2)] {
        let bench = Bench::new();
        let kept = bench.path("request.json");
        let program = described(&bench, &description, &format!("cp request.json {}; exit 1", kept.display()));
        bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n")).run(&["--allow-run", "acme"]);
        let request: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(kept).expect("request")).expect("JSON");
        assert_eq!(request["protocol"], version);
    }
}

#[test]
fn a_wrong_forecast_ends_the_plan() {
    for (body, expected) in [
        (r#"echo '{"kind":"forecast","seconds":-1}'"#, "below 0"),
        (r#"echo '{"kind":"forecast","seconds":1,"mesh":{"triangles":-3,"edge":0.01}}'"#, "below 0"),
        ("echo not json", "not of protocol 2"),
        ("exit 9", "ended with"),
    ] {
        let bench = Bench::new();
        bench.text(&pipeline(&described(&bench, &MESHER.replace('\n', ""), body), MESH));
        let (said, _) = plan(&bench, &[]);
        assert_eq!(said.code, 3, "{body}: {said:?}");
        assert!(said.err.contains(expected), "{body}: {}", said.err);
    }
}

/// Copies the garment, so that the stage has done its work.
const WORK: &str = "cp in/garment.json out/garment.json";

#[test]
fn a_process_it_leaves_behind_does_not_keep_the_run_waiting() {
    for pipes in ["", " >/dev/null", " 2>/dev/null"] {
        let bench = Bench::new();
        let program = script(&bench, &format!("{WORK}; setsid sleep 20{pipes} </dev/null &"));
        bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n"));
        let begun = Instant::now();
        assert_eq!(bench.run(&["--allow-run", "acme"]).code, 0, "{pipes}");
        assert!(begun.elapsed() < Duration::from_secs(4), "{pipes}: {:?}", begun.elapsed());
    }
}

#[test]
fn what_it_says_last_is_heard() {
    let (_, said) = misbehave("(sleep 0.1; echo late >&2; exit 9) ; exit 9");
    assert!(said.contains("late"), "{said}");
    let lines = "for i in 1 2 3; do echo '{\"kind\":\"progress\"}'; done";
    let (_, said) = misbehave(&format!("{lines}; echo not json"));
    assert!(said.contains("not of protocol"), "{said}");
}

#[test]
fn its_findings_are_limited_and_the_rest_is_counted() {
    let bench = Bench::new();
    let flood = r#"i=0; while [ $i -lt 1500 ]; do echo '{"kind":"diagnostic","severity":"warning","code":"c","message":"m"}'; i=$((i+1)); done"#;
    let program = script(&bench, &format!("{flood}; {WORK}"));
    bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n"));
    assert_eq!(bench.run(&["--allow-run", "acme"]).code, 0);
    let findings = bench.record()["findings"].as_array().expect("list").clone();
    assert_eq!(findings.len(), 1001);
    assert_eq!(findings[1000]["code"], "plugin-findings-left-out");
    assert!(findings[1000]["message"].as_str().is_some_and(|m| m.contains("1500")), "{}", findings[1000]);
}

#[test]
fn its_texts_are_cut_to_a_length() {
    let bench = Bench::new();
    let long = r#"m=x; for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18; do m=$m$m; done
        printf '{"kind":"diagnostic","severity":"warning","code":"c","message":"%s","hint":"%s"}\n' $m $m"#;
    let program = script(&bench, &format!("{long}; {WORK}"));
    bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n"));
    assert_eq!(bench.run(&["--allow-run", "acme"]).code, 0);
    let record = bench.record();
    for key in ["message", "hint"] {
        let text = record["findings"][0][key].as_str().expect("text");
        assert!(text.len() < 3000 && text.contains("260144 more letters"), "{key}: {} bytes", text.len());
    }
}

#[test]
fn consent_may_be_given_to_a_content_alone() {
    let bench = Bench::new();
    let program = script(&bench, WORK);
    bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n"));
    let said = bench.run(&[]);
    let content =
        said.err.split("--allow-run acme=").nth(1).and_then(|t| t.split(' ').next()).expect("digest").to_owned();
    assert_eq!(bench.run(&["--allow-run", &format!("acme={content}")]).code, 0);
    assert_eq!(bench.run(&["--force", "--allow-run", &format!("acme={}", &content[..8])]).code, 2, "too short");
    let text = std::fs::read_to_string(&program).expect("script");
    std::fs::write(&program, text + "# changed\n").expect("script");
    let said = bench.run(&["--force", "--allow-run", &format!("acme={content}")]);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("not the one that was allowed"), "{}", said.err);
    assert_eq!(bench.run(&["--force", "--allow-run", "acme"]).code, 0, "the name alone trusts any content");
}

#[test]
fn a_program_that_changes_during_the_run_is_not_started_again() {
    let bench = Bench::new();
    let program = script(&bench, &format!("{WORK}; echo '# more' >> {}", bench.path("program.sh").display()));
    bench.text(&pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n[[stage]]\nuse = \"acme.x\"\n"));
    assert_eq!(bench.run(&["--allow-run", "acme"]).code, 3);
    let finding = bench.record()["findings"][0].clone();
    assert!(finding["message"].as_str().is_some_and(|m| m.contains("changed since")), "{finding}");
}

/// The content of the program of plugin `acme`, as `plan` tells it.
fn content(bench: &Bench) -> String {
    let (_, plan) = plan(bench, &[]);
    plan["programs"][0]["content"].as_str().expect("content").to_owned()
}

#[test]
fn a_content_that_the_pipeline_states_must_be_there() {
    let bench = Bench::new();
    let program = script(&bench, WORK);
    let text = pipeline(&program, "[[stage]]\nuse = \"acme.x\"\n");
    bench.text(&text);
    let content = content(&bench);
    assert_eq!(bench.run(&["--allow-run", "acme"]).code, 0);
    assert_eq!(bench.record()["programs"][0]["content"], content.as_str(), "the record holds what was run");
    assert_eq!(bench.record()["programs"][0]["stated"], false);
    let key = bench.record()["key"].clone();
    let stated = text.replace("timeout =", &format!("content = \"{}\"\ntimeout =", &content[..20]));
    bench.text(&stated);
    assert_eq!(bench.run(&["--force"]).code, 2, "a pipeline does not allow itself");
    assert_eq!(bench.run(&["--force", "--allow-run", "acme"]).code, 0);
    assert_eq!(bench.record()["programs"][0]["stated"], true);
    assert_eq!(bench.record()["key"], key);
    let marker = bench.path("ran");
    let body = std::fs::read_to_string(&program).expect("script");
    std::fs::write(&program, body.replace("#!/bin/sh", &format!("#!/bin/sh\ntouch {}", marker.display())))
        .expect("script");
    for allowed in ["acme", &format!("acme={}", &content[..16])] {
        let found = bench.findings(&["--allow-run", allowed]);
        assert_eq!((found[0].0.as_str(), found[0].1, found[0].2), ("plugin-changed", 7, 11), "{found:?}");
        assert!(found[0].3.contains("write content = "), "{found:?}");
    }
    assert!(!marker.exists(), "the changed program ran");
    bench.text(&stated.replace(&content[..20], "1234"));
    assert_eq!(bench.findings(&["--allow-run", "acme"])[0].0, "out-of-range");
}

#[test]
fn a_script_beside_the_pipeline_belongs_to_the_content() {
    let bench = Bench::new();
    let script = script(&bench, WORK);
    let beside = bench.pipeline_file().with_file_name("plugin.sh");
    std::fs::rename(script, &beside).expect("script");
    let command =
        pipeline(Path::new("sh"), "[[stage]]\nuse = \"acme.x\"\n").replace("[\"sh\"]", "[\"sh\", \"plugin.sh\"]");
    bench.text(&command);
    let allowed = format!("acme={}", content(&bench));
    assert_eq!(bench.run(&["--allow-run", &allowed]).code, 0, "it runs from any folder");
    let text = std::fs::read_to_string(&beside).expect("script");
    std::fs::write(&beside, text + "# changed\n").expect("script");
    let said = bench.run(&["--force", "--allow-run", &allowed]);
    assert!(said.code == 2 && said.err.contains("plugin-changed"), "{said:?}");
}
