//! The sewing file says what a DXF cannot say: seams, declared darts and pleats, places, layers and attachments. It
//! also names what a garment needs beside them: copies of drawn pieces, names of edges, and pieces that are left out.
//!
//! # Form
//!
//! A TOML file with lists of tables. Quantities are texts with a unit. Points are in the coordinates of the piece, and
//! are snapped to the nearest corner or vertex of the outline within 1 mm.
//!
//! ```toml
//! [[seam]]
//! name = "side-left"
//! a = "front.side-left"                  # an edge by name or number …
//!
//! b = { piece = "back", from = ["0 mm", "384 mm"], to = ["0 mm", "0 mm"] }   # … or a run between two points
//! ease = "4 mm"                          # or gather = 1.6; an undeclared difference over the limit is an error
//!
//! [[dart]]                               # only where the detection of darts must be overruled, or cannot see
//! piece = "front"
//! apex = ["154 mm", "330 mm"]
//!
//! mouth = [["140 mm", "443 mm"], ["168 mm", "443 mm"]]
//!
//! [[place]]                              # where a piece starts in 3D; one without it arranges itself
//! piece = "front"
//! around = "torso"
//! side = "front"
//! height = "914 mm"
//!
//! [[attach]]
//! piece = "waistband"
//! edge = "top"
//! to = "waist"
//! strength = "elastic 0.9"
//! ```
//!
//! # Sides of a seam
//!
//! A side is one run of outline edges, or a list of runs in order. `a.from` meets `b.from`, and `a.to` meets `b.to`. A
//! run between two points follows the outline on the shorter way, unless `way` says otherwise.

pub(crate) mod codes;
mod construction;
mod dart;
mod keys;
mod lines;
mod place;
mod run;
mod schema;
mod seam;
mod walk;
pub mod write;

use lines::Lines;
pub use run::{edge_place, place_text};
pub use schema::schema;
use serde_spanned::Spanned;
use toile_garment::Diagnostic;
use toile_garment::sewing::SewingPlan;
use toml::de::{DeTable, DeValue};
use walk::{Table, Walk};

/// Reads a sewing file. `file` is its name for messages.
///
/// # Errors
/// All mistakes at once, each with line and column.
pub fn read(text: &str, file: &str) -> Result<SewingPlan, Vec<Diagnostic>> {
    match read_sound_tables(text, file) {
        (Some(plan), errors) if errors.is_empty() => Ok(plan),
        (_, errors) => Err(errors),
    }
}

/// The tables of a sewing file that are sound, and all mistakes of the others. There is no plan where a table is wrong
/// by which others name their pieces and edges.
#[must_use]
pub fn read_sound_tables(text: &str, file: &str) -> (Option<SewingPlan>, Vec<Diagnostic>) {
    let lines = Lines::new(text, file);
    let (document, syntax) = DeTable::parse_recoverable(text);
    if !syntax.is_empty() {
        return (None, syntax.iter().map(|e| syntax_error(e, &lines)).collect());
    }
    let mut walk = Walk::new(&lines);
    let mut top = Table::new(document.get_ref(), 0..0, &keys::TOP);
    let mut plan = named(&mut top, &mut walk);
    let is_named = walk.errors.is_empty();
    sewn(&mut top, &mut plan, &mut walk);
    top.finish(&mut walk);
    // In the order of the file, whatever table was read first.
    walk.errors.sort_by_key(|e| e.source.as_ref().map(|s| (s.line, s.column)));
    (is_named.then_some(plan), walk.errors)
}

fn syntax_error(error: &toml::de::Error, lines: &Lines<'_>) -> Diagnostic {
    let at = error.span().map_or(0, |s| s.start);
    Diagnostic::error(codes::SEWING_FILE_SYNTAX, format!("this is not TOML: {}", error.message()))
        .at(lines.source(at, None))
        .hint("strings stand in quotes, tables are written [[seam]]")
}

/// The tables that change and name pieces and edges.
fn named(top: &mut Table<'_>, walk: &mut Walk<'_>) -> SewingPlan {
    let mut plan = SewingPlan::default();
    for (table, span) in tables(top, "dart", walk) {
        plan.darts.extend(dart::dart(table, span, walk));
    }
    for (table, span) in tables(top, "copy", walk) {
        plan.copies.extend(place::copy(table, span, walk));
    }
    for (table, span) in tables(top, "edge", walk) {
        plan.edge_names.extend(run::edge_name(table, span, walk));
    }
    for (n, (table, span)) in tables(top, "fold", walk).into_iter().enumerate() {
        plan.folds.extend(construction::fold(table, span, n, walk));
    }
    if let Some(value) = top.take("leave_out") {
        plan.leave_out = walk.texts(value, "leave_out").unwrap_or_default();
        plan.leave_out_source = Some(walk.source(value.span().start, Some("leave_out")));
    }
    plan
}

/// The tables that speak of pieces and edges by their names.
fn sewn(top: &mut Table<'_>, plan: &mut SewingPlan, walk: &mut Walk<'_>) {
    for (n, (table, span)) in tables(top, "seam", walk).into_iter().enumerate() {
        plan.seams.extend(seam::seam(table, span, n, walk));
    }
    for (table, span) in tables(top, "place", walk) {
        plan.places.extend(place::place(table, span, walk));
    }
    for (table, span) in tables(top, "layer", walk) {
        plan.layers.extend(place::layer(table, span, walk));
    }
    for (table, span) in tables(top, "attach", walk) {
        plan.attachments.extend(place::attach(table, span, walk));
    }
    for (n, (table, span)) in tables(top, "elastic", walk).into_iter().enumerate() {
        plan.elastics.extend(construction::elastic(table, span, n, walk));
    }
    for (table, span) in tables(top, "interlining", walk) {
        plan.interlinings.extend(construction::interlining(table, span, walk));
    }
    for (table, span) in tables(top, "whole", walk) {
        plan.wholes.extend(place::whole(table, span, walk));
    }
}

/// The tables of a `[[name]]` list.
fn tables<'v>(top: &mut Table<'v>, name: &str, walk: &mut Walk<'_>) -> Vec<(&'v DeTable<'v>, std::ops::Range<usize>)> {
    let Some(value) = top.take(name) else { return Vec::new() };
    let wrong = |walk: &mut Walk<'_>, value: &Spanned<DeValue<'_>>| {
        walk.error(codes::SEWING_WRONG_TYPE, value.span().start, format!("`{name}` must be a list of tables"), |d| {
            d.hint(format!("write [[{name}]]"))
        });
    };
    let DeValue::Array(items) = value.get_ref() else {
        wrong(walk, value);
        return Vec::new();
    };
    let mut out = Vec::new();
    for item in items.iter() {
        match item.get_ref() {
            DeValue::Table(table) => out.push((table, item.span())),
            _ => wrong(walk, item),
        }
    }
    out
}

#[cfg(test)]
mod tests;
