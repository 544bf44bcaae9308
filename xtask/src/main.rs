//! The daily commands of the repository: `cargo xtask COMMAND [MORE ARGUMENTS]`.

#![allow(clippy::print_stdout, clippy::print_stderr)]

mod book;
mod dependencies;
mod garments;
mod licences;
mod notices;
mod run;

use run::{Done, cargo};
use std::process::ExitCode;

/// One command: its name, what it does, and its work.
type Command = (&'static str, &'static str, fn(&[String]) -> Done);

const COMMANDS: [Command; 15] = [
    ("fmt", "writes all sources in the one form", |more| cargo(&["fmt", "--all"], more)),
    ("lint", "clippy over all packages, warnings fail", lint),
    ("doc", "the documentation of all packages, warnings fail", doc),
    ("test", "all tests", test),
    ("left-out", "the tests of a build without the effects that may be left out", left_out),
    ("golden", "the golden cases", |more| cargo(&["test", "--release", "--locked", "--test", "golden"], more)),
    ("bless", "writes schemas, the tuning table and the book's reference anew", bless),
    ("validate", "all physics cases, as a table", |more| harness("validation", more)),
    ("stability", "all hard cases, as a table", |more| harness("stability", more)),
    ("book", "builds the book with the pinned mdBook, warnings fail", book::build),
    ("garments", "runs every sample garment and draws its picture for the book", garments::draw),
    ("deny", "licences, bans and sources of all dependencies, by deny.toml", licences::check),
    ("notices", "third-party notices of the program, into target/THIRD-PARTY.md", notices::write),
    ("fuzz", "type-checks the fuzz targets", fuzz),
    ("ci", "all that must hold before a change is taken", |more| run::program("bash", &[".ci/run"], more, &[])),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let found = arguments.first().and_then(|name| COMMANDS.iter().find(|(n, ..)| n == name));
    let Some((_, _, work)) = found else {
        println!("cargo xtask COMMAND [MORE ARGUMENTS]\n");
        COMMANDS.iter().for_each(|(name, about, _)| println!("  {name:<10} {about}"));
        return if arguments.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(2) };
    };
    match work(&arguments[1..]) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn lint(more: &[String]) -> Done {
    let words = ["clippy", "--release", "--locked", "--workspace", "--all-targets"];
    cargo(&words, &[more, &["--".to_owned(), "-D".to_owned(), "warnings".to_owned()]].concat())
}

fn doc(more: &[String]) -> Done {
    let words = ["doc", "--release", "--locked", "--no-deps", "--workspace"];
    run::program("cargo", &words, more, &[("RUSTDOCFLAGS", "-D warnings")])
}

fn test(more: &[String]) -> Done {
    cargo(&["test", "--release", "--locked", "--workspace"], more)
}

/// Hardly anything is optimised, for compiling takes most of the time of one short test.
fn left_out(more: &[String]) -> Done {
    let quick =
        ["toile.opt-level=0", "toile-stages.opt-level=0", "toile-cloth.opt-level=1", "toile-cloth.codegen-units=16"];
    let settings = quick.map(|setting| format!("profile.release.package.{setting}"));
    let words = ["test", "--release", "--locked", "--no-default-features", "--test", "left_out"];
    let configs = settings.iter().flat_map(|setting| ["--config", setting]);
    cargo(&words.into_iter().chain(configs).collect::<Vec<_>>(), more)
}

fn bless(more: &[String]) -> Done {
    let tuning = ["test", "--release", "--locked", "--package", "toile-cloth", "--lib", "the_tuning_page"];
    let pages = ["test", "--release", "--locked", "--test", "pipelines", "--test", "book"];
    run::program("cargo", &tuning, more, &[("TOILE_BLESS", "1")])?;
    run::program("cargo", &pages, more, &[("TOILE_BLESS", "1")])
}

fn harness(name: &str, more: &[String]) -> Done {
    let words = ["test", "--release", "--locked", "--package", "toile", "--test", name, "--", "--all"];
    cargo(&words, more)
}

/// The targets lie outside the workspace. They are checked with its versions and its compiled dependencies, and without
/// the C++ part of libFuzzer, which only a fuzzing run needs.
fn fuzz(more: &[String]) -> Done {
    let lock = "fuzz/Cargo.lock";
    std::fs::copy("Cargo.lock", lock).map_err(|e| format!("{lock}: {e}"))?;
    let words = ["check", "--release", "--manifest-path", "fuzz/Cargo.toml", "--target-dir", "target"];
    let settings = [("CUSTOM_LIBFUZZER_PATH", "target/libfuzzer.a"), ("CARGO_PROFILE_RELEASE_DEBUG", "false")];
    run::program("cargo", &words, more, &settings)
}
