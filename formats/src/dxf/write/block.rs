//! The block of one piece in one size.

use super::codes;
use super::model::{Dialect, DrawLine, DrawNotch, NotchLine, PieceDrawing};
use super::names::PieceName;
use super::sparse::fitted;
use super::style::{folded, key_value};
use super::tags::{Tags, decimal};
use crate::dxf::geom;
use std::collections::BTreeSet;
use toile_garment::notch::NotchKind;
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Vec2};

/// Writes one block.
pub fn block(
    tags: &mut Tags,
    piece: &PieceDrawing,
    name: &PieceName,
    dialect: Dialect,
    findings: &mut Vec<Diagnostic>,
) {
    let dense = dialect.has_dense();
    let boundary = fitted(&piece.boundary, dense);
    let sew = piece.sew_line.as_ref().map(|l| fitted(l, dense));
    let lost = boundary.lost + sew.as_ref().map_or(0, |s| s.lost);
    say_curves(piece, lost, boundary.off.max(sew.as_ref().map_or(0.0, |s| s.off)), findings);
    let (boundary, sew_line) = (boundary.line, sew.map(|s| s.line));
    let notches = piece.notches.iter().map(|n| on_line(*n, &boundary, sew_line.as_ref())).collect();
    let thinned = PieceDrawing { boundary, sew_line, notches, ..piece.clone() };
    draw(tags, &thinned, name, dialect, findings);
}

/// A reader's curve further than this off the line is said, mm.
const CURVE_SAID: f64 = 0.1;
/// A notch further than this off its line is put on it, mm; what is still farther off belongs to no line.
const NOTCH_OFF: (f64, f64) = (0.2, 5.0);

/// Says what the dialect cannot hold of the curves of a piece.
fn say_curves(piece: &PieceDrawing, lost: usize, off: f64, findings: &mut Vec<Diagnostic>) {
    let size = piece.size.as_ref().map_or_else(String::new, |s| format!(" in size {s}"));
    if lost > 0 {
        let text = format!(
            "{lost} curve point(s) of `{}`{size} are written as plain vertices: a curve through them would leave the line",
            piece.name
        );
        findings.push(Diagnostic::info(codes::CURVE_POINTS_LOST, text));
    }
    if off > CURVE_SAID {
        let text = format!(
            "the dialect has no dense copy of curves: a reader's curve through the curve points of `{}`{size} lies up to {off:.2} mm off",
            piece.name
        );
        findings.push(Diagnostic::info(codes::CURVE_COPY_LOST, text).hint("dialect = \"astm\" holds a dense copy"));
    }
}

/// A notch on the line that is written: where the line has fewer vertices than it had, the notch goes onto its chord.
fn on_line(notch: DrawNotch, boundary: &DrawLine, sew: Option<&DrawLine>) -> DrawNotch {
    let line = match notch.on {
        NotchLine::Cut => Some(boundary),
        NotchLine::Sew => sew,
        NotchLine::Fold | NotchLine::None => None,
    };
    let Some(line) = line else { return notch };
    let points: Vec<Vec2> = line.points.iter().map(|p| p.at).collect();
    let foot = geom::nearest(notch.at, &points, line.closed);
    let Some(foot) = foot.filter(|f| f.distance > NOTCH_OFF.0 && f.distance <= NOTCH_OFF.1) else { return notch };
    DrawNotch { at: foot.on(&points), ..notch }
}

fn draw(tags: &mut Tags, piece: &PieceDrawing, name: &PieceName, dialect: Dialect, findings: &mut Vec<Diagnostic>) {
    tags.entity("BLOCK", "0");
    tags.pair(2, &name.block);
    tags.int(70, 64);
    tags.point(10, Vec2::zeros());
    texts(tags, piece, name, dialect, findings);
    for (layer, line) in piece.lines() {
        if dialect == Dialect::Gerber && matches!(layer, "1" | "14") {
            runs(tags, layer, line, &line.points.iter().map(|p| p.at).collect::<Vec<_>>(), dialect);
        } else {
            polyline(tags, layer, line.points.iter().map(|p| p.at), line.closed, dialect);
        }
    }
    for (layer, line) in &piece.stripes {
        match line.points.as_slice() {
            [mark] => {
                tags.entity("POINT", layer);
                tags.point(10, mark.at);
            }
            [from, to] if !line.closed => {
                tags.entity("LINE", layer);
                tags.point(10, from.at);
                tags.point(11, to.at);
            }
            points => polyline(tags, layer, points.iter().map(|p| p.at), line.closed, dialect),
        }
    }
    if dialect.has_dense() {
        dense(tags, "84", &piece.boundary, dialect);
        if let Some(line) = &piece.sew_line {
            dense(tags, "87", line, dialect);
        }
    }
    points(tags, piece);
    for notch in &piece.notches {
        self::notch(tags, notch, piece, dialect, findings);
    }
    straight(tags, piece);
    for hole in &piece.drill_holes {
        tags.entity("POINT", "13");
        tags.point(10, hole.at);
        if let Some(diameter) = hole.diameter {
            tags.length(30, diameter);
        }
    }
    for rule in &piece.rules {
        let layer = match rule.kind {
            _ if dialect.is_astm() => rule.layer,
            PointKind::Curve => "3",
            _ => "2",
        };
        tags.text(layer, rule.at, &format!("# {}", rule.rule));
    }
    tags.entity("ENDBLK", "0");
}

fn texts(tags: &mut Tags, piece: &PieceDrawing, name: &PieceName, dialect: Dialect, findings: &mut Vec<Diagnostic>) {
    let quantity = &piece.cut.quantity;
    let count = if !dialect.is_astm() {
        if quantity.mirrored > 0 {
            findings.push(Diagnostic::info(
                codes::QUANTITY_WITHOUT_SIDES,
                format!(
                    "AAMA holds one quantity: `{}` is written as {} instead of {} and {} mirrored",
                    piece.name,
                    quantity.plain.saturating_add(quantity.mirrored),
                    quantity.plain,
                    quantity.mirrored
                ),
            ));
        }
        quantity.plain.saturating_add(quantity.mirrored).to_string()
    } else {
        format!("{},{}", quantity.plain, quantity.mirrored)
    };
    let fields = [
        ("Piece Name", Some(name.piece.as_str())),
        ("Size", name.size.as_deref()),
        ("Quantity", Some(count.as_str())),
        ("Material", piece.cut.material.as_deref()),
        ("Category", piece.cut.category.as_deref()),
        ("Annotation", piece.cut.annotation.as_deref()),
    ];
    let [lo, hi] = piece.bounds();
    let mut at = (lo + hi) / 2.0;
    for (key, value) in fields {
        let Some(value) = value else { continue };
        let text = key_value(tags, key, value, dialect, findings);
        tags.text("1", at, &text);
        at.y -= 5.0;
    }
    for text in &piece.texts {
        let layer = folded(tags, &text.layer, Dialect::Gerber, findings);
        let value = folded(tags, &text.text, dialect, findings);
        tags.text(&layer, text.at, &value);
    }
}

fn polyline(tags: &mut Tags, layer: &str, points: impl Iterator<Item = Vec2>, closed: bool, dialect: Dialect) {
    tags.entity("POLYLINE", layer);
    tags.int(66, 1);
    tags.int(70, i64::from(closed));
    if dialect == Dialect::Clo {
        tags.int(250, if matches!(layer, "1" | "84") { 2 } else { 0 });
    }
    for at in points {
        tags.entity("VERTEX", layer);
        tags.point(10, at);
    }
    tags.entity("SEQEND", layer);
}

/// One open POLYLINE from turn point to turn point, `points` being the line itself or its dense copy.
fn runs(tags: &mut Tags, layer: &str, line: &DrawLine, points: &[Vec2], dialect: Dialect) {
    let turn = |p: &Vec2| line.points.iter().any(|q| q.kind == PointKind::Turn && (q.at - p).norm() < 1e-9);
    let mut points = points.to_vec();
    let first = points.iter().position(turn);
    if let (true, Some(first)) = (line.closed, first) {
        points.rotate_left(first);
        points.extend(points.first().copied());
    } else if line.closed {
        return polyline(tags, layer, points.into_iter(), true, dialect);
    }
    let mut start = 0;
    for i in 1..points.len() {
        if i + 1 == points.len() || turn(&points[i]) {
            polyline(tags, layer, points[start..=i].iter().copied(), false, dialect);
            start = i;
        }
    }
}

fn dense(tags: &mut Tags, layer: &str, line: &DrawLine, dialect: Dialect) {
    if dialect == Dialect::Gerber {
        return runs(tags, layer, line, &line.dense_points(), dialect);
    }
    polyline(tags, layer, line.dense_points().into_iter(), line.closed, dialect);
}

/// Turn points on 2 and curve points on 3, each place once. A point says the kind of every vertex at its place. So the
/// outer line decides where an inner line meets a vertex of it.
fn points(tags: &mut Tags, piece: &PieceDrawing) {
    let place = |at: Vec2| (decimal(at.x), decimal(at.y));
    let outer = std::iter::once(&piece.boundary).chain(&piece.sew_line);
    let taken: BTreeSet<_> = outer.flat_map(|l| &l.points).map(|p| place(p.at)).collect();
    for (kind, layer) in [(PointKind::Turn, "2"), (PointKind::Curve, "3")] {
        let mut seen = BTreeSet::new();
        for (of, line) in piece.lines() {
            let is_inner = !matches!(of, "1" | "14");
            for point in line.points.iter().filter(|p| p.kind == kind) {
                let at = place(point.at);
                if !(is_inner && taken.contains(&at)) && seen.insert(at) {
                    tags.entity("POINT", layer);
                    tags.point(10, point.at);
                }
            }
        }
    }
}

fn notch(tags: &mut Tags, notch: &DrawNotch, piece: &PieceDrawing, dialect: Dialect, findings: &mut Vec<Diagnostic>) {
    let layer = match notch.kind {
        NotchKind::Slit | NotchKind::V => "4",
        NotchKind::T => "80",
        NotchKind::Castle => "81",
        NotchKind::Check => "82",
        NotchKind::U => "83",
    };
    let plain = !dialect.is_astm() && layer != "4";
    if plain {
        findings.push(Diagnostic::info(
            codes::NOTCH_SHAPE_LOST,
            format!("AAMA has no {:?} notch: one of `{}` is written on layer 4", notch.kind, piece.name),
        ));
    }
    tags.entity("POINT", if plain { "4" } else { layer });
    tags.point(10, notch.at);
    tags.length(30, notch.depth);
    tags.length(39, if notch.kind == NotchKind::Slit { 0.0 } else { notch.width });
    if let Some(angle) = notch.angle {
        tags.number(50, angle);
    }
}

/// Grain on 7 and again as grade reference on 5; fold on 6.
fn straight(tags: &mut Tags, piece: &PieceDrawing) {
    let grain = piece.grain.iter().flat_map(|g| [("7", g), ("5", g)]);
    for (layer, [from, to]) in grain.chain(piece.fold.iter().map(|f| ("6", f))) {
        tags.entity("LINE", layer);
        tags.point(10, *from);
        tags.point(11, *to);
    }
}
