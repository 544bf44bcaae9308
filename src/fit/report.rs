//! The result of a fitting for a person and for programs.

use super::levels::Level;
use super::{Fitted, Order};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Table of ease and list of changes, as text.
#[must_use]
pub fn text(fitted: &Fitted) -> String {
    let mut out = String::from("ease in mm      body        ease asked    ease reached\n");
    for l in &fitted.levels {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{:<12} {:>7.1} {:>15.1} {:>15.1}", word(l), 1e3 * l.body, 1e3 * l.asked, 1e3 * l.ease);
    }
    for hem in &fitted.hems {
        let _ = writeln!(out, "hem above the floor, {:<21} {}", hem.side, hem.words());
    }
    for piece in fitted.changes.chunk_by(|a, b| a.piece == b.piece) {
        let _ = writeln!(out, "{}", piece[0].piece);
        for change in piece {
            let _ = writeln!(out, "  {:<40} {}", change.what, change.words());
        }
    }
    out
}

/// Name of a height in words.
pub(super) fn word(level: &Level) -> String {
    level.name.replace('_', " ")
}

/// The result for programs; lengths in millimetres, angles in degrees.
#[must_use]
pub fn json(fitted: &Fitted, order: &Order) -> Value {
    let mm = |x: f64| (1e6 * x).round() / 1e3;
    let level = |l: &Level| {
        json!({ "name": l.name, "own_body_mm": mm(l.own_body), "own_ease_mm": mm(l.own_ease), "body_mm": mm(l.body),
                "asked_mm": mm(l.asked), "ease_mm": mm(l.ease),
                "followed": l.is_followed })
    };
    let change = |c: &super::changes::Change| {
        let mut value = json!({ "piece": c.piece, "what": c.what, "mm": c.length.map(mm) });
        if let Some(angle) = c.angle {
            value["degrees"] = json!(angle.map(|a| (1e3 * a.to_degrees()).round() / 1e3));
        }
        value
    };
    let round = |r: &super::Round| -> Value { r.iter().map(|(name, ease)| (name.clone(), json!(mm(*ease)))).collect() };
    json!({
        "kind": "toile-fit",
        "toile": env!("CARGO_PKG_VERSION"),
        "body": order.body.file_name(),
        "passed": fitted.passed,
        "within_mm": mm(order.within),
        "ease": fitted.levels.iter().map(level).collect::<Vec<_>>(),
        "rounds": fitted.rounds.iter().map(round).collect::<Vec<_>>(),
        "changes": fitted.changes.iter().map(change).collect::<Vec<_>>(),
        "hem": fitted.hems.iter().map(|h| json!({ "side": h.side, "mm": h.height.map(mm) })).collect::<Vec<_>>(),
        "findings": fitted.findings,
    })
}
