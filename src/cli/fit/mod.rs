//! `toile fit`: a garment for another body.

mod args;

pub use args::FitArgs;

use super::console::Console;
use crate::codes::{PATH_REFUSED, SET_FORM, UNKNOWN_VALUE, WRITE_FAILED, WRONG_VALUE};
use crate::engine::{Exit, RECORD_NAME, Stop, clean};
use crate::fit::{self, ALL_SIZES_NAME, ALL_SIZES_RULES_NAME, Fitted, Level, OWN_NAME, Order, PIPELINE_NAME};
use crate::halt::Halt;
use crate::new::Body;
use crate::pipeline::remedy;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use toile_garment::Diagnostic;
use toile_garment::units::Length;
use toile_stage_api::Registry;
use toile_stages::transfer::LEVELS;
use toml::de::ValueDeserializer;

/// Names of the results beside the pattern.
const JSON_NAME: &str = "fit.json";
const PAGE_NAME: &str = "fit.html";
/// Bound of the ease, where none is asked for.
const WITHIN: &str = "5 mm";
/// Length of cloth over which a change is averaged, where none is asked for: the map from body to body is not smoother.
const SMOOTH: &str = "40 mm";

pub(super) fn run(args: &FitArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    match fitted(args, registry, stop, console) {
        Ok(exit) => exit,
        Err(halt) => console.halted(&halt),
    }
}

fn fitted(args: &FitArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Result<Exit, Halt> {
    let order = order(args).map_err(Halt::usage)?;
    check_locks(&order, registry).map_err(Halt::usage)?;
    if let Body::Size(_) = order.body {
        // A size that is not there is told before any work.
        order.body.open().map_err(|findings| Halt::new(findings, Exit::Usage))?;
    }
    check_folder(&args.out, args.force).map_err(Halt::usage)?;
    let fitted = fit::fit(&order, registry, stop, |round, levels| {
        if !args.quiet {
            console.say(&told(round, levels));
        }
    })?;
    let json = fit::json(&fitted, &order);
    let text = serde_json::to_string_pretty(&json).unwrap_or_default() + "\n";
    let files = [(JSON_NAME, text), (PAGE_NAME, fit::html(&fitted, &order, args.language.language()))];
    for (name, text) in &files {
        fit::put(&args.out.join(name), text.as_bytes())?;
    }
    console.findings(&fitted.findings, None);
    if args.json {
        console.json(&json);
    } else {
        console.result(&crate::render::safe(&fit::text(&fitted)));
    }
    Ok(ended(args, &fitted, console))
}

/// Names what there is to look at.
fn ended(args: &FitArgs, fitted: &Fitted, console: &mut Console<'_>) -> Exit {
    let [page, pipeline] = [PAGE_NAME, PIPELINE_NAME].map(|name| clean(&args.out.join(name)));
    console.say(&format!("look at {page}\nagain: toile run {pipeline}\n"));
    if fitted.passed { Exit::Good } else { Exit::Gate }
}

fn told(round: usize, levels: &[Level]) -> String {
    let level = |l: &Level| match round {
        0 => format!("{} {:.1} mm", l.name, 1e3 * l.own_ease),
        _ => format!("{} {:.1} of {:.1} mm", l.name, 1e3 * l.ease, 1e3 * l.asked),
    };
    let words: Vec<String> = levels.iter().map(level).collect();
    let which = if round == 0 { "ease on its own body".to_owned() } else { format!("round {round}: ease") };
    format!("{which}: {}\n", words.join(", "))
}

fn order(args: &FitArgs) -> Result<Order, Diagnostic> {
    let mut ease = BTreeMap::new();
    for text in &args.ease {
        let Some((name, length)) = text.split_once('=') else {
            let message = format!("`--ease {text}` is not HEIGHT=LENGTH");
            return Err(Diagnostic::error(SET_FORM, message).hint("e.g. --ease waist=\"30 mm\""));
        };
        let name = name.trim();
        if !LEVELS.contains(&name) {
            let message = format!("`{name}` is no height at which ease is measured");
            return Err(Diagnostic::error(UNKNOWN_VALUE, message).hint(remedy(name, LEVELS)));
        }
        if ease.insert(name.to_owned(), length_of(length.trim().trim_matches('"'), "--ease")?).is_some() {
            let message = format!("--ease names `{name}` twice");
            return Err(Diagnostic::error(WRONG_VALUE, message).hint("give one of them"));
        }
    }
    Ok(Order {
        request: args.pipeline.request(),
        out: args.out.clone(),
        body: Body::of(&args.body),
        ease,
        within: within(args)?,
        rounds: args.rounds,
        flatten: flatten_params(args),
        threads: super::run::pool(args.threads),
    })
}

/// Words that are no locks are told before any work.
fn check_locks(order: &Order, registry: &Registry) -> Result<(), Diagnostic> {
    let told = |e: toml::de::Error| {
        let finding = Diagnostic::error(UNKNOWN_VALUE, format!("--lock, --smooth or --symmetry: {}", e.message()));
        finding.hint("locks are seams, grain, straight, right-angles, pleats, darts; a length reads \"40 mm\"")
    };
    let Some(stage) = registry.get("flatten") else { return Ok(()) };
    let params = ValueDeserializer::parse(&order.flatten).map_err(told)?;
    stage.configure(params).map(drop).map_err(told)
}

/// The parameters of `flatten`, as a pipeline writes them. Curvature of the moved garment is not told: whether its pattern
/// sits on the body is shown by the drape that follows.
fn flatten_params(args: &FitArgs) -> String {
    let quoted = |t: &str| toml::Value::String(t.to_owned()).to_string();
    let smooth = quoted(args.smooth.as_deref().unwrap_or(SMOOTH));
    let locks: Vec<String> = args.lock.iter().filter(|k| *k != "none").map(|k| quoted(k)).collect();
    let lock = if args.lock.is_empty() { String::new() } else { format!(", lock = [{}]", locks.join(", ")) };
    let symmetry = quoted(&args.symmetry);
    format!("{{ smooth = {smooth}, symmetry = {symmetry}, strain_limit = \"100 %\", let_go = false{lock} }}")
}

fn within(args: &FitArgs) -> Result<f64, Diagnostic> {
    let within = length_of(args.within.as_deref().unwrap_or(WITHIN), "--within")?;
    let wrong = || Diagnostic::error(WRONG_VALUE, "--within must be larger than 0 mm").hint("write e.g. \"5 mm\"");
    if within > 0.0 { Ok(within) } else { Err(wrong()) }
}

fn length_of(text: &str, option: &str) -> Result<f64, Diagnostic> {
    let length: Result<Length, _> = text.parse();
    length
        .map(|l| l.0)
        .map_err(|e| Diagnostic::error(WRONG_VALUE, format!("{option}: {e}")).hint("write e.g. \"30 mm\""))
}

/// A folder with other things in it is not touched.
fn check_folder(out: &Path, force: bool) -> Result<(), Diagnostic> {
    let refused = |why: String, hint: &str| Err(Diagnostic::error(PATH_REFUSED, why).hint(hint));
    // One that failed or was stopped has no result, and may be done again without a word.
    let is_done = out.join(JSON_NAME).is_file();
    let is_ours = is_done || out.join(OWN_NAME).join(RECORD_NAME).is_file();
    let has_files = std::fs::read_dir(out).is_ok_and(|mut entries| entries.next().is_some());
    match (has_files, is_ours, force || !is_done) {
        (true, true, false) => refused(
            format!("`{}` holds a fitting already", clean(out)),
            "replace it with --force, or name another folder",
        ),
        (true, false, _) => {
            refused(format!("`{}` holds files that are no fitting", clean(out)), "name a folder that is empty or new")
        }
        _ => std::fs::create_dir_all(out)
            .map_err(|e| Diagnostic::error(WRITE_FAILED, format!("cannot make the folder `{}`: {e}", clean(out)))),
    }?;
    // What an earlier fitting found must not lie beside a new one that fails.
    for name in [JSON_NAME, PAGE_NAME, ALL_SIZES_NAME, ALL_SIZES_RULES_NAME] {
        drop(std::fs::remove_file(out.join(name)));
    }
    Ok(())
}
