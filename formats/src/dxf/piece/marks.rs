//! Working lines, notches and darts of a piece whose outline is known.

use super::codes;
use super::{Desk, DrawnPiece, mm};
use crate::dxf::geom::{self, Crossing};
use crate::dxf::ledger::Verdict;
use crate::dxf::limits;
use crate::dxf::notches::{self, EdgeLine, Ground};
use crate::dxf::outline::{Making, Outline};
use crate::dxf::unfold::Fold;
use toile_garment::{Diagnostic, Vec2};

impl DrawnPiece {
    pub(super) fn find_cut_notches(&mut self) {
        for outline in [Some(&mut self.boundary), self.sew.as_mut()].into_iter().flatten() {
            outline.find_cut_notches();
        }
    }

    pub(super) fn say_cut_notches(&self, desk: &mut Desk<'_>) {
        let n = self.boundary.cut.len();
        if let Some(first) = self.boundary.cut.first() {
            let text = format!(
                "{n} notch(es) are cut into the outline of `{}`, the first at {}; the sewn line runs over them",
                self.label(),
                mm(first.at)
            );
            desk.say(Diagnostic::info(codes::NOTCH_CUT_IN, text), &self.block, "1", self.boundary.line);
        }
    }

    pub(super) fn make_work(&mut self, desk: &mut Desk<'_>) {
        let label = self.label().to_owned();
        let lines = [
            (Some(&mut self.boundary), &self.unfinished.dense, "84"),
            (self.sew.as_mut(), &self.unfinished.dense_sew, "87"),
        ];
        for (outline, dense, layer) in lines {
            let Some(outline) = outline else { continue };
            let verdict = outline.make_work(dense.as_ref(), desk.rules.tolerances.curve);
            if let Some(Err(off)) = verdict {
                let text = format!(
                    "the dense curve on layer {layer} of `{label}` is up to {off:.1} mm off the outline; not used"
                );
                let finding = Diagnostic::warning(codes::VALIDATION_CURVE_DIFFERS, text);
                desk.say(finding, &self.block, layer, outline.line);
            }
            let changed = outline.making != Making::AsDrawn || !outline.cut.is_empty();
            // A needle of an outline is turned inside out by a curve that swings past it.
            let spoilt = |work: &[Vec2]| geom::area(work) <= 0.0 || geom::crossing(work) != Crossing::None;
            if changed && spoilt(&outline.work_positions()) {
                let text = format!(
                    "the smooth curve through the points of `{label}` would cross itself; the drawn line was used"
                );
                outline.sharpen();
                outline.as_drawn();
                desk.say(Diagnostic::warning(codes::CURVE_NOT_SMOOTHED, text), &self.block, "1", outline.line);
            }
            if let Making::Smoothed(off) = outline.making {
                let text = format!(
                    "curve points of `{label}` were joined by a smooth curve, up to {off:.2} mm off the chords"
                );
                desk.say(Diagnostic::info(codes::CURVE_INTERPOLATED, text), &self.block, "3", outline.line);
            }
        }
    }

    pub(super) fn find_notches(&mut self, desk: &mut Desk<'_>) {
        let work =
            (self.unfinished.marks.len() + self.unfinished.strokes.len()) as u64 * self.boundary.drawn.len() as u64;
        if self.unfinished.marks.len() > limits::NOTCHES
            || self.unfinished.strokes.len() > limits::NOTCHES
            || work > limits::NOTCH_TESTS
        {
            let text = format!("`{}` has more than {} notches", self.label(), limits::NOTCHES);
            desk.say(Diagnostic::error(codes::TOO_MANY_NOTCHES, text), &self.block, "4", self.line);
            return;
        }
        let (boundary, sew) = (forms(&self.boundary), self.sew.as_ref().map(forms));
        let internal: Vec<(Vec<Vec2>, bool)> = self.inside.internal.iter().map(|p| (p.positions(), p.closed)).collect();
        let ground = Ground { boundary: edge(&boundary), sew: sew.as_ref().map(edge), internal: &internal };
        let (mut list, doubled) = notches::from_marks(&self.unfinished.marks, &ground, desk.rules.notch_scale);
        list.extend(notches::from_strokes(&self.unfinished.strokes, &ground));
        list.extend(self.boundary.cut.iter().map(|c| notches::cut_in(c, self.boundary.line)));
        if let Some(fold) = self.axes.fold.map(Fold) {
            let line = |on: &str| &sew.as_ref().filter(|_| on == "sew").unwrap_or(&boundary).0;
            let on_edge = list.iter_mut().filter(|n| matches!(n.on, "boundary" | "sew"));
            on_edge.filter(|n| fold.holds_alone(n.at, line(n.on))).for_each(|n| n.on = "fold");
        }
        notches::pair_twins(&mut list);
        for id in doubled {
            desk.overrule(id, Verdict::Interpreted, "doubled notch, merged");
        }
        for notch in list.iter().filter(|n| n.on == "off") {
            let text =
                format!("a notch of `{}` at {} lies {:.1} mm off the boundary", self.label(), mm(notch.at), notch.off);
            desk.say(Diagnostic::warning(codes::NOTCH_OFF_BOUNDARY, text), &self.block, "4", notch.line);
        }
        self.notches = list;
    }
}

/// A line as drawn, and the smooth line through its points where one was made.
fn forms(outline: &Outline) -> (Vec<Vec2>, Option<Vec<Vec2>>) {
    (outline.positions(), (outline.making != Making::AsDrawn).then(|| outline.work_positions()))
}

fn edge((drawn, smooth): &(Vec<Vec2>, Option<Vec<Vec2>>)) -> EdgeLine<'_> {
    EdgeLine { drawn, smooth: smooth.as_deref() }
}
