//! The sew line: on layer 14, or as a closed line on layer 8.

use super::border::note_doubled;
use super::codes;
use super::{Desk, DrawnPiece, mm};
use crate::dxf::chain::{self, Chained, Path};
use crate::dxf::geom;
use crate::dxf::ledger::Verdict;
use crate::dxf::outline::Outline;
use toile_garment::{Diagnostic, Vec2};

/// Width of a seam allowance, mm.
const ALLOWANCE: std::ops::RangeInclusive<f64> = 3.0..=40.0;
/// The sew line may run this far outside the cut line by rounding, mm.
const OUTSIDE: f64 = 0.5;

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
                if geom::area(&first.positions()).abs() < 0.3 * whole {
                    stray.push(first);
                } else if self.is_sew_line(&first, whole, desk) {
                    self.sew = Some(Outline::new(Path { closed: true, ..first }));
                } else {
                    self.keep_inside(first, desk);
                }
            }
            stray.extend(closed);
            for path in stray {
                let text = format!(
                    "a line on layer 14 of `{}` is not the whole sew line; kept as an internal line",
                    self.label()
                );
                desk.say(Diagnostic::info(codes::STITCH_LINE, text), &self.block, "14", path.line);
                self.keep_inside(path, desk);
            }
        } else if let Some(i) = (0..self.inside.internal.len())
            .filter(|i| self.may_be_inner_copy(&self.inside.internal[*i], whole))
            .take(40)
            .find(|i| self.is_inner_copy(&self.inside.internal[*i]))
        {
            let path = self.inside.internal.remove(i);
            self.inside.not_mirrored.remove(i);
            for id in &path.ids {
                desk.overrule(*id, Verdict::Interpreted, "closed line on layer 8 inside the outline: sew line");
            }
            self.sew_lines = 1;
            self.sew = Some(Outline::new(Path { closed: true, ..path }));
        }
    }

    /// Keeps a line of layer 14 as an internal line.
    fn keep_inside(&mut self, path: Path, desk: &mut Desk<'_>) {
        for id in &path.ids {
            let rule = "stitch line on layer 14 that is no outline: internal line";
            desk.overrule(*id, Verdict::Interpreted, rule);
        }
        self.inside.not_mirrored.push(false);
        self.inside.internal.push(path);
    }

    /// Judges the line of layer 14 by where it lies to the cut line: a line outside it is none that is sewn.
    fn is_sew_line(&self, path: &Path, whole: f64, desk: &mut Desk<'_>) -> bool {
        let (cut, sew) = (self.boundary.positions(), path.positions());
        let lies = Lies::new(&cut, &sew);
        let label = self.label();
        let (code, sewn, text, hint) = if lies.outside == lies.tried {
            (
                codes::SEW_LINE_OUTSIDE,
                false,
                format!(
                    "the line on layer 14 of `{label}` runs outside the cut line, up to {:.1} mm; it was not taken as the sew line, the cut line is sewn",
                    lies.out_by
                ),
                "if the layers are exchanged, map them: layers = { \"1\" = \"14\", \"14\" = \"1\" }",
            )
        } else if lies.outside > 0 {
            (
                codes::SEW_LINE_CROSSES,
                true,
                format!(
                    "the sew line of `{label}` crosses the cut line and lies up to {:.1} mm outside it at {}; it was taken as drawn",
                    lies.out_by,
                    mm(lies.worst)
                ),
                "correct the sew line (layer 14) or the cut line (layer 1) there",
            )
        } else if lies.in_by > *ALLOWANCE.end() && geom::area(&sew).abs() < 0.6 * whole {
            (
                codes::SEW_LINE_FAR,
                true,
                format!(
                    "the sew line of `{label}` lies up to {:.1} mm inside the cut line and encloses only {:.0} % of it; it was taken as drawn",
                    lies.in_by,
                    100.0 * geom::area(&sew).abs() / whole.max(1e-9)
                ),
                "make sure that layer 14 holds the sew line of this piece",
            )
        } else {
            return true;
        };
        desk.say(Diagnostic::warning(code, text).hint(hint), &self.block, "14", path.line);
        sewn
    }

    /// Does an open line of a half piece end on the fold with both ends?
    fn ends_on_fold(&self, path: &Path) -> bool {
        let ends = [path.points[0].0, path.points[path.points.len() - 1].0];
        let near = |[a, b]: [Vec2; 2]| {
            let d = b - a;
            ends.iter().all(|p| geom::cross(d, p - a).abs() <= 0.5 * d.norm())
        };
        path.points.len() >= 3 && self.axes.fold.is_some_and(near)
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

/// How a sew line lies to its cut line, looked at in some hundred points of each.
struct Lies {
    tried: usize,
    outside: usize,
    out_by: f64,
    worst: Vec2,
    in_by: f64,
}

impl Lies {
    fn new(cut: &[Vec2], sew: &[Vec2]) -> Self {
        let most = (20_000_000 / (cut.len() + sew.len()).max(1)).clamp(60, 300);
        let mut lies = Self { tried: 0, outside: 0, out_by: 0.0, worst: Vec2::zeros(), in_by: 0.0 };
        for p in sew.iter().step_by(sew.len() / most + 1) {
            lies.tried += 1;
            lies.look(*p, geom::distance(*p, cut, true), !geom::inside(*p, cut));
        }
        // Where the cut line lies inside the sew line, the sew line is outside although its vertices are not.
        if lies.outside < lies.tried {
            for p in cut.iter().step_by(cut.len() / most + 1).filter(|p| geom::inside(**p, sew)) {
                lies.tried += 1;
                lies.look(*p, geom::distance(*p, sew, true), true);
            }
        }
        lies
    }

    fn look(&mut self, p: Vec2, distance: f64, outside: bool) {
        if !outside {
            self.in_by = self.in_by.max(distance);
        } else if distance > OUTSIDE {
            self.outside += 1;
            if distance > self.out_by {
                (self.out_by, self.worst) = (distance, p);
            }
        }
    }
}
