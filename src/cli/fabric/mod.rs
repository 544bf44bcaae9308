//! `toile fabric test NAME FABRIC.toml`: one file per test. Each gives a [`Sheet`]; reading the fabric, findings and
//! writing are the same for all and stand here.

mod args;
mod bias;
mod cantilever;
mod cusick;
mod picture_frame;

pub use args::FabricArgs;

use super::console::Console;
use super::results::Results;
use crate::engine::Memory;
use crate::engine::{Exit, MAX_INPUT, Stop, clean, of_file_error, of_stage_error, read_limited};
use crate::progress::{Teller, Voice};
use args::{Common, FabricVerb, Test};
use serde_json::{Value, json};
use std::sync::Arc;
use toile_garment::Report;
use toile_garment::fabric::Fabric;
use toile_stage_api::{StageContext, StageError};
use toile_stages::text::text;

/// The result of a test.
struct Sheet {
    /// For programs; keys say their units.
    json: Value,
    /// For people.
    text: String,
    /// The picture.
    svg: String,
}

type Tested = Result<Sheet, StageError>;

pub(super) fn run(args: &FabricArgs, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let FabricVerb::Test(test) = &args.verb;
    match test {
        Test::Cusick(a) => perform("cusick", &a.common, stop, console, |fabric, cx| cusick::test(a, fabric, cx)),
        Test::Cantilever(a) => {
            perform("cantilever", &a.common, stop, console, |fabric, cx| cantilever::test(a, fabric, cx))
        }
        Test::Bias(a) => perform("bias", &a.common, stop, console, |fabric, cx| bias::test(a, fabric, cx)),
        Test::PictureFrame(a) => {
            perform("picture-frame", &a.common, stop, console, |fabric, cx| picture_frame::test(a, fabric, cx))
        }
    }
}

fn perform(
    name: &str,
    common: &Common,
    stop: &Arc<Stop>,
    console: &mut Console<'_>,
    test: impl FnOnce(&Fabric, &mut StageContext<'_>) -> Tested,
) -> Exit {
    let Some(fabric) = read(common, console) else { return Exit::Input };
    if common.svg.as_ref().is_some_and(|svg| !results(common).is_free(svg, console)) {
        return Exit::Usage;
    }
    let mut report = Report::default();
    let tested = watched(name, common, stop, &mut report, |cx| test(&fabric, cx));
    match tested {
        Ok(sheet) => {
            console.findings(&report.findings, None);
            show(name, &fabric, common, sheet, &report, console)
        }
        Err(error) => {
            let (findings, exit) = of_stage_error(error);
            report.findings.extend(findings);
            console.findings(&report.findings, None);
            exit
        }
    }
}

/// The picture never replaces the fabric.
fn results(common: &Common) -> Results {
    Results::new(common.force, &[&common.fabric])
}

/// The fabric; all that is wrong with its file is said.
fn read(common: &Common, console: &mut Console<'_>) -> Option<Fabric> {
    let name = clean(&common.fabric);
    let bytes = read_limited(&common.fabric, &common.fabric, MAX_INPUT).map_err(|e| of_file_error(&e).0);
    let content = bytes.and_then(|b| text(&name, &b).map_err(|finding| vec![finding]));
    let (text, read) = match content {
        Ok(text) => {
            let read = toile_formats::fabric::read(&text, &name);
            (text, read)
        }
        Err(findings) => (String::new(), Err(findings)),
    };
    read.map_err(|findings| console.findings(&findings, Some((&name, &text)))).ok()
}

/// Lends a test what the engine lends to a stage.
fn watched(
    name: &str,
    common: &Common,
    stop: &Arc<Stop>,
    report: &mut Report,
    test: impl FnOnce(&mut StageContext<'_>) -> Tested,
) -> Tested {
    let mut teller = Teller::new(if common.quiet { Voice::Quiet } else { Voice::Auto }, None);
    teller.stage_start(1, 1, name);
    let started = std::time::Instant::now();
    let tested = test(&mut StageContext {
        report,
        progress: &mut teller,
        files: &mut Memory::default(),
        cancel: stop.flag(),
        seed: 0,
        threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
    });
    teller.stage_end(name, started.elapsed().as_secs_f64(), if tested.is_ok() { "good" } else { "failed" });
    tested
}

fn show(
    name: &str,
    fabric: &Fabric,
    common: &Common,
    sheet: Sheet,
    report: &Report,
    console: &mut Console<'_>,
) -> Exit {
    if common.json {
        let mut all = json!({ "test": name, "fabric": fabric.name, "findings": report.findings });
        if let (Some(all), Value::Object(own)) = (all.as_object_mut(), sheet.json) {
            all.extend(own);
        }
        console.json(&all);
    } else {
        console.result(&crate::render::safe(&format!("{}\n{}", fabric.name, sheet.text)));
    }
    match &common.svg {
        None => Exit::Good,
        // JSON stands alone on stdout.
        Some(path) if common.json => results(common).write_silently(path, sheet.svg.as_bytes(), console),
        Some(path) => results(common).write(path, sheet.svg.as_bytes(), console),
    }
}

/// A figure for programs: six significant digits, as no test gives more.
fn figure(x: f64) -> Value {
    let text = format!("{x:.5e}");
    json!(text.parse::<f64>().ok().filter(|x| x.is_finite()))
}
