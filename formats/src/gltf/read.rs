//! The garment from a GLB alone, with the 3D shape as it stands there now.

use super::codes;
use super::geometry::{Placed, Sound, open, placed};
use super::{ReadError, check};
use gltf_json as json;
use json::extras::RawValue;
use serde::Deserialize;
use std::collections::BTreeMap;
use toile_garment::garment::Shape;
use toile_garment::texture::Image;
use toile_garment::{Diagnostic, Garment, Piece, Vec3};

/// Vertices that moved less than this were only rounded to single precision, metres.
const ROUNDING: f64 = 1e-6;
/// How far the cloth coordinates of a vertex may have been rounded on their way through an editor, metres.
const UV_ROUNDING: f64 = 2e-5;

/// A garment and how it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadGarment {
    /// The garment. When its 3D shape was edited after the export, `drape` is the edited shape and
    /// `drape_before_edit` the stored one; the certificate of the stored one is gone.
    pub garment: Garment,
    /// Was the 3D shape edited?
    pub edited: bool,
    /// Notes, e.g. how far vertices were moved.
    pub findings: Vec<Diagnostic>,
}

/// Reads a garment from a GLB that [`super::write_garment`] made, as it is now.
///
/// The body's mesh does not ride in a GLB: the body comes back with name, measures and digest only.
///
/// # Errors
/// See [`ReadError`].
pub fn read_garment(bytes: &[u8]) -> Result<Garment, ReadError> {
    read_garment_with_findings(bytes).map(|r| r.garment)
}

/// Reads like [`read_garment`], and gives the findings, too.
///
/// # Errors
/// See [`ReadError`].
pub fn read_garment_with_findings(bytes: &[u8]) -> Result<ReadGarment, ReadError> {
    let sound = open(bytes)?;
    let garment = stored(&sound)?;
    with_shape(garment, &sound)
}

/// Reads the garment that was stored in a GLB, whatever became of the shape there.
///
/// # Errors
/// See [`ReadError`].
pub fn read_stored_garment(bytes: &[u8]) -> Result<Garment, ReadError> {
    stored(&open(bytes)?)
}

/// Gives a garment the 3D shape of a GLB, which need not hold a document.
///
/// # Errors
/// See [`ReadError`].
pub fn read_shape_of(garment: Garment, bytes: &[u8]) -> Result<ReadGarment, ReadError> {
    fits(&garment)?;
    with_shape(garment, &open(bytes)?)
}

fn stored(sound: &Sound<'_>) -> Result<Garment, ReadError> {
    let mut garment = document(sound)?;
    restore_images(&mut garment, sound)?;
    fits(&garment)?;
    Ok(garment)
}

fn with_shape(mut garment: Garment, sound: &Sound<'_>) -> Result<ReadGarment, ReadError> {
    let (edited, mut findings) = take_shape(&mut garment, &placed(sound)?)?;
    if let Some(animation) = garment.animation.take() {
        let message = format!("the {} frames of the motion stay in the GLB and were not read back", animation.count);
        findings.push(Diagnostic::info(codes::ANIMATION_LEFT_OUT, message));
    }
    Ok(ReadGarment { garment, edited, findings })
}

/// The text of the stored document, if there is one.
///
/// `export-gltf` puts it into the extras of the asset. Editors keep extras of scenes and nodes, so these count, too.
pub fn document_text(document: &gltf::Document) -> Option<Box<RawValue>> {
    #[derive(Deserialize)]
    struct Extras {
        toile: Option<Box<RawValue>>,
    }
    let root = document.as_json();
    let places = std::iter::once(&root.asset.extras)
        .chain(root.scenes.iter().map(|s| &s.extras))
        .chain(root.nodes.iter().map(|n| &n.extras));
    places.flatten().find_map(|extras| serde_json::from_str::<Extras>(extras.get()).ok()?.toile)
}

fn document(sound: &Sound<'_>) -> Result<Garment, ReadError> {
    let text = document_text(&sound.document).ok_or(ReadError::NoDocument)?;
    super::document::read(text.get()).map_err(ReadError::Document)
}

/// The remedy for an edit that did more than move vertices.
const MOVE_ONLY: &str = "an edit moves vertices, and does not cut, subdivide or remesh. To shorten a hem, move its rows of \
                         vertices up, or cut a band off with the stage `alter`";

/// Images lie in the GLB as images of their own.
fn restore_images(garment: &mut Garment, sound: &Sound<'_>) -> Result<(), ReadError> {
    let root = sound.document.as_json();
    for (i, material) in garment.textures.iter_mut().flat_map(|t| &mut t.materials).enumerate() {
        let made = root.materials.get(i);
        let color = made.and_then(|m| m.pbr_metallic_roughness.base_color_texture.as_ref()).map(|t| t.index);
        let normal = made.and_then(|m| m.normal_texture.as_ref()).map(|t| t.index);
        for (image, texture) in [(&mut material.image, color), (&mut material.normal, normal)] {
            let Some(image) = image.as_mut().filter(|i| i.bytes.is_empty()) else { continue };
            image.bytes = texture.and_then(|t| image_bytes(root, sound.bin, t)).ok_or_else(|| {
                ReadError::Document(format!("an image of material `{}` is not in the file", material.name))
            })?;
            check_kind(image, &material.name)?;
        }
    }
    Ok(())
}

fn image_bytes(root: &json::Root, bin: &[u8], texture: json::Index<json::Texture>) -> Option<Vec<u8>> {
    let texture = root.textures.get(texture.value())?;
    let view = root.images.get(texture.source.value())?.buffer_view?;
    let (start, length, _) = check::view(root, view.value()).ok()?;
    bin.get(start..start.checked_add(length)?).map(<[u8]>::to_vec)
}

fn check_kind(image: &Image, material: &str) -> Result<(), ReadError> {
    let known = match image.mime.as_str() {
        "image/png" => image.bytes.starts_with(b"\x89PNG\r\n\x1a\n"),
        "image/jpeg" => image.bytes.starts_with(&[0xff, 0xd8, 0xff]),
        _ => false,
    };
    if known {
        Ok(())
    } else {
        Err(ReadError::Document(format!("the image of material `{material}` is no {}", image.mime)))
    }
}

/// Lists that the bundle does not compare with the meshes.
fn fits(garment: &Garment) -> Result<(), ReadError> {
    let vertices = |piece: usize| garment.pieces.get(piece).and_then(|p| p.mesh.as_ref()).map_or(0, |m| m.rest.len());
    if let Some(textures) = &garment.textures {
        let whole = textures.pieces.len() == garment.pieces.len()
            && textures.pieces.iter().enumerate().all(|(i, t)| {
                (t.material as usize) < textures.materials.len()
                    && t.uv_cloth.len() == vertices(i)
                    && t.uv_packed.len() == vertices(i)
            });
        if !whole {
            return Err(ReadError::Document("its texture coordinates do not fit its meshes".to_owned()));
        }
    }
    let held = garment.pins.iter().map(|p| p.vertex).chain(garment.loads.iter().map(|l| l.vertex));
    if held.into_iter().any(|v| v.vertex as usize >= vertices(v.piece.index())) {
        return Err(ReadError::Document("a pin or load names a vertex that is not there".to_owned()));
    }
    Ok(())
}

/// Compares the shape in the GLB with the stored one and takes what was moved.
fn take_shape(garment: &mut Garment, placed: &[Placed]) -> Result<(bool, Vec<Diagnostic>), ReadError> {
    let Some(stored) = garment.drape.clone().or_else(|| garment.stitched.clone()) else {
        return Err(ReadError::Document("it holds no positions in 3D".to_owned()));
    };
    let mut shape = stored;
    let mut findings = Vec::new();
    for (i, piece) in garment.pieces.iter().enumerate() {
        let there = vertices_of(garment, i, piece, placed)?;
        let mut moved: (usize, f64) = (0, 0.0);
        for (old, new) in shape.positions[i].iter_mut().zip(there) {
            let distance = (new - *old).norm();
            if distance > ROUNDING {
                moved = (moved.0 + 1, moved.1.max(distance));
                *old = new;
            }
        }
        if moved.0 > 0 {
            let message = format!(
                "piece `{}`: {} vertices moved after the export, by {:.3} mm at most",
                piece.name,
                moved.0,
                moved.1 * 1e3
            );
            findings.push(Diagnostic::info(codes::SHAPE_EDITED, message));
        }
    }
    let edited = !findings.is_empty();
    if edited {
        close_seams(garment, &mut shape);
        garment.reshape(shape);
    }
    Ok((edited, findings))
}

/// The positions of a piece in the order of its mesh.
fn vertices_of(garment: &Garment, i: usize, piece: &Piece, placed: &[Placed]) -> Result<Vec<Vec3>, ReadError> {
    let fail = |what: String| ReadError::Geometry(format!("piece `{}`: {what}", piece.name));
    let found = mesh_of(piece, placed).map_err(fail)?;
    let mesh = piece.mesh.as_ref().ok_or_else(|| fail("it has no mesh in the document".to_owned()))?;
    if found.triangles == mesh.triangles && found.positions.len() == mesh.rest.len() {
        return Ok(found.positions.clone());
    }
    // An editor splits and sorts vertices; the cloth coordinates say which is which.
    let cloth = garment.textures.as_ref().and_then(|t| t.pieces.get(i)).map(|t| t.uv_cloth.as_slice());
    match (&found.uv, cloth) {
        (Some(uv), Some(cloth)) => {
            let stored = garment.drape.as_ref().or(garment.stitched.as_ref()).and_then(|s| s.positions.get(i));
            let stored = stored.map_or(&[][..], Vec::as_slice);
            let in_metres = by_cloth(&found.positions, uv, cloth, stored);
            let repeat = repeat_of(garment, i).filter(|_| in_metres.is_err());
            // The file may count in repeats of the bitmap.
            let scaled = |[u, v]: [f64; 2]| uv.iter().map(|p| [p[0] * u, p[1] * v]).collect::<Vec<_>>();
            let again = repeat.and_then(|r| by_cloth(&found.positions, &scaled(r), cloth, stored).ok());
            again.map_or(in_metres, Ok).map_err(fail)
        }
        _ => Err(fail(format!(
            "the file has {} vertices in another order, the document {}, and there are no texture coordinates to match \
             them by; move vertices only, and keep their number and order",
            found.positions.len(),
            mesh.rest.len()
        ))),
    }
}

/// The repeat of the bitmap of a piece, metres.
fn repeat_of(garment: &Garment, piece: usize) -> Option<[f64; 2]> {
    let textures = garment.textures.as_ref()?;
    let material = textures.materials.get(textures.pieces.get(piece)?.material as usize)?;
    (material.image.is_some() || material.normal.is_some()).then_some(material.repeat)
}

/// The mesh of a piece: by node name, else by mesh name, else by the name in the extras.
fn mesh_of<'p>(piece: &Piece, placed: &'p [Placed]) -> Result<&'p Placed, String> {
    let ways: [fn(&Placed) -> Option<&str>; 3] =
        [|p| Some(p.node.as_str()), |p| Some(p.mesh.as_str()), |p| p.piece.as_deref()];
    for way in ways {
        let mut found = placed.iter().filter(|p| way(p) == Some(piece.name.as_str()));
        match (found.next(), found.next()) {
            (Some(_), Some(_)) => return Err("two nodes of the file have its name".to_owned()),
            (Some(one), None) => return Ok(one),
            (None, _) => {}
        }
    }
    Err("no node of the file has its name; keep every piece an object of its own, under its name".to_owned())
}

/// Vertices matched by where they lie on the cloth.
///
/// An editor that welds the legs of a dart keeps one cloth coordinate of two: the other vertex goes with the one that lay
/// at its place in the `stored` shape.
fn by_cloth(positions: &[Vec3], uv: &[[f64; 2]], cloth: &[[f64; 2]], stored: &[Vec3]) -> Result<Vec<Vec3>, String> {
    // A grid of cells somewhat larger than the tolerance: a match lies in the cell or beside it.
    const CELL: f64 = 4.0 * UV_ROUNDING;
    let cell = |[u, v]: [f64; 2]| ((u / CELL).floor() as i64, (v / CELL).floor() as i64);
    let mut grid: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    for (i, p) in cloth.iter().enumerate() {
        grid.entry(cell(*p)).or_default().push(i);
    }
    let mut out: Vec<Option<Vec3>> = vec![None; cloth.len()];
    for (position, [u, v]) in positions.iter().zip(uv) {
        let at = [*u, -*v];
        let (cu, cv) = cell(at);
        let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| (cu.saturating_add(i), cv.saturating_add(j))));
        let distance = |i: &usize| (cloth[*i][0] - at[0]).abs().max((cloth[*i][1] - at[1]).abs());
        let nearest = around
            .filter_map(|c| grid.get(&c))
            .flatten()
            .filter(|i| distance(i) <= UV_ROUNDING)
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(i) = nearest else {
            return Err(format!("a vertex at ({:.2}, {:.2}) mm of cloth is new; {MOVE_ONLY}", u * 1e3, -v * 1e3));
        };
        match &out[*i] {
            Some(other) if (other - position).norm() > ROUNDING => {
                return Err(format!("vertex {i} was torn into two places; {MOVE_ONLY}"));
            }
            _ => out[*i] = Some(*position),
        }
    }
    let place = |p: &Vec3| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
    let there: BTreeMap<[u64; 3], Vec3> =
        stored.iter().zip(&out).filter_map(|(s, found)| Some((place(s), (*found)?))).collect();
    for (found, s) in out.iter_mut().zip(stored) {
        *found = found.or_else(|| there.get(&place(s)).copied());
    }
    let lost = out.iter().filter(|p| p.is_none()).count();
    out.into_iter().collect::<Option<Vec<_>>>().ok_or_else(|| format!("{lost} vertices are gone; {MOVE_ONLY}"))
}

/// Sewn vertices that still lie together are made bit-equal again; if some do not, the shape is no longer welded.
fn close_seams(garment: &Garment, shape: &mut Shape) {
    if !shape.welded {
        return;
    }
    // Every vertex follows the first of its stitch; rounds until nothing changes close chains of stitches.
    for _ in 0..8 {
        let mut changed = false;
        for stitch in garment.seams.iter().flat_map(|s| &s.stitches) {
            let (a, b) = (stitch.a, stitch.b);
            let (pa, pb) = (
                shape.positions[a.piece.index()][a.vertex as usize],
                shape.positions[b.piece.index()][b.vertex as usize],
            );
            if pa == pb {
                continue;
            }
            if (pa - pb).norm() > 4.0 * ROUNDING {
                shape.welded = false;
                continue;
            }
            shape.positions[b.piece.index()][b.vertex as usize] = pa;
            changed = true;
        }
        if !changed {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_welded_vertex_goes_with_the_one_that_lay_at_its_place() {
        let (cloth, stored) = ([[0.0, 0.0], [0.1, 0.0], [0.2, 0.0]], [Vec3::zeros(), Vec3::zeros(), Vec3::x()]);
        let moved = [Vec3::new(0.0, 0.0, 0.5), Vec3::new(1.0, 0.0, 0.5)];
        let found = by_cloth(&moved, &[[0.0, 0.0], [0.2, 0.0]], &cloth, &stored).expect("matched");
        assert_eq!(found, [moved[0], moved[0], moved[1]]);
        // The third vertex lay alone, so nothing says where it went.
        assert!(by_cloth(&moved[..1], &[[0.0, 0.0]], &cloth, &stored).is_err());
    }
}
