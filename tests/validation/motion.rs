//! How the stage `animate` is asked to move a trial.

use crate::closed::G;
use crate::support::film;
use crate::support::trial::Trial;

/// Keys of `animate`; nothing is damped unless it is said.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Frames in a second.
    pub fps: f64,
    pub frames: usize,
    /// Longest time step, s.
    pub step: f64,
    /// m/s².
    pub gravity: f64,
    /// Time in which motion dies away to 1/e, s; 0 for never.
    pub calming: f64,
    /// More keys, as TOML.
    pub more: Vec<String>,
}

impl Motion {
    /// `seconds` of motion under gravity, with one step or several from frame to frame.
    pub fn new(fps: f64, seconds: f64, step: f64) -> Self {
        let frames = (seconds * fps).round() as usize + 1;
        Self { fps, frames, step, gravity: G, calming: 0.0, more: Vec::new() }
    }

    pub fn weightless(self) -> Self {
        Self { gravity: 0.0, ..self }
    }

    /// The trial with this motion after its drape; `keys` are meant for both.
    pub fn of(&self, trial: &Trial, keys: &[String]) -> Trial {
        let mut text = format!(
            "[[stage]]\nuse = \"animate\"\nwith.fps = {:?}\nwith.frames = {}\nwith.step = \"{} s\"\n\
             with.gravity = \"{} m/s2\"\nwith.calming = \"{} s\"\nwith.air = \"off\"\nwith.accuracy = \"reference\"\n\
             with.sequence = \"{}\"\n",
            self.fps,
            self.frames,
            self.step,
            self.gravity,
            self.calming,
            film::FIRST
        );
        keys.iter().chain(&self.more).for_each(|key| text += &format!("with.{key}\n"));
        Trial { stages: text, ..trial.clone() }
    }
}
