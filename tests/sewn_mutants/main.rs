//! Damaged copies of all files of a sewn garment, run through the whole program: a good garment or a refusal in words,
//! nothing half, nothing of another run beside it, never a panic.
//!
//! Most copies are only a little wrong, so that they get as far as `stitch`. A campaign is longer and begins elsewhere:
//!
//! ```text
//! TOILE_MUTANTS=100000 TOILE_DICE=7 cargo test --release --test sewn_mutants -- --nocapture
//! ```
//!
//! `TOILE_KEEP=FOLDER` keeps the project of every fault, `TOILE_PROGRAM=PATH` tries another build of the program.
#![cfg(unix)]
#![allow(clippy::print_stdout, clippy::expect_used, clippy::unwrap_used)]

#[path = "../../formats/tests/mutants/damage.rs"]
mod damage;
mod little;
mod projects;
mod verdict;

use damage::{Dice, mutant};
use little::a_little_wrong;
use projects::Project;
use std::path::{Path, PathBuf};
use std::time::Instant;
use verdict::{Ended, Tally, run};

/// Copies that are tried with all tests.
const FEW: usize = 150;
/// How often a campaign tells how far it is, s.
const TOLD_EVERY: u64 = 60;

fn number(name: &str, default: usize) -> usize {
    std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
}

/// A damaged copy: three of four are a little wrong, the others are anything.
fn damaged(bytes: &[u8], dice: &mut Dice) -> Vec<u8> {
    if dice.below(4) > 0 { a_little_wrong(bytes, dice) } else { mutant(bytes, dice) }
}

fn keep(project: &Path, index: usize) {
    let Some(folder) = std::env::var_os("TOILE_KEEP").map(PathBuf::from) else { return };
    let to = folder.join(format!("mutant-{index}"));
    std::fs::create_dir_all(&to).expect("folder");
    for entry in std::fs::read_dir(project).expect("project").flatten() {
        if entry.path().is_file() {
            std::fs::copy(entry.path(), to.join(entry.file_name())).expect("copy");
        }
    }
}

#[test]
fn what_comes_out_of_damaged_files_is_whole_or_refused_in_words() {
    let program = std::env::var_os("TOILE_PROGRAM").unwrap_or_else(|| env!("CARGO_BIN_EXE_toile").into());
    let (program, count) = (PathBuf::from(program), number("TOILE_MUTANTS", FEW));
    let mut dice = Dice((number("TOILE_DICE", 1) as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let projects = Project::all();
    for project in &projects {
        let ended = run(&program, project.folder());
        assert_eq!(ended.exit, 0, "{} undamaged: {ended:?}", project.name);
        assert!(ended.reached_stitch && ended.fault.is_none(), "{} undamaged: {ended:?}", project.name);
    }
    let (mut tally, mut told) = (Tally::default(), Instant::now());
    for index in 0..count {
        let project = &projects[dice.below(projects.len())];
        for _ in 0..=dice.below(5) / 4 {
            project.change(&mut dice, damaged);
        }
        let ended = run(&program, project.folder());
        if let Ended { fault: Some(fault), exit, .. } = &ended {
            println!("{} mutant {index}, exit {exit}: {fault}", project.name);
            keep(project.folder(), index);
        }
        tally.add(&ended);
        project.restore();
        if told.elapsed().as_secs() >= TOLD_EVERY {
            println!("{tally}");
            told = Instant::now();
        }
    }
    println!("{tally}");
    assert!(tally.reached_stitch * 3 > count, "too few copies reach `stitch`: {tally}");
    assert_eq!(tally.faults, 0, "{tally}");
}
