use super::*;
use toile_garment::body::BodySegment;
use toile_garment::{Severity, Vec3};

/// A box of 0.4 × 1.7 × 0.2 m standing on the floor, triangles outwards.
fn cube() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let p = (0..8u32)
        .map(|i| Vec3::new(f64::from(i & 1) * 0.4 - 0.2, f64::from(i >> 1 & 1) * 1.7, f64::from(i >> 2 & 1) * 0.2))
        .collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (p, quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect())
}

fn volume(body: &Body) -> f64 {
    let sum: f64 = body
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|i| body.positions[i as usize]);
            a.dot(&b.cross(&c))
        })
        .sum();
    sum / 6.0
}

fn codes(read: &ReadBody) -> Vec<&str> {
    read.findings.iter().map(|d| d.code.as_str()).collect()
}

fn obj(p: &[Vec3], t: &[[u32; 3]]) -> Vec<u8> {
    obj::write_mesh("box", p, t).into_bytes()
}

#[test]
fn a_sound_body_is_read_as_it_is() {
    let (p, t) = cube();
    let read = read(&obj(&p, &t), "some/where/box.obj", None).expect("body");
    assert_eq!((&read.body.positions, &read.body.triangles), (&p, &t));
    assert_eq!(codes(&read), Vec::<&str>::new());
    assert_eq!(read.body.name, "box");
    assert_eq!(read.body.digest.len(), 64);
    assert!((volume(&read.body) - 0.4 * 1.7 * 0.2).abs() < 1e-12);
}

#[test]
fn inside_out_is_turned_and_said() {
    let (p, t) = cube();
    let inside_out: Vec<_> = t.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    let read = read(&obj(&p, &inside_out), "box.obj", None).expect("body");
    assert!(volume(&read.body) > 0.0);
    assert_eq!(codes(&read), ["body-inside-out"]);
}

#[test]
fn half_turned_is_refused() {
    let (p, mut t) = cube();
    t[3].swap(0, 1);
    let found = read(&obj(&p, &t), "box.obj", None).expect_err("mixed");
    assert_eq!(found[0].code, "body-faces-mixed");
}

#[test]
fn holes_flat_and_double_triangles_are_counted() {
    let (p, mut t) = cube();
    t.pop();
    t.push([0, 0, 1]);
    t.push(t[0]);
    let read = read(&obj(&p, &t), "box.obj", None).expect("body");
    assert_eq!(codes(&read), ["body-triangles-flat", "body-triangles-double", "body-open"]);
    assert!(read.findings[2].message.contains(" 3 "), "{}", read.findings[2].message);
    assert_eq!(read.body.triangles.len(), 11);
}

#[test]
fn split_vertices_are_merged() {
    let (p, t) = cube();
    let split: Vec<Vec3> = t.iter().flatten().map(|i| p[*i as usize]).collect();
    let soup: Vec<[u32; 3]> = (0..t.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let read = read(&obj(&split, &soup), "box.obj", None).expect("body");
    assert_eq!(read.body.positions.len(), 8);
    assert_eq!(codes(&read), ["body-vertices-merged"]);
}

#[test]
fn a_body_in_millimetres_is_found() {
    let (p, t) = cube();
    let big: Vec<Vec3> = p.iter().map(|p| p * 1000.0).collect();
    let warned = read(&obj(&big, &t), "box.obj", None).expect("a scene without measures");
    assert_eq!(warned.findings[0].severity, Severity::Warning);
    let found = read(&obj(&big, &t), "box.obj", Some("name = \"b\"")).expect_err("a person");
    assert_eq!(found[0].code, "body-size");
    assert!(found[0].hint.as_deref().is_some_and(|h| h.contains("millimetres")));
}

#[test]
fn writes_what_it_read() {
    let (positions, triangles) = cube();
    let segment = BodySegment {
        from: Vec3::new(0.0, 1.4, 0.01),
        to: Vec3::new(0.0, 0.8, 0.0),
        half_width: 0.18,
        half_depth: 0.123456789,
    };
    let mut body = Body { name: "woman \"38\"".into(), positions, triangles, ..Body::default() };
    body.measures.insert("waist_girth".into(), 0.72);
    body.landmarks.insert("waist".into(), Vec3::new(0.0, 1.04, -0.015));
    body.segments.insert("torso".into(), segment.clone());
    body.segments.insert("arm-left".into(), segment);
    let (mesh, toml) = write(&body);
    assert_eq!(write(&body), (mesh.clone(), toml.clone()), "same bytes");
    let again = read(mesh.as_bytes(), "b.obj", Some(&toml)).unwrap_or_else(|e| panic!("{e:?}\n{toml}"));
    assert_eq!(write(&again.body), (mesh.clone(), toml), "written the same again");
    assert_eq!((&again.body.positions, &again.body.triangles), (&body.positions, &body.triangles));
    assert_eq!(again.body.digest, blake3::hash(mesh.as_bytes()).to_hex().to_string());
    assert_eq!(again.body.name, body.name);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-15;
    assert!(near(again.body.measures["waist_girth"], 0.72));
    assert!((again.body.landmarks["waist"] - body.landmarks["waist"]).norm() < 1e-15);
    for (name, s) in &body.segments {
        let read = &again.body.segments[name];
        assert!((read.from - s.from).norm() < 1e-15 && (read.to - s.to).norm() < 1e-15, "{name}");
        assert!(near(read.half_width, s.half_width) && near(read.half_depth, s.half_depth), "{name}");
    }
    assert_eq!(sidecar_name("a.b/body.obj"), "a.b/body.toml");
}

#[test]
fn mistakes_of_the_side_file_are_collected() {
    let (p, t) = cube();
    let toml = "nam = \"x\"\n[measures]\nwaist_girth = 720\nhip_girth = \"-1 mm\"\n[landmarks]\nwaist = [\"1 mm\"]\n\
        [segments.tors]\n[segments.torso]\nfrom = [\"0 mm\", \"0 mm\", \"0 mm\"]\n";
    let found = read(&obj(&p, &t), "b.obj", Some(toml)).expect_err("refused");
    assert_eq!(found.len(), 8, "{found:#?}");
    assert!(found.iter().all(|d| d.source.as_ref().is_some_and(|s| s.line.is_some() && s.file == "b.toml")));
    assert!(found.iter().any(|d| d.hint.as_deref() == Some("did you mean `torso`?")));
}

/// The second reading of the same files is handed over; another side file, or another name in messages, is read anew.
#[test]
fn a_body_is_read_again_with_the_same_result() {
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    let side = "[measures]\nwaist_girth = \"700 mm\"\n";
    let first = read(mesh.as_bytes(), "ball.obj", Some(side)).expect("reads");
    for _ in 0..3 {
        assert_eq!(read(mesh.as_bytes(), "ball.obj", Some(side)).expect("reads"), first);
    }
    let bare = read(mesh.as_bytes(), "other.obj", None).expect("reads");
    assert!(bare.body.measures.is_empty() && bare.body.name == "other" && first.body.measures.len() == 1);
}
