//! Stage `export-obj`: the garment as OBJ, and the forces on its pins as JSON.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::path::Path;
use toile_formats::obj::{self, GarmentObjError};
use toile_garment::garment::UpAxis;
use toile_garment::{Aspect, Code, Diagnostic, Garment};
use toile_stage_api::{Cost, Forecast, Stage, StageContext, StageError, StageInfo};

codes! {
    pub(crate) list CODES;

    /// `reactions` needs a drape, and there is none. Put `drape` before `export-obj`. Exit code 2.
    REACTIONS_MISSING = "reactions-missing";
}

/// Writes an OBJ.
pub struct ExportObj;

/// Parameters of `export-obj`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExportObjParams {
    /// The OBJ to write: pieces in order, each in the vertex order of its mesh; an imported mesh keeps its order.
    #[schemars(extend("format" = "output-file"))]
    pub file: String,
    /// Where to write the reaction force on every pin, in N, as JSON.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "output-file"))]
    pub reactions: Option<String>,
    /// Vertical axis of the file; that of the imported mesh when not given, else y.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub up: Option<UpAxis>,
}

impl Default for ExportObjParams {
    fn default() -> Self {
        Self { file: "{out}/garment.obj".to_owned(), reactions: None, up: None }
    }
}

impl Stage for ExportObj {
    type Params = ExportObjParams;
    const INFO: StageInfo = StageInfo::new(
        "export-obj",
        "writes the garment as OBJ in its own vertex order, and the forces on its pins",
        &[Aspect::Mesh, Aspect::Shape],
        &[],
        1,
    );

    fn forecast(
        &self,
        _: &Self::Params,
        forecast: &mut Forecast,
        _: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        Ok(forecast.by_triangles(0.005, 0.005, 1.0))
    }

    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let up = params.up.unwrap_or(garment.file_up);
        let text = obj::write_garment(&garment, up).map_err(failure)?;
        if let Some(file) = &params.reactions {
            let reactions = reactions(&garment, up)?;
            cx.files.write(Path::new(file), reactions.as_bytes())?;
        }
        cx.files.write(Path::new(&params.file), text.as_bytes())?;
        Ok(garment)
    }
}

/// The forces as JSON; `index` counts the vertices of the OBJ from 0.
fn reactions(garment: &Garment, up: UpAxis) -> Result<String, StageError> {
    if garment.reactions.len() != garment.pins.len() {
        let message = format!("there are {} pins but {} reaction forces", garment.pins.len(), garment.reactions.len());
        let finding = Diagnostic::error(REACTIONS_MISSING, message);
        return Err(StageError::parameter(finding.hint("put `drape` before `export-obj`, or leave `reactions` out")));
    }
    let counts = garment.pieces.iter().map(|p| p.mesh.as_ref().map_or(0, |m| m.rest.len()));
    let first: Vec<usize> = counts
        .scan(0, |sum, n| {
            let start = *sum;
            *sum += n;
            Some(start)
        })
        .collect();
    let pins: Vec<_> = garment
        .pins
        .iter()
        .zip(&garment.reactions)
        .map(|(pin, force)| {
            let (at, force) = (up.to_file(pin.at), up.to_file(*force));
            let start = first.get(pin.vertex.piece.index()).copied().unwrap_or(0);
            json!({ "index": start + pin.vertex.vertex as usize, "at_m": [at.x, at.y, at.z],
                    "force_N": [force.x, force.y, force.z] })
        })
        .collect();
    let mut text = serde_json::to_string_pretty(&json!({ "unit": "N", "pins": pins }))
        .map_err(|e| StageError::Internal(e.to_string()))?;
    text.push('\n');
    Ok(text)
}

fn failure(error: GarmentObjError) -> StageError {
    match error {
        GarmentObjError::NotFinite { .. } => StageError::Unstable(error.to_string()),
        other => StageError::Internal(other.to_string()),
    }
}
