//! Evidence for and against a dart, one row of points each. `decide.rs` adds what the rest of the file says.

use super::dart::{DrawnDart, Form};
use super::thresholds::{
    ANGLE_OF_SLIT, ANGLE_OF_WIDE_LINES, ANGLE_OF_WIDE_WEDGE, DIFFERENCE_OF_EQUAL_LEGS, DIFFERENCE_OF_UNEQUAL_LEGS,
    DISTANCE_OF_APEX_DRILL, DISTANCE_OF_CAP, DISTANCE_OF_MOUTH_NOTCH, DISTANCE_OF_TURN_POINT, DISTANCE_OF_WORD,
    LENGTH_OF_SLIT, MARGIN_OF_APEX_DRILL, PLACE_OF_CAP, POINTS_OF_CAP, POINTS_OF_DRILL, POINTS_OF_EQUAL_LEGS,
    POINTS_OF_LENS, POINTS_OF_LINES, POINTS_OF_NOTCHES, POINTS_OF_OTHER_WORD, POINTS_OF_SLIT, POINTS_OF_TURN_POINTS,
    POINTS_OF_UNEQUAL_LEGS, POINTS_OF_WIDE_ANGLE, POINTS_OF_WORD, RISE_OF_CAP,
};
use crate::dxf::geom;
use crate::dxf::piece::DrawnPiece;
use toile_garment::Vec2;

/// Words of the trade for a dart, in lower case.
const WORDS: [&str; 9] = ["dart", "abnäher", "abnaeher", "pince", "pinza", "ripresa", "ダーツ", "省道", "вытачка"];
/// Words of the trade for what looks like a dart and is none.
const OTHER_WORDS: [&str; 9] = ["slit", "vent", "schlitz", "fente", "spacco", "pleat", "falte", "plissee", "开衩"];

/// One row of the table: points for a dart, or against it, and the reason.
type Row = (bool, i32, &'static str);

impl DrawnPiece {
    /// Gives a dart the evidence that its own piece holds.
    pub(super) fn weigh(&self, dart: &mut DrawnDart) {
        let (drilled, notched) = (self.is_drilled(dart), self.is_notched(dart));
        let (named, capped) = (self.is_called(dart, &WORDS), self.is_capped(dart));
        let wide = match dart.form {
            Form::Wedge => dart.angle() >= ANGLE_OF_WIDE_WEDGE,
            Form::Marked => dart.angle() >= ANGLE_OF_WIDE_LINES,
            Form::Lens => false,
        };
        let differ = dart.leg_difference();
        let marked = drilled || notched || named || capped;
        let rows: [Row; 12] = [
            (wide, POINTS_OF_WIDE_ANGLE, "a wedge too wide for a slit"),
            (dart.form == Form::Marked, POINTS_OF_LINES, "two internal lines run from the edge to one point"),
            (dart.form == Form::Lens, POINTS_OF_LENS, "a closed line, sharp at both ends and alike on both sides"),
            (self.has_turn_points(dart), POINTS_OF_TURN_POINTS, "its apex and mouth are turn points"),
            (drilled, POINTS_OF_DRILL, "a drill hole at its apex"),
            (notched, POINTS_OF_NOTCHES, "notches at its mouth"),
            (named, POINTS_OF_WORD, "a text beside it says so"),
            (capped, POINTS_OF_CAP, "a folded cap at its mouth"),
            (differ <= DIFFERENCE_OF_EQUAL_LEGS, POINTS_OF_EQUAL_LEGS, "legs of one length"),
            (differ > DIFFERENCE_OF_UNEQUAL_LEGS, POINTS_OF_UNEQUAL_LEGS, "legs of different lengths"),
            (!marked && dart.is_slit_shaped(), POINTS_OF_SLIT, "it is long, narrow and unmarked: a slit or vent"),
            (
                self.is_called(dart, &OTHER_WORDS),
                POINTS_OF_OTHER_WORD,
                "a text beside it calls it a slit, vent or pleat",
            ),
        ];
        for (_, points, why) in rows.into_iter().filter(|(holds, ..)| *holds) {
            dart.add(points, why);
        }
    }

    fn has_turn_points(&self, dart: &DrawnDart) -> bool {
        let corner = |p: &Vec2| self.points.turn_list.iter().any(|t| (t - p).norm() <= DISTANCE_OF_TURN_POINT);
        self.points.marked && dart.apexes.iter().chain(dart.mouth_ends()).all(corner)
    }

    /// Tells whether a drill hole lies in the dart near an apex, or a little beside it.
    pub(super) fn is_drilled(&self, dart: &DrawnDart) -> bool {
        let drills = |apex: &Vec2| {
            let polygon = [dart.mouth[0], *apex, dart.mouth[1]];
            self.inside.drills.iter().any(|d| {
                (d.at - apex).norm() <= DISTANCE_OF_APEX_DRILL
                    && (geom::inside(d.at, &polygon) || geom::distance(d.at, &polygon, true) <= MARGIN_OF_APEX_DRILL)
            })
        };
        dart.apexes.iter().any(drills)
    }

    /// Tells whether each mouth point has a notch of its own.
    pub(super) fn is_notched(&self, dart: &DrawnDart) -> bool {
        if dart.form == Form::Lens {
            return false;
        }
        let near = |m: Vec2| {
            let at = move |(_, n): &(usize, Vec2)| (n - m).norm() <= DISTANCE_OF_MOUTH_NOTCH;
            self.notches.iter().map(|n| n.at).enumerate().filter(at).map(|(i, _)| i).collect::<Vec<_>>()
        };
        let [a, b] = dart.mouth.map(near);
        a.iter().any(|i| b.iter().any(|j| i != j))
    }

    /// Tells whether a text in the dart, or beside it, holds one of these words.
    fn is_called(&self, dart: &DrawnDart, words: &[&str]) -> bool {
        let polygon: Vec<Vec2> = dart.legs[0].iter().chain(dart.legs[1].iter().rev()).copied().collect();
        let beside = |at: Vec2| geom::inside(at, &polygon) || geom::distance(at, &polygon, true) <= DISTANCE_OF_WORD;
        let mut texts = self.texts.others.iter().filter(|(at, ..)| beside(*at));
        texts.any(|(_, _, text)| words.iter().any(|w| text.to_lowercase().contains(w)))
    }

    /// Tells whether the edge rises over the mouth to a point, as the folded cloth of a dart is cut.
    fn is_capped(&self, dart: &DrawnDart) -> bool {
        let [a, b] = dart.mouth;
        let width = dart.width();
        let out = dart.middle() - dart.apexes[0];
        if dart.form == Form::Lens || width * out.norm() <= 0.0 {
            return false;
        }
        let (along, across) = ((b - a) / width, out / out.norm());
        let edge = self.boundary.positions();
        let rise = |p: Vec2| (p - a).dot(&across).min((p - b).dot(&across));
        // The cut line lies an allowance outside the mouth points.
        let base = geom::distance(a, &edge, true).max(geom::distance(b, &edge, true));
        let least = base + RISE_OF_CAP.0.max(RISE_OF_CAP.1 * width);
        edge.iter().any(|p| {
            PLACE_OF_CAP.contains(&((p - a).dot(&along) / width))
                && (p - dart.middle()).norm() <= DISTANCE_OF_CAP.max(width)
                && rise(*p) >= least
        })
    }
}

impl DrawnDart {
    /// Angle between the straight legs, degrees.
    fn angle(&self) -> f64 {
        geom::angle(self.mouth[0] - self.apexes[0], self.mouth[1] - self.apexes[0])
    }

    /// Difference of the legs as a share of the longer.
    fn leg_difference(&self) -> f64 {
        let legs = [geom::length(&self.work[0], false), geom::length(&self.work[1], false)];
        (legs[0] - legs[1]).abs() / legs[0].max(legs[1]).max(1e-9)
    }

    fn is_slit_shaped(&self) -> bool {
        let long = self.leg_chord(0).min(self.leg_chord(1)) > LENGTH_OF_SLIT;
        self.form != Form::Lens && long && self.angle() < ANGLE_OF_SLIT
    }

    /// Points of the edge at which it is open; a lens has none.
    fn mouth_ends(&self) -> &[Vec2] {
        if self.form == Form::Lens { &[] } else { &self.mouth }
    }
}
