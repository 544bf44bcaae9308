//! A whole size run: every size as drawn or graded, and the grade rules that lead from the sample size to each.

use super::from_piece::{PieceOptions, piece_drawing};
use super::model::{DrawRule, Drawing, PieceDrawing, StyleText};
use crate::dxf::garment::to_piece;
use crate::dxf::geom;
use crate::dxf::outline::{Node, Outline};
use crate::dxf::pattern::Pattern;
use crate::dxf::piece::DrawnPiece;
use crate::dxf::unfold::Fold;
use crate::rul::RuleTable;
use std::collections::BTreeMap;
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, SourceRef, Vec2};

/// Most rules of a table.
const RULES: usize = 100_000;

/// All sizes of a style.
#[derive(Clone, Debug)]
pub struct SizeRun {
    /// The pieces in all sizes; those of the sample size carry their rules.
    pub drawing: Drawing,
    /// The rules, where there is more than one size.
    pub table: Option<RuleTable>,
    /// What could not be graded, and why.
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

/// All sizes of a pattern: those drawn, and those its rule table adds.
///
/// # Errors
/// A size that cannot be made.
pub fn size_run(pattern: &Pattern, rul: Option<&RuleTable>, options: PieceOptions) -> Result<SizeRun, Vec<Diagnostic>> {
    let sizes = pattern.size_order(rul);
    let first = pattern.choose(None, rul)?;
    let sample = first.size.clone();
    let mut findings = first.findings.clone();
    let mut by_size: Vec<Vec<DrawnPiece>> = Vec::new();
    for size in &sizes {
        let chosen = pattern.choose(Some(size), rul)?;
        by_size.push(chosen.pieces.into_iter().map(std::borrow::Cow::into_owned).collect());
    }
    if sizes.is_empty() {
        by_size.push(first.pieces.into_iter().map(std::borrow::Cow::into_owned).collect());
    }
    let at_sample = sizes.iter().position(|s| sample.as_deref() == Some(s)).unwrap_or(0);
    let mut rules = Rules::default();
    let mut pieces = Vec::new();
    for (i, list) in by_size.iter().enumerate() {
        for drawn in list {
            let mut piece = piece_drawing(&to_piece(drawn, &pattern.file), options, &mut findings);
            if i == at_sample && sizes.len() > 1 {
                match grown(drawn, &by_size, &piece, &mut rules) {
                    Some(list) => piece.rules = list,
                    None => {
                        let text = format!(
                            "`{}` has other vertices in other sizes: it is written in every size, without grade rules",
                            drawn.label()
                        );
                        let place = SourceRef::file(pattern.file.clone()).at_line(drawn.line);
                        findings.push(Diagnostic::warning("sizes-without-rules", text).at(place));
                    }
                }
            }
            pieces.push(piece);
        }
    }
    let name = pattern.style.clone().unwrap_or_default();
    let table = (sizes.len() > 1).then(|| RuleTable {
        name: Some(rul.and_then(|r| r.name.clone()).unwrap_or_else(|| name.clone())),
        units: Some("METRIC".into()),
        sample: sizes.get(at_sample).cloned(),
        sizes,
        rules: rules.list,
        findings: Vec::new(),
    });
    let rule_table = table.as_ref().and_then(|t| t.name.clone());
    let style = StyleText { name, sample_size: sample, author: String::new(), rule_table };
    Ok(SizeRun { drawing: Drawing { style, pieces }, table, findings })
}

/// Picks a line of a piece.
type LineOf = fn(&DrawnPiece) -> Option<&Outline>;

/// The vertices of a line, unfolded.
fn nodes(piece: &DrawnPiece, outline: &Outline) -> Vec<Node> {
    piece.fold.and_then(|f| Fold(f).outline(&outline.drawn)).unwrap_or_else(|| outline.drawn.clone())
}

/// Growths of every vertex of a piece in the frame of the line written as grade reference. `None` when a size has other
/// vertices.
fn grown(
    sample: &DrawnPiece,
    by_size: &[Vec<DrawnPiece>],
    piece: &PieceDrawing,
    rules: &mut Rules,
) -> Option<Vec<DrawRule>> {
    let angle = piece.grain.map_or(0.0, |[a, b]| libm::atan2(b.y - a.y, b.x - a.x));
    let same: Vec<&DrawnPiece> =
        by_size.iter().map(|list| list.iter().find(|p| p.label() == sample.label())).collect::<Option<Vec<_>>>()?;
    let mut out = Vec::new();
    let lines: [(&'static str, LineOf); 2] = [("1", |p| Some(&p.boundary)), ("14", |p| p.sew.as_ref())];
    for (layer, line) in lines {
        let Some(own) = line(sample) else { continue };
        let own = nodes(sample, own);
        let others: Vec<Vec<Node>> = same.iter().map(|p| line(p).map(|l| nodes(p, l))).collect::<Option<Vec<_>>>()?;
        if others.iter().any(|o| o.len() != own.len()) || rules.list.len() > RULES {
            return None;
        }
        for (i, node) in own.iter().enumerate().filter(|(_, n)| n.drawn) {
            let growth = others.iter().map(|o| geom::rotate(o[i].at - node.at, -angle)).collect();
            let kind = if node.kind == PointKind::Curve { PointKind::Curve } else { PointKind::Turn };
            out.push(DrawRule { at: node.at, rule: rules.number(growth), layer, kind });
        }
    }
    Some(out)
}
