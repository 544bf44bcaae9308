//! Growth of the working line, from that of the drawn vertices.
//!
//! A working line from a dense copy holds the corners of the drawn line. Its curve points stand on the copy or up to
//! two millimetres beside it. Each of them is an anchor where the copy passes it, so that the growth ruled for a curve
//! point is that of the fine curve there.

use super::super::geom;
use super::super::outline::Outline;
use toile_garment::Vec2;

/// A drawn vertex further than this from the working line is none of it (a notch cut into the line), mm.
const BESIDE: f64 = 2.0;
/// A curve point is looked for this far along from where the lengths put it, mm and share of its run.
const WINDOW: (f64, f64) = (10.0, 0.05);

/// Where a growth is known: way along the working line from its first vertex, mm.
#[derive(Clone, Copy)]
struct Anchor {
    along: f64,
    growth: Vec2,
}

/// The closed working line with the way along to each vertex.
struct Way {
    points: Vec<Vec2>,
    /// One more than there are vertices: the last is the whole length.
    along: Vec<f64>,
}

impl Way {
    fn new(points: Vec<Vec2>) -> Self {
        let n = points.len();
        let mut along = vec![0.0; n + 1];
        for i in 0..n {
            along[i + 1] = along[i] + (points[(i + 1) % n] - points[i]).norm();
        }
        Self { points, along }
    }

    fn whole(&self) -> f64 {
        self.along[self.points.len()]
    }

    /// The way to the place nearest to `p` between two ways along, which may go past the end of the line.
    fn nearest(&self, p: Vec2, from: f64, to: f64) -> Option<f64> {
        let (n, whole) = (self.points.len(), self.whole());
        let turns = if from >= whole { whole } else { 0.0 };
        let first = self.along.partition_point(|s| *s <= from - turns).saturating_sub(1).min(n - 1);
        let mut best = (BESIDE, None);
        for k in first.. {
            let (i, past) = (k % n, if k >= n { whole } else { turns });
            let start = self.along[i] + past;
            if start > to || k >= first + n {
                break;
            }
            let (distance, t) = geom::point_segment(p, self.points[i], self.points[(i + 1) % n]);
            let at = start + t * (self.along[i + 1] - self.along[i]);
            if distance < best.0 && (from..=to).contains(&at) {
                best = (distance, Some(at));
            }
        }
        best.1
    }
}

/// Growth of every vertex of the working line, given that of every drawn vertex.
pub fn growths(outline: &Outline, growth: &[Vec2]) -> Vec<Vec2> {
    let way = Way::new(outline.work_positions());
    let anchors = anchors(outline, &way, growth);
    let n = way.points.len();
    let (Some(first), whole) = (anchors.first().copied(), way.whole()) else { return vec![Vec2::zeros(); n] };
    let end = Anchor { along: first.along + whole, ..first };
    (0..n)
        .map(|i| {
            let s = if way.along[i] < first.along { way.along[i] + whole } else { way.along[i] };
            let next = anchors.partition_point(|a| a.along <= s);
            let (a, b) = (anchors[next - 1], anchors.get(next).copied().unwrap_or(end));
            let t = if b.along > a.along { (s - a.along) / (b.along - a.along) } else { 0.0 };
            a.growth + (b.growth - a.growth) * t
        })
        .collect()
}

/// The drawn vertices on the working line, in its order.
fn anchors(outline: &Outline, way: &Way, growth: &[Vec2]) -> Vec<Anchor> {
    let n = outline.drawn.len();
    let placed: Vec<usize> = (0..n).filter(|i| outline.place[*i].is_some()).collect();
    let at = |i: usize| outline.place[i].map_or(0.0, |k| way.along[k]);
    let mut out: Vec<Anchor> = placed.iter().map(|i| Anchor { along: at(*i), growth: growth[*i] }).collect();
    for (k, from) in placed.iter().enumerate() {
        let to = placed[(k + 1) % placed.len()];
        let steps = if k + 1 < placed.len() { to - from } else { to + n - from };
        let end = if at(to) > at(*from) { at(to) } else { at(to) + way.whole() };
        out.extend(run(outline, way, growth, *from, steps, [at(*from), end]));
    }
    let whole = way.whole();
    out.iter_mut().filter(|a| a.along >= whole).for_each(|a| a.along -= whole);
    out.sort_by(|a, b| a.along.total_cmp(&b.along));
    out
}

/// The drawn vertices between two that have their place, each where the working line passes it.
fn run(outline: &Outline, way: &Way, growth: &[Vec2], from: usize, steps: usize, ends: [f64; 2]) -> Vec<Anchor> {
    let n = outline.drawn.len();
    let at = |k: usize| outline.drawn[(from + k) % n].at;
    let drawn: f64 = (0..steps).map(|k| (at(k + 1) - at(k)).norm()).sum();
    if drawn <= 0.0 {
        return Vec::new();
    }
    let scale = (ends[1] - ends[0]) / drawn;
    let window = WINDOW.0.max(WINDOW.1 * (ends[1] - ends[0]));
    let (mut s, mut last) = (0.0, ends[0]);
    let mut out = Vec::new();
    for k in 1..steps {
        s += (at(k) - at(k - 1)).norm();
        let guess = ends[0] + s * scale;
        let Some(found) = way.nearest(at(k), last.max(guess - window), ends[1].min(guess + window)) else { continue };
        out.push(Anchor { along: found, growth: growth[(from + k) % n] });
        last = found;
    }
    out
}
