//! Darts that lie on the fold: a half piece holds one half of them, the mirror image makes them whole.

use super::dart::{Denied, DrawnDart};
use super::thresholds::{
    ANGLE_OF_FOLD_NECKLINE, COUNT_OF_STROKES, DISTANCE_OF_FOLD_POINT, GAP_OF_STROKES, VERTICES_OF_HALF_LINE,
    WIDTH_OF_FOLD_NECKLINE,
};
use super::{lens, marked, wedge};
use crate::dxf::chain::{self, Path};
use crate::dxf::geom;
use crate::dxf::outline::Outline;
use crate::dxf::piece::DrawnPiece;
use crate::dxf::unfold::Fold;
use toile_garment::Vec2;

impl DrawnPiece {
    /// Wedges, marked darts and lenses cut in two by the fold, whole.
    pub(super) fn darts_on_fold(&self, on: &'static str) -> (Vec<DrawnDart>, Vec<Denied>) {
        let Some(fold) = self.axes.fold.map(Fold) else { return (Vec::new(), Vec::new()) };
        let Some(whole) = unfolded(self.sewn(), fold) else { return (Vec::new(), Vec::new()) };
        let on_fold = |p: &Vec2| fold.distance(*p) <= DISTANCE_OF_FOLD_POINT;
        let (wedges, _) = wedge::wedges(&whole, on);
        let (mut found, mut denied) = (Vec::new(), Vec::new());
        for dart in wedges.into_iter().filter(|d| d.apexes.iter().all(on_fold)) {
            let (u, v) = (dart.mouth[0] - dart.apexes[0], dart.mouth[1] - dart.apexes[0]);
            let angle = geom::angle(u, v);
            if dart.width() > WIDTH_OF_FOLD_NECKLINE || angle > ANGLE_OF_FOLD_NECKLINE {
                let why = "it is wide and on the fold: a V neckline";
                denied.push(Denied { at: dart.apexes[0], why, form: dart.form });
            } else {
                found.push(dart);
            }
        }
        let halves: Vec<Path> = self.inside.internal.iter().filter_map(|p| doubled(p, fold)).collect();
        let others: Vec<Path> = self.half_lenses(fold);
        let (legs, boxes) = marked::marked(&halves, &whole, None);
        found.extend(legs);
        denied.extend(boxes);
        for paths in [&halves, &others] {
            let free = |eye: &DrawnDart| !found.iter().any(|d| d.ids.iter().any(|id| eye.ids.contains(id)));
            let lenses: Vec<DrawnDart> = lens::lenses(paths, &whole.positions()).into_iter().filter(free).collect();
            found.extend(lenses);
        }
        for dart in &mut found {
            dart.add(0, "its apex lies on the fold: one half is drawn");
        }
        (found, denied)
    }

    /// Halves of lenses that are no single internal line: drawn as several strokes, or on the cutouts' layer.
    fn half_lenses(&self, fold: Fold) -> Vec<Path> {
        let open = |paths: &[Path]| paths.iter().filter(|p| !p.closed).take(COUNT_OF_STROKES).cloned().collect();
        let chained =
            [&self.inside.internal, &self.inside.cutouts].map(|paths| chain::chain(open(paths), GAP_OF_STROKES));
        let several = chained.into_iter().flat_map(|c| c.open.into_iter().chain(c.closed)).filter(|p| p.ids.len() > 1);
        let alone = |p: &&Path| p.points.len() > 2 && (p.closed || p.ids.len() == 1);
        let cutouts = self.inside.cutouts.iter().filter(alone).cloned();
        let whole = several.chain(cutouts).filter_map(|p| doubled(&p, fold));
        whole.filter(|p| p.closed).collect()
    }
}

/// The working line of a half piece, whole.
fn unfolded(half: &Outline, fold: Fold) -> Option<Outline> {
    let work = fold.outline(&half.work)?;
    let place = (0..work.len()).map(Some).collect();
    Some(Outline { drawn: work.clone(), work, place, ..half.clone() })
}

/// An open line with one end, or both, on the fold, and its mirror image: one line.
fn doubled(path: &Path, fold: Fold) -> Option<Path> {
    let on = |p: Option<&(Vec2, bool)>| p.is_some_and(|p| fold.distance(p.0) <= DISTANCE_OF_FOLD_POINT);
    let off = path.points.iter().any(|p| fold.distance(p.0) > DISTANCE_OF_FOLD_POINT);
    if !off || path.points.len() > VERTICES_OF_HALF_LINE {
        return None;
    }
    let mut points = path.points.clone();
    if path.closed {
        // A side of it lies on the fold.
        let n = points.len();
        let side = (0..n).find(|i| on(points.get(*i)) && on(points.get((i + 1) % n)))?;
        points.rotate_left((side + 1) % n);
    }
    let closed = match (on(points.first()), on(points.last())) {
        (true, false) => {
            points.reverse();
            false
        }
        (false, true) => false,
        (true, true) => points.len() >= 3,
        (false, false) => return None,
    };
    let skip_first = usize::from(closed);
    let n = points.len();
    let mirrored: Vec<(Vec2, bool)> =
        points[skip_first..n - 1].iter().rev().map(|(p, own)| (fold.mirror(*p), *own)).collect();
    points.extend(mirrored);
    Some(Path { points, closed, ..path.clone() })
}
