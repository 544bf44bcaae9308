//! Repair of a start that is not free: cloth is pushed out of the body, and pieces are moved apart.

use crate::collision::body::Body;
use crate::collision::broad_phase::aabb::Aabb;
use crate::collision::crossings::count;
use crate::collision::crossings::pair::segment_meets;
use crate::prepare::initial_feasibility::resolve_intersections::resolve_intersections;
use crate::prepare::tuning::{
    BODY_REPAIR_CLEARANCE_GROWTH, BODY_REPAIR_ROUNDS, INTERSECTION_RESOLUTION, PIECES_APART_FIRST, PIECES_APART_GROWTH,
    PIECES_APART_MAX, PIECES_CLEARANCE, REPAIR_TURNS,
};
use crate::scene::topology::Topology;
use crate::{ClothError, Place, Vec3};

/// Distance within which the nearest place on the body is looked for, m.
const NEAREST_PLACE_REACH: f64 = 1.0;
/// Least distance of two middles that gives a direction, m.
const MIDDLE_DISTANCE_MIN: f64 = 1e-9;

/// For every vertex `true` if it is inside the body.
///
/// There is one winding number for each part of the cloth that is joined by edges which do not meet the body.
pub(crate) fn inside(x: &[Vec3], faces: &[[u32; 3]], crossing: &[[u32; 2]], body: &Body) -> Vec<bool> {
    let mut crosses = vec![false; faces.len()];
    for p in crossing {
        crosses[p[0] as usize] = true;
    }
    let free = |e: &[u32; 2]| !meets(e.map(|v| x[v as usize]), body, body.met.ignored_by(*e));
    let links: Vec<[u32; 2]> = faces
        .iter()
        .zip(&crosses)
        .flat_map(|(t, c)| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].into_iter().filter(move |e| !c || free(e)))
        .collect();
    let part = crate::scene::weld::groups(x.len(), &links);
    // A part that reaches out of the body's box is outside and needs no winding number.
    let reaches_out = |(p, q): (&u32, &Vec3)| (!body.may_contain(q)).then_some(*p as usize);
    let mut known: Vec<Option<bool>> = vec![None; x.len()];
    part.iter().zip(x).filter_map(reaches_out).for_each(|p| known[p] = Some(false));
    let within = |p: usize| body.contains(&x[p], body.met.ignored_by_piece(p));
    part.iter().map(|p| *known[*p as usize].get_or_insert_with(|| within(*p as usize))).collect()
}

/// Returns `true` if a segment has a point in common with the surface of the body, without the parts `ignored`.
fn meets([p, q]: [Vec3; 2], body: &Body, ignored: u32) -> bool {
    let mut any = false;
    body.candidates(&Aabb::of_two(&p, &q), |k| {
        any = any || body.met.is_met(k, ignored) && segment_meets(&p, &q, &body.triangle(k));
    });
    any
}

/// Cloth that crosses the body.
struct BodyCrossing {
    /// Triangles of the cloth and of the body that cross.
    found: count::Crossings,
    /// For every vertex `true` if it is inside the body.
    within: Vec<bool>,
    /// Number of vertices inside the body.
    deep: usize,
}

impl BodyCrossing {
    /// `None` where the cloth is free of the body.
    fn of(x: &[Vec3], topology: &Topology, body: &Body) -> Option<Self> {
        let found = count::body_crossings(x, &topology.faces, body);
        let within = inside(x, &topology.faces, &found.pairs, body);
        let deep = within.iter().filter(|w| **w).count();
        (found.count > 0 || deep > 0).then_some(Self { found, within, deep })
    }

    fn error(&self, x: &[Vec3], topology: &Topology) -> ClothError {
        let place = place(x, topology, &self.found.pairs, &self.within);
        ClothError::StartCrosses { self_crossings: 0, body_crossings: self.found.count, inside: self.deep, place }
    }
}

/// Moves vertices inside the body to `gap` (m) in front of it. Returns the number of moved vertices and the largest
/// move, m.
///
/// # Errors
/// A start of which more than a `share` of the vertices is inside, or that stays inside.
pub(crate) fn free_of_body(
    x: &mut [Vec3],
    topology: &Topology,
    body: &Body,
    gap: f64,
    share: f64,
) -> Result<(usize, f64), ClothError> {
    let start = x.to_vec();
    let mut first = None;
    for round in 0..BODY_REPAIR_ROUNDS.get() {
        let Some(crossing) = BodyCrossing::of(x, topology, body) else { return Ok(moves(x, &start)) };
        first.get_or_insert_with(|| crossing.error(x, topology));
        let BodyCrossing { found, within, deep } = crossing;
        if round == 0 && deep as f64 > share * x.len() as f64 {
            break;
        }
        let mut touched = within.clone();
        for p in &found.pairs {
            for v in topology.faces[p[0] as usize] {
                touched[v as usize] = true;
            }
        }
        let clearance = gap * (1.0 + BODY_REPAIR_CLEARANCE_GROWTH.get() * round as f64);
        for i in (0..x.len()).filter(|i| touched[*i]) {
            if let Some((q, d)) =
                body.nearest(&x[i], NEAREST_PLACE_REACH, body.met.ignored_by_piece(i)).filter(|(_, d)| *d > 0.0)
            {
                let out = if within[i] { (q - x[i]) / d } else { (x[i] - q) / d };
                if within[i] || d < clearance {
                    x[i] = q + out * clearance;
                }
            }
        }
    }
    first.map_or(Ok((0, 0.0)), Err)
}

/// Frees cloth of the body, as [`free_of_body`]. Where cloth meets cloth it is freed of itself after every push, because one
/// may undo the other.
///
/// # Errors
/// A start that cannot be freed of the body or of itself, or that still crosses the body after [`REPAIR_TURNS`].
pub(crate) fn free_of_body_in_turns(
    x: &mut [Vec3],
    topology: &Topology,
    body: &Body,
    [gap, share]: [f64; 2],
    held: Option<&[bool]>,
) -> Result<(usize, f64), ClothError> {
    let first = free_of_body(x, topology, body, gap, share)?;
    let Some(held) = held else { return Ok(first) };
    let mut freed = first;
    for _ in 0..REPAIR_TURNS.get() {
        if freed.0 == 0 || free_of_itself(x, topology, held)?.0 == 0 {
            return Ok(first);
        }
        freed = free_of_body(x, topology, body, gap, share)?;
    }
    if freed.0 > 0 && free_of_itself(x, topology, held)?.0 > 0 {
        return BodyCrossing::of(x, topology, body).map_or(Ok(first), |crossing| Err(crossing.error(x, topology)));
    }
    Ok(first)
}

/// A place at which the start is not free.
fn place(x: &[Vec3], topology: &Topology, pairs: &[[u32; 2]], within: &[bool]) -> Place {
    let any = |t: &[u32; 3]| t.iter().any(|v| within[*v as usize]);
    let triangle = pairs
        .first()
        .map_or_else(|| topology.faces.iter().position(any).and_then(|i| u32::try_from(i).ok()).unwrap_or(0), |p| p[0]);
    at_triangle(x, topology, triangle)
}

/// The middle of a triangle.
pub(crate) fn at_triangle(x: &[Vec3], topology: &Topology, triangle: u32) -> Place {
    let t = topology.faces[triangle as usize];
    Place { triangle, at: t.iter().map(|v| x[*v as usize]).sum::<Vec3>() / 3.0 }
}

/// Unit normal of a triangle; the axis z for one without area.
fn normal(x: &[Vec3], t: [u32; 3]) -> Vec3 {
    crate::unit_normal(crate::pick3(x, &t)).unwrap_or_else(Vec3::z)
}

/// Unit vector from the middle of one piece to that of another.
fn direction_between(x: &[Vec3], part: &[u32], [a, b]: [u32; 2]) -> Option<Vec3> {
    let middle = |which: u32| {
        let inside = || x.iter().zip(part).filter(|(_, p)| **p == which);
        inside().map(|(q, _)| *q).sum::<Vec3>() / inside().count() as f64
    };
    (middle(b) - middle(a)).try_normalize(MIDDLE_DISTANCE_MIN)
}

/// Moves one piece back and the other on by half of a way.
fn move_apart(x: &mut [Vec3], part: &[u32], [a, b]: [u32; 2], way: Vec3) {
    for (q, p) in x.iter_mut().zip(part) {
        if *p == a {
            *q -= way * 0.5;
        } else if *p == b {
            *q += way * 0.5;
        }
    }
}

/// Moves pieces that touch or cross at the start apart, whole, along the line of their middles.
///
/// Placements often put neighbours edge to edge in one plane. Returns the number of moved vertices and the largest
/// move, m.
///
/// # Errors
/// A piece that crosses itself, and pieces that still cross after [`PIECES_APART_MAX`].
pub(crate) fn free_of_itself(x: &mut [Vec3], topology: &Topology, held: &[bool]) -> Result<(usize, f64), ClothError> {
    let start = x.to_vec();
    if INTERSECTION_RESOLUTION.is_on() && resolve_intersections(x, topology, held).is_empty() {
        return Ok(moves(x, &start));
    }
    let part = topology.components(x.len());
    let mut step = PIECES_APART_FIRST.get();
    let mut gone = 0.0;
    let mut last = Vec::new();
    loop {
        let found = count::self_crossings(x, &topology.faces);
        let Some(first) = found.pairs.first() else { break };
        let of = |f: u32| part[topology.faces[f as usize][0] as usize];
        let itself = found.pairs.iter().find(|p| of(p[0]) == of(p[1]));
        if gone > PIECES_APART_MAX.get() || itself.is_some() {
            return Err(ClothError::StartCrosses {
                self_crossings: found.count,
                body_crossings: 0,
                inside: 0,
                place: at_triangle(x, topology, itself.unwrap_or(first)[0]),
            });
        }
        let mut pairs: Vec<[u32; 2]> = found.pairs.iter().map(|p| [of(p[0]), of(p[1])]).collect();
        pairs.iter_mut().for_each(|p| p.sort_unstable());
        pairs.sort_unstable();
        pairs.dedup();
        // Pieces with one middle are moved along a normal.
        let across = normal(x, topology.faces[first[0] as usize]);
        last = pairs.into_iter().map(|pair| (pair, direction_between(x, &part, pair).unwrap_or(across))).collect();
        last.iter().for_each(|(pair, way)| move_apart(x, &part, *pair, way * step));
        gone += step;
        step *= PIECES_APART_GROWTH.get();
    }
    // Pieces that are just apart would start with contacts of any stiffness.
    let mut further = x.to_vec();
    last.iter().for_each(|(pair, way)| move_apart(&mut further, &part, *pair, way * PIECES_CLEARANCE.get()));
    if count::self_crossings(&further, &topology.faces).count == 0 {
        x.copy_from_slice(&further);
    }
    Ok(moves(x, &start))
}

/// Number of moved vertices, and the largest move, m.
fn moves(x: &[Vec3], start: &[Vec3]) -> (usize, f64) {
    let moves = x.iter().zip(start).map(|(p, q)| (p - q).norm());
    moves.fold((0, 0.0), |(n, m), d| (n + usize::from(d > 0.0), f64::max(m, d)))
}
