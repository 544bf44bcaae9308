//! Bodies that end or are torn near an edge's attachment: a refusal with words or a sewn garment, never a panic.

use crate::support;
use support::bench::{Bench, SKIRT_STAGES};

/// A project with the sample skirt and the faces of the sample body that a rule keeps.
fn project(keep: impl Fn(usize, [[f64; 3]; 3]) -> bool) -> Bench {
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj");
    let file = bench.path("pipelines/test/body.obj");
    let text = std::fs::read_to_string(&file).expect("body");
    let place = |line: &str| {
        let mut numbers = line.split_whitespace().skip(1).map(|n| n.parse::<f64>().expect("number"));
        [0; 3].map(|_| numbers.next().expect("coordinate"))
    };
    let points: Vec<[f64; 3]> = text.lines().filter(|l| l.starts_with("v ")).map(place).collect();
    let corner = |word: &str| word.split('/').next().and_then(|n| n.parse::<usize>().ok()).expect("index");
    let mut faces = 0;
    let kept = text.lines().filter(|line| {
        let Some(words) = line.strip_prefix("f ") else { return true };
        let mut words = words.split_whitespace();
        faces += 1;
        keep(faces, [0; 3].map(|_| points[corner(words.next().expect("corner")) - 1]))
    });
    let body: String = kept.flat_map(|line| [line, "\n"]).collect();
    std::fs::write(file, body).expect("body");
    bench.stages(SKIRT_STAGES);
    bench
}

fn codes(bench: &Bench) -> Vec<String> {
    let findings = bench.record()["findings"].as_array().cloned().unwrap_or_default();
    findings.iter().filter_map(|f| f["code"].as_str().map(str::to_owned)).collect()
}

#[test]
fn a_body_that_ends_at_the_waist_is_refused_in_words() {
    // The waist lies at 1.05 m.
    for height in [1.0, 1.036, 1.04, 1.044, 1.048, 1.049, 1.06, 1.3] {
        let above = project(|_, face| face.iter().all(|p| p[1] >= height));
        let said = above.run(&[]);
        assert_eq!(said.code, if height < 1.03 { 0 } else { 2 }, "above {height}: {said:?}");
        if height >= 1.03 {
            assert_eq!(codes(&above).last().map(String::as_str), Some("attach-target-empty"), "above {height}");
        }
    }
    for height in [1.04, 1.052, 1.056] {
        let below = project(|_, face| face.iter().all(|p| p[1] <= height));
        assert_eq!(below.run(&[]).code, 2, "below {height}: {:?}", codes(&below));
        assert_eq!(codes(&below).last().map(String::as_str), Some("attach-target-empty"), "below {height}");
    }
}

#[test]
fn torn_bodies_never_end_in_an_internal_error() {
    // Every n-th face goes, or the faces of a side: what is left is sewn on or refused.
    for n in [2, 3, 7, 50] {
        let torn = project(|k, _| k % n != 0);
        let code = torn.run(&[]).code;
        assert!(matches!(code, 0 | 2 | 3), "every {n}th face: exit {code}, {:?}", codes(&torn));
    }
    for (axis, limit) in [(0, 0.0), (0, -0.1), (2, 0.0), (2, 0.08)] {
        let half = project(|_, face| face.iter().all(|p| p[axis] >= limit));
        let code = half.run(&[]).code;
        assert!(matches!(code, 0 | 2 | 3), "axis {axis} from {limit}: exit {code}, {:?}", codes(&half));
    }
}

#[test]
fn check_reads_the_files_and_tells_all_that_is_wrong() {
    let bench = project(|_, _| true);
    assert_eq!(bench.check(&[]).code, 0, "{:?}", bench.check(&[]));
    let folder = bench.pipeline_file().parent().expect("folder").to_path_buf();
    let edit = |name: &str, change: &dyn Fn(&str) -> String| {
        let path = folder.join(name);
        let text = std::fs::read_to_string(&path).expect("text");
        std::fs::write(&path, change(&text)).expect("text");
    };
    let codes = |bench: &Bench| bench.findings(&[]).into_iter().map(|f| f.0).collect::<Vec<_>>();
    // A fabric with a wrong unit, then a size that is not there as well: both are told at once.
    edit("fabric.toml", &|t| t.replacen("g/m2", "g", 1));
    assert_eq!(bench.check(&[]).code, 3);
    assert!(codes(&bench).contains(&"fabric-value".to_owned()), "{:?}", codes(&bench));
    let wrong_size = SKIRT_STAGES.replace("\"38\"", "\"52\"");
    bench.stages(&wrong_size);
    let found = codes(&bench);
    assert!(["size-not-found", "fabric-value"].iter().all(|c| found.iter().any(|f| f == c)), "{found:?}");
    bench.stages(SKIRT_STAGES);
    let samples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/fabrics/wool-suiting.toml");
    std::fs::copy(samples, folder.join("fabric.toml")).expect("fabric");
    let millimetres = |line: &str| {
        let numbers =
            line.split_whitespace().skip(1).map(|n| format!(" {:.3}", 1e3 * n.parse::<f64>().expect("number")));
        format!("v{}", numbers.collect::<String>())
    };
    edit("body.obj", &|t| {
        t.lines()
            .flat_map(|l| [if l.starts_with("v ") { millimetres(l) } else { l.to_owned() }, "\n".to_owned()])
            .collect()
    });
    let found = codes(&bench);
    assert!(found.iter().any(|c| c.starts_with("body-")), "{found:?}");
    assert_ne!(bench.check(&[]).code, 0);
    std::fs::copy(
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/bodies/size-38.obj"),
        folder.join("body.obj"),
    )
    .expect("body");
    edit("skirt.sewing.toml", &|t| {
        t.replacen("[[place]]", "[[copy]]\npiece = \"FRONT\"\nname = \"SECOND\"\n[[place]]", 1)
    });
    let found = codes(&bench);
    assert!(found.contains(&"piece-not-placed".to_owned()), "{found:?}");
}

#[test]
fn hopeless_work_is_refused_with_its_forecast() {
    let bench = project(|_, _| true);
    let said = bench.run(&["--max-memory", "15"]);
    assert_eq!(said.code, 5, "{said:?}");
    assert!(said.err.contains("over-limit") && said.err.contains("foreseen"), "{}", said.err);
    assert!(!bench.out().exists(), "nothing was begun");
    let fine = SKIRT_STAGES.replace("with.triangles = 150", "with.edge_length = \"1 mm\"");
    bench.stages(&format!("{fine}[[stage]]\nuse = \"drape\"\n"));
    let said = bench.run(&[]);
    assert_eq!(said.code, 5, "{said:?}");
    assert!(said.err.contains("--max-seconds"), "{}", said.err);
    let plan = |more: &[&str]| {
        let file = bench.pipeline_file();
        let words = [&["plan", file.to_str().expect("text"), "--json"], more].concat();
        support::bench::command(words.into_iter().map(Into::into).collect())
    };
    let told = plan(&[]);
    assert!(told.code == 5 && told.err.contains("over-limit"), "{told:?}");
    let plan_of = |said: &str| serde_json::from_str::<serde_json::Value>(said).expect("the plan is told all the same");
    assert!(plan_of(&told.out)["expected"]["seconds"].as_f64() > Some(500.0), "{told:?}");
    let most = ["--max-seconds", "1e6", "--max-memory"];
    assert_eq!(plan(&[&most[..], &["1e6"]].concat()).code, 0, "it may be allowed");
    let told = plan(&[&most[..], &["1000"]].concat());
    assert!(told.code == 5 && told.err.contains("--max-memory"), "{told:?}");
}

#[test]
fn values_of_any_size_are_refused_in_short_words() {
    let bench = project(|_, _| true);
    let messages = || {
        let findings = bench.record()["findings"].as_array().cloned().unwrap_or_default();
        findings.iter().filter_map(|f| f["message"].as_str().map(str::to_owned)).collect::<Vec<_>>()
    };
    for value in ["-1 mm", "1e300 mm", "99999999999 m"] {
        let said = bench.run(&["--force", "--set", &format!("stitch.clearance={value}")]);
        assert_eq!((said.code, codes(&bench).last().map(String::as_str)), (2, Some("setting-out-of-range")), "{value}");
    }
    let girth = ["waist_girth = \"700 mm\"", "waist_girth = \"1e99 mm\""];
    for (file, [from, to]) in [("body.toml", girth), ("body.obj", ["v ", "v 1e200 "])] {
        let path = bench.pipeline_file().with_file_name(file);
        let sound = std::fs::read_to_string(&path).expect("file");
        std::fs::write(&path, sound.replacen(from, to, 1)).expect("file");
        assert!(bench.run(&["--force"]).code > 1, "{file}");
        assert!(messages().iter().any(|m| m.contains("1.000e")), "{file}: {:?}", messages());
        assert!(messages().iter().all(|m| m.len() < 300), "{file}: {:?}", messages());
        std::fs::write(&path, sound).expect("file");
    }
}

/// Rust ends a program that gets no memory without a word, so what does not fit is refused before.
#[cfg(target_os = "linux")]
#[test]
fn a_file_that_needs_more_memory_than_there_is_is_refused_with_a_record() {
    let bench = project(|_, _| true);
    let file = bench.pipeline_file().with_file_name("body.obj");
    let mut body = std::fs::read_to_string(&file).expect("body");
    body.extend(std::iter::repeat_n("v 0.123456 0.123456 0.123456\n", 900_000));
    std::fs::write(&file, body).expect("body");
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", "ulimit -v 300000; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_toile"), "run"]);
    let ended = shell.arg(bench.pipeline_file()).arg("--out").arg(bench.out()).output().expect("shell");
    let said = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(5), "{said}");
    assert!(said.contains("over-limit") && said.contains("MB of memory"), "{said}");
    assert_eq!(bench.record()["exit_code"], 5);
    assert_eq!(bench.left(), ["run.json"]);
}
