//! Running a chain: outputs, refusals, exit codes, the record.

use crate::support;
use support::bench::Bench;

const WRITE: &str = "[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n[[stage]]\nuse = \"test-write\"\nwith.file = \"{out}/a.txt\"\nwith.text = \"hello {line} v{version}\"\n";

#[test]
fn writes_outputs_and_record() {
    let bench = Bench::new();
    let said = bench.stages(WRITE).run(&["--threads", "2"]);
    assert_eq!(said.code, 0, "{said:?}");
    assert_eq!(bench.left(), ["a.txt", "run.json"]);
    assert_eq!(bench.output("a.txt").as_deref(), Some("hello test v1"));
    let record = bench.record();
    assert_eq!(record["exit_code"], 0);
    assert_eq!(record["threads"], 2);
    assert_eq!(record["garment"]["triangles"], 2);
    assert_eq!(record["stages"][0]["use"], "test-sheet");
    assert_eq!(record["stages"][0]["revision"], 3);
    assert_eq!(record["stages"][0]["params"]["side"], "1000 mm");
    assert_eq!(record["outputs"][0]["path"], "a.txt");
    let digest = blake3::hash(b"hello test v1").to_hex().to_string();
    assert_eq!(record["outputs"][0]["blake3"], digest);
    assert!(record["stages"][0]["seconds"].is_number());
}

#[test]
fn never_overwrites_without_force() {
    let bench = Bench::new();
    assert_eq!(bench.stages(WRITE).run(&[]).code, 0);
    std::fs::write(bench.out().join("a.txt"), "mine").expect("file");
    let said = bench.run(&[]);
    assert_eq!(said.code, 2, "{said:?}");
    assert_eq!(bench.output("a.txt").as_deref(), Some("mine"));
    assert_eq!(bench.run(&["--force"]).code, 0);
    assert_eq!(bench.output("a.txt").as_deref(), Some("hello test v1"));
}

#[test]
fn refuses_before_the_work_when_outputs_are_there() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.out()).expect("folder");
    std::fs::write(bench.out().join("a.txt"), "mine").expect("file");
    let slow = "[[stage]]\nuse = \"test-slow\"\nwith.ms = 60000\n";
    let begun = std::time::Instant::now();
    assert_eq!(bench.stages(&format!("{slow}{WRITE}")).run(&[]).code, 2);
    assert!(begun.elapsed().as_secs() < 20);
    assert_eq!(bench.left(), ["a.txt"]);
}

#[test]
fn a_failed_run_leaves_its_record_and_nothing_else() {
    for (way, code) in [
        ("input", 3),
        ("parameter", 2),
        ("unsupported", 3),
        ("limit", 3),
        ("unstable", 4),
        ("internal", 5),
        ("panic", 5),
        ("finding", 3),
    ] {
        let bench = Bench::new();
        let fail = format!("{WRITE}[[stage]]\nuse = \"test-fail\"\nwith.way = \"{way}\"\n");
        let said = bench.stages(&fail).run(&[]);
        assert_eq!(said.code, code, "{way}: {said:?}");
        assert_eq!(bench.left(), ["run.json"], "{way}");
        let record = bench.record();
        assert_eq!(record["exit_code"], code, "{way}");
        assert_eq!(record["outputs"].as_array().map(Vec::len), Some(0));
        assert_eq!(record["findings"].as_array().map(Vec::len), Some(1), "{way}");
        // A run that wrote nothing does not stand in the way of the next.
        assert_eq!(bench.stages(WRITE).run(&[]).code, 0, "{way}");
    }
}

#[test]
fn a_failed_certificate_writes_and_says_so() {
    let bench = Bench::new();
    let drape = "[[stage]]\nuse = \"test-drape\"\nwith.passed = false\n";
    assert_eq!(bench.stages(&format!("{WRITE}{drape}")).run(&[]).code, 1);
    assert_eq!(bench.left(), ["a.txt", "run.json"]);
    assert_eq!(bench.record()["certificate"]["passed"], false);
    assert_eq!(bench.record()["findings"][0]["code"], "certificate-failed");
}

#[test]
fn times_stay_out_of_the_document() {
    let texts: Vec<String> = (0..2)
        .map(|_| {
            let bench = Bench::new();
            let stages = "[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n[[stage]]\nuse = \"test-drape\"\n[[stage]]\nuse = \"test-write\"\nwith = { file = \"{out}/g.json\", document = true }\n";
            assert_eq!(bench.stages(stages).run(&[]).code, 0);
            let cost = bench.record()["effects"][0]["cpu_seconds"].as_f64().expect("seconds");
            assert!(cost >= 0.25, "{cost}");
            bench.output("g.json").expect("document")
        })
        .collect();
    assert_eq!(texts[0], texts[1]);
    assert!(texts[0].contains("\"file\":\"{out}/g.json\""));
    assert!(!texts[0].contains(std::env::temp_dir().to_str().expect("text")));
}

#[test]
fn inputs_are_digested_and_paths_on_the_command_line_are_consent() {
    let bench = Bench::new();
    let elsewhere = tempfile::tempdir().expect("folder");
    let file = elsewhere.path().join("p.dxf");
    std::fs::write(&file, "pattern").expect("file");
    let text = "toile = 1\npipeline = { line = \"t\", version = 1 }\ninput.pattern = \"path\"\n[[stage]]\nuse = \"test-read\"\nwith.file = \"{pattern}\"\n[[stage]]\nuse = \"test-write\"\nwith = { file = \"{out}/g.json\", document = true }\n";
    let set = format!("pattern={}", file.display());
    let said = bench.text(text).run(&["--set", &set]);
    assert_eq!(said.code, 0, "{said:?}");
    let input = &bench.record()["inputs"][1];
    assert_eq!(input["path"], "{pattern}/p.dxf");
    assert_eq!(input["blake3"], blake3::hash(b"pattern").to_hex().to_string());
    let document = bench.output("g.json").expect("document");
    assert!(document.contains("\"style\":\"pattern\"") && !document.contains("/tmp/"), "{document}");
}

#[test]
fn an_override_reaches_text_numbers_and_tables() {
    let bench = Bench::new();
    bench.stages("[[stage]]\nuse = \"test-sheet\"\nid = \"cut\"\nwith.side = \"1 m\"\n");
    let sets =
        ["--set", "cut.side=5 mm", "--set", "cut.name=40", "--set", "cut.count=2", "--set", "cut.mark.depth=1 mm"];
    let said = bench.run(&sets);
    assert_eq!(said.code, 0, "{said:?}");
    let params = &bench.record()["stages"][0]["params"];
    assert_eq!((&params["side"], &params["name"]), (&"5 mm".into(), &"40".into()));
    assert_eq!((&params["count"], &params["mark"]["depth"]), (&2.into(), &"1 mm".into()));
    assert_eq!(bench.record()["set"][0], "cut.side=5 mm");
}

#[test]
fn sweeps_what_a_killed_run_left() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.out()).expect("folder");
    std::fs::write(bench.out().join(".0.tmp-toile"), "half").expect("file");
    std::fs::write(bench.out().join(".lock.tmp-toile"), "").expect("file");
    assert_eq!(bench.stages(WRITE).run(&[]).code, 0);
    assert_eq!(bench.left(), ["a.txt", "run.json"]);
}

#[test]
fn two_runs_do_not_share_a_folder() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.out()).expect("folder");
    let held = std::fs::File::create(bench.out().join(".lock.tmp-toile")).expect("lock");
    held.try_lock().expect("held");
    let said = bench.stages(WRITE).run(&["--force"]);
    assert_eq!(said.code, 2);
    drop(held);
    assert_eq!(bench.run(&[]).code, 0);
}

#[cfg(unix)]
#[test]
fn a_link_does_not_lead_out_of_the_output_folder() {
    let bench = Bench::new();
    let elsewhere = tempfile::tempdir().expect("folder");
    std::fs::create_dir_all(bench.out()).expect("folder");
    std::os::unix::fs::symlink(elsewhere.path(), bench.out().join("sub")).expect("link");
    let stages = "[[stage]]\nuse = \"test-write\"\nwith = { file = \"{out}/sub/a.txt\", text = \"x\" }\n";
    assert_eq!(bench.stages(stages).run(&[]).code, 2);
    assert_eq!(support::bench::list(elsewhere.path()), [""; 0]);
}

#[test]
fn an_output_folder_that_cannot_be_made_is_found_at_once() {
    let bench = Bench::new();
    std::fs::write(bench.path("result"), "a file").expect("file");
    let slow = "[[stage]]\nuse = \"test-slow\"\nwith.ms = 60000\n";
    assert_eq!(bench.stages(slow).run(&[]).code, 5);
}

#[test]
fn events_are_json_lines_in_order() {
    let bench = Bench::new();
    let events = bench.path("events.jsonl");
    let path = events.to_str().expect("text").to_owned();
    let flood = "[[stage]]\nuse = \"test-fail\"\nwith.way = \"flood\"\n";
    assert_eq!(bench.stages(&format!("{WRITE}{flood}")).run(&["--events", &path]).code, 0);
    let text = std::fs::read_to_string(&events).expect("events");
    let lines: Vec<serde_json::Value> = text.lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    assert!(lines.iter().enumerate().all(|(i, l)| l["seq"] == i && l["v"] == 1));
    assert_eq!(lines[0]["kind"], "stage.start");
    assert_eq!(lines.last().expect("line")["kind"], "run.end");
    assert_eq!(lines.iter().filter(|l| l["kind"] == "finding").count(), 100);
    assert_eq!(bench.run(&["--force", "--events", &path]).code, 0);
    assert_eq!(bench.run(&["--out", "elsewhere", "--events", &path]).code, 2, "events are not overwritten either");
}

/// A folder that is not there is named with what helps, for events and for the files of other verbs.
#[test]
fn a_missing_folder_of_an_output_is_named() {
    let bench = Bench::new();
    let lost = bench.path("og/x").display().to_string();
    let said = bench.stages(WRITE).run(&["--events", &lost]);
    let folder = "og`: make it, or correct the name";
    assert!(said.code == 2 && said.err.contains(folder) && !said.err.contains("--force"), "{said:?}");
    assert_eq!(bench.run(&["--events", &bench.path("").display().to_string()]).code, 2);
    let pattern = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/patterns/long-skirt.astm.dxf");
    let said = support::bench::command(["inspect", pattern, "--svg", &lost].map(Into::into).to_vec());
    assert!(said.code == 2 && said.err.contains(folder), "{said:?}");
}

/// Names that would take each other's place are refused before the work: events and outputs, the record, a file that
/// would have to be a folder, too.
#[test]
fn outputs_under_one_name_are_refused() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.out()).expect("folder");
    for name in ["a.txt", "run.json"] {
        let events = bench.out().join(name).display().to_string();
        let said = bench.stages(WRITE).run(&["--force", "--events", &events]);
        assert!(said.code == 2 && said.err.contains("outputs-collide"), "{said:?}");
    }
    for name in ["run.json", "a.txt/b.txt"] {
        let other = WRITE.split_once("[[stage]]\nuse = \"test-write\"").expect("a stage").1.replace("a.txt", name);
        let said = bench.stages(&format!("{WRITE}[[stage]]\nuse = \"test-write\"{other}")).run(&[]);
        assert!(said.code == 2 && said.err.contains("outputs-collide"), "{said:?}");
    }
    assert_eq!(bench.left(), Vec::<String>::new());
}

#[test]
fn an_input_that_is_used_nowhere_is_told() {
    let bench = Bench::new();
    let with = |text: &str| {
        let file = bench.stages(&WRITE.replace("hello", text)).pipeline_file();
        let before = std::fs::read_to_string(&file).expect("text");
        std::fs::write(&file, format!("{before}\n[input]\nsize = {{ kind = \"text\", default = \"38\" }}\n"))
            .expect("file");
        support::bench::command(["check".into(), file.into()].to_vec())
    };
    let said = with("hello");
    assert!(said.code == 0 && said.err.contains("input-unused") && said.err.contains("`size`"), "{said:?}");
    assert!(!with("{size}").err.contains("input-unused"));
}

const READ: &str = "[[stage]]\nuse = \"test-read\"\nwith.file = \"../../result/a.txt\"\n";

#[test]
fn force_never_replaces_an_input_of_the_run() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.out()).expect("folder");
    std::fs::write(bench.out().join("a.txt"), "the customer's").expect("file");
    let said = bench.stages(&format!("{READ}{WRITE}")).run(&["--force"]);
    assert_eq!(said.code, 2, "{said:?}");
    assert_eq!(bench.output("a.txt").as_deref(), Some("the customer's"));
    assert_eq!(bench.left(), ["a.txt"]);
}

#[test]
fn force_replaces_neither_the_pipeline_nor_an_input_called_like_the_record() {
    let bench = Bench::new();
    let own = WRITE.replace("a.txt", "v1.toml");
    let before = bench.stages(&own).pipeline_file();
    let text = std::fs::read_to_string(&before).expect("text");
    let folder = before.parent().expect("folder").to_path_buf();
    let run = |more: &[&str]| {
        let mut all =
            vec!["run".to_owned(), before.display().to_string(), "--out".into(), folder.display().to_string()];
        all.extend(more.iter().map(|s| (*s).to_owned()));
        support::bench::command(all.into_iter().map(Into::into).collect())
    };
    assert_eq!(run(&["--force", "--quiet"]).code, 2);
    assert_eq!(std::fs::read_to_string(&before).expect("text"), text);
    let events = before.to_str().expect("text").to_owned();
    assert_eq!(run(&["--force", "--quiet", "--events", &events]).code, 2);
    assert_eq!(std::fs::read_to_string(&before).expect("text"), text, "events replace no input either");
    std::fs::write(folder.join("run.json"), "a pattern of this name").expect("file");
    bench.stages("[[stage]]\nuse = \"test-read\"\nwith.file = \"run.json\"\n");
    assert_eq!(run(&["--force", "--quiet"]).code, 2);
    assert_eq!(std::fs::read_to_string(folder.join("run.json")).expect("text"), "a pattern of this name");
}

#[test]
fn outputs_of_an_earlier_run_are_gone_before_the_work() {
    let bench = Bench::new();
    let two = format!(
        "{WRITE}{}",
        WRITE.replace("a.txt", "b.txt").replace("[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n", "")
    );
    assert_eq!(bench.stages(&two).run(&[]).code, 0);
    assert_eq!(bench.left(), ["a.txt", "b.txt", "run.json"]);
    let fails = format!("{WRITE}[[stage]]\nuse = \"test-fail\"\nwith.way = \"unstable\"\n");
    assert_eq!(bench.stages(&fails).run(&["--force"]).code, 4);
    assert_eq!(bench.left(), ["run.json"], "nothing of the run that passed lies beside one that failed");
    assert_eq!(bench.record()["exit_code"], 4);
    assert_eq!(bench.stages(&two).run(&[]).code, 0);
    assert_eq!(bench.stages(WRITE).run(&["--force"]).code, 0);
    assert_eq!(bench.left(), ["a.txt", "run.json"], "an output that is not made anew is gone too");
}

#[test]
fn an_output_that_was_changed_since_or_is_read_now_stays() {
    let bench = Bench::new();
    assert_eq!(bench.stages(WRITE).run(&[]).code, 0);
    std::fs::write(bench.out().join("a.txt"), "mine").expect("file");
    let other = WRITE.replace("a.txt", "b.txt");
    assert_eq!(bench.stages(&other).run(&["--force"]).code, 0);
    assert_eq!(bench.output("a.txt").as_deref(), Some("mine"));
    assert_eq!(bench.record()["findings"][0]["code"], "earlier-output-changed");
    assert_eq!(bench.stages(WRITE).run(&["--force"]).code, 0);
    assert_eq!(bench.stages(&format!("{READ}{other}")).run(&["--force"]).code, 0);
    assert_eq!(bench.left(), ["a.txt", "b.txt", "run.json"], "an earlier output may be an input now");
}

#[cfg(unix)]
#[test]
fn lock_and_temporary_files_follow_no_link() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.out()).expect("folder");
    let victim = bench.path("victim");
    std::fs::write(&victim, "mine").expect("file");
    for name in [".0.tmp-toile", ".record.tmp-toile"] {
        std::os::unix::fs::symlink(&victim, bench.out().join(name)).expect("link");
    }
    assert_eq!(bench.stages(WRITE).run(&[]).code, 0);
    assert_eq!(bench.left(), ["a.txt", "run.json"]);
    std::os::unix::fs::symlink(bench.path("absent"), bench.out().join(".lock.tmp-toile")).expect("link");
    assert_eq!(bench.run(&["--force"]).code, 5);
    assert!(!bench.path("absent").exists());
    assert_eq!(std::fs::read_to_string(&victim).expect("text"), "mine");
}

#[test]
fn a_file_is_known_by_its_parameter_and_not_by_its_looks() {
    let bench = Bench::new();
    let missing = ["nope", "skirt.aama", "http://x/y", "a.b.c"].map(|name| (name, 3));
    let refused = [".", "..", "{out}/x.dxf", ""].map(|name| (name, 2));
    for (name, exit) in missing.into_iter().chain(refused) {
        bench.stages(&format!("[[stage]]\nuse = \"test-read\"\nwith.file = \"{name}\"\n"));
        let said = bench.check(&[]);
        assert_eq!(said.code, exit, "{name:?}: {said:?}");
    }
    for text in ["/lining", "./x", "c:/x", "front.dxf", "a.toml", "../.."] {
        let stages = WRITE.replace("hello {line} v{version}", text);
        let said = bench.stages(&stages).check(&[]);
        assert_eq!(said.code, 0, "{text:?}: {said:?}");
    }
}

#[test]
fn a_run_over_its_time_is_stopped_with_words() {
    let bench = Bench::new();
    bench.stages(&format!("{WRITE}[[stage]]\nuse = \"test-slow\"\nwith.ms = 60000\n"));
    let begun = std::time::Instant::now();
    assert_eq!(bench.run(&["--max-seconds", "0.3"]).code, 5);
    assert!(begun.elapsed().as_secs() < 20);
    assert_eq!(bench.left(), ["run.json"]);
    assert_eq!(bench.record()["findings"][0]["code"], "over-limit");
    assert_eq!(bench.run(&["--max-seconds", "-1"]).code, 2);
}
