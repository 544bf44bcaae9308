//! `toile new PATTERN.dxf --out DIR`: a working folder with proposed seams, or a sample.

use super::args::NewArgs;
use super::console::Console;
use crate::engine::{Exit, clean, unwritten};
use crate::new::{
    Body, Earlier, FABRIC_CHOSEN, FABRIC_HINT, Fabric, Folder, New, Order, SIZE_TAKEN, Sample, Source, Wishes,
    from_pattern, read,
};
use crate::progress::Spinner;
use std::collections::BTreeMap;
use toile_garment::text::shown;
use toile_garment::{Diagnostic, Severity};
use toile_stages::body::BodyMeasures;

/// Size of the body, where none is asked for.
const SIZE: &str = "38";
/// Fabric, where none is asked for.
const FABRIC: &str = "cotton-shirting";
/// Fabric of a pattern with ribs.
const KNIT: &str = "cotton-jersey";

pub(super) fn run(args: &NewArgs, console: &mut Console<'_>) -> Exit {
    let sized = args.size.as_deref().filter(|size| BodyMeasures::size(size).is_some());
    let body = Body::of(args.body.as_deref().or(sized).unwrap_or(SIZE));
    let word = args.pattern.to_string_lossy();
    if let Some(sample) = Sample::of(&word).filter(|_| !args.pattern.exists()) {
        let fabric = Fabric::of(args.fabric.as_deref().unwrap_or(sample.fabric));
        return match sample.folder(args.size.as_deref(), &body, &fabric) {
            Ok(folder) => write(args, &folder, console),
            Err(findings) => refuse(&findings, Exit::Usage, console),
        };
    }
    let earlier = match Earlier::read(&args.out) {
        Ok(earlier) => earlier,
        Err(findings) => return refuse(&findings, Exit::Input, console),
    };
    if let Some(Err(findings)) = earlier.as_ref().map(|e| e.check(&args.pattern, args.size.as_deref())) {
        return refuse(&findings, Exit::Usage, console);
    }
    let wishes = Wishes {
        leave_out: args.leave_out.clone(),
        unit: args.units.or_else(|| earlier.as_ref()?.unit),
        size: args.size.clone().or_else(|| earlier.as_ref()?.size.clone()),
        layers: layers(args, earlier.as_ref()),
    };
    let source = match read(&args.pattern, earlier.as_ref().map(|e| e.plan.clone()), &wishes) {
        Ok(source) => source,
        Err(findings) => return refuse(&findings, Exit::Input, console),
    };
    let told: Vec<Diagnostic> = source.findings.iter().filter(|f| f.severity != Severity::Info).cloned().collect();
    console.findings(&told, None);
    console.findings(size_taken(&source).as_slice(), None);
    let fabric = fabric(args, &source, console);
    let is_open = args.fabric.is_none() && source.knit().is_none();
    let own = earlier.as_ref().filter(|_| args.body.is_none()).and_then(|e| e.body.clone());
    let order = Order {
        source: &source,
        is_body_asked: args.body.is_some() || own.is_some(),
        is_size_asked: args.size.is_some(),
        body: own.unwrap_or(body),
        fabric,
        knit: is_open.then(|| Fabric::of(KNIT)),
        earlier: earlier.as_ref(),
        is_anonymous: args.anonymous,
        language: args.language.language(),
    };
    let spinner = Spinner::start(format!("searching for seams between {} pieces", source.garment.pieces.len()));
    let made = from_pattern(&order);
    drop(spinner);
    match made {
        Ok(new) => {
            console.findings(&new.findings, None);
            let exit = write(args, &new.folder, console);
            if exit != Exit::Good {
                return exit;
            }
            tell(args, &new, console)
        }
        Err(findings) => refuse(&findings, Exit::Usage, console),
    }
}

/// The layers that stand for others: those that were asked for, else those of the folder.
fn layers(args: &NewArgs, earlier: Option<&Earlier>) -> BTreeMap<String, String> {
    let of_folder = || earlier.map(|e| e.layers.clone()).unwrap_or_default();
    if args.layer.is_empty() { of_folder() } else { args.layer.iter().cloned().collect() }
}

/// Tells the size that was taken of a file with several.
fn size_taken(source: &Source) -> Option<Diagnostic> {
    let size = source.garment.size.as_deref().filter(|_| source.sizes.len() > 1)?;
    let [size, all] = [size, &source.sizes.join(", ")].map(|text| shown(text, &[]));
    let finding = Diagnostic::info(SIZE_TAKEN, format!("size {size} was taken; the file holds {all}"));
    Some(finding.hint("--size SIZE takes another one, and the body of that size"))
}

/// The fabric that was asked for, else one that suits the pattern.
fn fabric(args: &NewArgs, source: &Source, console: &mut Console<'_>) -> Fabric {
    let knit = source.knit().filter(|_| args.fabric.is_none());
    if let Some((piece, word)) = &knit {
        let [name, word] = [&piece.name, word].map(|text| shown(text, &[]));
        let message = format!("the text {word} of piece {name} tells that the garment is a knit: {KNIT} was chosen");
        let finding = Diagnostic::info(FABRIC_CHOSEN, message).hint(FABRIC_HINT);
        console.findings(&[finding], None);
    }
    Fabric::of(args.fabric.as_deref().unwrap_or(if knit.is_some() { KNIT } else { FABRIC }))
}

fn refuse(findings: &[Diagnostic], exit: Exit, console: &mut Console<'_>) -> Exit {
    console.findings(findings, None);
    exit
}

/// Writes the folder and names what was written.
fn write(args: &NewArgs, folder: &Folder, console: &mut Console<'_>) -> Exit {
    match folder.write(&args.out) {
        Ok(made) => {
            for path in &made.kept {
                console.say(&format!("kept {}, which was there\n", clean(path)));
            }
            if !args.json {
                made.written.iter().for_each(|path| console.result(&format!("{}\n", clean(path))));
            }
            Exit::Good
        }
        Err((path, error)) => refuse(&[unwritten(&path, &error)], Exit::System, console),
    }
}

/// Says what comes next. Exit code 1 where a person must decide something first.
fn tell(args: &NewArgs, new: &New, console: &mut Console<'_>) -> Exit {
    if args.json {
        console.json(&new.proposal);
    }
    let [page, pipeline, out] = ["start.html", "pipeline.toml", "out"].map(|name| clean(&args.out.join(name)));
    console.say(&format!("{} seams are proposed, {} of them too unsure to be sewn\n", new.seams, new.open));
    console.say(&format!(
        "look at {page}\nnext: toile run {pipeline} --out {out}\n\
         or:   toile watch {pipeline} --out {out}, which runs it again whenever one of its files is saved\n"
    ));
    if new.open == 0 { Exit::Good } else { Exit::Gate }
}
