//! Trousers with two pleats in each front, a dart in each back, and a waistband.

use crate::body::{HIP_HEIGHT, Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, left, solve, towards};
use crate::sheet::{Draft, Wedge};
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// Ease of the waist, all round.
pub const WAIST_EASE: f64 = 36.0;
/// Cloth in each of the two pleats of a front.
pub const PLEAT: f64 = 30.0;
/// Height of the waistband.
pub const BAND: f64 = 35.0;
/// Height of the waist seam.
const WAIST: f64 = WAIST_HEIGHT - BAND;
/// Height of the points of the crotch, of the knee and of the hem.
const CROTCH: f64 = 755.0;
const KNEE: f64 = 480.0;
const HEM: f64 = 80.0;
/// Dart of the back: intake and length.
const DART: [f64; 2] = [26.0, 110.0];
/// Centre back at the waist: in from the hip, and up.
const SEAT: [f64; 2] = [38.0, 22.0];

/// Widths of one leg, which differ in front and back.
struct Leg {
    /// Width from the centre at the hip.
    hip: f64,
    /// How far the point of the crotch lies beyond the centre.
    crotch: f64,
    /// Widths at knee and hem.
    knee: f64,
    hem: f64,
}

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let quarter = (m.waist + WAIST_EASE) / 4.0;
    let front = Leg { hip: m.hip / 4.0 + 12.0, crotch: m.hip / 20.0 - 3.0, knee: 214.0, hem: 184.0 };
    let back = Leg { hip: m.hip / 4.0 + 20.0, crotch: m.hip / 10.0 + 6.0, knee: 234.0, hem: 204.0 };
    let front_edges = front.front(quarter);
    let inseam = front_edges[4].length();
    let low = solve(CROTCH - 40.0, CROTCH + 10.0, |y| back.inseam(y).length() - inseam);
    vec![
        piece("FRONT", front_edges, Vec::new(), 0.0),
        piece("BACK", back.back(quarter, low), vec![Wedge { leg: 3 }], 700.0),
        waistband(4.0 * quarter),
    ]
}

impl Leg {
    /// x of the crease line.
    fn crease(&self) -> f64 {
        (self.hip - self.crotch) / 2.0
    }

    /// Hem and side seam, up to the hip.
    fn outer(&self, waist: Vec2) -> [Edge; 2] {
        let (c, knee, hem) = (self.crease(), self.knee / 2.0, self.hem / 2.0);
        let [corner, bend, hip] = [at(c + hem, HEM), at(c + knee, KNEE), at(self.hip, HIP_HEIGHT)];
        let third = [1.0 / 3.0; 2];
        let side = Edge::start("side", corner).line(bend, 16).curve(bend - corner, hip, at(0.0, 1.0), third, 24).curve(
            at(0.0, 1.0),
            waist,
            waist - hip,
            third,
            8,
        );
        [Edge::start("hem", at(c - hem, HEM)).line(corner, 8), side]
    }

    /// The inseam, from the point of the crotch at this height down to the hem.
    fn inseam(&self, crotch: f64) -> Edge {
        let (c, knee, hem) = (self.crease(), self.knee / 2.0, self.hem / 2.0);
        let (bend, end) = (at(c - knee, KNEE), at(c - hem, HEM));
        Edge::start("inseam", at(-self.crotch, crotch))
            .curve(at(0.3, -1.0), bend, end - bend, [0.3; 2], 20)
            .line(end, 16)
    }

    /// The left front: hem, side, waist, rise, inseam.
    fn front(&self, quarter: f64) -> Vec<Edge> {
        let waist = at(quarter + 2.0 * PLEAT, WAIST);
        let [hem, side] = self.outer(waist);
        let rise = Edge::start("rise", at(0.0, WAIST)).line(at(0.0, HIP_HEIGHT), 7).curve(
            at(0.0, -1.0),
            at(-self.crotch, CROTCH),
            at(-1.0, -0.05),
            [0.55, 0.6],
            20,
        );
        let across = Edge::start("waist", waist).line(at(0.0, WAIST), 8);
        vec![hem, side, across, rise, self.inseam(CROTCH)]
    }

    /// The right back: hem, side, waist with its dart, rise, inseam.
    fn back(&self, quarter: f64, crotch: f64) -> Vec<Edge> {
        let [seat, up] = SEAT;
        let centre = at(seat, WAIST + up);
        let waist_to = |x: f64| waist(at(x, WAIST), centre);
        let length = |x: f64| waist_to(x)[0].length() + waist_to(x)[3].length();
        let side = at(solve(quarter, quarter + 120.0, |x| length(x) - quarter), WAIST);
        let [hem, outer] = self.outer(side);
        let hip = at(4.0, HIP_HEIGHT);
        let rise = Edge::start("rise", centre).line(hip, 8).curve(
            hip - centre,
            at(-self.crotch, crotch),
            towards(183.0),
            [0.5, 0.55],
            24,
        );
        let mut edges = vec![hem, outer];
        edges.extend(waist_to(side.x));
        edges.extend([rise, self.inseam(crotch)]);
        edges
    }
}

/// The waist of a back from the side to the centre, with a dart that stands on its middle. It is square to both legs, so that
/// it is smooth when the dart is closed.
fn waist(side: Vec2, centre: Vec2) -> [Edge; 4] {
    let along = (centre - side).normalize();
    let middle = (side + centre) / 2.0;
    let [b, a] = [-0.5, 0.5].map(|share| middle + along * (share * DART[0]));
    let apex = middle + left(along) * DART[1];
    let square = |mouth: Vec2| -left((apex - mouth).normalize());
    let third = [1.0 / 3.0; 2];
    [
        Edge::start("waist-side", side).curve(along, b, square(b), third, 8),
        Edge::straight("leg", b, apex),
        Edge::straight("leg", apex, a),
        Edge::start("waist-centre", a).curve(square(a), centre, along, third, 8),
    ]
}

fn piece(name: &'static str, edges: Vec<Edge>, wedges: Vec<Wedge>, x: f64) -> Draft {
    let (side, inseam) = (edges[1].length(), edges.len() - 1);
    let crease = 0.5 * (edges[0].first().x + edges[0].last().x);
    Draft {
        name,
        wedges,
        // Knee and hip on the side seam, knee on the inseam.
        notches: vec![(1, 400.0), (1, side - 180.0), (inseam, edges[inseam].length() - 400.0)],
        edges,
        grain: [at(crease, 200.0), at(crease, 700.0)],
        quantity: Quantity { plain: 1, mirrored: 1 },
        annotation: "CUT 1 PAIR",
        shift: at(x, 0.0),
        ..Draft::default()
    }
}

/// The waistband, single. It is joined at the centre front.
fn waistband(length: f64) -> Draft {
    Draft {
        // Side seams and centre back.
        notches: [0.25, 0.5, 0.75].map(|share| (0, share * length)).to_vec(),
        shift: at(1200.0, 1100.0),
        ..Draft::strip("WAISTBAND", ["low", "join", "top", "join-2"], length, BAND)
    }
}
