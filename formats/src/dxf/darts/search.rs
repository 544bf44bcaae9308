//! The search for the darts of one piece: what is looked for, in which order, and what is told of look-alikes.

use super::codes;
use super::dart::{DECLARE, Denied, Form};
use super::{lens, marked, wedge, zigzag};
use crate::dxf::desk::Desk;
use crate::dxf::piece::{DrawnPiece, mm};
use toile_garment::{Diagnostic, Vec2};

impl DrawnPiece {
    /// Finds all that may be a dart of a piece whose outline, notches and working lines are known, with the evidence of
    /// the piece. `decide.rs` decides when all pieces are known.
    pub(in crate::dxf) fn find_darts(&mut self, desk: &mut Desk<'_>) {
        let on = if self.sew.is_some() { "sew" } else { "cut" };
        let (mut found, mut denied) = wedge::wedges(self.sewn(), on);
        let cut = self.sew.is_some().then(|| self.boundary.positions());
        let (legs, boxes) = marked::marked(&self.inside.internal, self.sewn(), cut.as_deref());
        found.extend(legs);
        denied.extend(boxes);
        let line = self.sewn().positions();
        let grain = self.axes.grain.map(|g| g[1] - g[0]);
        let [closed, cut_out] =
            [&self.inside.internal, &self.inside.cutouts].map(|p| lens::closed_inside(p, &found, &line));
        let drills: Vec<Vec2> = self.inside.drills.iter().map(|d| d.at).collect();
        for paths in [self.inside.internal.as_slice(), &self.inside.cutouts, &closed, &cut_out] {
            for eye in lens::lenses(paths, &line) {
                match lens::lens_doubt(&eye, grain, &drills) {
                    None => found.push(eye),
                    Some(why) => denied.push(Denied { at: eye.middle(), why, form: Form::Lens }),
                }
            }
        }
        let (folded, necklines) = self.darts_on_fold(on);
        found.extend(folded);
        denied.extend(necklines);
        for dart in &mut found {
            self.weigh(dart);
        }
        self.darts = found;
        self.doubts.denied = denied;
        self.tell_look_alikes(desk);
        self.find_candidates(&drills, desk);
        self.find_pleats(&line, desk);
    }

    /// Tells what runs as a dart does and is none, once for each reason.
    fn tell_look_alikes(&self, desk: &mut Desk<'_>) {
        let told = |d: &&Denied| d.form == Form::Marked || d.why == zigzag::WHY;
        let mut seen: Vec<&str> = Vec::new();
        for one in self.doubts.denied.iter().filter(told) {
            if seen.contains(&one.why) {
                continue;
            }
            seen.push(one.why);
            let count = self.doubts.denied.iter().filter(told).filter(|d| d.why == one.why).count();
            let others = if count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
            let text = format!(
                "the wedge at {} of `{}`{others} was not taken as a dart: {}",
                mm(one.at),
                self.label(),
                one.why
            );
            let finding = Diagnostic::info(codes::WEDGE_NOT_A_DART, text).hint(DECLARE);
            desk.say(finding, &self.block, one.form.layer(), self.line);
        }
    }
}
