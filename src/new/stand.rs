//! Bodies that are brought along: stood upright and measured.

use super::codes;
use std::collections::BTreeMap;
use toile_garment::Diagnostic;
use toile_garment::body::Body;
use toile_stages::body::{Found, MeshUnit, Stance};

/// The stance of a mesh, and the mesh upright in metres.
///
/// # Errors
/// No way to stand it shows two legs under a trunk.
pub fn upright(body: Body, unit: Option<MeshUnit>) -> Result<(Stance, Body), Box<Diagnostic>> {
    let Some(stance) = Stance::of(&body, unit) else {
        let message = format!("body `{}`: no way to stand it shows two legs under a trunk", body.name);
        let hint =
            "it must be a whole person whose legs are apart; else write [segments] and [landmarks] in a side file";
        return Err(Box::new(Diagnostic::error(codes::BODY_NOT_STANDING, message).hint(hint)));
    };
    if stance.is_upright() {
        return Ok((stance, body));
    }
    // Names of a mesh that stands otherwise have no place on this one.
    let bare = Body { name: body.name, positions: body.positions, triangles: body.triangles, ..Body::default() };
    let turned = stance.upright(&bare);
    Ok((stance, turned))
}

/// Findings on parts that the mesh does not show, with the lines that say them.
pub fn told(found: &Found) -> Vec<Diagnostic> {
    let name = &found.body.name;
    let line = |part: &str| match part {
        "crotch" => "[landmarks]\ncrotch = [\"0 mm\", \"770 mm\", \"0 mm\"]".to_owned(),
        part => format!("[measures]\n{part} = \"… mm\""),
    };
    let missing = found.missing.iter().map(|(part, why)| {
        let message = format!("body `{name}`: {part} was not found: {why}");
        let hint = format!("write it into the side file, then measure again: {}", line(part).replace('\n', " "));
        Diagnostic::warning(codes::BODY_PART_NOT_FOUND, message).hint(hint)
    });
    let usual = found.guessed.iter().map(|(part, why)| {
        let message = format!("body `{name}`: {part} is put where it usually is: {why}");
        let hint = format!("a line in the side file says otherwise: {}", line(part).replace('\n', " "));
        Diagnostic::info(codes::BODY_PART_USUAL, message).hint(hint)
    });
    missing.chain(usual).collect()
}

/// How far a girth of a side file may be from that of the mesh, and how far a length, metres. Where shoulder and neck
/// begin is a matter of taste.
const GIRTH_OFF: f64 = 0.012;
const LENGTH_OFF: f64 = 0.03;

/// Findings on measures of a side file that the mesh does not show.
pub fn differing(found: &Found, named: &BTreeMap<String, f64>) -> Vec<Diagnostic> {
    let name = &found.body.name;
    let differs = |(measure, said): (&String, &f64)| {
        let mesh = *found.mesh.get(measure.as_str())?;
        let most = if measure.ends_with("girth") { GIRTH_OFF } else { LENGTH_OFF };
        let is_held = found.body.measures.get(measure) == Some(said);
        (is_held && (mesh - said).abs() > most).then(|| {
            let (mesh, said) = (1e3 * mesh, 1e3 * said);
            let message =
                format!("body `{name}`: the side file says {measure} {said:.0} mm, and the mesh has {mesh:.0} mm");
            let hint = "take the line out of the side file and measure again, if the mesh is right";
            Diagnostic::warning(codes::BODY_SIDE_FILE_DIFFERS, message).hint(hint)
        })
    };
    let moved = found.moved.iter().map(|height| {
        let level = height.trim_end_matches("_height");
        let message =
            format!("body `{name}`: {height} was edited: girth and landmarks of the {level} are measured there");
        Diagnostic::info(codes::BODY_SIDE_FILE_DIFFERS, message).hint("--force writes them into the side file")
    });
    named.iter().filter_map(differs).chain(moved).collect()
}
