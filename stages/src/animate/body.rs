//! Frames of the body: a series of OBJ files, or the animation of a GLB.

use super::AnimateParams;
use super::codes;
use crate::codes::{BODY_FRAME_VERTICES, BODY_MISSING};
use std::collections::BTreeMap;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use toile_formats::{gltf, obj};
use toile_garment::body::Body;
use toile_garment::garment::UpAxis;
use toile_garment::{Code, Diagnostic, Garment, SourceRef, Vec3};
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
        let found = Diagnostic::error(BODY_MISSING, "the body is to move, but the garment was draped on none");
        StageError::parameter(found.hint("give the stage `stitch` the body at rest: with.body = \"…obj\""))
    })?;
    let glb = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb"));
    let series = if glb { animation(path, params.fps, body, cx)? } else { series(path, body, garment.file_up, cx)? };
    let frames: Vec<Vec<Vec3>> = series.iter().map(|(_, f)| f.clone()).collect();
    for (pair, (file, _)) in frames.windows(2).zip(series.iter().skip(1)) {
        let moved = pair[0].iter().zip(&pair[1]).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
        if moved * params.fps > FASTEST {
            let message =
                format!("the body moves by {moved:.3} m from the frame before: {:.0} m/s", moved * params.fps);
            let found =
                Diagnostic::error(codes::BODY_FRAME_JUMPS, message).at(SourceRef::file(file.display().to_string()));
            return Err(StageError::input(
                found.hint("frames hold metres, one after the other; is with.fps their rate?"),
            ));
        }
    }
    Ok(frames)
}

/// OBJ files have the axes of the cloth mesh they go with.
fn series(
    path: &Path,
    body: &Body,
    up: UpAxis,
    cx: &mut StageContext<'_>,
) -> Result<Vec<(PathBuf, Vec<Vec3>)>, StageError> {
    let text = path.to_string_lossy().into_owned();
    let Some((before, start, width, after)) = number(&text) else {
        let found = Diagnostic::error(codes::BODY_FRAMES_NAME, format!("`{text}` has no number to count up from"));
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
        let frame = frame(&bytes, &name(k), body, &known)?;
        out.push((name(k), frame.into_iter().map(|p| up.from_file(p)).collect()));
    }
    Ok(out)
}

/// Farthest that a vertex of a GLB at rest may be from its vertex of the body, metres.
const SAME: f64 = 1e-4;

/// Places of the body's vertices in a GLB, whose vertices may stand in another order and several at one place.
fn animation(
    path: &Path,
    fps: f64,
    body: &Body,
    cx: &mut StageContext<'_>,
) -> Result<Vec<(PathBuf, Vec<Vec3>)>, StageError> {
    let name = path.display().to_string();
    let refuse = |code: Code, message: String, hint: &str| {
        StageError::input(Diagnostic::error(code, message).at(SourceRef::file(name.clone())).hint(hint))
    };
    let moving = gltf::read_moving(&cx.files.read(path)?, fps).map_err(|e| {
        refuse(
            codes::BODY_GLB,
            e.to_string(),
            "export one GLB with the body's mesh, its skin or shapes, and one animation",
        )
    })?;
    let found = counterparts(&body.positions, &moving.rest);
    let missing = found.iter().filter(|f| f.is_none()).count();
    if let Some(v) = found.iter().position(Option::is_none) {
        let p = body.positions[v];
        let message = format!(
            "{missing} of {} vertices of the body have no vertex of the GLB's rest pose within 0.1 mm, the first at ({:.4}, {:.4}, {:.4}) m",
            found.len(),
            p.x,
            p.y,
            p.z
        );
        return Err(refuse(
            BODY_FRAME_VERTICES,
            message,
            "the GLB must hold the body that `stitch` reads, in metres, in the same rest pose",
        ));
    }
    let found: Vec<usize> = found.into_iter().flatten().collect();
    let pick = |f: &Vec<Vec3>| (path.to_path_buf(), found.iter().map(|i| f[*i]).collect());
    Ok(moving.frames.iter().map(pick).collect())
}

/// For every point the nearest of `others` within [`SAME`].
fn counterparts(points: &[Vec3], others: &[Vec3]) -> Vec<Option<usize>> {
    #[allow(clippy::cast_possible_truncation)]
    let cell = |p: &Vec3| [p.x, p.y, p.z].map(|c| (c / SAME).floor() as i64);
    let mut grid: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    for (i, p) in others.iter().enumerate() {
        grid.entry(cell(p)).or_default().push(i);
    }
    let near = |p: &Vec3| {
        let [x, y, z] = cell(p);
        let cells = (0..27).map(|k| [x + k / 9 - 1, y + k / 3 % 3 - 1, z + k % 3 - 1]);
        let all = cells.filter_map(|c| grid.get(&c)).flatten().map(|i| (*i, (others[*i] - p).norm()));
        all.filter(|(_, d)| *d <= SAME).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    };
    points.iter().map(near).collect()
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
    let mesh = obj::read_geometry(bytes, &name).map_err(StageError::Input)?;
    let wrong = |code: Code, message: String| {
        let found = Diagnostic::error(code, message).at(SourceRef::file(name.clone()));
        Err(StageError::input(found.hint(
            "export every frame from the mesh of the body that `stitch` reads, vertices and faces in the same order",
        )))
    };
    let (n, m) = (mesh.positions.len(), body.positions.len());
    if n != m {
        return wrong(
            BODY_FRAME_VERTICES,
            format!("the frame has {n} vertices, the body the garment was draped on {m}"),
        );
    }
    let theirs: BTreeSet<[u32; 3]> = mesh.triangles.iter().map(sorted).collect();
    if let Some(t) = known.iter().find(|t| !theirs.contains(*t)) {
        let [a, b, c] = t.map(|i| i + 1);
        return wrong(codes::BODY_FRAME_FACES, format!("the body's face {a} {b} {c} is not in the frame"));
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
