//! Damaged GLB, OBJ, PNG and TOML: refused or read, and never a panic, not even one that is caught.

use std::panic;
use std::sync::Mutex;
use toile_formats::gltf::{Carried, Wishes};
use toile_formats::{fabric, gltf, obj, texture};
use toile_garment::garment::Shape;
use toile_garment::mesh::PieceMesh;
use toile_garment::texture::{Image, Material, PieceTexture, Textures};
use toile_garment::{Garment, Piece, Vec2, Vec3};

static PANICS: Mutex<Vec<String>> = Mutex::new(Vec::new());

fn png() -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels = image::RgbImage::from_fn(8, 8, |x, y| image::Rgb([(x * 30) as u8, (y * 30) as u8, 90]));
    pixels.write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png).expect("encode");
    bytes
}

fn glb() -> Vec<u8> {
    glb_with(Carried::Plain)
}

fn glb_with(document: Carried) -> Vec<u8> {
    let rest = vec![Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0)];
    let positions = rest.iter().map(|r| Vec3::new(r.x, r.y, r.x * r.y)).collect();
    let uv: Vec<[f64; 2]> = rest.iter().map(|r| [r.x, r.y]).collect();
    let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [1, 3, 2]], ..PieceMesh::default() };
    let piece = Piece { name: "sheet".into(), mesh: Some(mesh), ..Piece::default() };
    let image = Some(Image { mime: "image/png".into(), width: 8, height: 8, bytes: png() });
    let (color, repeat) = ([1.0; 3], [0.1; 2]);
    let material = Material { name: "m".into(), color, image, repeat, roughness: 0.9, normal: None, sheen: None };
    let texture = PieceTexture { material: 0, uv_cloth: uv.clone(), uv_packed: uv };
    let garment = Garment {
        pieces: vec![piece],
        drape: Some(Shape { positions: vec![positions], sewn: false, welded: true, ..Shape::default() }),
        textures: Some(Textures { materials: vec![material], pieces: vec![texture], ..Textures::default() }),
        ..Garment::default()
    };
    gltf::write_garment_with(&garment, &Wishes { document, ..Wishes::default() }).expect("GLB")
}

/// A fixed sequence of numbers (xorshift).
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % n.max(1) as u64) as usize
    }
}

const NASTY: [&str; 14] = [
    "0",
    "-1",
    "1e308",
    "1e999",
    "nan",
    "2147483648",
    "4294967295",
    "4611686018427387904",
    "18446744073709551608",
    "[]",
    "{}",
    "null",
    "\"x\"",
    "1.5",
];

/// One damaged copy: bits, a cut, doubled or lost stretches, or a nasty word in place of a number.
fn mutant(seed: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut out = seed.to_vec();
    match dice.below(6) {
        0 => {
            for _ in 0..=dice.below(8) {
                let at = dice.below(out.len());
                out[at] ^= 1 << dice.below(8);
            }
        }
        1 => out.truncate(dice.below(seed.len())),
        2 => {
            let (a, n) = (dice.below(seed.len()), dice.below(64));
            out.drain(a..(a + n).min(seed.len()));
        }
        3 => {
            let (a, n) = (dice.below(seed.len()), dice.below(64));
            let copy = seed[a..(a + n).min(seed.len())].to_vec();
            let at = dice.below(seed.len());
            out.splice(at..at, copy);
        }
        _ => {
            let start = dice.below(seed.len());
            let Some(a) = (start..seed.len()).find(|i| seed[*i].is_ascii_digit()) else { return out };
            let b = (a..seed.len()).find(|i| !seed[*i].is_ascii_digit()).unwrap_or(seed.len());
            out.splice(a..b, NASTY[dice.below(NASTY.len())].bytes());
        }
    }
    out
}

/// Container lengths put right again, so that the JSON inside is what gets read.
fn relength(glb: &mut [u8], old: &[u8]) {
    if glb.len() < 20 || old.len() < 20 {
        return;
    }
    let grown = glb.len() as i64 - old.len() as i64;
    let json = i64::from(u32::from_le_bytes([old[12], old[13], old[14], old[15]])) + grown;
    let total = (glb.len() as u32).to_le_bytes();
    glb[8..12].copy_from_slice(&total);
    glb[12..16].copy_from_slice(&(json.max(0) as u32).to_le_bytes());
}

/// The JSON of a GLB with one text in place of another.
fn edited(glb: &[u8], from: &str, to: &str) -> Vec<u8> {
    let json = u32::from_le_bytes([glb[12], glb[13], glb[14], glb[15]]) as usize;
    let text = std::str::from_utf8(&glb[20..20 + json]).expect("JSON").trim_end();
    assert!(text.contains(from), "{from} is not in the file");
    let mut text = text.replacen(from, to, 1).into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut out = glb[..12].to_vec();
    out.extend_from_slice(&(text.len() as u32).to_le_bytes());
    out.extend_from_slice(b"JSON");
    out.extend_from_slice(&text);
    out.extend_from_slice(&glb[20 + json..]);
    let total = (out.len() as u32).to_le_bytes();
    out[8..12].copy_from_slice(&total);
    out
}

#[test]
fn no_file_panics_a_reader() {
    panic::set_hook(Box::new(|info| PANICS.lock().expect("list").push(info.to_string())));
    let outcome = panic::catch_unwind(all);
    let _ = panic::take_hook();
    let seen = PANICS.lock().expect("list");
    assert!(outcome.is_ok() && seen.is_empty(), "{seen:#?}");
}

fn all() {
    named_damage();
    let mut dice = Dice(7);
    for glb in [glb(), glb_with(Carried::Packed)] {
        for i in 0..3000 {
            let mut bytes = mutant(&glb, &mut dice);
            if i % 3 != 0 {
                relength(&mut bytes, &glb);
            }
            let _ = (gltf::read_garment(&bytes), gltf::inspect(&bytes));
        }
        for n in 0..64 {
            assert!(gltf::read_garment(&glb[..glb.len() * n / 64]).is_err());
        }
    }
    let obj =
        b"o s\nv 0 0 0\nv 1 0 0.5\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\nf -1 -2 -3\n";
    for _ in 0..3000 {
        if let Ok(mesh) = obj::read(&mutant(obj, &mut dice), "m.obj") {
            assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
            assert!(mesh.triangles.iter().flatten().all(|i| (*i as usize) < mesh.positions.len()));
        }
    }
    let png = png();
    for _ in 0..2000 {
        let _ = texture::read_image(&mutant(&png, &mut dice), "m.png");
    }
    let toml = include_bytes!("../../samples/fabrics/denim-11oz.toml");
    for _ in 0..3000 {
        let bytes = mutant(toml, &mut dice);
        if let Ok(f) = fabric::read(&String::from_utf8_lossy(&bytes), "f.toml") {
            let numbers = [f.areal_mass, f.thickness, f.friction, f.shear, f.bend_warp, f.strain_limit_warp];
            assert!(numbers.iter().all(|x| x.is_finite() && *x >= 0.0) && f.areal_mass > 0.0);
        }
    }
}

/// Each must be refused; what is wrong must be said.
fn named_damage() {
    let glb = glb();
    for (from, to, word) in [
        ("\"count\":4", "\"count\":4611686018427387904", "accessor"),
        ("\"count\":4", "\"count\":0", "accessor"),
        ("\"count\":4", "\"count\":5", "accessor"),
        ("\"byteOffset\":", "\"byteOffset\":1844674407370955160", "bufferView"),
        ("\"buffer\":0", "\"buffer\":7", "bufferView"),
        ("\"bufferView\":1", "\"bufferView\":99", "bufferView"),
        ("\"POSITION\":0", "\"POSITION\":99", "accessor 99"),
        ("\"indices\":4", "\"indices\":0", "accessor 0"),
        ("\"componentType\":5126", "\"componentType\":5121", "wrong type"),
        ("\"type\":\"VEC3\"", "\"type\":\"SCALAR\"", "wrong type"),
        ("\"scenes\":[{\"nodes\":[0]", "\"scenes\":[{\"nodes\":[5]", "scene"),
        ("\"nodes\":[{", "\"nodes\":[{\"children\":[0],", "loop"),
        ("\"nodes\":[{", "\"nodes\":[{\"children\":[3],", "child"),
        ("\"nodes\":[{", "\"nodes\":[{\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,1e39,0,0,1],", ""),
        ("\"material\":0", "\"material\":9", "do not fit"),
        ("\"buffers\":[{", "\"buffers\":[{\"uri\":\"file:///etc/x\",", "another file"),
        ("\"images\":[{", "\"images\":[{\"uri\":\"../../x.png\",", "another file"),
        ("\"version\":1}}", "\"version\":99}}", "newer"),
        ("\"kind\":\"toile-garment\"", "\"kind\":\"cake\"", "cake"),
        ("[[0,1,2],[1,3,2]]", "[[0,1,2],[1,3,77]]", "vertex"),
        ("\"toile\":{", "\"cake\":{", "no garment document"),
    ] {
        let bad = edited(&glb, from, to);
        let error = gltf::read_garment(&bad).map(|_| ()).expect_err(to).to_string();
        assert!(error.contains(word), "{from} -> {to}: {error}");
    }
    let deep =
        [b"glTF\x02\0\0\0".as_slice(), &200_020u32.to_le_bytes(), &200_000u32.to_le_bytes(), b"JSON", &[b'['; 200_000]];
    assert!(gltf::read_garment(&deep.concat()).is_err());
    let nodes: Vec<String> = (1..20_000).map(|i| format!("{{\"children\":[{i}]}}")).collect();
    let deep = edited(&glb, "\"nodes\":[{", &format!("\"nodes\":[{},{{", nodes.join(",")));
    let deep = edited(&deep, "\"nodes\":[0]}", "\"nodes\":[0]}");
    // A chain of twenty thousand nodes is strange but sound.
    assert!(gltf::read_garment(&deep).is_ok());
}
