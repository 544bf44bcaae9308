//! `[[seam]]`.

use super::codes;
use super::walk::{Table, Walk};
use super::{keys, run};
use std::ops::Range;
use toile_garment::sewing::SeamSpec;
use toile_garment::units::Length;
use toml::de::DeTable;

/// One seam; `n` numbers those without a name.
pub fn seam(table: &DeTable<'_>, span: Range<usize>, n: usize, walk: &mut Walk<'_>) -> Option<SeamSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::SEAM);
    let name = match t.take("name") {
        Some(value) => walk.text(value, "name"),
        None => Some(format!("seam-{}", n + 1)),
    };
    let a = t.need("a", walk).and_then(|v| run::side(v, "a", walk));
    let b = t.need("b", walk).and_then(|v| run::side(v, "b", walk));
    let ease = t.take("ease").map(|v| walk.quantity::<Length>(v, "ease"));
    let gather = t.take("gather").map(|v| gather(v, walk));
    let proposed = t.take("proposed").map(|v| share(v, walk));
    let reverse = t.take("reverse").map(|v| walk.flag(v, "reverse"));
    if ease.is_some() && gather.is_some() {
        walk.error(codes::SEWING_EASE_AND_GATHER, at, "a seam has `ease` or `gather`, not both", |d| {
            d.hint("ease is the difference in length, gather the ratio of longer over shorter")
        });
    }
    t.finish(walk);
    let source = Some(walk.source(at, Some("seam")));
    Some(SeamSpec {
        name: name?,
        a: a?,
        b: b?,
        reverse: all_or_none(reverse)?,
        ease: all_or_none(ease)?,
        gather: all_or_none(gather)?,
        proposed: all_or_none(proposed)?,
        source,
    })
}

fn gather(value: super::walk::Value<'_>, walk: &mut Walk<'_>) -> Option<f64> {
    let ratio = walk.number(value, "gather")?;
    if (1.0..=100.0).contains(&ratio) {
        return Some(ratio);
    }
    walk.error(codes::SEWING_BAD_GATHER, value.span().start, format!("`gather` cannot be {ratio}"), |d| {
        d.hint("gather is the longer side over the shorter, from 1 to 100, e.g. 1.6")
    });
    None
}

/// How sure a proposal is, 0 to 1.
fn share(value: super::walk::Value<'_>, walk: &mut Walk<'_>) -> Option<f64> {
    let share = walk.number(value, "proposed")?;
    if (0.0..=1.0).contains(&share) {
        return Some(share);
    }
    walk.error(codes::SEWING_BAD_CONFIDENCE, value.span().start, format!("`proposed` cannot be {share}"), |d| {
        d.hint("it is a confidence from 0 to 1; remove it from what is right")
    });
    None
}

/// Absent is fine, present but wrong is not.
fn all_or_none<T>(value: Option<Option<T>>) -> Option<Option<T>> {
    match value {
        None => Some(None),
        Some(inner) => inner.map(Some),
    }
}
