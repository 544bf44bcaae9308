//! The moving parts, the steps in time, and the result.

use crate::scene::validate;
use crate::{BodyMesh, ClothError, EffectReport, SceneFault, Vec3};

/// How time is stepped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamics {
    /// Longest time step, s.
    pub step: f64,
    /// Rate at which velocities die away, 1/s (paper equation 7: C_d/m). A linear drag of c kg/(m² s) on a fabric of
    /// σ kg/m² is the rate c/σ.
    pub damping: f64,
    /// Explicit steps only: `damping` acts on the velocity of half a step before, not on the mean over the step.
    pub lagged: bool,
    /// Explicit steps only: `step` is taken as it is, even where the cloth does not bear it.
    pub fixed: bool,
    /// Pressure of still air over the square of the speed across the cloth, kg/m³: ½ ρ C_d.
    pub drag: f64,
    /// A stage of a step is solved when a Newton step would change no velocity by more than this, m/s.
    pub tolerance: f64,
    /// Speed of the fastest vertex below which the cloth has come to rest, m/s.
    pub rest_speed: f64,
}

impl Default for Dynamics {
    fn default() -> Self {
        Self {
            step: 1.0 / 120.0,
            damping: 0.5,
            lagged: false,
            fixed: false,
            drag: 0.6,
            tolerance: 5e-3,
            rest_speed: 5e-3,
        }
    }
}

/// The request.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Frames in a second.
    pub fps: f64,
    /// Frames to give, the first at time 0.
    pub frames: usize,
    /// End as soon as the body has stopped and the cloth has come to rest.
    pub until_settled: bool,
    /// Places of the body's vertices, frame by frame, m; after the last frame it stands still. Empty for a body that
    /// does not move.
    pub body: Vec<Vec<Vec3>>,
    /// Time in which the body is led from the scene's pose to the first frame, where they differ, s.
    pub lead_in: f64,
    /// Velocities at the start, m/s; empty for rest.
    pub velocities: Vec<Vec3>,
    /// Is the start a place of rest? Then what lies on the body is held there with the loads that it rested with.
    pub rests: bool,
}

impl Default for Motion {
    fn default() -> Self {
        Self {
            fps: 30.0,
            frames: 1,
            until_settled: false,
            body: Vec::new(),
            lead_in: 1.0,
            velocities: Vec::new(),
            rests: false,
        }
    }
}

/// One moment of the motion.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// Counted from 0.
    pub number: usize,
    /// s.
    pub seconds: f64,
    /// Cloth, m.
    pub positions: &'a [Vec3],
    /// m/s.
    pub velocities: &'a [Vec3],
    /// The body's vertices, m; empty without a body.
    pub body: &'a [Vec3],
    /// J.
    pub kinetic: f64,
    /// Stored in the cloth, weight and contact, J.
    pub potential: f64,
}

/// The end of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trip {
    /// Frames given.
    pub frames: usize,
    /// Time steps.
    pub steps: u64,
    /// Steps of the descents inside them.
    pub descents: u64,
    /// Stages whose descent ended short of the tolerance.
    pub unfinished: u64,
    /// Parts in which the body had to come because cloth was in its way.
    pub parted: u64,
    /// Had the cloth come to rest at the end?
    pub settled: bool,
    /// Fastest vertex in the last frame, m/s.
    pub speed: f64,
    /// Largest distance of a body vertex between the scene's pose and the first frame, m.
    pub lead_in_distance: f64,
    /// Effects.
    pub effects: Vec<EffectReport>,
}

/// More are an error in a number, not a film.
const MOST_FRAMES: f64 = 100_000.0;

fn bad<T>(fault: SceneFault, what: String) -> Result<T, ClothError> {
    Err(ClothError::BadScene { fault, what })
}

impl Dynamics {
    /// Number of equal steps in a time, s.
    pub(crate) fn steps(&self, time: f64) -> f64 {
        // A hair of slack, so that rounding makes no further step.
        (time / self.step * (1.0 - 1e-9)).ceil().max(1.0)
    }

    /// Checks that all values are in range.
    ///
    /// # Errors
    /// [`ClothError::BadSetting`] for the first that is not.
    pub fn check(&self) -> Result<(), ClothError> {
        validate::first(self.faults())
    }

    /// All values out of their ranges.
    #[must_use]
    pub fn faults(&self) -> Vec<ClothError> {
        let ranges: [(&'static str, f64, f64, f64); 5] = [
            ("step", self.step, 1e-6, 1.0),
            ("damping", self.damping, 0.0, 1e6),
            ("drag", self.drag, 0.0, 1e6),
            ("tolerance", self.tolerance, 1e-12, 1.0),
            ("rest_speed", self.rest_speed, 0.0, 1e3),
        ];
        validate::out_of_range(&ranges)
    }
}

impl Motion {
    /// All values out of their ranges, whatever the body.
    #[must_use]
    pub fn faults(&self) -> Vec<ClothError> {
        let frames = ("frames", self.frames as f64, 0.0, MOST_FRAMES);
        validate::out_of_range(&[("fps", self.fps, 1.0, 1e5), ("lead_in", self.lead_in, 0.0, 60.0), frames])
    }

    /// Checks that all values are in range and fit a body and a number of vertices.
    ///
    /// # Errors
    /// [`ClothError::BadSetting`] or [`ClothError::BadScene`] for the first that does not.
    pub fn check(&self, body: Option<&BodyMesh>, vertices: usize) -> Result<(), ClothError> {
        validate::first(self.faults())?;
        if !self.velocities.is_empty() && self.velocities.len() != vertices {
            let what = format!("{} start velocities for {vertices} vertices", self.velocities.len());
            return bad(SceneFault::Velocities, what);
        }
        let Some(n) = body.map(|b| b.positions.len()).filter(|_| !self.body.is_empty()) else {
            return if self.body.is_empty() {
                Ok(())
            } else {
                bad(SceneFault::NoBody, "frames of a body, but no body".into())
            };
        };
        for (i, frame) in self.body.iter().enumerate() {
            if frame.len() != n {
                let what = format!("frame {i} of the body has {} vertices, the body has {n}", frame.len());
                return bad(SceneFault::FrameVertices, what);
            }
            if let Some(v) = frame.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
                return bad(SceneFault::FrameNotFinite, format!("vertex {v} of frame {i} of the body is not finite"));
            }
        }
        Ok(())
    }
}
