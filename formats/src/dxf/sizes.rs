//! Choosing a size: drawn, or graded from the sample size.

use super::codes;
use super::grade::{self, GradeError};
use super::pattern::Pattern;
use super::piece::DrawnPiece;
use crate::codes::SIZE_NOT_FOUND;
use crate::rul::RuleTable;
use std::borrow::Cow;
use std::collections::BTreeMap;
use toile_garment::{Diagnostic, SourceRef};

/// The pieces of one size.
pub(crate) struct Chosen<'a> {
    pub size: Option<String>,
    pub pieces: Vec<Cow<'a, DrawnPiece>>,
    pub findings: Vec<Diagnostic>,
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

    pub(crate) fn choose(&self, size: Option<&str>, rul: Option<&RuleTable>) -> Result<Chosen<'_>, Vec<Diagnostic>> {
        let mut findings = Vec::new();
        let wanted = self.wanted(size, &mut findings);
        if let Some(wanted) = wanted.as_deref().filter(|w| !self.available_sizes(rul).iter().any(|s| same(s, w))) {
            let list = self.available_sizes(rul).join(", ");
            let known = if list.is_empty() { "the file names no size".into() } else { format!("there are: {list}") };
            return Err(vec![
                Diagnostic::error(SIZE_NOT_FOUND, format!("size `{wanted}` is not in this pattern; {known}"))
                    .at(self.place()),
            ]);
        }
        let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (i, piece) in self.pieces.iter().enumerate() {
            let key = piece.name.clone().unwrap_or_else(|| format!("\u{1}{}", piece.block));
            groups.entry(key).or_default().push(i);
        }
        let mut picked: Vec<(usize, Cow<'_, DrawnPiece>)> = Vec::new();
        let mut errors = Vec::new();
        for list in groups.values() {
            match self.pick(list, wanted.as_deref(), rul) {
                Ok(found) => picked.extend(found),
                Err(error) => errors.push(*error),
            }
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        picked.sort_by_key(|p| p.0);
        Ok(Chosen { size: wanted, pieces: picked.into_iter().map(|p| p.1).collect(), findings })
    }

    fn pick<'a>(
        &'a self,
        list: &[usize],
        wanted: Option<&str>,
        rul: Option<&RuleTable>,
    ) -> Result<Vec<(usize, Cow<'a, DrawnPiece>)>, Box<Diagnostic>> {
        let borrowed = |i: &usize| (*i, Cow::Borrowed(&self.pieces[*i]));
        let Some(wanted) = wanted else { return Ok(list.iter().map(borrowed).collect()) };
        let sized = |i: &&usize| self.pieces[**i].size.as_deref().is_some_and(|s| same(s, wanted));
        let drawn: Vec<_> = list.iter().filter(sized).map(borrowed).collect();
        if !drawn.is_empty() {
            return Ok(drawn);
        }
        let sizeless: Vec<_> = list.iter().filter(|i| self.pieces[**i].size.is_none()).map(borrowed).collect();
        let sample = rul.and_then(|r| r.sample.as_deref()).or(self.sample_size.as_deref());
        let is_sample = |i: &&usize| match (self.pieces[**i].size.as_deref(), sample) {
            (Some(s), Some(sample)) => same(s, sample),
            _ => list.len() == 1,
        };
        let base = list.iter().find(is_sample);
        if let (Some(rul), Some(base)) = (rul, base) {
            let piece = &self.pieces[*base];
            match grade::grade(piece, rul, wanted) {
                Ok(graded) => return Ok(vec![(*base, Cow::Owned(graded))]),
                Err(GradeError::NoRules) => return Ok(vec![borrowed(base)]),
                Err(GradeError::Rule(n)) => {
                    let text = format!("`{}` uses grade rule {n}, which the rule table does not have", piece.label());
                    return Err(Box::new(Diagnostic::error(codes::RULE_MISSING, text).at(self.place())));
                }
                Err(GradeError::Size) => {}
            }
        }
        if !sizeless.is_empty() {
            return Ok(sizeless);
        }
        let label = list.first().map_or("", |i| self.pieces[*i].label());
        let have: Vec<&str> = list.iter().filter_map(|i| self.pieces[*i].size.as_deref()).collect();
        let text = format!("piece `{label}` is not drawn in size `{wanted}`; it is in {}", have.join(", "));
        Err(Box::new(Diagnostic::error(SIZE_NOT_FOUND, text).at(self.place())))
    }
}
