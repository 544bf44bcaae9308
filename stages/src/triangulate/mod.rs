//! `triangulate`: pieces become meshes. Outlines, darts and folds are chains of mesh edges.
//!
//! Other internal lines do not act on the cloth, so the mesh does not follow them; they lie on its triangles. Corners,
//! notches, mouths, apexes, the widest places of fish-eye darts and seam ends become vertices. Both sides of a seam and
//! both legs of a dart get equal counts between them. Inside lies a hexagonal lattice turned off the grain. It is joined
//! by a constrained Delaunay triangulation and smoothed, and what stays bad is mended in patches.

mod cdt;
mod check;
pub(crate) mod codes;
mod counts;
pub(crate) mod crossing;
mod curve;
mod edge_use;
mod forecast;
mod lattice;
mod layout;
mod lines;
mod lyon;
mod net;
mod patch;
mod region;
mod regular;
mod repair;
mod size;
mod smooth;
mod write;

use crate::sewing::resolve::{ResolvedSeam, find, placed};
use crate::sewing::shapes::{Shapes, mm, shapes};
use counts::Counts;
use curve::CurveKind;
use layout::Layout;
use net::Net;
pub(crate) use net::ONE_PLACE;
use regular::{FillError, Filled};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use toile_garment::units::{Angle, Length};
use toile_garment::{Aspect, Diagnostic, Garment, Piece, Report, Vec2};
use toile_stage_api::{Cost, Forecast, Knob, Meaning, Stage, StageContext, StageError, StageInfo};

/// Tries at finer lines before a crossing of sampled lines is an error.
const TRIES: usize = 5;

/// How the inside is filled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Mesher {
    /// Near-equilateral triangles: for draping.
    #[default]
    Regular,
    /// lyon's fill, its triangles halved: narrower triangles, fold lines are not kept; a draft to look at.
    Lyon,
}

/// Parameters of `triangulate`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Length of a mesh edge (particle distance), e.g. "12 mm"; 12 mm when `triangles` is not given either.
    pub edge_length: Option<Length>,
    /// Number of triangles wanted for the whole garment, instead of an edge length.
    pub triangles: Option<u32>,
    /// How the inside is filled.
    pub mesher: Mesher,
    /// Angle of the lattice's rows to the weft: off the grain, or creases follow the yarns.
    pub angle: Angle,
}

impl Default for Params {
    fn default() -> Self {
        Self { edge_length: None, triangles: None, mesher: Mesher::Regular, angle: Angle(15_f64.to_radians()) }
    }
}

/// The stage.
pub struct Triangulate;

impl Stage for Triangulate {
    type Params = Params;
    const INFO: StageInfo = StageInfo::new(
        "triangulate",
        "meshes every piece; outlines, darts and folds become chains of edges, seam sides and dart legs get equal counts",
        &[Aspect::Pieces],
        &[Aspect::Mesh],
        2,
    );

    const KNOBS: &'static [Knob] = &[Knob::in_place_of("triangles", Meaning::EdgeLength, "edge_length")];

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        _: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        forecast.mesh = forecast::mesh(params, &forecast.garment)?;
        Ok(forecast.by_triangles(0.01, 0.01, 1.0))
    }

    fn run(&self, params: &Params, mut garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let shapes = shapes(&garment).map_err(StageError::Input)?;
        // What the seams look like is told by `assemble`; here they only have to be found.
        let seams = placed(find(&garment, &shapes)).map_err(StageError::Parameter)?;
        size::check_pieces(&garment, &shapes)?;
        let h = size::edge_length(params, &garment, &shapes)?;
        let (net, meshed) = mesh_with_lines(&garment, &shapes, &seams, h, params, cx)?;
        for ((piece, shape), (layout, filled)) in garment.pieces.iter_mut().zip(&shapes).zip(meshed) {
            let quality = check::quality(&layout, &filled.0, &filled.1);
            for finding in check::findings(piece, &quality, params.mesher == Mesher::Lyon) {
                if finding.severity == toile_garment::Severity::Error {
                    return Err(StageError::input(finding));
                }
                cx.report.push(finding);
            }
            write::write(piece, shape, &net.curves[piece.id.index()], &layout, filled);
        }
        Ok(garment)
    }
}

/// Meshes all pieces. Fold lines that cannot be told from their neighbours at any sampling are left out, and said.
fn mesh_with_lines(
    garment: &Garment,
    shapes: &Shapes,
    seams: &[ResolvedSeam],
    h: f64,
    params: &Params,
    cx: &mut StageContext<'_>,
) -> Result<(Net, Vec<(Layout, Filled)>), StageError> {
    let mut left_out = BTreeSet::new();
    loop {
        let mut notes = Report::default();
        let net = net::build(garment, shapes, seams, h, &left_out, &mut notes).map_err(StageError::Input)?;
        let mut counts = counts::counts(&net, h);
        size::check_total(counts.total())?;
        match mesh_all(garment, &net, &mut counts, h, params, cx)? {
            Meshed::All(meshed) => {
                notes.findings.into_iter().for_each(|note| cx.report.push(note));
                return Ok((net, meshed));
            }
            Meshed::Crossed { errors, lines } => {
                let known = left_out.len();
                left_out.extend(lines);
                if left_out.len() == known {
                    return Err(StageError::Input(errors));
                }
            }
        }
    }
}

/// Meshes of all pieces, or what is in their way.
enum Meshed {
    /// Layout and triangles of every piece.
    All(Vec<(Layout, Filled)>),
    /// Crossings that finer edges do not part, and the fold lines among them: piece and line.
    Crossed { errors: Vec<Diagnostic>, lines: BTreeSet<(usize, usize)> },
}

/// Meshes all pieces; sampled lines that cross are sampled finer, together with all they are sewn to.
fn mesh_all(
    garment: &Garment,
    net: &Net,
    counts: &mut Counts,
    h: f64,
    params: &Params,
    cx: &mut StageContext<'_>,
) -> Result<Meshed, StageError> {
    for attempt in 0..TRIES {
        let mut done = Vec::new();
        let mut errors = Vec::new();
        let mut lines = BTreeSet::new();
        let mut finer = std::collections::BTreeMap::new();
        for piece in &garment.pieces {
            if cx.cancelled() {
                return Err(StageError::Cancelled);
            }
            cx.progress.update(done.len() as u64, garment.pieces.len() as u64, &piece.name);
            let p = piece.id.index();
            let layout = layout::layout(p, &net.curves[p], counts);
            match mesh_piece(&layout, piece, h, params) {
                Ok(filled) => done.push((layout, filled)),
                Err(crossed) => {
                    errors.push(crossing_error(piece, &layout, &crossed));
                    for (k, i) in crossed {
                        if let CurveKind::Line(line) = net.curves[p][k].kind {
                            lines.insert((p, line));
                        }
                        let s = layout.stretch[k].get(i).copied().unwrap_or(0);
                        finer.insert(counts.group((p, k), s), ((p, k), s));
                    }
                }
            }
        }
        if errors.is_empty() {
            return Ok(Meshed::All(done));
        }
        if attempt + 1 == TRIES || finer.is_empty() {
            return Ok(Meshed::Crossed { errors, lines });
        }
        for (at, s) in finer.into_values() {
            counts.halve(at, s);
        }
        size::check_total(counts.total())?;
    }
    Err(StageError::Internal("meshing ended without an answer".to_owned()))
}

/// Meshes one piece, or tells the edges (curve, number) that cross or touch.
fn mesh_piece(layout: &Layout, piece: &Piece, h: f64, params: &Params) -> Result<Filled, Vec<(usize, usize)>> {
    let (edges, repeated) = layout.all_edges();
    if !repeated.is_empty() {
        return Err(repeated);
    }
    let filled = match params.mesher {
        Mesher::Regular => regular::fill(layout, &edges, h, rows(piece, params.angle.0)),
        Mesher::Lyon => lyon::fill(layout, h),
    };
    filled.map_err(|e| match e {
        FillError::Conflicts(list) | FillError::Touches(list) => edges_of(layout, &list),
        FillError::Points => Vec::new(),
    })
}

/// Direction of the lattice's rows: the weft, turned.
fn rows(piece: &Piece, angle: f64) -> Vec2 {
    let warp = piece.warp();
    let weft = Vec2::new(warp.y, -warp.x);
    let (sin, cos) = libm::sincos(angle);
    Vec2::new(cos * weft.x - sin * weft.y, sin * weft.x + cos * weft.y)
}

/// Curve and number of edges given by their vertices; edges that share a vertex with them where they are none.
fn edges_of(layout: &Layout, list: &[[u32; 2]]) -> Vec<(usize, usize)> {
    let mut out = Vec::new();
    for k in 0..layout.chains.len() {
        for (i, [a, b]) in layout.edges(k).enumerate() {
            let is = |e: &[u32; 2]| (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
            if list.iter().any(is) {
                out.push((k, i));
            }
        }
    }
    if out.is_empty() {
        for k in 0..layout.chains.len() {
            for (i, edge) in layout.edges(k).enumerate() {
                if list.iter().flatten().any(|v| edge.contains(v)) {
                    out.push((k, i));
                }
            }
        }
    }
    out
}

fn crossing_error(piece: &Piece, layout: &Layout, crossed: &[(usize, usize)]) -> Diagnostic {
    let places: Vec<String> = crossed
        .iter()
        .take(4)
        .filter_map(|(k, i)| layout.edges(*k).nth(*i))
        .map(|[a, b]| mm((layout.points[a as usize] + layout.points[b as usize]) * 0.5))
        .collect();
    Diagnostic::error(
        codes::LINES_CROSS,
        format!("piece `{}`: lines cross or touch when meshed, near {}", piece.name, places.join(", ")),
    )
    .at(piece.source.clone())
    .hint("use a shorter edge_length, or redraw the lines apart")
}

#[cfg(test)]
mod tests;
