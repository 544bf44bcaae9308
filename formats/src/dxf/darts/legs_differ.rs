//! The finding `dart-legs-differ`: legs that are sewn together and are not of one length.

use super::codes;
use super::thresholds::{LENGTH_OF_LEG_DIFFERENCE, SHARE_OF_LEG_DIFFERENCE};
use crate::dxf::desk::Desk;
use crate::dxf::piece::{DrawnPiece, mm};
use toile_garment::Diagnostic;

impl DrawnPiece {
    /// Tells the darts whose legs differ in length.
    pub(in crate::dxf) fn check_legs(&mut self, desk: &mut Desk<'_>) {
        for dart in &self.darts {
            let (a, b) = (dart.leg_path(0), dart.leg_path(1));
            if (a - b).abs() > LENGTH_OF_LEG_DIFFERENCE && (a - b).abs() > SHARE_OF_LEG_DIFFERENCE * a.max(b) {
                let text = format!(
                    "the legs of the dart at {} of `{}` are {a:.1} and {b:.1} mm long, {:.1} mm apart; they were left as drawn",
                    mm(dart.apexes[0]),
                    self.label(),
                    (a - b).abs()
                );
                let hint = "the difference is eased in when the dart is sewn; correct the pattern if it is a mistake";
                desk.say(Diagnostic::warning(codes::DART_LEGS_DIFFER, text).hint(hint), &self.block, "1", dart.line);
            }
        }
    }
}
