use super::*;
use crate::export_gltf::{ExportGltf, ExportGltfParams};
use crate::export_obj::{ExportObj, ExportObjParams};
use crate::texture::{Texture, TextureParams};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use toile_formats::gltf;
use toile_garment::mesh::ChainKind;
use toile_garment::{Report, Vec2};
use toile_stage_api::{FileError, Files};

#[derive(Default)]
struct Memory(BTreeMap<PathBuf, Vec<u8>>);

impl Files for Memory {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let missing = || FileError::Missing { path: path.display().to_string(), reason: "not there".into() };
        self.0.get(path).cloned().ok_or_else(missing)
    }
    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(self.0.get(path).cloned())
    }
    fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        self.0.insert(path.to_owned(), bytes.to_vec());
        Ok(())
    }
}

const FABRIC: &str = "name = \"t\"\nareal_mass = \"150 g/m2\"\nthickness = \"0.5 mm\"\nfriction = 0.3\n[isotropic]\n\
    stretch = \"500 N/m\"\npoisson = 0.3\nbending = \"10 uN.m\"\n";
/// A square of four vertices, level, z up; one vertex is unused.
const SQUARE: &str = "v 0 0 1\nv 1 0 1\nv 7 7 7\nv 1 2 1\nv 0 2 1\nvt 0 0\nvt 1 0\nvt 1 2\nvt 0 2\n\
    f 1/1 2/2 4/3\nf 1/1 4/3 5/4\n";

fn run<S: Stage>(
    stage: &S,
    params: &S::Params,
    garment: Garment,
    files: &mut Memory,
) -> Result<(Garment, Report), StageError> {
    let mut report = Report::default();
    let cancel = AtomicBool::new(false);
    let mut cx = StageContext { report: &mut report, progress: &mut (), files, cancel: &cancel, seed: 0, threads: 1 };
    let garment = stage.run(params, garment, &mut cx)?;
    Ok((garment, report))
}

fn files(pairs: &[(&str, &str)]) -> Memory {
    let fabric = [("f.toml", FABRIC)];
    Memory(pairs.iter().chain(&fabric).map(|(n, t)| (PathBuf::from(n), t.as_bytes().to_vec())).collect())
}

fn params(toml: &str) -> ImportMeshParams {
    toml::from_str(&format!("cloth = \"c.obj\"\nfabric = \"f.toml\"\n{toml}")).expect("parameters")
}

fn import(toml: &str, pairs: &[(&str, &str)]) -> Result<(Garment, Report), StageError> {
    run(&ImportMesh, &params(toml), Garment::default(), &mut files(pairs))
}

fn mesh(garment: &Garment) -> &toile_garment::mesh::PieceMesh {
    garment.pieces[0].mesh.as_ref().expect("mesh")
}

/// A quarter of a tube of radius 1, in file order from the top.
fn curved() -> String {
    let mut text = String::new();
    for i in 0..=8u32 {
        let a = f64::from(i) / 8.0 * std::f64::consts::FRAC_PI_2;
        for y in [2.0, 1.0] {
            text += &format!("v {} {y} {}\n", libm::sin(a), libm::cos(a));
        }
    }
    for i in 0..8 {
        text += &format!("f {} {} {} {}\n", 2 * i + 1, 2 * i + 2, 2 * i + 4, 2 * i + 3);
    }
    text
}

#[test]
fn z_up_keeps_order_and_turns_axes_both_ways() {
    let pairs = [("c.obj", SQUARE), ("p.txt", "# held\n0\n1 1 0 0.5\n"), ("l.txt", "3 0 0 -2\n")];
    let (garment, report) = import("up = \"z\"\npins = \"p.txt\"\nloads = \"l.txt\"", &pairs).expect("garment");
    let start = garment.stitched.as_ref().expect("start");
    assert_eq!(start.positions[0].len(), 5, "the unused vertex stays");
    assert_eq!(start.positions[0][3], Vec3::new(1.0, 1.0, -2.0));
    assert!(report.findings.iter().any(|f| f.code == "vertices-unused" && f.message.contains("1 vertices")));
    assert_eq!(mesh(&garment).triangles, vec![[0, 1, 3], [0, 3, 4]]);
    assert_eq!(garment.pins[0].at, Vec3::new(0.0, 1.0, 0.0));
    assert_eq!(garment.pins[1].at, Vec3::new(1.0, 0.5, 0.0));
    assert_eq!(garment.loads[0].force, Vec3::new(0.0, -2.0, 0.0), "down");

    let mut draped = garment.clone();
    draped.reactions = vec![Vec3::new(0.0, 3.0, 0.0), Vec3::new(1.0, 0.0, -2.0)];
    let mut disk = Memory::default();
    let out = ExportObjParams { file: "o.obj".into(), reactions: Some("r.json".into()), up: None };
    run(&ExportObj, &out, draped, &mut disk).expect("written");
    let again = obj::read(&disk.0[Path::new("o.obj")], "o.obj").expect("OBJ");
    let first = obj::read(SQUARE.as_bytes(), "c.obj").expect("OBJ");
    assert_eq!((again.positions, again.triangles), (first.positions, first.triangles));
    let json: serde_json::Value = serde_json::from_slice(&disk.0[Path::new("r.json")]).expect("JSON");
    assert_eq!(json["pins"][0]["force_N"], serde_json::json!([0.0, -0.0, 3.0]));
    assert_eq!(json["pins"][1]["force_N"], serde_json::json!([1.0, 2.0, 0.0]));
    assert_eq!((&json["pins"][1]["index"], &json["unit"]), (&serde_json::json!(1), &serde_json::json!("N")));
    let missing = run(&ExportObj, &out, garment, &mut disk).expect_err("no drape yet");
    assert!(matches!(missing, StageError::Parameter(_)));
}

#[test]
fn a_flat_mesh_lies_on_its_grain() {
    // Level, z up: weft along x, warp along y, as `vt` of the same file says.
    for rest in ["positions", "uv"] {
        let (garment, _) = import(&format!("up = \"z\"\nrest = \"{rest}\""), &[("c.obj", SQUARE)]).expect("garment");
        let m = mesh(&garment);
        assert!(m.rest_corners.is_none());
        assert_eq!(m.rest[1] - m.rest[0], Vec2::new(1.0, 0.0), "{rest}");
        assert_eq!(m.rest[4] - m.rest[0], Vec2::new(0.0, 2.0), "{rest}");
        assert!((m.area() - 2.0).abs() < 1e-12);
    }
    // Upright, y up: warp up.
    let upright = "v 0 0 0\nv 2 0 0\nv 2 3 0\nf 1 2 3\n";
    let (garment, _) = import("", &[("c.obj", upright)]).expect("garment");
    assert_eq!(mesh(&garment).rest[2] - mesh(&garment).rest[0], Vec2::new(2.0, 3.0));
}

#[test]
fn a_curved_rest_shape_keeps_every_edge_length() {
    let text = curved();
    let (garment, _) = import("", &[("c.obj", &text)]).expect("garment");
    let m = mesh(&garment);
    let start = &garment.stitched.as_ref().expect("start").positions[0];
    assert_eq!(m.rest_corners.as_ref().map(Vec::len), Some(m.triangles.len()));
    for (t, corners) in m.triangles.iter().enumerate() {
        let rest = m.rest_triangle(t).expect("rest");
        assert!((rest[1] - rest[0]).perp(&(rest[2] - rest[0])) > 0.0);
        for k in 0..3 {
            let (a, b) = (corners[k] as usize, corners[(k + 1) % 3] as usize);
            let (flat, real) = ((rest[(k + 1) % 3] - rest[k]).norm(), (start[b] - start[a]).norm());
            assert!((flat - real).abs() < 1e-14, "{flat} {real}");
            // The tube's axis is upright: the warp runs along it.
            if (start[b] - start[a]).x == 0.0 && (start[b] - start[a]).z == 0.0 {
                assert!((rest[(k + 1) % 3] - rest[k]).x.abs() < 1e-12);
            }
        }
    }
    let outline = m.outline().expect("outline");
    assert_eq!((outline.vertices.len(), outline.kind), (18, ChainKind::Outline));
    // The document holds it, and so does a GLB.
    let mut disk = Memory::default();
    let glb = ExportGltfParams { file: "g.glb".into(), ..ExportGltfParams::default() };
    run(&ExportGltf, &glb, garment.clone(), &mut disk).expect("GLB");
    assert_eq!(gltf::read_garment(&disk.0[Path::new("g.glb")]).expect("read"), garment);
}

#[test]
fn mirrored_and_cut_texture_layouts_keep_their_lengths() {
    // The second triangle is mirrored in the texture plane.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 5 0\nvt 4 1\nvt 5 1\n\
        f 1/1 2/2 3/3\nf 1/4 3/5 4/6\n";
    let (garment, report) = import("rest = \"uv\"", &[("c.obj", text)]).expect("garment");
    assert!(report.findings.iter().any(|f| f.code == "uv-mirrored"));
    let m = mesh(&garment);
    assert!(m.rest_corners.is_some() && (m.area() - 1.0).abs() < 1e-12);
    let plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let error = import("rest = \"uv\"", &[("c.obj", plain)]).expect_err("no vt");
    assert!(error.to_string().contains("mesh-without-uv"));
}

#[test]
fn flat_triangles_are_left_out_and_counted() {
    let text = SQUARE.to_owned() + "f 1/1 2/2 2/2\nf 1/1 2/2 1/1\n";
    let (garment, report) = import("up = \"z\"", &[("c.obj", &text)]).expect("garment");
    assert_eq!(mesh(&garment).triangles.len(), 2);
    assert!(report.findings.iter().any(|f| f.code == "triangles-flat" && f.message.contains(": 2 ")));
}

#[test]
fn repeated_triangles_are_refused() {
    let twice = format!("{SQUARE}f 2/2 4/3 1/1\n");
    let Err(StageError::Input(errors)) = import("", &[("c.obj", &twice)]) else { panic!("taken") };
    assert_eq!(errors[0].code, "triangles-double");
    assert!(errors[0].message.contains("number 3"), "{}", errors[0].message);
}

#[test]
fn stitches_become_a_seam() {
    let (garment, _) = strips("0 8\n1,9\n").expect("garment");
    let seam = &garment.seams[0];
    assert_eq!(seam.stitches.len(), 2);
    assert_eq!((seam.stitches[1].a.vertex, seam.stitches[1].b.vertex), (1, 9));
    assert!(!garment.stitched.expect("start").welded);
}

#[test]
fn ends_of_an_edge_that_are_sewn_to_one_point_are_told_with_their_lines() {
    // By one stitch, by two, and by three in a row.
    for (stitches, ends, lines) in [
        ("0 8\n1 2\n", "1 and 2", "lines 2"),
        ("# rail\n0 8\n1 8\n", "0 and 1", "lines 2, 3"),
        ("2 9\n3 10\n9 10\n", "2 and 3", "lines 1, 2"),
    ] {
        let Err(StageError::Input(found)) = strips(stitches) else { panic!("{stitches} is refused as input") };
        let told = &found[0];
        assert_eq!(told.code, "vertex-list");
        assert!(told.message.contains(ends) && told.message.contains(lines), "{told:?}");
        assert_eq!(told.source.as_ref().map(|s| s.file.as_str()), Some("s.txt"));
    }
}

/// Two strips of four vertices a side, one over the other, with these stitches.
fn strips(stitches: &str) -> Result<(Garment, Report), StageError> {
    let mut cloth = String::new();
    for z in [0.0, 0.05] {
        (0..8).for_each(|k| cloth += &format!("v {} {} {z}\n", f64::from(k / 4) * 0.1, f64::from(k % 4) * 0.1));
    }
    for first in [1, 9] {
        for k in first..first + 3 {
            cloth += &format!("f {k} {} {}\nf {k} {} {}\n", k + 4, k + 5, k + 5, k + 1);
        }
    }
    import("stitches = \"s.txt\"", &[("c.obj", &cloth), ("s.txt", stitches)])
}

#[test]
fn a_seam_named_the_wrong_way_round_is_told_in_whatever_order_its_stitches_come() {
    let told = |stitches: &str| {
        let (_, report) = strips(stitches).expect("garment");
        report.findings.into_iter().find(|f| f.code == "seam-reversed")
    };
    let found = told("1 10\n0 11\n3 8\n2 9\n").expect("told");
    assert!(found.message.contains("from the stitch 0 11 to 3 8") && found.message.contains("200 mm"), "{found:?}");
    assert!(told("1 9\n0 8\n3 11\n2 10\n").is_none());
    // Single stitches here and there are no seam.
    assert!(told("0 11\n7 8\n3 9\n").is_none());
}

#[test]
fn mistakes_of_all_files_are_collected() {
    let pairs = [
        ("c.obj", SQUARE),
        ("p.txt", "0\n0\n99\nx\n1 2\n"),
        ("s.txt", "0 0\n1\n"),
        ("l.txt", "1 nan 0 0\n1 0 0\n"),
        ("b.obj", "v 0 0 0\n"),
    ];
    let toml = "pins = \"p.txt\"\nstitches = \"s.txt\"\nloads = \"l.txt\"\nbody = \"b.obj\"";
    let Err(StageError::Several(all)) = import(toml, &pairs) else { panic!("several mistakes") };
    let inputs = |error| if let StageError::Input(found) = error { found } else { panic!("refused as input") };
    let found: Vec<Diagnostic> = all.into_iter().flat_map(inputs).collect();
    assert_eq!(found.iter().filter(|d| d.code == "vertex-list").count(), 8, "{found:#?}");
    assert!(found.iter().any(|d| d.code == "obj-empty"));
    let twice = found.iter().find(|d| d.message.contains("pinned twice")).expect("double pin");
    assert_eq!(twice.source.as_ref().and_then(|s| s.line), Some(2));
}

#[test]
fn the_whole_way_to_a_glb() {
    let mut disk = files(&[("c.obj", SQUARE)]);
    let mut png = Vec::new();
    png.extend_from_slice(PNG);
    disk.0.insert("check.png".into(), png);
    let (garment, _) =
        run(&ImportMesh, &params("up = \"z\"\nrest = \"uv\""), Garment::default(), &mut disk).expect("garment");
    let look: TextureParams =
        toml::from_str("image = \"check.png\"\nrepeat = [\"40 mm\", \"50 mm\"]").expect("parameters");
    let (garment, _) = run(&Texture, &look, garment, &mut disk).expect("texture");
    let glb = ExportGltfParams { file: "g.glb".into(), ..ExportGltfParams::default() };
    let (garment, _) = run(&ExportGltf, &glb, garment, &mut disk).expect("GLB");
    let first = disk.0[Path::new("g.glb")].clone();
    assert_eq!(gltf::read_garment(&first).expect("read"), garment);
    run(&ExportGltf, &glb, garment, &mut disk).expect("GLB");
    assert_eq!(first, disk.0[Path::new("g.glb")], "same bytes");
}

/// A PNG of one white pixel.
const PNG: &[u8] = &[
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0, 58, 126, 155,
    85, 0, 0, 0, 10, 73, 68, 65, 84, 120, 156, 99, 248, 15, 0, 1, 1, 1, 0, 177, 56, 246, 20, 0, 0, 0, 0, 73, 69, 78,
    68, 174, 66, 96, 130,
];
