//! One drawn piece in one size: what the layers of a block mean together.

use super::chain::{self, Chained, Path};
use super::darts::{self, DrawnDart, Form};
use super::findings::Findings;
use super::geom::{self, Crossing, PointIndex};
use super::ledger::{Ledger, Verdict};
use super::limits;
use super::marked;
use super::notches::{self, DrawnNotch, Ground};
use super::outline::{Making, Marks, Outline};
use super::sheet::{Sheet, Stroke};
use super::texts;
use std::collections::BTreeMap;
use toile_garment::piece::Quantity;
use toile_garment::{Diagnostic, SourceRef, Vec2};

/// A mirror line lies on the boundary within this, mm.
const ON_FOLD: f64 = 0.3;
/// Width of a seam allowance, mm.
const ALLOWANCE: std::ops::RangeInclusive<f64> = 3.0..=40.0;

/// A piece as drawn, millimetres in block coordinates.
#[derive(Clone, Debug)]
pub struct DrawnPiece {
    /// Block name.
    pub block: String,
    /// Line of the block.
    pub line: u64,
    /// Text `Piece Name`, if any.
    pub name: Option<String>,
    /// Text `Size`, if any.
    pub size: Option<String>,
    /// Text `Quantity`.
    pub quantity: Quantity,
    /// Other piece texts by key, in lower case.
    pub keys: BTreeMap<String, String>,
    /// Texts without meaning: place, layer, text.
    pub texts: Vec<(Vec2, String, String)>,
    /// Grade rule texts: place and rule.
    pub rules: Vec<(Vec2, u32)>,
    /// Cut line.
    pub boundary: Outline,
    /// Sew line, where it differs.
    pub sew: Option<Outline>,
    /// Number of sew lines drawn.
    pub sew_lines: usize,
    /// Fold of a half piece.
    pub fold: Option<[Vec2; 2]>,
    /// Notches.
    pub notches: Vec<DrawnNotch>,
    /// Grain line.
    pub grain: Option<[Vec2; 2]>,
    /// Reference line of the grading.
    pub reference: Option<[Vec2; 2]>,
    /// Internal lines (legs of marked darts among them).
    pub internal: Vec<Path>,
    /// Internal lines that say `NM`: not mirrored.
    pub not_mirrored: Vec<bool>,
    /// Cutouts.
    pub cutouts: Vec<Path>,
    /// Drill holes.
    pub drills: Vec<Stroke>,
    /// Darts.
    pub darts: Vec<DrawnDart>,
    /// Points of layer 2 in file order, doubled ones merged.
    pub turn_list: Vec<Vec2>,
    /// Number of corners: points of layer 2, or corners of the outline where there are none.
    pub turn_points: usize,
    /// Points of layer 3, doubled ones merged.
    pub curve_points: usize,
    /// Are there points of layers 2 or 3 in the block?
    pub marked: bool,
    dense: Option<Outline>,
    dense_sew: Option<Outline>,
    marks: Vec<super::sheet::Mark>,
    strokes: Vec<Stroke>,
}

/// What building a piece writes to.
pub(crate) struct Desk<'a> {
    pub findings: &'a mut Findings,
    pub ledger: &'a mut Ledger,
}

impl Desk<'_> {
    fn say(&mut self, finding: Diagnostic, block: &str, layer: &str, line: u64) {
        let place: SourceRef = self.findings.place_in(block, Some(layer), line);
        self.findings.push(finding.at(place));
    }
}

fn mm(p: Vec2) -> String {
    format!("({:.1}, {:.1}) mm", p.x, p.y)
}

impl DrawnPiece {
    /// The outline that is sewn: the sew line where there is one.
    #[must_use]
    pub fn sewn(&self) -> &Outline {
        self.sew.as_ref().unwrap_or(&self.boundary)
    }

    /// Piece name, or the block's.
    #[must_use]
    pub fn label(&self) -> &str {
        self.name.as_deref().filter(|n| !n.is_empty()).unwrap_or(&self.block)
    }

    /// First step: lines chained and kinds set. `None` when the outline is wrong (which is then a finding).
    pub(crate) fn outline(block: &str, line: u64, sheet: Sheet, desk: &mut Desk<'_>) -> Option<Self> {
        let boundary = boundary(block, line, &sheet, desk)?;
        let (main, inner) = boundary;
        let marks = Marks::new(&sheet.turn, &sheet.curve);
        let mut outline = Outline::new(main);
        outline.classify(&marks);
        check_shape(block, &outline, desk)?;
        let distinct = |list: &[Vec2]| {
            let mut index = PointIndex::new(0.01, []);
            list.iter()
                .enumerate()
                .filter(|(i, p)| index.insert_new(**p, *i, 0.01))
                .map(|(_, p)| *p)
                .collect::<Vec<_>>()
        };
        let turn_list = distinct(&sheet.turn);
        let mut piece = Self {
            block: block.to_owned(),
            line,
            name: None,
            size: None,
            quantity: Quantity::default(),
            keys: BTreeMap::new(),
            texts: Vec::new(),
            rules: Vec::new(),
            sew: None,
            sew_lines: 0,
            fold: None,
            notches: Vec::new(),
            grain: sheet
                .grain
                .iter()
                .map(|s| s.ends)
                .max_by(|a, b| (a[1] - a[0]).norm().total_cmp(&(b[1] - b[0]).norm())),
            reference: sheet.reference.first().map(|s| s.ends),
            internal: sheet.internal.into_iter().map(Path::tidy).filter(|p| p.points.len() >= 2).collect(),
            not_mirrored: Vec::new(),
            cutouts: inner
                .into_iter()
                .chain(sheet.cutouts.into_iter().map(Path::tidy))
                .filter(|p| p.points.len() >= 2)
                .collect(),
            drills: sheet.drills,
            darts: Vec::new(),
            turn_points: turn_list.len(),
            turn_list,
            curve_points: distinct(&sheet.curve).len(),
            marked: marks.any,
            dense: closed_copy(sheet.dense),
            dense_sew: closed_copy(sheet.dense_sew),
            marks: sheet.marks,
            strokes: sheet.notch_strokes,
            boundary: outline,
        };
        piece.read_notes(sheet.notes);
        piece.find_fold(&sheet.mirror, desk);
        piece.find_sew_line(sheet.sew, desk);
        if let Some(sew) = &mut piece.sew {
            sew.classify(&marks);
        }
        if !piece.marked {
            piece.turn_points =
                piece.boundary.drawn.iter().filter(|n| n.kind == toile_garment::outline::PointKind::Turn).count();
        }
        piece.check_grain(desk);
        Some(piece)
    }

    fn read_notes(&mut self, notes: Vec<super::sheet::Note>) {
        let starts = |p: &Path| [p.points[0].0, p.points[p.points.len() - 1].0];
        let not_mirrored = PointIndex::new(
            0.05,
            notes.iter().enumerate().filter(|(_, n)| n.text.eq_ignore_ascii_case("nm")).map(|(i, n)| (n.at, i)),
        );
        self.not_mirrored =
            self.internal.iter().map(|p| starts(p).iter().any(|s| not_mirrored.has(*s, 0.05))).collect();
        for note in notes {
            if let Some(rule) = texts::rule_number(&note.text) {
                self.rules.push((note.at, rule));
            } else if let Some((key, value)) = texts::key_value(&note.text) {
                self.take_key(&key, value, &note.text, note.at, note.layer);
            } else if !note.text.is_empty() {
                self.texts.push((note.at, note.layer, note.text));
            }
        }
    }

    fn take_key(&mut self, key: &str, value: String, text: &str, at: Vec2, layer: String) {
        match key {
            "piece name" if self.name.is_none() => self.name = Some(value).filter(|v| !v.is_empty()),
            "size" | "size name" | "sample size" if self.size.is_none() => {
                self.size = Some(value).filter(|v| !v.is_empty())
            }
            "quantity" => self.quantity = texts::quantity(&value).unwrap_or_default(),
            "category" | "annotation" | "material" | "fabric" => {
                self.keys.entry(key.to_owned()).or_insert(value);
            }
            _ => self.texts.push((at, layer, text.to_owned())),
        }
    }

    fn find_fold(&mut self, mirrors: &[Stroke], desk: &mut Desk<'_>) {
        let longest = mirrors.iter().max_by(|a, b| {
            let l = |s: &Stroke| (s.ends[1] - s.ends[0]).norm();
            l(a).total_cmp(&l(b))
        });
        let Some(stroke) = longest else { return };
        let line = self.boundary.positions();
        let [a, b] = stroke.ends;
        if fold_run(&line, a, b).is_some() {
            self.fold = Some([a, b]);
            desk.ledger.overrule(
                stroke.id,
                Verdict::Interpreted,
                "mirror line on the boundary: the half piece is unfolded",
            );
        } else {
            let text = format!(
                "the mirror line from {} to {} of `{}` does not lie on the boundary; the piece was not unfolded",
                mm(a),
                mm(b),
                self.label()
            );
            desk.ledger.overrule(stroke.id, Verdict::Refused, "mirror line off the boundary");
            desk.say(Diagnostic::warning("fold-off-boundary", text), &self.block, "6", stroke.line);
        }
    }

    fn find_sew_line(&mut self, runs: Vec<Path>, desk: &mut Desk<'_>) {
        if !runs.is_empty() {
            let Chained { mut closed, open, gaps: _ } = chain::chain(runs);
            let mut stray = Vec::new();
            for path in open {
                // The sew line of a half piece ends on the fold.
                let ends = [path.points[0].0, path.points[path.points.len() - 1].0];
                let on_fold = self.fold.is_some_and(|[a, b]| {
                    let d = b - a;
                    ends.iter().all(|p| geom::cross(d, p - a).abs() <= 0.5 * d.norm())
                });
                if on_fold && path.points.len() >= 3 { closed.push(path) } else { stray.push(path) }
            }
            self.sew_lines = closed.len();
            closed.sort_by(|a, b| geom::area(&b.positions()).abs().total_cmp(&geom::area(&a.positions()).abs()));
            let whole = geom::area(&self.boundary.positions()).abs();
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
        } else if let Some(i) = (0..self.internal.len()).find(|i| self.is_inner_copy(&self.internal[*i])) {
            let path = self.internal.remove(i);
            self.not_mirrored.remove(i);
            for id in &path.ids {
                desk.ledger.overrule(*id, Verdict::Interpreted, "closed line on layer 8 inside the outline: sew line");
            }
            self.sew_lines = 1;
            self.sew = Some(Outline::new(path));
        }
    }

    /// A closed line on layer 8 that runs inside the cut line all round, an allowance away.
    fn is_inner_copy(&self, path: &Path) -> bool {
        let (ours, theirs) = (self.boundary.positions(), path.positions());
        if !path.closed || geom::area(&theirs).abs() < 0.5 * geom::area(&ours).abs() || theirs.len() > 20_000 {
            return false;
        }
        let cut_near = |p: &Vec2| ALLOWANCE.contains(&geom::distance(*p, &theirs, true));
        let stride = |n: usize| n / 500 + 1;
        let cut: Vec<bool> = ours.iter().step_by(stride(ours.len())).map(cut_near).collect();
        let near = cut.iter().filter(|c| **c).count();
        let inside = theirs.iter().step_by(stride(theirs.len())).all(|p| geom::inside(*p, &ours));
        inside && near * 10 >= cut.len() * 9
    }

    fn check_grain(&mut self, desk: &mut Desk<'_>) {
        if self.grain.is_some_and(|[a, b]| (b - a).norm() < 1.0) {
            self.grain = None;
        }
        if self.grain.is_none() {
            let text = format!("`{}` has no grain line (layer 7)", self.label());
            desk.say(
                Diagnostic::warning("grain-missing", text).hint("the warp is then taken along +y"),
                &self.block,
                "7",
                self.line,
            );
        }
    }

    /// Second step, once kinds are known in every size: working lines, notches, darts.
    pub(crate) fn finish(&mut self, desk: &mut Desk<'_>) {
        self.make_work(desk);
        self.find_notches(desk);
        self.find_darts(desk);
        self.check_extras(desk);
    }

    fn make_work(&mut self, desk: &mut Desk<'_>) {
        let label = self.label().to_owned();
        let lines = [(Some(&mut self.boundary), &self.dense, "84"), (self.sew.as_mut(), &self.dense_sew, "87")];
        for (outline, dense, layer) in lines {
            let Some(outline) = outline else { continue };
            let verdict = outline.make_work(dense.as_ref());
            if let Some(Err(off)) = verdict {
                let text = format!(
                    "the dense curve on layer {layer} of `{label}` is up to {off:.1} mm off the outline; not used"
                );
                let finding = Diagnostic::warning("validation-curve-differs", text);
                desk.say(finding, &self.block, layer, outline.line);
            }
            if geom::crossing(&outline.work_positions()) != Crossing::None {
                let text = format!(
                    "the smooth curve through the points of `{label}` would cross itself; the drawn line was used"
                );
                outline.as_drawn();
                desk.say(Diagnostic::warning("curve-not-smoothed", text), &self.block, "1", outline.line);
            }
            if let Making::Smoothed(off) = outline.making {
                let text = format!(
                    "curve points of `{label}` were joined by a smooth curve, up to {off:.2} mm off the chords"
                );
                desk.say(Diagnostic::info("curve-interpolated", text), &self.block, "3", outline.line);
            }
        }
    }

    fn find_notches(&mut self, desk: &mut Desk<'_>) {
        if self.marks.len() > limits::NOTCHES || self.strokes.len() > limits::NOTCHES {
            let text = format!("`{}` has more than {} notches", self.label(), limits::NOTCHES);
            desk.say(Diagnostic::error("too-many-notches", text), &self.block, "4", self.line);
            return;
        }
        let boundary = self.boundary.positions();
        let sew = self.sew.as_ref().map(Outline::positions);
        let internal: Vec<(Vec<Vec2>, bool)> = self.internal.iter().map(|p| (p.positions(), p.closed)).collect();
        let ground = Ground { boundary: &boundary, sew: sew.as_deref(), internal: &internal };
        let (mut list, doubled) = notches::from_marks(&self.marks, &ground);
        list.extend(notches::from_strokes(&self.strokes, &ground));
        for id in doubled {
            desk.ledger.overrule(id, Verdict::Interpreted, "doubled notch, merged");
        }
        for notch in list.iter().filter(|n| n.on == "off") {
            let text =
                format!("a notch of `{}` at {} lies {:.1} mm off the boundary", self.label(), mm(notch.at), notch.off);
            desk.say(Diagnostic::warning("notch-off-boundary", text), &self.block, "4", notch.line);
        }
        self.notches = list;
    }

    fn find_darts(&mut self, desk: &mut Desk<'_>) {
        let on = if self.sew.is_some() { "sew" } else { "cut" };
        let mut found = darts::wedges(self.sewn(), on);
        found.extend(marked::marked(&self.internal, self.sewn()));
        let line = self.sewn().positions();
        found.extend(marked::lenses(&self.internal, &line));
        found.extend(marked::lenses(&self.cutouts, &line));
        for dart in &found {
            for id in &dart.ids {
                let rule = if dart.form == Form::Lens { "closed lens: fish-eye dart" } else { "legs of a marked dart" };
                desk.ledger.overrule(*id, Verdict::Interpreted, rule);
            }
        }
        let at: Vec<Vec2> = self.notches.iter().map(|n| n.at).collect();
        let drills: Vec<Vec2> = self.drills.iter().map(|d| d.ends[0]).collect();
        for (drill, mouth) in marked::candidates(&at, &drills, &found) {
            let text = format!(
                "two notches at {} and {} and a drill hole at {} of `{}` may be a dart; it was not made one",
                mm(mouth[0]),
                mm(mouth[1]),
                mm(drill),
                self.label()
            );
            let hint = "declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"wedge\"";
            desk.say(Diagnostic::info("dart-candidate", text).hint(hint), &self.block, "13", self.line);
        }
        self.darts = found;
    }

    fn check_extras(&mut self, desk: &mut Desk<'_>) {
        for dart in &self.darts {
            let (a, b) = (dart.leg_path(0), dart.leg_path(1));
            if (a - b).abs() > 1.0 && (a - b).abs() > 0.01 * a.max(b) {
                let text = format!(
                    "the legs of the dart at {} of `{}` are {a:.1} and {b:.1} mm long, {:.1} mm apart; they were left as drawn",
                    mm(dart.apexes[0]),
                    self.label(),
                    (a - b).abs()
                );
                let hint = "the difference is eased in when the dart is sewn; correct the pattern if it is a mistake";
                desk.say(Diagnostic::warning("dart-legs-differ", text).hint(hint), &self.block, "1", dart.line);
            }
        }
    }

    /// Carries kinds and notches over from the sample size.
    pub(crate) fn take_from_sample(&mut self, sample: &Self) -> bool {
        if !self.marked && sample.marked {
            if !self.boundary.classify_like(&sample.boundary) {
                return false;
            }
            if let (Some(sew), Some(like)) = (&mut self.sew, &sample.sew) {
                sew.classify_like(like);
            }
            self.turn_points = 0;
        }
        if self.marks.is_empty() && self.strokes.is_empty() {
            let (from, to) = (sample.boundary.positions(), self.boundary.positions());
            if from.len() != to.len() || sample.marks.len() > limits::NOTCHES {
                return sample.marks.is_empty();
            }
            self.marks = sample.marks.iter().filter_map(|m| carried(m, &from, &to)).collect();
        }
        true
    }
}

fn carried(mark: &super::sheet::Mark, from: &[Vec2], to: &[Vec2]) -> Option<super::sheet::Mark> {
    let foot = geom::nearest(mark.at, from, true).filter(|f| f.distance <= 0.5)?;
    let (a, b) = (to[foot.segment], to[(foot.segment + 1) % to.len()]);
    let u = from[(foot.segment + 1) % from.len()] - from[foot.segment];
    let turned = libm::atan2(geom::cross(u, b - a), u.dot(&(b - a)));
    Some(super::sheet::Mark { at: a + (b - a) * foot.t, angle: mark.angle.map(|x| x + turned), ..mark.clone() })
}

fn closed_copy(runs: Vec<Path>) -> Option<Outline> {
    let largest = chain::chain(runs).closed.into_iter().max_by(|a, b| {
        let area = |p: &Path| geom::area(&p.positions()).abs();
        area(a).total_cmp(&area(b))
    });
    largest.map(Outline::new)
}

/// The run of boundary vertices that lies on the line from `a` to `b`: first and last index, counter-clockwise.
pub(crate) fn fold_run(line: &[Vec2], a: Vec2, b: Vec2) -> Option<(usize, usize)> {
    let n = line.len();
    let d = b - a;
    if d.norm() < 5.0 || n < 3 {
        return None;
    }
    let off = |p: Vec2| geom::cross(d, p - a).abs() / d.norm();
    let near =
        |p: Vec2| (0..n).filter(|i| (line[*i] - p).norm() <= 1.0 && off(line[*i]) <= ON_FOLD).collect::<Vec<_>>();
    for from in near(a).into_iter().chain(near(b)).take(16) {
        let target = if (line[from] - a).norm() <= 1.0 { b } else { a };
        let mut i = from;
        for _ in 0..n {
            i = (i + 1) % n;
            if off(line[i]) > ON_FOLD {
                break;
            }
            if (line[i] - target).norm() <= 1.0 {
                return Some((from, i));
            }
        }
    }
    None
}

/// The outline among the lines of layer 1, and closed lines inside it.
fn boundary(block: &str, line: u64, sheet: &Sheet, desk: &mut Desk<'_>) -> Option<(Path, Vec<Path>)> {
    let Chained { mut closed, open, gaps } = chain::chain(sheet.boundary.clone());
    for gap in gaps {
        let text =
            format!("the outline of block `{block}` has a gap of {:.2} mm at {}; it was closed", gap.width, mm(gap.at));
        desk.say(Diagnostic::warning("outline-gap-closed", text), block, "1", line);
    }
    let area = |p: &Path| geom::area(&p.positions()).abs();
    closed.sort_by(|a, b| area(b).total_cmp(&area(a)));
    let longest_open = open.iter().map(|p| geom::length(&p.positions(), false)).fold(0.0, f64::max);
    let main_length = closed.first().map_or(0.0, |p| geom::length(&p.positions(), true));
    if closed.is_empty() || longest_open > 0.5 * main_length {
        for path in &open {
            let (a, b) = (path.points[0].0, path.points[path.points.len() - 1].0);
            let text = format!(
                "the outline of block `{block}` is open: {:.2} mm are missing between {} and {}",
                (a - b).norm(),
                mm(b),
                mm(a)
            );
            let finding = Diagnostic::error("outline-open", text)
                .hint(format!("close it in the pattern; gaps up to {} mm are closed with a note", chain::GAP));
            desk.say(finding, block, "1", path.line);
        }
        if open.is_empty() {
            let text = format!("block `{block}` has lines on layer 1 but no outline");
            desk.say(Diagnostic::error("outline-missing", text), block, "1", line);
        }
        return None;
    }
    for path in &open {
        let text = format!(
            "an open line on layer 1 of block `{block}` at {} is no part of the outline; it was left out",
            mm(path.points[0].0)
        );
        for id in &path.ids {
            desk.ledger.overrule(*id, Verdict::Refused, "open line on layer 1 beside the outline");
        }
        desk.say(Diagnostic::warning("outline-stray-line", text), block, "1", path.line);
    }
    let mut closed = closed.into_iter();
    let main = closed.next()?;
    let polygon = main.positions();
    let mut inner = Vec::new();
    for path in closed {
        let inside = path.points.iter().all(|p| geom::inside(p.0, &polygon));
        let (what, verdict) =
            if inside { ("read as a cutout", Verdict::Interpreted) } else { ("left out", Verdict::Refused) };
        let text =
            format!("block `{block}` has a second closed line on layer 1 at {}; it was {what}", mm(path.points[0].0));
        for id in &path.ids {
            desk.ledger.overrule(*id, verdict, "second closed line on layer 1");
        }
        desk.say(Diagnostic::warning("outline-second", text), block, "1", path.line);
        if inside {
            inner.push(path);
        }
    }
    Some((main, inner))
}

fn check_shape(block: &str, outline: &Outline, desk: &mut Desk<'_>) -> Option<()> {
    let points = outline.positions();
    let mut fail = |code: &str, text: String, hint: &str| {
        desk.say(Diagnostic::error(code, text).hint(hint), block, "1", outline.line);
        None
    };
    if points.len() > limits::OUTLINE_POINTS {
        let text = format!("the outline of block `{block}` has more than {} points", limits::OUTLINE_POINTS);
        return fail("outline-too-long", text, "export it with a coarser curve tolerance");
    }
    let (lo, hi) = geom::bounds(points.iter().copied())?;
    let extent = (hi.x - lo.x).max(hi.y - lo.y);
    if extent > limits::PIECE_EXTENT_MM {
        let text = format!("the outline of block `{block}` is {:.0} m long", extent / 1000.0);
        return fail("outline-too-large", text, "check the unit of the file");
    }
    match geom::crossing(&points) {
        Crossing::None if points.len() >= 3 && geom::area(&points).abs() >= 1.0 => Some(()),
        Crossing::None => {
            let text = format!("the outline of block `{block}` at {} encloses no area", mm(points[0]));
            fail("outline-without-area", text, "draw a closed outline on layer 1")
        }
        Crossing::TooMany => {
            let text = format!("the outline of block `{block}` is too entangled to check");
            fail("outline-too-entangled", text, "simplify it")
        }
        Crossing::At(_, _, p) => {
            let text = format!("the outline of block `{block}` intersects itself at {}", mm(p));
            fail("outline-crosses-itself", text, "correct the outline there")
        }
    }
}
