//! Loose garments for the upper body: straight side seams, no darts.

use crate::body::Measures;
use crate::draft::{Edge, at, left, whole};
use crate::sheet::Draft;
use crate::upper::{Upper, left_name};
use toile_garment::Vec2;
use toile_garment::piece::Quantity;

/// Slope of the shoulder seam, degrees.
pub const SLOPE: f64 = 19.0;
/// Height of the pitch of the armhole over the underarm.
const PITCH: f64 = 92.0;

/// Front or back of a loose garment.
pub struct Loose {
    /// Ease of the bust, all round.
    pub bust_ease: f64,
    /// Ease of the hip, all round.
    pub hip_ease: f64,
    /// Height of the hem.
    pub hem: f64,
    /// Height of the underarm.
    pub underarm: f64,
    /// Neck point at the shoulder.
    pub neck: Vec2,
    /// x of the shoulder point for a bust of 880.
    pub shoulder: f64,
    /// Height of the neckline at the centre.
    pub neck_centre: f64,
    /// Shape of the neckline; see [`Upper::neck_reach`].
    pub neck_reach: [f64; 2],
    /// Half the width between the armholes.
    pub across: f64,
}

impl Loose {
    /// The right half: hem, side, armhole, shoulder, neckline.
    pub fn half(&self, m: &Measures) -> Vec<Edge> {
        let underarm = at((m.bust + self.bust_ease) / 4.0, self.underarm);
        let corner = at((m.hip + self.hip_ease) / 4.0, self.hem);
        let upper = Upper {
            neck: self.neck,
            shoulder_x: self.shoulder + (m.bust - 880.0) / 20.0,
            slope: SLOPE,
            neck_centre: self.neck_centre,
            neck_reach: self.neck_reach,
            pitch: at(self.across, self.underarm + PITCH),
        };
        let up = (underarm - corner).normalize();
        let hem = Edge::start("hem", at(0.0, self.hem)).curve(at(1.0, 0.0), corner, -left(up), [0.33; 2], 8);
        let [armhole, shoulder, neck] = upper.edges(underarm, up);
        vec![hem, Edge::straight("side", corner, underarm), armhole, shoulder, neck]
    }
}

/// A whole front or back from its right half, with notches on the armhole at distances from the underarm.
pub fn torso(name: &'static str, half: &[Edge], notches: &[f64], x: f64) -> Draft {
    let edges = whole(half, left_name);
    let mut marks = vec![(0, edges[0].length() / 2.0), (4, edges[4].length() / 2.0)];
    for d in notches {
        marks.extend([(2, *d), (6, edges[6].length() - d)]);
    }
    // A balance notch 150 mm above the hem.
    marks.extend([(1, 150.0), (7, edges[7].length() - 150.0)]);
    Draft {
        name,
        notches: marks,
        edges,
        grain: [at(0.0, 920.0), at(0.0, 1300.0)],
        quantity: Quantity::default(),
        shift: at(x, 0.0),
        ..Draft::default()
    }
}
