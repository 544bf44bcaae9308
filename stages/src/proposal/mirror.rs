//! Which atom is the mirror image of which.
//!
//! A garment is usually the same on both sides, so a seam on one side tells the seam on the other. Pieces are compared
//! as rings of atoms. A piece is the mirror image of another one, or of itself about an axis.

use super::atoms::{Layout, Panel};
use super::profile::heading;
use super::tuning;
use crate::sewing::ring::{arcs, nearest_on};
use toile_garment::Vec2;

/// No mirror image.
pub const ALONE: usize = usize::MAX;

/// The mirror images of panels and atoms.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// For every atom its image, or [`ALONE`].
    pub atom: Vec<usize>,
    /// For every panel its image, or [`ALONE`].
    pub panel: Vec<usize>,
}

impl Mirror {
    /// A garment in which nothing mirrors anything.
    pub fn none(layout: &Layout) -> Self {
        Self { atom: vec![ALONE; layout.atoms.len()], panel: vec![ALONE; layout.panels.len()] }
    }

    /// The image of an atom.
    pub fn of(&self, atom: usize) -> Option<usize> {
        Some(self.atom[atom]).filter(|a| *a != ALONE)
    }

    /// Notes that a reflection carries one panel onto another; atoms whose ends are carried onto ends are images.
    fn set(&mut self, layout: &Layout, p: usize, q: usize, reflection: &Reflection) {
        let near = |u: Vec2, v: Vec2| (reflection.of(u) - v).norm() < tuning::SAME_PLACE;
        let ends = |a: usize| (layout.atoms[a].points[0], layout.atoms[a].points[layout.atoms[a].points.len() - 1]);
        for a in layout.panels[p].atoms.clone() {
            let (start, end) = ends(a);
            let is_image = |b: &usize| near(start, ends(*b).1) && near(end, ends(*b).0);
            if let Some(b) = layout.panels[q].atoms.clone().find(is_image) {
                (self.atom[a], self.atom[b]) = (b, a);
            }
        }
        (self.panel[p], self.panel[q]) = (q, p);
    }
}

/// A reflection of the plane: x ↦ M x + t with M = [[c, s], [s, −c]].
#[derive(Clone, Copy, Debug)]
struct Reflection {
    c: f64,
    s: f64,
    t: Vec2,
}

impl Reflection {
    /// The one that carries two points onto two others, as far as their distance allows.
    fn through(p: [Vec2; 2], q: [Vec2; 2]) -> Self {
        let double = heading(p[1] - p[0]) + heading(q[1] - q[0]);
        let (c, s) = (libm::cos(double), libm::sin(double));
        let (m, n) = ((p[0] + p[1]) / 2.0, (q[0] + q[1]) / 2.0);
        Self { c, s, t: n - Vec2::new(c * m.x + s * m.y, s * m.x - c * m.y) }
    }

    fn of(&self, p: Vec2) -> Vec2 {
        Vec2::new(self.c * p.x + self.s * p.y, self.s * p.x - self.c * p.y) + self.t
    }

    /// Angle between its axis and a direction, radians from 0 (along) to π/2 (across).
    fn off(&self, direction: Vec2) -> f64 {
        let axis = 0.5 * libm::atan2(self.s, self.c);
        libm::acos(libm::cos(axis - heading(direction)).abs().min(1.0))
    }
}

/// The clear corners of a panel, in walking order.
fn corners(layout: &Layout, panel: &Panel) -> Vec<Vec2> {
    let clear = |a: &usize| {
        let joint = layout.atoms[*a].joint;
        joint.is_corner() && (joint.angle - std::f64::consts::PI).abs() > tuning::CLEAR_CORNER
    };
    panel.atoms.clone().filter(clear).map(|a| layout.atoms[a].points[0]).collect()
}

/// All reflections that carry the outline of one panel onto that of another.
fn reflections(layout: &Layout, p: &Panel, q: &Panel) -> Vec<(f64, Reflection)> {
    let (from, onto) = (corners(layout, p), corners(layout, q));
    let n = from.len();
    if n != onto.len() || n < 2 || (p.perimeter - q.perimeter).abs() > 0.01 * p.perimeter {
        return Vec::new();
    }
    let far = (1..n).max_by(|i, j| (from[*i] - from[0]).norm().total_cmp(&(from[*j] - from[0]).norm())).unwrap_or(1);
    (0..n)
        .map(|k| (onto[k], onto[(k + n - far) % n]))
        .filter(|(u, v)| ((u - v).norm() - (from[far] - from[0]).norm()).abs() < 2.0 * tuning::SAME_PLACE)
        .map(|(u, v)| Reflection::through([from[0], from[far]], [u, v]))
        .map(|r| (off_outline(layout, p, q, &r), r))
        .filter(|(off, _)| *off < tuning::SAME_OUTLINE)
        .collect()
}

/// Is a panel its own mirror image?
pub fn is_own_image(layout: &Layout, panel: &Panel) -> bool {
    !reflections(layout, panel, panel).is_empty()
}

/// Largest distance of the outline of a reflected panel from that of another, metres.
fn off_outline(layout: &Layout, p: &Panel, q: &Panel, r: &Reflection) -> f64 {
    let onto: Vec<Vec2> = q.atoms.clone().flat_map(|a| layout.atoms[a].points.iter().copied()).collect();
    let arc = arcs(&onto, true);
    let off = |a: usize| {
        let points = &layout.atoms[a].points;
        let step = (points.len() / 8).max(1);
        points.iter().step_by(step).map(|p| nearest_on(&onto, &arc, true, r.of(*p)).1).fold(0.0, f64::max)
    };
    p.atoms.clone().map(off).fold(0.0, f64::max)
}

/// The likely maps, the likeliest first; at least one.
///
/// Where pieces are congruent and each its own mirror image, they may be left and right, or lie on the middle. Then
/// there is a map for each.
pub fn maps(layout: &Layout, namesakes: &dyn Fn(usize, usize) -> bool) -> Vec<Mirror> {
    let count = layout.panels.len();
    let mut base = Mirror::none(layout);
    let alone = |p| reflections(layout, p, p).into_iter().map(|(_, r)| r).collect();
    let own: Vec<Vec<Reflection>> = layout.panels.iter().map(alone).collect();
    // Chiral pairs: each other's image and not their own; the best fit first.
    let mut fits = Vec::new();
    for p in 0..count {
        for q in (p + 1..count).filter(|q| own[p].is_empty() && own[*q].is_empty()) {
            let best = reflections(layout, &layout.panels[p], &layout.panels[q]).into_iter();
            fits.extend(best.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(off, r)| (!namesakes(p, q), off, p, q, r)));
        }
    }
    fits.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then((a.2, a.3).cmp(&(b.2, b.3))));
    let chiral = !fits.is_empty();
    for (_, _, p, q, reflection) in &fits {
        if base.panel[*p] == ALONE && base.panel[*q] == ALONE {
            base.set(layout, *p, *q, reflection);
        }
    }
    // Pieces that are their own image: about the axis along the warp; or congruent ones by twos.
    let groups = congruent(layout, &own);
    let mut maps = vec![base];
    for group in &groups {
        let single = |map: &Mirror| {
            let mut map = map.clone();
            for p in group {
                if let Some((_, reflection)) = best_reflection(layout, *p, *p) {
                    map.set(layout, *p, *p, &reflection);
                }
            }
            map
        };
        let paired = |map: &Mirror| {
            let mut map = map.clone();
            for (p, q, reflection) in by_twos(layout, group, namesakes) {
                map.set(layout, p, q, &reflection);
            }
            map
        };
        let mut next = Vec::new();
        for map in &maps {
            let pairs_up = group.len() % 2 == 0 && chiral;
            if group.len() <= 2 {
                next.push(single(map));
            }
            if pairs_up {
                next.push(paired(map));
            }
            if group.len() > 2 && !pairs_up {
                // A ring of panels, sewn each to the next.
                next.push(map.clone());
            }
        }
        next.truncate(tuning::MOST_MAPS);
        maps = next;
    }
    maps
}

/// The direction of the axis about which a panel is likely the same: across a band, else along the warp.
fn upright(layout: &Layout, panel: &Panel) -> Vec2 {
    let longest = panel.atoms.clone().max_by(|a, b| layout.atoms[*a].length.total_cmp(&layout.atoms[*b].length));
    match longest.map(|a| &layout.atoms[a]) {
        Some(atom) if panel.slenderness < tuning::BAND => {
            let chord = atom.points[atom.points.len() - 1] - atom.points[0];
            Vec2::new(-chord.y, chord.x)
        }
        _ => panel.warp,
    }
}

/// The atoms of a panel that a reflection carries onto atoms of another.
fn carried(layout: &Layout, p: usize, q: usize, reflection: &Reflection) -> usize {
    let mut map = Mirror::none(layout);
    map.set(layout, p, q, reflection);
    layout.panels[p].atoms.clone().filter(|a| map.atom[*a] != ALONE).count()
}

/// The reflection that carries most atoms of a panel onto those of another; among equals the most upright one.
fn best_reflection(layout: &Layout, p: usize, q: usize) -> Option<(usize, Reflection)> {
    let upright = upright(layout, &layout.panels[p]);
    let all = reflections(layout, &layout.panels[p], &layout.panels[q]).into_iter();
    let counted = all.map(|(_, r)| (carried(layout, p, q, &r), r));
    counted.min_by(|a, b| b.0.cmp(&a.0).then(a.1.off(upright).total_cmp(&b.1.off(upright))))
}

/// Congruent panels by twos: namesakes, then those whose marks agree best, then in the order of the file.
fn by_twos(
    layout: &Layout,
    group: &[usize],
    namesakes: &dyn Fn(usize, usize) -> bool,
) -> Vec<(usize, usize, Reflection)> {
    let mut all = Vec::new();
    for (k, p) in group.iter().enumerate() {
        for q in &group[k + 1..] {
            if let Some((count, reflection)) = best_reflection(layout, *p, *q) {
                all.push((!namesakes(*p, *q), usize::MAX - count, *p, *q, reflection));
            }
        }
    }
    all.sort_by_key(|x| (x.0, x.1, x.2, x.3));
    let mut out: Vec<(usize, usize, Reflection)> = Vec::new();
    for (_, _, p, q, reflection) in all {
        if !out.iter().any(|(x, y, _)| [*x, *y].contains(&p) || [*x, *y].contains(&q)) {
            out.push((p, q, reflection));
        }
    }
    out
}

/// Panels that are their own images, in groups of congruent ones.
fn congruent(layout: &Layout, own: &[Vec<Reflection>]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for p in (0..own.len()).filter(|p| !own[*p].is_empty()) {
        let fits = |g: &Vec<usize>| !reflections(layout, &layout.panels[g[0]], &layout.panels[p]).is_empty();
        match groups.iter_mut().find(|g| fits(g)) {
            Some(group) => group.push(p),
            None => groups.push(vec![p]),
        }
    }
    groups
}
