//! The seams of a sewing file in the form of a proposal, exactly as a person wrote them.

use super::edge_parts::edge_parts;
use super::seams::{ProposedSeam, Run};
use crate::sewing::resolve::{ResolvedSeam, Side, Span};
use crate::sewing::ring::Ring;
use crate::sewing::shapes::Shapes;
use toile_garment::{Garment, Vec2};

/// The seams of a sewing file. `confidence` tells that of a seam by its name.
#[must_use]
pub fn written(
    garment: &Garment,
    shapes: &Shapes,
    seams: &[ResolvedSeam],
    confidence: impl Fn(&str) -> f64,
) -> Vec<ProposedSeam> {
    let runs = |side: &Side| side.spans.iter().filter_map(|s| run(garment, shapes, s)).collect::<Vec<_>>();
    let one = |seam: &ResolvedSeam| {
        let (a, b) = (runs(&seam.a), runs(&seam.b));
        let fold_over = a.first().zip(b.first()).is_some_and(|(a, b)| a.forward == b.forward);
        ProposedSeam {
            name: seam.name.clone(),
            a,
            b,
            fold_over,
            length_a: seam.a.length,
            length_b: seam.b.length,
            confidence: confidence(&seam.name),
            atoms: Vec::new(),
            instead: Vec::new(),
        }
    };
    seams.iter().map(one).filter(|s| !s.a.is_empty() && !s.b.is_empty()).collect()
}

fn run(garment: &Garment, shapes: &Shapes, span: &Span) -> Option<Run> {
    let piece = span.piece.index();
    let shape = shapes.get(piece)?;
    let points = points(shape.rings.get(span.ring)?, span);
    let on_outline = span.ring == 0;
    let edges = if on_outline {
        edge_parts(&garment.pieces[piece], shape, [span.from, span.to], span.forward)
    } else {
        Vec::new()
    };
    Some(Run { piece, ends: [points[0], points[points.len() - 1]], forward: span.forward, points, edges })
}

/// The points of a span, in sewing order.
fn points(ring: &Ring, span: &Span) -> Vec<Vec2> {
    let start = if span.forward { span.from } else { span.to };
    let mut inside: Vec<(f64, Vec2)> =
        ring.points.iter().zip(&ring.arc).map(|(p, s)| (ring.ahead(start, *s), *p)).collect();
    inside.retain(|(way, _)| *way > 0.0 && *way < span.length);
    inside.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut out = vec![ring.at(start)];
    out.extend(inside.into_iter().map(|(_, p)| p));
    out.push(ring.at(start + span.length));
    if !span.forward {
        out.reverse();
    }
    out
}
