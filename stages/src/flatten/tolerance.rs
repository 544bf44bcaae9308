//! The verdict on flattened pieces against asked tolerances.

use super::codes;
use super::params::FlattenTolerance;
use toile_garment::flat::{Check, CheckKind, Flat, FlatPiece, PieceVerdict};
use toile_garment::{Diagnostic, Garment, Report};

/// The remedy for a change that is too large.
const REMEDY: &str = "lock it, take the 3D edit back there, or allow more";

/// One change against its limit; both in the unit of the text.
struct Change {
    what: String,
    value: f64,
    limit: f64,
    unit: &'static str,
}

/// Reports every change of a piece or seam that is larger than its tolerance, and says how many there are.
pub fn judge(garment: &Garment, flat: &Flat, tolerance: &FlattenTolerance, report: &mut Report) -> usize {
    let mut over = 0;
    for piece in &flat.pieces {
        let name = garment.pieces.get(piece.piece.index()).map_or("?", |p| p.name.as_str());
        over += tell(&format!("piece `{name}`"), changes(piece, tolerance), report);
    }
    over += flat.verdicts.iter().map(|v| of_verdict(garment, v, tolerance, report)).sum::<usize>();
    let Some(limit) = tolerance.ease else { return over };
    for pair in &flat.pairs {
        let value = 1e3 * ((pair.a[1] - pair.b[1]) - (pair.a[0] - pair.b[0]));
        let change = Change { what: "ease".to_owned(), value, limit: 1e3 * limit.0, unit: "mm" };
        over += tell(&format!("seam `{}`", pair.name), vec![change], report);
    }
    over
}

/// The facts that the verdict alone knows, as far as it was asked for.
fn of_verdict(garment: &Garment, verdict: &PieceVerdict, t: &FlattenTolerance, report: &mut Report) -> usize {
    let name = garment.pieces.get(verdict.piece.index()).map_or("?", |p| p.name.as_str());
    let is_asked = |kind: CheckKind| match kind {
        CheckKind::Seam => t.seam.is_some(),
        CheckKind::Notch => t.notch.is_some(),
        CheckKind::NotchPartner => t.notch_partner.is_some(),
        CheckKind::Corner => t.corner.is_some(),
        CheckKind::Bow => t.bow.is_some(),
        CheckKind::Symmetry => t.symmetry.is_some(),
        _ => false,
    };
    let over: Vec<&Check> = verdict.checks.iter().filter(|c| is_asked(c.kind) && !c.passes()).collect();
    for check in &over {
        let what = format!("piece `{name}`: {}", check.words());
        report.push(Diagnostic::warning(codes::FLATTEN_OUT_OF_TOLERANCE, what).hint(REMEDY));
    }
    over.len()
}

fn changes(piece: &FlatPiece, tolerance: &FlattenTolerance) -> Vec<Change> {
    let mut out = Vec::new();
    let mut add = |what: String, value: f64, limit: Option<f64>, unit| {
        out.extend(limit.map(|limit| Change { what, value, limit, unit }));
    };
    let [original, new, _] = piece.area;
    let area = if original > 0.0 { 100.0 * (new / original - 1.0) } else { 0.0 };
    add("area".to_owned(), area, tolerance.area.map(|s| 100.0 * s.0), "%");
    for edge in &piece.edges {
        let change = 1e3 * (edge.flat - edge.original);
        add(format!("edge `{}`", edge.name), change, tolerance.edge.map(|l| 1e3 * l.0), "mm");
    }
    for dart in &piece.darts {
        let name = |what: &str| format!("{what} of dart `{}`", dart.name);
        let turn = (dart.angle[1] - dart.angle[0]).to_degrees();
        add(name("angle"), turn, tolerance.dart_angle.map(|a| a.0.to_degrees()), "degrees");
        add(name("intake"), 1e3 * (dart.width[1] - dart.width[0]), tolerance.dart_intake.map(|l| 1e3 * l.0), "mm");
        add(name("legs"), 1e3 * (dart.legs[2] - dart.legs[3]), tolerance.dart_legs.map(|l| 1e3 * l.0), "mm");
    }
    add("grain".to_owned(), piece.grain_shift.to_degrees(), tolerance.grain.map(|a| a.0.to_degrees()), "degrees");
    out
}

fn tell(place: &str, changes: Vec<Change>, report: &mut Report) -> usize {
    let over: Vec<Change> = changes.into_iter().filter(|c| c.value.abs() > c.limit).collect();
    for c in &over {
        let what = format!("{place}: {} changed by {:+.2} {u}, over {:.2} {u}", c.what, c.value, c.limit, u = c.unit);
        report.push(Diagnostic::warning(codes::FLATTEN_OUT_OF_TOLERANCE, what).hint(REMEDY));
    }
    over.len()
}
