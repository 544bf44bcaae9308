//! Two readings of OBJ files: `tobj`'s, by which bodies come in, and our own scan, which keeps the order of the file.

use std::fmt::Write as _;
use toile_formats::obj::{self, ObjMesh};

/// Numbers that look thrown, the same on every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n
    }
}

/// Both readings must give the same mesh, or the same findings.
fn agree(bytes: &[u8], what: &str) -> Option<ObjMesh> {
    let (ours, theirs) = (obj::read(bytes, "f.obj"), obj::read_geometry(bytes, "f.obj"));
    match (ours, theirs) {
        (Ok(ours), Ok(theirs)) => {
            assert_eq!(ours.positions, theirs.positions, "{what}");
            assert_eq!(ours.triangles, theirs.triangles, "{what}");
            assert_eq!((ours.faces, ours.polygons), (theirs.faces, theirs.polygons), "{what}");
            Some(ours)
        }
        (Err(ours), Err(theirs)) => {
            assert_eq!(ours, theirs, "{what}");
            None
        }
        (ours, theirs) => panic!("{what}: {:?} against {:?}", ours.err(), theirs.err()),
    }
}

/// The mesh written again and read by `tobj` alone: every corner lies where our scan puts it.
fn proof(mesh: &ObjMesh) {
    let mut text = String::new();
    for p in &mesh.positions {
        let _ = writeln!(text, "v {:?} {:?} {:?}", p.x, p.y, p.z);
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| i + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    let (models, _) =
        tobj::load_obj_buf(&mut text.as_bytes(), &tobj::LoadOptions::default(), |_| Err(tobj::LoadError::ReadError))
            .expect("a clean file");
    let theirs = &models[0].mesh;
    assert_eq!(theirs.indices.len(), 3 * mesh.triangles.len());
    for (ours, theirs_at) in mesh.triangles.iter().flatten().zip(&theirs.indices) {
        let at = 3 * *theirs_at as usize;
        assert_eq!(&theirs.positions[at..at + 3], mesh.positions[*ours as usize].as_slice());
    }
}

fn obj_files(folder: &std::path::Path, into: &mut Vec<std::path::PathBuf>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder).expect("folder").map(|e| e.expect("entry").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            obj_files(&path, into);
        } else if path.extension().is_some_and(|e| e == "obj") {
            into.push(path);
        }
    }
}

#[test]
fn all_samples_are_read_alike() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    obj_files(&root.join("samples"), &mut files);
    obj_files(&root.join("tests"), &mut files);
    assert!(files.len() >= 3, "{files:?}");
    let mut read = 0;
    for path in files {
        let bytes = std::fs::read(&path).expect("file");
        if let Some(mesh) = agree(&bytes, &path.display().to_string()) {
            proof(&mesh);
            read += 1;
        }
    }
    assert!(read >= 3);
}

/// Files as exporters write them, and files that are wrong in small ways.
const FORMS: &[&str] = &[
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    // Unused vertices, order unlike that of the faces, groups that share vertices.
    "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng a\nf 5 4 3\ng b\nusemtl red\nf 5 3 2\n",
    // Quads, a pentagon, relative numbers, texture vertices and normals.
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0.5 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3//1 4\nf -5 -4 -3 -2 -1\n",
    // Faces between vertices, weights, colours, comments, lines that go on, CRLF.
    "# c\r\nv 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\nv 1 \\\r\n1 0 # top\r\nf 1 2 3\r\nv 5 5 5\r\nf 2 3 4\r\n",
    // Lines of three ends are no triangle, points no face.
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\np 1\nf 1 2 3\n",
    "v 1e-310 -0 0\nv 1 0 0\nf 1 2 2\n",
    // Wrong: a weight, two numbers, too many, not finite, too large, forward, zero, no normal, two corners, nothing.
    "v 0 0 0 2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "v 0 0 0 1 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "v 1e10 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "v 0 0 0\nf 1 2 3\nv 1 0 0\nv 0 1 0\n",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2 3\n",
    "v 0 0 0\nv 1 0 0\nf 1 2\n",
    "v 0 0 0\nvt 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "v 0,5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "v 0 0 0\n",
    "f 1 2 3\n",
    "",
];

#[test]
fn forms_and_their_damage_are_read_alike() {
    for (i, form) in FORMS.iter().enumerate() {
        let mesh = agree(form.as_bytes(), &format!("form {i}"));
        assert_eq!(mesh.is_some(), i < 6, "form {i}");
        mesh.iter().for_each(proof);
    }
    let mut dice = Dice(7);
    for round in 0..6000 {
        let form = FORMS[round % 6].as_bytes();
        let bytes = damaged(form, &mut dice);
        agree(&bytes, &String::from_utf8_lossy(&bytes));
    }
}

/// Some bytes exchanged for others that stand in OBJ files.
fn damaged(form: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = form.to_vec();
    for _ in 0..=dice.below(3) {
        let at = dice.below(bytes.len());
        bytes[at] = b"0123456789 -/.\n#\\vfe\xff"[dice.below(21)];
    }
    bytes
}

/// Why `tobj` reads no cloth: it renumbers vertices by first use, forgets unused ones and starts anew in each group.
#[test]
fn tobj_keeps_no_order_of_vertices() {
    let (models, _) = tobj::load_obj_buf(&mut FORMS[1].as_bytes(), &tobj::LoadOptions::default(), |_| {
        Err(tobj::LoadError::ReadError)
    })
    .expect("read");
    let meshes: Vec<_> = models.iter().map(|m| (m.mesh.positions.len() / 3, m.mesh.indices.clone())).collect();
    assert_eq!(meshes, [(3, vec![0, 1, 2]), (3, vec![0, 1, 2])]);
    let mesh = obj::read_geometry(FORMS[1].as_bytes(), "f.obj").expect("read");
    assert_eq!((mesh.positions.len(), mesh.triangles), (5, vec![[4, 3, 2], [4, 2, 1]]));
}

/// Why `tobj` sees no other lines: a line with three ends becomes a triangle.
#[test]
fn tobj_makes_a_triangle_of_a_line() {
    let (models, _) = tobj::load_obj_buf(&mut FORMS[4].as_bytes(), &tobj::LoadOptions::default(), |_| {
        Err(tobj::LoadError::ReadError)
    })
    .expect("read");
    assert_eq!(models[0].mesh.indices.len(), 3 + 3);
    assert_eq!(obj::read_geometry(FORMS[4].as_bytes(), "f.obj").expect("read").triangles, [[0, 1, 2]]);
}
