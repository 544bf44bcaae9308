//! Drawings of the pieces: seams in their colours, numbered edges that can be clicked, and notches.

use super::colour::colour;
use std::fmt::Write as _;
use toile_formats::svg::canvas::escape as escaped;
use toile_garment::outline::OutlineEdge;
use toile_garment::{Piece, Vec2};
use toile_stages::proposal::Proposal;

/// Pixels for a metre of cloth.
const SCALE: f64 = 420.0;
/// Room around a piece, pixels.
const MARGIN: f64 = 26.0;
/// Length of the arrow on an edge, pixels.
const ARROW: f64 = 8.0;

/// The picture's frame of a piece.
struct Frame {
    low: Vec2,
    high: Vec2,
}

impl Frame {
    fn of(points: &[Vec2]) -> Option<Self> {
        let extreme = |choose: fn(f64, f64) -> f64| {
            points.iter().copied().reduce(|a, b| Vec2::new(choose(a.x, b.x), choose(a.y, b.y)))
        };
        Some(Self { low: extreme(f64::min)?, high: extreme(f64::max)? })
    }

    fn size(&self) -> Vec2 {
        (self.high - self.low) * SCALE + Vec2::repeat(2.0 * MARGIN)
    }

    fn at(&self, p: Vec2) -> (f64, f64) {
        (MARGIN + (p.x - self.low.x) * SCALE, MARGIN + (self.high.y - p.y) * SCALE)
    }

    fn path(&self, points: &[Vec2]) -> String {
        let pixels: Vec<String> = points.iter().map(|p| self.at(*p)).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        pixels.join(" ")
    }
}

/// Writes the drawing of a piece. `number` is that of the piece in the view.
pub fn figure(out: &mut String, proposal: &Proposal, piece: &Piece, words: &str, number: Option<usize>) {
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
    for notch in piece.notches.iter().filter(|n| n.is_on_edge()) {
        let (x, y) = frame.at(notch.at);
        let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"#7a1fa2\"/>");
    }
    for edge in &piece.edges {
        let along = along(&points, edge);
        clickable(out, proposal, piece, edge, &along, &frame);
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

/// The points of an edge, from its start to its end.
fn along(outline: &[Vec2], edge: &OutlineEdge) -> Vec<Vec2> {
    let (n, from, to) = (outline.len(), edge.from as usize, edge.to as usize);
    let Some(steps) = (to + n).checked_sub(from) else { return Vec::new() };
    (0..=steps % n.max(1)).filter_map(|k| outline.get((from + k) % n).copied()).collect()
}

/// An unseen wide line over an edge, for the pointer and the keyboard.
fn clickable(out: &mut String, proposal: &Proposal, piece: &Piece, edge: &OutlineEdge, along: &[Vec2], frame: &Frame) {
    let length: f64 = along.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let has = |seam: &&toile_stages::proposal::ProposedSeam| {
        let mut runs = seam.a.iter().chain(&seam.b).filter(|r| r.piece == piece.id.index());
        runs.any(|r| r.edges.iter().any(|e| e.number == edge.index))
    };
    let seams: Vec<&str> = proposal.seams.iter().filter(has).map(|s| s.name.as_str()).collect();
    let name = escaped(&format!("{}.{}", piece.name, edge.index));
    let _ = writeln!(
        out,
        "<polyline class=\"edge\" points=\"{}\" data-edge=\"{name}\" data-mm=\"{:.2}\" data-seams=\"{}\" role=\"button\" \
         tabindex=\"-1\" aria-label=\"edge {name}, {:.0} mm\"/>",
        frame.path(along),
        length * 1e3,
        escaped(&seams.join("|")),
        length * 1e3
    );
}

/// The number of an edge, and an arrow along it.
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
        x + dy * 1.6,
        y - dx * 1.6 + 4.0,
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
