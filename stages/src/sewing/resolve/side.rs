//! One side of a seam as spans without intakes.

use super::super::lookup::RawRun;
use super::super::ring::SAME;
use super::super::shapes::{Shapes, mm};
use crate::codes::SEAM_TO_ITSELF;
use crate::sewing::codes;
use toile_garment::sewing::SeamSpec;
use toile_garment::{Code, Diagnostic, Garment, PieceId, SourceRef};

/// A stretch of a ring, without an intake inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// Piece.
    pub piece: PieceId,
    /// Ring of the piece: 0 the outline, 1 + k cutout k.
    pub ring: usize,
    /// Arc position at which it starts, in sewing order.
    pub from: f64,
    /// Arc position at which it ends.
    pub to: f64,
    /// True where it is walked forward.
    pub forward: bool,
    /// Length, metres.
    pub length: f64,
}

/// A side: spans in sewing order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Side {
    /// Spans.
    pub spans: Vec<Span>,
    /// Sewn length, metres.
    pub length: f64,
}

impl Side {
    /// Distances from the start of the side to the start of every span.
    pub fn starts(&self) -> Vec<f64> {
        let mut at = 0.0;
        self.spans
            .iter()
            .map(|s| {
                let start = at;
                at += s.length;
                start
            })
            .collect()
    }

    /// Where the ring position of a piece comes on this side, metres from its start; every time it does.
    pub fn find(&self, shapes: &Shapes, piece: PieceId, ring: usize, s: f64) -> Vec<f64> {
        let starts = self.starts();
        let mut out = Vec::new();
        for (span, start) in self.spans.iter().zip(starts) {
            if span.piece != piece || span.ring != ring {
                continue;
            }
            let r = &shapes[piece.index()].rings[ring];
            let d = if span.forward { r.ahead(span.from, s) } else { r.ahead(s, span.from) };
            if d <= span.length + SAME {
                out.push(start + d.min(span.length));
            }
        }
        out
    }
}

/// Cuts the runs of a side at the intakes they cross.
pub fn side(garment: &Garment, shapes: &Shapes, spec: &SeamSpec, runs: &[RawRun]) -> Result<Side, Diagnostic> {
    spans(garment, shapes, &format!("seam `{}`", spec.name), spec.source.as_ref(), runs)
}

/// [`side`] of whatever is sewn: `what` names it, `source` tells where the file says so.
pub fn spans(
    garment: &Garment,
    shapes: &Shapes,
    what: &str,
    source: Option<&SourceRef>,
    runs: &[RawRun],
) -> Result<Side, Diagnostic> {
    let wrong = |code: Code, told: String, hint: &str| {
        Diagnostic::error(code, format!("{what} {told}")).at(source.cloned()).hint(hint)
    };
    let mut out = Side::default();
    for run in runs {
        let piece = &garment.pieces[run.piece.index()];
        let ring = &shapes[run.piece.index()].rings[run.ring];
        for end in [run.from, run.to] {
            if let Some(gap) = ring.gap_around(end) {
                let dart = piece.darts.get(gap.dart).map_or("", |d| d.name.as_str());
                return Err(wrong(
                    codes::SEAM_ENDS_IN_DART,
                    format!("ends at {} inside dart `{dart}` of piece `{}`", mm(ring.at(end)), piece.name),
                    "end it at a mouth point, or deny the dart with [[dart]] kind = \"none\"",
                ));
            }
        }
        let spans = cut(run, &shapes[run.piece.index()]);
        if spans.is_empty() {
            return Err(wrong(
                codes::SEAM_WITHOUT_LENGTH,
                format!("has a run of no length on piece `{}` at {}", piece.name, mm(ring.at(run.from))),
                "give two different points",
            ));
        }
        out.spans.extend(spans);
    }
    out.length = out.spans.iter().map(|s| s.length).sum();
    Ok(out)
}

fn wrong(spec: &SeamSpec, code: Code, what: String, hint: &str) -> Diagnostic {
    Diagnostic::error(code, format!("seam `{}` {what}", spec.name)).at(spec.source.clone()).hint(hint)
}

/// The run without the intakes between its ends.
fn cut(run: &RawRun, shape: &super::super::shapes::PieceShape) -> Vec<Span> {
    let ring = &shape.rings[run.ring];
    let (start, _) = run.span();
    let whole = run.walk(shape);
    let mut cuts: Vec<(f64, f64)> = Vec::new();
    let mut at = 0.0;
    for (gap_from, gap_to, _) in ring.gaps_between(start, whole) {
        cuts.push((at, gap_from));
        at = gap_to;
    }
    cuts.push((at, whole));
    let position = |d: f64| {
        let s = start + d;
        if s >= ring.total() - SAME { (s - ring.total()).max(0.0) } else { s }
    };
    let mut spans: Vec<Span> = cuts
        .into_iter()
        .filter(|(a, b)| b - a > SAME)
        .map(|(a, b)| Span {
            piece: run.piece,
            ring: run.ring,
            from: position(a),
            to: position(b),
            forward: true,
            length: b - a,
        })
        .collect();
    if !run.forward {
        spans.reverse();
        for s in &mut spans {
            (s.from, s.to, s.forward) = (s.to, s.from, false);
        }
    }
    spans
}

/// Refuses a seam that would sew a line to itself point by point.
pub fn check_not_itself(spec: &SeamSpec, a: &Side, b: &Side, shapes: &Shapes) -> Result<(), Diagnostic> {
    for s in &a.spans {
        let ring = &shapes[s.piece.index()].rings[s.ring];
        for t in b.spans.iter().filter(|t| t.piece == s.piece && t.ring == s.ring) {
            let ((s0, s1), (t0, t1)) = (ordered(s), ordered(t));
            let (ls, lt) = (ring.ahead(s0, s1), ring.ahead(t0, t1));
            let (ls, lt) = (if ls < SAME { s.length } else { ls }, if lt < SAME { t.length } else { lt });
            let shared = ring.ahead(s0, t0) < ls - SAME || ring.ahead(t0, s0) < lt - SAME;
            if shared {
                return Err(wrong(
                    spec,
                    SEAM_TO_ITSELF,
                    format!("has the same stretch of outline near {} on both sides", mm(ring.at(t0))),
                    "the two sides must be different stretches; a fold-over sews two neighbouring ones",
                ));
            }
        }
    }
    Ok(())
}

fn ordered(s: &Span) -> (f64, f64) {
    if s.forward { (s.from, s.to) } else { (s.to, s.from) }
}
