//! A picture of a garment in a GLB: seen from the front and from the left, one colour a piece.
//!
//! `cargo run --release --example picture -- GARMENT.glb PICTURE.png`

use image::{Rgb, RgbImage};
use std::process::ExitCode;
use toile_garment::Vec3;

const WIDTH: u32 = 360;
const HEIGHT: u32 = 540;
const COLOURS: [[f64; 3]; 4] = [[70.0, 104.0, 150.0], [176.0, 122.0, 78.0], [92.0, 138.0, 100.0], [150.0, 96.0, 130.0]];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [from, to] = arguments.as_slice() else { return failed("picture GARMENT.glb PICTURE.png") };
    let bytes = match std::fs::read(from) {
        Ok(bytes) => bytes,
        Err(error) => return failed(&format!("{from}: {error}")),
    };
    let garment = match toile_formats::gltf::read_garment(&bytes) {
        Ok(garment) => garment,
        Err(error) => return failed(&format!("{from}: {error}")),
    };
    let Some(drape) = &garment.drape else { return failed("the garment is not draped") };
    let mut pieces = Vec::new();
    for (piece, positions) in garment.pieces.iter().zip(&drape.positions) {
        let Some(mesh) = &piece.mesh else { continue };
        pieces.push((positions.as_slice(), mesh.triangles.as_slice()));
    }
    match draw(&pieces).save(to) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => failed(&format!("{to}: {error}")),
    }
}

#[allow(clippy::print_stderr)]
fn failed(why: &str) -> ExitCode {
    eprintln!("{why}");
    ExitCode::from(2)
}

type Piece<'a> = (&'a [Vec3], &'a [[u32; 3]]);

/// Both views side by side.
fn draw(pieces: &[Piece<'_>]) -> RgbImage {
    let mut picture = RgbImage::from_pixel(2 * WIDTH, HEIGHT, Rgb([250, 250, 248]));
    let all = || pieces.iter().flat_map(|(positions, _)| positions.iter());
    let low = all().fold(Vec3::repeat(f64::INFINITY), |a, p| a.inf(p));
    let high = all().fold(Vec3::repeat(f64::NEG_INFINITY), |a, p| a.sup(p));
    let (middle, size) = ((low + high) / 2.0, high - low);
    let scale = 0.9 * (f64::from(HEIGHT) / size.y).min(f64::from(WIDTH) / size.x.max(size.z));
    let views: [fn(Vec3) -> Vec3; 2] = [|p| p, |p| Vec3::new(-p.z, p.y, p.x)];
    for (view, left) in views.into_iter().zip([0, WIDTH]) {
        let mut depth = vec![f64::NEG_INFINITY; (WIDTH * HEIGHT) as usize];
        for ((positions, triangles), colour) in pieces.iter().zip(COLOURS.iter().cycle()) {
            let seen: Vec<Vec3> = positions.iter().map(|p| view(p - middle) * scale).collect();
            let normals = normals(&seen, triangles);
            for t in *triangles {
                let corners = t.map(|i| (seen[i as usize], normals[i as usize]));
                fill(&mut picture, &mut depth, left, corners, colour);
            }
        }
    }
    picture
}

/// Normals at the vertices, of length 1.
fn normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut normals = vec![Vec3::zeros(); positions.len()];
    for t in triangles {
        let [a, b, c] = t.map(|i| positions[i as usize]);
        let normal = (b - a).cross(&(c - a));
        t.iter().for_each(|i| normals[*i as usize] += normal);
    }
    normals.iter().map(|n| n.try_normalize(0.0).unwrap_or_else(Vec3::z)).collect()
}

/// One triangle into the picture, where nothing lies in front of it.
fn fill(picture: &mut RgbImage, depth: &mut [f64], left: u32, corners: [(Vec3, Vec3); 3], colour: &[f64; 3]) {
    let at = |p: Vec3| (f64::from(WIDTH) / 2.0 + p.x, f64::from(HEIGHT) / 2.0 - p.y);
    let [a, b, c] = corners.map(|(p, _)| at(p));
    let area = (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0);
    if area == 0.0 {
        return;
    }
    let range = |x: f64, y: f64, z: f64, most: u32| {
        let low = x.min(y).min(z).floor().max(0.0) as u32;
        low..(x.max(y).max(z).ceil().max(0.0) as u32 + 1).min(most)
    };
    for y in range(a.1, b.1, c.1, HEIGHT) {
        for x in range(a.0, b.0, c.0, WIDTH) {
            let (px, py) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let v = ((px - a.0) * (c.1 - a.1) - (py - a.1) * (c.0 - a.0)) / area;
            let w = ((b.0 - a.0) * (py - a.1) - (b.1 - a.1) * (px - a.0)) / area;
            let u = 1.0 - v - w;
            if u < -1e-9 || v < -1e-9 || w < -1e-9 {
                continue;
            }
            let mix =
                |pick: fn(&(Vec3, Vec3)) -> Vec3| pick(&corners[0]) * u + pick(&corners[1]) * v + pick(&corners[2]) * w;
            let (z, normal) = (mix(|c| c.0).z, mix(|c| c.1));
            let cell = &mut depth[(y * WIDTH + x) as usize];
            if z > *cell {
                *cell = z;
                picture.put_pixel(left + x, y, Rgb(shade(normal, colour)));
            }
        }
    }
}

/// Light from above the viewer's left; the wrong side of the cloth is paler.
fn shade(normal: Vec3, colour: &[f64; 3]) -> [u8; 3] {
    let outside = normal.z >= 0.0;
    let facing = if outside { normal } else { -normal };
    let light = Vec3::new(-0.45, 0.5, 0.74).dot(&facing).max(0.0);
    let pale = if outside { 0.0 } else { 0.35 };
    colour.map(|c| ((c + (255.0 - c) * pale) * (0.35 + 0.75 * light)).min(255.0) as u8)
}
