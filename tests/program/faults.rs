//! Signals: what is left on disk, how soon the program is gone. The program is this test itself, started again.
#![cfg(unix)]

use crate::support;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use support::bench::{Bench, list};

const ARGUMENTS: &str = "TOILE_TEST_ARGUMENTS";

/// Not a test by itself: the command line with the stages for tests, in a process of its own.
#[test]
fn child() {
    let Ok(arguments) = std::env::var(ARGUMENTS) else { return };
    toile::engine::quiet_panics();
    let stop = toile::engine::Stop::new();
    stop.listen();
    let arguments = arguments.split('\n').map(std::ffi::OsString::from);
    let registry = support::stages::registry();
    let code = toile::cli::run_from(arguments, registry, &stop, &mut std::io::stdout(), &mut std::io::stderr());
    std::process::exit(i32::from(code));
}

fn start(bench: &Bench, more: &[&str]) -> Child {
    let (file, out) = (bench.pipeline_file(), bench.out());
    let first = ["toile", "run", file.to_str().expect("text"), "--out", out.to_str().expect("text")];
    let arguments = [&first[..], more].concat().join("\n");
    let mut command = Command::new(std::env::current_exe().expect("this test"));
    command.args(["--exact", "faults::child", "--nocapture"]).env(ARGUMENTS, arguments);
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("child")
}

fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status().expect("kill");
    assert!(status.success());
}

/// Waits for the file that shows that the chain has come to its slow stage.
fn wait_for_work(bench: &Bench) {
    let until = Instant::now() + Duration::from_secs(20);
    let is_staged = |name: &String| name.ends_with(".tmp-toile") && name != ".lock.tmp-toile";
    while !list(&bench.out()).iter().any(is_staged) {
        assert!(Instant::now() < until, "the run did not begin: {:?}", list(&bench.out()));
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(50));
}

fn slow(deaf: bool) -> String {
    let write = "[[stage]]\nuse = \"test-write\"\nwith = { file = \"{out}/a.txt\", text = \"whole\" }\n";
    format!("{write}[[stage]]\nuse = \"test-slow\"\nwith = {{ ms = 60000, deaf = {deaf} }}\n")
}

fn stopped_by(name: &str, deaf: bool) {
    let bench = Bench::new();
    bench.stages(&slow(deaf));
    let mut child = start(&bench, &[]);
    wait_for_work(&bench);
    let begun = Instant::now();
    signal(&child, name);
    let status = child.wait().expect("child");
    let took = begun.elapsed();
    assert_eq!(status.code(), Some(130), "{name} {status:?}");
    assert!(took < Duration::from_millis(1500), "{name}: gone after {took:?}");
    assert_eq!(bench.left(), ["run.json"], "{name}");
    assert_eq!(bench.record()["status"], "stopped");
}

#[test]
fn a_stage_that_listens_stops_at_once() {
    stopped_by("-INT", false);
    stopped_by("-TERM", false);
}

#[test]
fn a_stage_that_does_not_listen_is_left_behind() {
    stopped_by("-INT", true);
}

#[test]
fn a_killed_run_leaves_no_half_file_and_the_next_run_is_clean() {
    let bench = Bench::new();
    bench.stages(&slow(true));
    let mut child = start(&bench, &[]);
    wait_for_work(&bench);
    signal(&child, "-KILL");
    child.wait().expect("child");
    assert!(bench.left().iter().all(|n| n.ends_with(".tmp-toile")), "{:?}", bench.left());
    let quick = slow(false).replace("60000", "1");
    assert_eq!(bench.stages(&quick).run(&[]).code, 0);
    assert_eq!(bench.left(), ["a.txt", "run.json"]);
}

#[test]
fn kills_at_many_moments_leave_whole_files_only() {
    let text = "x".repeat(200_000);
    let write = |n: u32| {
        format!("[[stage]]\nuse = \"test-write\"\nwith = {{ file = \"{{out}}/{n}.txt\", text = \"{text}\" }}\n")
    };
    let bench = Bench::new();
    bench.stages(&(0..4).map(write).collect::<String>());
    for moment in 0..12_u64 {
        let mut child = start(&bench, &["--force"]);
        std::thread::sleep(Duration::from_millis(moment * 4));
        drop(child.kill());
        child.wait().expect("child");
        for name in bench.left().iter().filter(|n| n.ends_with(".txt")) {
            assert_eq!(bench.output(name).map(|t| t.len()), Some(text.len()), "{name} is half");
        }
    }
    assert_eq!(bench.run(&["--force"]).code, 0);
    assert_eq!(bench.left(), ["0.txt", "1.txt", "2.txt", "3.txt", "run.json"]);
}

/// A run was killed while its outputs went or took their names: the folder holds a part of them, and no record.
#[test]
fn what_a_killed_run_left_by_name_is_gone_after_the_next() {
    let write = |name: &str| {
        format!("[[stage]]\nuse = \"test-write\"\nwith = {{ file = \"{{out}}/{name}.txt\", text = \"x\" }}\n")
    };
    let bench = Bench::new();
    assert_eq!(bench.stages(&["a", "b", "c"].map(write).concat()).run(&[]).code, 0);
    let (record, pending) = (bench.out().join("run.json"), bench.out().join(".outputs.tmp-toile"));
    std::fs::rename(record, &pending).expect("file");
    std::fs::remove_file(bench.out().join("a.txt")).expect("file");
    std::fs::write(bench.out().join("c.txt"), "mine").expect("file");
    let said = bench.stages(&write("d")).run(&[]);
    assert_eq!(said.code, 2, "{said:?}");
    assert_eq!(bench.left(), [".outputs.tmp-toile", "b.txt", "c.txt"]);
    assert_eq!(bench.run(&["--force"]).code, 0);
    assert_eq!(bench.left(), ["c.txt", "d.txt", "run.json"]);
}

#[test]
fn four_at_once_do_not_spoil_each_other() {
    let bench = Bench::new();
    bench.stages(&slow(false).replace("60000", "100"));
    let mut children: Vec<Child> = (0..4).map(|_| start(&bench, &["--force"])).collect();
    let codes: Vec<Option<i32>> = children.iter_mut().map(|c| c.wait().expect("child").code()).collect();
    assert!(codes.contains(&Some(0)), "{codes:?}");
    assert!(codes.iter().all(|c| matches!(c, Some(0 | 2))), "{codes:?}");
    assert_eq!(bench.left(), ["a.txt", "run.json"]);
}
