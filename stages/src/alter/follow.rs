//! How the sewing plan follows a changed piece.

use super::build::Altered;
use super::contour::Carried;
use crate::sewing::lookup;
use crate::sewing::resolve::{Side, Span, elastic_side, find, placed};
use crate::sewing::ring::SAME;
use crate::sewing::shapes::Shapes;
use toile_formats::dxf::geom;
use toile_garment::dart::DartKind;
use toile_garment::sewing::{
    Around, AttachSpec, DartSpec, EdgeNameSpec, ElasticSpec, FoldSpec, InterliningSpec, LayerSpec, PlaceSpec,
    Placement, RunSpec, RunWay, SewingPlan, WholeSpec,
};
use toile_garment::{Diagnostic, Garment, Piece, PieceId, Vec2};

/// The plan for the parts of a piece.
///
/// # Errors
/// Seams and bands of the old plan that are not on the outlines.
pub fn plan(garment: &Garment, shapes: &Shapes, id: PieceId, altered: &Altered) -> Result<SewingPlan, Vec<Diagnostic>> {
    let old = &garment.plan;
    let follow = Follow { garment, shapes, id, altered, name: &garment.pieces[id.index()].name };
    let seams = placed(find(garment, shapes))?;
    let seams = old.seams.iter().zip(&seams).map(|(spec, found)| {
        if !follow.touches(&found.a) && !follow.touches(&found.b) {
            return spec.clone();
        }
        let [a, b] = [&found.a, &found.b].map(|side| follow.side(side));
        toile_garment::sewing::SeamSpec { a, b, reverse: None, ..spec.clone() }
    });
    let seams = seams.collect();
    let (edge_names, attachments) = follow.names()?;
    Ok(SewingPlan {
        seams,
        darts: old.darts.clone(),
        places: old.places.iter().flat_map(|p| follow.place(p)).collect(),
        layers: old.layers.iter().map(|l| LayerSpec { pieces: follow.pieces(&l.pieces), ..l.clone() }).collect(),
        attachments,
        copies: Vec::new(),
        edge_names,
        elastics: old.elastics.iter().map(|e| follow.elastic(e)).collect::<Result<_, _>>()?,
        folds: old.folds.iter().map(|f| follow.fold(f)).collect(),
        interlinings: old
            .interlinings
            .iter()
            .map(|i| InterliningSpec { pieces: follow.pieces(&i.pieces), ..i.clone() })
            .collect(),
        wholes: follow.wholes(),
        leave_out: Vec::new(),
        leave_out_source: None,
    })
}

/// The darts of a piece as a sewing file declares them, so that a file that is read again has them.
pub fn declared(piece: &Piece) -> Vec<DartSpec> {
    let is_wedge = |k: DartKind| matches!(k, DartKind::Wedge | DartKind::MarkedWedge | DartKind::FishEye);
    let spec = |d: &toile_garment::dart::Dart| DartSpec {
        piece: piece.name.clone(),
        name: Some(d.name.clone()),
        apexes: d.apexes.clone(),
        mouth: d.mouth,
        kind: Some(d.kind),
        press: None,
        sewn: None,
        source: None,
    };
    piece.darts.iter().filter(|d| is_wedge(d.kind)).map(spec).collect()
}

struct Follow<'a> {
    garment: &'a Garment,
    shapes: &'a Shapes,
    id: PieceId,
    altered: &'a Altered,
    name: &'a str,
}

impl Follow<'_> {
    fn is_it(&self, name: &str) -> bool {
        name.eq_ignore_ascii_case(self.name)
    }

    fn touches(&self, side: &Side) -> bool {
        side.spans.iter().any(|s| s.piece == self.id)
    }

    /// The name of the piece, or those of its parts.
    fn pieces(&self, names: &[String]) -> Vec<String> {
        let parts = || self.altered.parts.iter().map(|p| p.name.clone());
        let each = |n: &String| if self.is_it(n) { parts().collect() } else { vec![n.clone()] };
        names.iter().flat_map(each).collect()
    }

    /// The pieces that were cut apart. The parts of a part are parts of the same whole, and those of a piece that a person
    /// places are placed themselves.
    fn wholes(&self) -> Vec<WholeSpec> {
        let old = self.garment.plan.wholes.iter();
        let mut wholes: Vec<WholeSpec> =
            old.map(|w| WholeSpec { pieces: self.pieces(&w.pieces), ..w.clone() }).collect();
        let is_part = self.garment.plan.wholes.iter().any(|w| w.pieces.iter().any(|p| self.is_it(p)));
        let is_placed = self.garment.plan.places.iter().any(|p| self.is_it(&p.piece));
        if self.altered.parts.len() > 1 && !is_part && !is_placed {
            let pieces = self.altered.parts.iter().map(|p| p.name.clone()).collect();
            wholes.push(WholeSpec { name: self.name.to_owned(), pieces, source: None });
        }
        wholes
    }

    fn side(&self, side: &Side) -> Vec<RunSpec> {
        let mut out: Vec<RunSpec> = Vec::new();
        for run in side.spans.iter().flat_map(|span| self.span(span)) {
            match (out.last_mut(), &run) {
                // The halves of an edge beside a dart that is closed now are one.
                (Some(RunSpec::Points { piece, to, way, .. }), RunSpec::Points { piece: p, from, to: end, way: w })
                    if piece == p && way == w && (*to - from).norm() < SAME =>
                {
                    *to = *end;
                }
                _ => out.push(run),
            }
        }
        out
    }

    fn span(&self, span: &Span) -> Vec<RunSpec> {
        let ring = &self.shapes[span.piece.index()].rings[span.ring];
        let way = if span.forward { RunWay::Left } else { RunWay::Right };
        let ends = [ring.at(span.from), ring.at(span.to)];
        if self.shapes[span.piece.index()].seam_line(span.ring).is_some() {
            return self.line(span, ring.line()).into_iter().collect();
        }
        if span.piece != self.id {
            let piece = self.garment.pieces[span.piece.index()].name.clone();
            return vec![RunSpec::Points { piece, from: ends[0], to: ends[1], way }];
        }
        if span.ring != 0 {
            let carried = self.altered.carried(&ends);
            let run = carried.map(|(part, p)| self.points(part, [p[0], p[1]], way));
            return run.into_iter().collect();
        }
        let [from, to] = if span.forward { [span.from, span.to] } else { [span.to, span.from] };
        let ahead = ring.ahead(from, to);
        let mut runs = self.runs(from, if ahead < SAME { ring.total() } else { ahead });
        if span.forward {
            return runs.into_iter().map(|(part, ends)| self.points(part, ends, way)).collect();
        }
        runs.reverse();
        runs.into_iter().map(|(part, [a, b])| self.points(part, [b, a], way)).collect()
    }

    /// A line inside a piece; `None` where no part has the whole of it.
    fn line(&self, span: &Span, line: &[Vec2]) -> Option<RunSpec> {
        let mut line = line.to_vec();
        if !span.forward {
            line.reverse();
        }
        if span.piece != self.id {
            return Some(RunSpec::Line { piece: self.garment.pieces[span.piece.index()].name.clone(), line });
        }
        let (part, line) = self.altered.carried(&line)?;
        Some(RunSpec::Line { piece: self.altered.parts[part].name.clone(), line })
    }

    fn points(&self, part: usize, [from, to]: [Vec2; 2], way: RunWay) -> RunSpec {
        RunSpec::Points { piece: self.altered.parts[part].name.clone(), from, to, way }
    }

    /// The runs on the parts that a walk along the old outline covers, in its order: the part, and both ends walked forward.
    fn runs(&self, from: f64, length: f64) -> Vec<(usize, [Vec2; 2])> {
        let ring = &self.shapes[self.id.index()].rings[0];
        let parts = self.altered.parts.iter().enumerate();
        let mut all: Vec<_> =
            parts.flat_map(|(k, p)| p.contour.carried(ring, from, length).into_iter().map(move |c| (k, c))).collect();
        // Seams skip the legs of darts. Where a dart is gone, its legs are edges of their own.
        let is_leg = |c: &Carried| {
            let gap = ring.gap_around((from + (c.way[0] + c.way[1]) / 2.0).rem_euclid(ring.total()));
            gap.is_some_and(|g| self.altered.is_gone(g.dart))
        };
        all.retain(|(_, c)| !is_leg(c));
        all.sort_by(|(_, a), (_, b)| a.way[0].total_cmp(&b.way[0]));
        let mut out: Vec<(usize, [Vec2; 2])> = Vec::new();
        let mut last: Option<(usize, usize)> = None;
        for (part, c) in all {
            let count = self.altered.parts[part].contour.vertices.len();
            // One new segment between two old ones is cloth: an edge that spreads. A dart has two.
            let is_next = |s: usize| (0..=2).any(|k| (s + k) % count == c.segment);
            let goes_on = last.is_some_and(|(p, s)| p == part && is_next(s));
            match out.last_mut().filter(|_| goes_on) {
                Some(run) => run.1[1] = c.ends[1],
                None => out.push((part, c.ends)),
            }
            last = Some((part, c.segment));
        }
        out
    }

    /// The edges of the parts that lie on a walk along the old outline for more than a quarter of their length: the part,
    /// and both ends.
    fn edges_on(&self, from: f64, length: f64) -> Vec<(usize, [Vec2; 2])> {
        let ring = &self.shapes[self.id.index()].rings[0];
        let mut out = Vec::new();
        for (part, p) in self.altered.parts.iter().enumerate() {
            let carried = p.contour.carried(ring, from, length);
            for edge in p.contour.edges() {
                let on = |c: &&Carried| edge.contains(&c.segment);
                let covered: f64 = carried.iter().filter(on).map(|c| c.way[1] - c.way[0]).sum();
                let at = |k: usize| p.contour.vertices[k].at;
                let next = |k: usize| at((k + 1) % p.contour.vertices.len());
                let whole: f64 = edge.iter().map(|k| (next(*k) - at(*k)).norm()).sum();
                if covered > 0.25 * whole {
                    out.push((part, [at(edge[0]), next(edge[edge.len() - 1])]));
                }
            }
        }
        out
    }

    /// Named edges, and the attachments that speak of edges.
    fn names(&self) -> Result<(Vec<EdgeNameSpec>, Vec<AttachSpec>), Vec<Diagnostic>> {
        let plan = &self.garment.plan;
        let mut names: Vec<EdgeNameSpec> =
            plan.edge_names.iter().filter(|n| !self.is_it(n.run.piece())).cloned().collect();
        let mut attachments: Vec<AttachSpec> = Vec::new();
        let named = self.garment.pieces[self.id.index()].edges.iter().filter_map(|e| e.name.clone());
        let named = named.map(|name| (name.clone(), name));
        let tied = plan.attachments.iter().filter(|a| self.is_it(&a.piece)).map(|a| a.edge.clone());
        let tied = tied.map(|edge| (edge.clone(), by_number(&edge)));
        let mut given: Vec<(String, usize)> = Vec::new();
        for (label, name) in named.chain(tied) {
            if given.iter().any(|(l, _)| l.eq_ignore_ascii_case(&label)) {
                continue;
            }
            let run = RunSpec::Edge { piece: self.name.to_owned(), edge: label.clone() };
            let run = lookup::run(self.garment, self.shapes, &run, None).map_err(|e| vec![e])?;
            for (part, ends) in self.edges_on(run.span().0, run.walk(&self.shapes[self.id.index()])) {
                let run = self.points(part, ends, RunWay::Left);
                let known = names.iter().position(|n| n.run == run);
                let number = known.unwrap_or_else(|| {
                    let name = free_name(&names, run.piece(), &name);
                    names.push(EdgeNameSpec { run, name, source: None });
                    names.len() - 1
                });
                given.push((label.clone(), number));
            }
        }
        for attach in &plan.attachments {
            if !self.is_it(&attach.piece) {
                attachments.push(attach.clone());
                continue;
            }
            for (_, number) in given.iter().filter(|(l, _)| l.eq_ignore_ascii_case(&attach.edge)) {
                let edge = &names[*number];
                let tied = AttachSpec { piece: edge.run.piece().to_owned(), edge: edge.name.clone(), ..attach.clone() };
                // Edges that became one are held once.
                if !attachments.iter().any(|a| a.piece == tied.piece && a.edge == tied.edge && a.to == tied.to) {
                    attachments.push(tied);
                }
            }
        }
        Ok((names, attachments))
    }

    fn elastic(&self, spec: &ElasticSpec) -> Result<ElasticSpec, Vec<Diagnostic>> {
        let side = elastic_side(self.garment, self.shapes, spec).map_err(|e| vec![e])?;
        let along = if self.touches(&side) { self.side(&side) } else { spec.along.clone() };
        Ok(ElasticSpec { along, ..spec.clone() })
    }

    fn fold(&self, spec: &FoldSpec) -> FoldSpec {
        let carried = self.altered.carried(&spec.line).filter(|_| self.is_it(&spec.piece));
        carried.map_or_else(
            || spec.clone(),
            |(part, line)| FoldSpec { piece: self.altered.parts[part].name.clone(), line, ..spec.clone() },
        )
    }

    /// Where the parts start. Around the body a part lies where it lay in the whole piece.
    fn place(&self, spec: &PlaceSpec) -> Vec<PlaceSpec> {
        if !self.is_it(&spec.piece) {
            return vec![spec.clone()];
        }
        let old = self.garment.pieces[self.id.index()].outline.positions();
        let each = self.altered.parts.iter().map(|part| {
            let placement = match &spec.placement {
                Placement::Around(place) => Placement::Around(moved(place, &old, &part.contour.points())),
                other => other.clone(),
            };
            PlaceSpec { piece: part.name.clone(), placement, ..spec.clone() }
        });
        each.collect()
    }
}

/// The place of a part of a piece.
fn moved(place: &Around, old: &[Vec2], part: &[Vec2]) -> Around {
    let extent = |points: &[Vec2]| geom::bounds(points.iter().map(|p| geom::rotate(*p, place.turn)));
    let (Some((low, high)), Some((part_low, part_high))) = (extent(old), extent(part)) else { return place.clone() };
    let is_arm = place.segment.starts_with("arm");
    let higher = if is_arm { high.y - part_high.y } else { part_high.y - high.y };
    let shift = (part_low.x + part_high.x - low.x - high.x) / 2.0;
    Around { height: place.height + higher, shift: place.shift + shift, ..place.clone() }
}

/// The name that an edge gets which was meant by its number.
fn by_number(label: &str) -> String {
    if label.chars().all(|c| c.is_ascii_digit()) { format!("edge-{label}") } else { label.to_owned() }
}

/// The name, or the name with a number after a dot where another edge of the piece has it.
fn free_name(names: &[EdgeNameSpec], piece: &str, name: &str) -> String {
    let is_taken = |n: &str| names.iter().any(|e| e.run.piece() == piece && e.name == n);
    let numbered = (2..).map(|k| format!("{name}.{k}"));
    std::iter::once(name.to_owned()).chain(numbered).find(|n| !is_taken(n)).unwrap_or_default()
}
