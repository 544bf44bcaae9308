//! The outcome of a run.

use crate::Vec3;

/// The reason why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// Energy change and speed below their tolerances (and, when sewing, every pair closed).
    Settled,
    /// Stitches are open although the sewing force has grown to its most: the pieces do not reach round the body, or
    /// something is in the way.
    SeamsOpen,
    /// Nothing holds the cloth, so it falls without end.
    Unheld,
    /// Something holds the cloth back from where held vertices are led: it would tear before they are there, or no step
    /// leads on.
    HeldBack,
    /// The step limit was reached.
    MaxSteps,
    /// The limit of simulated time was reached.
    MaxSeconds,
}

impl StopReason {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Settled => "settled",
            Self::SeamsOpen => "seams stayed open at full force",
            Self::Unheld => "nothing holds the cloth, it falls",
            Self::HeldBack => "something holds the cloth back, what is held of it cannot be led to its place",
            Self::MaxSteps => "the step limit was reached",
            Self::MaxSeconds => "the limit of simulated time was reached",
        }
    }
}

/// An effect that was on or off, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectReport {
    /// `self-contact`, `body-contact`, `friction`, `strain-limit`, `softened-stretch`, …
    pub name: &'static str,
    /// Set where the effect acted.
    pub on: bool,
    /// The rule that decided.
    pub rule: String,
    /// The evidence that the scene or the run gave.
    pub evidence: String,
    /// CPU time it took on all levels, s (0 where it is not measured apart). Never part of a result that must be
    /// reproducible.
    pub cpu_seconds: f64,
}

/// Force that a pin gives to the cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Held vertex.
    pub vertex: u32,
    /// Force, N.
    pub force: Vec3,
}

/// The end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Positions, in the order of the scene, m.
    pub positions: Vec<Vec3>,
    /// Steps taken.
    pub steps: u64,
    /// Simulated time, s.
    pub seconds: f64,
    /// True only if every tolerance was met.
    pub settled: bool,
    /// Why it ended.
    pub stop_reason: StopReason,
    /// Elastic energy, J.
    pub energy: f64,
    /// Fastest free vertex at the end, m/s.
    pub speed_max: f64,
    /// Largest net force on a free vertex at the end over the mean vertex weight; contact, friction and pins count.
    pub residual_rel: f64,
    /// Largest distance of a stitched pair, m.
    pub seam_gap_max: f64,
    /// Stitched pairs not closed: index into the stitches, gap in m; largest gap first, at most 20.
    pub open_stitches: Vec<(u32, f64)>,
    /// Effects.
    pub effects: Vec<EffectReport>,
    /// Forces on the pins.
    pub reactions: Vec<Reaction>,
    /// Vertices that were moved before the first step (out of the body, or pieces apart), and the largest move, m.
    pub repaired: (usize, f64),
    /// Edges so tiny beside their triangles that their ends were draped as one vertex.
    pub joined: usize,
}

impl Outcome {
    /// Counts the steps and costs of a run that led to this one.
    pub(crate) fn after(mut self, before: &Self) -> Self {
        self.steps += before.steps;
        self.add_costs(&before.effects);
        self
    }

    /// Counts what effects cost in a run that led to this one.
    pub(crate) fn add_costs(&mut self, before: &[EffectReport]) {
        for e in &mut self.effects {
            e.cpu_seconds += before.iter().filter(|b| b.name == e.name).map(|b| b.cpu_seconds).sum::<f64>();
        }
    }
}
