//! `import-garment`: a garment as this program wrote it, also after its 3D shape was edited, so that a pipeline can
//! begin in 3D.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_formats::garment_file;
use toile_garment::{Aspect, Code, Diagnostic, Garment, SourceRef};
use toile_stage_api::{Cost, Forecast, MeshSize, Stage, StageContext, StageError, StageInfo};

codes! {
    pub(crate) list CODES;

    /// The garment of a file has no meshes or no drape, so nothing in 3D begins with it. Drape it first. Exit code 3.
    GARMENT_NOT_DRAPED = "garment-not-draped";
}

/// Parameters of `import-garment`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImportGarmentParams {
    /// A GLB that `export-gltf` wrote, also as an editor saved it again, or a garment document. In a GLB vertices may
    /// be moved, sorted, split and welded; names and texture coordinates tell which is which.
    #[schemars(extend("format" = "input-file"))]
    pub file: PathBuf,
    /// The GLB that was edited, or its garment document. Give it when the editor left the document out of `file`, as
    /// Blender does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub document: Option<PathBuf>,
}

/// The stage.
pub struct ImportGarment;

impl Stage for ImportGarment {
    type Params = ImportGarmentParams;
    const INFO: StageInfo = StageInfo::new(
        "import-garment",
        "reads a draped garment from a GLB, also an edited one, or from a garment document",
        &[],
        &[Aspect::Pieces, Aspect::Mesh, Aspect::Seams, Aspect::Drape],
        1,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        forecast.garment = self.run(params, Garment::default(), cx)?;
        let meshes = || forecast.garment.pieces.iter().filter_map(|p| p.mesh.as_ref());
        let triangles = meshes().map(|m| m.triangles.len()).sum::<usize>() as f64;
        let area: f64 = meshes().map(|m| m.area()).sum();
        // An even triangle of edge h has √3/4 h².
        let edge = (area / triangles.max(1.0) * 4.0 / 3f64.sqrt()).sqrt();
        forecast.mesh = Some(MeshSize { triangles, edge });
        Ok(forecast.by_triangles(0.01, 0.001, 1.0))
    }

    fn run(&self, params: &Self::Params, _: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let file = params.file.to_string_lossy().into_owned();
        let bytes = cx.files.read(&params.file)?;
        let garment = match &params.document {
            None => garment_file::read(&bytes, &file, cx.report),
            Some(path) => {
                let document = cx.files.read(path)?;
                garment_file::read_by_document((&bytes, &file), (&document, &path.to_string_lossy()), cx.report)
            }
        }
        .map_err(StageError::input)?;
        for (aspect, what) in [(Aspect::Mesh, "meshes"), (Aspect::Drape, "drape")] {
            if !garment.has(aspect) {
                return Err(StageError::input(
                    Diagnostic::error(GARMENT_NOT_DRAPED, format!("the garment of `{file}` has no {what}"))
                        .at(SourceRef::file(file))
                        .hint("give a garment that was draped"),
                ));
            }
        }
        Ok(garment)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::piece;
    use std::path::Path;
    use std::sync::atomic::AtomicBool;
    use toile_garment::garment::Shape;
    use toile_garment::mesh::PieceMesh;
    use toile_garment::{Report, Vec2, Vec3, bundle};
    use toile_stage_api::{FileError, Files};

    fn square() -> Garment {
        let corners = [(0.0, 0.0, 't'), (100.0, 0.0, 't'), (100.0, 100.0, 't'), (0.0, 100.0, 't')];
        let rest = corners.map(|(x, y, _)| Vec2::new(x, y) * 1e-3).to_vec();
        let drape =
            Shape { positions: vec![rest.iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect()], ..Shape::default() };
        let mut sheet = piece(0, "sheet", &corners);
        sheet.mesh = Some(PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() });
        Garment { pieces: vec![sheet], drape: Some(drape), ..Garment::default() }
    }

    struct One(Vec<u8>);

    impl Files for One {
        fn read(&mut self, _: &Path) -> Result<Vec<u8>, FileError> {
            Ok(self.0.clone())
        }
        fn read_optional(&mut self, _: &Path) -> Result<Option<Vec<u8>>, FileError> {
            Ok(None)
        }
        fn write(&mut self, _: &Path, _: &[u8]) -> Result<(), FileError> {
            Ok(())
        }
    }

    fn read(bytes: Vec<u8>) -> Result<Garment, StageError> {
        let params = ImportGarmentParams { file: "g.glb".into(), document: None };
        let (mut report, cancel) = (Report::default(), AtomicBool::new(false));
        let mut cx = StageContext {
            report: &mut report,
            progress: &mut (),
            files: &mut One(bytes),
            cancel: &cancel,
            seed: 0,
            threads: 1,
        };
        ImportGarment.run(&params, Garment::default(), &mut cx)
    }

    #[test]
    fn a_document_and_a_glb_are_read() {
        let text = bundle::to_value(&square()).expect("document").to_string();
        assert_eq!(read(text.into_bytes()).expect("read").pieces[0].name, "sheet");
        let glb = toile_formats::gltf::write_garment(&square()).expect("GLB");
        assert_eq!(read(glb).expect("read").drape, square().drape);
    }

    #[test]
    fn what_is_not_draped_and_what_is_no_garment_is_refused() {
        let flat = Garment { drape: None, ..square() };
        let text = bundle::to_value(&flat).expect("document").to_string();
        assert!(read(text.into_bytes()).expect_err("refused").to_string().contains("garment-not-draped"));
        assert!(read(b"solid x".to_vec()).expect_err("refused").to_string().contains("garment-file"));
    }
}
