//! The height at which a garment starts: its waist seams lie where the body is as narrow as they are.
//!
//! A strapless dress that is placed 110 mm too low closes its waist seam on the hips, and nothing draws it up from there.

use super::ignored_parts::beside_arms;
use crate::body::{Section, sections};
use toile_garment::body::Body;
use toile_garment::seam::{Seam, SeamKind, Stitch};
use toile_garment::{Diagnostic, Garment, MeshVertex, Vec3};

/// Distance between the heights at which the body is measured, m.
const HEIGHT_STEP: f64 = 0.01;
/// Largest change of height, m.
const CHANGE_MOST: f64 = 0.25;
/// Share of the strain limit of the fabric up to which a ring of seams is stretched when it is put on. It was chosen so that
/// woven cloth with a limit of 5 % gives way by 2.5 %; before, all cloth gave way by 3 %. A rib of jersey that is a tenth
/// shorter than the hip stays on it: raised by 131 mm, the raglan sweatshirt was not sewn at its arms with edges of 20 and
/// 25 mm. No other value was tried.
const STRETCH_SHARE: f64 = 0.5;
/// Difference of girth that counts as much as a change of height by 1 m, m.
const GIRTH_PER_HEIGHT: f64 = 0.1;
/// Distance of the heights of seams that form one ring, m.
const RING_HEIGHT: f64 = 0.08;
/// Rise of a level seam over its length, at most.
const LEVEL: f64 = 0.4;
/// Width of a level cut of the body over that of its torso, above which the cut runs through the arms.
const WITH_ARMS: f64 = 1.25;

/// The change of height of the pieces that do not lie on arms, m; `None` where they belong where they are.
#[must_use]
pub fn change_of_height(garment: &Garment, placed: &[Vec<Vec3>]) -> Option<f64> {
    let girths = Girths::of(garment.body.as_ref()?)?;
    let rings = rings(garment, placed, &beside_arms(garment, placed));
    let tight = |r: &&Ring| girths.at(r.height).is_some_and(|girth| r.stretched < girth);
    // The narrowest ring decides.
    let ring = rings.iter().filter(tight).min_by(|a, b| a.length.total_cmp(&b.length))?;
    let cost =
        |(height, girth): &(f64, f64)| (girth - ring.length).abs() + GIRTH_PER_HEIGHT * (height - ring.height).abs();
    let within = |(height, _): &(f64, f64)| (height - ring.height).abs() <= CHANGE_MOST;
    let (height, girth) = girths.all().filter(within).min_by(|a, b| cost(a).total_cmp(&cost(b)))?;
    (ring.stretched >= girth).then_some(height - ring.height)
}

/// Tells the change.
#[must_use]
pub fn finding(by: f64) -> Diagnostic {
    let way = if by > 0.0 { "raised" } else { "lowered" };
    let message = format!(
        "where its pieces are placed the garment is narrower than the body: they were {way} by {:.0} mm before sewing",
        by.abs() * 1e3
    );
    Diagnostic::info(super::codes::START_RAISED, message).hint("place them there in the sewing file")
}

/// Girths of the torso on level planes, from the lowest up.
struct Girths {
    lowest: f64,
    by_step: Vec<Option<f64>>,
}

impl Girths {
    fn of(body: &Body) -> Option<Self> {
        let torso = body.segments.get("torso")?;
        // Below its lower end there are legs.
        let (low, high) = (torso.from.y.min(torso.to.y) + 2.0 * HEIGHT_STEP, torso.from.y.max(torso.to.y));
        let steps = ((high - low) / HEIGHT_STEP).ceil() as usize;
        let middle = (torso.from + torso.to) * 0.5;
        let girth = |k: usize| {
            let at = Vec3::new(middle.x, low + HEIGHT_STEP * k as f64, middle.z);
            let near = |c: Vec3| (c.x - middle.x).abs() < torso.half_width;
            let own: Vec<_> = sections(&body.positions, &body.triangles, at, Vec3::y())
                .into_iter()
                .filter(|s| near(s.centre()))
                .collect();
            let wide = |(low, high): (Vec3, Vec3)| high.x - low.x > 2.0 * WITH_ARMS * torso.half_width;
            let whole = !own.is_empty() && !own.iter().any(|s| wide(s.bounds()));
            whole.then(|| own.iter().map(Section::girth).fold(0.0, f64::max))
        };
        Some(Self { lowest: low, by_step: (0..=steps).map(girth).collect() })
    }

    /// All heights with their girths, m.
    fn all(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let height = |k: usize| self.lowest + HEIGHT_STEP * k as f64;
        self.by_step.iter().enumerate().filter_map(move |(k, girth)| Some((height(k), (*girth)?)))
    }

    /// Girth at the nearest height that was measured, m.
    fn at(&self, height: f64) -> Option<f64> {
        let step = ((height - self.lowest) / HEIGHT_STEP).round();
        if step < 0.0 { None } else { self.by_step.get(step as usize).copied().flatten() }
    }
}

/// A ring of level seams around the torso.
#[derive(Clone, Copy, Debug)]
struct Ring {
    /// Mean height, m.
    height: f64,
    /// m.
    length: f64,
    /// Length to which its fabric may be stretched, m.
    stretched: f64,
}

/// Level seams between these pieces that join cloth above with cloth below, those at one height together.
fn rings(garment: &Garment, placed: &[Vec<Vec3>], pieces: &[usize]) -> Vec<Ring> {
    let seams = garment.seams.iter().filter(|s| matches!(s.kind, SeamKind::Seam));
    let mut level: Vec<Ring> = seams.filter_map(|s| level_seam(garment, s, placed, pieces)).collect();
    level.sort_by(|a, b| a.height.total_cmp(&b.height));
    let together = level.chunk_by(|a, b| b.height - a.height < RING_HEIGHT);
    let ring = |seams: &[Ring]| {
        let length = seams.iter().map(|s| s.length).sum::<f64>();
        let stretched = seams.iter().map(|s| s.stretched).sum();
        Ring { height: seams.iter().map(|s| s.height * s.length).sum::<f64>() / length, length, stretched }
    };
    together.map(ring).collect()
}

/// A seam that runs level between a piece above and a piece below it; its length is that of its shorter side.
fn level_seam(garment: &Garment, seam: &Seam, placed: &[Vec<Vec3>], pieces: &[usize]) -> Option<Ring> {
    let at = |v: MeshVertex| {
        pieces.contains(&v.piece.index()).then(|| placed[v.piece.index()].get(v.vertex as usize).copied()).flatten()
    };
    let ends: Vec<[Vec3; 2]> = seam.stitches.iter().filter_map(|s| Some([at(s.a)?, at(s.b)?])).collect();
    if ends.len() != seam.stitches.len() || ends.len() < 2 {
        return None;
    }
    let side = |k: usize| {
        let heights = ends.iter().map(|e| e[k].y);
        let length: f64 = ends.windows(2).map(|w| (w[1][k] - w[0][k]).norm()).sum();
        let rise = heights.clone().fold(f64::NEG_INFINITY, f64::max) - heights.clone().fold(f64::INFINITY, f64::min);
        (heights.sum::<f64>() / ends.len() as f64, length, rise)
    };
    let [(ya, la, ra), (yb, lb, rb)] = [side(0), side(1)];
    let first = seam.stitches[0];
    let above = |v: MeshVertex, seam_height: f64| {
        let x = &placed[v.piece.index()];
        x.iter().map(|p| p.y).sum::<f64>() / x.len() as f64 > seam_height
    };
    let apart = above(first.a, ya) != above(first.b, yb);
    let level = ra <= LEVEL * la && rb <= LEVEL * lb;
    let length = la.min(lb);
    let stretched = length * (1.0 + STRETCH_SHARE * stretch_least(garment, first));
    (apart && level).then_some(Ring { height: 0.5 * (ya + yb), length, stretched })
}

/// The smallest strain limit of the fabrics of the two pieces.
fn stretch_least(garment: &Garment, stitch: Stitch) -> f64 {
    let fabrics = [stitch.a, stitch.b].map(|v| garment.fabric_of(&garment.pieces[v.piece.index()]));
    let limits = fabrics.into_iter().flatten().map(|f| f.strain_limit_warp.min(f.strain_limit_weft));
    limits.reduce(f64::min).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cloth, one, rectangle, sewn};
    use toile_garment::body::BodySegment;
    use toile_garment::fabric::Fabric;

    /// A round body of this radius at each height, without arms.
    fn body(radius: impl Fn(f64) -> f64) -> Body {
        const AROUND: u32 = 48;
        const ROWS: u32 = 60;
        let place = |i: u32, j: u32| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(AROUND));
            let y = 0.7 + 0.75 * f64::from(j) / f64::from(ROWS);
            Vec3::new(radius(y) * sin, y, radius(y) * cos)
        };
        let positions = (0..=ROWS).flat_map(|j| (0..AROUND).map(move |i| (i, j))).map(|(i, j)| place(i, j)).collect();
        let cell = |i: u32, j: u32| {
            let (a, b) = (j * AROUND + i, j * AROUND + (i + 1) % AROUND);
            [[a, b, b + AROUND], [a, b + AROUND, a + AROUND]]
        };
        let triangles = (0..ROWS).flat_map(|j| (0..AROUND).flat_map(move |i| cell(i, j))).collect();
        let torso = BodySegment {
            from: Vec3::new(0.0, 1.4, 0.0),
            to: Vec3::new(0.0, 0.75, 0.0),
            half_width: 0.17,
            half_depth: 0.17,
        };
        Body { positions, triangles, segments: [("torso".to_owned(), torso)].into(), ..Body::default() }
    }

    /// A body with its waist, of 0.8 m, at 1.1 m.
    fn with_waist() -> Body {
        body(|y| 0.8 / std::f64::consts::TAU + 0.4 * (y - 1.1) * (y - 1.1))
    }

    #[test]
    fn a_tight_ring_belongs_where_the_body_is_as_narrow() {
        let girths = Girths::of(&with_waist()).expect("a torso");
        let (height, girth) = girths.all().min_by(|a, b| a.1.total_cmp(&b.1)).expect("heights");
        assert!((height - 1.1).abs() < 0.02 && (girth - 0.8).abs() < 0.005, "{height} {girth}");
        assert!(girths.at(0.9).is_some_and(|g| g > 0.88));
        assert!(girths.at(0.5).is_none());
    }

    /// A top and a rib, sewn to each other by a ring of 0.82 m at this height, and a fabric with this strain limit.
    fn ring_at(height: f64, strain_limit: f64) -> (Garment, Vec<Vec<Vec3>>) {
        const STITCHES: u32 = 41;
        let around = |k: u32, y: f64| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / f64::from(STITCHES - 1));
            Vec3::new(cos, 0.0, sin) * (0.82 / std::f64::consts::TAU) + Vec3::y() * y
        };
        let piece =
            |beyond: f64| (0..STITCHES).map(|k| around(k, height)).chain([around(0, height + beyond)]).collect();
        let at = |piece: usize, vertex: u32| MeshVertex { piece: piece.into(), vertex };
        let stitches = (0..STITCHES).map(|k| Stitch { a: at(0, k), b: at(1, k) }).collect();
        let mut garment = one(rectangle(0, "TOP", 820.0, 600.0));
        garment.pieces.push(rectangle(1, "RIB", 820.0, 120.0));
        garment.seams.push(sewn("waist", stitches));
        garment.body = Some(with_waist());
        let fabric = cloth(0.2, 300.0, 30.0, [1e-5, 1e-5]);
        let fabric = Fabric { strain_limit_warp: strain_limit, strain_limit_weft: strain_limit, ..fabric };
        garment.fabrics.insert(String::new(), fabric);
        (garment, vec![piece(0.3), piece(-0.1)])
    }

    /// The hip measures 0.9 m. Woven cloth of 0.82 m belongs higher; a rib that stretches by a tenth belongs there.
    #[test]
    fn a_rib_that_stretches_stays_on_the_hip() {
        let (woven, placed) = ring_at(0.9, 0.05);
        let by = change_of_height(&woven, &placed).expect("raised");
        assert!((0.05..0.2).contains(&by), "{by}");
        let (knit, placed) = ring_at(0.9, 0.3);
        assert_eq!(change_of_height(&knit, &placed), None);
    }
}
