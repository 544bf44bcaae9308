//! The princess dress: panels from armhole to hem without darts, a godet in each of the four seams.

use crate::body::{HIP_HEIGHT, Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, left, solve, towards, turned, whole};
use crate::sheet::Draft;
use crate::upper::{FITTED, Upper};
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// Ease of bust, waist and hip, all round.
pub const EASE: [f64; 3] = [70.0, 60.0, 60.0];
/// Height of the hem.
const HEM: f64 = WAIST_HEIGHT - 660.0;
/// Height of the bust points on the flat front.
const BUST: f64 = 1226.0;
/// Length of the seams that a godet opens, from the hem.
pub const GODET: f64 = 300.0;
/// Angle of a godet at its point, degrees.
const SPREAD: f64 = 36.0;
/// Lean of the panels' edges below the hip, degrees.
const FLARE: f64 = 3.0;
/// x of the princess seam at the bust.
const SEAM: f64 = 96.0;
/// Share of the armhole that belongs to the side panel.
const ARMHOLE: f64 = 0.42;

/// The differences between front and back.
struct Half {
    /// Cloth that the princess seam takes in at the waist.
    waist: f64,
    /// How far the upper side panel is turned about the bust point, degrees.
    turn: f64,
    /// How much longer the quarter is than a quarter of the girth.
    shift: f64,
    neck_y: f64,
    neck_centre: f64,
    neck_reach: [f64; 2],
    /// x of the armhole beyond an eighth of the bust, and its height over the underarm.
    pitch: [f64; 2],
}

const FRONT: Half = Half {
    waist: 30.0,
    turn: 6.0,
    shift: 5.0,
    neck_y: 1476.0,
    neck_centre: 1360.0,
    neck_reach: [0.45, 0.5],
    pitch: [46.0, 62.0],
};
const BACK: Half = Half {
    waist: 38.0,
    turn: 0.0,
    shift: -5.0,
    neck_y: 1468.0,
    neck_centre: 1430.0,
    neck_reach: [0.22, 0.5],
    pitch: [58.0, 68.0],
};

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let (centre_back, side_back) = BACK.panels(m, 1240.0);
    let side = side_back[1].length();
    let underarm = solve(1200.0, 1300.0, |y| FRONT.panels(m, y).1[1].length() - side);
    let (centre_front, side_front) = FRONT.panels(m, underarm);
    vec![
        centre("CENTRE-FRONT", &centre_front, 0.0),
        pair("SIDE-FRONT", side_front, 250.0),
        centre("CENTRE-BACK", &centre_back, 1000.0),
        pair("SIDE-BACK", side_back, 1250.0),
        godet(),
    ]
}

impl Half {
    /// The right half of the centre panel and the right side panel. The latter's edges: hem, side, armhole, princess
    /// seam, godet.
    fn panels(&self, m: &Measures, underarm: f64) -> (Vec<Edge>, Vec<Edge>) {
        let quarter = |girth: f64, ease: f64| (girth + ease) / 4.0 + self.shift;
        let [bust, waist, hip] = [quarter(m.bust, EASE[0]), quarter(m.waist, EASE[1]), quarter(m.hip, EASE[2])];
        let upper = Upper {
            neck: at(m.neck / 5.0 + 22.0, self.neck_y),
            shoulder_x: 172.0,
            slope: FITTED,
            neck_centre: self.neck_centre,
            neck_reach: self.neck_reach,
            pitch: at(m.bust / 8.0 + self.pitch[0], underarm + self.pitch[1]),
        };
        let up = towards(90.0 - 9.0);
        let [armhole, shoulder, neck] = upper.edges(at(bust, underarm), up);
        let [lower, armhole] = armhole.cut(ARMHOLE * armhole.length(), ["armhole-low", "armhole"], [18, 24]);
        let seam = self.seam(1.0, HEM, armhole.first());
        let low =
            Edge::start("hem", at(0.0, HEM - 4.0)).curve(at(1.0, 0.0), seam[0].first(), -left(lean(1.0)), [0.33; 2], 6);
        let centre = vec![low, seam[0].clone(), seam[1].clone(), armhole, shoulder, neck];

        let point = at(SEAM, BUST);
        let lower = lower.turned(point, -self.turn);
        let inner_seam = |y: f64| self.seam(-1.0, y, lower.last());
        let y = solve(HEM - 40.0, HEM + 40.0, |y| inner_seam(y)[1].length() - seam[1].length());
        let [opening, princess] = inner_seam(y);
        let side = self.side(hip, waist + self.waist, lower.first(), turned(up, at(0.0, 0.0), -self.turn));
        let hem = Edge::start("hem", opening.first()).curve(
            -left(lean(-1.0)),
            side.first(),
            -left(side_lean()),
            [0.33; 2],
            10,
        );
        let panel = vec![hem, side, lower, princess.reversed(), opening.reversed()];
        (centre, panel)
    }

    /// The princess seam from the hem up, in two parts: beside the godet, and above it. `s` is 1 for the centre panel.
    fn seam(&self, s: f64, hem: f64, top: Vec2) -> [Edge; 2] {
        let hip = at(SEAM + 4.0, HIP_HEIGHT);
        let waist = at(SEAM + 2.0 - s * self.waist / 2.0, WAIST_HEIGHT);
        let low = hip - lean(s) * ((hip.y - hem) / lean(s).y);
        let open = low + lean(s) * GODET;
        let up = at(0.0, 1.0);
        let above = towards(90.0 - s * 2.0);
        let end = (top - at(SEAM, BUST)).normalize();
        let upper = Edge::start("princess", open)
            .line(hip, 8)
            .curve(lean(s), waist, up, [0.33; 2], 16)
            .curve(up, at(SEAM, BUST), above, [0.33; 2], 16)
            .curve(above, top, end, [0.33; 2], 22);
        [Edge::start("godet", low).line(open, 8), upper]
    }

    fn side(&self, hip: f64, waist: f64, underarm: Vec2, up: Vec2) -> Edge {
        let hip = at(hip, HIP_HEIGHT);
        let low = hip - side_lean() * ((HIP_HEIGHT - HEM - 14.0) / side_lean().y);
        Edge::start("side", low)
            .line(hip, 10)
            .curve(side_lean(), at(waist, WAIST_HEIGHT), at(0.0, 1.0), [0.33; 2], 19)
            .curve(at(0.0, 1.0), underarm, up, [0.33; 2], 19)
    }
}

/// Direction of the princess edge below the hip, upwards.
fn lean(s: f64) -> Vec2 {
    towards(90.0 + s * FLARE)
}

/// Direction of the side seam below the hip, upwards.
fn side_lean() -> Vec2 {
    towards(90.0 + 5.0)
}

fn centre(name: &'static str, half: &[Edge], x: f64) -> Draft {
    let edges = whole(half, |name| match name {
        "godet" => "godet-2",
        "princess" => "princess-2",
        "armhole" => "armhole-2",
        "shoulder" => "shoulder-2",
        other => other,
    });
    Draft {
        name,
        // Waist notches on both seams, and the centres.
        notches: vec![
            (2, WAIST_HEIGHT - HEM - GODET),
            (8, edges[8].length() - (WAIST_HEIGHT - HEM - GODET)),
            (0, edges[0].length() / 2.0),
        ],
        edges,
        grain: [at(0.0, HEM + 100.0), at(0.0, 1250.0)],
        quantity: Quantity { plain: 1, mirrored: 0 },
        shift: at(x, 0.0),
        ..Draft::default()
    }
}

fn pair(name: &'static str, edges: Vec<Edge>, x: f64) -> Draft {
    let princess = edges[3].length();
    Draft {
        name,
        notches: vec![(3, princess - (WAIST_HEIGHT - HEM - GODET))],
        grain: [at(SEAM + 40.0, HEM + 100.0), at(SEAM + 40.0, 1180.0)],
        edges,
        quantity: Quantity { plain: 1, mirrored: 1 },
        annotation: "CUT 1 PAIR",
        shift: at(x, 0.0),
        ..Draft::default()
    }
}

fn godet() -> Draft {
    let point = at(0.0, HEM + GODET);
    let [low, high] = [-1.0, 1.0].map(|s| point + towards(270.0 + s * SPREAD / 2.0) * GODET);
    Draft {
        name: "GODET",
        edges: vec![
            Edge::start("hem", low).arc(point, SPREAD, 12),
            Edge::start("right", high).line(point, 8),
            Edge::start("left", point).line(low, 8),
        ],
        grain: [at(0.0, HEM + 60.0), at(0.0, HEM + GODET - 80.0)],
        quantity: Quantity { plain: 4, mirrored: 0 },
        annotation: "CUT 4",
        shift: at(2200.0, 0.0),
        ..Draft::default()
    }
}
