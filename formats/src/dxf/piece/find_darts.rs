//! Darts of a piece: found, weighed by their evidence, or denied with the reason.

use super::{Desk, DrawnPiece, mm};
use crate::dxf::darts::{self, Denied, DrawnDart, Form};
use crate::dxf::ledger::Verdict;
use crate::dxf::{chain, geom, limits, marked, pleats};
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Vec2};

/// What to do about a dart that was not taken.
const DECLARE: &str = "if it is a dart, declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"wedge\"";
/// Ends of strokes of a lens meet within this, mm.
pub(super) const STROKES: f64 = 0.5;
/// Most strokes that are chained.
pub(super) const STROKES_MOST: usize = 400;
/// A wider and blunter wedge in the middle of a symmetric piece is a neckline, mm and degrees.
const NECKLINE: (f64, f64) = (80.0, 30.0);
/// Between shoulders a wider or a blunter one is, and a blunt one from this width on, mm and degrees.
const COLLARED: (f64, f64, f64) = (60.0, 30.0, 40.0);
/// Shoulders fall away from the mouth by more than this, degrees; a waist goes on as it runs over the mouth.
const SHOULDER: f64 = 5.0;
/// A shoulder's slope is taken over at least this, mm.
const SLOPE: f64 = 10.0;
/// A drill hole belongs to an apex within this, mm: it is put 10 to 15 mm short of it.
const DRILL: f64 = 20.0;
/// A notch belongs to a mouth point within this, mm (across an allowance).
const NOTCH: f64 = 14.0;

impl DrawnPiece {
    pub(super) fn find_darts(&mut self, desk: &mut Desk<'_>) {
        let on = if self.sew.is_some() { "sew" } else { "cut" };
        let (mut found, mut denied) = darts::wedges(self.sewn(), on);
        let cut = self.sew.is_some().then(|| self.boundary.positions());
        let (legs, boxes) = marked::marked(&self.internal, self.sewn(), cut.as_deref());
        found.extend(legs);
        denied.extend(boxes);
        let line = self.sewn().positions();
        let grain = self.grain.map(|g| g[1] - g[0]);
        let [closed, cut_out] = [&self.internal, &self.cutouts].map(|p| closed_inside(p, &found, &line));
        let drills: Vec<Vec2> = self.drills.iter().map(|d| d.at).collect();
        for paths in [self.internal.as_slice(), &self.cutouts, &closed, &cut_out] {
            for lens in marked::lenses(paths, &line) {
                match marked::lens_doubt(&lens, grain, &drills) {
                    None => found.push(lens),
                    Some(why) => denied.push(Denied { at: lens.middle(), why, form: Form::Lens }),
                }
            }
        }
        let (folded, necklines) = self.darts_on_fold(on);
        found.extend(folded);
        denied.extend(necklines);
        for dart in &found {
            for id in &dart.ids {
                let rule = if dart.form == Form::Lens { "closed lens: fish-eye dart" } else { "legs of a marked dart" };
                desk.overrule(*id, Verdict::Interpreted, rule);
            }
        }
        for dart in &mut found {
            self.weigh(dart);
        }
        self.darts = found;
        self.denied = denied;
        self.tell_look_alikes(desk);
        self.find_candidates(&drills, desk);
        self.find_pleats(&line, desk);
    }

    /// What runs as a dart does and is none: told once for each reason.
    fn tell_look_alikes(&self, desk: &mut Desk<'_>) {
        let told = |d: &&Denied| d.form == Form::Marked || d.why == darts::rows::WHY;
        let mut seen: Vec<&str> = Vec::new();
        for one in self.denied.iter().filter(told) {
            if seen.contains(&one.why) {
                continue;
            }
            seen.push(one.why);
            let count = self.denied.iter().filter(told).filter(|d| d.why == one.why).count();
            let others = if count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
            let text = format!(
                "the wedge at {} of `{}`{others} was not taken as a dart: {}",
                mm(one.at),
                self.label(),
                one.why
            );
            let layer = if one.form == Form::Marked { "8" } else { "1" };
            desk.say(Diagnostic::info("wedge-not-a-dart", text).hint(DECLARE), &self.block, layer, self.line);
        }
    }

    /// Evidence and confidence of a dart.
    fn weigh(&self, dart: &mut DrawnDart) {
        let mut add = |weight: f64, why: &str| {
            dart.confidence += weight;
            dart.evidence.push(why.to_owned());
        };
        match dart.form {
            Form::Wedge => add(0.6, "the outline makes a wedge"),
            Form::Marked => add(0.8, "two internal lines run from the edge to one point"),
            Form::Lens => add(0.75, "a closed line, sharp at both ends and alike on both sides"),
        }
        let ends = if dart.form == Form::Lens { Vec::new() } else { dart.mouth.to_vec() };
        let corner = |p: &Vec2| self.turn_list.iter().any(|t| (t - p).norm() <= 0.05);
        if self.marked && dart.apexes.iter().chain(&ends).all(corner) {
            add(0.1, "its apex and mouth are turn points");
        }
        if dart.apexes.iter().any(|a| self.drills.iter().any(|d| (d.at - a).norm() <= DRILL)) {
            add(0.15, "a drill hole at its apex");
        }
        if !ends.is_empty() && ends.iter().all(|m| self.notches.iter().any(|n| (n.at - m).norm() <= NOTCH)) {
            add(0.1, "notches at its mouth");
        }
        let legs = [geom::length(&dart.work[0], false), geom::length(&dart.work[1], false)];
        let differ = (legs[0] - legs[1]).abs() / legs[0].max(legs[1]).max(1e-9);
        if differ <= 0.01 {
            add(0.1, "legs of one length");
        } else if differ > 0.1 {
            add(-0.15, "legs of different lengths");
        }
        dart.confidence = dart.confidence.clamp(0.05, 0.99);
    }

    fn find_candidates(&mut self, drills: &[Vec2], desk: &mut Desk<'_>) {
        let at: Vec<Vec2> = self.notches.iter().filter(|n| n.on != "off" && n.on != "internal").map(|n| n.at).collect();
        let hint = "declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"wedge\" or \"fish-eye\"";
        self.candidates = marked::candidates(&at, drills, &self.darts);
        for (drill, mouth) in &self.candidates {
            let text = format!(
                "two notches at {} and {} and a drill hole at {} of `{}` may be a dart; it was not made one",
                mm(mouth[0]),
                mm(mouth[1]),
                mm(*drill),
                self.label()
            );
            desk.say(Diagnostic::info("dart-candidate", text).hint(hint), &self.block, "13", self.line);
        }
        for [tip, side, other] in marked::threes(drills, &self.darts, self.grain.map(|g| g[1] - g[0])) {
            let text = format!(
                "three drill holes of `{}` at {}, {} and {} may be a fish-eye dart; it was not made one",
                self.label(),
                mm(tip),
                mm(side),
                mm(other)
            );
            desk.say(Diagnostic::info("dart-candidate", text).hint(hint), &self.block, "13", self.line);
        }
        for kite in marked::kites(drills, &self.darts) {
            let text = format!(
                "four drill holes of `{}` between {} and {} may be a fish-eye dart; it was not made one",
                self.label(),
                mm(kite[0]),
                mm(kite[1])
            );
            desk.say(Diagnostic::info("dart-candidate", text).hint(hint), &self.block, "13", self.line);
        }
    }

    fn find_pleats(&mut self, line: &[Vec2], desk: &mut Desk<'_>) {
        let legs = |p: &&chain::Path| self.darts.iter().any(|d| d.ids.iter().any(|id| p.ids.contains(id)));
        let free: Vec<&chain::Path> = self.internal.iter().filter(|p| !legs(p)).collect();
        let texts: Vec<(Vec2, String)> = self.texts.iter().map(|(at, _, text)| (*at, text.clone())).collect();
        self.pleats = pleats::find(&free, line, &self.notches, &texts);
        for pleat in &self.pleats {
            let [a, b] = pleat.lines.map(|l| mm(l[0]));
            let what = if pleat.converging { "dart-pleat" } else { "pleat" };
            let text = format!(
                "the lines from {a} and {b} of `{}`, {:.1} mm apart, look like a {what} ({}); it was not made one",
                self.label(),
                pleat.width,
                pleat.evidence.join(", ")
            );
            let hint = "declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"pleat\"";
            desk.say(Diagnostic::info("pleat-candidate", text).hint(hint), &self.block, "8", pleat.line);
        }
    }

    /// Is the outline its own mirror image at this axis?
    pub(crate) fn symmetric_about(line: &[Vec2], axis: [Vec2; 2]) -> bool {
        let points: Vec<Vec2> = line.iter().step_by(line.len() / 400 + 1).copied().collect();
        let twins =
            points.iter().filter(|p| geom::distance(geom::mirror(**p, axis[0], axis[1]), line, true) <= 2.0).count();
        twins * 10 >= points.len() * 9
    }

    /// A wide wedge in the middle of a symmetric piece is a V neckline.
    pub(super) fn deny_necklines(&mut self, desk: &mut Desk<'_>) {
        let nodes = &self.sewn().drawn;
        let line: Vec<Vec2> = nodes.iter().map(|n| n.at).collect();
        let corners = nodes.iter().filter(|n| n.kind == PointKind::Turn).count();
        let mut denied = Vec::new();
        self.darts.retain(|dart| {
            let apex = dart.apexes[0];
            let axis = [apex, (dart.mouth[0] + dart.mouth[1]) * 0.5];
            let (u, v) = (dart.mouth[0] - apex, dart.mouth[1] - apex);
            let angle = geom::angle(u, v);
            let width = dart.width();
            let wide = width > NECKLINE.0 && angle > NECKLINE.1;
            let narrow = width > COLLARED.0 || (angle > COLLARED.1 && width > COLLARED.2);
            let neckline = dart.form == Form::Wedge
                && corners >= 5
                && (wide || narrow && between_shoulders(dart, &line))
                && Self::symmetric_about(&line, axis);
            if neckline {
                denied.push((apex, dart.line));
            }
            !neckline
        });
        for (at, file_line) in denied {
            let why = "it is wide and in the middle of a symmetric piece: a V neckline";
            let text = format!("the wedge at {} of `{}` was not taken as a dart: {why}", mm(at), self.label());
            desk.say(Diagnostic::warning("wedge-not-a-dart", text).hint(DECLARE), &self.block, "1", file_line);
            self.denied.push(Denied { at, why, form: Form::Wedge });
        }
    }
}

/// Does the outline fall away on both sides of the mouth, towards the apex?
fn between_shoulders(dart: &DrawnDart, line: &[Vec2]) -> bool {
    let [a, b] = dart.mouth;
    let inward = dart.apexes[0] - (a + b) * 0.5;
    [(a, a - b), (b, b - a)].into_iter().all(|(end, outward)| {
        let n = line.len();
        let Some(at) = (0..n).find(|i| (line[*i] - end).norm() <= 0.5) else { return false };
        let away = |step: usize| {
            (1..n).map(|k| line[(at + k * step) % n] - end).find(|d| d.norm() >= SLOPE).unwrap_or_default()
        };
        // The other way leads along the leg.
        let [p, q] = [away(1), away(n - 1)];
        let beside = if p.dot(&outward) * q.norm() > q.dot(&outward) * p.norm() { p } else { q };
        let (fall, run) = (beside.dot(&inward) / inward.norm(), beside.dot(&outward) / outward.norm());
        libm::atan2(fall, run).to_degrees() > SHOULDER
    })
}

/// Closed lines made of several open ones inside the piece: a lens of two or four strokes.
fn closed_inside(paths: &[chain::Path], found: &[DrawnDart], line: &[Vec2]) -> Vec<chain::Path> {
    let free = |p: &&chain::Path| {
        !p.closed
            && p.points.len() <= 2000
            && !found.iter().any(|d| d.ids.iter().any(|id| p.ids.contains(id)))
            && [p.points[0].0, p.points[p.points.len() - 1].0].iter().all(|e| geom::inside(*e, line))
    };
    let most = 2000.min(limits::DART_TESTS / line.len().max(1));
    let open: Vec<chain::Path> = paths.iter().take(most).filter(free).take(STROKES_MOST).cloned().collect();
    if open.len() < 2 { Vec::new() } else { chain::chain(open, STROKES).closed }
}
