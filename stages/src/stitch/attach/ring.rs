//! Level rings around the body, as a tape lies.

use crate::body::{Section, hull, section_at};
use crate::codes::BODY_MISSING;
use crate::stitch::codes;
use toile_garment::body::Body;
use toile_garment::{Diagnostic, Garment, Vec2, Vec3};

/// A landmark this far beside a section is not on it, m.
const BESIDE: f64 = 0.02;

/// Largest gap of an open section, as a share of its girth.
const LARGEST_GAP: f64 = 0.1;

/// A tape around the body: a convex ring at one height.
pub struct Ring {
    points: Vec<Vec3>,
    arc: Vec<f64>,
}

/// Height and level section of the body at a landmark or height. An open mesh may have a gap there, but no more than a
/// share of it.
pub fn section(garment: &Garment, to: &str) -> Result<(f64, Section), Diagnostic> {
    let (body, landmark, height) = target(garment, to)?;
    let sound = |s: &Section| s.girth() > 0.0 && s.gap() <= LARGEST_GAP * s.girth();
    let found = section_at(body, height).filter(sound).ok_or_else(|| {
        let (low, high) = extent(body);
        let message = format!(
            "the body goes not all the way round at `{to}`, {:.0} mm: its mesh ends or is torn there",
            height * 1e3
        );
        let hint = format!(
            "the mesh reaches from {:.0} to {:.0} mm; give a whole body, or set `{to}` in its side file",
            low * 1e3 + 0.0,
            high * 1e3
        );
        Diagnostic::error(codes::ATTACH_TARGET_EMPTY, message).hint(hint)
    })?;
    if is_round(&found, landmark) {
        return Ok((height, found));
    }
    let message =
        format!("an edge is attached to `{to}`, which lies on an arm or a leg, at a height of {:.0} mm", height * 1e3);
    let remedy =
        "edges are held around the trunk or the neck: give a sleeve or a leg an [[elastic]] along its edge instead";
    Err(Diagnostic::error(codes::ATTACH_TO_LIMB, message).hint(format!("{remedy}; {}", known(body))))
}

/// The body, the landmark of this name if it is one, and its height.
pub fn target<'g>(garment: &'g Garment, to: &str) -> Result<(&'g Body, Option<Vec3>, f64), Diagnostic> {
    let body = garment.body.as_ref().ok_or_else(|| {
        Diagnostic::error(BODY_MISSING, format!("an edge is attached to `{to}`, but there is no body"))
            .hint("give the stage `stitch` a body: with.body = \"…obj\"")
    })?;
    let landmark = body.landmarks.get(to).or_else(|| body.landmarks.get(&format!("{to}-front"))).copied();
    let height = landmark.map(|p| p.y).or_else(|| body.measures.get(&format!("{to}_height")).copied());
    let unknown = || {
        let message = format!("the body has no landmark or height `{to}`");
        Diagnostic::error(codes::ATTACH_TARGET_UNKNOWN, message).hint(known(body))
    };
    height.ok_or_else(unknown).map(|height| (body, landmark, height))
}

/// The landmarks that an edge can be attached to.
fn known(body: &Body) -> String {
    let of_trunk = body.landmarks.iter().filter(|(_, p)| section_at(body, p.y).is_none_or(|s| is_round(&s, Some(**p))));
    match of_trunk.map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ") {
        names if names.is_empty() => "no side file tells its landmarks; `toile body measure` writes one".to_owned(),
        names => format!("this body has the landmarks {names}"),
    }
}

/// Does a level section go round the trunk or the neck, and does a landmark lie on it? Beside the middle lies a limb.
fn is_round(section: &Section, landmark: Option<Vec3>) -> bool {
    let (low, high) = section.bounds();
    let (middle, half) = (0.5 * (low.x + high.x), 0.5 * (high.x - low.x));
    middle.abs() < 0.5 * half && landmark.is_none_or(|p| (p.x - middle).abs() < half + BESIDE)
}

/// Lowest and highest point of the triangles, metres.
fn extent(body: &Body) -> (f64, f64) {
    let heights = body.triangles.iter().flatten().filter_map(|v| Some(body.positions.get(*v as usize)?.y));
    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)))
}

impl Ring {
    /// The convex outline of a level section, moved outwards by `gap`; starts at the front, runs to the wearer's left.
    pub fn around(section: &Section, gap: f64) -> Self {
        let height = section.points.first().map_or(0.0, |p| p.y);
        // In the plane (z, x) a counter-clockwise hull runs from the front to the wearer's left.
        let hull = hull(section.points.iter().map(|p| Vec2::new(p.z, p.x)).collect());
        let n = hull.len();
        let outwards = |a: Vec2, b: Vec2| Vec2::new(b.y - a.y, a.x - b.x).normalize();
        let mut points = Vec::with_capacity(n);
        for i in 0..n {
            let (a, b, c) = (hull[(i + n - 1) % n], hull[i], hull[(i + 1) % n]);
            let (u, v) = (outwards(a, b), outwards(b, c));
            let mitre = (u + v) / (1.0 + u.dot(&v)).max(0.2);
            let p = b + mitre * gap;
            points.push(Vec3::new(p.y, height, p.x));
        }
        let front = (0..n).min_by(|a, b| bearing(points[*a]).abs().total_cmp(&bearing(points[*b]).abs())).unwrap_or(0);
        points.rotate_left(front);
        let mut arc = vec![0.0];
        for i in 0..n {
            arc.push(arc[i] + (points[(i + 1) % n] - points[i]).norm());
        }
        Self { points, arc }
    }

    /// Length around, metres.
    pub fn girth(&self) -> f64 {
        self.arc[self.points.len()]
    }

    /// The place at an arc position, metres.
    pub fn at(&self, arc: f64) -> Vec3 {
        let rest = arc.rem_euclid(self.girth());
        let n = self.points.len();
        let i = self.arc.partition_point(|a| *a <= rest).clamp(1, n) - 1;
        let share = (rest - self.arc[i]) / (self.arc[i + 1] - self.arc[i]);
        self.points[i] * (1.0 - share) + self.points[(i + 1) % n] * share
    }

    /// Arc position of the ring's point that lies in the same direction from the middle.
    pub fn arc_towards(&self, p: Vec3) -> f64 {
        let want = bearing(p);
        let near = |q: &Vec3| {
            let d = (bearing(*q) - want).rem_euclid(std::f64::consts::TAU);
            d.min(std::f64::consts::TAU - d)
        };
        let best = (0..self.points.len()).min_by(|a, b| near(&self.points[*a]).total_cmp(&near(&self.points[*b])));
        best.map_or(0.0, |i| self.arc[i])
    }
}

/// Direction from the body's axis: 0 at the front, growing to the wearer's left.
pub fn bearing(p: Vec3) -> f64 {
    libm::atan2(p.x, p.z)
}
