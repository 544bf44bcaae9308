//! Bodies that are brought along: stood upright and measured.

use super::codes;
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
