//! Texts of a block: keys of the piece, grade rules, labels.

use super::codes;
use super::{Desk, DrawnPiece, RuleMark, mm};
use crate::dxf::chain::Path;
use crate::dxf::geom::PointIndex;
use crate::dxf::grade;
use crate::dxf::sheet::Note;
use crate::dxf::texts;
use std::collections::BTreeSet;
use toile_garment::piece::Quantity;
use toile_garment::{Diagnostic, Vec2};

/// A rule belongs to a vertex this far off if there is no other, mm.
const RULE_OFF: f64 = 1.0;

const QUANTITY_HINT: &str = "write a number, or two as `1,1`: as drawn, and mirrored";

/// Name and size among the texts of a block: the first of each that says something; without one, what a key of other
/// programs says.
pub(super) fn names(notes: &[Note]) -> [Option<String>; 2] {
    let said: Vec<(String, String)> =
        notes.iter().filter_map(|n| texts::key_value(&n.text)).filter(|(_, v)| !v.is_empty()).collect();
    let first = |is: &dyn Fn(&str) -> bool| said.iter().find(|(key, _)| is(key)).map(|(_, value)| value.clone());
    let name =
        first(&|key| key == "piece name").or_else(|| first(&|key| texts::foreign_key(key) == Some("piece name")));
    [name, first(&|key| matches!(key, "size" | "size name" | "sample size"))]
}

/// Puts the colon into texts that lack it, as `SIZE 36`, where no other text of the block says this. Tells which.
pub(super) fn add_colons(notes: &mut [Note]) -> BTreeSet<String> {
    let meaning =
        |key: &str| if matches!(key, "size name" | "sample size") { "size" } else { texts::own_key(key) }.to_owned();
    let told = notes.iter().filter_map(|n| texts::key_value(&n.text)).filter(|(_, value)| !value.is_empty());
    let told: BTreeSet<String> = told.map(|(key, _)| meaning(&key)).collect();
    let mut added = BTreeSet::new();
    for note in notes {
        let Some((key, value)) = texts::without_colon(&note.text) else { continue };
        if key != "units" && !told.contains(&meaning(key)) {
            added.insert(std::mem::replace(&mut note.text, format!("{key}: {value}")));
        }
    }
    added
}

/// The place within reach of a rule, if all of them are one.
fn only_near(index: &PointIndex, places: &[Vec2], at: Vec2) -> Option<Vec2> {
    let near = index.near(at, RULE_OFF);
    let first = places[near.first()?.1];
    near.iter().all(|(_, i)| (places[*i] - first).norm() <= grade::AT).then_some(first)
}

impl DrawnPiece {
    pub(super) fn read_notes(&mut self, notes: Vec<Note>, desk: &mut Desk<'_>) {
        let starts = |p: &Path| [p.points[0].0, p.points[p.points.len() - 1].0];
        let not_mirrored = PointIndex::new(
            0.05,
            notes.iter().enumerate().filter(|(_, n)| n.text.eq_ignore_ascii_case("nm")).map(|(i, n)| (n.at, i)),
        );
        self.inside.not_mirrored =
            self.inside.internal.iter().map(|p| starts(p).iter().any(|s| not_mirrored.has(*s, 0.05))).collect();
        self.check_quantities(&notes, desk);
        let inserted = self.texts.quantity_told.then_some(self.texts.quantity);
        let fabric =
            notes.iter().find(|n| texts::key_value(&n.text).is_some_and(|(key, v)| key == "fabric" && !v.is_empty()));
        let fabric = fabric.cloned();
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
        self.check_count(inserted, desk);
        // A piece has one material: a fabric beside it stays a text.
        let beside = fabric.filter(|_| self.texts.keys.get("material").is_some_and(|m| !m.is_empty()));
        if let Some(note) = beside
            && self.texts.keys.remove("fabric") != self.texts.keys.get("material").cloned()
        {
            self.texts.others.push((note.at, note.layer, note.text));
        }
        if self.texts.keys.get("fabric").is_some_and(|f| !f.is_empty()) {
            self.texts.foreign.insert("fabric".to_owned());
        }
    }

    /// Says that texts of a piece give different quantities, and quantities that cannot be understood.
    fn check_quantities(&self, notes: &[Note], desk: &mut Desk<'_>) {
        let keyed = notes.iter().filter_map(|n| Some((texts::key_value(&n.text)?, n)));
        let said = keyed.filter(|((key, _), _)| texts::own_key(key) == "quantity");
        let (own, foreign): (Vec<_>, Vec<_>) =
            said.map(|((key, value), n)| (key, value, n)).partition(|(key, _, _)| key == "quantity");
        if own.is_empty() {
            foreign.iter().for_each(|(_, value, note)| self.say_foreign_unclear(value, &note.text, desk));
        }
        let is_clear = |(_, value, _): &&(String, String, &Note)| texts::quantity(value).is_some();
        let (own, foreign): (Vec<_>, Vec<_>) =
            (own.iter().filter(is_clear).collect(), foreign.iter().filter(is_clear).collect());
        let (counts, why) = match (own.last(), foreign.first()) {
            (Some(last), _) if foreign.is_empty() => (last, "the last one counts"),
            (Some(last), _) => (last, "that under the key `Quantity` counts"),
            (None, Some(first)) => (first, "the first one counts"),
            (None, None) => return,
        };
        let differs = |other: &&&(String, String, &Note)| texts::quantity(&other.1) != texts::quantity(&counts.1);
        if let Some(other) = own.iter().chain(&foreign).find(differs) {
            let text = format!(
                "block `{}` has two texts `Quantity` that differ: `{}` and `{}`; {why}",
                self.block, other.1, counts.1
            );
            let hint = "take the wrong one out of the block";
            desk.say(Diagnostic::warning(codes::TEXT_CONTRADICTS, text).hint(hint), &self.block, "1", self.line);
        }
    }

    /// Says that a text gives another quantity than the INSERTs, and that nothing is to be cut.
    fn check_count(&self, inserted: Option<Quantity>, desk: &mut Desk<'_>) {
        let told = self.texts.quantity;
        if let Some(counted) = inserted.filter(|counted| *counted != told) {
            let text = format!(
                "block `{}` is inserted {} times, and its text `Quantity` says {}; the text counts",
                self.block,
                counted.plain + counted.mirrored,
                told.plain + told.mirrored
            );
            desk.say(Diagnostic::info(codes::TEXT_CONTRADICTS, text), &self.block, "1", self.line);
        }
        if told.plain + told.mirrored == 0 {
            let text = format!("`{}`: its quantity is 0: nothing of it is cut; it was read all the same", self.label());
            let hint = "leave it out with `pieces` of `import-dxf`, or correct its text `Quantity`";
            desk.say(Diagnostic::info(codes::QUANTITY_UNCLEAR, text).hint(hint), &self.block, "1", self.line);
        }
    }

    /// Says that a quantity under a key of another program cannot be understood, where no other text says it.
    fn say_foreign_unclear(&self, value: &str, whole: &str, desk: &mut Desk<'_>) {
        if texts::quantity(value).is_some() {
            return;
        }
        let taken = if self.texts.quantity_told { "the number of INSERTs" } else { "1" };
        let text = format!("`{}`: `{}` cannot be understood; {taken} was taken", self.label(), whole.trim());
        let finding = Diagnostic::warning(codes::QUANTITY_UNCLEAR, text).hint(QUANTITY_HINT);
        desk.say(finding, &self.block, "1", self.line);
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

    /// Texts of grade rules that stand a little beside their vertex are put on it; those that stand at none are told.
    pub(super) fn settle_rules(&mut self, desk: &mut Desk<'_>) {
        if self.texts.rules.is_empty() {
            return;
        }
        let [graded, others] = self.rule_places();
        let index =
            |places: &[Vec2]| PointIndex::new(RULE_OFF, places.iter().copied().enumerate().map(|(i, p)| (p, i)));
        let (on_graded, on_others) = (index(&graded), index(&others));
        let stand = PointIndex::new(grade::AT, self.texts.rules.iter().map(|r| (r.at, r.rule as usize)));
        let (mut moved, mut lost) = ((0_usize, 0.0_f64), Vec::new());
        for rule in &mut self.texts.rules {
            if on_graded.has(rule.at, grade::AT) || on_others.has(rule.at, grade::AT) {
                continue;
            }
            // A vertex that has a rule of its own keeps it.
            let is_free = |at: &Vec2| stand.near(*at, grade::AT).iter().all(|(_, other)| *other == rule.rule as usize);
            let beside = only_near(&on_graded, &graded, rule.at).or_else(|| only_near(&on_others, &others, rule.at));
            match beside.filter(is_free) {
                Some(at) => {
                    moved = (moved.0 + 1, moved.1.max((rule.at - at).norm()));
                    rule.at = at;
                }
                // Rule 0 moves nothing: it may stand anywhere.
                None if rule.rule != 0 => lost.push(*rule),
                None => {}
            }
        }
        if moved.0 > 0 {
            let text = format!(
                "{} grade rule(s) of `{}` stand up to {:.2} mm beside their vertex; they were put on it",
                moved.0,
                self.label(),
                moved.1
            );
            desk.say(Diagnostic::info(codes::GRADE_RULE_BESIDE_VERTEX, text), &self.block, "2", self.line);
        }
        if let Some(first) = lost.first() {
            let text = format!(
                "{} grade rule(s) of `{}` stand at no vertex within {RULE_OFF} mm, or between two, as # {} at {}; they move nothing",
                lost.len(),
                self.label(),
                first.rule,
                mm(first.at)
            );
            let hint = "put the text on its vertex in the pattern program";
            desk.say(Diagnostic::warning(codes::GRADE_RULE_OFF_VERTEX, text).hint(hint), &self.block, "2", self.line);
        }
    }

    /// The places that a grade rule moves, and those at which one may stand beside them. Dense copies follow their
    /// originals: a rule on one of their vertices alone moves nothing.
    fn rule_places(&self) -> [Vec<Vec2>; 2] {
        let lines = std::iter::once(&self.boundary).chain(&self.sew);
        let mut graded: Vec<Vec2> = lines.flat_map(|l| l.drawn.iter().map(|n| n.at)).collect();
        let inside =
            self.inside.internal.iter().chain(&self.inside.cutouts).chain(self.inside.stripes.iter().map(|s| &s.1));
        graded.extend(inside.flat_map(|p| p.points.iter().map(|q| q.0)));
        graded.extend(self.inside.drills.iter().map(|d| d.at));
        let mut others: Vec<Vec2> = self.unfinished.marks.iter().map(|m| m.at).collect();
        others.extend(self.unfinished.strokes.iter().flat_map(|s| s.ends));
        let axes = [self.axes.grain, self.axes.fold, self.axes.reference];
        others.extend(axes.into_iter().flatten().chain(self.axes.alternates.iter().map(|a| a.1)).flatten());
        [graded, others]
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
            "material" => self.texts.keys.get(key).map(|m| ("Material", m.as_str())),
            "category" => self.texts.keys.get(key).map(|c| ("Category", c.as_str())),
            _ => None,
        };
        let had = had.filter(|(_, had)| !had.is_empty());
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
                Diagnostic::warning(codes::QUANTITY_UNCLEAR, text).hint(QUANTITY_HINT)
            };
            desk.say(finding, &self.block, "1", self.line);
        }
    }

    /// Takes a text under a key of another program, unless the standard's key says the same thing.
    fn take_foreign(&mut self, key: &str, value: &str) -> bool {
        match texts::foreign_key(key) {
            Some("piece name") => self.name.as_deref() == Some(value),
            Some("quantity") => match texts::quantity(value) {
                Some(told) if !self.texts.quantity_told || told == self.texts.quantity => {
                    (self.texts.quantity, self.texts.quantity_told) = (told, true);
                    true
                }
                _ => false,
            },
            Some(own) if !self.texts.keys.contains_key(own) && !value.is_empty() => {
                self.texts.keys.insert(own.to_owned(), value.to_owned());
                true
            }
            _ => false,
        }
    }

    /// Is this the text that names the piece or its size?
    fn is_named_by(&self, key: &str, value: &str) -> bool {
        let taken = if key == "piece name" { &self.name } else { &self.size };
        value.is_empty() || taken.as_deref() == Some(value)
    }

    fn take_key(&mut self, key: &str, value: String, text: &str, at: Vec2, layer: String) {
        match key {
            "piece name" | "size" | "size name" | "sample size" if self.is_named_by(key, &value) => {}
            "quantity" => {
                (self.texts.quantity, self.texts.quantity_told) = (texts::quantity(&value).unwrap_or_default(), true);
            }
            _ if self.take_foreign(key, &value) => {
                self.texts.foreign.insert(key.to_owned());
            }
            "category" | "annotation" | "material" | "fabric" => {
                let had = self.texts.keys.get(key).filter(|had| !had.is_empty());
                match had {
                    // The first one counts, the others stay texts.
                    Some(had) if *had != value && !value.is_empty() => {
                        self.texts.others.push((at, layer, text.to_owned()));
                    }
                    Some(_) => {}
                    None => drop(self.texts.keys.insert(key.to_owned(), value)),
                }
            }
            _ => self.texts.others.push((at, layer, text.to_owned())),
        }
    }
}
