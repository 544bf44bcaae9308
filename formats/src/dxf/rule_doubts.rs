//! A rule table beside the pattern it is meant for.

use super::codes;
use super::geom;
use super::pattern::Pattern;
use super::piece::DrawnPiece;
use crate::rul::RuleTable;
use std::collections::BTreeSet;
use toile_garment::{Code, Diagnostic, SourceRef, Vec2};

/// From one size to the next no point of a piece moves farther, mm, or farther than this share of its larger side.
const STEP: (f64, f64) = (120.0, 0.25);

fn differ(a: &str, b: &str) -> bool {
    let tidy = |t: &str| t.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
    let (a, b) = (tidy(a), tidy(b));
    !a.is_empty() && !b.is_empty() && a != b
}

impl Pattern {
    /// Findings where a rule table does not fit this pattern: its name, its sample size, rules that are missing,
    /// growths that no garment has.
    #[must_use]
    pub fn check_rules(&self, table: &RuleTable) -> Vec<Diagnostic> {
        let place = || SourceRef::file(self.file.clone());
        let mut out = Vec::new();
        let mut say = |code: Code, text: String, hint: &str, piece: Option<&DrawnPiece>| {
            let mut at = place();
            (at.block, at.line) = (piece.map(|p| p.block.clone()), piece.map(|p| p.line));
            out.push(Diagnostic::warning(code, text).at(at).hint(hint));
        };
        let own = self.style_texts.get("grade rule table");
        if let Some((own, theirs)) = own.zip(table.name.as_ref()).filter(|(a, b)| differ(a, b)) {
            let text =
                format!("the pattern names the rule table `{own}`, and the one beside it is `{theirs}`; it was taken");
            say(
                codes::RULE_TABLE_DIFFERS,
                text,
                "give the rule table that belongs to the pattern: rules = \"…\"",
                None,
            );
        }
        let own = self.sample_size.as_ref();
        if let Some((own, theirs)) = own.zip(table.sample.as_ref()).filter(|(a, b)| differ(a, b)) {
            let text = format!("the sample size is `{own}` in the pattern and `{theirs}` in the rule table");
            say(
                codes::RULE_TABLE_DIFFERS,
                text,
                "growths are relative to the sample size of the table; make sure which is right",
                None,
            );
        }
        for piece in &self.pieces {
            let missing: BTreeSet<u32> =
                piece.texts.rules.iter().map(|r| r.rule).filter(|n| *n != 0 && !table.rules.contains_key(n)).collect();
            if !missing.is_empty() {
                let list: Vec<String> = missing.iter().take(20).map(u32::to_string).collect();
                let text = format!(
                    "`{}` uses the grade rules {}, which the rule table does not have; only drawn sizes can be made of it",
                    piece.label(),
                    list.join(", ")
                );
                say(
                    codes::RULES_MISSING,
                    text,
                    "give the rule table that belongs to the pattern, whole: rules = \"…\"",
                    Some(piece),
                );
            }
        }
        if let Some((piece, rule, sizes, step)) = self.pieces.iter().find_map(|p| implausible(p, table)) {
            let text = format!(
                "rule {rule} moves a point of `{}` by {step:.0} mm from size {} to {}: the unit of the rule table ({}) or of the pattern is wrong",
                piece.label(),
                sizes[0],
                sizes[1],
                table.units.as_deref().unwrap_or("none")
            );
            say(codes::RULE_GROWTH_DOUBTFUL, text, "correct UNITS in the rule table", Some(piece));
        }
        out
    }
}

type Doubt<'a> = (&'a DrawnPiece, u32, [&'a str; 2], f64);

/// The first rule of a piece with a step between two sizes that no piece of its size makes.
fn implausible<'a>(piece: &'a DrawnPiece, table: &'a RuleTable) -> Option<Doubt<'a>> {
    let (lo, hi) = geom::bounds(piece.boundary.drawn.iter().map(|n| n.at))?;
    let most = STEP.0.max(STEP.1 * (hi.x - lo.x).max(hi.y - lo.y));
    let used: BTreeSet<u32> = piece.texts.rules.iter().map(|r| r.rule).collect();
    used.into_iter().filter_map(|rule| table.rules.get(&rule).map(|g| (rule, g))).find_map(|(rule, growth)| {
        let step = |k: usize| -> Option<f64> {
            let (a, b): (&Vec2, &Vec2) = (growth.get(k)?, growth.get(k + 1)?);
            Some((b - a).norm()).filter(|s| *s > most)
        };
        (0..growth.len()).find_map(|k| {
            let sizes = [table.sizes.get(k)?.as_str(), table.sizes.get(k + 1)?.as_str()];
            step(k).map(|s| (piece, rule, sizes, s))
        })
    })
}
