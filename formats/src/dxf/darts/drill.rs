//! Candidates: drill holes and notches that may be darts, although no line is drawn.

use super::codes;
use super::dart::DrawnDart;
use super::declare::table;
use super::legs_test::wedge_test;
use super::thresholds::{
    ANGLE_OF_CANDIDATE, ANGLE_OF_DRILL_ROW, COSINE_OF_KITE, COUNT_OF_CANDIDATE_MARKS, COUNT_OF_FREE_DRILLS,
    DIFFERENCE_OF_CANDIDATE_LEGS, DISTANCE_OF_TAKEN_DRILL, LENGTH_OF_DRILL_ROW, LENGTH_OF_LEG, LENGTH_OF_LENS,
    OFFSET_OF_KITE, PLACE_OF_KITE_SIDES, PLACE_OF_MIDDLE_DRILL, SLIMNESS_OF_DRILL_ROW, SLIMNESS_OF_LENS, WIDTH_OF_LENS,
};
use crate::dxf::desk::Desk;
use crate::dxf::geom;
use crate::dxf::piece::{DrawnPiece, mm};
use toile_garment::{Diagnostic, Vec2};

impl DrawnPiece {
    /// Tells what drill holes and notches alone say of darts.
    pub(super) fn find_candidates(&mut self, drills: &[Vec2], desk: &mut Desk<'_>) {
        let at: Vec<Vec2> = self.notches.iter().filter(|n| n.on != "off" && n.on != "internal").map(|n| n.at).collect();
        let hint = "declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"wedge\" or \"fish-eye\"";
        self.doubts.candidates = candidates(&at, drills, &self.darts);
        for (drill, mouth) in &self.doubts.candidates {
            let text = format!(
                "two notches at {} and {} and a drill hole at {} of `{}` may be a dart; it was not made one",
                mm(mouth[0]),
                mm(mouth[1]),
                mm(*drill),
                self.label()
            );
            let lines = format!(
                "if it is one, write in the sewing file, with the apex where the legs meet:\n{}",
                table(self.label(), *drill, *mouth)
            );
            desk.say(Diagnostic::warning(codes::DART_CANDIDATE, text).hint(lines), &self.block, "13", self.line);
        }
        for [tip, side, other] in threes(drills, &self.darts, self.axes.grain.map(|g| g[1] - g[0])) {
            let text = format!(
                "three drill holes of `{}` at {}, {} and {} may be a fish-eye dart; it was not made one",
                self.label(),
                mm(tip),
                mm(side),
                mm(other)
            );
            desk.say(Diagnostic::info(codes::DART_CANDIDATE, text).hint(hint), &self.block, "13", self.line);
        }
        for kite in kites(drills, &self.darts) {
            let text = format!(
                "four drill holes of `{}` between {} and {} may be a fish-eye dart; it was not made one",
                self.label(),
                mm(kite[0]),
                mm(kite[1])
            );
            desk.say(Diagnostic::info(codes::DART_CANDIDATE, text).hint(hint), &self.block, "13", self.line);
        }
    }
}

/// Three drill holes along the grain: both tips, and one at the widest place, on the axis or beside it. They come in
/// the order tip, middle, tip.
fn threes(drills: &[Vec2], darts: &[DrawnDart], grain: Option<Vec2>) -> Vec<[Vec2; 3]> {
    let near = |p: &Vec2| {
        darts.iter().any(|d| d.apexes.iter().chain(&d.mouth).any(|q| (p - q).norm() < DISTANCE_OF_TAKEN_DRILL))
    };
    let free: Vec<Vec2> = drills.iter().copied().filter(|p| !near(p)).take(COUNT_OF_FREE_DRILLS).collect();
    // Only exactly three: among more holes there is no telling, and a row of buttons has more.
    let [a, b, c] = free.as_slice() else { return Vec::new() };
    let orders = [[*a, *b, *c], [*b, *a, *c], [*a, *c, *b]];
    let fits = |[s, m, t]: &[Vec2; 3]| {
        let axis = t - s;
        let length = axis.norm();
        let along = (m - s).dot(&axis) / (length * length).max(1e-9);
        let beside = (geom::cross(axis, m - s) / length.max(1e-9)).abs();
        let up = grain.is_none_or(|g| {
            libm::atan2(geom::cross(axis, g).abs(), axis.dot(&g).abs()).to_degrees() <= ANGLE_OF_DRILL_ROW
        });
        (LENGTH_OF_DRILL_ROW..=*LENGTH_OF_LENS.end()).contains(&length)
            && PLACE_OF_MIDDLE_DRILL.contains(&along)
            && beside <= length / SLIMNESS_OF_DRILL_ROW
            && up
    };
    orders.into_iter().find(fits).into_iter().collect()
}

/// Four drill holes in the shape of a slim kite: its two tips first.
fn kites(drills: &[Vec2], darts: &[DrawnDart]) -> Vec<[Vec2; 4]> {
    let near = |p: &Vec2| {
        darts.iter().any(|d| d.apexes.iter().chain(&d.mouth).any(|q| (p - q).norm() < DISTANCE_OF_TAKEN_DRILL))
    };
    let free: Vec<Vec2> = drills.iter().copied().filter(|p| !near(p)).take(COUNT_OF_FREE_DRILLS).collect();
    // Only exactly four: among more holes there is no telling.
    let [a, b, c, d] = free.as_slice() else { return Vec::new() };
    let orders =
        [[*a, *b, *c, *d], [*a, *c, *b, *d], [*a, *d, *b, *c], [*c, *d, *a, *b], [*b, *d, *a, *c], [*b, *c, *a, *d]];
    orders
        .into_iter()
        .find(|[s, t, p, q]| {
            let (axis, across) = (t - s, q - p);
            let (length, width) = (axis.norm(), across.norm());
            let along = |r: &Vec2| (r - s).dot(&axis) / (length * length);
            LENGTH_OF_LENS.contains(&length)
                && WIDTH_OF_LENS.contains(&width)
                && length >= SLIMNESS_OF_LENS * width
                && axis.dot(&across).abs() <= COSINE_OF_KITE * length * width
                && (geom::cross(axis, (p + q) * 0.5 - s) / length).abs() <= OFFSET_OF_KITE * width
                && [p, q].iter().all(|r| PLACE_OF_KITE_SIDES.contains(&along(r)))
        })
        .into_iter()
        .collect()
}

/// Two notches at a mouth and a drill hole near the apex: only a candidate, a person must say. The hole lies on the
/// axis of the mouth, and no other hole claims the same mouth.
fn candidates(notches: &[Vec2], drills: &[Vec2], darts: &[DrawnDart]) -> Vec<(Vec2, [Vec2; 2])> {
    let mut found: Vec<(Vec2, [Vec2; 2])> = Vec::new();
    for drill in drills.iter().take(COUNT_OF_CANDIDATE_MARKS) {
        let taken = darts.iter().any(|d| {
            let polygon: Vec<Vec2> = d.legs[0].iter().chain(d.legs[1].iter().rev()).copied().collect();
            d.apexes.iter().any(|a| (a - drill).norm() < DISTANCE_OF_TAKEN_DRILL) || geom::inside(*drill, &polygon)
        });
        if taken {
            continue;
        }
        let near: Vec<Vec2> = notches
            .iter()
            .copied()
            .filter(|p| LENGTH_OF_LEG.contains(&(p - drill).norm()))
            .take(COUNT_OF_CANDIDATE_MARKS)
            .collect();
        let pair =
            near.iter().enumerate().flat_map(|(i, a)| near[i + 1..].iter().map(move |b| (*a, *b))).find(|(a, b)| {
                let (u, v) = ((a - drill).norm(), (b - drill).norm());
                (u - v).abs() <= DIFFERENCE_OF_CANDIDATE_LEGS * u.max(v)
                    && wedge_test(*drill, *a, *b).is_ok()
                    && geom::angle(a - drill, b - drill) >= ANGLE_OF_CANDIDATE
            });
        found.extend(pair.map(|(a, b)| (*drill, [a, b])));
    }
    let all = found.clone();
    found.retain(|(drill, mouth)| !all.iter().any(|(d, m)| d != drill && m.iter().any(|p| mouth.contains(p))));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_holes_along_the_grain() {
        let v = Vec2::new;
        let up = Some(v(0.0, 1.0));
        let eye = [v(150.0, 450.0), v(162.0, 300.0), v(150.0, 150.0)];
        assert_eq!(threes(&eye, &[], up), vec![eye]);
        assert_eq!(threes(&[eye[1], eye[0], eye[2]], &[], up).len(), 1, "in any order");
        assert_eq!(threes(&[eye[0], v(150.0, 290.0), eye[2]], &[], up).len(), 1, "on the axis");
        // Across the grain, a wide triangle, four holes: none.
        assert!(threes(&eye, &[], Some(v(1.0, 0.0))).is_empty());
        assert!(threes(&[eye[0], v(250.0, 300.0), eye[2]], &[], up).is_empty());
        assert!(threes(&[eye[0], eye[1], eye[2], v(10.0, 10.0)], &[], up).is_empty());
    }

    #[test]
    fn notches_and_drill_are_a_candidate() {
        let c = candidates(&[Vec2::new(135.0, 600.0), Vec2::new(165.0, 600.0)], &[Vec2::new(150.0, 510.0)], &[]);
        assert_eq!(c.len(), 1);
    }
}
