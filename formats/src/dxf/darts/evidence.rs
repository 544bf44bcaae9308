//! Evidence and confidence of a dart that was found.

use super::dart::{DrawnDart, Form};
use super::thresholds::{
    CONFIDENCE_OF_DRILL, CONFIDENCE_OF_EQUAL_LEGS, CONFIDENCE_OF_LENS, CONFIDENCE_OF_MARKED_DART,
    CONFIDENCE_OF_NOTCHES, CONFIDENCE_OF_TURN_POINTS, CONFIDENCE_OF_WEDGE, DIFFERENCE_OF_EQUAL_LEGS,
    DIFFERENCE_OF_UNEQUAL_LEGS, DISTANCE_OF_APEX_DRILL, DISTANCE_OF_MOUTH_NOTCH, DISTANCE_OF_TURN_POINT,
    DOUBT_OF_UNEQUAL_LEGS, RANGE_OF_CONFIDENCE,
};
use crate::dxf::geom;
use crate::dxf::piece::DrawnPiece;
use toile_garment::Vec2;

impl DrawnPiece {
    /// Gives a dart its evidence and its confidence.
    pub(super) fn weigh(&self, dart: &mut DrawnDart) {
        let mut add = |weight: f64, why: &str| {
            dart.confidence += weight;
            dart.evidence.push(why.to_owned());
        };
        match dart.form {
            Form::Wedge => add(CONFIDENCE_OF_WEDGE, "the outline makes a wedge"),
            Form::Marked => add(CONFIDENCE_OF_MARKED_DART, "two internal lines run from the edge to one point"),
            Form::Lens => add(CONFIDENCE_OF_LENS, "a closed line, sharp at both ends and alike on both sides"),
        }
        let ends = if dart.form == Form::Lens { Vec::new() } else { dart.mouth.to_vec() };
        let corner = |p: &Vec2| self.points.turn_list.iter().any(|t| (t - p).norm() <= DISTANCE_OF_TURN_POINT);
        if self.points.marked && dart.apexes.iter().chain(&ends).all(corner) {
            add(CONFIDENCE_OF_TURN_POINTS, "its apex and mouth are turn points");
        }
        if dart.apexes.iter().any(|a| self.inside.drills.iter().any(|d| (d.at - a).norm() <= DISTANCE_OF_APEX_DRILL)) {
            add(CONFIDENCE_OF_DRILL, "a drill hole at its apex");
        }
        if !ends.is_empty()
            && ends.iter().all(|m| self.notches.iter().any(|n| (n.at - m).norm() <= DISTANCE_OF_MOUTH_NOTCH))
        {
            add(CONFIDENCE_OF_NOTCHES, "notches at its mouth");
        }
        let legs = [geom::length(&dart.work[0], false), geom::length(&dart.work[1], false)];
        let differ = (legs[0] - legs[1]).abs() / legs[0].max(legs[1]).max(1e-9);
        if differ <= DIFFERENCE_OF_EQUAL_LEGS {
            add(CONFIDENCE_OF_EQUAL_LEGS, "legs of one length");
        } else if differ > DIFFERENCE_OF_UNEQUAL_LEGS {
            add(-DOUBT_OF_UNEQUAL_LEGS, "legs of different lengths");
        }
        dart.confidence = dart.confidence.clamp(*RANGE_OF_CONFIDENCE.start(), *RANGE_OF_CONFIDENCE.end());
    }
}
