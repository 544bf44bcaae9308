//! Strain of the cloth and its distance to the body, per vertex.

use super::bent::{PAD, bending, pressure, strain_beside_limit, tension};
use super::nearest::Nearest;
use super::surface::Surface;
use crate::flatten::figures;
use toile_formats::picture::{Field, Scale};
use toile_garment::flat::StrainMap;
use toile_garment::garment::Shape;
use toile_garment::mesh::PieceMesh;
use toile_garment::{Garment, Piece, Vec2, Vec3};

/// Ends that a scale of strain may have, percent.
const STRAIN_ENDS: [f64; 9] = [0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0];

/// Ends that a scale of the distance to the body may have, millimetres.
const EASE_ENDS: [f64; 8] = [10.0, 20.0, 40.0, 60.0, 100.0, 200.0, 400.0, 600.0];

/// All maps that can be made of a garment in 3D.
#[must_use]
pub fn maps(garment: &Garment) -> Vec<Field> {
    let strains = strain(garment).into_iter().flatten();
    let pulls = tension(garment).into_iter().chain(pressure(garment, PAD));
    let strains = strains.chain(strain_beside_limit(garment));
    strains.chain(ease(garment)).chain(pulls).chain(bending(garment)).collect()
}

/// Strain along warp, weft and bias, percent. `None` without positions in 3D.
#[must_use]
pub fn strain(garment: &Garment) -> Option<[Field; 3]> {
    let shape = shape(garment)?;
    let all: Vec<[Vec<f64>; 3]> =
        garment.pieces.iter().zip(&shape.positions).map(|(piece, at)| of_piece(piece, at)).collect();
    let [warp, weft, bias]: [Vec<Vec<f64>>; 3] = [0, 1, 2].map(|k| all.iter().map(|b| b[k].clone()).collect());
    // One scale for both directions of the threads, so that their colours can be compared. The bias gives more.
    let limit = Field::round_limit(&warp, &STRAIN_ENDS).max(Field::round_limit(&weft, &STRAIN_ENDS));
    let slack = Field::round_limit(&bias, &STRAIN_ENDS);
    let field = |key, name, values, limit| Field { key, name, unit: "%", scale: Scale::Signed, values, limit };
    Some([
        field("strain-warp", "strain along warp", warp, limit),
        field("strain-weft", "strain along weft", weft, limit),
        field("strain-bias", "strain along bias", bias, slack),
    ])
}

/// Distance from the cloth to the nearest point of the body, millimetres. `None` without a body or positions in 3D.
#[must_use]
pub fn ease(garment: &Garment) -> Option<Field> {
    let (shape, body) = (shape(garment)?, garment.body.as_ref().filter(|b| !b.triangles.is_empty())?);
    let surface = Surface::of_body(body);
    let tree = Nearest::new(&surface);
    let far = |at: &Vec<Vec3>| at.iter().map(|p| 1e3 * tree.distance(p)).collect();
    let values: Vec<Vec<f64>> = shape.positions.iter().map(far).collect();
    let limit = Field::round_limit(&values, &EASE_ENDS);
    Some(Field { key: "ease", name: "distance to the body", unit: "mm", scale: Scale::FromZero, values, limit })
}

pub(super) fn shape(garment: &Garment) -> Option<&Shape> {
    garment.drape.as_ref().or(garment.stitched.as_ref())
}

/// Strain along warp, weft and bias of every vertex, percent: the mean of its triangles by their area.
fn of_piece(piece: &Piece, at: &[Vec3]) -> [Vec<f64>; 3] {
    let Some(mesh) = piece.mesh.as_ref().filter(|m| m.triangles.iter().flatten().all(|v| (*v as usize) < at.len()))
    else {
        return [Vec::new(), Vec::new(), Vec::new()];
    };
    let (map, area) = per_triangle(mesh, at, piece.warp());
    let bias: Vec<f64> = (0..map.warp.len()).map(|t| bias(map.warp[t], map.weft[t], map.shear[t])).collect();
    [&map.warp, &map.weft, &bias].map(|values| {
        let mut sums = vec![[0.0; 2]; at.len()];
        for ((t, value), area) in mesh.triangles.iter().zip(values).zip(&area) {
            for v in t {
                sums[*v as usize][0] += 100.0 * value * area;
                sums[*v as usize][1] += area;
            }
        }
        sums.iter().map(|[sum, area]| if *area > 0.0 { sum / area } else { f64::NAN }).collect()
    })
}

/// The larger strain of both directions half way between warp and weft; `shear` is the angle that is lost, radians.
fn bias(warp: f64, weft: f64, shear: f64) -> f64 {
    let (warp, weft) = (1.0 + warp, 1.0 + weft);
    let longest = 0.5 * (warp * warp + weft * weft) + (warp * weft * libm::sin(shear)).abs();
    longest.max(0.0).sqrt() - 1.0
}

/// Strain and rest area of every triangle.
fn per_triangle(mesh: &PieceMesh, at: &[Vec3], warp: Vec2) -> (StrainMap, Vec<f64>) {
    // A rest shape with cuts has the warp along +y in every triangle.
    let warp = if mesh.rest_corners.is_some() { Vec2::y() } else { warp };
    let corners: Vec<[Vec2; 3]> =
        (0..mesh.triangles.len()).map(|t| mesh.rest_triangle(t).unwrap_or([Vec2::zeros(); 3])).collect();
    let plane: Vec<Vec2> = corners.iter().flatten().copied().collect();
    let surface: Vec<Vec3> = mesh.triangles.iter().flatten().map(|v| at[*v as usize]).collect();
    let alone: Vec<[u32; 3]> = (0..corners.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let area = corners.iter().map(|[a, b, c]| 0.5 * (b - a).perp(&(c - a)).abs()).collect();
    (figures::strain(&plane, &surface, &alone, warp), area)
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::body::Body;

    /// A square of 0.1 m, stretched by 4 % along its warp and pressed by 1 % along its weft, 30 mm before a body.
    fn garment() -> Garment {
        let rest: Vec<Vec2> = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]].map(Vec2::from).to_vec();
        let at = rest.iter().map(|p| Vec3::new(0.99 * p.x, 1.04 * p.y, 0.03)).collect();
        let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() };
        let wall = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]].map(Vec3::from).to_vec();
        Garment {
            pieces: vec![Piece { mesh: Some(mesh), ..Piece::default() }],
            drape: Some(Shape { positions: vec![at], ..Shape::default() }),
            body: Some(Body { positions: wall, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Body::default() }),
            ..Garment::default()
        }
    }

    #[test]
    fn maps_show_what_was_stretched_and_how_far_the_body_is() {
        let fields = maps(&garment());
        let all = |k: usize, x: f64| fields[k].values[0].iter().all(|v| (v - x).abs() < 1e-9);
        assert_eq!(
            fields.iter().map(|f| f.key).collect::<Vec<_>>(),
            ["strain-warp", "strain-weft", "strain-bias", "ease", "tension", "pressure", "bending"]
        );
        assert!(all(0, 4.0) && all(1, -1.0) && all(3, 30.0));
        // Without shear the bias is stretched by the mean square of both.
        assert!(all(2, 100.0 * ((0.5 * (1.04 * 1.04 + 0.99 * 0.99_f64)).sqrt() - 1.0)));
        assert_eq!(fields.iter().map(|f| f.limit).collect::<Vec<_>>(), [5.0, 5.0, 2.0, 40.0, 5.0, 0.05, 10.0]);
        assert!((bias(0.0, 0.0, std::f64::consts::FRAC_PI_6) - (1.5_f64.sqrt() - 1.0)).abs() < 1e-12);
    }

    #[test]
    fn without_a_body_there_is_no_ease() {
        let garment = Garment { body: None, ..garment() };
        assert_eq!(maps(&garment).len(), 5);
        assert!(maps(&Garment::default()).is_empty());
    }
}
