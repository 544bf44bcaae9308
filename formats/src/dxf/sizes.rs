//! Choosing a size: drawn, or graded from the sample size.

use super::codes;
use super::grade::{self, GradeError};
use super::pattern::Pattern;
use super::piece::{DrawnPiece, RefusedPiece};
use super::texts;
use super::write::PRODUCT;
use crate::codes::SIZE_NOT_FOUND;
use crate::rul::RuleTable;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::{Diagnostic, SourceRef};

/// The pieces of one size.
pub(crate) struct Chosen<'a> {
    pub size: Option<String>,
    pub pieces: Vec<Cow<'a, DrawnPiece>>,
    pub findings: Vec<Diagnostic>,
}

/// All sizes of one piece: places in the lists of sound and of refused pieces.
#[derive(Default)]
struct Group {
    sound: Vec<usize>,
    refused: Vec<usize>,
}

/// A piece is known by its name, one without a name by its block.
fn key(name: &Option<String>, block: &str) -> String {
    name.clone().unwrap_or_else(|| format!("\u{1}{block}"))
}

fn same(a: &str, b: &str) -> bool {
    a.trim().eq_ignore_ascii_case(b.trim())
}

impl Pattern {
    fn place(&self) -> SourceRef {
        SourceRef::file(self.file.clone())
    }

    /// Sizes drawn, and sizes of the rule table that are not.
    #[must_use]
    pub fn available_sizes(&self, rul: Option<&RuleTable>) -> Vec<String> {
        let mut list = self.sizes.clone();
        let graded = rul.map_or(&[] as &[String], |r| &r.sizes);
        list.extend(graded.iter().filter(|s| !self.sizes.iter().any(|d| same(d, s))).cloned());
        list
    }

    /// The whole run in order: that of the rule table, else as drawn.
    #[must_use]
    pub fn size_order(&self, rul: Option<&RuleTable>) -> Vec<String> {
        let all = self.available_sizes(rul);
        let Some(table) = rul else { return all };
        let mut list: Vec<String> =
            table.sizes.iter().filter_map(|t| all.iter().find(|s| same(s, t)).cloned()).collect();
        list.extend(all.into_iter().filter(|s| !table.sizes.iter().any(|t| same(s, t))));
        list
    }

    fn wanted(&self, size: Option<&str>, findings: &mut Vec<Diagnostic>) -> Option<String> {
        if let Some(size) = size {
            return Some(size.trim().to_owned());
        }
        let drawn = |s: &str| self.sizes.iter().find(|d| same(d, s)).cloned();
        if let Some(sample) = self.sample_size.as_deref().and_then(drawn) {
            return Some(sample);
        }
        if self.sizes.len() <= 1 {
            return self.sizes.first().cloned();
        }
        let marked = self.pieces.iter().find(|p| p.points.marked && p.size.is_some()).and_then(|p| p.size.clone());
        let choice = marked.or_else(|| self.sizes.get(self.sizes.len() / 2).cloned());
        if let Some(choice) = &choice {
            let text = format!(
                "no size was asked for and no sample size is drawn; {choice} was taken of {}",
                self.sizes.join(", ")
            );
            findings.push(Diagnostic::warning(codes::SIZE_CHOSEN, text).at(self.place()).hint("give size = \"…\""));
        }
        choice
    }

    /// Keeps only the pieces of these names, and what was found of them and of the file. A piece is called by its name
    /// or its block, upper and lower case alike. Where a name is wrong, all sound pieces stay to be looked at.
    ///
    /// # Errors
    /// One finding per name that no piece has.
    pub fn keep_pieces(&mut self, names: &[String]) -> Result<(), Vec<Diagnostic>> {
        let called = |label: &str, block: &str, name: &str| same(label, name) || same(block, name);
        let sound = self.pieces.iter().map(|p| (p.label(), p.block.as_str()));
        let all: Vec<(&str, &str)> = sound.chain(self.refused.iter().map(|p| (p.label(), p.block.as_str()))).collect();
        let missing: Vec<&String> =
            names.iter().filter(|n| !all.iter().any(|(label, block)| called(label, block, n))).collect();
        let wanted = |label: &str, block: &str| names.iter().any(|n| called(label, block, n));
        if !missing.is_empty() {
            let labels: BTreeSet<&str> = all.iter().map(|p| p.0).collect();
            let known = labels.into_iter().collect::<Vec<_>>().join(", ");
            let say = |name: &&String| {
                let text = format!("piece `{name}` is not in this pattern; there are: {known}");
                Diagnostic::error(codes::PIECE_NOT_FOUND, text).at(self.place())
            };
            let told = missing.iter().map(say).collect();
            self.refused.retain(|p| wanted(p.label(), &p.block));
            return Err(told);
        }
        let sound = self.pieces.iter().filter(|p| !wanted(p.label(), &p.block)).map(|p| p.block.clone());
        let others = self.refused.iter().filter(|p| !wanted(p.label(), &p.block)).map(|p| p.block.clone());
        let dropped: BTreeSet<String> = sound.chain(others).collect();
        self.pieces.retain(|p| wanted(p.label(), &p.block));
        self.refused.retain(|p| wanted(p.label(), &p.block));
        let of_dropped =
            |f: &Diagnostic| f.source.as_ref().and_then(|s| s.block.as_ref()).is_some_and(|b| dropped.contains(b));
        self.findings.retain(|f| !of_dropped(f));
        Ok(())
    }

    /// The pattern as if it held only what can be used.
    #[must_use]
    pub fn of_sound_pieces(&self) -> Self {
        Self { refused: Vec::new(), ..self.clone() }
    }

    pub(crate) fn choose(&self, size: Option<&str>, rul: Option<&RuleTable>) -> Result<Chosen<'_>, Vec<Diagnostic>> {
        let mut findings = Vec::new();
        let wanted = self.wanted(size, &mut findings);
        if let Some(wanted) = wanted.as_deref().filter(|w| !self.available_sizes(rul).iter().any(|s| same(s, w))) {
            return Err(vec![self.size_not_found(wanted, rul)]);
        }
        let mut groups: BTreeMap<String, Group> = BTreeMap::new();
        for (i, piece) in self.pieces.iter().enumerate() {
            groups.entry(key(&piece.name, &piece.block)).or_default().sound.push(i);
        }
        for (i, piece) in self.refused.iter().enumerate() {
            groups.entry(key(&piece.name, &piece.block)).or_default().refused.push(i);
        }
        let mut picked: Vec<(usize, Cow<'_, DrawnPiece>)> = Vec::new();
        let (mut errors, mut lacking) = (Vec::new(), Vec::new());
        for group in groups.values() {
            match self.pick(group, wanted.as_deref(), rul) {
                Ok(found) if found.is_empty() => lacking.push(group),
                Ok(found) => picked.extend(found),
                Err(list) => errors.extend(list),
            }
        }
        if !errors.is_empty() {
            errors.extend(self.instead(wanted.as_deref()));
            return Err(errors);
        }
        if let (true, Some(wanted)) = (picked.is_empty(), &wanted) {
            return Err(vec![self.none_in_size(&lacking, wanted)]);
        }
        findings.extend(lacking.iter().map(|group| self.left_out(group, wanted.as_deref().unwrap_or_default())));
        findings.extend(self.style_texts_not_kept());
        picked.sort_by_key(|p| p.0);
        Ok(Chosen { size: wanted, pieces: picked.into_iter().map(|p| p.1).collect(), findings })
    }

    /// Says which texts of the style a garment does not hold. Texts that every writer makes anew are none of them.
    fn style_texts_not_kept(&self) -> Option<Diagnostic> {
        let is_ours = |text: &str| text.split([';', ' ']).any(|word| word.trim() == PRODUCT);
        let lost = self.style_texts.iter().filter(|(key, value)| {
            let is_written_again = texts::is_made_anew(key) || texts::is_of_writer(key) && is_ours(value);
            !(value.is_empty() || is_written_again)
        });
        let list: Vec<String> = lost.map(|(key, _)| format!("`{key}`")).collect();
        let text = format!("the garment does not keep these texts of the style: {}", list.join(", "));
        let hint = "`author` and `date` of export-dxf write such texts";
        (!list.is_empty()).then(|| Diagnostic::info(codes::STYLE_TEXT_NOT_KEPT, text).at(self.place()).hint(hint))
    }

    fn size_not_found(&self, wanted: &str, rul: Option<&RuleTable>) -> Diagnostic {
        let list = self.available_sizes(rul).join(", ");
        let known = if list.is_empty() { "the file names no size".into() } else { format!("there are: {list}") };
        let text = format!("size `{wanted}` is not in this pattern; {known}");
        Diagnostic::error(SIZE_NOT_FOUND, text).at(self.place())
    }

    /// The label of a piece and the sizes it is drawn in.
    fn drawn_in(&self, group: &Group) -> (&str, Vec<&str>) {
        let sound = group.sound.iter().map(|i| (self.pieces[*i].label(), &self.pieces[*i].size));
        let all: Vec<_> =
            sound.chain(group.refused.iter().map(|i| (self.refused[*i].label(), &self.refused[*i].size))).collect();
        (all.first().map_or("", |p| p.0), all.iter().filter_map(|p| p.1.as_deref()).collect())
    }

    /// None of the pieces that were asked for has a size that the file has.
    fn none_in_size(&self, groups: &[&Group], wanted: &str) -> Diagnostic {
        let one = |group: &&Group| {
            let (label, have) = self.drawn_in(group);
            format!("`{label}` is in {}", have.join(", "))
        };
        let list: Vec<String> = groups.iter().map(one).collect();
        let text =
            format!("no piece is drawn in size `{wanted}`, and no grade rules make one in it; {}", list.join("; "));
        let hint = "ask for a size that the pieces have, or draw them in this size too";
        Diagnostic::error(SIZE_NOT_FOUND, text).at(self.place()).hint(hint)
    }

    /// Says that a piece is not drawn in the size that was asked for.
    fn left_out(&self, group: &Group, wanted: &str) -> Diagnostic {
        let (label, have) = self.drawn_in(group);
        let text = format!(
            "piece `{label}` is not drawn in size `{wanted}`, and no grade rules make it; the garment is without it; it is in {}",
            have.join(", ")
        );
        Diagnostic::warning(codes::PIECE_NOT_IN_SIZE, text).at(self.place()).hint("draw the piece in this size too")
    }

    /// Says which pieces and sizes can be asked for instead of those that cannot be used.
    fn instead(&self, wanted: Option<&str>) -> Option<Diagnostic> {
        let fits = |size: &Option<String>| wanted.zip(size.as_deref()).is_none_or(|(w, s)| same(w, s));
        let spoilt: BTreeSet<&str> = self.refused.iter().filter(|r| fits(&r.size)).map(RefusedPiece::label).collect();
        let sound: BTreeSet<&str> = self
            .pieces
            .iter()
            .filter(|p| fits(&p.size))
            .map(DrawnPiece::label)
            .filter(|l| !spoilt.contains(l))
            .collect();
        let bad = |size: &String| self.refused.iter().any(|r| r.size.as_deref().is_some_and(|s| same(s, size)));
        let sizes: Vec<&str> = self.sizes.iter().filter(|s| !bad(s)).map(String::as_str).collect();
        let mut ways = Vec::new();
        if !sound.is_empty() && !spoilt.is_empty() {
            let list: Vec<String> = sound.iter().map(|l| format!("\"{l}\"")).collect();
            ways.push(format!("the other pieces, with pieces = [{}]", list.join(", ")));
        }
        if !sizes.is_empty() && !self.refused.is_empty() && sizes.len() < self.sizes.len() {
            ways.push(format!("another size ({})", sizes.join(", ")));
        }
        let text = format!("what can be used of this file: {}", ways.join(", or "));
        (!ways.is_empty()).then(|| Diagnostic::info(codes::SOUND_PARTS, text).at(self.place()))
    }

    /// The pieces of a group in the size wanted; none where the group has none in this size.
    fn pick<'a>(
        &'a self,
        group: &Group,
        wanted: Option<&str>,
        rul: Option<&RuleTable>,
    ) -> Result<Vec<(usize, Cow<'a, DrawnPiece>)>, Vec<Diagnostic>> {
        let list = &group.sound;
        let faults = |of: &dyn Fn(&RefusedPiece) -> bool| {
            let asked = group.refused.iter().map(|i| &self.refused[*i]).filter(|r| of(r));
            let list: Vec<Diagnostic> = asked.flat_map(|r| r.faults.clone()).collect();
            if list.is_empty() { Ok(()) } else { Err(list) }
        };
        let borrowed = |i: &usize| (*i, Cow::Borrowed(&self.pieces[*i]));
        let Some(wanted) = wanted else {
            faults(&|_| true)?;
            return Ok(list.iter().map(borrowed).collect());
        };
        faults(&|r| r.size.as_deref().is_none_or(|s| same(s, wanted)))?;
        let sized = |i: &&usize| self.pieces[**i].size.as_deref().is_some_and(|s| same(s, wanted));
        let drawn: Vec<_> = list.iter().filter(sized).map(borrowed).collect();
        if !drawn.is_empty() {
            return Ok(drawn);
        }
        let sizeless: Vec<_> = list.iter().filter(|i| self.pieces[**i].size.is_none()).map(borrowed).collect();
        let sample = rul.and_then(|r| r.sample.as_deref()).or(self.sample_size.as_deref());
        let is_sample = |size: Option<&str>| match (size, sample) {
            (Some(s), Some(sample)) => same(s, sample),
            _ => list.len() + group.refused.len() == 1,
        };
        if let Some(rul) = rul {
            if rul.size_index(wanted).is_some() {
                faults(&|r| is_sample(r.size.as_deref()))?;
            }
            let is_in_sizes = list.iter().any(|i| !is_sample(self.pieces[*i].size.as_deref()));
            if let Some(base) = list.iter().find(|i| is_sample(self.pieces[**i].size.as_deref())) {
                let piece = &self.pieces[*base];
                match grade::grade(piece, rul, wanted) {
                    Ok(graded) => return Ok(vec![(*base, Cow::Owned(graded))]),
                    // Drawn in one size alone, it is the same in all. Drawn in others, it would have been drawn in this.
                    Err(GradeError::NoRules) if !is_in_sizes => return Ok(vec![borrowed(base)]),
                    Err(GradeError::Rule(n)) => {
                        let text =
                            format!("`{}` uses grade rule {n}, which the rule table does not have", piece.label());
                        return Err(vec![Diagnostic::error(codes::RULE_MISSING, text).at(self.place())]);
                    }
                    Err(GradeError::NoRules | GradeError::Size) => {}
                }
            }
        }
        Ok(sizeless)
    }
}
