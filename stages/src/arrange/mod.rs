//! A garment arranges itself: every piece gets a place around the body from its role, its seams and the body.
//!
//! The pieces that hang at the shoulders or the waist come first, then what is sewn to it. A piece lies flat before
//! or behind its segment of the body, or it is bent around it. Seams pull the pieces in their planes to where their
//! threads are short.

mod anchors;
mod around;
mod clear;
mod dresser;
mod facing;
mod form;
mod lean;
mod parts;
mod pull;
mod sheet;
mod upright;
mod whole_leg;

pub(crate) use around::{Cylinder, side_angle};
pub use dresser::Segment;
pub use form::Form;
pub use parts::{Arranged, Laid, Whole, arrange_wholes};
pub use sheet::Sheet;

use crate::roles::outline::{Polygon, turned};
use crate::roles::{Join, Part, Role, Upright};
use dresser::{Dresser, Thread};
use facing::Lie;
use pull::GAP;
use toile_garment::body::Body;
use toile_garment::outline::OutlineEdge;
use toile_garment::{Piece, Vec2, Vec3};

/// Free length left where a bent piece meets itself, m.
const RING_GAP: f64 = 0.01;
/// Distance of a bent piece from its segment, m.
const BENT: f64 = 0.02;
/// Mean length of the threads of a piece that lies flat before a body, m. They lead through the body.
const THREAD_USUAL: f64 = 0.25;
/// Length beyond it at which a place is half as sure as its role, m.
const THREAD_DOUBT: f64 = 0.25;

/// The place of a piece.
#[derive(Clone, Debug)]
pub struct Place {
    /// Segment of the body that it lies on.
    pub segment: Segment,
    /// Where it lies.
    pub sheet: Sheet,
    /// How sure the place is, from 0 to 1.
    pub confidence: f64,
}

impl Place {
    /// Rows of the rotation: world = rotation · [x, y, 0] + translation. A bent piece is taken flat in its middle.
    #[must_use]
    pub fn rotation(&self) -> [[f64; 3]; 3] {
        self.sheet.rotation()
    }

    /// Where the origin of the piece goes, m.
    #[must_use]
    pub fn translation(&self) -> Vec3 {
        self.sheet.origin
    }
}

/// An edge that the body has to hold, so that the garment stays up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Held {
    /// Piece.
    pub piece: usize,
    /// Number of the edge.
    pub edge: u32,
}

/// An arranged garment.
#[derive(Clone, Debug)]
pub struct Arrangement {
    /// Places of all pieces; `None` where a piece has none.
    pub places: Vec<Option<Place>>,
    /// Pieces without a place, and why.
    pub unplaced: Vec<(usize, String)>,
    /// Edges that the body has to hold at the waist; none where the garment hangs at the shoulders or the bust.
    pub held: Vec<Held>,
    /// Mean length of the threads between pieces, m.
    pub mean_thread: f64,
    /// Longest thread, m.
    pub longest_thread: f64,
}

/// A person's own places and layers for the pieces.
#[derive(Clone, Debug)]
pub struct Given {
    /// Places; `None` where the program looks for one.
    pub sheets: Vec<Option<Sheet>>,
    /// Layers; a lower one lies inside.
    pub layers: Vec<i32>,
}

impl Given {
    /// Nothing is said of so many pieces.
    #[must_use]
    pub fn nothing(pieces: usize) -> Self {
        Self { sheets: vec![None; pieces], layers: vec![0; pieces] }
    }
}

/// Arranges pieces around a body, or around a usual one where there is none.
#[must_use]
pub fn arrange(pieces: &[Piece], roles: &[Role], joins: &[Join], body: Option<&Body>, given: Given) -> Arrangement {
    // Everything is worked out with upright pieces. The sheets take in the turn at the end.
    let Upright { turns, outlines, joins } = Upright::of(pieces, joins);
    let upright = |mut sheet: Sheet, turn: &f64| {
        sheet.turn -= turn;
        sheet
    };
    let sheets = given.sheets.into_iter().zip(&turns).map(|(sheet, turn)| Some(upright(sheet?, turn))).collect();
    let given = Given { sheets, ..given };
    let mut d = Dresser::new(outlines, roles, &joins, Form::of(body), given);
    let mut order: Vec<usize> = (0..pieces.len()).filter(|i| d.is_given[*i]).collect();
    for i in order.clone() {
        d.segments[i] = facing::segment_of(&d, i);
    }
    let mut is_first = order.is_empty();
    let mut first_bent: Vec<usize> = Vec::new();
    while let Some(group) = next_group(&d, is_first) {
        let before = order.len();
        let bent = place_group(&mut d, &group, is_first);
        first_bent.extend(bent.into_iter().filter(|_| is_first));
        order.extend(group.iter().filter(|i| d.sheets[**i].is_some()));
        // A second garment, sewn to nothing of the first, hangs by itself.
        is_first = next_group(&d, false).is_none();
        if order.len() == before {
            break;
        }
    }
    first_bent.iter().for_each(|i| turn_to_threads(&mut d, *i));
    clear::layers(&mut d, &order);
    let mut arrangement = told(&d, pieces, &turns);
    for (place, turn) in arrangement.places.iter_mut().zip(&turns) {
        place.iter_mut().for_each(|place| place.sheet.turn += turn);
    }
    arrangement
}

/// The pieces that are sewn on when all others are sewn: collars that are folded over themselves or over stands, and these
/// stands.
#[must_use]
pub fn sewn_last(pieces: &[Piece], roles: &[Role], joins: &[Join]) -> Vec<usize> {
    let outlines = pieces.iter().map(Polygon::of).collect();
    let d = Dresser::new(outlines, roles, joins, Form::of(None), Given::nothing(pieces.len()));
    let with_stands = |i: usize| d.stands_under(i).flat_map(move |stand| [i, stand]);
    let is_folded = |i: &usize| d.part(*i) == Some(Part::Collar) && !pieces[*i].folds.is_empty();
    let all = 0..pieces.len();
    let mut last: Vec<usize> = all.clone().flat_map(with_stands).chain(all.filter(is_folded)).collect();
    last.sort_unstable();
    last.dedup();
    last
}

/// The order in which parts are placed.
fn rank(part: Option<Part>) -> usize {
    match part {
        Some(Part::Bodice | Part::Yoke) => 0,
        Some(Part::Waistband | Part::Strap | Part::Sleeve | Part::Stand) => 1,
        Some(Part::Skirt | Part::Leg | Part::Collar | Part::Hood) => 2,
        Some(Part::Tier | Part::Godet) => 3,
        Some(Part::Cuff) => 4,
        _ => 5,
    }
}

/// The pieces that are placed next: those of the lowest rank that are sewn to what is placed, with their like.
fn next_group(d: &Dresser<'_>, is_first: bool) -> Option<Vec<usize>> {
    let is_open = |i: &usize| d.sheets[*i].is_none() && !d.threads[*i].is_empty();
    let is_ready = |i: &usize| is_open(i) && (is_first || d.hung(*i).next().is_some());
    let count = d.sheets.len();
    let lowest = (0..count).filter(is_ready).map(|i| rank(d.part(i))).min()?;
    let mut group: Vec<usize> = (0..count).filter(is_ready).filter(|i| rank(d.part(*i)) == lowest).collect();
    let mut next = 0;
    while next < group.len() {
        for t in &d.threads[group[next]] {
            let k = t.other.piece;
            if is_open(&k) && rank(d.part(k)) == lowest && !group.contains(&k) {
                group.push(k);
            }
        }
        next += 1;
    }
    group.sort_unstable();
    Some(group)
}

/// Places a group of pieces. Gives those that are bent around their segments, with no way to face that is known.
fn place_group(d: &mut Dresser<'_>, group: &[usize], is_first: bool) -> Vec<usize> {
    for i in group {
        d.segments[*i] = facing::segment_of(d, *i);
    }
    let mut bent: Vec<(usize, Option<f64>)> = Vec::new();
    let mut flat: Vec<usize> = Vec::new();
    let mut ring: Vec<(usize, f64)> = Vec::new();
    let mut open: Vec<usize> = group.to_vec();
    // What faces a known way comes first; it tells the rest.
    while !open.is_empty() {
        let lies: Vec<(usize, Lie)> = open.iter().filter_map(|i| Some((*i, facing::lie_of(d, *i)?))).collect();
        if lies.is_empty() {
            let found = facing::ring(d, &open);
            ring.extend(found.iter().filter(|_| found.len() > 2));
            found.iter().for_each(|(i, azimuth)| lay_flat(d, *i, *azimuth));
            flat.extend(found.iter().map(|(i, _)| *i));
            open.retain(|i| found.iter().all(|(f, _)| f != i));
            continue;
        }
        for (i, lie) in &lies {
            match lie {
                Lie::Flat(azimuth) => {
                    lay_flat(d, *i, *azimuth);
                    flat.push(*i);
                    if d.roles[*i].facing.is_none() && matches!(d.part(*i), Some(Part::Skirt)) {
                        ring.push((*i, *azimuth));
                    }
                }
                Lie::Bent(azimuth) => bent.push((*i, *azimuth)),
            }
        }
        settle_flat(d, &flat, is_first);
        open.retain(|i| lies.iter().all(|(l, _)| l != i));
    }
    settle_flat(d, &flat, is_first);
    if ring.len() > 2 {
        clear::ring_room(d, &ring);
    }
    clear::side_by_side(d, &flat);
    flat.iter().for_each(|i| lean::over_leg(d, *i));
    for (i, azimuth) in &bent {
        lay_bent(d, *i, *azimuth, is_first);
        clear::around_neck(d, *i);
    }
    bent.into_iter().filter(|(_, azimuth)| azimuth.is_none()).map(|(i, _)| i).collect()
}

/// A flat piece on the axis of its segment, facing an azimuth.
fn lay_flat(d: &mut Dresser<'_>, i: usize, azimuth: f64) {
    let segment = if d.segments[i] == Segment::Neck { &d.form.torso } else { d.segment(i) };
    let [front, left] = dresser::across_segment(segment);
    let (s, c) = libm::sincos(azimuth);
    let up = if matches!(d.segments[i], Segment::Arm(_)) { segment.from - segment.to } else { Vec3::y() };
    let mut sheet = Sheet::facing(front * c + left * s, up, upright::turn_of(d, i));
    sheet.origin = (segment.from + segment.to) * 0.5 - sheet.direction(d.outlines[i].centroid());
    d.sheets[i] = Some(sheet);
}

/// Pulls flat pieces to where they are sewn, and puts them off the body.
fn settle_flat(d: &mut Dresser<'_>, flat: &[usize], is_first: bool) {
    // Where a piece lies along its normal depends on where it lies in its plane, and hardly the other way round.
    for _ in 0..2 {
        let anchors = if is_first { anchors::anchors(d, flat) } else { Vec::new() };
        pull::pull(d, flat, &anchors);
        flat.iter().for_each(|i| clear::off_body(d, *i));
    }
}

/// Bends a piece around its segment where its threads are short.
fn lay_bent(d: &mut Dresser<'_>, i: usize, azimuth: Option<f64>, is_first: bool) {
    let turn = upright::turn_of(d, i);
    let middle = d.middle(i, turn);
    let segment = d.segment(i).clone();
    let Some(mut sheet) = Sheet::around(&segment, BENT, turn, middle, azimuth.unwrap_or(0.0), 0.0) else { return };
    let halves = if d.is_whole_leg(i) { 2.0 } else { 1.0 };
    let width = halves * d.outlines[i].map(|p| turned(p, turn)).size().x;
    let short = width + RING_GAP - sheet.girth().unwrap_or(0.0);
    sheet.widen(short.max(0.0) / std::f64::consts::TAU * 1.05);
    let threads = threads_around(d, i, &sheet);
    let angle = azimuth.or(threads.map(|t| t.angle)).unwrap_or(0.0);
    let axial = threads.map_or_else(|| axial_at_start(d, i, turn, is_first), |t| t.axial);
    let clearance = BENT + short.max(0.0) / std::f64::consts::TAU * 1.05;
    d.sheets[i] = Sheet::around(&segment, clearance, turn, middle, angle, axial);
    whole_leg::lay_on_cone(d, i);
}

/// The place of the middle of a bent piece at which its threads are short.
#[derive(Clone, Copy)]
struct Around {
    /// Angle about the axis of its segment, rad.
    angle: f64,
    /// Distance along that axis, m.
    axial: f64,
}

/// Where the threads of a bent piece lead it; `None` where nothing that it is sewn to has a place.
fn threads_around(d: &Dresser<'_>, i: usize, sheet: &Sheet) -> Option<Around> {
    let segment = d.segment(i);
    let axis = (segment.to - segment.from).normalize();
    let radius = sheet.girth()? / std::f64::consts::TAU;
    let middle = d.middle(i, sheet.turn);
    let (mut axial, mut sin, mut cos, mut all) = (0.0, 0.0, 0.0, 0.0);
    for (t, p) in d.hung(i) {
        let q = turned(t.at, sheet.turn) - middle;
        axial += t.share * ((p - segment.from).dot(&axis) + q.y + gap_around(d, i, t, sheet.turn));
        let (s, c) = libm::sincos(facing::azimuth_of(d, i, p) - q.x / radius);
        (sin, cos, all) = (sin + t.share * s, cos + t.share * c, all + t.share);
    }
    (all > 0.0).then(|| Around { angle: libm::atan2(sin, cos), axial: axial / all })
}

/// How much farther along the axis a bent piece lies than its thread tells, m. It would touch the piece that it is sewn to if
/// that is bent around the same segment, as a cuff and its sleeve are.
fn gap_around(d: &Dresser<'_>, i: usize, thread: &Thread, turn: f64) -> f64 {
    let other = thread.other.piece;
    let is_bent = d.sheets[other].as_ref().is_some_and(|s| s.bend.is_some());
    let would_touch = is_bent && d.segments[other] == d.segments[i] && !d.folds_over(i, other);
    if would_touch { GAP * turned(thread.outwards, turn).y } else { 0.0 }
}

/// Turns a piece, that was bent around its segment before anything that it is sewn to was placed, to where its threads
/// are short.
fn turn_to_threads(d: &mut Dresser<'_>, i: usize) {
    let Some(sheet) = &d.sheets[i] else { return };
    let Some(around) = threads_around(d, i, sheet) else { return };
    if let Some(sheet) = &mut d.sheets[i] {
        sheet.turn_to(around.angle);
    }
}

/// Distance of the middle along the axis of a piece that is sewn to nothing yet: its top is at the waist.
fn axial_at_start(d: &Dresser<'_>, i: usize, turn: f64, is_first: bool) -> f64 {
    let half = 0.5 * d.outlines[i].map(|p| turned(p, turn)).size().y;
    let segment = d.segment(i);
    let top = if is_first && d.segments[i] == Segment::Torso { segment.from.y - d.form.waist } else { 0.0 };
    top + half
}

/// Places with their confidence, and how long the threads are. `turns` brought the pieces upright.
fn told(d: &Dresser<'_>, pieces: &[Piece], turns: &[f64]) -> Arrangement {
    let mut arrangement = Arrangement {
        places: Vec::new(),
        unplaced: Vec::new(),
        held: held(d, pieces, turns),
        mean_thread: 0.0,
        longest_thread: 0.0,
    };
    let (mut sum, mut all) = (0.0, 0.0);
    for i in 0..pieces.len() {
        let Some(sheet) = &d.sheets[i] else {
            arrangement.places.push(None);
            arrangement.unplaced.push((i, reason(d, i)));
            continue;
        };
        let (mut own, mut share) = (0.0, 0.0);
        for (t, p) in d.hung(i) {
            let length = (sheet.at(t.at) - p).norm();
            own += t.share * length;
            share += t.share;
            arrangement.longest_thread = arrangement.longest_thread.max(length);
        }
        (sum, all) = (sum + own, all + share);
        let doubt = if share > 0.0 { (own / share - THREAD_USUAL).max(0.0) / THREAD_DOUBT } else { 1.0 };
        let role = if d.roles[i].confidence > 0.0 { d.roles[i].confidence } else { 0.5 };
        let confidence = if d.is_given[i] { 1.0 } else { role / (1.0 + doubt * doubt) };
        arrangement.places.push(Some(Place { segment: d.segments[i], sheet: sheet.clone(), confidence }));
    }
    arrangement.mean_thread = if all > 0.0 { sum / all } else { 0.0 };
    arrangement
}

fn reason(d: &Dresser<'_>, i: usize) -> String {
    if d.threads[i].is_empty() {
        "it is sewn to nothing".to_owned()
    } else {
        "what it is sewn to has no place".to_owned()
    }
}

/// The free upper edges of a skirt or of trousers, where nothing above holds them.
fn held(d: &Dresser<'_>, pieces: &[Piece], turns: &[f64]) -> Vec<Held> {
    let has = |parts: &[Part]| (0..pieces.len()).any(|i| d.part(i).is_some_and(|p| parts.contains(&p)));
    if has(&[Part::Bodice, Part::Strap, Part::Sleeve]) {
        return Vec::new();
    }
    let lowest = (0..pieces.len()).map(|i| rank(d.part(i))).min();
    let mut held = Vec::new();
    for piece in pieces.iter().filter(|p| Some(rank(d.part(p.id.index()))) == lowest) {
        let free = anchors::free_upper_points(d, piece.id.index());
        for edge in &piece.edges {
            let line: Vec<Vec2> =
                edge_line(piece, edge).into_iter().map(|p| turned(p, turns[piece.id.index()])).collect();
            let length: f64 = line.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            let on_edge = |p: &Vec2| line.windows(2).any(|w| distance(*p, w[0], w[1]) < ON_EDGE);
            let covered: f64 = free.iter().filter(|(p, _)| on_edge(p)).map(|(_, l)| l).sum();
            if covered > 0.6 * length {
                held.push(Held { piece: piece.id.index(), edge: edge.index });
            }
        }
    }
    held
}

/// Distance within which a point of the mesh, or of a part, lies on a drawn edge, m.
const ON_EDGE: f64 = 0.002;

/// The points of an edge of the outline, in order.
fn edge_line(piece: &Piece, edge: &OutlineEdge) -> Vec<Vec2> {
    let points = &piece.outline.points;
    let n = points.len();
    let steps = (edge.to as usize + n - edge.from as usize) % n.max(1);
    (0..=steps).filter_map(|k| points.get((edge.from as usize + k) % n).map(|p| p.at)).collect()
}

/// Distance of a point from a line between two ends, m.
fn distance(p: Vec2, from: Vec2, to: Vec2) -> f64 {
    let along = to - from;
    let share = ((p - from).dot(&along) / along.norm_squared().max(1e-18)).clamp(0.0, 1.0);
    (p - from - along * share).norm()
}

#[cfg(test)]
pub(crate) mod tests;
