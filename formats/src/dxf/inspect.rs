//! The contents of a file, as JSON and as a table for people.

use super::darts::{DrawnDart, Form, Pleat};
use super::garment::{refused_piece, to_piece};
use super::ledger::Verdict;
use super::notches::DrawnNotch;
use super::pattern::{Pattern, ReadOptions, read_all};
use super::piece::{DrawnPiece, RefusedPiece, in_file_order};
use super::{geom, grade};
use crate::rul::{self, RuleTable};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use toile_garment::outline::OutlineEdge;
use toile_garment::{Diagnostic, Piece, Vec2};

/// The contents of a file.
#[derive(Clone, Debug)]
pub struct Inspection {
    /// The pattern as read.
    pub pattern: Pattern,
    /// One garment piece per drawn piece and size, unfolded: its edges are the ones the sewing file counts.
    pub pieces: Vec<Piece>,
    /// The lines of pieces that cannot be used, to be drawn.
    pub refused: Vec<Piece>,
    /// Facts of the file by the keys of `toile inspect --json`.
    pub json: Value,
    /// The same as a table.
    pub text: String,
}

/// Looks into a DXF, with its rule table if there is one.
///
/// # Errors
/// All findings, at least one of them an error.
pub fn inspect(bytes: &[u8], file: &str, rul: Option<&[u8]>) -> Result<Inspection, Vec<Diagnostic>> {
    inspect_with(bytes, file, rul, &ReadOptions::default())
}

/// Inspects a file as [`inspect`] does, with the user's own layers and unit.
///
/// # Errors
/// All findings, at least one of them an error.
pub fn inspect_with(
    bytes: &[u8],
    file: &str,
    rul: Option<&[u8]>,
    options: &ReadOptions,
) -> Result<Inspection, Vec<Diagnostic>> {
    let rule_units = rul.and_then(|r| rul::read(r, file).ok()).and_then(|t| t.units);
    let options = ReadOptions { rule_units: options.rule_units.clone().or(rule_units), ..options.clone() };
    let mut pattern = read_all(bytes, file, &options)?;
    let table = rul.and_then(|r| companion(&mut pattern, r, &rul_name(file)));
    let pieces: Vec<Piece> = pattern.pieces.par_iter().map(|p| to_piece(p, file)).collect();
    let json = facts(&pattern, &pieces, table.as_ref());
    let text = text(&pattern, table.as_ref());
    let refused = pattern.refused.iter().filter_map(refused_piece).collect();
    Ok(Inspection { pattern, pieces, refused, json, text })
}

/// The rule table beside a pattern. A broken one does not keep the pieces from being looked at: its mistakes become
/// warnings.
fn companion(pattern: &mut Pattern, bytes: &[u8], file: &str) -> Option<RuleTable> {
    match rul::read(bytes, file) {
        Ok(table) => {
            pattern.findings.extend(table.findings.iter().cloned());
            let doubts = pattern.check_rules(&table);
            pattern.findings.extend(doubts);
            Some(table)
        }
        Err(list) => {
            pattern.findings.extend(rul::broken(list, file));
            None
        }
    }
}

/// Name of the rule table that belongs to a DXF: the same with `.rul`.
#[must_use]
fn rul_name(file: &str) -> String {
    match file.rsplit_once('.') {
        Some((stem, _)) => format!("{stem}.rul"),
        None => format!("{file}.rul"),
    }
}

fn round(v: f64) -> f64 {
    let r = (v * 1e4).round() / 1e4;
    if r == 0.0 { 0.0 } else { r }
}

fn xy(p: Vec2) -> Value {
    json!([round(p.x), round(p.y)])
}

fn facts(pattern: &Pattern, pieces: &[Piece], table: Option<&RuleTable>) -> Value {
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| {
        out.insert(key.to_owned(), value);
    };
    put("file", json!(pattern.file));
    put("profile", profile(pattern));
    put("units", json!(pattern.units.declared));
    put("mm_per_unit", json!(pattern.units.mm_per_unit));
    put("dxf_version", json!(pattern.release));
    put("encoding", json!(pattern.encoding));
    put("style_name", json!(pattern.style));
    put("style_texts", json!(pattern.style_texts));
    put("sizes", json!(drawn_order(pattern, table)));
    put("size_run", json!(pattern.size_order(table)));
    put("sample_size", json!(pattern.sample_size));
    put("block_count", json!(pattern.pieces.len() + pattern.refused.len()));
    put("ledger", ledger(pattern));
    put("findings", json!(pattern.all_findings()));
    let sound: Vec<Value> = pattern.pieces.par_iter().zip(pieces).map(|(d, p)| piece(d, p)).collect();
    put("pieces", Value::Array(of_all_pieces(pattern, sound, refused)));
    if let Some(table) = table {
        put("rul_sizes", json!(table.sizes));
        put("rul_sample_size", json!(table.sample));
        put("graded_turn_points_mm", graded(pattern, table));
    }
    Value::Object(out)
}

/// The drawn sizes, in the order of the rule table where there is one.
fn drawn_order(pattern: &Pattern, table: Option<&RuleTable>) -> Vec<String> {
    let mut sizes = pattern.size_order(table);
    sizes.retain(|s| pattern.sizes.contains(s));
    sizes
}

fn profile(pattern: &Pattern) -> Value {
    let p = &pattern.profile;
    let others: Vec<Value> = p.others.iter().map(|(v, r)| json!({ "vendor": v.name(), "reasons": r })).collect();
    json!({
        "vendor": p.vendor.name(),
        "confidence": round(p.confidence),
        "reasons": p.reasons,
        "others": others,
        "standard": p.standard.0,
        "standard_reason": p.standard.1,
        "effects": p.effects,
    })
}

fn ledger(pattern: &Pattern) -> Value {
    let l = &pattern.ledger;
    let by_rule: Vec<Value> = l
        .by_rule()
        .into_iter()
        .map(|((verdict, rule), count)| {
            let verdict = match verdict {
                Verdict::Accepted => "accepted",
                Verdict::Interpreted => "interpreted",
                Verdict::Refused => "refused",
            };
            json!({ "verdict": verdict, "rule": rule, "count": count })
        })
        .collect();
    json!({
        "entities": l.entities(),
        "vertices": pattern.vertices,
        "accepted": l.count(Verdict::Accepted),
        "interpreted": l.count(Verdict::Interpreted),
        "refused": l.count(Verdict::Refused),
        "by_rule": by_rule,
        "library_census": { "sent": pattern.census.sent, "agreed": pattern.census.agreed },
    })
}

fn graded(pattern: &Pattern, table: &RuleTable) -> Value {
    let mut out = Map::new();
    for piece in pattern.pieces.iter().filter(|p| !p.texts.rules.is_empty()) {
        let mut sizes = Map::new();
        for size in &table.sizes {
            if let Ok(graded) = grade::grade(piece, table, size) {
                sizes.insert(size.clone(), graded.points.turn_list.iter().map(|p| xy(*p)).collect());
            }
        }
        out.insert(piece.label().to_owned(), Value::Object(sizes));
    }
    Value::Object(out)
}

fn piece(drawn: &DrawnPiece, piece: &Piece) -> Value {
    let line = drawn.boundary.positions();
    let area = geom::area(&line).abs() / 100.0;
    let half = drawn.axes.fold.is_some();
    let bounds =
        geom::bounds(line.iter().copied()).map(|(lo, hi)| json!([round(lo.x), round(lo.y), round(hi.x), round(hi.y)]));
    let net = drawn.sewn().positions();
    let mut out = json!({
        "block": drawn.block,
        "name": drawn.name,
        "size": drawn.size,
        "quantity": drawn.texts.quantity.plain,
        "quantity_pair": [drawn.texts.quantity.plain, drawn.texts.quantity.mirrored],
        "material": piece.material,
        "area_cm2": round(area),
        "area_unfolded_cm2": round(if half { 2.0 * area } else { area }),
        "perimeter_mm": round(geom::length(&line, true)),
        "bbox_mm": bounds,
        "boundary_vertices": drawn.boundary.drawn.iter().filter(|n| n.drawn).count(),
        "half_piece_on_fold": half,
        "net_area_cm2": round(geom::area(&net).abs() / 100.0),
        "net_perimeter_mm": round(geom::length(&net, true)),
        "sew_line_count": drawn.sew_lines,
        "dart_count": drawn.darts.len() + drawn.doubts.undecided.len() + drawn.doubts.candidates.len(),
        "darts_unfolded": piece.darts.len(),
        // Marks (POINT) count apart from notches drawn with strokes: both are listed and both are sewn.
        "notch_count": drawn.notches.iter().filter(|n| !n.strokes && !n.cut).count(),
        "stroke_notch_count": drawn.notches.iter().filter(|n| n.strokes).count(),
        "cut_notch_count": drawn.notches.iter().filter(|n| n.cut).count(),
        "drill_count": drawn.inside.drills.len(),
        "drill_diameters_mm": drawn.inside.drills.iter().map(|d| d.diameter.map(round)).collect::<Vec<_>>(),
        "stripe_line_count": drawn.inside.stripes.len(),
        "internal_line_count": drawn.inside.internal.len(),
        "cutout_count": drawn.inside.cutouts.len(),
        "grain_line_mm": drawn.axes.grain.map(|g| g.map(xy)),
        "turn_point_count": drawn.points.turn_points,
        "curve_point_count": drawn.points.curve_list.len(),
    });
    let undecided = drawn.doubts.undecided.iter().map(|d| dart(d, true));
    let darts = drawn.darts.iter().map(|d| dart(d, false)).chain(undecided);
    let darts = darts.chain(drawn.doubts.candidates.iter().map(candidate));
    let denied = drawn.doubts.denied.iter().map(|d| json!({ "at_mm": xy(d.at), "why": d.why }));
    // Moved in: `json!` would copy what is a `Value` already.
    let lists = [
        ("darts", darts.collect()),
        ("not_darts", denied.collect()),
        ("pleats", drawn.doubts.pleats.iter().map(pleat).collect()),
        ("notches", drawn.notches.iter().map(notch).collect()),
        ("drills_mm", drawn.inside.drills.iter().map(|d| xy(d.at)).collect()),
        ("edges", edges(piece)),
    ];
    if let Some(map) = out.as_object_mut() {
        map.extend(lists.into_iter().map(|(key, list)| (key.to_owned(), Value::Array(list))));
        map.extend(drawn.axes.fold.map(|fold| ("fold_line_mm".to_owned(), json!(fold.map(xy)))));
    }
    out
}

/// A piece that cannot be used: what can be read of it, and why it is refused.
fn refused(piece: &RefusedPiece) -> Value {
    let line = piece.positions();
    let closed = piece.lines.first().is_some_and(|l| l.closed);
    let bounds =
        geom::bounds(line.iter().copied()).map(|(lo, hi)| json!([round(lo.x), round(lo.y), round(hi.x), round(hi.y)]));
    json!({
        "block": piece.block,
        "name": piece.name,
        "size": piece.size,
        "area_cm2": round(geom::area(&line).abs() / 100.0),
        "perimeter_mm": round(geom::length(&line, closed)),
        "bbox_mm": bounds,
        "boundary_vertices": line.len(),
        "importable": false,
        "refused": piece.faults,
        "darts": [],
        "notches": [],
        "edges": [],
    })
}

/// The facts of all pieces, in the order of the file.
fn of_all_pieces<T>(pattern: &Pattern, sound: Vec<T>, refused: impl Fn(&RefusedPiece) -> T) -> Vec<T> {
    let sound = pattern.pieces.iter().map(|p| p.line).zip(sound);
    in_file_order(sound, pattern.refused.iter().map(|p| (p.line, refused(p))))
}

fn notch(n: &DrawnNotch) -> Value {
    json!({
        "kind": n.kind, "at_mm": xy(n.at), "depth_mm": round(n.depth), "width_mm": round(n.width), "on": n.on,
        "angle_deg": n.angle.map(|a| round(a.to_degrees())), "twin": n.twin,
    })
}

fn dart(d: &DrawnDart, undecided: bool) -> Value {
    let kind = match d.form {
        Form::Wedge => "boundary_wedge",
        Form::Marked => "internal_line",
        Form::Lens => "contour",
    };
    let (chord, path) = ([d.leg_chord(0), d.leg_chord(1)].map(round), [d.leg_path(0), d.leg_path(1)].map(round));
    let mut out = json!({
        "kind": kind,
        "apex_mm": d.apexes.first().map(|p| xy(*p)),
        "mouth_mm": d.mouth.map(xy),
        "leg_chord_mm": chord,
        "leg_path_mm": path,
        "leg_difference_mm": round((d.leg_path(0) - d.leg_path(1)).abs()),
        "width_mm": round(d.width()),
        "line": d.on,
        "confidence": round(d.confidence()),
        "evidence": d.reasons(),
        "candidate": undecided,
    });
    if let (Form::Lens, Some(map)) = (d.form, out.as_object_mut()) {
        map.insert("apexes_mm".to_owned(), d.apexes.iter().map(|p| xy(*p)).collect());
    }
    out
}

/// A drill hole and two notches: not made a dart, a person must say.
fn candidate((drill, mouth): &(Vec2, [Vec2; 2])) -> Value {
    let legs = mouth.map(|m| round((m - drill).norm()));
    json!({
        "kind": "drill_and_notches",
        "apex_mm": xy(*drill),
        "mouth_mm": mouth.map(xy),
        "leg_chord_mm": legs,
        "leg_path_mm": legs,
        "leg_difference_mm": round((legs[0] - legs[1]).abs()),
        "width_mm": round((mouth[1] - mouth[0]).norm()),
        "line": "cut",
        "confidence": 0.5,
        "evidence": ["a drill hole on the axis between two notches"],
        "candidate": true,
    })
}

fn pleat(p: &Pleat) -> Value {
    json!({
        "kind": if p.converging { "dart_pleat" } else { "pleat" },
        "lines_mm": p.lines.map(|l| l.map(xy)),
        "width_mm": round(p.width),
        "confidence": round(p.confidence),
        "evidence": p.evidence,
        "candidate": true,
    })
}

fn edges(piece: &Piece) -> Vec<Value> {
    let edge = |e: &OutlineEdge| {
        let points = piece.outline.edge_points(e);
        let length: f64 = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
        Some(json!({
            "index": e.index, "name": e.name, "from_mm": xy(*points.first()? * 1e3), "to_mm": xy(*points.last()? * 1e3),
            "length_mm": round(length * 1e3),
        }))
    };
    piece.edges.iter().filter_map(edge).collect()
}

fn text(pattern: &Pattern, table: Option<&RuleTable>) -> String {
    let mut out = String::new();
    let say = |out: &mut String, line: String| {
        let _ = writeln!(out, "{line}");
    };
    let or = |v: &Option<String>| v.clone().unwrap_or_else(|| "-".to_owned());
    say(
        &mut out,
        format!(
            "{}  style {}  units {} ({} mm)  text {}",
            toile_garment::text::shown(&pattern.file, &[]),
            or(&pattern.style),
            or(&pattern.units.declared),
            pattern.units.mm_per_unit,
            pattern.encoding
        ),
    );
    let p = &pattern.profile;
    let why = p.reasons.join("; ");
    say(&mut out, format!("written by {} ({:.0} %: {why})  {}", p.vendor.name(), p.confidence * 100.0, p.standard.0));
    let graded: Vec<String> =
        pattern.available_sizes(table).into_iter().filter(|size| !pattern.sizes.contains(size)).collect();
    let graded = if graded.is_empty() { String::new() } else { format!("  by grade rules {}", graded.join(" ")) };
    say(&mut out, format!("sizes {}{graded}  sample {}", pattern.sizes.join(" "), or(&pattern.sample_size)));
    say(
        &mut out,
        format!(
            "{:<24} {:<8} {:>9} {:>9} {:>9} {:>5} {:>5} {:>5} {:>7} {:>6} {:>5}",
            "piece", "size", "cut cm2", "sewn cm2", "cut mm", "count", "pts", "darts", "notches", "drills", "fold"
        ),
    );
    let rows = pattern.pieces.iter().map(row).collect();
    for row in of_all_pieces(pattern, rows, refused_row) {
        say(&mut out, row);
    }
    let l = &pattern.ledger;
    say(
        &mut out,
        format!(
            "{} entities: {} accepted, {} interpreted, {} refused",
            l.entities(),
            l.count(Verdict::Accepted),
            l.count(Verdict::Interpreted),
            l.count(Verdict::Refused)
        ),
    );
    for finding in pattern.told_findings() {
        say(&mut out, finding.to_string());
    }
    out
}

/// A piece in one line of the table.
fn row(p: &DrawnPiece) -> String {
    let line = p.boundary.positions();
    let area = |line: &[Vec2]| geom::area(line).abs() / 100.0;
    let size = p.size.clone().unwrap_or_else(|| "-".to_owned());
    let row = format!(
        "{:<24} {:<8} {:>9.2} {:>9.2} {:>9.1} {:>5} {:>5} {:>5} {:>7} {:>6} {:>5}",
        p.label(),
        size,
        area(&line),
        area(&p.sewn().positions()),
        geom::length(&line, true),
        p.texts.quantity.plain + p.texts.quantity.mirrored,
        line.len(),
        p.darts.len(),
        p.notches.len(),
        p.inside.drills.len(),
        if p.axes.fold.is_some() { "half" } else { "" }
    );
    row.trim_end().to_owned()
}

/// A piece that cannot be used, in one line of the table.
fn refused_row(p: &RefusedPiece) -> String {
    let size = p.size.clone().unwrap_or_else(|| "-".to_owned());
    let mut codes: Vec<&str> = Vec::new();
    for fault in &p.faults {
        if !codes.contains(&fault.code.as_str()) {
            codes.push(fault.code.as_str());
        }
    }
    format!("{:<24} {:<8} cannot be used: {}", p.label(), size, codes.join(", "))
}
