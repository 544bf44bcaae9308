//! Two results side by side: inputs, parameters, pieces, seams, measures, strain, shape and findings.

mod change;
pub(crate) mod codes;
mod documents;
mod lines;
mod page;
mod patterns;
mod shape;
mod side;
mod tolerance;

pub(crate) use change::exceeds;
pub use change::{Change, Group};
pub use lines::{JobDiff, LineSide, diff_lines, is_line, lines_json, lines_text, open_line};
pub use page::{html, lines_html};
pub use shape::{Motion, align};
pub(crate) use side::glb_of;
pub use side::{Side, open};
pub use tolerance::{Tolerance, read_tolerance};

use serde_json::{Value, json};
use std::fmt::Write as _;

/// Everything that differs, in a fixed order.
#[must_use]
pub fn diff(a: &Side, b: &Side) -> Vec<Change> {
    let mut changes = documents::changes(a, b);
    if let (Some(a), Some(b)) = (&a.garment, &b.garment) {
        changes.extend(patterns::changes(a, b));
        changes.extend(shape::changes(a, b));
    }
    changes.sort_by_key(|c| c.group);
    changes
}

/// The differences for people.
#[must_use]
pub fn text(a: &Side, b: &Side, changes: &[Change], tolerance: &Tolerance) -> String {
    let mut out = format!("{} against {}\n", b.name, a.name);
    if changes.is_empty() {
        out.push_str("nothing differs\n");
    }
    let mut group = None;
    for change in changes {
        if group != Some(change.group) {
            // Writing to a String cannot fail.
            let _ = writeln!(out, "{}", change.group.word());
            group = Some(change.group);
        }
        let over = if tolerance.is_stated() && tolerance.is_over(change) { "  over the tolerance" } else { "" };
        let _ = writeln!(out, "  {}: {}{over}", change.what, change.words());
    }
    out
}

/// The differences for programs.
#[must_use]
pub fn to_json(a: &Side, b: &Side, changes: &[Change], tolerance: &Tolerance) -> Value {
    json!({
        "a": a.name,
        "b": b.name,
        "over": changes.iter().filter(|c| tolerance.is_over(c)).count(),
        "changes": changes.iter().map(|c| change_json(c, tolerance)).collect::<Vec<_>>(),
    })
}

fn change_json(c: &Change, tolerance: &Tolerance) -> Value {
    json!({
        "group": c.group.word(), "what": c.what, "before": c.before, "after": c.after,
        "by": c.by, "unit": c.unit, "over": tolerance.is_over(c),
    })
}
