//! Pictures of a square of cloth that hangs in front of a body.

use super::*;
use toile_garment::body::Body;
use toile_garment::garment::Shape;
use toile_garment::mesh::PieceMesh;
use toile_garment::{Piece, Vec2, Vec3};

/// A square of 0.4 m at z = 0.2 m, and a larger square of a body behind it.
fn garment() -> Garment {
    let rest = vec![Vec2::new(0.0, 0.0), Vec2::new(0.4, 0.0), Vec2::new(0.4, 0.4), Vec2::new(0.0, 0.4)];
    let worn = rest.iter().map(|p| Vec3::new(p.x - 0.2, p.y + 1.0, 0.2)).collect();
    let triangles = vec![[0, 1, 2], [0, 2, 3]];
    let mesh = PieceMesh { rest, triangles: triangles.clone(), ..PieceMesh::default() };
    let wall = |x: f64, y: f64| Vec3::new(x, y, 0.0);
    let body = vec![wall(-0.4, 0.8), wall(0.4, 0.8), wall(0.4, 1.6), wall(-0.4, 1.6)];
    Garment {
        pieces: vec![Piece { name: "square".into(), mesh: Some(mesh), ..Piece::default() }],
        drape: Some(Shape { positions: vec![worn], ..Shape::default() }),
        body: Some(Body { positions: body, triangles, ..Body::default() }),
        ..Garment::default()
    }
}

fn wishes(view: View) -> Wishes<'static> {
    Wishes { views: vec![view], width: 96, height: 128, body: true, field: None }
}

fn decoded(png: &[u8]) -> image::RgbImage {
    image::load_from_memory(png).expect("PNG").to_rgb8()
}

#[test]
fn the_same_garment_gives_the_same_bytes_and_fills_the_frame() {
    let garment = garment();
    let bytes = png(&garment, &wishes(View::Front)).expect("picture");
    assert_eq!(bytes, png(&garment, &wishes(View::Front)).expect("picture"));
    let bare = decoded(&png(&garment, &Wishes { body: false, ..wishes(View::Front) }).expect("picture"));
    let paper = bare.get_pixel(0, 0).0;
    let wide = (0..96).filter(|x| bare.get_pixel(*x, 64).0 != paper).count();
    // 88 % of 96 pixels; the edges of the square may share a pixel with the paper.
    assert!((84..=86).contains(&wide), "{wide}");
    assert_ne!(decoded(&bytes).get_pixel(2, 2).0, paper, "the body stands behind the cloth");
}

#[test]
fn a_quantity_is_seen_in_its_colour_with_a_legend_below() {
    let garment = garment();
    let values = vec![vec![5.0; 4]];
    let field = Field { key: "warp", name: "strain", unit: "%", scale: Scale::Signed, values, limit: 5.0 };
    let with = |field| Wishes { field, body: false, ..wishes(View::Front) };
    let picture = decoded(&png(&garment, &with(Some(&field))).expect("picture"));
    assert!(picture.height() > 128);
    let [r, g, b] = picture.get_pixel(48, 64).0;
    assert!(r > 100 && u32::from(r) > 2 * u32::from(g) && u32::from(r) > 2 * u32::from(b), "{r} {g} {b}");
}

#[test]
fn views_stand_side_by_side_and_each_model_fills_its_frames() {
    let garment = garment();
    let both = Wishes { views: vec![View::Flat, View::Left], ..wishes(View::Front) };
    let picture = decoded(&png(&garment, &both).expect("picture"));
    assert_eq!(picture.dimensions(), (192, 128));
    // Worn half as large as it is drawn, the cloth is as wide in the front view as it is in the flat lay.
    let mut small = garment;
    small.drape.iter_mut().flat_map(|d| &mut d.positions).flatten().for_each(|p| *p *= 0.5);
    let both = Wishes { views: vec![View::Flat, View::Front], body: false, ..wishes(View::Front) };
    let picture = decoded(&png(&small, &both).expect("picture"));
    let paper = picture.get_pixel(0, 0).0;
    let wide = [0, 96].map(|from| (from..from + 96).filter(|x| picture.get_pixel(*x, 64).0 != paper).count());
    assert!(wide.iter().all(|w| (84..=86).contains(w)), "{wide:?}");
}

#[test]
fn nothing_to_see_is_said() {
    let empty = Garment::default();
    assert_eq!(png(&empty, &wishes(View::Front)), Err(PictureError::Missing("positions in 3D")));
    assert_eq!(png(&empty, &wishes(View::Flat)), Err(PictureError::Missing("meshed pieces")));
    assert_eq!(png(&garment(), &Wishes { width: 10, ..wishes(View::Front) }), Err(PictureError::Size));
}

#[test]
fn the_inside_of_a_fold_is_darker_than_its_outside() {
    // A deep trough, open towards the eye: two walls and a floor far behind.
    let mut garment = garment();
    let corner = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    let strip = [(-0.2, 0.2), (-0.1, 0.2), (-0.05, -0.3), (0.05, -0.3), (0.1, 0.2), (0.2, 0.2)];
    let worn: Vec<Vec3> = strip.iter().flat_map(|(x, z)| [corner(*x, 1.0, *z), corner(*x, 1.8, *z)]).collect();
    let rest = worn.iter().map(|p| Vec2::new(p.x, p.y)).collect();
    let triangles = (0..5u32).flat_map(|k| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]]).collect();
    garment.pieces[0].mesh = Some(PieceMesh { rest, triangles, ..PieceMesh::default() });
    garment.drape = Some(Shape { positions: vec![worn], ..Shape::default() });
    let picture = decoded(&png(&garment, &Wishes { body: false, ..wishes(View::Front) }).expect("picture"));
    let light = |x: u32| picture.get_pixel(x, 64).0.iter().map(|c| u32::from(*c)).sum::<u32>();
    // Its floor against the cloth beside it, both of which face the eye.
    assert!(light(48) + 90 < light(10), "{} {}", light(48), light(10));
}
