//! Texts of a block: keys of the piece, grade rules, labels.

use super::codes;
use super::{Desk, DrawnPiece, RuleMark};
use crate::dxf::chain::Path;
use crate::dxf::geom::PointIndex;
use crate::dxf::sheet::Note;
use crate::dxf::texts;
use toile_garment::{Diagnostic, Vec2};

impl DrawnPiece {
    pub(super) fn read_notes(&mut self, notes: Vec<Note>, desk: &mut Desk<'_>) {
        let starts = |p: &Path| [p.points[0].0, p.points[p.points.len() - 1].0];
        let not_mirrored = PointIndex::new(
            0.05,
            notes.iter().enumerate().filter(|(_, n)| n.text.eq_ignore_ascii_case("nm")).map(|(i, n)| (n.at, i)),
        );
        self.inside.not_mirrored =
            self.inside.internal.iter().map(|p| starts(p).iter().any(|s| not_mirrored.has(*s, 0.05))).collect();
        for note in notes {
            if let Some((rule, line)) = texts::rule_number(&note.text) {
                if note.layer.trim() == "5" && self.name_alternate(note.at, rule) {
                    continue;
                }
                self.texts.rules.push(RuleMark { at: note.at, rule, line });
            } else if let Some((key, value)) = texts::key_value(&note.text) {
                self.check_key(&key, &value, desk);
                self.take_key(&key, value, &note.text, note.at, note.layer);
            } else if !note.text.is_empty() {
                self.texts.others.push((note.at, note.layer, note.text));
            }
        }
    }

    /// A number on layer 5 at an end of an alternate reference line is its name.
    fn name_alternate(&mut self, at: Vec2, number: u32) -> bool {
        let near = |ends: &[Vec2; 2]| ends.iter().any(|p| (p - at).norm() <= 0.05);
        let line = self.axes.alternates.iter_mut().find(|l| l.0.is_none() && near(&l.1));
        line.map(|l| l.0 = Some(number)).is_some()
    }

    /// The alternate reference line a rule names: by its text, else by its place among them.
    pub(crate) fn alternate(&self, number: u32) -> Option<[Vec2; 2]> {
        let named = self.axes.alternates.iter().find(|l| l.0 == Some(number));
        let counted =
            || (number as usize).checked_sub(1).and_then(|i| self.axes.alternates.get(i)).filter(|l| l.0.is_none());
        named.or_else(counted).map(|l| l.1)
    }

    /// Every alternate reference line that a rule names must be there.
    pub(super) fn check_rules(&self, desk: &mut Desk<'_>) {
        let missing = self.texts.rules.iter().filter_map(|r| r.line).find(|n| *n != 0 && self.alternate(*n).is_none());
        if let Some(number) = missing {
            let text = format!(
                "grade rules of `{}` name the alternate reference line {number}, which layer 5 does not have; the reference line was taken",
                self.label()
            );
            desk.say(Diagnostic::warning(codes::GRADE_LINE_MISSING, text), &self.block, "5", self.line);
        }
    }

    /// Texts that contradict one above, and quantities that are none.
    fn check_key(&self, key: &str, value: &str, desk: &mut Desk<'_>) {
        let had = match key {
            "piece name" => self.name.as_deref().map(|n| ("Piece Name", n)),
            "size" => self.size.as_deref().map(|s| ("Size", s)),
            _ => None,
        };
        if let Some((what, had)) = had.filter(|(_, h)| !value.is_empty() && !h.eq_ignore_ascii_case(value)) {
            let text = format!(
                "block `{}` has two texts `{what}` that differ: `{had}` and `{value}`; the first one counts",
                self.block
            );
            let hint = "take the wrong one out of the block";
            desk.say(Diagnostic::warning(codes::TEXT_CONTRADICTS, text).hint(hint), &self.block, "1", self.line);
        }
        if key == "quantity" && texts::quantity(value).is_none() {
            let text = format!("`{}`: `Quantity: {value}` cannot be understood; 1 was taken", self.label());
            let finding = if value.is_empty() {
                Diagnostic::info(
                    codes::QUANTITY_UNCLEAR,
                    format!("`{}`: the text `Quantity` is empty; 1 was taken", self.label()),
                )
            } else {
                Diagnostic::warning(codes::QUANTITY_UNCLEAR, text)
                    .hint("write a number, or two as `1,1`: as drawn, and mirrored")
            };
            desk.say(finding, &self.block, "1", self.line);
        }
    }

    fn take_key(&mut self, key: &str, value: String, text: &str, at: Vec2, layer: String) {
        match key {
            "piece name" if self.name.is_none() => self.name = Some(value).filter(|v| !v.is_empty()),
            "size" | "size name" | "sample size" if self.size.is_none() => {
                self.size = Some(value).filter(|v| !v.is_empty())
            }
            "quantity" => self.texts.quantity = texts::quantity(&value).unwrap_or_default(),
            "category" | "annotation" | "material" | "fabric" => {
                self.texts.keys.entry(key.to_owned()).or_insert(value);
            }
            _ => self.texts.others.push((at, layer, text.to_owned())),
        }
    }
}
