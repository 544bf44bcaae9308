//! How sharply the cloth is bent, and the pressure that its tension puts on the body by Laplace's law.
//!
//! The normals of the vertices turn over every triangle; the turn per length is the curvature of the cloth there. A
//! stretched cloth of tension T, N/m, that lies on a body with curvature κ, 1/m, presses with T κ, Pa, in each of warp
//! and weft. Shear and weight are left out, and so is all cloth that does not touch the body.

use super::maps::{ease, shape};
use std::collections::BTreeMap;
use toile_formats::normals;
use toile_formats::picture::{Field, Scale};
use toile_garment::fabric::Fabric;
use toile_garment::mesh::PieceMesh;
use toile_garment::{Garment, Piece, Vec2, Vec3};

/// Ends that a scale of bending may have, 1/m.
const BENDING_ENDS: [f64; 6] = [10.0, 20.0, 50.0, 100.0, 200.0, 400.0];
/// Ends that a scale of strain beside its limit may have, percent.
const SHARE_ENDS: [f64; 5] = [10.0, 20.0, 50.0, 100.0, 200.0];
/// Ends that a scale of tension may have, N/m.
const TENSION_ENDS: [f64; 9] = [5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0];
/// Ends that a scale of pressure may have, kPa.
const PRESSURE_ENDS: [f64; 7] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0];
/// Cloth nearer to the body than this touches it, millimetres: half a thickness of heavy cloth and the solver's gap.
const TOUCHES: f64 = 3.0;
/// Diameter of the pad over which pressure is averaged, as a sensor has it, metres.
pub const PAD: f64 = 0.02;

/// Curvature of a triangle along warp and weft and between them, 1/m, positive where it bulges to the right side.
struct Bend {
    warp: f64,
    weft: f64,
    both: f64,
    /// Strain along warp and weft.
    strain: [f64; 2],
    area: f64,
}

/// The larger of the two curvatures of the cloth, 1/m. `None` without positions in 3D.
#[must_use]
pub fn bending(garment: &Garment) -> Option<Field> {
    let largest = |bend: &Bend, _: Option<&Fabric>| {
        let (mean, half) = (0.5 * (bend.warp + bend.weft), 0.5 * (bend.warp - bend.weft));
        mean.abs() + libm::hypot(half, bend.both)
    };
    let values = per_vertex(garment, largest)?;
    let limit = Field::round_limit(&values, &BENDING_ENDS);
    Some(Field { key: "bending", name: "bending", unit: "1/m", scale: Scale::Rising, values, limit })
}

/// The larger strain of warp and weft, each beside the limit of its fabric, percent; 0 where the cloth is slack. `None`
/// without positions in 3D, or where no fabric has a limit.
#[must_use]
pub fn strain_beside_limit(garment: &Garment) -> Option<Field> {
    let share = |bend: &Bend, fabric: Option<&Fabric>| {
        let Some(fabric) = fabric else { return f64::NAN };
        let limits = [fabric.strain_limit_warp, fabric.strain_limit_weft];
        let of = |k: usize| if limits[k] > 0.0 { 100.0 * bend.strain[k].max(0.0) / limits[k] } else { f64::NAN };
        let [warp, weft] = [of(0), of(1)];
        if warp > weft || weft.is_nan() { warp } else { weft }
    };
    let values = per_vertex(garment, share)?;
    let is_known = values.iter().flatten().any(|x| x.is_finite());
    let limit = Field::round_limit(&values, &SHARE_ENDS);
    let (key, name) = ("strain-limit", "strain beside the limit");
    is_known.then_some(Field { key, name, unit: "%", scale: Scale::Rising, values, limit })
}

/// The larger tension of warp and weft, N/m, by the tensile curves of the fabric; 0 where the cloth is slack. `None`
/// without positions in 3D.
#[must_use]
pub fn tension(garment: &Garment) -> Option<Field> {
    let pull = |bend: &Bend, fabric: Option<&Fabric>| {
        let Some([warp, weft]) = fabric.map(|f| tensions(bend, f)) else { return f64::NAN };
        if warp > weft { warp } else { weft }
    };
    let values = per_vertex(garment, pull)?;
    let limit = Field::round_limit(&values, &TENSION_ENDS);
    Some(Field { key: "tension", name: "tension of the cloth", unit: "N/m", scale: Scale::Rising, values, limit })
}

/// Tension along warp and weft, N/m, never below 0.
fn tensions(bend: &Bend, fabric: &Fabric) -> [f64; 2] {
    let pulls = [fabric.stretch_warp.tension(bend.strain[0]), fabric.stretch_weft.tension(bend.strain[1])];
    pulls.map(|pull| if pull > 0.0 { pull } else { 0.0 })
}

/// Pressure on the body, kPa, each value the mean over a round pad of this diameter, metres. `None` without a body or
/// positions in 3D.
#[must_use]
pub fn pressure(garment: &Garment, pad: f64) -> Option<Field> {
    let gap = ease(garment)?;
    let presses = |bend: &Bend, fabric: Option<&Fabric>| {
        let Some(f) = fabric else { return f64::NAN };
        let [warp, weft] = tensions(bend, f);
        1e-3 * (warp * bend.warp + weft * bend.weft)
    };
    let mut bare = per_vertex(garment, presses)?;
    for (value, gap) in bare.iter_mut().zip(&gap.values).flat_map(|(v, g)| v.iter_mut().zip(g)) {
        *value = if *gap > TOUCHES { 0.0 } else { value.max(0.0) };
    }
    let values = over_pads(&shape(garment)?.positions, &bare, 0.5 * pad);
    let limit = Field::round_limit(&values, &PRESSURE_ENDS);
    Some(Field { key: "pressure", name: "pressure on the body", unit: "kPa", scale: Scale::Rising, values, limit })
}

/// A number of every triangle as the mean of its vertices by area.
fn per_vertex(garment: &Garment, number: impl Fn(&Bend, Option<&Fabric>) -> f64) -> Option<Vec<Vec<f64>>> {
    let shape = shape(garment)?;
    let whole = |m: &&PieceMesh, at: &[Vec3]| m.triangles.iter().flatten().all(|v| (*v as usize) < at.len());
    let pieces: Vec<_> = garment.pieces.iter().zip(&shape.positions).collect();
    let mesh =
        |piece: &'_ Piece, at: &[Vec3]| piece.mesh.as_ref().filter(|m| whole(m, at)).cloned().unwrap_or_default();
    let meshes: Vec<PieceMesh> = pieces.iter().map(|(piece, at)| mesh(piece, at)).collect();
    let surfaces: Vec<_> =
        pieces.iter().zip(&meshes).map(|((_, at), m)| (at.as_slice(), m.triangles.as_slice())).collect();
    let normals = normals::smooth(&surfaces);
    let of = |i: usize| {
        let ((piece, at), mesh) = (&pieces[i], &meshes[i]);
        let mut sums = vec![[0.0; 2]; at.len()];
        for (k, t) in mesh.triangles.iter().enumerate() {
            let Some(bend) = bend(mesh, k, *t, at, &normals[i], piece.warp()) else { continue };
            let value = number(&bend, garment.fabric_of(piece));
            for v in t {
                sums[*v as usize][0] += value * bend.area;
                sums[*v as usize][1] += bend.area;
            }
        }
        sums.iter().map(|[sum, area]| if *area > 0.0 { sum / area } else { f64::NAN }).collect()
    };
    Some((0..pieces.len()).map(of).collect())
}

fn bend(mesh: &PieceMesh, k: usize, t: [u32; 3], at: &[Vec3], normals: &[Vec3], warp: Vec2) -> Option<Bend> {
    // A rest shape with cuts has the warp along +y in every triangle.
    let warp = if mesh.rest_corners.is_some() { Vec2::y() } else { warp };
    let weft = Vec2::new(warp.y, -warp.x);
    let [a, b, c] = mesh.rest_triangle(k)?;
    let (u, v) = (b - a, c - a);
    let twice = u.perp(&v);
    if twice.abs() < 1e-14 {
        return None;
    }
    let [p, q, r] = t.map(|v| v as usize);
    // A step of one metre along a direction of the cloth: how it goes in space, and how the normal turns.
    let step = |d: Vec2| {
        let (s, w) = (d.perp(&v) / twice, u.perp(&d) / twice);
        ((at[q] - at[p]) * s + (at[r] - at[p]) * w, (normals[q] - normals[p]) * s + (normals[r] - normals[p]) * w)
    };
    let ((along, turn), (across, sway)) = (step(warp), step(weft));
    let (long, wide) = (along.norm(), across.norm());
    if long < 1e-6 || wide < 1e-6 {
        return None;
    }
    Some(Bend {
        warp: turn.dot(&along) / (long * long),
        weft: sway.dot(&across) / (wide * wide),
        both: 0.5 * (turn.dot(&across) + sway.dot(&along)) / (long * wide),
        strain: [long - 1.0, wide - 1.0],
        area: 0.5 * twice.abs(),
    })
}

/// Means over all vertices within a radius, of all pieces.
fn over_pads(at: &[Vec<Vec3>], values: &[Vec<f64>], radius: f64) -> Vec<Vec<f64>> {
    let cell = |p: &Vec3| p.map(|x| (x / radius).floor() as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<(Vec3, f64)>> = BTreeMap::new();
    for (p, value) in at.iter().zip(values).flat_map(|(p, v)| p.iter().zip(v)).filter(|(_, v)| v.is_finite()) {
        cells.entry(cell(p).into()).or_default().push((*p, *value));
    }
    let mean = |p: &Vec3| {
        let [x, y, z]: [i64; 3] = cell(p).into();
        let around = (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [x + i, y + j, z + k])));
        let near = around.filter_map(|c| cells.get(&c)).flatten().filter(|(q, _)| (q - p).norm() <= radius);
        let [sum, count] = near.fold([0.0, 0.0], |[sum, count], (_, value)| [sum + value, count + 1.0]);
        if count > 0.0 { sum / count } else { f64::NAN }
    };
    at.iter().zip(values).map(|(p, v)| p.iter().take(v.len()).map(mean).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::body::Body;
    use toile_garment::garment::Shape;

    /// A sleeve of cloth around a tube of radius 0.1 m, pulled by 2 % around, half a millimetre off the tube.
    fn sleeve() -> Garment {
        const SIDES: u32 = 120;
        let radius = 0.1;
        let (mut rest, mut worn, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..=12_u32 {
            for k in 0..=SIDES {
                let turn = std::f64::consts::TAU * f64::from(k) / f64::from(SIDES);
                let (s, c) = libm::sincos(turn);
                rest.push(Vec2::new(radius * turn / 1.02, 0.01 * f64::from(row)));
                worn.push(Vec3::new(radius * s, 0.01 * f64::from(row), radius * c));
            }
        }
        for cell in 0..12 * SIDES {
            let a = cell / SIDES * (SIDES + 1) + cell % SIDES;
            triangles.extend([[a, a + 1, a + SIDES + 2], [a, a + SIDES + 2, a + SIDES + 1]]);
        }
        let body = Body {
            positions: worn.iter().map(|p| Vec3::new(0.995 * p.x, p.y, 0.995 * p.z)).collect(),
            triangles: triangles.clone(),
            ..Body::default()
        };
        let mesh = PieceMesh { rest, triangles, ..PieceMesh::default() };
        Garment {
            pieces: vec![Piece { mesh: Some(mesh), ..Piece::default() }],
            drape: Some(Shape { positions: vec![worn], ..Shape::default() }),
            fabrics: [(String::new(), crate::testing::cloth(0.2, 500.0, 40.0, [1e-5; 2]))].into(),
            body: Some(body),
            ..Garment::default()
        }
    }

    /// Vertices away from the free edges, where a normal is that of the tube.
    fn inner(field: &Field) -> Vec<f64> {
        (4 * 121..9 * 121).filter(|v| (10..111).contains(&(v % 121))).map(|v| field.values[0][v]).collect()
    }

    #[test]
    fn a_tube_is_bent_by_one_over_its_radius() {
        let field = bending(&sleeve()).expect("3D");
        for k in inner(&field) {
            assert!((k / 10.0 - 1.0).abs() < 0.01, "{k} of 10 per metre");
        }
        // Some values lie a hair above 10, so the scale ends at the next round number.
        assert_eq!(field.limit, 20.0);
    }

    #[test]
    fn a_pulled_sleeve_presses_by_tension_over_radius() {
        let garment = sleeve();
        let field = pressure(&garment, PAD).expect("a body");
        // 500 N/m · 2 % / 0.1 m = 100 Pa.
        for p in inner(&field) {
            assert!((p / 0.1 - 1.0).abs() < 0.02, "{p} kPa");
        }
        // 500 N/m · 2 % along the weft; the warp is slack.
        for t in inner(&tension(&garment).expect("3D")) {
            assert!((t / 10.0 - 1.0).abs() < 0.02, "{t} N/m");
        }
        assert!(pressure(&Garment { body: None, ..garment }, PAD).is_none());
    }

    #[test]
    fn strain_is_shown_beside_the_limit_of_the_fabric() {
        let mut garment = sleeve();
        for fabric in garment.fabrics.values_mut() {
            fabric.strain_limit_weft = 0.04;
        }
        let field = strain_beside_limit(&garment).expect("a limit");
        // 2 % along the weft of 4 % that it bears; the warp is slack.
        for share in inner(&field) {
            assert!((share / 50.0 - 1.0).abs() < 0.02, "{share} %");
        }
        garment.fabrics.clear();
        assert!(strain_beside_limit(&garment).is_none());
    }
}
