//! The worth of each mechanism and each tuned number of the solver. A suite of cases runs with one mechanism switched
//! off, or one number scaled, and is compared with the same cases run plainly.
//!
//! ```text
//! cargo test --release --features experiments --test ablation -- [--projects FOLDER]… [--numbers] [--only NAME]…
//!     [--cases WORD] [--harnesses] [--limit SECONDS] [--jobs N]
//! ```
//!
//! The samples are always in the suite. `--projects` adds every sub-folder that holds a `pipeline.toml` (garments,
//! scenes of the comparison). `--numbers` also halves and doubles every tuned number; otherwise only mechanisms are
//! switched off. `--only` takes some mechanisms or numbers, `--cases` the cases whose name holds the word.
//! `--harnesses` also runs the quick cases of the physics and the stability harness. `--limit` ends a case after this
//! many seconds (120). `--jobs` runs cases side by side (1).
//!
//! The table tells failures beside those of the plain run, and medians of ratios to the plain run: CPU time of sewing,
//! of draping, and elastic energy. Ratios of one run on one machine are comparable; times of different runs are not.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod options;
mod suite;

use options::Options;
use suite::{Case, Figures};

/// A change of the solver, and the text of its experiment file.
struct Variant {
    name: String,
    experiment: String,
}

fn variants(options: &Options) -> Vec<Variant> {
    let off = toile_stages::experiment::mechanism_names()
        .into_iter()
        .map(|name| Variant { name: format!("without {name}"), experiment: format!("off = [\"{name}\"]\n") });
    let scaled = toile_stages::experiment::number_names().into_iter().flat_map(|name| {
        [0.5, 2.0].map(|factor| Variant {
            name: format!("{name} × {factor}"),
            experiment: format!("[scale]\n{name} = {factor:?}\n"),
        })
    });
    let all = off.chain(scaled.filter(|_| options.numbers));
    all.filter(|v| options.only.is_empty() || options.only.iter().any(|o| v.experiment.contains(o.as_str()))).collect()
}

fn median(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).map_or("–".into(), |m| format!("{m:.2}"))
}

fn ratios(plain: &[Figures], other: &[Figures], of: impl Fn(&Figures) -> Option<f64>) -> String {
    let pairs = plain.iter().zip(other).filter_map(|(p, o)| Some((of(p)?, of(o)?)));
    median(pairs.filter(|(p, _)| *p > 0.0).map(|(p, o)| o / p).collect())
}

fn row(name: &str, cases: &[Case], plain: &[Figures], other: &[Figures]) {
    let worse = cases.iter().zip(plain).zip(other).filter(|((_, p), o)| p.passed && !o.passed);
    let worse: Vec<&str> = worse.map(|((c, _), _)| c.name.as_str()).collect();
    let better = plain.iter().zip(other).filter(|(p, o)| !p.passed && o.passed).count();
    let [sewing, draping] = [ratios(plain, other, |f| f.sewing), ratios(plain, other, |f| f.draping)];
    let energy = ratios(plain, other, |f| f.energy);
    println!("| {name} | {} | {better} | {sewing} | {draping} | {energy} |", worse.join(", "));
}

fn main() -> std::process::ExitCode {
    let options = match Options::read(std::env::args().skip(1)) {
        Ok(options) => options,
        Err(what) => {
            eprintln!("error: {what}");
            return std::process::ExitCode::from(2);
        }
    };
    let cases = suite::cases(&options);
    let run = |experiment: &str| suite::run(&cases, experiment, &options);
    let plain = run("");
    for (case, f) in cases.iter().zip(&plain) {
        let seconds = f.sewing.unwrap_or(0.0) + f.draping.unwrap_or(0.0);
        println!("{}: {}, {seconds:.1} CPU s", case.name, if f.passed { "passed" } else { "failed" });
    }
    println!("\n| variant | fails | passes instead | sewing | draping | energy |\n|---|---|---|---|---|---|");
    for v in variants(&options) {
        row(&v.name, &cases, &plain, &run(&v.experiment));
    }
    std::process::ExitCode::SUCCESS
}
