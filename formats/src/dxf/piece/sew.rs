//! The sew line: on layer 14, or as a closed line on layer 8.

use super::border::note_doubled;
use super::codes;
use super::offset::{ALLOWANCE, OUTSIDE, is_offset};
use super::{Desk, DrawnPiece, loops, mm};
use crate::dxf::chain::{self, Chained, Path};
use crate::dxf::geom::{self, Crossing};
use crate::dxf::ledger::Verdict;
use crate::dxf::outline::Outline;
use toile_garment::{Diagnostic, Vec2};

/// A closed line on layer 14 with a larger share of the area of the piece is meant for its sew line, however it runs.
const SHARE_OF_NET: f64 = 0.3;
/// A point this near to the cut line lies on it, mm: writers round to 0.1 mm at least.
const ON_EDGE: f64 = 0.5;
/// Stretches of an edge at whose ends it is looked at.
const BETWEEN: u8 = 8;
/// The ledger's word on sew lines that do not stand on their own layer.
pub(crate) const SEW_LINE_ON_8: &str = "closed line on layer 8 inside the outline: sew line";
/// Most open lines of layer 8 that are joined to see whether they are the sew line.
const RUNS: usize = 400;

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
                if geom::area(&first.positions()).abs() < SHARE_OF_NET * whole && !self.is_offset(&first, 0.0) {
                    stray.push(first);
                } else if self.is_sew_line(&first, whole, desk) {
                    self.take_sew_line(first, "14", desk);
                } else {
                    self.keep_inside(first, desk);
                }
            }
            stray.extend(closed);
            for path in stray {
                desk.say(self.stray(&path), &self.block, "14", path.line);
                self.keep_inside(path, desk);
            }
        } else {
            self.find_inner_copy(desk);
        }
    }

    /// The finding for a line of layer 14 that is not taken as the sew line. A large one that crosses itself encloses
    /// little, as a bow does, and is meant for it nevertheless.
    fn stray(&self, path: &Path) -> Diagnostic {
        let (label, line) = (self.label(), path.positions());
        let extent = |points: &[Vec2]| {
            geom::bounds(points.iter().copied()).map_or(0.0, |(lo, hi)| (hi.x - lo.x) * (hi.y - lo.y))
        };
        let is_large = extent(&line) >= SHARE_OF_NET * extent(&self.boundary.positions());
        if path.closed
            && self.sew.is_none()
            && is_large
            && let Crossing::At(_, _, at) = geom::crossing(&line)
        {
            let text = format!(
                "the sew line of `{label}` intersects itself at {}, so that it encloses no piece; it was kept as an internal line, the cut line is sewn",
                mm(at)
            );
            return Diagnostic::warning(codes::SEW_LINE_CROSSES_ITSELF, text).hint("correct the sew line there");
        }
        if let Some([from, to]) = self.open_edge(path).filter(|_| is_large && self.axes.fold.is_none()) {
            let text = format!(
                "is `{label}` half a piece? Its sew line is open along the straight edge from {} to {} alone, and no fold \
                 line is there; the piece was taken as drawn, and its cut line is sewn",
                mm(from),
                mm(to)
            );
            let hint = "draw the edge as a fold line on layer 6, or map the layer that has it: layers = { \"…\" = \"6\" }; \
                        if the piece is whole, close its sew line there";
            return Diagnostic::warning(codes::FOLD_MISSING, text).hint(hint);
        }
        let text = format!("a line on layer 14 of `{label}` is not the whole sew line; kept as an internal line");
        Diagnostic::info(codes::STITCH_LINE, text)
    }

    /// The ends of an open line, where both lie on one straight edge of the cut line.
    fn open_edge(&self, path: &Path) -> Option<[Vec2; 2]> {
        let (points, cut) = (path.positions(), self.boundary.positions());
        let (from, to) = (*points.first()?, *points.last()?);
        let is_on = |p: Vec2| geom::distance(p, &cut, true) < ON_EDGE;
        let between = (0..=BETWEEN).map(|k| from + (to - from) * (f64::from(k) / f64::from(BETWEEN)));
        (!path.closed && (to - from).norm() > ON_EDGE && between.into_iter().all(is_on)).then_some([from, to])
    }

    /// Makes the line on layer 8 that is the cut line moved inwards the sew line: drawn whole, or in runs.
    fn find_inner_copy(&mut self, desk: &mut Desk<'_>) {
        let whole = |p: &&Path| p.closed || self.ends_on_fold(p);
        let lines = self.inside.internal.iter().filter(whole).filter(|p| self.is_offset(p, *ALLOWANCE.start()));
        let area = |p: &Path| geom::area(&p.positions()).abs();
        let largest = lines.max_by(|a, b| area(a).total_cmp(&area(b))).cloned();
        let Some(path) = largest.or_else(|| self.inner_copy_in_runs()) else { return };
        for id in &path.ids {
            desk.overrule(*id, Verdict::Interpreted, SEW_LINE_ON_8);
        }
        let taken: Vec<bool> =
            self.inside.internal.iter().map(|p| p.ids.iter().any(|id| path.ids.contains(id))).collect();
        let mut keep = taken.iter().map(|t| !t);
        self.inside.internal.retain(|_| keep.next().unwrap_or(true));
        let mut keep = taken.iter().map(|t| !t);
        self.inside.not_mirrored.retain(|_| keep.next().unwrap_or(true));
        self.sew_lines = 1;
        self.take_sew_line(path, "8", desk);
    }

    /// Open lines on layer 8 that together make a closed line that is the cut line moved inwards.
    fn inner_copy_in_runs(&self) -> Option<Path> {
        let open: Vec<Path> = self.inside.internal.iter().filter(|p| !p.closed).take(RUNS).cloned().collect();
        let Chained { closed, open, .. } = chain::chain(open, chain::JOIN);
        let whole = closed.into_iter().chain(open.into_iter().filter(|p| p.ids.len() > 1 && self.ends_on_fold(p)));
        whole.into_iter().find(|p| self.is_offset(p, *ALLOWANCE.start()))
    }

    fn is_offset(&self, path: &Path, least: f64) -> bool {
        is_offset(&self.boundary.positions(), path, self.axes.fold, &(least..=*ALLOWANCE.end()))
    }

    /// Takes a line as the sew line; small loops of it are cut off.
    fn take_sew_line(&mut self, path: Path, layer: &str, desk: &mut Desk<'_>) {
        let mut sew = Outline::new(Path { closed: true, ..path });
        if !loops::cut_off(&self.block, ("sew line", layer), &mut sew, desk.rules.tolerances.loops, desk) {
            let text = format!("the sew line of `{}` intersects itself; it was taken as drawn", self.label());
            let finding = Diagnostic::warning(codes::SEW_LINE_CROSSES_ITSELF, text);
            desk.say(finding.hint("correct the sew line there"), &self.block, layer, sew.line);
        }
        self.sew = Some(sew);
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
