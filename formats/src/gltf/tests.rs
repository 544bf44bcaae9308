use super::*;
use crate::garment_file;
use crate::picture::{Field, Scale};
use crate::sample::two_pieces;
use serde_json::Value;
use toile_garment::texture::{Colourway, Sheen};
use toile_garment::{Garment, Report, Vec2, Vec3, bundle};

/// The chunks as JSON and bytes.
fn open_glb(glb: &[u8]) -> (Value, Vec<u8>) {
    let chunks = container::split(glb).expect("container");
    (serde_json::from_slice(chunks.json).expect("JSON"), chunks.bin.expect("bin").to_vec())
}

fn close_glb(json: &Value, bin: &[u8]) -> Vec<u8> {
    container::join(json.to_string().as_bytes(), bin).expect("small")
}

fn floats(json: &Value, bin: &[u8], accessor: u64) -> (usize, Vec<f32>) {
    let a = &json["accessors"][accessor as usize];
    let v = &json["bufferViews"][a["bufferView"].as_u64().expect("view") as usize];
    let start = v["byteOffset"].as_u64().expect("offset") as usize;
    let len = v["byteLength"].as_u64().expect("length") as usize;
    let values = bin[start..start + len].chunks_exact(4).map(|c| f32::from_le_bytes(c.try_into().expect("4")));
    (start, values.collect())
}

fn attribute(json: &Value, mesh: usize, name: &str) -> u64 {
    json["meshes"][mesh]["primitives"][0]["attributes"][name].as_u64().expect("attribute")
}

/// The parts of a garment that a GLB carries.
fn without_body_mesh(mut garment: Garment) -> Garment {
    if garment.drape.is_some() {
        garment.stitched = None;
    }
    if let Some(body) = &mut garment.body {
        body.positions.clear();
        body.triangles.clear();
    }
    garment
}

#[test]
fn the_round_trip_gives_the_garment_back() {
    let garment = two_pieces();
    let glb = write_garment(&garment).expect("GLB");
    let read = read_garment_with_findings(&glb).expect("read");
    assert!(!read.edited && read.findings.is_empty());
    assert_eq!(read.garment, without_body_mesh(garment));
}

#[test]
fn same_garment_same_bytes() {
    let garment = two_pieces();
    let glb = write_garment(&garment).expect("GLB");
    assert_eq!(glb, write_garment(&garment).expect("GLB"));
    let again = read_garment(&glb).expect("read");
    assert_eq!(glb, write_garment(&again).expect("GLB"), "reading and writing changes nothing");
    let mut slower = garment.clone();
    slower.effects[0].cpu_seconds = 77.0;
    assert_eq!(glb, write_garment(&slower).expect("GLB"), "times stay out");
}

#[test]
fn nodes_positions_and_cloth_coordinates() {
    let garment = two_pieces();
    let (json, bin) = open_glb(&write_garment(&garment).expect("GLB"));
    assert_eq!(json["nodes"][0]["name"], "front");
    assert_eq!(json["meshes"][1]["extras"]["piece"], "back");
    assert_eq!(json["asset"]["extras"]["toile"]["kind"], "toile-garment");
    let drape = garment.drape.as_ref().expect("drape");
    let textures = garment.textures.as_ref().expect("textures");
    for mesh in 0..2 {
        let index = attribute(&json, mesh, "POSITION");
        let (_, p) = floats(&json, &bin, index);
        let want: Vec<f32> = drape.positions[mesh].iter().flat_map(|p| [p.x as f32, p.y as f32, p.z as f32]).collect();
        assert_eq!(p, want);
        for k in 0..3 {
            let column = || p.iter().skip(k).step_by(3).copied();
            let (lo, hi) = (column().fold(f32::MAX, f32::min), column().fold(f32::MIN, f32::max));
            assert_eq!(json["accessors"][index as usize]["min"][k].as_f64(), Some(f64::from(lo)));
            assert_eq!(json["accessors"][index as usize]["max"][k].as_f64(), Some(f64::from(hi)));
        }
        let (_, uv) = floats(&json, &bin, attribute(&json, mesh, "TEXCOORD_0"));
        for (got, [u, v]) in uv.chunks_exact(2).zip(&textures.pieces[mesh].uv_cloth) {
            assert_eq!(got, [*u as f32, 0.0 - *v as f32], "u right, v down");
        }
    }
    let info = &json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    let scale = &info["extensions"]["KHR_texture_transform"]["scale"];
    for (k, repeat) in [0.06, 0.04].into_iter().enumerate() {
        assert!((scale[k].as_f64().expect("scale") * repeat - 1.0).abs() < 1e-6);
    }
    assert_eq!(json["extensionsUsed"][0], "KHR_texture_transform");
    assert_eq!(json["materials"][0]["doubleSided"], true);
    assert_eq!(json["images"][0]["mimeType"], "image/png");
}

/// Viewers without the extension repeat the bitmap, too, and such a file is read back.
#[test]
fn coordinates_in_repeats_need_no_extension() {
    let garment = two_pieces();
    let wishes = Wishes { repeats: true, ..Wishes::default() };
    let glb = write_garment_with(&garment, &wishes).expect("GLB");
    let (json, bin) = open_glb(&glb);
    assert!(!json.to_string().contains("KHR_texture_transform"), "{json}");
    let textures = garment.textures.as_ref().expect("textures");
    let (_, uv) = floats(&json, &bin, attribute(&json, 0, "TEXCOORD_0"));
    for (got, [u, v]) in uv.chunks_exact(2).zip(&textures.pieces[0].uv_cloth) {
        assert!((f64::from(got[0]) - u / 0.06).abs() < 1e-5 && (f64::from(got[1]) + v / 0.04).abs() < 1e-5);
    }
    assert!(!read_garment_with_findings(&glb).expect("read").edited);
}

#[test]
fn cloth_without_a_texture_has_coordinates_and_a_material() {
    let garment = Garment { textures: None, ..two_pieces() };
    let (json, bin) = open_glb(&write_garment(&garment).expect("GLB"));
    assert_eq!(json["meshes"][0]["primitives"][0]["material"], 0);
    let rest = &garment.pieces[0].mesh.as_ref().expect("mesh").rest;
    let (_, uv) = floats(&json, &bin, attribute(&json, 0, "TEXCOORD_0"));
    // The warp is upright, and v counts downwards.
    let [a, b] = [0, 1].map(|k| Vec2::new(f64::from(uv[2 * k]), -f64::from(uv[2 * k + 1])));
    assert!(((b - a).norm() - (rest[1] - rest[0]).norm()).abs() < 1e-6, "metres");
    assert!(attribute(&json, 1, "TEXCOORD_1") > 0);
}

/// The views that are packed lie in a buffer of their own, and this program says why it does not read them.
#[test]
fn a_packed_file_is_smaller_and_is_refused_in_words() {
    let garment = two_pieces();
    let wishes = Wishes { squeezed: true, document: Carried::Nothing, ..Wishes::default() };
    let glb = write_garment_with(&garment, &wishes).expect("GLB");
    let (json, bin) = open_glb(&glb);
    let name = "EXT_meshopt_compression";
    assert_eq!(
        (&json["extensionsRequired"][0], &json["buffers"][1]["extensions"][name]["fallback"]),
        (&name.into(), &true.into())
    );
    assert_eq!(json["buffers"][0]["byteLength"].as_u64().expect("length").next_multiple_of(4), bin.len() as u64);
    let mut end = 0;
    for view in json["bufferViews"].as_array().expect("views") {
        let packed = &view["extensions"][name];
        let own = if packed.is_null() { view } else { packed };
        let [offset, length] = ["byteOffset", "byteLength"].map(|k| own[k].as_u64().expect("number"));
        assert!(offset >= end && offset % 4 == 0 && offset + length <= bin.len() as u64, "{view}");
        end = offset + length;
        if !packed.is_null() {
            let size = packed["count"].as_u64().zip(packed["byteStride"].as_u64()).map(|(n, s)| n * s);
            assert_eq!((size, &view["buffer"]), (view["byteLength"].as_u64(), &1.into()), "{view}");
        }
    }
    assert_eq!(glb, write_garment_with(&garment, &wishes).expect("GLB"));
    let told = read_garment(&glb).expect_err("packed").to_string();
    assert!(told.contains(name), "{told}");
}

/// Which zero `min` and `max` give is the processor's choice, and the text tells them apart.
#[test]
fn the_first_of_two_zeros_is_the_bound() {
    let bounds = |values: &[[f32; 1]]| {
        let (mut buffer, mut root) = (write::Buffer::default(), gltf_json::Root::default());
        let _ = buffer.plain(&mut root, values, true);
        [&root.accessors[0].min, &root.accessors[0].max]
            .map(|b| b.as_ref().map(ToString::to_string).unwrap_or_default())
    };
    assert_eq!(bounds(&[[0.0], [-0.0]]), ["[0.0]", "[0.0]"]);
    assert_eq!(bounds(&[[-0.0], [0.0]]), ["[-0.0]", "[-0.0]"]);
}

#[test]
fn normals_are_unit_smooth_over_the_seam_and_face_outwards() {
    let garment = two_pieces();
    let (json, bin) = open_glb(&write_garment(&garment).expect("GLB"));
    let normals: Vec<Vec<Vec3>> = (0..2)
        .map(|m| {
            let (_, n) = floats(&json, &bin, attribute(&json, m, "NORMAL"));
            n.chunks_exact(3).map(|n| Vec3::new(n[0].into(), n[1].into(), n[2].into())).collect()
        })
        .collect();
    for n in normals.iter().flatten() {
        assert!((n.norm() - 1.0).abs() < 1e-6, "{n:?}");
    }
    for stitch in garment.seams.iter().flat_map(|s| &s.stitches) {
        let (a, b) = (stitch.a, stitch.b);
        assert_eq!(
            normals[a.piece.index()][a.vertex as usize],
            normals[b.piece.index()][b.vertex as usize],
            "a crease at a welded seam"
        );
    }
    let drape = garment.drape.expect("drape");
    for (n, p) in normals[0].iter().zip(&drape.positions[0]) {
        assert!(n.dot(&Vec3::new(p.x, 0.0, p.z)) > 0.0, "front normals point out of the tube");
    }
}

#[test]
fn flat_and_folded_triangles_still_have_unit_normals() {
    let mut garment = two_pieces();
    // Everything in one plane, front and back exactly on each other: seam normals cancel.
    for p in garment.drape.as_mut().expect("drape").positions.iter_mut().flatten() {
        p.z = 0.0;
    }
    garment.drape.as_mut().expect("drape").positions[0][0] = Vec3::new(-0.15, 0.1, 0.0);
    let (json, bin) = open_glb(&write_garment(&garment).expect("GLB"));
    for m in 0..2 {
        let (_, n) = floats(&json, &bin, attribute(&json, m, "NORMAL"));
        assert!(n.chunks_exact(3).all(|n| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-5));
    }
}

#[test]
fn a_moved_vertex_is_found_and_the_stored_drape_kept() {
    let mut garment = two_pieces();
    garment.certificate = Some(toile_garment::garment::Certificate { passed: true, ..Default::default() });
    let whole = read_garment(&write_garment(&garment).expect("GLB")).expect("read");
    assert_eq!(whole.certificate, garment.certificate, "the shape is the one that was certified");
    let (json, mut bin) = open_glb(&write_garment(&garment).expect("GLB"));
    let (start, p) = floats(&json, &bin, attribute(&json, 0, "POSITION"));
    let vertex = 9;
    let y = p[vertex * 3 + 1] + 0.01;
    bin[start + vertex * 12 + 4..][..4].copy_from_slice(&y.to_le_bytes());
    let read = read_garment_with_findings(&close_glb(&json, &bin)).expect("read");
    assert!(read.edited);
    assert!(read.findings[0].message.contains("1 vertices moved") && read.findings[0].message.contains("10.000 mm"));
    assert_eq!(read.garment.drape_before_edit, garment.drape);
    assert_eq!(read.garment.certificate, None, "nobody certified the edited shape");
    let facts = inspect(&close_glb(&json, &bin)).expect("facts");
    assert_eq!((&facts["toile"]["edited"], &facts["toile"]["certificate_passed"]), (&true.into(), &Value::Null));
    let (old, new) = (garment.drape.expect("drape"), read.garment.drape.expect("drape"));
    assert_eq!(new.positions[0][vertex].y, f64::from(y));
    for (i, (a, b)) in old.positions.iter().flatten().zip(new.positions.iter().flatten()).enumerate() {
        assert_eq!(a == b, i != vertex, "only the moved vertex differs");
    }
    assert!(new.welded, "no seam was touched");
}

#[test]
fn a_torn_seam_is_no_longer_welded() {
    let garment = two_pieces();
    let stitch = garment.seams[0].stitches[1].a;
    let (json, mut bin) = open_glb(&write_garment(&garment).expect("GLB"));
    let (start, _) = floats(&json, &bin, attribute(&json, stitch.piece.index(), "POSITION"));
    bin[start + stitch.vertex as usize * 12..][..4].copy_from_slice(&0.5f32.to_le_bytes());
    let read = read_garment(&close_glb(&json, &bin)).expect("read");
    assert!(!read.drape.expect("drape").welded);
}

#[test]
fn node_transforms_are_applied() {
    let garment = two_pieces();
    let (mut json, bin) = open_glb(&write_garment(&garment).expect("GLB"));
    // A parent that lifts by 0.5 m above a child that turns by 90 degrees about y and doubles.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    json["nodes"][0]["rotation"] = serde_json::json!([0.0, half, 0.0, half]);
    json["nodes"][0]["scale"] = serde_json::json!([2.0, 2.0, 2.0]);
    let parent = serde_json::json!({ "translation": [0.0, 0.5, 0.0], "children": [0] });
    json["nodes"].as_array_mut().expect("nodes").push(parent);
    json["scenes"][0]["nodes"] = serde_json::json!([2, 1]);
    let read = read_garment(&close_glb(&json, &bin)).expect("read");
    let (old, new) = (garment.drape.expect("drape"), read.drape.expect("drape"));
    for (a, b) in old.positions[0].iter().zip(&new.positions[0]) {
        let want = Vec3::new(2.0 * a.z, 2.0 * a.y + 0.5, -2.0 * a.x);
        assert!((b - want).norm() < 1e-6, "{b:?} against {want:?}");
    }
    assert_eq!(old.positions[1], new.positions[1]);
}

/// The GLB as an editor saves it: mesh 0 is a soup of three vertices for each triangle, triangles backwards and renamed,
/// and its vertex 7 is 20 mm higher.
fn as_an_editor_saves(garment: &Garment) -> (Value, Vec<u8>) {
    let (mut json, mut bin) = open_glb(&write_garment(garment).expect("GLB"));
    let primitive = json["meshes"][0]["primitives"][0].clone();
    let mesh = garment.pieces[0].mesh.as_ref().expect("mesh");
    let order: Vec<u32> = mesh.triangles.iter().rev().flatten().copied().collect();
    let mut attributes = serde_json::Map::new();
    for name in ["POSITION", "TEXCOORD_0"] {
        let width = if name == "POSITION" { 3 } else { 2 };
        let (_, values) = floats(&json, &bin, primitive["attributes"][name].as_u64().expect("accessor"));
        let start = bin.len();
        for i in &order {
            for k in 0..width {
                let mut x = values[*i as usize * width + k];
                if name == "POSITION" && *i == 7 && k == 1 {
                    x += 0.02;
                }
                bin.extend_from_slice(&x.to_le_bytes());
            }
        }
        let views = json["bufferViews"].as_array_mut().expect("views");
        views.push(serde_json::json!({ "buffer": 0, "byteOffset": start, "byteLength": bin.len() - start }));
        let view = views.len() - 1;
        let accessors = json["accessors"].as_array_mut().expect("accessors");
        let kind = if width == 3 { "VEC3" } else { "VEC2" };
        accessors.push(serde_json::json!({ "bufferView": view, "componentType": 5126, "count": order.len(),
            "type": kind, "min": vec![0.0; width], "max": vec![0.0; width] }));
        attributes.insert(name.into(), (accessors.len() - 1).into());
    }
    json["meshes"][0]["primitives"][0] = serde_json::json!({ "attributes": attributes });
    json["nodes"][0]["name"] = "Front.001".into();
    json["meshes"][0]["name"] = "Front.001".into();
    json["buffers"][0]["byteLength"] = bin.len().into();
    (json, bin)
}

/// Vertex 7 of piece 0 is 20 mm higher, and its neighbour is where it was.
fn is_edited(read: &ReadGarment, garment: &Garment) {
    assert!(read.edited);
    let drape = |garment: &Garment| garment.drape.clone().expect("drape").positions.swap_remove(0);
    let (old, new) = (drape(garment), drape(&read.garment));
    assert!((new[7].y - old[7].y - 0.02).abs() < 1e-6);
    assert_eq!(old[8], new[8]);
}

#[test]
fn vertices_that_an_editor_sorted_and_split_are_matched_by_their_cloth() {
    let garment = two_pieces();
    let (json, bin) = as_an_editor_saves(&garment);
    is_edited(&read_garment_with_findings(&close_glb(&json, &bin)).expect("read"), &garment);
}

#[test]
fn a_glb_whose_document_an_editor_left_out_is_read_by_the_original() {
    let garment = two_pieces();
    let (mut json, bin) = as_an_editor_saves(&garment);
    let document = json["asset"]["extras"].take();
    let saved = close_glb(&json, &bin);
    assert_eq!(read_garment(&saved), Err(ReadError::NoDocument));
    let original = write_garment(&garment).expect("GLB");
    let stored = read_stored_garment(&original).expect("stored");
    is_edited(&read_shape_of(stored, &saved).expect("read"), &garment);
    // Files by name, as stages and commands read them.
    let text = bundle::to_value(&garment).expect("document").to_string();
    for document in [&original[..], text.as_bytes()] {
        let mut report = Report::default();
        let read = garment_file::read_by_document((&saved, "saved.glb"), (document, "original"), &mut report);
        let read = read.expect("read");
        assert_eq!((read.drape_before_edit, report.findings.len()), (garment.drape.clone(), 1));
    }
    let mut report = Report::default();
    let refused = garment_file::read_by_document((&saved, "saved.glb"), (&saved, "saved.glb"), &mut report);
    assert!(refused.expect_err("no document").hint.is_some_and(|h| h.contains("--document")));
    let refused = garment_file::read_by_document((text.as_bytes(), "g.json"), (&original, "g.glb"), &mut report);
    assert!(refused.expect_err("no GLB").message.contains("`g.json` is no GLB"));
    // Extras of nodes are kept by editors.
    json["nodes"][0]["extras"] = document;
    is_edited(&read_garment_with_findings(&close_glb(&json, &bin)).expect("read"), &garment);
}

#[test]
fn a_renamed_piece_or_another_mesh_is_refused_by_name() {
    let (mut json, bin) = open_glb(&write_garment(&two_pieces()).expect("GLB"));
    for key in ["nodes", "meshes"] {
        json[key][1]["name"] = "x".into();
        json[key][1]["extras"] = Value::Null;
    }
    let error = read_garment(&close_glb(&json, &bin)).expect_err("refused").to_string();
    assert!(error.contains("piece `back`"), "{error}");
    let (mut json, bin) = open_glb(&write_garment(&two_pieces()).expect("GLB"));
    json["asset"]["extras"] = Value::Null;
    assert_eq!(read_garment(&close_glb(&json, &bin)), Err(ReadError::NoDocument));
}

#[test]
fn no_path_leaves_the_machine() {
    let mut garment = two_pieces();
    garment.provenance.inputs[0].path = "/home/anna/patterns/skirt.dxf".into();
    garment.provenance.stages[0].params = serde_json::json!({ "file": "C:\\out\\garment.glb", "n": 3 });
    let plain = Wishes { document: Carried::Plain, ..Wishes::default() };
    let glb = write_garment_with(&garment, &plain).expect("GLB");
    let text = String::from_utf8_lossy(&glb);
    assert!(!text.contains("anna") && !text.contains("C:\\\\out"));
    let read = read_garment(&glb).expect("read");
    assert_eq!(read.provenance.inputs[0].path, "skirt.dxf");
    assert_eq!(read.provenance.stages[0].params, serde_json::json!({ "file": "garment.glb", "n": 3 }));
}

#[test]
fn refuses_to_write_what_is_not_there_or_not_finite() {
    let mut garment = two_pieces();
    garment.drape.as_mut().expect("drape").positions[1][2].z = f64::NAN;
    let error = write_garment(&garment).expect_err("NaN").to_string();
    assert!(error.contains("vertex 2 of piece `back`"), "{error}");
    garment.drape = None;
    garment.stitched = None;
    assert!(matches!(write_garment(&garment), Err(WriteError::Missing(_))));
    assert!(matches!(write_garment(&Garment::default()), Err(WriteError::Missing(_))));
}

#[test]
fn a_garment_without_textures_gets_a_plain_cloth() {
    let mut garment = two_pieces();
    garment.textures = None;
    let glb = write_garment(&garment).expect("GLB");
    let (json, _) = open_glb(&glb);
    assert_eq!(json["materials"].as_array().map(Vec::len), Some(1));
    assert!(json.get("extensionsUsed").is_none());
    assert_eq!(read_garment(&glb).expect("read"), without_body_mesh(garment));
}

#[test]
fn inspect_says_what_is_inside() {
    let facts = inspect(&write_garment(&two_pieces()).expect("GLB")).expect("facts");
    assert_eq!(facts["meshes"][0]["node"], "front");
    assert_eq!((facts["triangles"].as_u64(), facts["vertices"].as_u64()), (Some(48), Some(40)));
    assert!((facts["size_m"][0].as_f64().expect("width") - 0.3).abs() < 1e-6);
    assert_eq!(facts["toile"]["pieces"], serde_json::json!(["front", "back"]));
    assert_eq!(facts["toile"]["seams"], 2);
}

/// Two frames: moved as a whole, and lifted at one vertex.
fn in_motion() -> Garment {
    let mut garment = two_pieces();
    let base = garment.drape.clone().expect("drape").positions;
    let base: Vec<Vec<Vec3>> =
        base.iter().map(|p| p.iter().map(|p| p.map(|c| f64::from(c as f32))).collect()).collect();
    garment.drape.as_mut().expect("drape").positions = base.clone();
    let moved: Vec<Vec<Vec3>> =
        base.iter().map(|p| p.iter().map(|p| p + Vec3::new(0.5, 0.0, 0.25)).collect()).collect();
    let mut lifted = base.clone();
    lifted[0][1].y += 0.125;
    garment.animation = Some(toile_garment::animation::Animation {
        fps: 24.0,
        count: 3,
        frames: vec![base, moved, lifted],
        ..toile_garment::animation::Animation::default()
    });
    garment
}

#[test]
fn frames_are_morph_targets_that_a_viewer_plays() {
    let garment = in_motion();
    let glb = write_garment(&garment).expect("GLB");
    let (json, bin) = open_glb(&glb);
    for mesh in json["meshes"].as_array().expect("meshes") {
        assert_eq!(mesh["primitives"][0]["targets"].as_array().map(Vec::len), Some(3));
        assert_eq!(mesh["weights"], serde_json::json!([0.0, 0.0, 0.0]));
    }
    let sampler = &json["animations"][0]["samplers"][0];
    let (_, times) = floats(&json, &bin, sampler["input"].as_u64().expect("input"));
    assert_eq!(times, [0.0, 1.0 / 24.0, 2.0 / 24.0]);
    let (_, weights) = floats(&json, &bin, sampler["output"].as_u64().expect("output"));
    assert_eq!(weights, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let plain = Wishes { document: Carried::Plain, ..Wishes::default() };
    let (text, _) = open_glb(&write_garment_with(&garment, &plain).expect("GLB"));
    assert!(!text["asset"]["extras"]["toile"].to_string().contains("frames"), "the document does not repeat them");
    // Read as a moving body it gives the frames back.
    let moving = read_moving(&glb, 24.0).expect("motion");
    let frames = garment.animation.expect("frames").frames;
    for (read, frame) in moving.frames.iter().zip(&frames) {
        let flat: Vec<Vec3> = frame.iter().flatten().copied().collect();
        let most = read.iter().zip(&flat).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
        assert!(read.len() == flat.len() && most < 1e-6, "{most}");
    }
    assert_eq!(moving.frames.len(), 3);
}

#[test]
fn a_garment_in_motion_is_read_without_its_frames_and_says_so() {
    let read = read_garment_with_findings(&write_garment(&in_motion()).expect("GLB")).expect("read");
    assert!(!read.edited && read.garment.animation.is_none());
    assert_eq!(read.findings.iter().map(|f| f.code.as_str()).collect::<Vec<_>>(), ["animation-left-out"]);
}

#[test]
fn a_skin_turns_its_vertices_about_the_joint() {
    // One triangle, its last corner held by a joint at (0, 1, 0) that turns by 90° about z in a second.
    let numbers: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0];
    let weights: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let joints: [u8; 12] = [0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0];
    let mut bind = [0.0f32; 32];
    for k in 0..8 {
        bind[k % 4 * 5 + k / 4 * 16] = 1.0;
    }
    bind[16 + 13] = -1.0;
    let turn: [f32; 8] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5f32.sqrt(), 0.5f32.sqrt()];
    let mut bin = Vec::new();
    let mut views = Vec::new();
    for bytes in [
        &floats_of(&numbers)[..],
        &floats_of(&weights),
        &joints,
        &floats_of(&bind),
        &floats_of(&[0.0, 1.0]),
        &floats_of(&turn),
    ] {
        views.push(serde_json::json!({"buffer": 0, "byteOffset": bin.len(), "byteLength": bytes.len()}));
        bin.extend_from_slice(bytes);
    }
    let accessor = |view: usize, kind: u32, count: usize, form: &str| {
        serde_json::json!({"bufferView": view, "componentType": kind, "count": count, "type": form,
            "min": [0.0, 0.0, 0.0], "max": [1.0, 2.0, 0.0]})
    };
    let mut accessors = [
        accessor(0, 5126, 3, "VEC3"),
        accessor(1, 5126, 3, "VEC4"),
        accessor(2, 5121, 3, "VEC4"),
        accessor(3, 5126, 2, "MAT4"),
        accessor(4, 5126, 2, "SCALAR"),
        accessor(5, 5126, 2, "VEC4"),
    ];
    for a in accessors.iter_mut().skip(1) {
        let map = a.as_object_mut().expect("object");
        map.remove("min");
        map.remove("max");
    }
    accessors[4]["min"] = serde_json::json!([0.0]);
    accessors[4]["max"] = serde_json::json!([1.0]);
    let json = serde_json::json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]}, {"translation": [0.0, 1.0, 0.0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "WEIGHTS_0": 1, "JOINTS_0": 2}}]}],
        "skins": [{"joints": [1, 2], "inverseBindMatrices": 3}],
        "animations": [{"samplers": [{"input": 4, "output": 5}],
                        "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}]}],
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": bin.len()}]
    });
    let moving = read_moving(&close_glb(&json, &bin), 2.0).expect("motion");
    assert_eq!(moving.frames.len(), 3);
    assert!((moving.rest[2] - Vec3::new(0.0, 2.0, 0.0)).norm() < 1e-6);
    let half = 0.5f64.sqrt();
    assert!((moving.frames[1][2] - Vec3::new(-half, 1.0 + half, 0.0)).norm() < 1e-6, "{}", moving.frames[1][2]);
    assert!((moving.frames[2][2] - Vec3::new(-1.0, 1.0, 0.0)).norm() < 1e-6, "{}", moving.frames[2][2]);
    assert!((moving.frames[2][1] - Vec3::x()).norm() < 1e-6, "what the root holds stays");
}

fn floats_of(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

#[test]
fn a_glb_without_motion_is_refused_as_a_moving_body() {
    let glb = write_garment(&two_pieces()).expect("GLB");
    assert!(matches!(read_moving(&glb, 24.0), Err(ReadError::Damaged(_))));
}

#[test]
fn the_document_is_packed_plain_or_absent_and_reads_the_same() {
    let garment = two_pieces();
    let of = |document| write_garment_with(&garment, &Wishes { document, ..Wishes::default() }).expect("GLB");
    let [packed, plain, nothing] = [Carried::Packed, Carried::Plain, Carried::Nothing].map(of);
    assert!(packed.len() < plain.len(), "{} bytes packed, {} plain", packed.len(), plain.len());
    assert_eq!(read_garment(&packed).expect("packed"), read_garment(&plain).expect("plain"));
    assert_eq!(read_garment(&nothing), Err(ReadError::NoDocument));
    let (mut json, bin) = open_glb(&packed);
    json["asset"]["extras"]["toile"]["version"] = 99.into();
    let error = read_garment(&close_glb(&json, &bin)).expect_err("newer").to_string();
    assert!(error.contains("newer"), "{error}");
}

/// The look of a cloth is sheen, a normal map with its repeat, and colourways that share their bitmaps.
#[test]
fn looks_and_colourways_are_told_in_extensions() {
    let mut garment = two_pieces();
    let textures = garment.textures.as_mut().expect("textures");
    textures.materials[0].normal = textures.materials[0].image.clone();
    textures.materials[0].sheen = Some(Sheen { color: [0.2, 0.1, 0.0], roughness: 0.4 });
    textures.colourways = vec![Colourway { name: "navy".into(), colors: vec![[0.0, 0.0, 0.2]] }];
    let glb = write_garment(&garment).expect("GLB");
    let (json, _) = open_glb(&glb);
    let material = &json["materials"][0];
    assert_eq!(material["extensions"]["KHR_materials_sheen"]["sheenRoughnessFactor"], serde_json::json!(0.4_f32));
    let scale = &material["normalTexture"]["extensions"]["KHR_texture_transform"]["scale"];
    assert!((scale[0].as_f64().expect("scale") * 0.06 - 1.0).abs() < 1e-6);
    assert_eq!(json["images"].as_array().map(Vec::len), Some(1), "equal bitmaps lie in the file once");
    let names = &json["extensions"]["KHR_materials_variants"]["variants"];
    assert_eq!(names, &serde_json::json!([{ "name": "as sewn" }, { "name": "navy" }]));
    let mappings = &json["meshes"][1]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"];
    assert_eq!(mappings[1], serde_json::json!({ "material": 1, "variants": [1] }));
    let blue = json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"][2].as_f64();
    assert!((blue.expect("a colour") - 0.2).abs() < 1e-6);
    assert_eq!(json["extensionsUsed"].as_array().map(Vec::len), Some(3));
    assert_eq!(read_garment(&glb).expect("read"), without_body_mesh(garment));
}

#[test]
fn what_is_wished_stands_beside_the_pieces_and_reading_goes_on() {
    let mut garment = two_pieces();
    garment.fabrics.insert(String::new(), crate::fabric::read(FABRIC, "f.toml").expect("fabric"));
    let values = garment.pieces.iter().map(|p| vec![0.5; p.mesh.as_ref().map_or(0, |m| m.rest.len())]).collect();
    let field = Field { key: "ease", name: "gap", unit: "mm", scale: Scale::FromZero, values, limit: 1.0 };
    let wishes = Wishes { body: true, thickness: true, lines: true, field: Some(&field), ..Wishes::default() };
    let glb = write_garment_with(&garment, &wishes).expect("GLB");
    let (json, bin) = open_glb(&glb);
    let names: Vec<&str> = json["nodes"].as_array().expect("nodes").iter().filter_map(|n| n["name"].as_str()).collect();
    assert_eq!(names, ["front", "back", "front wrong side", "back wrong side", "seams", "body"]);
    assert_eq!(json["meshes"][4]["primitives"][0]["mode"], 1, "lines");
    // The wrong side lies a thickness behind the right one.
    let [front, behind] = [0, 2].map(|mesh| floats(&json, &bin, attribute(&json, mesh, "POSITION")).1);
    let apart = |v: usize, k: usize| f64::from(front[3 * v + k] - behind[3 * v + k]);
    let away = |v: usize| (0..3).map(|k| apart(v, k) * apart(v, k)).sum::<f64>().sqrt();
    assert!((0..front.len() / 3).all(|v| (away(v) - 0.5e-3).abs() < 1e-6));
    assert!(json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"].is_u64());
    assert_eq!(read_garment(&glb).expect("read"), without_body_mesh(garment));
}

/// Every texture of a material names coordinates that its primitives have, and a normal map comes with tangents.
#[test]
fn every_primitive_has_what_the_textures_of_its_material_name() {
    let mut garment = two_pieces();
    garment.fabrics.insert(String::new(), crate::fabric::read(FABRIC, "f.toml").expect("fabric"));
    let textures = garment.textures.as_mut().expect("textures");
    textures.materials[0].normal = textures.materials[0].image.clone();
    let wishes = Wishes { body: true, thickness: true, lines: true, ..Wishes::default() };
    let (json, bin) = open_glb(&write_garment_with(&garment, &wishes).expect("GLB"));
    let mut textured = 0;
    for (k, mesh) in json["meshes"].as_array().expect("meshes").iter().enumerate() {
        let primitive = &mesh["primitives"][0];
        let material = &json["materials"][primitive["material"].as_u64().expect("material") as usize];
        let bitmaps = [&material["pbrMetallicRoughness"]["baseColorTexture"], &material["normalTexture"]];
        for bitmap in bitmaps.into_iter().filter(|b| b.is_object()) {
            let name = format!("TEXCOORD_{}", bitmap["texCoord"].as_u64().unwrap_or(0));
            assert!(primitive["attributes"][&name].is_u64(), "mesh {k} has no {name}");
            textured += 1;
        }
        if !material["normalTexture"].is_object() {
            continue;
        }
        let tangents = floats(&json, &bin, attribute(&json, k, "TANGENT")).1;
        let normals = floats(&json, &bin, attribute(&json, k, "NORMAL")).1;
        for (t, n) in tangents.chunks_exact(4).zip(normals.chunks_exact(3)) {
            let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
            assert!((dot(&t[..3], &t[..3]) - 1.0).abs() < 1e-5 && t[3].abs() == 1.0, "{t:?}");
            assert!(dot(&t[..3], n).abs() < 1e-5, "a tangent lies across its normal");
        }
        // The weft lies to the right of the warp, and on the wrong side to the left of it.
        let side = if k < 2 { 1.0 } else { -1.0 };
        assert!(tangents.chunks_exact(4).take(20).all(|t| t[3] == side), "mesh {k}");
    }
    assert_eq!(textured, 8, "both bitmaps on both sides of both pieces");
}

const FABRIC: &str = "name = \"t\"\nareal_mass = \"150 g/m2\"\nthickness = \"0.5 mm\"\nfriction = 0.3\n\
    [linear]\nstretch_warp = \"500 N/m\"\nstretch_weft = \"300 N/m\"\nshear = \"40 N/m/rad\"\n\
    bending = \"1e-5 N.m\"\n";
