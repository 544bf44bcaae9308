//! The sew line: on layer 14, or as a closed line on layer 8.

use super::border::note_doubled;
use super::{Desk, DrawnPiece};
use crate::dxf::chain::{self, Chained, Path};
use crate::dxf::geom;
use crate::dxf::ledger::Verdict;
use crate::dxf::outline::Outline;
use toile_garment::{Diagnostic, Vec2};

/// Width of a seam allowance, mm.
const ALLOWANCE: std::ops::RangeInclusive<f64> = 3.0..=40.0;

impl DrawnPiece {
    pub(super) fn find_sew_line(&mut self, runs: Vec<Path>, desk: &mut Desk<'_>) {
        let whole = geom::area(&self.boundary.positions()).abs();
        if !runs.is_empty() {
            let Chained { mut closed, open, gaps: _, doubled } = chain::chain(runs, desk.rules.tolerances.gap);
            note_doubled(&doubled, desk);
            let mut stray = Vec::new();
            for path in open {
                // The sew line of a half piece ends on the fold.
                if self.ends_on_fold(&path) { closed.push(path) } else { stray.push(path) }
            }
            self.sew_lines = closed.len();
            closed.sort_by(|a, b| geom::area(&b.positions()).abs().total_cmp(&geom::area(&a.positions()).abs()));
            let mut closed = closed.into_iter();
            if let Some(first) = closed.next() {
                if geom::area(&first.positions()).abs() >= 0.3 * whole {
                    self.sew = Some(Outline::new(Path { closed: true, ..first }));
                } else {
                    stray.push(first);
                }
            }
            stray.extend(closed);
            for path in stray {
                for id in &path.ids {
                    desk.ledger.overrule(
                        *id,
                        Verdict::Interpreted,
                        "stitch line on layer 14 that is no outline: internal line",
                    );
                }
                let text = format!(
                    "a line on layer 14 of `{}` is not the whole sew line; kept as an internal line",
                    self.label()
                );
                desk.say(Diagnostic::info("stitch-line", text), &self.block, "14", path.line);
                self.not_mirrored.push(false);
                self.internal.push(path);
            }
        } else if let Some(i) = (0..self.internal.len())
            .filter(|i| self.may_be_inner_copy(&self.internal[*i], whole))
            .take(40)
            .find(|i| self.is_inner_copy(&self.internal[*i]))
        {
            let path = self.internal.remove(i);
            self.not_mirrored.remove(i);
            for id in &path.ids {
                desk.ledger.overrule(*id, Verdict::Interpreted, "closed line on layer 8 inside the outline: sew line");
            }
            self.sew_lines = 1;
            self.sew = Some(Outline::new(Path { closed: true, ..path }));
        }
    }

    /// Does an open line of a half piece end on the fold with both ends?
    fn ends_on_fold(&self, path: &Path) -> bool {
        let ends = [path.points[0].0, path.points[path.points.len() - 1].0];
        let near = |[a, b]: [Vec2; 2]| {
            let d = b - a;
            ends.iter().all(|p| geom::cross(d, p - a).abs() <= 0.5 * d.norm())
        };
        path.points.len() >= 3 && self.fold.is_some_and(near)
    }

    fn may_be_inner_copy(&self, path: &Path, whole: f64) -> bool {
        path.points.len() <= 20_000
            && (path.closed || self.ends_on_fold(path))
            && geom::area(&path.positions()).abs() >= 0.5 * whole
    }

    /// A closed line on layer 8 that runs inside the cut line all round, an allowance away.
    fn is_inner_copy(&self, path: &Path) -> bool {
        let (ours, theirs) = (self.boundary.positions(), path.positions());
        let cut_near = |p: &Vec2| ALLOWANCE.contains(&geom::distance(*p, &theirs, true));
        let stride = |n: usize| n / 500 + 1;
        let cut: Vec<bool> = ours.iter().step_by(stride(ours.len())).map(cut_near).collect();
        let near = cut.iter().filter(|c| **c).count();
        let inside = theirs
            .iter()
            .step_by(stride(theirs.len()))
            .all(|p| geom::inside(*p, &ours) || geom::distance(*p, &ours, true) <= 0.5);
        inside && near * 10 >= cut.len() * 9
    }
}
