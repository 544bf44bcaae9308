//! `toile body measure FILE.obj`: what a mesh says of its body.

use super::picture;
use crate::cli::args::BodyMeasureArgs;
use crate::cli::console::Console;
use crate::cli::results::Results;
use crate::codes::WRONG_VALUE;
use crate::engine::{Exit, MAX_INPUT, clean, of_file_error, read_limited};
use crate::new::{BODY_NOT_STANDING, told, upright};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use toile_garment::Diagnostic;
use toile_stages::body::{Found, MESH_UNITS, MeshUnit, Stance, measured};

/// A mesh and what was found on it.
struct Taken {
    stance: Stance,
    found: Found,
    findings: Vec<Diagnostic>,
}

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
    let results = Results::new(args.force, &[&args.mesh]);
    let paths: Vec<&Path> = files.iter().map(|(path, _)| path.as_path()).collect();
    if !results.are_free(&paths, console) {
        return Exit::Usage;
    }
    console.result(&table(args, &taken));
    console.findings(&taken.findings, None);
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
    let side = args.mesh.with_extension("toml");
    let side = if side.is_file() { Some(load(&side)?) } else { None };
    let text = side.as_ref().map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    let read = toile_formats::body::read(&bytes, &args.mesh.to_string_lossy(), text.as_deref())?;
    let unit =
        args.units.and_then(|u| MESH_UNITS.into_iter().find(|m: &MeshUnit| (1e3 * m.metres - u.mm()).abs() < 1e-9));
    let (stance, body) = upright(read.body, unit).map_err(|f| vec![*f])?;
    let found = measured(&body);
    let mut findings: Vec<Diagnostic> =
        read.findings.into_iter().filter(|f| f.code != toile_formats::codes::BODY_SIZE).collect();
    findings.extend(told(&found));
    Ok(Taken { stance, found, findings })
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
        let guess = found.guessed.iter().any(|(n, _)| n == name);
        let _ = writeln!(text, "{name:<20}{:>8.1}{}", 1e3 * length, if guess { "  by a usual share" } else { "" });
    }
    let (landmarks, segments) = (found.body.landmarks.len(), found.body.segments.len());
    let _ = writeln!(text, "{landmarks} landmarks, {segments} segments");
    text
}
