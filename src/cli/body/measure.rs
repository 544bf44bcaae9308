//! `toile body measure FILE.obj`: what a mesh says of its body.

use super::picture;
use crate::cli::args::BodyMeasureArgs;
use crate::cli::console::Console;
use crate::cli::results::Results;
use crate::codes::WRONG_VALUE;
use crate::engine::{Exit, MAX_INPUT, clean, of_file_error, read_limited};
use crate::new::{BODY_NOT_STANDING, differing, told, upright};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use toile_garment::Diagnostic;
use toile_garment::body::Body;
use toile_stages::body::{Found, MESH_UNITS, MeshUnit, Stance, impossible, measured};
use toile_stages::text::text;

/// A mesh and what was found on it.
struct Taken {
    stance: Stance,
    found: Found,
    /// Measures that the side file names.
    named: BTreeMap<String, f64>,
    findings: Vec<Diagnostic>,
}

/// Heights of bodies, metres, as in runs.
const STATURES: std::ops::RangeInclusive<f64> = 0.2..=3.0;

pub(super) fn run(args: &BodyMeasureArgs, console: &mut Console<'_>) -> Exit {
    let taken = match take(args) {
        Ok(taken) => taken,
        Err(findings) => {
            console.findings(&findings, None);
            return Exit::Input;
        }
    };
    let as_obj = args.out.as_ref().filter(|o| o.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj")));
    let side = as_obj.map_or_else(|| args.out.clone(), |o| Some(o.with_extension("toml")));
    let side = side.unwrap_or_else(|| args.mesh.with_extension("toml"));
    let name = side.file_stem().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let mut body = taken.found.body.clone();
    if as_obj.is_some() {
        body.name = name;
    }
    let (mesh, text) = toile_formats::body::write(&body);
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    let is_usable = taken.stance.is_upright() || as_obj.is_some();
    files.extend(as_obj.map(|path| (path.clone(), mesh.into_bytes())));
    files.extend(is_usable.then(|| (side, text.into_bytes())));
    let picture = args.picture.as_ref().map(|path| (path.clone(), picture::draw(&taken.found).into_bytes()));
    files.extend(picture);
    // The figures are told whatever happens to the files.
    console.result(&table(args, &taken));
    console.findings(&taken.findings, None);
    // What is there already, byte by byte, needs no writing.
    files.retain(|(path, bytes)| std::fs::read(path).ok().as_ref() != Some(bytes));
    let results = Results::new(args.force, &[&args.mesh]);
    let files: Vec<(&Path, &[u8])> = files.iter().map(|(path, bytes)| (path.as_path(), bytes.as_slice())).collect();
    match results.write_all(&files, console) {
        Exit::Good if !is_usable => {
            console.findings(&[not_upright(args, &taken.stance)], None);
            Exit::Input
        }
        exit => exit,
    }
}

/// Reads the mesh and what its side file names, stands it upright and measures it.
fn take(args: &BodyMeasureArgs) -> Result<Taken, Vec<Diagnostic>> {
    let load = |path: &Path| {
        read_limited(path, path, MAX_INPUT).map_err(|e| of_file_error(&e).0.into_iter().collect::<Vec<_>>())
    };
    for path in args.out.iter().chain(&args.picture) {
        let ending = path.extension().map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
        let is_picture = args.picture.as_ref() == Some(path);
        if !(if is_picture { ["svg", "svg"] } else { ["toml", "obj"] }).contains(&ending.as_str()) {
            let message = format!("`{}` has an ending that is not written here", clean(path));
            let hint = "--out takes FILE.toml or FILE.obj, --picture FILE.svg";
            return Err(vec![Diagnostic::error(WRONG_VALUE, message).hint(hint)]);
        }
    }
    let bytes = load(&args.mesh)?;
    let side_path = args.mesh.with_extension("toml");
    let side = if side_path.is_file() { Some(load(&side_path)?) } else { None };
    let text =
        side.as_ref().map(|bytes| text(&clean(&side_path), bytes)).transpose().map_err(|finding| vec![finding])?;
    let read = toile_formats::body::read(&bytes, &args.mesh.to_string_lossy(), text.as_deref())?;
    let unit =
        args.units.and_then(|u| MESH_UNITS.into_iter().find(|m: &MeshUnit| (1e3 * m.metres - u.mm()).abs() < 1e-9));
    let (stance, body) = upright(read.body, unit).map_err(|f| vec![*f])?;
    is_person(args, &body, &stance).map_err(|f| vec![f])?;
    let found = measured(&body);
    let broken = "the mesh is no whole body there: close its holes, or write the measure in a side file";
    let wrong: Vec<Diagnostic> = impossible(&found.body).into_iter().map(|f| f.hint(broken)).collect();
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let mut findings: Vec<Diagnostic> =
        read.findings.into_iter().filter(|f| f.code != toile_formats::codes::BODY_SIZE).collect();
    findings.extend(told(&found));
    findings.extend(differing(&found, &body.measures));
    Ok(Taken { stance, found, named: body.measures, findings })
}

/// Refuses a mesh that is no person in its unit.
fn is_person(args: &BodyMeasureArgs, body: &Body, stance: &Stance) -> Result<(), Diagnostic> {
    let ends = body.positions.iter().map(|p| p.y);
    let [low, high] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], y| [l.min(y), h.max(y)]);
    let stature = high - low;
    if STATURES.contains(&stature) {
        return Ok(());
    }
    let message =
        format!("in {} `{}` is {:.1} mm tall, which is no person", stance.unit.name, clean(&args.mesh), 1e3 * stature);
    let likely = MESH_UNITS.iter().find(|u| STATURES.contains(&(stature / stance.unit.metres * u.metres)));
    let hint = match likely.filter(|u| **u != stance.unit) {
        Some(unit) => format!("leave --units out, or say --units {}", unit.name),
        None => "scale the mesh to metres".to_owned(),
    };
    Err(Diagnostic::error(toile_formats::codes::BODY_SIZE, message).hint(hint))
}

fn not_upright(args: &BodyMeasureArgs, stance: &Stance) -> Diagnostic {
    let message = format!(
        "`{}` stands {}: a body stands +y up, front to +z, in m, its feet at 0, so no side file was written",
        clean(&args.mesh),
        stance.words()
    );
    let hint = format!("`toile body measure {} --out UPRIGHT.obj` writes it so, with its side file", clean(&args.mesh));
    Diagnostic::error(BODY_NOT_STANDING, message).hint(hint)
}

/// The measures, one a line.
fn table(args: &BodyMeasureArgs, taken: &Taken) -> String {
    let found = &taken.found;
    let (stance, pose) = (taken.stance.words(), found.pose.words());
    let mut text = format!("{}: {stance}; {pose}; measures in mm\n", clean(&args.mesh));
    for (name, length) in &found.body.measures {
        let shown = found.mesh.get(name.as_str()).copied().unwrap_or(*length);
        let _ = writeln!(text, "{name:<20}{:>8.1}{}", 1e3 * shown, source(taken, name));
    }
    let (landmarks, segments) = (found.body.landmarks.len(), found.body.segments.len());
    let _ = writeln!(text, "{landmarks} landmarks, {segments} segments");
    text
}

/// Where a measure comes from, if the mesh alone does not show it, and what the side file says instead.
fn source(taken: &Taken, name: &str) -> String {
    let found = &taken.found;
    let said = taken.named.get(name);
    match (found.mesh.get(name), said) {
        (None, _) => "  by the side file".to_owned(),
        (_, Some(_)) if found.led.iter().any(|n| n == name) => "  by the side file".to_owned(),
        (Some(mesh), Some(said)) if 1e3 * (mesh - said).abs() >= 0.05 => {
            format!("  {:.1} in the side file", 1e3 * said)
        }
        _ if found.guessed.iter().any(|(n, _)| *n == name) => "  by a usual share".to_owned(),
        _ => String::new(),
    }
}
