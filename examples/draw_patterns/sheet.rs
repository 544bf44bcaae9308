//! From a drafted sew line to the drawing of a piece: seam allowance, marks, place on the sheet.

use crate::draft::{Edge, at, band, left};
use toile_formats::dxf::write::{CutNotes, DrawDrill, DrawLine, DrawNotch, DrawPoint, NotchLine, PieceDrawing};
use toile_garment::Vec2;
use toile_garment::notch::NotchKind;
use toile_garment::outline::PointKind;
use toile_garment::piece::Quantity;

/// Seam allowance, mm.
pub const ALLOWANCE: f64 = 10.0;
/// Depth of a slit notch, mm.
const NOTCH_DEPTH: f64 = 5.0;

/// A wedge dart: its two legs are neighbouring edges of the outline.
#[derive(Clone, Copy, Debug)]
pub struct Wedge {
    /// Index of the first leg.
    pub leg: usize,
}

/// A piece as drafted: the sew line and what is marked on it.
#[derive(Clone, Debug, Default)]
pub struct Draft {
    /// Name.
    pub name: &'static str,
    /// Sew line, counter-clockwise, from the first corner.
    pub edges: Vec<Edge>,
    /// Wedge darts.
    pub wedges: Vec<Wedge>,
    /// Fish-eye darts: lower apex, right, upper apex, left.
    pub fish_eyes: Vec<[Vec2; 4]>,
    /// Notches: edge, and distance from its start, mm.
    pub notches: Vec<(usize, f64)>,
    /// Grain line, from below.
    pub grain: [Vec2; 2],
    /// How often it is cut.
    pub quantity: Quantity,
    /// The material it is cut of, `MAIN` when empty.
    pub material: &'static str,
    /// Words for the cutter.
    pub annotation: &'static str,
    /// Where the piece lies on the sheet.
    pub shift: Vec2,
}

/// A point of the sew line that the cut line follows.
struct RingPoint {
    at: Vec2,
    kind: Option<PointKind>,
    /// Edge and fine point.
    edge: (usize, usize),
}

impl Draft {
    /// A straight band with the grain along it; edges as of [`band`].
    pub fn strip(name: &'static str, edges: [&'static str; 4], length: f64, height: f64) -> Self {
        let grain = [0.3, 0.7].map(|share| at(length * share, height / 2.0));
        Self { name, edges: band(edges, length, height), grain, ..Self::default() }
    }

    fn is_leg(&self, edge: usize) -> bool {
        self.wedges.iter().any(|w| edge == w.leg || edge == w.leg + 1)
    }

    /// The two mouth points and the apex of a wedge.
    pub fn wedge(&self, wedge: Wedge) -> [Vec2; 3] {
        [self.edges[wedge.leg].first(), self.edges[wedge.leg + 1].last(), self.edges[wedge.leg].last()]
    }

    fn ring(&self, with_legs: bool) -> Vec<RingPoint> {
        let mut out = Vec::new();
        for (e, edge) in self.edges.iter().enumerate() {
            if !with_legs && self.is_leg(e) {
                continue;
            }
            let mouth = !with_legs && self.is_leg((e + 1) % self.edges.len());
            let n = edge.dense().len() - usize::from(!mouth);
            for (i, at) in edge.dense()[..n].iter().enumerate() {
                let corner = i == 0 || i + 1 == edge.dense().len();
                let kind = if corner { Some(PointKind::Turn) } else { edge.is_marked(i).then_some(PointKind::Curve) };
                out.push(RingPoint { at: *at, kind, edge: (e, i) });
            }
        }
        out
    }

    /// The cut line: 10 mm outside the sew line, straight over the mouths of darts.
    fn cut_ring(&self) -> Vec<RingPoint> {
        let ring = self.ring(false);
        let n = ring.len();
        let moved = |i: usize| {
            let (p, at, q) = (ring[(i + n - 1) % n].at, ring[i].at, ring[(i + 1) % n].at);
            let (a, b) = (-left((at - p).normalize()), -left((q - at).normalize()));
            at + (a + b) * (ALLOWANCE / (1.0 + a.dot(&b)))
        };
        (0..n).map(|i| RingPoint { at: moved(i), kind: ring[i].kind, edge: ring[i].edge }).collect()
    }

    /// A notch on the cut line, square to the sew line.
    fn notch(&self, cut: &[RingPoint], edge: usize, distance: f64) -> DrawNotch {
        let sew = &self.edges[edge];
        let (i, share) = sew.locate(distance);
        let along = sew.dense()[i + 1] - sew.dense()[i];
        let start = cut.iter().position(|p| p.edge == (edge, i)).expect("every edge but a dart leg has a cut line");
        let (p, q) = (cut[start].at, cut[(start + 1) % cut.len()].at);
        let inward = left(along.normalize());
        let target = sew.dense()[i] + along * share;
        // Where the normal of the sew line meets the cut line.
        let d = q - p;
        let cross = inward.x * d.y - inward.y * d.x;
        let t = ((target.x - p.x) * inward.y - (target.y - p.y) * inward.x) / -cross;
        self.slit(p + d * t.clamp(0.0, 1.0), inward)
    }

    fn slit(&self, at: Vec2, inward: Vec2) -> DrawNotch {
        let angle = Some(libm::atan2(inward.y, inward.x).to_degrees());
        DrawNotch {
            kind: NotchKind::Slit,
            at: at + self.shift,
            depth: NOTCH_DEPTH,
            width: 0.0,
            angle,
            on: NotchLine::Cut,
        }
    }

    /// Notches at the mouth, and the drill hole 10 mm short of the apex.
    fn wedge_marks(&self, cut: &[RingPoint], wedge: Wedge) -> ([DrawNotch; 2], Vec2) {
        let [first, second, apex] = self.wedge(wedge);
        let middle = (first + second) / 2.0;
        let inward = (apex - middle).normalize();
        let cut_at = |edge: usize, i: usize| {
            cut.iter().find(|p| p.edge == (edge, i)).map(|p| p.at).expect("mouth points have a cut line")
        };
        let before = (wedge.leg + self.edges.len() - 1) % self.edges.len();
        let after = (wedge.leg + 2) % self.edges.len();
        let ends = [cut_at(before, self.edges[before].dense().len() - 1), cut_at(after, 0)];
        (ends.map(|at| self.slit(at, inward)), apex - inward * 10.0)
    }

    fn line(&self, ring: &[RingPoint]) -> DrawLine {
        let points = ring.iter().filter_map(|p| Some(DrawPoint { at: p.at + self.shift, kind: p.kind? })).collect();
        DrawLine { points, closed: true, dense: Some(ring.iter().map(|p| p.at + self.shift).collect()) }
    }

    /// The drawing of the piece in one size.
    pub fn drawing(&self, size: &str) -> PieceDrawing {
        let cut = self.cut_ring();
        let (material, category) = match self.material {
            "" => ("MAIN", "SHELL"),
            other => (other, other),
        };
        let mut notches: Vec<_> = self.notches.iter().map(|(e, d)| self.notch(&cut, *e, *d)).collect();
        let mut drill_holes = Vec::new();
        for wedge in &self.wedges {
            let (mouth, hole) = self.wedge_marks(&cut, *wedge);
            notches.extend(mouth);
            drill_holes.push(hole + self.shift);
        }
        let corner = |at: Vec2| DrawPoint { at: at + self.shift, kind: PointKind::Turn };
        for [low, _, high, _] in &self.fish_eyes {
            let inward = (high - low).normalize() * 10.0;
            drill_holes.extend([low + inward + self.shift, high - inward + self.shift]);
        }
        let internal =
            self.fish_eyes.iter().map(|f| DrawLine { points: f.map(corner).into(), closed: true, dense: None });
        PieceDrawing {
            name: self.name.to_owned(),
            size: Some(size.to_owned()),
            cut: CutNotes {
                quantity: self.quantity,
                material: Some(material.to_owned()),
                category: Some(category.to_owned()),
                annotation: (!self.annotation.is_empty()).then(|| self.annotation.to_owned()),
            },
            boundary: self.line(&cut),
            sew_line: Some(self.line(&self.ring(true))),
            internal: internal.collect(),
            notches,
            drill_holes: drill_holes.into_iter().map(|at| DrawDrill { at, diameter: None }).collect(),
            grain: Some(self.grain.map(|p| p + self.shift)),
            ..PieceDrawing::default()
        }
    }
}
