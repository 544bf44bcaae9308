//! Blunt apexes of a piece: two vertices in the place of one.

use super::{Desk, DrawnPiece, mm};
use crate::dxf::chain::JOIN;
use crate::dxf::darts::blunt::{self, Joined};
use toile_garment::{Diagnostic, Vec2};

/// What stands at a vertex stands there within this, mm.
const AT: f64 = 0.02;

impl DrawnPiece {
    /// Makes one vertex of every blunt apex, on the outlines and their dense copies.
    pub(super) fn join_blunt_apexes(&mut self, desk: &mut Desk<'_>) {
        let mut all = blunt::join(&mut self.boundary);
        if let Some(copy) = &mut self.dense {
            blunt::join_copy(copy, &all);
        }
        if let Some(sew) = &mut self.sew {
            let joined = blunt::join(sew);
            if let Some(copy) = &mut self.dense_sew {
                blunt::join_copy(copy, &joined);
            }
            all.extend(joined);
        }
        let rules = self.rules.iter_mut().map(|r| &mut r.at);
        for p in self.turn_list.iter_mut().chain(rules) {
            carry(p, &all);
        }
        for one in all.iter().filter(|j| j.width() > JOIN) {
            let text = format!(
                "the apex at {} of `{}` is drawn blunt, {:.2} mm wide; it was read as one point",
                mm(one.apex),
                self.label(),
                one.width()
            );
            desk.say(Diagnostic::info("dart-apex-blunt", text), &self.block, "1", self.boundary.line);
        }
    }
}

/// A corner point or a grade rule at one of the two vertices goes with them.
fn carry(p: &mut Vec2, joined: &[Joined]) {
    for one in joined {
        if one.ends.iter().any(|e| (e - *p).norm() <= AT) {
            *p = one.apex;
        }
    }
}
