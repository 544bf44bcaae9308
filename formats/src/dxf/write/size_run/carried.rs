//! The sizes of a pattern carried to pieces that were changed in one size. Every point keeps its growth from the outline of
//! the pattern, and a point between two vertices gets what lies between theirs.

use super::super::from_piece::{PieceOptions, piece_drawing};
use super::super::model::{Dialect, DrawRule, Drawing, PieceDrawing, StyleText};
use super::super::write;
use super::{Rules, SAME, SizeRun, Sized, Sizes};
use crate::codes::{SIZES_CARRIED, SIZES_NOT_CARRIED};
use crate::dxf::geom;
use crate::dxf::{ReadOptions, read};
use crate::rul::RuleTable;
use toile_garment::outline::{PieceLine, PointKind};
use toile_garment::{Diagnostic, Piece, SourceRef, Vec2};

/// Millimetres in a metre.
const MM: f64 = 1e3;
/// A point this near to the outline of the pattern lies on it, mm. Chords of drawn curves lie off them by as much.
const ON_LINE: f64 = 1.0;
/// Growths that differ by less are one, mm.
const NO_GROWTH: f64 = 1e-3;

/// A piece before and after a change that kept its points, metres.
pub struct Changed {
    /// The piece where its points lie on the pattern.
    pub before: Piece,
    /// The piece as it is to be written.
    pub after: Piece,
}

/// A closed line with the growth of each of its points in every size, mm.
struct GrownLine {
    points: Vec<Vec2>,
    growth: Vec<Vec<Vec2>>,
}

impl GrownLine {
    /// The growth at the place of the line that is nearest to a point, and its distance.
    fn at(&self, p: Vec2) -> Option<(f64, Vec<Vec2>)> {
        let foot = geom::nearest(p, &self.points, true)?;
        let (a, b) = (self.growth.get(foot.segment)?, self.growth.get((foot.segment + 1) % self.points.len())?);
        Some((foot.distance, between(a, b, foot.t)))
    }

    /// Growth of every point of a closed line; those without one get what lies between their neighbours by the way.
    fn filled(points: Vec<Vec2>, known: Vec<Option<Vec<Vec2>>>) -> Option<Self> {
        let n = points.len();
        let first = known.iter().position(Option::is_some)?;
        let mut growth = vec![Vec::new(); n];
        let mut from = 0;
        for k in 1..=n {
            let Some(to) = &known[(first + k) % n] else { continue };
            let begin = known[(first + from) % n].as_ref()?;
            let step = |i: usize| (points[(first + i + 1) % n] - points[(first + i) % n]).norm();
            let whole: f64 = (from..k).map(step).sum();
            let mut way = 0.0;
            for i in from..k {
                growth[(first + i) % n] = between(begin, to, if whole > 0.0 { way / whole } else { 0.0 });
                way += step(i);
            }
            from = k;
        }
        Some(Self { points, growth })
    }
}

fn between(a: &[Vec2], b: &[Vec2], t: f64) -> Vec<Vec2> {
    a.iter().zip(b).map(|(a, b)| a + (b - a) * t).collect()
}

impl Sizes {
    /// The changed pieces in all sizes of this pattern, `size` being the one that they were changed in.
    ///
    /// # Errors
    /// A pattern of one size, and what cannot be written.
    pub fn carried(
        &self,
        size: Option<&str>,
        changed: &[Changed],
        options: PieceOptions,
    ) -> Result<SizeRun, Vec<Diagnostic>> {
        let wanted = size.or(self.sample.as_deref());
        let base = self.names.iter().position(|s| wanted.is_some_and(|w| s.trim().eq_ignore_ascii_case(w.trim())));
        let Some(base) = base.filter(|_| self.names.len() > 1) else {
            let text = format!(
                "`{}` has no other sizes to carry to pieces of size {}; its sizes are: {}",
                self.file,
                wanted.unwrap_or("?"),
                self.names.join(", ")
            );
            return Err(vec![Diagnostic::error(SIZES_NOT_CARRIED, text).at(SourceRef::file(self.file.clone()))]);
        };
        let (mut rules, mut findings) = (Rules::default(), self.findings.clone());
        let whole = PieceOptions { half_on_fold: false, ..options };
        let mut pieces = Vec::new();
        for piece in changed {
            let mut drawing = piece_drawing(&piece.after, whole, &mut findings);
            drawing.rules = self.carried_rules(base, piece, &drawing, &mut rules, &mut findings);
            pieces.push(drawing);
        }
        let table = RuleTable {
            name: Some(self.table_name.clone().unwrap_or_else(|| self.style.clone())),
            units: Some("METRIC".into()),
            sample: self.names.get(base).cloned(),
            sizes: self.names.clone(),
            rules: rules.list,
            findings: Vec::new(),
        };
        let style = StyleText {
            name: self.style.clone(),
            sample_size: self.names.get(base).cloned(),
            rule_table: table.name.clone(),
            ..StyleText::default()
        };
        graded(Drawing { style, pieces }, &table, options, findings)
    }

    /// The rules of a changed piece at all its drawn vertices.
    fn carried_rules(
        &self,
        base: usize,
        piece: &Changed,
        drawing: &PieceDrawing,
        rules: &mut Rules,
        findings: &mut Vec<Diagnostic>,
    ) -> Vec<DrawRule> {
        let name = &piece.before.name;
        let told = |text: String| {
            let hint = "grade these places in the new file, or make the change in every size";
            Diagnostic::warning(SIZES_NOT_CARRIED, text).hint(hint)
        };
        let line = self.like(base, &piece.before).and_then(|o| self.grown_outline(o)).map(|line| {
            let points = |l: &PieceLine| l.points.iter().map(|p| p.at * MM).collect::<Vec<_>>();
            let at = |p: &Vec2| line.at(*p).filter(|(d, _)| *d <= ON_LINE).map(|(_, growth)| growth);
            let known: Vec<_> = points(&piece.before.outline).iter().map(at).collect();
            let corners = piece.before.outline.points.iter().zip(&known).filter(|(p, _)| p.kind == PointKind::Turn);
            let lost = corners.filter(|(_, growth)| growth.is_none()).count();
            (GrownLine::filled(points(&piece.after.outline), known), lost)
        });
        let (line, lost) = match line {
            Some((Some(line), lost)) => (Some(line), lost),
            _ => (None, 0),
        };
        if line.is_none() {
            findings.push(told(format!(
                "`{name}` lies on no piece of the pattern with the same vertices in every size: it stays as it is in all sizes"
            )));
        }
        if lost > 0 {
            findings.push(told(format!(
                "{lost} corner(s) of `{name}` are new or were moved off the outline of the pattern: they go with the \
                 points beside them from size to size"
            )));
        }
        let none = vec![Vec2::zeros(); self.names.len()];
        let angle = drawing.grain.map_or(0.0, |[a, b]| libm::atan2(b.y - a.y, b.x - a.x));
        let mut out = Vec::new();
        let lines = [("1", Some(&drawing.boundary)), ("14", drawing.sew_line.as_ref())];
        for (layer, drawn) in lines.into_iter().filter_map(|(layer, l)| Some((layer, l?))) {
            for p in &drawn.points {
                let growth = line.as_ref().and_then(|l| l.at(p.at)).map_or_else(|| none.clone(), |(_, g)| g);
                let growth = growth.into_iter().map(|g| if g.norm() < NO_GROWTH { Vec2::zeros() } else { g });
                let growth = growth.map(|g| geom::rotate(g, -angle)).collect();
                let kind = if p.kind == PointKind::Curve { PointKind::Curve } else { PointKind::Turn };
                out.push(DrawRule { at: p.at, rule: rules.number(growth), layer, kind });
            }
        }
        out
    }

    /// The piece of a size that a changed piece was made of: the one on whose vertices most of its vertices lie.
    fn like(&self, size: usize, piece: &Piece) -> Option<&Sized> {
        let score = |s: &Sized| {
            let there: Vec<Vec2> = s.piece.outline.points.iter().map(|p| p.at).collect();
            let is_there = |p: &Vec2| there.iter().any(|q| (p - q).norm() * MM <= SAME);
            let count = piece.outline.points.iter().filter(|p| is_there(&p.at)).count();
            (count, s.drawn.label().eq_ignore_ascii_case(&piece.name))
        };
        let list = self.lists.get(size)?.iter().map(|s| (score(s), s)).filter(|(score, _)| score.0 > 0);
        list.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, s)| s)
    }

    /// The sewn line of a piece with its growth in every size.
    fn grown_outline(&self, sample: &Sized) -> Option<GrownLine> {
        let sewn = super::super::growth::drawn_line(&sample.drawn, &self.of_all_sizes(sample)?, |p| Some(p.sewn()))?;
        let growth = sewn.iter().map(|g| g.by_size.iter().map(|to| to - g.at).collect()).collect();
        Some(GrownLine { points: sewn.iter().map(|g| g.at).collect(), growth })
    }
}

/// The drawing of one size in all sizes of its rules.
fn graded(
    drawing: Drawing,
    table: &RuleTable,
    options: PieceOptions,
    mut findings: Vec<Diagnostic>,
) -> Result<SizeRun, Vec<Diagnostic>> {
    let written = write(&drawing, Dialect::Astm)?;
    let pattern = read(&written.bytes, "carried.dxf", &ReadOptions::default())?;
    let sizes = Sizes::new(&pattern, Some(table))?;
    let count = sizes.names.len();
    let mut run = sizes.draw(PieceOptions { half_on_fold: options.half_on_fold, mark_darts: false });
    let text = format!(
        "the change in size {} was carried to {count} sizes: {}",
        table.sample.as_deref().unwrap_or("?"),
        table.sizes.join(", ")
    );
    findings.push(Diagnostic::info(SIZES_CARRIED, text));
    run.findings = findings;
    Ok(run)
}
