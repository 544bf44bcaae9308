//! Stage `import-mesh`: a cloth mesh instead of a pattern, for physics cases and runs side by side with others.
//!
//! The garment gets one piece whose mesh holds the vertices of the OBJ in file order, to the end.

mod borders;
mod boundary;
pub(crate) mod codes;
mod forecast;
mod lists;
mod rest;
#[cfg(test)]
mod tests;
mod turned;

use crate::sewing::sewn_points::SewnPoints;
use crate::text::utf8;
use borders::Borders;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::path::Path;
use toile_formats::codes::BODY_SIZE;
use toile_formats::{body, fabric, obj};
use toile_garment::fabric::Fabric;
use toile_garment::garment::{Load, Pin, Shape, UpAxis};
use toile_garment::ids::{MeshVertex, PieceId, SeamId};
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::seam::{Seam, SeamKind, SeamRun, SeamSide, Stitch};
use toile_garment::{Aspect, Diagnostic, Garment, Piece, Severity, SourceRef, Vec3};
use toile_stage_api::{Cost, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

pub use rest::Rest;

/// Reads a cloth mesh.
pub struct ImportMesh;

/// Parameters of `import-mesh`. All files share the axes of the mesh; numbers in them are metres and newtons.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImportMeshParams {
    /// OBJ with the start positions, metres.
    #[schemars(extend("format" = "input-file"))]
    pub cloth: String,
    /// Where the rest shape comes from: the 3D `positions`, or `uv` (`vt` in metres, u along the weft, v along the
    /// warp).
    #[serde(default)]
    pub rest: Rest,
    /// Vertical axis of all files: `y` or `z`.
    #[serde(default)]
    pub up: UpAxis,
    /// Held vertices: one index from 0 a line, optionally x y z to hold it elsewhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub pins: Option<String>,
    /// Sewn vertices: two indices from 0 a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub stitches: Option<String>,
    /// Forces: index fx fy fz in N a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub loads: Option<String>,
    /// OBJ of the body; a TOML file beside it is read too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub body: Option<String>,
    /// Fabric file.
    #[schemars(extend("format" = "input-file"))]
    pub fabric: String,
}

impl Stage for ImportMesh {
    type Params = ImportMeshParams;
    const INFO: StageInfo = StageInfo::new(
        "import-mesh",
        "reads a cloth mesh with pins, stitches, loads, body and fabric instead of a pattern",
        &[],
        &[Aspect::Pieces, Aspect::Mesh, Aspect::Stitched, Aspect::Fabric],
        2,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        forecast.garment = self.run(params, Garment::default(), cx)?;
        forecast.mesh = forecast::measure(&forecast.garment);
        Ok(forecast.by_triangles(0.01, 0.005, 1.0))
    }

    fn run(&self, params: &Self::Params, _: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let mut input = Input { params, errors: Errors::default() };
        let cloth = input.cloth(cx);
        let fabric = input.fabric(cx);
        let body = input.body(cx);
        let count = cloth.as_ref().map_or(usize::MAX, |c| c.positions.len());
        let pins = input.list(cx, params.pins.as_deref(), |text, file| lists::pins(text, file, count));
        let sewn = input.list(cx, params.stitches.as_deref(), |text, file| lists::stitches(text, file, count));
        let loads = input.list(cx, params.loads.as_deref(), |text, file| lists::loads(text, file, count));
        input.errors.finish()?;
        let (Some(cloth), Some(fabric)) = (cloth, fabric) else {
            return Err(StageError::Internal("files that cannot be read have no fault".to_owned()));
        };
        let stitches: Vec<(u32, u32)> = sewn.iter().map(|s| s.pair).collect();
        let mut garment = one_piece(params, cloth, &stitches, cx)?;
        if params.rest == Rest::Positions && turns_with_grain(&fabric) {
            cx.report.push(rest::grain_note(&params.cloth));
        }
        garment.fabrics.insert(String::new(), fabric);
        garment.body = body;
        let up = params.up;
        let start = garment.stitched.as_ref().map_or_else(Vec::new, |s| s.positions.concat());
        let at = |v: u32, given: Option<Vec3>| given.map_or(start[v as usize], |p| up.from_file(p));
        garment.pins = pins.iter().map(|(v, p)| Pin { vertex: vertex(*v), at: at(*v, *p) }).collect();
        garment.loads = loads.iter().map(|(v, f)| Load { vertex: vertex(*v), force: up.from_file(*f) }).collect();
        if let Some(file) = params.stitches.as_deref().filter(|_| !stitches.is_empty()) {
            garment.seams.push(seam(&stitches, file));
            let ends = SewnPoints::new(&garment, &garment.seams).collapsed_side(&garment.pieces[0]);
            if let Some(ends) = ends {
                return Err(StageError::input(lists::collapsed(&sewn, ends, file)));
            }
        }
        if let Some(shape) = &mut garment.stitched {
            shape.welded = stitches.iter().all(|(a, b)| start[*a as usize] == start[*b as usize]);
        }
        Ok(garment)
    }
}

fn vertex(v: u32) -> MeshVertex {
    MeshVertex { piece: PieceId(0), vertex: v }
}

/// Does the direction of the grain matter to this fabric?
fn turns_with_grain(f: &Fabric) -> bool {
    f.stretch_warp != f.stretch_weft
        || f.bend_warp != f.bend_weft
        || f.bend_curve_warp != f.bend_curve_weft
        || f.bend_bias.is_some_and(|b| b != f.bend_warp)
}

/// Reads the input files; mistakes of all of them are collected.
struct Input<'a> {
    params: &'a ImportMeshParams,
    errors: Errors,
}

impl Input<'_> {
    fn keep<T>(&mut self, read: Result<T, Vec<Diagnostic>>) -> Option<T> {
        self.errors.keep(read.map_err(StageError::Input))
    }

    fn text(&mut self, cx: &mut StageContext<'_>, file: &str) -> Option<String> {
        let bytes = self.errors.keep(cx.files.read(Path::new(file)))?;
        self.errors.keep(utf8(Path::new(file), &bytes))
    }

    fn cloth(&mut self, cx: &mut StageContext<'_>) -> Option<obj::ObjMesh> {
        let file = &self.params.cloth;
        let bytes = self.errors.keep(cx.files.read(Path::new(file)))?;
        let cloth = self.keep(obj::read(&bytes, file))?;
        self.errors.inputs(repeated(&cloth, file).into_iter().collect());
        Some(cloth)
    }

    fn fabric(&mut self, cx: &mut StageContext<'_>) -> Option<Fabric> {
        let file = &self.params.fabric;
        let text = self.text(cx, file)?;
        self.keep(fabric::read(&text, file))
    }

    fn body(&mut self, cx: &mut StageContext<'_>) -> Option<toile_garment::body::Body> {
        let file = self.params.body.as_ref()?;
        let side = body::sidecar_name(file);
        let bytes = self.errors.keep(cx.files.read(Path::new(file)));
        let beside = self.errors.keep(cx.files.read_optional(Path::new(&side))).flatten();
        let beside = beside.and_then(|b| self.errors.keep(utf8(Path::new(&side), &b)));
        let mut read = self.keep(body::read(&bytes?, file, beside.as_deref()))?;
        // A body of a test scene, a ball or a disc, need not be as high as a person.
        let height = |d: &Diagnostic| d.code == BODY_SIZE && d.severity == Severity::Warning;
        read.findings.retain(|d| !height(d));
        cx.report.findings.append(&mut read.findings);
        body::turn(&mut read.body, self.params.up);
        Some(read.body)
    }

    fn list<T>(
        &mut self,
        cx: &mut StageContext<'_>,
        file: Option<&str>,
        read: impl Fn(&str, &str) -> Result<Vec<T>, Vec<Diagnostic>>,
    ) -> Vec<T> {
        let read = file.and_then(|file| {
            let text = self.text(cx, file)?;
            self.keep(read(&text, file))
        });
        read.unwrap_or_default()
    }
}

/// Triangles that have the vertices of an earlier one: one cloth in the place of another.
fn repeated(cloth: &obj::ObjMesh, file: &str) -> Option<Diagnostic> {
    let mut seen = BTreeSet::new();
    let mut again = cloth.triangles.iter().enumerate().filter(|(_, t)| {
        let mut key = **t;
        key.sort_unstable();
        // One with a vertex twice has no area: such triangles are left out and counted.
        key[0] != key[1] && key[1] != key[2] && !seen.insert(key)
    });
    let (first, _) = again.next()?;
    let message =
        format!("{} triangles stand in `{file}` again, the first of them is number {}", again.count() + 1, first + 1);
    let found = Diagnostic::error(codes::TRIANGLES_DOUBLE, message).at(SourceRef::file(file));
    Some(found.hint("remove double faces and export again; a second layer needs vertices of its own"))
}

/// The garment of one piece with mesh and start positions.
fn one_piece(
    params: &ImportMeshParams,
    mut cloth: obj::ObjMesh,
    stitches: &[(u32, u32)],
    cx: &mut StageContext<'_>,
) -> Result<Garment, StageError> {
    let file = params.cloth.as_str();
    let place = SourceRef::file(file);
    cx.report.findings.append(&mut cloth.findings);
    let positions: Vec<Vec3> = cloth.positions.iter().map(|p| params.up.from_file(*p)).collect();
    let mut built = rest::build(params.rest, file, &positions, &cloth).map_err(|d| StageError::input(*d))?;
    cx.report.findings.append(&mut built.findings);
    let borders = Borders::new(&built.mesh, &positions, file);
    if let Some(finding) = borders.junction().or_else(|| borders.doubled(stitches)) {
        return Err(StageError::input(finding));
    }
    if let Some(file) = &params.stitches {
        cx.report.findings.extend(turned::turned(&borders, stitches, file));
    }
    let loose = unused(positions.len(), &built.mesh.triangles);
    if loose > 0 {
        let message = format!("`{file}`: {loose} vertices belong to no triangle; they stay in the file and do nothing");
        cx.report.push(Diagnostic::warning(codes::VERTICES_UNUSED, message).at(place.clone()));
    }
    built.mesh.chains = boundary::chains(&built.mesh, file, &mut cx.report.findings);
    let points: Vec<LinePoint> = built
        .mesh
        .outline()
        .iter()
        .flat_map(|c| &c.vertices)
        .map(|v| LinePoint { at: built.mesh.rest[*v as usize], kind: PointKind::Plain })
        .collect();
    built.mesh.outline_vertex = built.mesh.outline().iter().flat_map(|c| &c.vertices).map(|v| Some(*v)).collect();
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let name = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let piece = Piece {
        name: name.to_owned(),
        block: name.to_owned(),
        outline: PieceLine { points, closed: true, ..PieceLine::default() },
        mesh: Some(built.mesh),
        source: Some(place),
        ..Piece::default()
    };
    Ok(Garment {
        style: name.to_owned(),
        pieces: vec![piece],
        stitched: Some(Shape { positions: vec![positions], sewn: false, welded: true, ..Shape::default() }),
        file_up: params.up,
        ..Garment::default()
    })
}

fn unused(count: usize, triangles: &[[u32; 3]]) -> usize {
    let mut used = vec![false; count];
    for v in triangles.iter().flatten() {
        if let Some(slot) = used.get_mut(*v as usize) {
            *slot = true;
        }
    }
    used.iter().filter(|u| !**u).count()
}

fn seam(stitches: &[(u32, u32)], file: &str) -> Seam {
    let side = |pick: fn(&(u32, u32)) -> u32| SeamSide {
        runs: vec![SeamRun { piece: PieceId(0), vertices: stitches.iter().map(pick).collect() }],
        // The pairs of a file follow no line: there is no length to compare.
        length: 0.0,
    };
    Seam {
        id: SeamId(0),
        name: "stitches".to_owned(),
        kind: SeamKind::Seam,
        a: side(|s| s.0),
        b: side(|s| s.1),
        ease: 0.0,
        gather: None,
        stitches: stitches.iter().map(|(a, b)| Stitch { a: vertex(*a), b: vertex(*b) }).collect(),
        source: Some(SourceRef::file(file)),
    }
}
