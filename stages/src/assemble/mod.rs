//! `assemble`: seams and darts become vertex runs and stitches.

mod bands;
pub(crate) mod codes;
mod collapsed;
mod runs;
mod stitches;

use crate::sewing::resolve::{Limits, ResolvedSeam, Side, judged};
use crate::sewing::ring::Ring;
use crate::sewing::shapes::{Shapes, shapes};
use crate::solve::lines::fold_vertices;
use runs::run_vertices;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stitches::stitches;
use toile_garment::dart::DartKind;
use toile_garment::piece::PressedFold;
use toile_garment::seam::{Seam, SeamKind, SeamRun, SeamSide};
use toile_garment::units::Share;
use toile_garment::{Aspect, DartId, Diagnostic, Garment, Piece, SeamId};
use toile_stage_api::{Cost, EdgeLengths, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

/// Parameters of `assemble`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Largest difference in length of two sides that need not be declared, as a share of the shorter.
    pub max_ease: Share,
}

impl Default for Params {
    fn default() -> Self {
        Self { max_ease: Share(0.03) }
    }
}

/// The stage.
pub struct Assemble;

impl Stage for Assemble {
    type Params = Params;
    const INFO: StageInfo = StageInfo::new(
        "assemble",
        "sews meshes on paper: seams and darts become stitches, lengths and directions are checked",
        &[Aspect::Mesh],
        &[Aspect::Seams],
        1,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        let mut errors = Errors::default();
        let limits = errors.keep(limits(params)).unwrap_or(Limits { max_ease: Params::default().max_ease.0 });
        // Outlines that are no outlines are told by the stage that meshes them.
        if let Ok(shapes) = shapes(&forecast.garment) {
            let seams = judged(&forecast.garment, &shapes, &limits, cx.report).map_err(StageError::Parameter);
            forecast.edges = errors.keep(seams).map(|seams| edge_lengths(&shapes, &seams));
        }
        errors.finish()?;
        Ok(forecast.by_triangles(0.001, 0.001, 1.0))
    }

    fn run(&self, params: &Params, mut garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let limits = limits(params)?;
        let shapes = shapes(&garment).map_err(StageError::Input)?;
        let resolved = judged(&garment, &shapes, &limits, cx.report).map_err(StageError::Parameter)?;
        let mut seams = Vec::new();
        let mut errors = Vec::new();
        for seam in &resolved {
            match declared(&garment, &shapes, seam) {
                Ok(s) => seams.push(s),
                Err(e) => errors.push(e),
            }
        }
        for piece in &garment.pieces {
            for d in 0..piece.darts.len() {
                match dart(piece, d) {
                    Ok(s) => seams.extend(s),
                    Err(e) => errors.push(e),
                }
            }
        }
        errors.extend(garment.pieces.iter().flat_map(unfolded));
        if errors.is_empty() {
            errors = collapsed::check(&garment, &seams);
        }
        if !errors.is_empty() {
            return Err(StageError::Input(errors));
        }
        for (i, seam) in seams.iter_mut().enumerate() {
            seam.id = SeamId::from(i);
        }
        garment.bands = bands::bands(&garment, &shapes, &seams, cx.report).map_err(StageError::Input)?;
        garment.seams = seams;
        Ok(garment)
    }
}

/// The limits of the parameters, in range.
fn limits(params: &Params) -> Result<Limits, StageError> {
    let max_ease = params.max_ease.0;
    if max_ease.is_finite() && max_ease >= 0.0 {
        return Ok(Limits { max_ease });
    }
    let found = Diagnostic::error(codes::MAX_EASE, format!("max_ease cannot be {}", params.max_ease));
    Err(StageError::parameter(found.hint("e.g. max_ease = \"3 %\"")))
}

/// A declared seam on the meshes.
/// Lengths of free and of gathered edges.
fn edge_lengths(shapes: &Shapes, seams: &[ResolvedSeam]) -> EdgeLengths {
    let all: f64 = shapes.iter().filter_map(|s| s.rings.first()).map(Ring::without_gaps).sum();
    let sewn: f64 = seams.iter().map(|s| s.a.length + s.b.length).sum();
    let gathered = seams.iter().map(|s| (s.a.length - s.b.length).abs()).sum();
    EdgeLengths { free: (all - sewn).max(0.0), gathered }
}

fn declared(garment: &Garment, shapes: &Shapes, seam: &ResolvedSeam) -> Result<Seam, Diagnostic> {
    let side = |side: &Side| -> Result<SeamSide, Diagnostic> {
        let mut runs = Vec::new();
        for span in &side.spans {
            let piece = &garment.pieces[span.piece.index()];
            let vertices = run_vertices(piece, &shapes[span.piece.index()], span).ok_or_else(|| {
                let message = format!("seam `{}`: its ends on piece `{}` are no mesh vertices", seam.name, piece.name);
                Diagnostic::error(codes::SEAM_NOT_IN_MESH, message)
                    .at(seam.source.clone())
                    .hint("mesh the pieces with the sewing file they are sewn with")
            })?;
            runs.push(SeamRun { piece: span.piece, vertices });
        }
        Ok(SeamSide { runs, length: side.length })
    };
    let (a, b) = (side(&seam.a)?, side(&seam.b)?);
    let stitches = stitches(&a, &b).map_err(|e| e.finding(&seam.name).at(seam.source.clone()))?;
    Ok(Seam {
        id: SeamId(0),
        name: seam.name.clone(),
        kind: SeamKind::Seam,
        ease: a.length - b.length,
        a,
        b,
        gather: seam.gather,
        stitches,
        source: seam.source.clone(),
    })
}

/// Folds of a piece that its mesh does not have.
fn unfolded(piece: &Piece) -> impl Iterator<Item = Diagnostic> + '_ {
    let missing = |fold: &&PressedFold| piece.mesh.as_ref().is_some_and(|m| fold_vertices(m, &fold.line).len() < 2);
    piece.folds.iter().filter(missing).map(|fold| {
        let message = format!("piece `{}`: the mesh has no edges along fold `{}`", piece.name, fold.name);
        Diagnostic::error(codes::FOLD_NOT_IN_MESH, message)
            .at(piece.source.clone())
            .hint("let its line run over cloth of the piece, in the coordinates of the piece")
    })
}

/// A dart as a seam; none for a dart that takes nothing away.
fn dart(piece: &Piece, d: usize) -> Result<Option<Seam>, Diagnostic> {
    let dart = &piece.darts[d];
    let Some(mesh) = &dart.mesh else { return Ok(None) };
    let side = |leg: usize| SeamSide {
        runs: vec![SeamRun { piece: piece.id, vertices: mesh.legs[leg].clone() }],
        length: dart.leg_length(leg),
    };
    let (a, b) = (side(0), side(1));
    let name = format!("{} {}", piece.name, dart.name);
    let pairs = if dart.kind == DartKind::Pleat && mesh.legs[0].len() == 1 {
        stitches::pair(piece.id, mesh.legs[0][0], mesh.legs[1][0])
    } else {
        stitches(&a, &b).map_err(|e| e.finding(&name).at(dart.source.clone()))?
    };
    Ok(Some(Seam {
        id: SeamId(0),
        name,
        kind: SeamKind::Dart { piece: piece.id, dart: DartId::from(d) },
        ease: a.length - b.length,
        a,
        b,
        gather: None,
        stitches: pairs,
        source: dart.source.clone(),
    }))
}

#[cfg(test)]
mod tests;
