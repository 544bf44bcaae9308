//! The block of one piece in one size.

use super::codes;
use super::model::{Dialect, DrawLine, DrawNotch, PieceDrawing};
use super::names::PieceName;
use super::style::{folded, key_value};
use super::tags::{Tags, decimal};
use super::thin::thin;
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
    let thinned = PieceDrawing {
        boundary: thin(&piece.boundary, dense),
        sew_line: piece.sew_line.as_ref().map(|l| thin(l, dense)),
        internal: piece.internal.iter().map(|l| thin(l, false)).collect(),
        cutouts: piece.cutouts.iter().map(|l| thin(l, false)).collect(),
        ..piece.clone()
    };
    draw(tags, &thinned, name, dialect, findings);
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
            tags.real(30, diameter);
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
    let quantity = &piece.quantity;
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
        ("Material", piece.material.as_deref()),
        ("Category", piece.category.as_deref()),
        ("Annotation", piece.annotation.as_deref()),
    ];
    let [lo, hi] = piece.bounds();
    let mut at = (lo + hi) / 2.0;
    for (key, value) in fields {
        let Some(value) = value else { continue };
        tags.text("1", at, &key_value(key, value, dialect, findings));
        at.y -= 5.0;
    }
    for text in &piece.texts {
        tags.text(&folded(&text.layer, Dialect::Gerber, findings), text.at, &folded(&text.text, dialect, findings));
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

/// Turn points on 2 and curve points on 3, each place once.
fn points(tags: &mut Tags, piece: &PieceDrawing) {
    for (kind, layer) in [(PointKind::Turn, "2"), (PointKind::Curve, "3")] {
        let mut seen = BTreeSet::new();
        let marked = piece.lines().flat_map(|(_, l)| &l.points).filter(|p| p.kind == kind);
        for point in marked {
            if seen.insert((decimal(point.at.x), decimal(point.at.y))) {
                tags.entity("POINT", layer);
                tags.point(10, point.at);
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
    tags.real(30, notch.depth);
    tags.real(39, if notch.kind == NotchKind::Slit { 0.0 } else { notch.width });
    if let Some(angle) = notch.angle {
        tags.real(50, angle);
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
