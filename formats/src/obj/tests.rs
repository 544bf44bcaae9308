use super::*;

const SQUARE: &str = "# a square\no sheet\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
    f 1/1 2/2 3/3 4/4\n";

fn codes(text: &[u8]) -> Vec<String> {
    read(text, "m.obj").expect_err("refused").into_iter().map(|d| d.code).collect()
}

#[test]
fn keeps_file_order_and_unused_vertices() {
    // Faces name the last vertex first; vertex 2 is used by none.
    let text = "v 9 9 9\nv 5 5 5\nv 1 0 0\nv 0 1 0\nf 4 3 1\n";
    let mesh = read(text.as_bytes(), "m.obj").expect("mesh");
    assert_eq!(mesh.positions[0], Vec3::new(9.0, 9.0, 9.0));
    assert_eq!(mesh.positions[1], Vec3::new(5.0, 5.0, 5.0));
    assert_eq!(mesh.triangles, vec![[3, 2, 0]]);
    assert_eq!(mesh.uv_triangles, None);
}

#[test]
fn reads_quads_uv_groups_and_relative_indices() {
    let mesh = read(SQUARE.as_bytes(), "m.obj").expect("mesh");
    assert_eq!(mesh.triangles, vec![[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.uv_triangles, Some(vec![[0, 1, 2], [0, 2, 3]]));
    assert_eq!((mesh.faces, mesh.polygons), (1, 1));
    assert_eq!(mesh.groups, vec![ObjGroup { name: "sheet".into(), first: 0 }]);
    let relative = SQUARE.replace("f 1/1 2/2 3/3 4/4", "f -4/-4 -3/-3 \\\n-2/-2 -1/-1\nl 1 2 3\ns off\nusemtl red");
    let again = read(relative.as_bytes(), "m.obj").expect("mesh");
    assert_eq!(again.triangles, mesh.triangles);
    assert_eq!(again.ignored["l"], 1);
    assert_eq!(again.materials, vec!["red".to_owned()]);
}

#[test]
fn keeps_double_precision() {
    let text = "v 0.12345678901234567 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let mesh = read(text.as_bytes(), "m.obj").expect("mesh");
    assert_eq!(mesh.positions[0].x.to_bits(), 0.12345678901234567_f64.to_bits());
}

#[test]
fn cuts_hollow_polygons_without_folds() {
    // A quad with a hollow corner, and an L of six corners.
    let quad = "v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 2 3 4 1\n";
    let ell = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 2 3 4 5 6 1\n";
    for (text, area) in [(quad, 1.0), (ell, 3.0)] {
        let mesh = read(text.as_bytes(), "m.obj").expect("mesh");
        let mut sum = 0.0;
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            let z = (b - a).cross(&(c - a)).z;
            assert!(z > 0.0, "a triangle turned over in {text}");
            sum += 0.5 * z;
        }
        assert!((sum - area).abs() < 1e-12, "{sum}");
    }
}

#[test]
fn refuses_bad_numbers_and_indices_by_line() {
    for (bad, code) in [
        ("v nan 0 0", "obj-number"),
        ("v 1e999 0 0", "obj-number"),
        ("v 1,0 0 0", "obj-number"),
        ("v 1e200 0 0", "obj-number"),
        ("v 1 2", "obj-line"),
        ("v 1 2 3 0", "obj-line"),
        ("f 1 2 999999999", "obj-index"),
        ("f -1 -2 -999999", "obj-index"),
        ("f 0 1 2", "obj-index"),
        ("f 1 2 99999999999999999999", "obj-index"),
        ("f 1/-9223372036854775808 2/1 3/1", "obj-index"),
        ("f 1/1/1/1 2/2 3/3", "obj-index"),
        ("f 1 2", "obj-line"),
    ] {
        let text = format!("{SQUARE}{bad}\n");
        let found = read(text.as_bytes(), "m.obj").expect_err(bad);
        assert_eq!(found[0].code, code, "{bad}");
        assert_eq!(found[0].source.as_ref().and_then(|s| s.line), Some(12), "{bad}");
    }
}

#[test]
fn refuses_floods_and_emptiness() {
    assert_eq!(codes(b""), vec!["obj-empty"]);
    assert_eq!(codes(b"v 0 0 0\n"), vec!["obj-empty"]);
    let polygon = format!("{SQUARE}f{}\n", " 1".repeat(100_000));
    assert_eq!(codes(polygon.as_bytes()), vec!["obj-polygon"]);
    let endless = format!("v 1 2 3 {}", "4 ".repeat(2_000_000));
    assert_eq!(codes(endless.as_bytes())[0], "obj-line");
    let many = format!("{SQUARE}{}", "f 1 2 9\n".repeat(5000));
    let found = codes(many.as_bytes());
    assert_eq!(found.len(), 21, "twenty and a count");
    assert_eq!(found[20], "obj-more");
    assert!(!codes(&[0xff; 4096]).is_empty());
}

#[test]
fn denormals_and_minus_zero_are_zero() {
    let mesh = read(b"v 1e-320 -0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "m.obj").expect("mesh");
    assert_eq!(mesh.positions[0].as_slice().iter().map(|x| x.to_bits()).collect::<Vec<_>>(), vec![0, 0, 0]);
}

#[test]
fn writes_what_it_read() {
    let mesh = read(b"v 0.1 -0.2 1e-7\nv 1 0 0.3333333333333333\nv 0 1 0\nf 3 1 2\n", "m.obj").expect("mesh");
    let text = write_mesh("sheet", &mesh.positions, &mesh.triangles);
    let again = read(text.as_bytes(), "m.obj").expect("mesh");
    assert_eq!((again.positions, again.triangles), (mesh.positions, mesh.triangles));
}

#[test]
fn any_cut_of_a_file_is_read_or_refused() {
    for n in 0..SQUARE.len() {
        match read(&SQUARE.as_bytes()[..n], "m.obj") {
            Ok(mesh) => assert!(mesh.triangles.iter().flatten().all(|i| (*i as usize) < mesh.positions.len())),
            Err(found) => assert!(!found.is_empty()),
        }
    }
}
