//! Stage `export-gltf`: the garment as GLB, with the whole document inside.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;
use toile_formats::gltf::{self, WriteError};
use toile_garment::{Aspect, Garment};
use toile_stage_api::{Cost, Forecast, Stage, StageContext, StageError, StageInfo};

/// Writes a GLB.
pub struct ExportGltf;

/// Parameters of `export-gltf`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExportGltfParams {
    /// The GLB to write.
    #[schemars(extend("format" = "output-file"))]
    pub file: String,
}

impl Default for ExportGltfParams {
    fn default() -> Self {
        Self { file: "{out}/garment.glb".to_owned() }
    }
}

impl Stage for ExportGltf {
    type Params = ExportGltfParams;
    const INFO: StageInfo = StageInfo::new(
        "export-gltf",
        "writes the garment as GLB: a node for each piece, cloth coordinates, images, the document inside",
        &[Aspect::Mesh, Aspect::Stitched],
        &[],
        1,
    );

    fn forecast(
        &self,
        _: &Self::Params,
        forecast: &mut Forecast,
        _: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        Ok(forecast.by_triangles(0.005, 0.002, 1.0))
    }

    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let glb = gltf::write_garment(&garment).map_err(failure)?;
        cx.files.write(Path::new(&params.file), &glb)?;
        Ok(garment)
    }
}

fn failure(error: WriteError) -> StageError {
    match error {
        WriteError::NotFinite { .. } => StageError::Unstable(error.to_string()),
        WriteError::TooLarge => StageError::Limit(error.to_string()),
        other => StageError::Internal(other.to_string()),
    }
}
