//! Sews the long skirt around any OBJ. The body's side file is that of the sample, so its landmarks and segments may lie far
//! from the mesh. A body may be refused, but nothing panics, and every place that comes out is a number.
#![no_main]

use serde_json::{Value, json};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use toile_garment::{Garment, Report};
use toile_stage_api::{FileError, Files, Stage, StageContext, StageError};
use toile_stages::{assemble::Assemble, import_dxf::ImportDxf, stitch::Stitch, triangulate::Triangulate};

/// Longest sewing, s.
const SECONDS: u64 = 5;

/// The sample's files, and the body that is tried.
struct Given<'a>(&'a [u8]);

impl Files for Given<'_> {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let missing = || FileError::Missing { path: path.display().to_string(), reason: "it is not given".into() };
        self.read_optional(path)?.ok_or_else(missing)
    }

    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(match path.to_str() {
            Some("skirt.dxf") => Some(include_bytes!("../../samples/patterns/long-skirt.astm.dxf").to_vec()),
            Some("sewing.toml") => Some(include_bytes!("../../samples/patterns/long-skirt.sewing.toml").to_vec()),
            Some("fabric.toml") => Some(include_bytes!("../../samples/fabrics/wool-suiting.toml").to_vec()),
            Some("body.toml") => Some(include_bytes!("../../samples/bodies/size-38.toml").to_vec()),
            Some("body.obj") => Some(self.0.to_vec()),
            _ => None,
        })
    }

    fn write(&mut self, _: &Path, _: &[u8]) -> Result<(), FileError> {
        Ok(())
    }
}

fn run<S: Stage>(stage: &S, params: Value, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
    let params: S::Params = serde_json::from_value(params).expect("parameters");
    stage.run(&params, garment, cx)
}

fn sew(cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
    let pattern = json!({ "file": "skirt.dxf", "sewing": "sewing.toml", "size": "38" });
    let garment = run(&ImportDxf, pattern, Garment::default(), cx)?;
    let garment = run(&Triangulate, json!({ "triangles": 300 }), garment, cx)?;
    let garment = run(&Assemble, json!({}), garment, cx)?;
    run(&Stitch, json!({ "body": "body.obj", "fabric": "fabric.toml" }), garment, cx)
}

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    static CANCEL: AtomicBool = AtomicBool::new(false);
    CANCEL.store(false, Ordering::Relaxed);
    std::thread::spawn(|| {
        std::thread::sleep(Duration::from_secs(SECONDS));
        CANCEL.store(true, Ordering::Relaxed);
    });
    let mut report = Report::default();
    let sewn = sew(&mut StageContext {
        report: &mut report,
        progress: &mut (),
        files: &mut Given(data),
        cancel: &CANCEL,
        seed: 0,
        threads: 1,
    });
    let shape = sewn.ok().and_then(|garment| garment.stitched);
    let places = shape.iter().flat_map(|s| &s.positions).flatten();
    assert!(places.into_iter().all(|p| p.iter().all(|c| c.is_finite())));
});
