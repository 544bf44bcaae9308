//! Reads many damaged copies of files: `mutants COUNT [--seed N] [--save FOLDER] FILE…`. Exit code 1 when any copy
//! panics a reader, takes too long, is refused without a word, or is read with something lost.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../tests/mutants/mod.rs"]
mod mutants;

use mutants::{Dice, fault, mutant};
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut option = |name: &str| {
        let at = arguments.iter().position(|a| a == name)?;
        arguments.remove(at);
        (at < arguments.len()).then(|| arguments.remove(at))
    };
    let seed = option("--seed").and_then(|s| s.parse().ok()).unwrap_or(1_u64);
    let save = option("--save").map(std::path::PathBuf::from);
    let count: usize = arguments.first().and_then(|a| a.parse().ok()).unwrap_or(0);
    let files: Vec<(String, Vec<u8>)> =
        arguments.iter().skip(1).filter_map(|f| Some((f.clone(), std::fs::read(f).ok()?))).collect();
    if count == 0 || files.is_empty() {
        eprintln!("usage: mutants COUNT [--seed N] [--save FOLDER] FILE…");
        return ExitCode::from(2);
    }
    // A panic is told once here, with its place.
    let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut wrong = 0_usize;
    for i in 0..count {
        let (name, bytes) = &files[i % files.len()];
        let mut damaged = mutant(bytes, &mut dice);
        if dice.below(4) == 0 {
            damaged = mutant(&damaged, &mut dice);
        }
        if let Some(what) = fault(name, &damaged) {
            wrong += 1;
            println!("{name}, mutant {i}: {what}");
            let ending = name.rsplit('.').next().unwrap_or("bin");
            if let Some(Err(error)) = save.as_ref().map(|s| std::fs::write(s.join(format!("{i}.{ending}")), &damaged)) {
                eprintln!("{error}");
            }
        }
    }
    println!("{count} mutants of {} file(s), {wrong} fault(s)", files.len());
    if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) }
}
