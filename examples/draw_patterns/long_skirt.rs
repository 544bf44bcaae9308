//! The long skirt: A-line, front and back cut whole, two waist darts in each.

use crate::body::{HIP_HEIGHT, Measures, WAIST_HEIGHT};
use crate::draft::{Edge, at, left, solve, towards, whole};
use crate::sheet::{Draft, Wedge};
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// Ease of the waist, all round.
pub const WAIST_EASE: f64 = 8.0;
/// Ease of the hip, all round.
pub const HIP_EASE: f64 = 40.0;
/// Waist to hem at the centre.
const LENGTH: f64 = 850.0;
/// Angle of the side seam below the hip against the vertical, degrees.
const FLARE: f64 = 8.0;
/// How much longer the front quarter is than the back quarter at the waist, half of it.
const SHIFT: f64 = 5.0;

/// The differences between front and back.
#[derive(Clone, Copy)]
struct Quarter {
    /// Finished waist.
    waist: f64,
    /// Half the width at the hip.
    hip: f64,
    /// Height of the waist at the centre.
    centre: f64,
    /// Dart: intake and length of a leg.
    dart: [f64; 2],
    /// Waist to hem at the centre.
    length: f64,
}

/// All pieces of one size.
pub fn pieces(m: &Measures) -> Vec<Draft> {
    let [front, back] = halves(m, LENGTH, WAIST_EASE);
    vec![piece("FRONT", &front, 0.0), piece("BACK", &back, 900.0)]
}

/// The right halves of front and back: hem, side, waist beside the dart, its legs, waist at the centre.
pub fn halves(m: &Measures, length: f64, waist_ease: f64) -> [Vec<Edge>; 2] {
    let finished = (m.waist + waist_ease) / 4.0;
    let hip = (m.hip + HIP_EASE) / 4.0;
    let front = Quarter { waist: finished + SHIFT, hip, centre: WAIST_HEIGHT, dart: [20.0, 95.0], length };
    let back = Quarter { waist: finished - SHIFT, hip, centre: WAIST_HEIGHT - 8.0, dart: [30.0, 130.0], length };
    let front_half = front.half(WAIST_HEIGHT + 16.0);
    let side = front_half[1].length();
    let rise = solve(WAIST_HEIGHT - 20.0, WAIST_HEIGHT + 50.0, |y| back.half(y)[1].length() - side);
    [front_half, back.half(rise)]
}

/// A whole piece from its right half.
pub fn piece(name: &'static str, half: &[Edge], x: f64) -> Draft {
    let edges = whole(half, left_name);
    let hip = WAIST_HEIGHT - HIP_HEIGHT;
    let (right, left) = (edges[1].length(), 9);
    let middle = edges[5].length() / 2.0;
    Draft {
        name,
        wedges: vec![Wedge { leg: 3 }, Wedge { leg: 6 }],
        // Hip level from the waist down, balance above the hem, centres.
        notches: vec![
            (1, right - hip),
            (left, hip),
            (1, 180.0),
            (left, right - 180.0),
            (5, middle),
            (0, edges[0].length() / 2.0),
        ],
        edges,
        grain: [at(0.0, 350.0), at(0.0, 800.0)],
        quantity: Quantity { plain: 1, mirrored: 0 },
        shift: at(x, 0.0),
        ..Draft::default()
    }
}

fn left_name(right: &'static str) -> &'static str {
    match right {
        "side" => "side-2",
        "waist-side" => "waist-side-2",
        other => other,
    }
}

impl Quarter {
    /// The right half, with the waist corner of the side seam at this height.
    fn half(&self, side_y: f64) -> Vec<Edge> {
        let width = solve(self.waist * 0.8, self.waist * 1.6, |x| {
            let edges = self.half_to(at(x, side_y));
            edges[2].length() + edges[5].length() - self.waist
        });
        self.half_to(at(width, side_y))
    }

    fn half_to(&self, side: Vec2) -> Vec<Edge> {
        let [intake, leg] = self.dart;
        let slant = libm::asin(intake / 2.0 / leg).to_degrees();
        let axis = (self.waist + intake) * 0.44;
        // The waist is square to the centre and to both legs, so that it is smooth when the dart is closed.
        let inner = axis - intake / 2.0;
        let mouth_y = self.centre + inner * libm::tan((slant / 2.0).to_radians());
        let (a, b) = (at(inner, mouth_y), at(axis + intake / 2.0, mouth_y));
        let apex = at(axis, mouth_y - leg * libm::cos(slant.to_radians()));
        let hip = at(self.hip, HIP_HEIGHT);
        let up = towards(90.0 + FLARE);
        let hem = self.hem_corner(hip);
        let chord = libm::atan2(hip.x - side.x, side.y - hip.y).to_degrees();
        let top = towards(90.0 + 2.0 * chord - FLARE);
        let third = [1.0 / 3.0; 2];
        vec![
            Edge::start("hem", at(0.0, WAIST_HEIGHT - self.length)).curve(at(1.0, 0.0), hem, -left(up), third, 10),
            Edge::start("side", hem).line(hip, 16).curve(up, side, top, third, 10),
            Edge::start("waist-side", side).curve(left(top), b, towards(180.0 - slant), third, 10),
            Edge::straight("leg", b, apex),
            Edge::straight("leg", apex, a),
            Edge::start("waist-centre", a).curve(
                towards(180.0 + slant),
                at(0.0, self.centre),
                at(-1.0, 0.0),
                third,
                10,
            ),
        ]
    }

    /// The hem is square to the side seam and to the centre.
    fn hem_corner(&self, hip: Vec2) -> Vec2 {
        let down = -towards(90.0 + FLARE);
        let rise = libm::tan((FLARE / 2.0).to_radians());
        let l = solve(0.0, 2.0 * self.length, |l| {
            let p = hip + down * l;
            WAIST_HEIGHT - self.length + rise * p.x - p.y
        });
        hip + down * l
    }
}
