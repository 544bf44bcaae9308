//! Settings of the solver: model, integrator, contact, stops.
//!
//! Defaults are for draping; [`Settings::sewing`] has those for sewing.

/// The in-plane model of the cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// The paper's three classes of springs on the mesh edges (structural, shear, flexion), each with its own
    /// strain-dependent stiffness. Shear comes out too stiff on triangle meshes (docs/structural.md).
    Springs,
    /// Triangle springs whose three coefficients depend on all three elongations: exact for any orthotropic law.
    #[default]
    Coupled,
}

/// The integrator of the solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// The least energy is sought by a descent, without time (docs/book/src/solver.md).
    #[default]
    Static,
    /// Implicit steps in time until nothing moves, after Baraff and Witkin 1998 (docs/dynamics.md). Seams are closed as
    /// by [`Self::Static`].
    Implicit,
    /// Explicit central differences with an adaptive step (paper equations 8–14).
    CentralDifference,
}

/// The correction of over-elongation after an explicit step (paper §2.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ElongationCorrection {
    /// Yarns of the triangles along warp, weft and bias, in a few passes, after Kang et al. 2000.
    #[default]
    Kang,
    /// Springs on the mesh edges, in one pass, after Provot 1995.
    Provot,
}

/// The force of a contact by its distance, in explicit steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactPenalty {
    /// A spring below the gap.
    #[default]
    Linear,
    /// c_p exp(1/d) with the distance d in gaps (paper equation 6).
    Exponential,
}

/// A switch for an effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Switch {
    /// The effect is used by its own rule.
    #[default]
    Auto,
    /// The effect is used whatever the rule says.
    On,
    /// The effect is not even built.
    Off,
}

/// The effects that a scene may or may not call for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effects {
    /// Cloth against cloth.
    pub self_contact: Switch,
    /// Cloth against the body.
    pub body_contact: Switch,
    /// Coulomb friction at contacts.
    pub friction: Switch,
    /// Over-elongation correction after the step (paper §2.2).
    pub strain_limit: Switch,
    /// Friction in bending (docs/hysteresis.md).
    pub bending_hysteresis: Switch,
}

/// When a state without time counts as at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// The energy that a Newton step would still win, over the elastic energy, at which the state is at rest.
    pub decrement_tolerance: f64,
    /// The longest move of a vertex in such a step, m.
    pub move_tolerance: f64,
    /// Largest net force on a vertex over the mean vertex weight.
    pub residual_tolerance: f64,
    /// Most descent steps.
    pub max_descents: u64,
}

impl Default for Equilibrium {
    fn default() -> Self {
        Self { decrement_tolerance: 1e-3, move_tolerance: 1e-4, residual_tolerance: 1e-2, max_descents: 5_000 }
    }
}

/// The numbers of explicit steps: damping, penalty, step and stop.
#[derive(Clone, Debug, PartialEq)]
pub struct ExplicitSteps {
    /// Mass-proportional damping rate C_d/m, 1/s (paper equation 7).
    pub damping: f64,
    /// Stiffness-proportional damping time, in time steps: quiets the shortest waves, leaves the rest shape alone.
    pub stiffness_damping: f64,
    /// Stiffness of every contact, a penalty, N/m; 0 for as stiff as the step bears.
    pub contact_stiffness: f64,
    /// Law of that penalty.
    pub penalty: ContactPenalty,
    /// Largest tangent stiffness of the stretch curves used, N/m; infinite for the curves as measured. A lower cap
    /// allows a longer time step and costs added strain, which the strain limit bounds and the report states.
    pub stiffness_cap: f64,
    /// Fraction of the stable time step that is used, 0..1.
    pub step_fraction: f64,
    /// Elements much smaller than the rest get inertia (not weight) so that they do not rule the time step.
    pub mass_scaling: bool,
    /// How over-elongation is corrected after a step.
    pub correction: ElongationCorrection,
    /// Stop condition b: relative change of the elastic energy over a check interval.
    pub energy_tolerance: f64,
    /// No free vertex may be faster than this for the state to be called settled, m/s.
    pub speed_tolerance: f64,
    /// Most steps.
    pub max_steps: u64,
    /// Most simulated time, s.
    pub max_seconds: f64,
}

impl Default for ExplicitSteps {
    fn default() -> Self {
        Self {
            damping: 4.0,
            stiffness_damping: 0.2,
            contact_stiffness: 0.0,
            penalty: ContactPenalty::default(),
            stiffness_cap: 2000.0,
            step_fraction: 0.6,
            mass_scaling: true,
            correction: ElongationCorrection::default(),
            energy_tolerance: 1e-3,
            speed_tolerance: 2e-3,
            max_steps: 2_000_000,
            max_seconds: 20.0,
        }
    }
}

/// How stitched pairs are drawn together, and when they are joined.
#[derive(Clone, Debug, PartialEq)]
pub struct Stitches {
    /// Explicit steps: force per gap, in units of the stitch's share of the cloth's stiffness (paper equation 5: c_s).
    pub stiffness: f64,
    /// Explicit steps: largest acceleration a sewing force may give, m/s².
    pub acceleration: f64,
    /// A stitched pair nearer than this counts as sewn and is joined, m (stop condition a).
    pub closed_distance: f64,
    /// Explicit steps: time over which the sewing force grows to full, s.
    pub ramp: f64,
}

impl Default for Stitches {
    fn default() -> Self {
        Self { stiffness: 0.05, acceleration: 200.0, closed_distance: 1e-3, ramp: 0.2 }
    }
}

/// All numbers of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// In-plane model.
    pub model: Model,
    /// Time stepping.
    pub integrator: Integrator,
    /// Effects.
    pub effects: Effects,
    /// Factor on the scene's gravity.
    pub gravity_scale: f64,
    /// Pressure that pushes the cloth to its front side, Pa; static only.
    pub pressure: f64,
    /// Distance at which vertices are held off the body, m.
    pub body_gap: f64,
    /// Distance at which cloth is held off cloth, m; at least the fabric's thickness is used.
    pub self_gap: f64,
    /// Most vertices pushed out of the body at the start, as a fraction; above it the start is refused.
    pub repair_share: f64,
    /// Rest without time.
    pub equilibrium: Equilibrium,
    /// Explicit steps.
    pub explicit: ExplicitSteps,
    /// Stitches.
    pub stitches: Stitches,
    /// Largest number of threads. Results never depend on it.
    ///
    /// Each part of the cloth that meets no other has one thread, and the factor of a large part has two
    /// (docs/book/src/solver.md).
    pub threads: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            model: Model::Coupled,
            integrator: Integrator::Static,
            effects: Effects::default(),
            gravity_scale: 1.0,
            pressure: 0.0,
            body_gap: 1e-3,
            self_gap: 1e-3,
            repair_share: 0.2,
            equilibrium: Equilibrium::default(),
            explicit: ExplicitSteps::default(),
            stitches: Stitches::default(),
            threads: 1,
        }
    }
}

impl Settings {
    /// Defaults for sewing: no gravity until the seams are closed (the drape brings it), more damping, looser stop.
    #[must_use]
    pub fn sewing() -> Self {
        Self {
            gravity_scale: 0.0,
            // A sewer's hands slide the cloth into place, and leave no folds that were not there before.
            effects: Effects { friction: Switch::Off, bending_hysteresis: Switch::Off, ..Effects::default() },
            explicit: ExplicitSteps {
                damping: 10.0,
                energy_tolerance: 1e-2,
                speed_tolerance: 5e-2,
                max_seconds: 6.0,
                ..ExplicitSteps::default()
            },
            ..Self::default()
        }
    }

    /// The largest tangent stiffness used: only explicit steps need a cap.
    #[must_use]
    pub fn curve_cap(&self) -> f64 {
        if self.integrator == Integrator::CentralDifference { self.explicit.stiffness_cap } else { f64::INFINITY }
    }
}
