//! Two readings of the same file must agree: ours, in file order, and `tobj`'s, renumbered.
//!
//! `tobj` gets a cleaned stream of the vertices and faces that passed our checks: what it panics on, or reads as
//! something else (`l` lines with three ends become triangles), never reaches it.

use super::scan::Scan;

/// Compares corner by corner.
pub fn agrees_with_tobj(scan: &Scan) -> Result<(), String> {
    let stream = cleaned(scan);
    let options = tobj::LoadOptions::default();
    let (models, _) = tobj::load_obj_buf(&mut stream.as_bytes(), &options, |_| Err(tobj::LoadError::GenericFailure))
        .map_err(|e| e.to_string())?;
    let mut corners = scan.corners.iter();
    let mut faces = scan.faces.iter();
    for mesh in models.iter().map(|m| &m.mesh) {
        let count = if mesh.face_arities.is_empty() { mesh.indices.len() / 3 } else { mesh.face_arities.len() };
        for face in 0..count {
            let arity = mesh.face_arities.get(face).map_or(3, |n| *n as usize);
            let ours = faces.next().ok_or("one finds more faces")?;
            if ours.corners.len() != arity {
                return Err(format!("{} or {arity} corners in the face of line {}", ours.corners.len(), ours.line));
            }
        }
        for (k, index) in mesh.indices.iter().enumerate() {
            let corner = corners.next().ok_or("one finds more corners")?;
            let at = *index as usize * 3;
            let theirs = mesh.positions.get(at..at + 3).ok_or("a corner without a vertex")?;
            let ours = scan.positions.get(corner.v as usize).ok_or("a corner without a vertex")?;
            if theirs != ours.as_slice() {
                return Err(format!("corner {k} at {theirs:?} or at {:?}", ours.as_slice()));
            }
            let uv = corner.vt.and_then(|vt| scan.texcoords.get(vt as usize));
            if let Some(uv) = uv {
                let at = mesh.texcoord_indices.get(k).map_or(usize::MAX, |i| (*i as usize).saturating_mul(2));
                if mesh.texcoords.get(at..at.saturating_add(2)) != Some(uv.as_slice()) {
                    return Err(format!("texture vertex of corner {k}"));
                }
            }
        }
    }
    if corners.next().is_some() || faces.next().is_some() { Err("one finds fewer faces".to_owned()) } else { Ok(()) }
}

/// Vertices and faces alone, indices absolute.
fn cleaned(scan: &Scan) -> String {
    let mut text = String::with_capacity(scan.positions.len() * 40 + scan.corners.len() * 12);
    let (mut number, mut index) = (zmij::Buffer::new(), itoa::Buffer::new());
    let mut line = |key: &str, numbers: &[f64]| {
        text.push_str(key);
        for n in numbers {
            text.push(' ');
            text.push_str(number.format_finite(*n));
        }
        text.push('\n');
    };
    scan.positions.iter().for_each(|p| line("v", p.as_slice()));
    scan.texcoords.iter().for_each(|uv| line("vt", uv));
    for face in &scan.faces {
        text.push('f');
        for corner in scan.corners.get(face.corners.clone()).unwrap_or_default() {
            text.push(' ');
            text.push_str(index.format(u64::from(corner.v) + 1));
            if let Some(vt) = corner.vt {
                text.push('/');
                text.push_str(index.format(u64::from(vt) + 1));
            }
        }
        text.push('\n');
    }
    text
}
