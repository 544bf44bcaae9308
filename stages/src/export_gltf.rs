//! Stage `export-gltf`: the garment as GLB, with the whole document inside.

use crate::export_picture::ColoursParam;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;
use toile_formats::gltf::{self, Carried, Wishes, WriteError};
use toile_garment::{Aspect, Garment};
use toile_stage_api::{Cost, Forecast, Stage, StageContext, StageError, StageInfo};

/// Writes a GLB.
pub struct ExportGltf;

/// The garment document in the GLB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DocumentParam {
    /// Packed: small, read by `flatten` and `inspect`.
    #[default]
    Packed,
    /// JSON text, for programs that read it themselves.
    Plain,
    /// None: the pattern stays at home, and the GLB cannot be flattened.
    Nothing,
}

/// The meaning of texture coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UvParam {
    /// Metres of cloth.
    #[default]
    Metres,
    /// Repeats of the bitmap.
    Repeats,
}

/// A compression of the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CompressionParam {
    /// None: every program reads it.
    #[default]
    None,
    /// `EXT_meshopt_compression`.
    Meshopt,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// Parameters of `export-gltf`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExportGltfParams {
    /// The GLB to write.
    #[schemars(extend("format" = "output-file"))]
    pub file: String,
    /// The garment document inside: `packed`, `plain` or `nothing`.
    pub document: DocumentParam,
    /// Adds the body as a node of its own.
    pub body: bool,
    /// Adds the wrong side of the cloth, as far behind the right one as the fabric is thick, and the edges between.
    pub thickness: bool,
    /// Adds lines: seams, darts and free edges.
    pub lines: bool,
    /// Texture coordinates: `metres` of cloth, which viewers repeat by KHR_texture_transform, or `repeats` of the bitmap, for
    /// viewers without that extension.
    #[serde(skip_serializing_if = "is_default")]
    pub uv: UvParam,
    /// `none`, or `meshopt`: vertices and triangles are packed by EXT_meshopt_compression, for the web. Places are rounded
    /// to 0.03 mm. This program does not read such a file; `document = "nothing"` makes it smaller still.
    #[serde(skip_serializing_if = "is_default")]
    pub compression: CompressionParam,
    /// Meaning of the colours: `cloth`, or a map of `export-picture`, as colours of the vertices.
    pub colours: ColoursParam,
}

impl Default for ExportGltfParams {
    fn default() -> Self {
        Self {
            file: "{out}/garment.glb".to_owned(),
            document: DocumentParam::Packed,
            body: false,
            thickness: false,
            lines: false,
            uv: UvParam::Metres,
            compression: CompressionParam::None,
            colours: ColoursParam::Cloth,
        }
    }
}

impl Stage for ExportGltf {
    type Params = ExportGltfParams;
    const INFO: StageInfo = StageInfo::new(
        "export-gltf",
        "writes the garment as GLB: a node for each piece, cloth coordinates, images, the document inside",
        &[Aspect::Mesh, Aspect::Shape],
        &[],
        2,
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
        let field = params.colours.field(&garment)?;
        let wishes = Wishes {
            document: match params.document {
                DocumentParam::Packed => Carried::Packed,
                DocumentParam::Plain => Carried::Plain,
                DocumentParam::Nothing => Carried::Nothing,
            },
            body: params.body,
            thickness: params.thickness,
            lines: params.lines,
            repeats: params.uv == UvParam::Repeats,
            squeezed: params.compression == CompressionParam::Meshopt,
            field: field.as_ref(),
        };
        let glb = gltf::write_garment_with(&garment, &wishes).map_err(failure)?;
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
