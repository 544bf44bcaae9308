//! Girths of garment and body at the heights that pattern makers name, and lengths of free edges.

use super::balance;
use super::edge_names::edge_names;
use super::maps::maps;
use super::rings::{Ring, rings};
use super::surface::{Hem, Surface};
use super::tailor::{leaning_seams, lengths, piece_sizes};
use crate::body::section_near;
use crate::roles::{Part, joins_of_meshes, roles};
use toile_formats::report::{Fit, FreeEdge, Level};
use toile_garment::body::{Body, BodySegment};
use toile_garment::flat::FlatMetric;
use toile_garment::{Garment, Vec2, Vec3};

/// A part of the body that a girth is taken around, and where.
struct Place {
    /// Name of the girth.
    name: &'static str,
    /// The part: a segment of the body.
    segment: &'static str,
    /// The measure of the body that tells the height.
    height: &'static str,
    /// The landmark that tells it where the measure is not known.
    landmark: &'static str,
    /// How far below that height, metres.
    below: f64,
}

const fn place(name: &'static str, segment: &'static str, height: [&'static str; 2], below: f64) -> Place {
    let [height, landmark] = height;
    Place { name, segment, height, landmark, below }
}

/// Girths that are taken, where the garment covers them.
const PLACES: [Place; 6] = [
    place("bust", "torso", ["bust_height", "bust-left"], 0.0),
    place("under_bust", "torso", ["under_bust_height", "under-bust-front"], 0.0),
    place("waist", "torso", ["waist_height", "waist-front"], 0.0),
    place("hip", "torso", ["hip_height", "hip-left"], 0.0),
    place("thigh_left", "leg-left", ["crotch_height", "crotch"], 0.03),
    place("thigh_right", "leg-right", ["crotch_height", "crotch"], 0.03),
];

/// A level this near to an edge of the garment is taken that much inside it, metres.
const INSIDE: f64 = 0.004;

/// A level that lies further than this beside the garment is not taken, metres.
const BESIDE: f64 = 0.02;

/// Steps in which cloth is looked for below an armhole, metres, and the most of them.
const BELOW_ARMHOLE: f64 = 0.005;
const STEPS_BELOW: u32 = 40;

/// Measures a garment for its report. Where an edit in 3D was flattened, the flattened pieces are its pattern.
#[must_use]
pub fn measure(garment: &Garment) -> Fit {
    let flattened = of_flattened(garment);
    let garment = flattened.as_ref().unwrap_or(garment);
    let mut fit = Fit { maps: maps(garment), ..Fit::default() };
    let Some(surface) = Surface::of(garment).filter(|s| !s.triangles.is_empty()) else { return fit };
    let range = surface.range();
    let rest = rest_lengths(garment);
    if let Some(body) = &garment.body {
        let level = |p: &Place| level(p, body, &surface, &rest, range);
        fit.levels = PLACES.iter().filter_map(level).collect();
    }
    let hems = free_edges(garment, surface.hems(), &rest, range);
    let is_level = |name: &str| name == "hem" || name.starts_with("leg hem");
    let balances =
        hems.iter().filter(|(_, e)| is_level(&e.name)).flat_map(|(h, e)| balance::of_hem(&e.name, h, &surface));
    fit.balance = balances.chain(leaning_seams(garment)).collect();
    fit.edges = hems.into_iter().map(|(_, edge)| edge).collect();
    fit.lengths = lengths(garment);
    fit.pieces = piece_sizes(garment);
    fit.range = Some(range);
    fit
}

/// The garment of the pieces that an edit in 3D gave; `None` where nothing was edited.
fn of_flattened(garment: &Garment) -> Option<Garment> {
    let flat = garment.flat.as_ref().filter(|f| f.metric != FlatMetric::Unedited)?;
    let mut new = garment.clone();
    for of in &flat.pieces {
        let mesh = new.pieces.get_mut(of.piece.index()).and_then(|p| p.mesh.as_mut());
        if let Some(mesh) = mesh.filter(|m| m.rest.len() == of.positions.len()) {
            mesh.rest.clone_from(&of.positions);
        }
    }
    Some(new)
}

/// The free edges with their names, from below to above.
fn free_edges(garment: &Garment, mut hems: Vec<Hem>, rest: &Rest, range: [f64; 2]) -> Vec<(Hem, FreeEdge)> {
    hems.sort_by(|a, b| a.height.total_cmp(&b.height).then_with(|| a.pieces.cmp(&b.pieces)));
    let pieces = |hem: &Hem| {
        let names = hem.pieces.iter().filter_map(|p| garment.pieces.get(*p as usize)).map(|p| p.name.as_str());
        names.collect::<Vec<_>>().join(", ")
    };
    let parts: Vec<Option<Part>> =
        roles(&garment.pieces, &joins_of_meshes(garment)).into_iter().map(|role| role.part).collect();
    let waist = garment.body.as_ref().and_then(|body| level_height("waist", body));
    let edge = |(h, name): (&Hem, String)| {
        let pattern = h.edges.iter().filter_map(|e| rest.edge(*e)).sum();
        FreeEdge { name, pieces: pieces(h), height: h.height, pattern, length: h.length }
    };
    let edges: Vec<FreeEdge> = hems.iter().zip(edge_names(&hems, &parts, waist, range)).map(edge).collect();
    hems.into_iter().zip(edges).collect()
}

fn level(place: &Place, body: &Body, surface: &Surface, rest: &Rest, range: [f64; 2]) -> Option<Level> {
    let wanted = level_height(place.name, body)?;
    let height = inside(wanted, range)?;
    let at = axis(body, place.segment, height);
    let skin = section_near(&body.positions, &body.triangles, Vec3::new(at.x, height, at.y), Vec3::y());
    let (height, ring) = around(place, body, surface, height)?;
    Some(Level {
        name: place.name.to_owned(),
        height,
        body: skin.map(|s| s.girth()).filter(|g| *g > 0.0),
        pattern: rest.around(surface, &ring, height),
        along: ring.along(),
        tape: ring.tape(),
    })
}

/// The cloth around a part of the body at a height, and that height. Where sleeves hang on the cloth there, it is taken
/// below the armholes, as the chest of a shirt is measured.
fn around(place: &Place, body: &Body, surface: &Surface, height: f64) -> Option<(f64, Ring)> {
    let mut heights = (0..=STEPS_BELOW).map(|step| height - f64::from(step) * BELOW_ARMHOLE);
    let height = heights.find(|height| place.segment != "torso" || !has_sleeves(body, surface, *height))?;
    Some((height, outermost(place, body, surface, height)?))
}

/// Does cloth go around the trunk and an arm at once? A plane may cut the open end of a sleeve, too.
fn has_sleeves(body: &Body, surface: &Surface, height: f64) -> bool {
    let trunk = axis(body, "torso", height);
    let mut around = rings(surface, height).into_iter().filter(|r| r.holds(trunk));
    around.any(|r| ["arm-left", "arm-right"].iter().any(|arm| goes_around(&r, body, arm, height)))
}

/// The outermost of several layers around a part. A skirt lies around both legs, and is no girth of one.
fn outermost(place: &Place, body: &Body, surface: &Surface, height: f64) -> Option<Ring> {
    let at = axis(body, place.segment, height);
    let around = rings(surface, height).into_iter().filter(|r| r.closed && r.holds(at));
    let ring = around.max_by(|a, b| a.tape().total_cmp(&b.tape()))?;
    let other = if place.segment == "leg-left" { "leg-right" } else { "leg-left" };
    (place.segment == "torso" || !ring.holds(axis(body, other, height))).then_some(ring)
}

/// Does a ring go around a part of the body that reaches this height?
fn goes_around(ring: &Ring, body: &Body, segment: &str, height: f64) -> bool {
    let reaches = |s: &BodySegment| (s.from.y.min(s.to.y)..=s.from.y.max(s.to.y)).contains(&height);
    body.segments.get(segment).is_some_and(reaches) && ring.holds(axis(body, segment, height))
}

/// The height at which cloth of this range is measured for a wanted height. An edge that lies on the level, such as a
/// waistband, is measured just inside. `None` where the cloth does not reach the level.
#[must_use]
pub fn inside(wanted: f64, [low, high]: [f64; 2]) -> Option<f64> {
    let height = wanted.clamp(low + INSIDE, (high - INSIDE).max(low + INSIDE));
    ((wanted - height).abs() <= BESIDE).then_some(height)
}

/// The height of a girth of this name on a body, metres above the floor.
#[must_use]
pub fn level_height(name: &str, body: &Body) -> Option<f64> {
    PLACES.iter().find(|p| p.name == name).and_then(|p| Some(named_height(p, body)? - p.below))
}

/// The height of a place: by its measure, its landmark, or the lower end of the torso, which is the crotch.
fn named_height(place: &Place, body: &Body) -> Option<f64> {
    let crotch = || body.segments.get("torso").filter(|_| place.segment != "torso").map(|t| t.to.y);
    let landmark = || body.landmarks.get(place.landmark).map(|p| p.y);
    body.measures.get(place.height).copied().or_else(landmark).or_else(crotch)
}

/// The place of the axis of a part of the body at a height, seen from above.
fn axis(body: &Body, segment: &str, height: f64) -> Vec2 {
    let Some(s) = body.segments.get(segment) else { return Vec2::zeros() };
    let share = (height - s.from.y) / (s.to.y - s.from.y);
    let at = s.from + (s.to - s.from) * if share.is_finite() { share } else { 0.0 };
    Vec2::new(at.x, at.z)
}

/// Length in the plane of the line in which a height cuts a triangle, metres. `None` where it does not.
#[must_use]
pub fn cut_in_plane(worn: [Vec3; 3], plane: [Vec2; 3], height: f64) -> Option<f64> {
    let mut ends = (0..3).filter_map(|k| {
        let (p, q) = (worn[k], worn[(k + 1) % 3]);
        let share = (height - p.y) / (q.y - p.y);
        ((p.y < height) != (q.y < height)).then(|| plane[k].lerp(&plane[(k + 1) % 3], share))
    });
    Some((ends.next()? - ends.next()?).norm())
}

/// Rest shapes of all triangles, in the order of the surface.
struct Rest(Vec<Option<[Vec2; 3]>>);

fn rest_lengths(garment: &Garment) -> Rest {
    let meshes = garment.pieces.iter().filter_map(|p| p.mesh.as_ref());
    Rest(meshes.flat_map(|m| (0..m.triangles.len()).map(|t| m.rest_triangle(t))).collect())
}

/// Length of the cloth at rest along a ring of its surface, metres.
pub(super) fn rest_around(garment: &Garment, surface: &Surface, ring: &Ring, height: f64) -> f64 {
    rest_lengths(garment).around(surface, ring, height)
}

impl Rest {
    /// Length of an edge of a triangle at rest, from the corner at which it begins, metres.
    fn edge(&self, (triangle, corner): (usize, usize)) -> Option<f64> {
        let corners = self.0.get(triangle).copied().flatten()?;
        Some((corners[(corner + 1) % 3] - corners[corner]).norm())
    }

    /// Length of the cloth at rest along a cut at a height, metres.
    fn around(&self, surface: &Surface, ring: &Ring, height: f64) -> f64 {
        let length = |t: &usize| cut_in_plane(surface.corners(*t), self.0.get(*t).copied().flatten()?, height);
        ring.triangles.iter().filter_map(length).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::Piece;
    use toile_garment::garment::Shape;
    use toile_garment::mesh::PieceMesh;

    /// A tube of cloth of 0.9 m around a pole, made of one piece whose ends are sewn, stretched by a tenth around.
    fn garment() -> Garment {
        const SIDES: u32 = 180;
        let radius = 0.99 / std::f64::consts::TAU;
        let (mut rest, mut worn, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..=4_u32 {
            for k in 0..=SIDES {
                let share = f64::from(k) / f64::from(SIDES);
                let (s, c) = libm::sincos(std::f64::consts::TAU * share);
                rest.push(Vec2::new(0.9 * share, 0.1 * f64::from(row)));
                worn.push(Vec3::new(radius * c, 0.7 + 0.1 * f64::from(row), radius * s));
            }
        }
        for cell in 0..4 * SIDES {
            let a = cell / SIDES * (SIDES + 1) + cell % SIDES;
            triangles.extend([[a, a + 1, a + SIDES + 2], [a, a + SIDES + 2, a + SIDES + 1]]);
        }
        let end = |v| toile_garment::MeshVertex { piece: 0_usize.into(), vertex: v };
        let stitch = |row: u32| {
            let a = row * (SIDES + 1);
            toile_garment::seam::Stitch { a: end(a), b: end(a + SIDES) }
        };
        let seam = crate::testing::sewn("back", (0..=4).map(stitch).collect());
        let mesh = PieceMesh { rest, triangles, ..PieceMesh::default() };
        Garment {
            pieces: vec![Piece { name: "tube".into(), mesh: Some(mesh), ..Piece::default() }],
            seams: vec![seam],
            drape: Some(Shape { positions: vec![worn], ..Shape::default() }),
            body: Some(Body { measures: [("hip_height".to_owned(), 0.84)].into(), ..Body::default() }),
            ..Garment::default()
        }
    }

    #[test]
    fn a_tube_measures_its_pattern_at_rest_and_its_girth_as_worn() {
        let fit = measure(&garment());
        let names: Vec<&str> = fit.levels.iter().map(|l| l.name.as_str()).collect();
        assert_eq!(names, ["hip"]);
        let hip = &fit.levels[0];
        assert!((hip.pattern - 0.9).abs() < 1e-9, "{}", hip.pattern);
        assert!((hip.along - 0.99).abs() < 1e-3 && (hip.tape - 0.99).abs() < 1e-3);
        assert_eq!((hip.height, hip.body), (0.84, None));
        assert_eq!(fit.edges.len(), 2);
        assert!(fit.edges[0].height < fit.edges[1].height && (fit.edges[0].length - 0.99).abs() < 1e-3);
        let names: Vec<String> = fit.measures().into_iter().map(|m| m.name).filter(|n| !n.contains("_girth")).collect();
        let level = ["hem_front_above_back", "hem_left_above_right"];
        assert_eq!(names, [&["hem", "hem", "top_edge", "top_edge", "total_length"][..], &level].concat());
        assert!(fit.balance.iter().all(|b| b.value.abs() < 1e-9));
        assert!(fit.edges.iter().all(|e| (e.pattern - 0.9).abs() < 1e-9));
        // The middle of the tube as a piece: 0.9 m around, worn 0.99 m.
        let width = fit.pieces[0].width;
        assert!((width[0] - 0.9).abs() < 1e-9 && (width[1] - 0.99).abs() < 1e-3, "{width:?}");
    }

    /// A plane through the sleeves cuts one ring around trunk and arms, which is no girth of the bust.
    #[test]
    fn cloth_with_sleeves_is_measured_below_the_armholes() {
        let mut garment = garment();
        let arm = BodySegment {
            from: Vec3::new(0.1, 0.95, 0.0),
            to: Vec3::new(0.1, 0.8, 0.0),
            half_width: 0.04,
            half_depth: 0.04,
        };
        garment.body.as_mut().expect("body").segments.insert("arm-left".to_owned(), arm);
        let height = measure(&garment).levels[0].height;
        assert!((0.79..0.8).contains(&height), "{height}");
    }
}
