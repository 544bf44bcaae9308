//! A garment for tests: two pieces sewn to a tube, with a dart, textures, body and history.

use toile_garment::body::Body;
use toile_garment::dart::{Dart, DartEvidence, DartKind, DartMesh};
use toile_garment::garment::{EffectRecord, Shape};
use toile_garment::ids::{MeshVertex, PieceId, SeamId};
use toile_garment::mesh::{ChainKind, MeshChain, PieceMesh};
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::provenance::{InputRecord, StageRecord};
use toile_garment::seam::{Seam, SeamKind, SeamRun, SeamSide, Stitch};
use toile_garment::texture::{Image, Material, PieceTexture, Textures};
use toile_garment::{Garment, Piece, Vec2, Vec3};

const COLUMNS: u32 = 4;
const ROWS: u32 = 5;
const WIDTH: f64 = 0.3;
const HEIGHT: f64 = 0.6;

fn rest() -> Vec<Vec2> {
    let point = |i| {
        let (c, r) = (f64::from(i % COLUMNS), f64::from(i / COLUMNS));
        Vec2::new(c / f64::from(COLUMNS - 1) * WIDTH, r / f64::from(ROWS - 1) * HEIGHT)
    };
    (0..COLUMNS * ROWS).map(point).collect()
}

fn triangles() -> Vec<[u32; 3]> {
    let cell = |r, c| {
        let a = r * COLUMNS + c;
        [[a, a + 1, a + COLUMNS + 1], [a, a + COLUMNS + 1, a + COLUMNS]]
    };
    (0..ROWS - 1).flat_map(|r| (0..COLUMNS - 1).flat_map(move |c| cell(r, c))).collect()
}

fn outline() -> Vec<u32> {
    let (last, top) = (COLUMNS - 1, (ROWS - 1) * COLUMNS);
    let right = (1..ROWS).map(|r| r * COLUMNS + last);
    let back = (0..last).rev().map(|c| top + c);
    (0..COLUMNS).chain(right).chain(back).chain((1..ROWS - 1).rev().map(|r| r * COLUMNS)).collect()
}

fn piece(id: usize, name: &str) -> Piece {
    let rest = rest();
    let ids = outline();
    let points = ids.iter().map(|i| LinePoint { at: rest[*i as usize], kind: PointKind::Plain }).collect();
    let mesh = PieceMesh {
        triangles: triangles(),
        chains: vec![MeshChain { kind: ChainKind::Outline, index: 0, vertices: ids.clone(), closed: true }],
        outline_vertex: ids.into_iter().map(Some).collect(),
        rest,
        rest_corners: None,
    };
    Piece {
        id: PieceId::from(id),
        name: name.into(),
        block: name.to_uppercase(),
        outline: PieceLine { points, closed: true, ..PieceLine::default() },
        mesh: Some(mesh),
        ..Piece::default()
    }
}

fn dart(rest: &[Vec2]) -> Dart {
    let legs = [vec![17, 13], vec![18, 13]];
    let points = |leg: &Vec<u32>| leg.iter().map(|i| rest[*i as usize]).collect::<Vec<_>>();
    Dart {
        name: "dart-1".into(),
        kind: DartKind::MarkedWedge,
        evidence: DartEvidence::InternalLine,
        apexes: vec![rest[13]],
        mouth: [rest[17], rest[18]],
        legs: [points(&legs[0]), points(&legs[1])],
        line: "internal".into(),
        depth: None,
        mesh: Some(DartMesh { legs }),
        source: None,
    }
}

/// A half tube: bulging to the front (`side` = 1) or to the back (−1), both with the same side edges.
fn bulge(side: f64) -> Vec<Vec3> {
    let place = |(i, r): (usize, &Vec2)| {
        let edge = (i as u32).is_multiple_of(COLUMNS) || i as u32 % COLUMNS == COLUMNS - 1;
        let x = r.x - WIDTH / 2.0;
        let depth = 0.12 * (1.0 - 4.0 * x * x / (WIDTH * WIDTH));
        // Seen from outside, the back piece runs the other way.
        Vec3::new(side * x, r.y + 0.8, if edge { 0.0 } else { side * depth })
    };
    rest().iter().enumerate().map(place).collect()
}

fn seam(id: usize, name: &str, a_column: u32, b_column: u32) -> Seam {
    let run = |piece: usize, column: u32| SeamRun {
        piece: PieceId::from(piece),
        vertices: (0..ROWS).map(|r| r * COLUMNS + column).collect(),
    };
    let (a, b) = (run(0, a_column), run(1, b_column));
    let vertex = |run: &SeamRun, k: usize| MeshVertex { piece: run.piece, vertex: run.vertices[k] };
    let stitches = (0..ROWS as usize).map(|k| Stitch { a: vertex(&a, k), b: vertex(&b, k) }).collect();
    Seam {
        id: SeamId::from(id),
        name: name.into(),
        kind: SeamKind::Seam,
        a: SeamSide { runs: vec![a], length: HEIGHT },
        b: SeamSide { runs: vec![b], length: HEIGHT },
        ease: 0.0,
        gather: None,
        stitches,
        source: None,
    }
}

/// A small PNG.
pub fn png() -> Image {
    let mut bytes = Vec::new();
    let pixels = image::RgbImage::from_fn(8, 8, |x, y| image::Rgb([(x * 30) as u8, (y * 30) as u8, 90]));
    pixels.write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png).expect("encode");
    Image { mime: "image/png".into(), width: 8, height: 8, bytes }
}

/// The garment.
pub fn two_pieces() -> Garment {
    let mut front = piece(0, "front");
    front.darts = vec![dart(&rest())];
    let texture = |k: f64| PieceTexture {
        material: 0,
        uv_cloth: rest().iter().map(|r| [r.x, r.y]).collect(),
        uv_packed: rest().iter().map(|r| [r.x + 0.4 * k, r.y]).collect(),
    };
    let material = Material {
        name: "check".into(),
        color: [1.0, 0.9, 0.8],
        image: Some(png()),
        repeat: [0.06, 0.04],
        roughness: 0.85,
        normal: None,
        sheen: None,
    };
    let body = Body {
        name: "stand".into(),
        positions: vec![Vec3::zeros(), Vec3::x(), Vec3::y()],
        triangles: vec![[0, 1, 2]],
        measures: [("waist_girth".to_owned(), 0.72)].into(),
        digest: "abc".into(),
        ..Body::default()
    };
    let stage = StageRecord { stage: "drape".into(), id: "drape".into(), revision: 1, params: serde_json::json!({}) };
    let input = InputRecord { path: "patterns/skirt.dxf".into(), blake3: "0".into() };
    let shape = Shape { positions: vec![bulge(1.0), bulge(-1.0)], sewn: true, welded: true, ..Shape::default() };
    let mut garment = Garment {
        style: "tube".into(),
        pieces: vec![front, piece(1, "back")],
        seams: vec![seam(0, "left", COLUMNS - 1, 0), seam(1, "right", 0, COLUMNS - 1)],
        body: Some(body),
        stitched: Some(shape.clone()),
        drape: Some(shape),
        textures: Some(Textures {
            materials: vec![material],
            pieces: vec![texture(0.0), texture(1.0)],
            ..Textures::default()
        }),
        effects: vec![EffectRecord {
            name: "friction".into(),
            on: true,
            rule: "there is a body".into(),
            evidence: "body `stand`".into(),
            cpu_seconds: 0.0,
        }],
        ..Garment::default()
    };
    garment.provenance.inputs.push(input);
    garment.provenance.stages.push(stage);
    garment
}
