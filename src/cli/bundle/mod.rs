//! `toile bundle` and `toile bundle verify`.

mod args;

pub use args::BundleArgs;

use super::console::Console;
use super::results::Results;
use crate::bundle::{self, Bundle, Order};
use crate::codes::WRITE_FAILED;
use crate::engine::{Exit, Stop, clean};
use crate::rerun::Means;
use args::{BundleVerb, VerifyArgs};
use serde_json::json;
use std::path::Path;
use std::sync::Arc;
use toile_garment::Diagnostic;
use toile_stage_api::Registry;

pub(super) fn run(args: &BundleArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    match (&args.verb, &args.run, &args.out) {
        (Some(BundleVerb::Verify(args)), ..) => verify(args, registry, stop, console),
        (None, Some(run), Some(out)) => pack(args, run, out, registry, stop, console),
        // The reader of arguments asks for both.
        _ => Exit::Usage,
    }
}

fn pack(
    args: &BundleArgs,
    run: &Path,
    out: &Path,
    registry: &mut Registry,
    stop: &Arc<Stop>,
    console: &mut Console<'_>,
) -> Exit {
    let order = Order {
        run: run.to_path_buf(),
        pipeline: args.pipeline.clone(),
        allow_read: args.allow_read.clone(),
        allow_run: args.allow_run.clone(),
    };
    let packed = match bundle::pack(&order, stop, registry) {
        Ok(packed) => packed,
        Err(refusal) => {
            let source = refusal.source.as_ref().map(|(file, text)| (file.as_str(), text.as_str()));
            console.findings(&refusal.findings, source);
            return refusal.exit;
        }
    };
    let inputs: Vec<&Path> = packed.inputs.iter().map(std::path::PathBuf::as_path).collect();
    let exit = Results::new(args.force, &inputs).write_silently(out, &packed.bytes, console);
    if exit == Exit::Good {
        let digest = blake3::hash(&packed.bytes).to_hex();
        let text = format!("{}\n{} files, blake3 {digest}\n", clean(out), packed.manifest.files.len());
        console.result(&crate::render::safe(&text));
    }
    exit
}

fn verify(args: &VerifyArgs, registry: &mut Registry, stop: &Arc<Stop>, console: &mut Console<'_>) -> Exit {
    let bundle = match bundle::open(&args.file) {
        Ok(bundle) => bundle,
        Err(findings) => {
            console.findings(&findings, None);
            return Exit::Input;
        }
    };
    let mut differences = Vec::new();
    if args.run {
        match again(args, &bundle, registry, stop) {
            Ok(found) => differences = found,
            Err((findings, exit)) => {
                console.findings(&findings, None);
                return exit;
            }
        }
    }
    if args.json {
        console.json(&json!({
            "bundle": bundle.manifest, "blake3": bundle.blake3, "run_again": args.run, "differences": differences,
        }));
    } else {
        console.findings(&differences, None);
        console.result(&crate::render::safe(&text(args, &bundle, differences.is_empty())));
    }
    if differences.is_empty() { Exit::Good } else { Exit::Gate }
}

fn again(
    args: &VerifyArgs,
    bundle: &Bundle,
    registry: &mut Registry,
    stop: &Arc<Stop>,
) -> Result<Vec<Diagnostic>, (Vec<Diagnostic>, Exit)> {
    let threads = super::run::pool(args.threads);
    let folder = tempfile::tempdir().map_err(|e| {
        let message = format!("there is no folder for temporary files: {e}");
        (vec![Diagnostic::error(WRITE_FAILED, message)], Exit::System)
    })?;
    let means = Means { threads, limits: args.limits.limits(), cache: None };
    bundle::replay(bundle, folder.path(), &args.allow_run, &means, stop, registry)
}

fn text(args: &VerifyArgs, bundle: &Bundle, is_same: bool) -> String {
    let manifest = &bundle.manifest;
    let mut text = format!(
        "{}: {} files, all as their hashes say\nblake3   {}\nprogram  {}\npipeline {}\n",
        clean(&args.file),
        manifest.files.len(),
        bundle.blake3,
        manifest.program,
        manifest.pipeline
    );
    manifest.set.iter().for_each(|set| text.push_str(&format!("set      {set}\n")));
    if args.run {
        let verdict = if is_same { "all the same" } else { "not the same" };
        text.push_str(&format!("run again: exit code and {} outputs, {verdict}\n", manifest.outputs.len()));
    }
    text
}
