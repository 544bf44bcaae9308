//! Frames of the body: a series of OBJ files.

use super::AnimateParams;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use toile_formats::obj;
use toile_garment::body::Body;
use toile_garment::{Diagnostic, Garment, SourceRef, Vec3};
use toile_stage_api::{StageContext, StageError};

/// Most frames that are read.
const MOST: usize = 100_000;
/// No point of a body is faster, m/s: frames in other units, or in disorder.
const FASTEST: f64 = 50.0;

/// Places of the body's vertices in every frame, metres.
///
/// # Errors
/// A missing series, another mesh, a body that jumps: each with file and remedy.
pub fn frames(
    path: &Path,
    params: &AnimateParams,
    garment: &Garment,
    cx: &mut StageContext<'_>,
) -> Result<Vec<Vec<Vec3>>, StageError> {
    let body = garment.body.as_ref().filter(|b| !b.triangles.is_empty()).ok_or_else(|| {
        let found = Diagnostic::error("body-missing", "the body is to move, but the garment was draped on none");
        StageError::parameter(found.hint("give the stage `stitch` the body at rest: with.body = \"…obj\""))
    })?;
    let series = series(path, body, cx)?;
    let frames: Vec<Vec<Vec3>> = series.iter().map(|(_, f)| f.clone()).collect();
    for (pair, (file, _)) in frames.windows(2).zip(series.iter().skip(1)) {
        let moved = pair[0].iter().zip(&pair[1]).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
        if moved * params.fps > FASTEST {
            let message =
                format!("the body moves by {moved:.3} m from the frame before: {:.0} m/s", moved * params.fps);
            let found = Diagnostic::error("body-frame-jumps", message).at(SourceRef::file(file.display().to_string()));
            return Err(StageError::input(
                found.hint("frames hold metres, one after the other; is with.fps their rate?"),
            ));
        }
    }
    Ok(frames)
}

fn series(path: &Path, body: &Body, cx: &mut StageContext<'_>) -> Result<Vec<(PathBuf, Vec<Vec3>)>, StageError> {
    let text = path.to_string_lossy().into_owned();
    let Some((before, start, width, after)) = number(&text) else {
        let found = Diagnostic::error("body-frames-name", format!("`{text}` has no number to count up from"));
        return Err(StageError::parameter(found.hint("name the first file of a series: with.body = \"walk-000.obj\"")));
    };
    let name = |k: usize| PathBuf::from(format!("{before}{k:0width$}{after}"));
    let known: BTreeSet<[u32; 3]> = body.triangles.iter().map(sorted).collect();
    let mut out = Vec::new();
    for k in (start..).take(MOST) {
        if cx.cancelled() {
            return Err(StageError::Cancelled);
        }
        let there = if k == start { Some(cx.files.read(path)?) } else { cx.files.read_optional(&name(k))? };
        let Some(bytes) = there else { break };
        out.push((name(k), frame(&bytes, &name(k), body, &known)?));
    }
    Ok(out)
}

/// The last number in a file's name: what stands before it, the number, its digits, what stands after it.
pub fn number(path: &str) -> Option<(&str, usize, usize, &str)> {
    let name = path.rfind(['/', '\\']).map_or(0, |i| i + 1);
    let end = name + path[name..].rfind(|c: char| c.is_ascii_digit())? + 1;
    let from = path[..end].rfind(|c: char| !c.is_ascii_digit()).map_or(0, |i| i + 1).max(name);
    let first = path[from..end].parse().ok()?;
    Some((&path[..from], first, end - from, &path[end..]))
}

fn sorted(t: &[u32; 3]) -> [u32; 3] {
    let mut t = *t;
    t.sort_unstable();
    t
}

fn frame(bytes: &[u8], file: &Path, body: &Body, known: &BTreeSet<[u32; 3]>) -> Result<Vec<Vec3>, StageError> {
    let name = file.display().to_string();
    let mesh = obj::read(bytes, &name).map_err(StageError::Input)?;
    let wrong = |code: &str, message: String| {
        let found = Diagnostic::error(code, message).at(SourceRef::file(name.clone()));
        Err(StageError::input(found.hint(
            "export every frame from the mesh of the body that `stitch` reads, vertices and faces in the same order",
        )))
    };
    let (n, m) = (mesh.positions.len(), body.positions.len());
    if n != m {
        return wrong(
            "body-frame-vertices",
            format!("the frame has {n} vertices, the body the garment was draped on {m}"),
        );
    }
    let theirs: BTreeSet<[u32; 3]> = mesh.triangles.iter().map(sorted).collect();
    if let Some(t) = known.iter().find(|t| !theirs.contains(*t)) {
        let [a, b, c] = t.map(|i| i + 1);
        return wrong("body-frame-faces", format!("the body's face {a} {b} {c} is not in the frame"));
    }
    Ok(mesh.positions)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_is_the_last_in_the_name() {
        assert_eq!(number("in 2/walk2-007.obj"), Some(("in 2/walk2-", 7, 3, ".obj")));
        assert_eq!(number("12.obj"), Some(("", 12, 2, ".obj")));
        assert_eq!(number("in 2/walk.obj"), None);
    }
}
