//! A whole size run: every size as drawn or graded, and the grade rules that lead from the sample size to each.

mod carried;

use super::codes;
use super::from_piece::{PieceOptions, piece_drawing};
use super::growth::{Grown, drawn_line, made_line};
use super::model::{DrawLine, DrawRule, Drawing, PieceDrawing, StyleText};
use crate::dxf::codes::SOUND_PARTS;
use crate::dxf::garment::to_piece;
use crate::dxf::geom::{self, PointIndex};
use crate::dxf::pattern::Pattern;
use crate::dxf::piece::DrawnPiece;
use crate::dxf::sizes::Chosen;
use crate::rul::RuleTable;
use std::collections::BTreeMap;
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Piece, SourceRef, Vec2};

pub use carried::Changed;

/// Most rules of a table.
const RULES: usize = 100_000;
/// A rule belongs to a vertex within this, mm.
const SAME: f64 = 0.02;

/// Why a size cannot be made. A run holds all sizes and pieces, so that a choice of them is no remedy.
fn of_run(mut findings: Vec<Diagnostic>) -> Vec<Diagnostic> {
    findings.retain(|f| f.code != SOUND_PARTS);
    findings
}

/// All sizes of a style.
#[derive(Clone, Debug)]
pub struct SizeRun {
    /// The pieces in all sizes; those of the sample size carry their rules.
    pub drawing: Drawing,
    /// The rules, where there is more than one size.
    pub table: Option<RuleTable>,
    /// Findings on pieces that could not be graded, and why.
    pub findings: Vec<Diagnostic>,
}

/// Numbers of rules by their growths.
#[derive(Default)]
struct Rules {
    by_growth: BTreeMap<Vec<[i64; 2]>, u32>,
    list: BTreeMap<u32, Vec<Vec2>>,
}

impl Rules {
    /// The rule with these growths; 1/10,000 mm apart is the same.
    fn number(&mut self, growth: Vec<Vec2>) -> u32 {
        let key = growth.iter().map(|g| [g.x, g.y].map(|v| (v * 1e4).round() as i64)).collect();
        let next = self.by_growth.len() as u32 + 1;
        let number = *self.by_growth.entry(key).or_insert(next);
        self.list.entry(number).or_insert(growth);
        number
    }
}

/// A piece in one size.
struct Sized {
    drawn: DrawnPiece,
    piece: Piece,
}

/// A pattern in all its sizes: those drawn, and those its rule table adds.
pub struct Sizes {
    file: String,
    style: String,
    table_name: Option<String>,
    names: Vec<String>,
    sample: Option<String>,
    lists: Vec<Vec<Sized>>,
    recut: bool,
    findings: Vec<Diagnostic>,
}

impl Sizes {
    /// The pieces of a pattern in all sizes.
    ///
    /// # Errors
    /// A size that cannot be made.
    pub fn new(pattern: &Pattern, rul: Option<&RuleTable>) -> Result<Self, Vec<Diagnostic>> {
        let names = pattern.size_order(rul);
        let first = pattern.choose(None, rul).map_err(of_run)?;
        let (sample, mut findings) = (first.size.clone(), first.findings.clone());
        let chosen: Vec<Chosen<'_>> = if names.is_empty() {
            vec![first]
        } else {
            names.iter().map(|size| pattern.choose(Some(size), rul)).collect::<Result<_, _>>().map_err(of_run)?
        };
        for finding in chosen.iter().flat_map(|c| &c.findings) {
            if !findings.contains(finding) {
                findings.push(finding.clone());
            }
        }
        let sized = |drawn: DrawnPiece| Sized { piece: to_piece(&drawn, &pattern.file), drawn };
        let lists = chosen.into_iter().map(|c| c.pieces.into_iter().map(|p| sized(p.into_owned())).collect()).collect();
        let style = pattern.style.clone().unwrap_or_default();
        let table_name = rul.and_then(|r| r.name.clone());
        Ok(Self { file: pattern.file.clone(), style, table_name, names, sample, lists, recut: false, findings })
    }

    /// Changes the cut lines and the notches of the pieces of all sizes, which are changed together.
    ///
    /// # Errors
    /// What `change` gives.
    pub fn recut<E>(&mut self, change: impl FnOnce(&mut [Piece]) -> Result<(), E>) -> Result<(), E> {
        self.recut = true;
        let mut pieces: Vec<Piece> = self.lists.iter().flatten().map(|s| s.piece.clone()).collect();
        change(&mut pieces)?;
        self.lists.iter_mut().flatten().zip(pieces).for_each(|(s, piece)| s.piece = piece);
        Ok(())
    }

    /// The drawing of all sizes, and the rules that lead from the sample size to each.
    #[must_use]
    pub fn draw(self, options: PieceOptions) -> SizeRun {
        let mut findings = self.findings.clone();
        let at_sample = self.names.iter().position(|s| self.sample.as_deref() == Some(s)).unwrap_or(0);
        let mut rules = Rules::default();
        let mut pieces = Vec::new();
        for (i, list) in self.lists.iter().enumerate() {
            for sized in list {
                let mut piece = piece_drawing(&sized.piece, options, &mut findings);
                if i == at_sample && self.names.len() > 1 {
                    piece.rules = self.rules(sized, &piece, &mut rules, &mut findings);
                }
                pieces.push(piece);
            }
        }
        let table = (self.names.len() > 1).then(|| RuleTable {
            name: Some(self.table_name.unwrap_or_else(|| self.style.clone())),
            units: Some("METRIC".into()),
            sample: self.names.get(at_sample).cloned(),
            sizes: self.names,
            rules: rules.list,
            findings: Vec::new(),
        });
        let rule_table = table.as_ref().and_then(|t| t.name.clone());
        let style = StyleText { name: self.style, sample_size: self.sample, rule_table, ..StyleText::default() };
        SizeRun { drawing: Drawing { style, pieces }, table, findings }
    }

    /// The rules of a piece of the sample size, as far as it is drawn.
    fn rules(
        &self,
        sized: &Sized,
        piece: &PieceDrawing,
        rules: &mut Rules,
        findings: &mut Vec<Diagnostic>,
    ) -> Vec<DrawRule> {
        let Some(lines) = self.grown(sized).filter(|_| rules.list.len() <= RULES) else {
            let text = format!(
                "`{}` has other vertices in other sizes, or is missing in one: it is written in every size it has, without grade rules ({})",
                sized.drawn.label(),
                self.counts(sized.drawn.label())
            );
            let place = SourceRef::file(self.file.clone()).at_line(sized.drawn.line);
            findings.push(Diagnostic::warning(codes::SIZES_WITHOUT_RULES, text).at(place));
            return Vec::new();
        };
        let angle = piece.grain.map_or(0.0, |[a, b]| libm::atan2(b.y - a.y, b.x - a.x));
        // A half piece has no vertices beyond its fold.
        let drawn = |line: &DrawLine| line.points.iter().map(|p| (p.at, 0)).collect::<Vec<_>>();
        let there = [Some(&piece.boundary), piece.sew_line.as_ref()].into_iter().flatten().flat_map(drawn);
        let there = PointIndex::new(SAME, there);
        let mut out = Vec::new();
        for (layer, grown) in lines {
            for Grown { at, kind, by_size } in grown.into_iter().filter(|g| there.has(g.at, SAME)) {
                let growth = by_size.iter().map(|to| geom::rotate(to - at, -angle)).collect();
                let kind = if kind == PointKind::Curve { PointKind::Curve } else { PointKind::Turn };
                out.push(DrawRule { at, rule: rules.number(growth), layer, kind });
            }
        }
        out
    }

    /// How many vertices and notches a piece has in each size, sizes of the same counts together.
    fn counts(&self, label: &str) -> String {
        let mut sizes: BTreeMap<[usize; 2], Vec<&str>> = BTreeMap::new();
        for (name, list) in self.names.iter().zip(&self.lists) {
            for drawn in list.iter().map(|s| &s.drawn).filter(|d| d.label() == label) {
                sizes.entry([drawn.boundary.drawn.len(), drawn.notches.len()]).or_default().push(name);
            }
        }
        let one = |([vertices, notches], names): (&[usize; 2], &Vec<&str>)| {
            format!("{}: {vertices} vertices, {notches} notches", names.join(", "))
        };
        sizes.iter().map(one).collect::<Vec<_>>().join("; ")
    }

    /// A piece in every size; `None` where one has none of that name.
    fn in_all_sizes(&self, sample: &Sized) -> Option<Vec<&Sized>> {
        let like = |list: &'_ Vec<Sized>| list.iter().position(|s| s.drawn.label() == sample.drawn.label());
        self.lists.iter().map(|list| like(list).map(|i| &list[i])).collect()
    }

    /// The same as it is drawn.
    fn of_all_sizes(&self, sample: &Sized) -> Option<Vec<&DrawnPiece>> {
        Some(self.in_all_sizes(sample)?.into_iter().map(|s| &s.drawn).collect())
    }

    /// The vertices of the lines of a piece and where they go in each size; `None` when a size has others.
    fn grown(&self, sample: &Sized) -> Option<Vec<(&'static str, Vec<Grown>)>> {
        let drawn = self.of_all_sizes(sample)?;
        if !self.recut {
            let mut lines = vec![("1", drawn_line(&sample.drawn, &drawn, |p| Some(&p.boundary))?)];
            if sample.drawn.sew.is_some() {
                lines.push(("14", drawn_line(&sample.drawn, &drawn, |p| p.sew.as_ref())?));
            }
            return Some(lines);
        }
        let sewn = drawn_line(&sample.drawn, &drawn, |p| Some(p.sewn()))?;
        let same = self.in_all_sizes(sample)?;
        let cuts: Vec<_> = same.iter().map(|s| s.piece.cut_line.as_ref()).collect::<Option<_>>()?;
        Some(vec![("14", sewn), ("1", made_line(sample.piece.cut_line.as_ref()?, &cuts)?)])
    }
}
