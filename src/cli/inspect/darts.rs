//! The darts of a pattern as a table: what a sewing file and `alter` name, and where they are.

use serde_json::{Value, json};
use std::fmt::Write as _;
use toile_garment::dart::{Dart, DartKind};
use toile_garment::{Garment, Piece, Vec2};

/// The table and its values for programs; `None` where there are no darts.
pub(super) fn table(garment: &Garment) -> Option<(String, Value)> {
    let all: Vec<(&Piece, &Dart)> = garment.pieces.iter().flat_map(|p| p.darts.iter().map(move |d| (p, d))).collect();
    let name = |(p, d): &(&Piece, &Dart)| format!("{} {}", p.name, d.name);
    let width = all.iter().map(|d| name(d).chars().count()).max()?.max(4);
    let size = garment.size.as_deref().map_or_else(String::new, |s| format!(" of size {s}"));
    let mut text = format!("darts{size}\n");
    let _ = writeln!(text, "{:<width$} {:<12} {:>9} {:>9}  point, mm", "dart", "kind", "width mm", "leg mm");
    for dart in &all {
        let (_, d) = dart;
        let points: Vec<String> = d.apexes.iter().map(|p| format!("({:.1}, {:.1})", p.x * 1e3, p.y * 1e3)).collect();
        let [width_mm, leg] = [d.intake(), d.leg_length(0)].map(|l| l * 1e3);
        let kind = word(d.kind);
        let row = format!("{:<width$} {kind:<12} {width_mm:>9.1} {leg:>9.1}  {}", name(dart), points.join(" "));
        let _ = writeln!(text, "{}", row.trim_end());
    }
    Some((text, all.iter().map(|(p, d)| value(p, d)).collect()))
}

fn word(kind: DartKind) -> &'static str {
    match kind {
        DartKind::Wedge => "wedge",
        DartKind::MarkedWedge => "marked wedge",
        DartKind::FishEye => "fish-eye",
        DartKind::Pleat => "pleat",
    }
}

fn value(piece: &Piece, dart: &Dart) -> Value {
    let mm = |length: f64| (length * 1e6).round() / 1e3;
    let at = |p: &Vec2| [mm(p.x), mm(p.y)];
    json!({
        "piece": piece.name,
        "dart": dart.name,
        "kind": word(dart.kind),
        "width_mm": mm(dart.intake()),
        "legs_mm": [mm(dart.leg_length(0)), mm(dart.leg_length(1))],
        "points_mm": dart.apexes.iter().map(at).collect::<Vec<_>>(),
        "mouth_mm": dart.mouth.iter().map(at).collect::<Vec<_>>(),
    })
}
