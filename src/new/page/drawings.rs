//! Drawings of the pieces: seams in their colours, numbered edges that can be clicked, and notches.

use super::colour::colour;
use std::fmt::Write as _;
use toile_formats::svg::canvas::escape as escaped;
use toile_formats::svg::inward_normal;
use toile_garment::notch::Notch;
use toile_garment::outline::OutlineEdge;
use toile_garment::{Piece, Vec2};
use toile_stages::proposal::{Proposal, ProposedSeam};
use toile_stages::sewing::edges::Edge;
use toile_stages::sewing::ring::{along as line_point, arcs};

/// Pixels for a metre of cloth.
const SCALE: f64 = 420.0;
/// Longest side of a small piece, pixels: it is drawn larger, so that its numbers can be read.
const SMALL: f64 = 240.0;
/// Room around a piece, pixels.
const MARGIN: f64 = 26.0;
/// Lengths that differ by less are one, metres.
const SAME_LENGTH: f64 = 1e-5;
/// Distance of the label of a notch from it, pixels.
const NOTCH_LABEL: f64 = 11.0;
/// Length of the arrow on an edge, pixels.
const ARROW: f64 = 8.0;

/// The picture's frame of a piece.
struct Frame {
    low: Vec2,
    high: Vec2,
    scale: f64,
}

impl Frame {
    fn of(points: &[Vec2]) -> Option<Self> {
        let low = points.iter().copied().reduce(|a, b| a.inf(&b))?;
        let high = points.iter().copied().reduce(|a, b| a.sup(&b))?;
        Some(Self { low, high, scale: SCALE.max(SMALL / (high - low).max().max(1e-3)) })
    }

    fn size(&self) -> Vec2 {
        (self.high - self.low) * self.scale + Vec2::repeat(2.0 * MARGIN)
    }

    fn at(&self, p: Vec2) -> (f64, f64) {
        (MARGIN + (p.x - self.low.x) * self.scale, MARGIN + (self.high.y - p.y) * self.scale)
    }

    fn path(&self, points: &[Vec2]) -> String {
        let pixels: Vec<String> = points.iter().map(|p| self.at(*p)).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        pixels.join(" ")
    }
}

/// A piece to be drawn.
pub struct Drawn<'a> {
    /// All seams.
    pub proposal: &'a Proposal,
    /// The piece.
    pub piece: &'a Piece,
    /// The edges of all pieces, as they are sewn.
    pub edges: &'a [Edge],
    /// Its name and role.
    pub words: String,
    /// Its number in the view.
    pub number: Option<usize>,
}

impl Drawn<'_> {
    /// Names of the seams that have an edge, or a part of it.
    fn seams_of(&self, edge: &OutlineEdge) -> Vec<&str> {
        let has = |seam: &&ProposedSeam| {
            let mut runs = seam.a.iter().chain(&seam.b).filter(|r| r.piece == self.piece.id.index());
            runs.any(|r| r.edges.iter().any(|e| e.number == edge.index))
        };
        self.proposal.seams.iter().filter(has).map(|s| s.name.as_str()).collect()
    }
}

/// Writes the drawing of a piece.
pub fn figure(out: &mut String, drawn: &Drawn<'_>) {
    let Drawn { proposal, piece, words, number, .. } = drawn;
    let points = piece.outline.positions();
    let Some(frame) = Frame::of(&points) else { return };
    let size = frame.size();
    let pick = number.map(|n| format!(" data-pick=\"piece:{n}\"")).unwrap_or_default();
    let _ = writeln!(
        out,
        "<figure><figcaption>{}</figcaption>\n<svg width=\"{:.0}\" height=\"{:.0}\" \
         viewBox=\"0 0 {:.0} {:.0}\" role=\"group\" aria-label=\"{}\">\n\
         <polygon{pick} points=\"{}\" fill=\"#f7f5ef\" stroke=\"#999\" stroke-width=\"1.5\"/>",
        escaped(words),
        size.x,
        size.y,
        size.x,
        size.y,
        escaped(words),
        frame.path(&points)
    );
    seams(out, proposal, piece, &frame);
    for (notch, label) in piece.notches.iter().zip(piece.notch_labels()).filter(|(n, _)| n.is_on_edge()) {
        marked(out, piece, notch, &label, &frame);
    }
    for edge in &piece.edges {
        let along = along(&points, edge);
        clickable(out, drawn, &frame, edge, &along);
        label(out, edge, &along, &frame);
    }
    out.push_str("</svg></figure>\n");
}

fn seams(out: &mut String, proposal: &Proposal, piece: &Piece, frame: &Frame) {
    for (k, seam) in proposal.seams.iter().enumerate() {
        for run in seam.a.iter().chain(&seam.b).filter(|r| r.piece == piece.id.index()) {
            let _ = writeln!(
                out,
                "<polyline data-pick=\"seam:{k}\" points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"4\">\
                 <title>{}</title></polyline>",
                frame.path(&run.points),
                colour(k),
                escaped(&seam.name)
            );
        }
    }
}

/// A notch with its label, inside the piece.
fn marked(out: &mut String, piece: &Piece, notch: &Notch, label: &str, frame: &Frame) {
    let (x, y) = frame.at(notch.at);
    let inward = inward_normal(&piece.outline, notch.at);
    let _ = writeln!(
        out,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"#7a1fa2\"/>\n\
         <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"9\" fill=\"#7a1fa2\" text-anchor=\"middle\" pointer-events=\"none\">{}</text>",
        x + inward.x * NOTCH_LABEL,
        y - inward.y * NOTCH_LABEL + 3.0,
        escaped(label)
    );
}

/// The points of an edge, from its start to its end.
fn along(outline: &[Vec2], edge: &OutlineEdge) -> Vec<Vec2> {
    let (n, from, to) = (outline.len(), edge.from as usize, edge.to as usize);
    let Some(steps) = (to + n).checked_sub(from) else { return Vec::new() };
    (0..=steps % n.max(1)).filter_map(|k| outline.get((from + k) % n).copied()).collect()
}

/// Unseen wide lines over an edge, one from notch to notch, for the pointer and the keyboard.
fn clickable(out: &mut String, drawn: &Drawn<'_>, frame: &Frame, edge: &OutlineEdge, along: &[Vec2]) {
    let arcs = arcs(along, false);
    let length = arcs.last().copied().unwrap_or_default();
    let name = escaped(&format!("{}.{}", drawn.piece.name, edge.index));
    let seams = escaped(&drawn.seams_of(edge).join("|"));
    // Where an intake lies on the edge, its notches are not where the drawing has them.
    let sewn = drawn.edges.iter().find(|e| e.piece == drawn.piece.id && e.number == edge.index);
    let sewn = sewn.filter(|e| (e.length - length).abs() < SAME_LENGTH);
    let notches: &[f64] = sewn.map_or(&[], |e| &e.notches);
    let ends: Vec<f64> = [&[0.0], notches, &[length]].concat();
    let parts = ends.len() - 1;
    let place = |k: usize| match k {
        0 => "start".to_owned(),
        k if k == parts => "end".to_owned(),
        k => format!("notch {k}"),
    };
    for k in 0..parts {
        let (from, to) = (place(k), place(k + 1));
        let mm = (ends[k + 1] - ends[k]) * 1e3;
        let _ = writeln!(
            out,
            "<polyline class=\"edge\" points=\"{}\" data-edge=\"{name}\" data-part=\"{k}\" data-from=\"{from}\" \
             data-to=\"{to}\" data-mm=\"{mm:.2}\" data-seams=\"{seams}\" role=\"button\" tabindex=\"-1\" \
             aria-label=\"edge {name} from {from} to {to}, {mm:.0} mm\"/>",
            frame.path(&between(along, &arcs, [ends[k], ends[k + 1]])),
        );
    }
}

/// The points of a line between two distances from its start.
fn between(points: &[Vec2], arcs: &[f64], [from, to]: [f64; 2]) -> Vec<Vec2> {
    let at = |s: f64| {
        let k = arcs.partition_point(|a| *a < s).clamp(1, arcs.len() - 1);
        line_point(points[k - 1], points[k], arcs[k - 1], arcs[k], s)
    };
    let inside = points.iter().zip(arcs).filter(|(_, s)| (from..to).contains(*s) && **s > from).map(|(p, _)| *p);
    std::iter::once(at(from)).chain(inside).chain(std::iter::once(at(to))).collect()
}

/// The number of an edge, outside the piece, and an arrow along it.
fn label(out: &mut String, edge: &OutlineEdge, along: &[Vec2], frame: &Frame) {
    let Some((middle, way)) = middle(along) else { return };
    let ((x, y), (dx, dy)) = (frame.at(middle), (way.x * ARROW, -way.y * ARROW));
    let _ = writeln!(
        out,
        "<path d=\"M{:.1} {:.1}L{x:.1} {y:.1}L{:.1} {:.1}\" fill=\"none\" stroke=\"#222\"/>\n\
         <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\" text-anchor=\"middle\" paint-order=\"stroke\" \
         stroke=\"#fff\" stroke-width=\"3\">{}</text>",
        x - dx - dy * 0.5,
        y - dy + dx * 0.5,
        x - dx + dy * 0.5,
        y - dy - dx * 0.5,
        x - dy * 1.6,
        y + dx * 1.6 + 4.0,
        edge.index
    );
}

/// The middle vertex of an edge, or the middle of its chord where it has no vertex between its ends, and the unit vector
/// of its way there.
fn middle(along: &[Vec2]) -> Option<(Vec2, Vec2)> {
    let half = along.len().checked_sub(1)? / 2;
    let (before, at, after) = match along {
        [] | [_] => return None,
        [from, to] => (*from, (from + to) / 2.0, *to),
        _ => (along[half - 1], along[half], along[half + 1]),
    };
    (after - before).try_normalize(0.0).map(|way| (at, way))
}
