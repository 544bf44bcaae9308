//! `[[elastic]]`, `[[fold]]` and `[[interlining]]`: bands along edges, folds pressed into pieces, and stiffer pieces.

use super::codes;
use super::walk::{Table, Value, Walk};
use super::{keys, run};
use std::f64::consts::PI;
use std::ops::Range;
use toile_garment::sewing::{BAND_STRETCH, BandLength, ElasticSpec, FoldSpec, InterliningSpec};
use toile_garment::units::{Angle, ArealMass, Bending, Force, Length, Share};
use toml::de::DeTable;

/// One elastic band; `n` numbers those without a name.
pub fn elastic(table: &DeTable<'_>, span: Range<usize>, n: usize, walk: &mut Walk<'_>) -> Option<ElasticSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::ELASTIC);
    let name = match t.take("name") {
        Some(value) => walk.text(value, "name"),
        None => Some(format!("elastic-{}", n + 1)),
    };
    let along = t.need("along", walk).and_then(|v| run::side(v, "along", walk));
    let length = t.need("length", walk).and_then(|v| band_length(v, walk));
    let stretch = match t.take("stretch") {
        Some(value) => stretch(value, walk),
        None => Some(BAND_STRETCH),
    };
    t.finish(walk);
    let source = Some(walk.source(at, Some("elastic")));
    Some(ElasticSpec { name: name?, along: along?, length: length?, stretch: stretch?, source })
}

/// A length, or a share of the cloth.
fn band_length(value: Value<'_>, walk: &mut Walk<'_>) -> Option<BandLength> {
    let text = walk.text(value, "length")?;
    let length = match text.parse::<Share>() {
        Ok(share) => BandLength::Share(share.0),
        Err(_) => BandLength::Length(walk.quantity::<Length>(value, "length")?),
    };
    let (BandLength::Length(size) | BandLength::Share(size)) = length;
    if size > 0.0 {
        return Some(length);
    }
    walk.error(codes::SEWING_BAND, value.span().start, format!("`length` cannot be {text}"), |d| {
        d.hint("write the length of the unstretched band, e.g. \"640 mm\", or its share of the cloth, e.g. \"60 %\"")
    });
    None
}

fn stretch(value: Value<'_>, walk: &mut Walk<'_>) -> Option<f64> {
    let force = walk.quantity::<Force>(value, "stretch")?;
    if force > 0.0 {
        return Some(force);
    }
    walk.error(codes::SEWING_BAND, value.span().start, format!("`stretch` cannot be {force} N"), |d| {
        d.hint("write the tension of the band at twice its length, e.g. \"30 N\"")
    });
    None
}

/// One pressed fold; `n` numbers those without a name.
pub fn fold(table: &DeTable<'_>, span: Range<usize>, n: usize, walk: &mut Walk<'_>) -> Option<FoldSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::FOLD);
    let piece = t.need("piece", walk).and_then(|v| walk.text(v, "piece"));
    let name = match t.take("name") {
        Some(value) => walk.text(value, "name"),
        None => Some(format!("fold-{}", n + 1)),
    };
    let line = t.need("line", walk).and_then(|v| walk.points(v, "line"));
    let angle = t.need("angle", walk).and_then(|v| angle(v, walk));
    t.finish(walk);
    let source = Some(walk.source(at, Some("fold")));
    Some(FoldSpec { piece: piece?, name: name?, line: line?, angle: angle?, source })
}

fn angle(value: Value<'_>, walk: &mut Walk<'_>) -> Option<f64> {
    let angle = walk.quantity::<Angle>(value, "angle")?;
    // 180° is a little more than π when it is read.
    if angle != 0.0 && angle.abs() <= PI * (1.0 + 1e-12) {
        return Some(angle.clamp(-PI, PI));
    }
    walk.error(
        codes::SEWING_FOLD_ANGLE,
        value.span().start,
        "`angle` must lie between -180° and 180°, and not be 0",
        |d| d.hint("write angle = \"180 deg\" where the right side is outside, and \"-180 deg\" where it is inside"),
    );
    None
}

/// Interlining on pieces.
pub fn interlining(table: &DeTable<'_>, span: Range<usize>, walk: &mut Walk<'_>) -> Option<InterliningSpec> {
    let at = span.start;
    let mut t = Table::new(table, span, &keys::INTERLINING);
    let pieces = t.need("pieces", walk).and_then(|v| walk.names(v, "pieces"));
    let areal_mass = t.need("areal_mass", walk).and_then(|v| walk.quantity::<ArealMass>(v, "areal_mass"));
    let bending = t.need("bending", walk).and_then(|v| walk.quantity::<Bending>(v, "bending"));
    t.finish(walk);
    let (areal_mass, bending) = (areal_mass?, bending?);
    if !(areal_mass > 0.0 && bending >= 0.0) {
        walk.error(
            codes::SEWING_INTERLINING,
            at,
            "an interlining has a mass, and a bending rigidity of 0 or more",
            |d| d.hint("e.g. areal_mass = \"60 g/m2\" and bending = \"40 uN.m\""),
        );
        return None;
    }
    Some(InterliningSpec { pieces: pieces?, areal_mass, bending, source: Some(walk.source(at, Some("interlining"))) })
}
