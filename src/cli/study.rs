//! `toile study`: what accuracy costs in time, for one garment.

use super::args::StudyArgs;
use super::bench::{Chain, check_folder, tell, write_files};
use super::codes;
use super::console::Console;
use crate::codes::{UNKNOWN_VALUE, WRONG_VALUE};
use crate::engine::{Exit, Stop};
use crate::halt::Halt;
use crate::progress::Voice;
use crate::study::choose::millimetres;
use crate::study::report::Head;
use crate::study::{Axes, Bench, Ran, Setting, Study, chart, finest, page, pictures, report, table};
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toile_formats::report::Language;
use toile_formats::report::accuracy::Origin;
use toile_garment::Diagnostic;
use toile_stage_api::{Knob, Registry};

/// Names of the results.
const FILES: [&str; 4] = ["study.json", "study.svg", "study.html", "study.md"];

pub(super) fn run(args: &StudyArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    match study(args, registry, stop, console) {
        Ok(exit) => exit,
        Err(halt) => {
            let exit = console.halted(&halt);
            if exit == Exit::Stopped {
                console.say("stopped; what is through is kept, and the same command goes on from there\n");
            }
            exit
        }
    }
}

fn study(args: &StudyArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Result<Exit, Halt> {
    let axes = axes(args).map_err(Halt::usage)?;
    let wanted = length(&args.want, "--want").map_err(Halt::usage)?;
    let chain = Chain::look(&args.pipeline, registry, stop)?;
    let threads = super::run::pool(args.threads);
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("out").join(format!("{}-study", chain.file_name)));
    check_folder(&out, (FILES[0], "toile_study", "pipeline"), &chain.name).map_err(Halt::usage)?;
    let bench = Bench {
        request: args.pipeline.request(),
        out: out.clone(),
        threads,
        force: args.force,
        voice: if args.quiet { Voice::Quiet } else { Voice::Auto },
        stop,
    };
    let mut runs =
        Runs { bench: &bench, budget: args.budget.unwrap_or(f64::INFINITY), ran: Vec::new(), left_out: Vec::new() };
    runs.all(&axes.settings(chain.has_mesh_stage), registry, args.quiet, console)?;
    if args.starts > 0 {
        runs.shaken(args.starts, registry, args.quiet, console)?;
    }
    runs.carried(registry, args.quiet, console)?;
    let head = Head { pipeline: chain.name, threads, wanted_mm: wanted, left_out: runs.left_out };
    let pictures = pictures::of_presets(&runs.ran);
    let varied = |stage: &str| registry.get(stage).map_or_else(Vec::new, |s| keys(s.knobs()));
    let of = finest(&runs.ran).and_then(|k| runs.ran[k].garment.as_ref());
    let made_of = of.map(|garment| Origin::of(garment, varied)).unwrap_or_default();
    let Some(mut study) = report(head, runs.ran) else {
        let message = "no setting gave a drape; nothing can be compared".to_owned();
        let finding =
            Diagnostic::error(codes::STUDY_EMPTY, message).hint("`toile run` with the same pipeline says why");
        return Err(Halt { findings: vec![finding], source: None, exit: Exit::Unstable });
    };
    study.shown = Some(chart::accuracy(&study, made_of));
    write(&study, &pictures, &out, args.language.language())?;
    let said = if args.json { json(&study) } else { table::text(&study) };
    tell(&said, &out, &FILES, console);
    Ok(Exit::Good)
}

/// The runs of a study, one after the other.
struct Runs<'a> {
    bench: &'a Bench<'a>,
    budget: f64,
    ran: Vec<Ran>,
    left_out: Vec<String>,
}

impl Runs<'_> {
    fn all(
        &mut self,
        settings: &[Setting],
        registry: &mut Registry,
        quiet: bool,
        console: &mut Console<'_>,
    ) -> Result<(), Halt> {
        let mut spent = 0.0;
        for (number, setting) in settings.iter().enumerate() {
            if spent + self.expected(setting) > self.budget {
                self.left_out.push(setting.name());
                continue;
            }
            if !quiet {
                console.say(&format!("study {}/{} {}\n", number + 1, settings.len(), setting.name()));
            }
            let ran = self.bench.run(setting, registry)?;
            if !ran.resumed {
                spent += ran.done.cpu_seconds;
            }
            if !quiet {
                let how = if ran.resumed { ", done before" } else { "" };
                let (seconds, triangles) = (ran.done.cpu_seconds, ran.done.triangles);
                console.say(&format!("  {triangles} triangles, {seconds:.1} CPU s, {}{how}\n", ran.done.status));
            }
            self.ran.push(ran);
        }
        Ok(())
    }

    /// Drapes every mesh of the program's own choice again from shaken starts.
    fn shaken(
        &mut self,
        starts: u32,
        registry: &mut Registry,
        quiet: bool,
        console: &mut Console<'_>,
    ) -> Result<(), Halt> {
        let own = |s: &Setting| *s == Setting::plain(s.edge);
        for i in (0..self.ran.len()).filter(|i| own(&self.ran[*i].done.setting)).collect::<Vec<_>>() {
            let setting = self.ran[i].done.setting;
            let spent: f64 = self.ran.iter().map(|r| r.done.cpu_seconds).sum();
            if self.ran[i].garment.is_none() {
                continue;
            }
            if spent + f64::from(1 + starts) * self.ran[i].done.cpu_seconds > self.budget {
                self.left_out.push(format!("{} from shaken starts", setting.name()));
                continue;
            }
            if !quiet {
                console.say(&format!("study {} from {starts} shaken starts\n", setting.name()));
            }
            let again = self.bench.shaken(starts).run(&setting, registry)?;
            self.ran[i].scatter = again.done.certificate.and_then(|c| c.rests);
        }
        Ok(())
    }

    /// Carries the finest drape onto every coarser mesh of the program's own choice, and onto its own.
    fn carried(&mut self, registry: &mut Registry, quiet: bool, console: &mut Console<'_>) -> Result<(), Halt> {
        let Some(finest) = finest(&self.ran) else { return Ok(()) };
        let edge = self.ran[finest].done.setting.edge;
        for i in 0..self.ran.len() {
            let setting = self.ran[i].done.setting;
            let is_another = i != finest && setting.edge == edge;
            if !setting.is_own() || is_another || self.ran[i].garment.is_none() {
                continue;
            }
            if !quiet {
                console.say(&format!("study {} in the folds of the finest\n", setting.name()));
            }
            let carried = self.bench.carry(&self.ran[i], &self.ran[finest], registry)?;
            self.ran[i].carried = carried;
        }
        Ok(())
    }

    /// CPU seconds that a setting will take, from the dearest run so far and the order between them.
    fn expected(&self, setting: &Setting) -> f64 {
        let known = self.ran.iter().map(|r| r.done.cpu_seconds * setting.weight() / r.done.setting.weight());
        known.fold(0.0, f64::max)
    }
}

/// All keys of knobs, and of parameters that they replace.
fn keys(knobs: &[Knob]) -> Vec<String> {
    let own = |k: &Knob| [Some(k.key.to_string()), k.instead_of.as_ref().map(ToString::to_string)];
    knobs.iter().flat_map(own).flatten().collect()
}

fn axes(args: &StudyArgs) -> Result<Axes, Diagnostic> {
    let own = Axes::default();
    let edges: Result<Vec<f64>, Diagnostic> = args.edges.iter().map(|t| length(t, "--edges")).collect();
    Ok(Axes {
        edges: if args.edges.is_empty() { own.edges } else { edges? },
        accuracies: words(&args.accuracies, "--accuracies", own.accuracies)?,
        models: words(&args.models, "--models", own.models)?,
        integrators: words(&args.integrators, "--integrators", own.integrators)?,
        self_contact: words(&args.self_contact, "--self-contact", own.self_contact)?,
        full: args.full,
    })
}

/// Values of an axis in the words of pipelines.
fn words<T: DeserializeOwned>(texts: &[String], option: &str, own: Vec<T>) -> Result<Vec<T>, Diagnostic> {
    if texts.is_empty() {
        return Ok(own);
    }
    let read = |text: &String| {
        serde_json::from_value(serde_json::Value::String(text.clone())).map_err(|e| {
            Diagnostic::error(UNKNOWN_VALUE, format!("{option}: {e}")).hint("`toile stages drape` lists the words")
        })
    };
    texts.iter().map(read).collect()
}

/// A length in mm.
fn length(text: &str, option: &str) -> Result<f64, Diagnostic> {
    let wrong = |why: String| Diagnostic::error(WRONG_VALUE, format!("{option}: {why}")).hint("write e.g. \"12 mm\"");
    millimetres(text).map_err(wrong)
}

fn json(study: &Study) -> String {
    toile_garment::text::json(&serde_json::to_string_pretty(study).unwrap_or_default()) + "\n"
}

fn write(study: &Study, pictures: &[String], out: &Path, language: Language) -> Result<(), Halt> {
    let page = page::html(study, pictures, language);
    let texts = [json(study), chart::svg(study, language), page, table::markdown(study)];
    write_files(out, &FILES, &texts)
}
