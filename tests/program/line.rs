//! A product line: mistakes, plan, list, runs that are killed and resumed, gates.

use crate::support;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;
use std::time::Duration;
use support::project::Project;

/// Two axes and a quick chain: 3 × 2 jobs, of which two are left out and one is added.
const LINE: &str = "toile = 1\n[line]\nname = \"prints\"\n\
    [[style]]\nname = \"skirt\"\npipeline = \"printed.toml\"\n\
    [matrix]\nsize = [\"36\", \"38\", \"40\"]\n\
    paper.narrow = { export-print.width = \"600 mm\" }\npaper.wide = { export-print.width = \"1500 mm\" }\n\
    [[exclude]]\nsize = [\"36\", \"40\"]\npaper = \"wide\"\n\
    [[include]]\nstyle = \"skirt\"\nsize = \"38\"\npaper = \"wide\"\nname = \"loose\"\nset = { export-print.gap = \"40 mm\" }\n";

fn jobs(project: &Project) -> BTreeMap<String, Value> {
    let (code, out, err) = project.toile("line jobs line.toml");
    assert_eq!(code, 0, "{err}");
    let job = |line: &str| serde_json::from_str::<Value>(line).expect("JSON");
    out.lines().map(job).map(|j| (j["job"].as_str().expect("name").to_owned(), j)).collect()
}

#[test]
fn a_matrix_becomes_jobs_with_inputs_outputs_and_keys() {
    let project = Project::new();
    project.write("line.toml", LINE);
    let all = jobs(&project);
    let names: Vec<&str> = all.keys().map(String::as_str).collect();
    let wanted = ["narrow_36", "narrow_38", "narrow_40", "wide_38", "wide_38_loose"];
    assert_eq!(names, wanted.map(|n| format!("skirt_{n}")));
    let job = &all["skirt_narrow_36"];
    assert_eq!(job["choices"], serde_json::json!({ "paper": "narrow", "size": "36" }));
    assert_eq!(job["outputs"], serde_json::json!(["pieces.svg"]));
    let read = |name: &str| job["inputs"].as_array().expect("inputs").iter().find(|i| i["path"] == name).cloned();
    let digest = blake3::hash(&std::fs::read(project.path("long-skirt.astm.dxf")).expect("file")).to_hex().to_string();
    assert_eq!(read("long-skirt.astm.dxf").expect("pattern")["blake3"], digest);
    assert!(read("long-skirt.astm.rul").expect("looked for")["blake3"].is_null(), "a rule table that is not there");
    let keys: BTreeSet<&str> = all.values().map(|j| j["key"].as_str().expect("key")).collect();
    assert_eq!(keys.len(), 5, "every job is another content");
    let (code, out, err) = project.toile("deps printed.toml --set size=36 --set export-print.width=600mm --json");
    assert_eq!(code, 0, "{err}");
    let deps: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(
        (&deps["key"], &deps["inputs"].as_array().map(Vec::len)),
        (&job["key"], &job["inputs"].as_array().map(Vec::len))
    );
    let (code, out, _) = project.toile("line plan line.toml --json");
    let plan: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!((code, &plan["jobs"], &plan["different"], &plan["files"]), (0, &5.into(), &5.into(), &10.into()));
}

#[test]
fn a_key_follows_the_content_and_nothing_else() {
    let project = Project::new();
    project.write("line.toml", LINE);
    let key = |all: &BTreeMap<String, Value>, job: &str| all[job]["key"].clone();
    let before = jobs(&project);
    project.change("printed.toml", "toile = 1", "# A comment.\ntoile = 1");
    project.change("line.toml", "\"prints\"", "\"prints\"\nabout = \"words\"");
    assert_eq!(key(&jobs(&project), "skirt_wide_38"), key(&before, "skirt_wide_38"));
    project.change("line.toml", "1500 mm", "1400 mm");
    let after = jobs(&project);
    assert_eq!(key(&after, "skirt_narrow_38"), key(&before, "skirt_narrow_38"));
    assert_ne!(key(&after, "skirt_wide_38"), key(&before, "skirt_wide_38"));
    project.write("long-skirt.astm.rul", "");
    assert_ne!(key(&jobs(&project), "skirt_narrow_38"), key(&before, "skirt_narrow_38"), "a file that was not there");
}

#[test]
fn all_mistakes_of_all_jobs_are_told_at_once_with_their_places() {
    let project = Project::new();
    let bad = LINE
        .replace("export-print.width = \"600 mm\"", "export-print.widht = \"600 mm\"")
        .replace("paper = \"wide\"\n[[inc", "paper = \"wade\"\n[[inc")
        .replace("\"40\"]\npaper.n", "\"41\"]\npaper.n")
        + "[[style]]\nname = \"coat\"\npipeline = \"coat.toml\"\n[limits]\ntime = \"60\"\n[[gate]]\nfigure = \"x\"\n";
    project.write("line.toml", &bad);
    let (code, out, _) = project.toile("line check line.toml --format json");
    assert_eq!(code, 2);
    let found: Value = serde_json::from_str(&out).expect("JSON");
    let line_of = |text: &str| bad.lines().position(|l| l.contains(text)).expect("line") as u64 + 1;
    let mut told: Vec<(String, u64)> = Vec::new();
    for finding in found["findings"].as_array().expect("findings") {
        told.push((
            finding["code"].as_str().expect("code").to_owned(),
            finding["source"]["line"].as_u64().unwrap_or(0),
        ));
    }
    for (code, place) in [
        ("unknown-key", line_of("widht")),
        ("line-choice-unknown", line_of("wade")),
        ("file-missing", line_of("coat.toml") - 2),
        ("wrong-value", line_of("time =")),
        ("missing-key", line_of("figure =") - 1),
    ] {
        assert!(told.iter().any(|(c, l)| c == code && *l == place), "{code} in line {place} is not in {told:?}");
    }
    assert!(told.iter().any(|(c, _)| c == "size-not-found"), "files are read, too: {told:?}");
}

#[test]
fn what_is_done_is_not_done_again_and_a_change_runs_its_own_jobs() {
    let project = Project::new();
    project.write("line.toml", LINE);
    let (code, out, err) = project.toile("line run line.toml --out out -j 2");
    assert_eq!(code, 0, "{out}{err}");
    assert!(out.starts_with("5 jobs: 0 of 5 were done before; 5 passed"), "{out}");
    let first = project.digests("out/jobs");
    assert_eq!(first.len(), 5, "one output for each job: {first:?}");
    let again = |wanted: &str| {
        let (code, out, err) = project.toile("line run line.toml --out out -j 2");
        assert_eq!(code, 0, "{out}{err}");
        assert!(out.contains(wanted), "{out}");
    };
    again("5 of 5 were done before");
    project.change("line.toml", "1500 mm", "1400 mm");
    again("3 of 5 were done before");
    std::fs::write(project.path("out/jobs/skirt_narrow_36/pieces.svg"), "damaged").expect("damage");
    again("4 of 5 were done before");
    std::fs::remove_file(project.path("out/jobs/skirt_narrow_38/run.json")).expect("removed");
    again("4 of 5 were done before");
    let now = project.digests("out/jobs");
    let differ: Vec<&String> = now.keys().filter(|k| now[*k] != first[*k]).collect();
    assert!(differ.iter().all(|k| k.starts_with("skirt_wide")), "{differ:?}");
    let results = project.json("out/line.json");
    assert_eq!(results["jobs"][0]["job"], "skirt_narrow_36");
}

#[test]
fn two_versions_of_a_line_are_compared_job_by_job() {
    let project = Project::new();
    project.write("line.toml", LINE);
    assert_eq!(project.toile("line run line.toml --out old -j 2").0, 0);
    let (code, out, err) = project.toile("diff old old");
    assert!(code == 0 && out.ends_with("5 jobs: 0 differ, 0 over the tolerance\n"), "{out}{err}");
    // One choice changes, and one job gets another name.
    project.change("line.toml", "1500 mm", "1400 mm");
    project.change("line.toml", "name = \"loose\"", "name = \"free\"");
    assert_eq!(project.toile("line run line.toml --out new -j 2").0, 0);
    let (code, out, _) = project.toile("diff old new");
    assert_eq!(code, 1, "{out}");
    for told in [
        "6 jobs: 3 differ, 3 over the tolerance",
        "  skirt_wide_38_loose: good, and is gone",
        "  skirt_wide_38_free: good, and is new",
        "export-print.width: 1500 mm → 1400 mm (jobs: 1)  over the tolerance in 1",
    ] {
        assert!(out.contains(told), "`{told}` is not in {out}");
    }
    let (_, json, _) = project.toile("diff old new --format json");
    let found: Value = serde_json::from_str(&json).expect("JSON");
    let names: Vec<&str> = found["jobs"].as_array().expect("jobs").iter().filter_map(|j| j["job"].as_str()).collect();
    assert_eq!(
        (names, found["over"].as_u64()),
        (vec!["skirt_wide_38", "skirt_wide_38_loose", "skirt_wide_38_free"], Some(3))
    );
    project.write("any.toml", "strain = 0.1\n");
    let (code, out, _) = project.toile("diff old new --tolerance any.toml");
    assert!(code == 1 && out.contains("6 jobs: 3 differ, 2 over"), "a job that is gone is over: {out}");
    std::fs::write(project.path("new/jobs/skirt_wide_38/run.json"), "damaged").expect("damage");
    let (_, out, _) = project.toile("diff old new");
    assert!(out.contains("result of the job: cannot be opened, and is new (jobs: 1)"), "{out}");
}

#[test]
fn failures_carry_their_code_stay_to_look_at_and_are_not_tried_again() {
    let project = Project::new();
    // The sewing file of the small size names a piece that no pattern has.
    let sewing = std::fs::read_to_string(project.path("long-skirt.sewing.toml")).expect("sewing");
    project.write("wrong.sewing.toml", &sewing.replace("FRONT", "FRNT"));
    project.change("printed.toml", "with.sewing = \"long", "with.sewing = \"{sewing}");
    project.change("printed.toml", "[input]\n", "[input]\nsewing = { kind = \"text\", default = \"long-skirt\" }\n");
    project.change("printed.toml", "{sewing}-skirt.sewing.toml", "{sewing}.sewing.toml");
    let line = "toile = 1\n[line]\nname = \"x\"\n[[style]]\nname = \"skirt\"\npipeline = \"printed.toml\"\n\
        [matrix]\nsize = [\"38\"]\n[[gate]]\nfigure = \"strain_max\"\nmax = 0.1\n";
    project.write("line.toml", line);
    let (code, out, err) = project.toile("line run line.toml --out out");
    assert_eq!(code, 1, "a gate without its figure does not pass: {out}{err}");
    let results = project.json("out/line.json");
    assert_eq!(results["jobs"][0]["status"], "gate-failed");
    assert!(results["jobs"][0]["why"][0].as_str().expect("why").contains("`strain_max` has nothing to look at"));
    let (code, _, err) = project.toile("run printed.toml --set sewing=wrong --out wrong --quiet");
    assert!((2..=4).contains(&code), "{err}");
    let record = project.json("wrong/run.json");
    assert_eq!(record["exit_code"], code);
    assert!(record["key"].is_string(), "a failed run has its key, too");
}

/// The workflow in `pipelines/line` reads `toile line jobs` and starts what it says there.
#[test]
fn the_workflow_finds_its_facts_and_they_make_what_the_line_makes() {
    let project = Project::new();
    project.write("line.toml", &LINE.replace("[[style]]", "[limits]\ntime = \"60 s\"\n[[style]]"));
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let plan = std::fs::read_to_string(root.join("pipelines/line/plan.py")).expect("plan");
    let job = &jobs(&project)["skirt_wide_38_loose"];
    let facts: BTreeSet<&str> = plan.split("job[\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert_eq!(facts.into_iter().collect::<Vec<_>>(), ["arguments", "expected", "job", "key"]);
    assert!(job["expected"]["mb"].is_number() && job["expected"]["seconds"].is_number());
    let arguments: Vec<&str> = job["arguments"].as_array().expect("list").iter().filter_map(Value::as_str).collect();
    assert_eq!(arguments.first(), Some(&"run"));
    assert!(arguments.ends_with(&["--max-seconds", "60"]), "{arguments:?}");
    let alone = ["--out", "alone/skirt_wide_38_loose", "--quiet", "--force"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_toile"));
    command.current_dir(project.dir.path()).args(arguments).args(alone);
    assert!(command.status().expect("program").success());
    assert_eq!(project.toile("line run line.toml --out out --quiet --only job=skirt_wide_38_loose").0, 0);
    assert_eq!(project.digests("alone"), project.digests("out/jobs"));
    assert_eq!(project.json("alone/skirt_wide_38_loose/run.json")["key"], job["key"]);
}

#[cfg(unix)]
#[test]
fn a_killed_line_goes_on_and_gives_the_bytes_of_a_serial_one() {
    let project = Project::new();
    let many = LINE.replace("[\"36\", \"38\", \"40\"]", "[\"36\", \"38\", \"40\"]\nexport-print = [1]");
    let widths: Vec<String> = (0..4).map(|k| format!("w{k} = {{ export-print.gap = \"{} mm\" }}", 10 + k)).collect();
    let many = many.replace("export-print = [1]", &format!("gap = {{ {} }}", widths.join(", ")));
    project.write("line.toml", many.split("[[exclude]]").next().expect("matrix"));
    let (code, out, err) = project.toile("line run line.toml --out serial -j 1 --quiet");
    assert_eq!(code, 0, "{out}{err}");
    let serial = project.digests("serial/jobs");
    assert_eq!(serial.len(), 24);
    let mut killed = 0;
    for wait in [150, 420, 300, 700] {
        let mut child = project.command("line run line.toml --out killed -j 2 --quiet").spawn().expect("line");
        std::thread::sleep(Duration::from_millis(wait));
        killed += u32::from(child.try_wait().expect("state").is_none());
        drop(child.kill());
        child.wait().expect("end");
    }
    assert!(killed >= 1, "the line was through before it was killed");
    let (code, out, err) = project.toile("line run line.toml --out killed -j 2 --quiet");
    assert_eq!(code, 0, "{out}{err}");
    assert_eq!(project.digests("killed/jobs"), serial, "outputs, and nothing half-written beside them");
}

#[test]
fn one_folder_belongs_to_one_line_at_a_time() {
    let project = Project::new();
    project.write("line.toml", LINE);
    std::fs::create_dir_all(project.path("out")).expect("folder");
    let lock = toile::line::Lock::take(&project.path("out")).expect("lock");
    let (code, _, err) = project.toile("line run line.toml --out out");
    assert_eq!(code, 2);
    assert!(err.contains("another line is run there"), "{err}");
    drop(lock);
    assert_eq!(project.toile("line run line.toml --out out --only size=38").0, 0, "judged by its own jobs");
    assert_eq!(project.digests("out/jobs").len(), 3);
    assert_eq!(project.toile("line report line.toml --out out").0, 130, "two jobs were never run");
}

#[test]
fn gates_that_nothing_can_pass_are_refused_before_any_job() {
    let project = Project::new();
    for (gate, told) in [
        ("figure = \"strain_mix\"\nmax = 0.1", "did you mean `strain_max`?"),
        ("figure = \"body_crossings\"\nmax = -1", "never below 0"),
        ("figure = \"strain_max\"\nmin = 0.2\nmax = 0.1", "at least 0.2 and at most 0.1"),
        ("figure = \"hip_girth.drape.tape\"\nmax = 980", "its bound has no unit"),
        ("figure = \"strain_max\"\nmax = \"2 mm\"", "is no length"),
    ] {
        project.write("line.toml", &format!("{LINE}[[gate]]\n{gate}\n"));
        let (code, out, err) = project.toile("line check line.toml");
        assert!(code == 2 && err.contains(told), "{gate}: {out}{err}");
    }
    let good =
        "[[gate]]\nfigure = \"hip_girth.drape.tape\"\nmin = \"980 mm\"\n[[gate]]\nfigure = \"strain_max\"\nmax = 1\n";
    project.write("line.toml", &format!("{LINE}{good}"));
    assert_eq!(project.toile("line check line.toml").0, 0);
}

#[test]
fn a_part_that_no_line_has_and_a_folder_without_results_are_refused() {
    let project = Project::new();
    project.write("line.toml", LINE);
    for (asked, told) in [
        ("--only sise=38", "did you mean `size`?"),
        ("--only size=39", "`size` has no `39`"),
        ("--only size=36 --only paper=wide", "no job has all of"),
    ] {
        let (code, out, err) = project.toile(&format!("line run line.toml --out out {asked}"));
        assert!(code == 2 && out.is_empty() && err.contains(told), "{asked}: {out}{err}");
    }
    let (code, out, err) = project.toile("line report line.toml --out out");
    assert!(code == 2 && out.is_empty() && err.contains("there are no results of a line in `out`"), "{out}{err}");
    assert!(!project.path("out").exists(), "nothing is made for it");
}

#[test]
fn every_file_that_a_sample_reads_is_foreseen() {
    let project = Project::new();
    let (code, _, err) = project.toile("run printed.toml --out a --quiet");
    assert_eq!(code, 0, "{err}");
    assert!(project.json("a/run.json")["key"].is_string());
}
