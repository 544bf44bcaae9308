//! How a mesh stands: which way is up, where its front is, and its unit.

use super::slices::Slices;
use crate::body::section::{Section, sections};
use toile_garment::Vec3;
use toile_garment::body::Body;

/// Shares of the height at which legs, and at which a trunk, are looked for.
const LEGS: [f64; 6] = [0.12, 0.17, 0.22, 0.27, 0.32, 0.37];
const TRUNK: [f64; 4] = [0.55, 0.60, 0.65, 0.70];
/// Legs and trunk that must be seen.
const ENOUGH: usize = 8;
/// Statures of persons, metres.
const STATURES: std::ops::RangeInclusive<f64> = 0.7..=2.3;
/// Share of the stature under which the crotch of a child lies.
const CHILD: f64 = 0.42;
/// Distance of the feet from the floor that needs no shift, metres.
const FLOOR: f64 = 0.01;

/// A unit of length of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshUnit {
    /// Its name.
    pub name: &'static str,
    /// Its length, metres.
    pub metres: f64,
}

/// Units of meshes.
pub const MESH_UNITS: [MeshUnit; 4] = [
    MeshUnit { name: "m", metres: 1.0 },
    MeshUnit { name: "mm", metres: 1e-3 },
    MeshUnit { name: "cm", metres: 1e-2 },
    MeshUnit { name: "inch", metres: 0.0254 },
];

/// How a mesh stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Stance {
    /// Upwards, an axis of the mesh.
    pub up: Vec3,
    /// To the front, an axis of the mesh.
    pub front: Vec3,
    /// Unit of its coordinates.
    pub unit: MeshUnit,
    /// Lowest height and middle from left to right, in its unit.
    pub floor: f64,
    middle: f64,
}

impl Stance {
    /// The stance of a mesh, in a unit that a person gave or in the one that makes it as high as a person. `None` where no
    /// way to stand it shows two legs under a trunk.
    #[must_use]
    pub fn of(body: &Body, unit: Option<MeshUnit>) -> Option<Self> {
        let axes = [Vec3::y(), Vec3::z(), -Vec3::z(), -Vec3::y(), Vec3::x(), -Vec3::x()];
        let ways = axes.iter().flat_map(|up| across(*up).map(|side| (*up, side)));
        let scored = ways.map(|(up, side)| (legs_and_trunk(body, up, side), up, side));
        let mut best: Option<(usize, Vec3, Vec3)> = None;
        for way in scored {
            if best.is_none_or(|b| way.0 > b.0) {
                best = Some(way);
            }
            if way.0 == LEGS.len() + TRUNK.len() {
                break;
            }
        }
        let (_, up, side) = best.filter(|b| b.0 >= ENOUGH)?;
        let ([floor, top], [left, right]) = (span(body, up), span(body, side));
        let front = front(body, up, side);
        let unit = unit.unwrap_or_else(|| unit_of(body, top - floor, up, side));
        Some(Self { up, front, unit, floor, middle: 0.5 * (left + right) * side.dot(&up.cross(&front)) })
    }

    /// Does the mesh stand as a body has to: metres, y up, z to the front, its feet on the floor?
    #[must_use]
    pub fn is_upright(&self) -> bool {
        self.up == Vec3::y() && self.front == Vec3::z() && self.unit.metres == 1.0 && self.floor.abs() <= FLOOR
    }

    /// The body stood upright, in metres.
    #[must_use]
    pub fn upright(&self, body: &Body) -> Body {
        let mut out = body.clone();
        if self.is_upright() {
            return out;
        }
        let side = self.up.cross(&self.front);
        let steps = |x: f64| crate::body::to_micrometres(x * self.unit.metres);
        let turn = |p: Vec3| {
            Vec3::new(p.dot(&side) - self.middle, p.dot(&self.up) - self.floor, p.dot(&self.front)).map(steps)
        };
        out.positions.iter_mut().for_each(|p| *p = turn(*p));
        out
    }

    /// The stance in words.
    #[must_use]
    pub fn words(&self) -> String {
        let floor = (self.floor * self.unit.metres).abs() > FLOOR;
        let floor =
            if floor { format!(", feet at {:.0} mm", 1e3 * self.floor * self.unit.metres) } else { String::new() };
        format!("{} up, front to {}, {}{floor}", axis(self.up), axis(self.front), self.unit.name)
    }
}

/// The name of an axis.
fn axis(way: Vec3) -> String {
    let at = way.iamax();
    format!("{}{}", if way[at] < 0.0 { "-" } else { "+" }, ["x", "y", "z"][at])
}

/// The two axes across another.
fn across(up: Vec3) -> [Vec3; 2] {
    if up.x != 0.0 {
        [Vec3::y(), Vec3::z()]
    } else if up.y != 0.0 {
        [Vec3::x(), Vec3::z()]
    } else {
        [Vec3::x(), Vec3::y()]
    }
}

/// Lowest and highest place along an axis.
fn span(body: &Body, along: Vec3) -> [f64; 2] {
    body.positions
        .iter()
        .map(|p| p.dot(&along))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)])
}

/// The outlines at a share of the height.
fn at_share(body: &Body, up: Vec3, share: f64) -> Vec<Section> {
    let [low, high] = span(body, up);
    sections(&body.positions, &body.triangles, up * (low + share * (high - low)), up)
}

/// How far an outline reaches along an axis.
fn reach(section: &Section, along: Vec3) -> [f64; 2] {
    let ends = section.points.iter().map(|p| p.dot(&along));
    ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)])
}

/// Counts the heights at which two legs stand beside the middle, or a trunk lies around it.
fn legs_and_trunk(body: &Body, up: Vec3, side: Vec3) -> usize {
    let [left, right] = span(body, side);
    let middle = 0.5 * (left + right);
    let spans = |share: f64| -> Vec<[f64; 2]> { at_share(body, up, share).iter().map(|s| reach(s, side)).collect() };
    let legs = |share: &&f64| {
        let found = spans(**share);
        // A shallow body lies around its middle from front to back, too: legs are apart.
        found.iter().any(|s| s[1] <= middle)
            && found.iter().any(|s| s[0] >= middle)
            && !found.iter().any(|s| s[0] < middle && s[1] > middle)
    };
    let trunk = |share: &&f64| spans(**share).iter().any(|s| s[0] < middle && s[1] > middle);
    LEGS.iter().filter(legs).count() + TRUNK.iter().filter(trunk).count()
}

/// Which way across up and side the front is: where the toes are, or, without feet, away from the seat.
fn front(body: &Body, up: Vec3, side: Vec3) -> Vec3 {
    let ahead = side.cross(&up);
    let [low, high] = span(body, up);
    let height = high - low;
    let of = |share: f64| {
        let found = at_share(body, up, share);
        found
            .iter()
            .map(|s| reach(s, ahead))
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], s| [l.min(s[0]), h.max(s[1])])
    };
    let foot = body.positions.iter().filter(|p| p.dot(&up) - low < 0.035 * height).map(|p| p.dot(&ahead));
    let [heel, toe] = foot.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
    let [back, shin] = of(0.09);
    let leg = 0.5 * (back + shin);
    let clear = toe - heel > 0.1 * height;
    let (seat, waist) = (of(0.51), of(0.62));
    let is_ahead = if clear { toe - leg > leg - heel } else { waist[0] - seat[0] > seat[1] - waist[1] };
    if is_ahead { ahead } else { -ahead }
}

/// The unit that makes the mesh as high as a person. Where two do, the legs decide: those of a child are short.
fn unit_of(body: &Body, height: f64, up: Vec3, side: Vec3) -> MeshUnit {
    let likely: Vec<MeshUnit> = MESH_UNITS.into_iter().filter(|u| STATURES.contains(&(height * u.metres))).collect();
    match likely.as_slice() {
        [] => MESH_UNITS[0],
        [one] => *one,
        [small, large, ..] => {
            let crotch = Slices::crotch(body, up, side);
            if crotch.is_some_and(|share| share < CHILD) { *small } else { *large }
        }
    }
}
