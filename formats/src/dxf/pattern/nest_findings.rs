//! The findings of a size run, each told once for a piece.

use super::Pattern;
use std::collections::BTreeMap;
use toile_garment::Diagnostic;

/// Findings of one code on one piece: code and label of the piece.
type Kind<'a> = (&'a str, &'a str);

impl Pattern {
    /// The findings of the file. Those of one code are told of each piece in a single size. It is the one given (`None` is
    /// the sample size), or else the first that has any. The text says in how many other sizes there are more.
    #[must_use]
    pub fn findings_of_size(&self, size: Option<&str>) -> Vec<Diagnostic> {
        let wanted = size.or(self.sample_size.as_deref());
        let drawn: BTreeMap<&str, (&str, Option<&str>)> =
            self.pieces.iter().map(|p| (p.block.as_str(), (p.label(), p.size.as_deref()))).collect();
        let place = |f: &Diagnostic| drawn.get(f.source.as_ref()?.block.as_deref()?).copied();
        let mut sizes: BTreeMap<Kind<'_>, Vec<Option<&str>>> = BTreeMap::new();
        for finding in &self.findings {
            let Some((piece, size)) = place(finding) else { continue };
            let known = sizes.entry((&finding.code, piece)).or_default();
            match known.iter().position(|s| *s == size) {
                None if size == wanted => known.insert(0, size),
                None => known.push(size),
                Some(_) => {}
            }
        }
        let told = |finding: &Diagnostic| {
            let Some((piece, size)) = place(finding) else { return Some(finding.clone()) };
            let known = &sizes[&(finding.code.as_str(), piece)];
            (known[0] == size).then(|| with_more(finding, known.len() - 1))
        };
        self.findings.iter().filter_map(told).collect()
    }
}

/// A finding that stands for those of other sizes.
fn with_more(finding: &Diagnostic, sizes: usize) -> Diagnostic {
    let more = match sizes {
        0 => return finding.clone(),
        1 => "in another size".to_owned(),
        n => format!("in {n} other sizes"),
    };
    let mut told = finding.clone();
    told.message = format!("{} (and alike {more})", told.message);
    told
}
