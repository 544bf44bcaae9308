//! Drawn pieces into the garment document: unfolded, in metres.

use super::chain::Path;
use super::darts::{DrawnDart, Form};
use super::geom;
use super::notches::DrawnNotch;
use super::outline::{Marks, Node, Outline};
use super::pattern::Pattern;
use super::piece::{DrawnPiece, RefusedPiece};
use super::sheet::Drill;
use super::tolerances::Tolerances;
use super::unfold::Fold;
use super::write::{DrawPoint, sparse};
use crate::rul::RuleTable;
use std::borrow::Cow;
use std::collections::BTreeSet;
use toile_garment::dart::{Dart, DartEvidence, DartKind};
use toile_garment::notch::Notch;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::piece::{DrawnVertices, DrillHole, PieceText};
use toile_garment::{Diagnostic, Garment, Piece, PieceId, SourceRef, Vec2};

/// Metres per millimetre.
pub(super) const M: f64 = 1e-3;

impl Pattern {
    /// The garment in one size: as asked, else the sample size, else the only one. A size that is not drawn is graded
    /// when the rule table has it. The findings of the choice come with it.
    ///
    /// # Errors
    /// The size is not there (all sizes are listed), or a grade rule is missing.
    pub fn to_garment(
        &self,
        size: Option<&str>,
        rul: Option<&RuleTable>,
    ) -> Result<(Garment, Vec<Diagnostic>), Vec<Diagnostic>> {
        let chosen = self.choose(size, rul)?;
        let pieces = chosen
            .pieces
            .iter()
            .zip(names(&chosen.pieces))
            .enumerate()
            .map(|(i, (drawn, name))| Piece { id: PieceId::from(i), name, ..to_piece(drawn, &self.file) })
            .collect();
        let garment =
            Garment { style: self.style.clone().unwrap_or_default(), size: chosen.size, pieces, ..Garment::default() };
        Ok((garment, chosen.findings))
    }

    /// The garment in several sizes, in the order asked for. It holds every piece in each, called `piece@size`, and
    /// pieces of no size once. The size of the garment is the sample size if it is among them, else the first.
    ///
    /// # Errors
    /// As [`Self::to_garment`], for each size.
    pub fn to_garment_in_sizes(
        &self,
        sizes: &[String],
        rul: Option<&RuleTable>,
    ) -> Result<(Garment, Vec<Diagnostic>), Vec<Diagnostic>> {
        let mut all = Garment { style: self.style.clone().unwrap_or_default(), ..Garment::default() };
        let (mut findings, mut errors) = (Vec::new(), Vec::new());
        let mut names = BTreeSet::new();
        for size in sizes {
            match self.to_garment(Some(size), rul) {
                Ok((one, told)) => {
                    findings.extend(told);
                    for mut piece in one.pieces {
                        let Some(own) = &piece.size else {
                            if names.insert(piece.name.clone()) {
                                piece.id = PieceId::from(all.pieces.len());
                                all.pieces.push(piece);
                            }
                            continue;
                        };
                        piece.name = format!("{}@{own}", piece.name);
                        if names.insert(piece.name.clone()) {
                            piece.id = PieceId::from(all.pieces.len());
                            all.pieces.push(piece);
                        }
                    }
                }
                Err(list) => errors.extend(list),
            }
        }
        let sample = self.sample_size.as_ref().filter(|s| sizes.iter().any(|w| w.eq_ignore_ascii_case(s)));
        all.size = sample.or(sizes.first()).cloned();
        if errors.is_empty() { Ok((all, findings)) } else { Err(errors) }
    }
}

/// The names of pieces in a garment: each once.
pub(super) fn names(pieces: &[Cow<'_, DrawnPiece>]) -> Vec<String> {
    let mut taken = BTreeSet::new();
    pieces.iter().map(|p| unique(p.label().to_owned(), &mut taken)).collect()
}

fn unique(name: String, taken: &mut BTreeSet<String>) -> String {
    let mut candidate = name.clone();
    let mut n = 2;
    while !taken.insert(candidate.clone()) {
        candidate = format!("{name}-{n}");
        n += 1;
    }
    candidate
}

/// One piece, unfolded, in metres.
#[must_use]
pub fn to_piece(drawn: &DrawnPiece, file: &str) -> Piece {
    let source = |line: u64, layer: &str| {
        let mut s = SourceRef::file(file).at_line(line);
        s.block = Some(drawn.block.clone());
        s.layer = Some(layer.to_owned());
        Some(s)
    };
    let fold = drawn.axes.fold.map(Fold);
    let mut sewn = drawn.sewn().clone();
    let mut darts = drawn.darts.clone();
    anchor_marked(&mut sewn, &mut darts, fold);
    let nodes = whole(&sewn, fold);
    let sewn_layer = if drawn.sew.is_some() { "14" } else { "1" };
    let outline = closed_line(&nodes, source(sewn.line, sewn_layer));
    let cut_nodes = drawn.sew.as_ref().map(|_| whole(&drawn.boundary, fold));
    let cut_line = cut_nodes.as_ref().map(|nodes| closed_line(nodes, source(drawn.boundary.line, "1")));
    let vertices = drawn_vertices(drawn, &nodes, cut_nodes.as_deref(), fold);
    let marks = Marks::new(&drawn.points.turn_list, &drawn.points.curve_list, &Tolerances::default());
    let source_of_cutout = |p: &Path| source(p.line, cutout_layer(drawn, &p.ids));
    let kind = |p: Vec2| match (marks.kind(p), fold) {
        (PointKind::Plain, Some(fold)) => marks.kind(fold.mirror(p)),
        (kind, _) => kind,
    };
    if let Some(fold) = fold {
        let mirrored: Vec<DrawnDart> = darts.iter().filter(|d| !on_fold(fold, d)).map(|d| fold.dart(d)).collect();
        darts.extend(mirrored);
    }
    let layer_of_dart = |d: &DrawnDart| if d.form == Form::Wedge { sewn_layer } else { dart_layer(drawn, d) };
    let text = |key: &str| drawn.texts.keys.get(key).filter(|v| !v.is_empty()).cloned();
    Piece {
        name: drawn.label().to_owned(),
        block: drawn.block.clone(),
        size: drawn.size.clone(),
        quantity: drawn.texts.quantity,
        material: text("material").or_else(|| text("fabric")),
        category: text("category"),
        annotation: text("annotation"),
        edges: outline.edges(),
        outline,
        cut_line,
        drawn: Some(vertices).filter(|v| *v != DrawnVertices::default()),
        notches: notches(drawn, fold).into_iter().map(|n| notch(&n, source(n.line, "4"))).collect(),
        drill_holes: drills(drawn, fold).iter().map(|d| drill_hole(d, source(d.line, "13"))).collect(),
        grain: drawn.axes.grain.map(|g| g.map(|p| p * M)),
        fold: fold.map(|f| f.with_left(&drawn.boundary.positions()).map(|p| p * M)),
        internal_lines: internals(drawn, fold).into_iter().map(|p| open_line(&p, &kind, source(p.line, "8"))).collect(),
        cutouts: cutouts(drawn, fold).iter().map(|p| open_line(p, &kind, source_of_cutout(p))).collect(),
        match_lines: match_lines(drawn, fold, &source),
        darts: darts.iter().zip(0..).map(|(d, i)| dart(d, i, source(d.line, layer_of_dart(d)))).collect(),
        texts: texts(drawn),
        source: Some(SourceRef { block: Some(drawn.block.clone()), ..SourceRef::file(file).at_line(drawn.line) }),
        ..Piece::default()
    }
}

fn drill_hole(drill: &Drill, source: Option<SourceRef>) -> DrillHole {
    DrillHole { at: drill.at * M, diameter: drill.diameter.map(|d| d * M), source }
}

/// The vertices of the drawing that a file told, on the sewn outline and on the cut line.
fn drawn_vertices(drawn: &DrawnPiece, sewn: &[Node], cut: Option<&[Node]>, fold: Option<Fold>) -> DrawnVertices {
    DrawnVertices {
        outline: untold(drawn.sewn(), sewn, fold),
        cut_line: cut.map(|nodes| untold(&drawn.boundary, nodes, fold)).unwrap_or_default(),
    }
}

/// The lines of a piece that cannot be used, in metres, to be looked at. `None` where it has none.
pub(crate) fn refused_piece(refused: &RefusedPiece) -> Option<Piece> {
    let (first, others) = refused.lines.split_first()?;
    let name = format!("{} {} (cannot be used)", refused.label(), refused.size.as_deref().unwrap_or_default());
    Some(Piece {
        name,
        block: refused.block.clone(),
        size: refused.size.clone(),
        outline: open_line(first, &plain, None),
        internal_lines: others.iter().map(|p| open_line(p, &plain, None)).collect(),
        ..Piece::default()
    })
}

/// Texts without meaning, where they stand.
fn texts(drawn: &DrawnPiece) -> Vec<PieceText> {
    let text =
        |(at, layer, text): &(Vec2, String, String)| PieceText { at: at * M, layer: layer.clone(), text: text.clone() };
    drawn.texts.others.iter().map(text).collect()
}

/// The mouth of a marked dart becomes two vertices of the outline, so that its pointers have something to point to.
fn anchor_marked(sewn: &mut Outline, darts: &mut [DrawnDart], fold: Option<Fold>) {
    let half = sewn.positions();
    for dart in darts.iter_mut().filter(|d| d.form == Form::Marked) {
        // The half piece holds one mouth point of a dart on the fold.
        let fold = fold.filter(|f| on_fold(*f, dart));
        let off = dart.mouth.map(|m| geom::distance(m, &half, true));
        let mine = usize::from(off[1] < off[0]);
        let anchored = sewn.insert_work(dart.mouth[mine]);
        for leg in 0..2 {
            let at = match fold {
                _ if leg == mine => anchored,
                Some(fold) => fold.mirror(anchored),
                None => sewn.insert_work(dart.mouth[leg]),
            };
            dart.mouth[leg] = at;
            if let Some(first) = dart.work[leg].first_mut() {
                *first = at;
            }
        }
    }
}

fn whole(outline: &Outline, fold: Option<Fold>) -> Vec<Node> {
    fold.and_then(|f| f.outline(&outline.work)).unwrap_or_else(|| outline.work.clone())
}

fn closed_line(nodes: &[Node], source: Option<SourceRef>) -> PieceLine {
    let points = nodes.iter().map(|n| LinePoint { at: n.at * M, kind: n.kind }).collect();
    PieceLine { points, closed: true, name: None, source }
}

fn open_line(path: &Path, kind: &dyn Fn(Vec2) -> PointKind, source: Option<SourceRef>) -> PieceLine {
    let points = path.points.iter().map(|(at, _)| LinePoint { at: at * M, kind: kind(*at) }).collect();
    PieceLine { points, closed: path.closed, name: None, source }
}

/// The layer on which a cutout is drawn.
fn cutout_layer(drawn: &DrawnPiece, ids: &[u32]) -> &'static str {
    if ids.iter().any(|id| drawn.inside.on_boundary_layer.contains(id)) { "1" } else { "11" }
}

/// The layer on which the lines of a dart inside the piece are drawn.
fn dart_layer(drawn: &DrawnPiece, dart: &DrawnDart) -> &'static str {
    let cut_out = drawn.inside.cutouts.iter().any(|p| p.ids.iter().any(|id| dart.ids.contains(id)));
    if cut_out { cutout_layer(drawn, &dart.ids) } else { "8" }
}

/// No vertex of the line is marked.
fn plain(_: Vec2) -> PointKind {
    PointKind::Plain
}

/// The vertices of a line as drawn, unfolded; none where the working line tells them.
fn untold(outline: &Outline, work: &[Node], fold: Option<Fold>) -> Vec<LinePoint> {
    let nodes = outline.without_cut_notches();
    let mut nodes = fold.and_then(|f| f.outline(&nodes)).unwrap_or(nodes);
    if let Some(fold) = fold {
        smooth_over(fold, &mut nodes, work);
    }
    let points = |nodes: &[Node]| nodes.iter().map(|n| DrawPoint { at: n.at, kind: n.kind }).collect::<Vec<_>>();
    let drawn = points(&nodes);
    if sparse::sparse(&points(work), true, sparse::CLOSE).points == drawn {
        return Vec::new();
    }
    drawn.into_iter().map(|p| LinePoint { at: p.at * M, kind: p.kind }).collect()
}

/// The vertices on the fold are corners where the working line has corners; between curve points they are curve points.
fn smooth_over(fold: Fold, nodes: &mut [Node], work: &[Node]) {
    let n = nodes.len();
    for i in (0..n).filter(|i| fold.passes(nodes[*i].at)).collect::<Vec<_>>() {
        let corner = work.iter().any(|w| w.at == nodes[i].at && w.kind == PointKind::Turn);
        let beside = [nodes[(i + n - 1) % n].kind, nodes[(i + 1) % n].kind];
        nodes[i].kind = if corner {
            PointKind::Turn
        } else if beside == [PointKind::Curve; 2] {
            PointKind::Curve
        } else {
            PointKind::Plain
        };
    }
}

/// Does a dart lie on the fold, so that it is its own mirror image?
fn on_fold(fold: Fold, dart: &DrawnDart) -> bool {
    dart.apexes.iter().all(|p| fold.passes(*p))
}

/// Away from the fold: what lies on it, or beside it by rounding, is its own mirror image. Marks are put onto it.
fn beside(fold: Fold, points: &[Vec2]) -> bool {
    points.iter().any(|p| !fold.passes(*p))
}

fn notches(drawn: &DrawnPiece, fold: Option<Fold>) -> Vec<DrawnNotch> {
    let mut list = drawn.notches.clone();
    if let Some(fold) = fold {
        let d = fold.0[1] - fold.0[0];
        let axis = libm::atan2(d.y, d.x);
        list.iter_mut().filter(|n| fold.passes(n.at)).for_each(|n| n.at = fold.onto(n.at));
        let mirrored: Vec<DrawnNotch> = list
            .iter()
            .filter(|n| beside(fold, &[n.at]))
            .map(|n| DrawnNotch { at: fold.mirror(n.at), angle: n.angle.map(|a| 2.0 * axis - a), ..n.clone() })
            .collect();
        list.extend(mirrored);
    }
    list
}

fn notch(n: &DrawnNotch, source: Option<SourceRef>) -> Notch {
    Notch {
        kind: n.kind,
        at: n.at * M,
        depth: n.depth * M,
        width: n.width * M,
        angle: n.angle,
        on: n.on.to_owned(),
        name: None,
        source,
    }
}

fn drills(drawn: &DrawnPiece, fold: Option<Fold>) -> Vec<Drill> {
    let mut list = drawn.inside.drills.clone();
    if let Some(fold) = fold {
        list.iter_mut().filter(|d| fold.passes(d.at)).for_each(|d| d.at = fold.onto(d.at));
        let mirrored: Vec<Drill> =
            list.iter().filter(|d| beside(fold, &[d.at])).map(|d| Drill { at: fold.mirror(d.at), ..*d }).collect();
        list.extend(mirrored);
    }
    list
}

/// Stripe and plaid lines, named after their layer.
fn match_lines(
    drawn: &DrawnPiece,
    fold: Option<Fold>,
    source: &dyn Fn(u64, &str) -> Option<SourceRef>,
) -> Vec<PieceLine> {
    let mut out = Vec::new();
    for (layer, path) in &drawn.inside.stripes {
        let name = if layer.trim() == "10" { "plaid" } else { "stripe" };
        let twin = fold.and_then(|f| mirrored_path(path, f));
        for path in std::iter::once(path).chain(twin.as_ref()) {
            out.push(PieceLine { name: Some(name.into()), ..open_line(path, &plain, source(path.line, layer)) });
        }
    }
    out
}

/// A line counts as its own mirror image if each of its points has an image among them within this, mm.
const SAME_IMAGE: f64 = 0.05;

/// The mirror image of a line; none for a line on the fold and for one that is its own image.
fn mirrored_path(path: &Path, fold: Fold) -> Option<Path> {
    let points = path.positions();
    let has_image = |p: &Vec2| points.iter().any(|q| (fold.mirror(*p) - q).norm() <= SAME_IMAGE);
    if !beside(fold, &points) || points.iter().all(has_image) {
        return None;
    }
    Some(Path { points: path.points.iter().map(|(p, own)| (fold.mirror(*p), *own)).collect(), ..path.clone() })
}

fn internals(drawn: &DrawnPiece, fold: Option<Fold>) -> Vec<Path> {
    let is_leg = |p: &Path| drawn.darts.iter().any(|d| d.ids.iter().any(|id| p.ids.contains(id)));
    let mut list = Vec::new();
    for (i, path) in drawn.inside.internal.iter().enumerate().filter(|(_, p)| !is_leg(p)) {
        list.push(path.clone());
        let once = drawn.inside.not_mirrored.get(i).copied().unwrap_or(false);
        list.extend(fold.filter(|_| !once).and_then(|f| mirrored_path(path, f)));
    }
    list
}

fn cutouts(drawn: &DrawnPiece, fold: Option<Fold>) -> Vec<Path> {
    let is_leg = |p: &Path| drawn.darts.iter().any(|d| d.ids.iter().any(|id| p.ids.contains(id)));
    let mut list = Vec::new();
    for path in drawn.inside.cutouts.iter().filter(|p| !is_leg(p)) {
        list.push(path.clone());
        list.extend(fold.and_then(|f| mirrored_path(path, f)));
    }
    list
}

fn dart(d: &DrawnDart, index: usize, source: Option<SourceRef>) -> Dart {
    let metres = |line: &Vec<Vec2>| line.iter().map(|p| p * M).collect::<Vec<_>>();
    let (kind, evidence) = match d.form {
        Form::Wedge => (DartKind::Wedge, DartEvidence::BoundaryWedge),
        Form::Marked => (DartKind::MarkedWedge, DartEvidence::InternalLine),
        Form::Lens => (DartKind::FishEye, DartEvidence::Contour),
    };
    // A wedge is sewn from the edge on, a lens that is open to the edge too.
    let mouth = match (d.form, d.work[0].first(), d.work[1].first()) {
        (Form::Wedge, Some(a), Some(b)) => [*a, *b],
        _ => d.mouth,
    };
    Dart {
        name: format!("dart-{}", index + 1),
        kind,
        evidence,
        apexes: d.apexes.iter().map(|p| p * M).collect(),
        mouth: mouth.map(|p| p * M),
        legs: [metres(&d.work[0]), metres(&d.work[1])],
        line: d.on.to_owned(),
        depth: None,
        mesh: None,
        source,
    }
}
