//! Frames as they will be stored, each counted afresh.

use super::AnimateParams;
use super::body::number;
use super::certificate::Watched;
use super::codes;
use crate::solve::Layout;
use std::path::Path;
use toile_cloth::{BodyMesh, ClothError, Figures, Frame, Scene, Settings, Welded, certify};
use toile_formats::obj;
use toile_garment::animation::{Animation, MotionCertificate};
use toile_garment::garment::Shape;
use toile_garment::{Diagnostic, Garment, Vec3};
use toile_stage_api::{StageContext, StageError};

/// Collects frames.
pub struct Store<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    frames: Vec<Vec<Vec3>>,
    worst: Figures,
    /// Frame with the largest strain.
    strained: usize,
    watched: Watched,
    failed: Option<ClothError>,
}

impl<'a> Store<'a> {
    pub fn new(scene: &'a Scene, settings: &'a Settings) -> Self {
        Self {
            scene,
            settings,
            frames: Vec::new(),
            worst: Figures::default(),
            strained: 0,
            watched: Watched::new(scene),
            failed: None,
        }
    }

    /// Takes a frame, in the numbers a viewer will see.
    pub fn take(&mut self, frame: &Frame<'_>) {
        self.watched.take(frame);
        let x: Vec<Vec3> = frame.positions.iter().zip(&self.scene.positions).map(|(p, b)| as_shown(p, b)).collect();
        let body = self.scene.body.as_ref().map(|b| BodyMesh {
            positions: if frame.body.is_empty() { b.positions.clone() } else { frame.body.to_vec() },
            triangles: b.triangles.clone(),
        });
        match certify(&Scene { body: body.map(Into::into), ..self.scene.clone() }, self.settings, &x) {
            Ok(f) => {
                let w = &mut self.worst;
                w.self_crossings = w.self_crossings.max(f.self_crossings);
                w.body_crossings = w.body_crossings.max(f.body_crossings);
                w.penetration_max = w.penetration_max.max(f.penetration_max);
                if f.strain_max > w.strain_max {
                    (w.strain_max, self.strained) = (f.strain_max, frame.number);
                }
            }
            Err(e) => self.failed = self.failed.take().or(Some(e)),
        }
        self.frames.push(x);
    }

    /// The largest strain along warp or weft, and its frame.
    pub fn strained(&self) -> (f64, usize) {
        (self.worst.strain_max, self.strained)
    }

    /// The certificate of the motion; `strain` is the gate of the drape's strain.
    pub fn certificate(&self, params: &AnimateParams, strain: f64) -> MotionCertificate {
        self.watched.certificate(self.scene, params, &self.worst, strain)
    }

    /// The frames by piece, and the worst of their figures.
    ///
    /// # Errors
    /// When a frame could not be counted.
    pub fn finish(self, fps: f64, settled: bool, layout: &Layout, welded: &Welded) -> Result<Animation, StageError> {
        if let Some(e) = self.failed {
            return Err(crate::solve::failure(e));
        }
        Ok(Animation {
            fps,
            count: u32::try_from(self.frames.len()).unwrap_or(u32::MAX),
            frames: self.frames.iter().map(|f| layout.split(&welded.spread(f))).collect(),
            settled,
            self_crossings: self.worst.self_crossings as u64,
            body_crossings: self.worst.body_crossings as u64,
            penetration_max_mm: self.worst.penetration_max * 1e3,
            strain_max: self.worst.strain_max,
            certificate: None,
        })
    }
}

/// A morph target holds the difference to the base in single precision, and a viewer adds it in single precision: the
/// nearest place that comes out of this unchanged.
fn as_shown(p: &Vec3, base: &Vec3) -> Vec3 {
    #[allow(clippy::cast_possible_truncation)]
    let shown = |p: f64, base: f64| {
        let (mut p, base) = (p as f32, base as f32);
        for _ in 0..4 {
            p = base + (p - base);
        }
        f64::from(p)
    };
    Vec3::new(shown(p.x, base.x), shown(p.y, base.y), shown(p.z, base.z))
}

/// Writes every frame as OBJ, as `export-obj` would.
///
/// # Errors
/// A pattern without a number, or a file that cannot be written.
pub fn write(
    pattern: &str,
    animation: &Animation,
    garment: &Garment,
    cx: &mut StageContext<'_>,
) -> Result<(), StageError> {
    let Some((before, first, width, after)) = number(pattern) else {
        let found = Diagnostic::error(codes::SEQUENCE_NAME, format!("`{pattern}` has no number to count up from"));
        return Err(StageError::parameter(found.hint("name the first frame: with.sequence = \"{out}/frame-000.obj\"")));
    };
    let mut moved = garment.clone();
    for (k, frame) in animation.frames.iter().enumerate() {
        moved.drape = Some(Shape { positions: frame.clone(), sewn: true, welded: true, ..Shape::default() });
        let text = obj::write_garment(&moved, garment.file_up).map_err(|e| StageError::Internal(e.to_string()))?;
        cx.files.write(Path::new(&format!("{before}{:0width$}{after}", first + k)), text.as_bytes())?;
    }
    Ok(())
}
