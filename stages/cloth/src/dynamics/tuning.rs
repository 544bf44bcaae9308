//! Tuned numbers of motion in time.

use crate::tuning::tuned;

tuned! {
    room "dynamics";

    /// Time step of a drape by implicit steps.
    SETTLING_STEP: f64 = 1.0 / 60.0, {
        unit: "s",
        larger: "Fewer steps, each with more work, and more of the motion is lost.",
        smaller: "More steps.",
        tried: "1/120 to 1/15 s",
        evidence: "The drape of the long skirt took 5.0, 2.8, 1.6 and 1.1 CPU s at 1/120, 1/60, 1/30 and 1/15 s, of the T-shirt 12.1, 7.0, 5.4 and 3.8. All ended within 0.1 mm of each other. Net forces of 0.24 and 0.88 were left on the skirt at both ends, and 0.02 between.",
    }
    /// Velocity to which a step is solved over the speed at which the cloth is at rest.
    SETTLING_TOLERANCE_SHARE: f64 = 0.5, {
        unit: "speed tolerance",
        larger: "What a step leaves over counts as motion, and the cloth comes to rest late or never.",
        smaller: "More work in every step.",
        tried: "0.1 to 1",
        evidence: "On the long skirt net forces of 0.001, 0.021 and 0.95 of a vertex's weight were left at 0.1, 0.5 and 1, in the same time.",
    }

    /// Steps of the descent between two parts of the body's way, in which the cloth gives way.
    GIVING_WAY_STEPS: usize = 6, {
        unit: "steps",
        larger: "Fewer factorisations while cloth gives way, and steps with an older Hessian.",
        smaller: "More factorisations.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Factorisations in a stage, at most.
    STAGE_FACTORISATIONS_MOST: usize = 25, {
        unit: "factorisations",
        larger: "More work on stages that do not end.",
        smaller: "More stages are left unfinished.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Longest move of a short step over the tolerance, at which the digits of the energy no longer tell the step.
    STAGE_SHORT_STEP_SHARE: f64 = 1e-3, {
        unit: "tolerance",
        larger: "Stages may end with a step that fell short.",
        smaller: "More factorisations at the end of a stage.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Part of a step below which its block ends.
    STAGE_BLOCK_END_PART: f64 = 0.2, {
        unit: "part of the full step",
        larger: "More factorisations.",
        smaller: "More short steps with an old Hessian.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Longest move over the tolerance at which a step without gain ends the stage.
    STAGE_NEARLY_ENDED: f64 = 10.0, {
        unit: "tolerance",
        larger: "Stages end farther from their solution.",
        smaller: "More blocks in which rounding decides.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Blocks without gain after which a stage is given up.
    STAGE_STUCK_BLOCKS_MOST: u32 = 3, {
        unit: "blocks",
        larger: "More work on stages that are stuck.",
        smaller: "More stages are left unfinished.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Factor of τ after two blocks without gain.
    STAGE_STUCK_TAU_FACTOR: f64 = 0.1, {
        unit: "factor",
        larger: "More blocks without gain.",
        smaller: "Shorter steps than are needed.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Part of the body's remaining way below which the body does not come on.
    BODY_PART_LEAST: f64 = 2e-3, {
        unit: "part of the way",
        larger: "The body counts as caught although it still comes on.",
        smaller: "Caught cloth is seen later.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Such parts in a row after which the cloth cannot give way.
    BODY_IDLE_PARTS_MOST: usize = 60, {
        unit: "parts",
        larger: "More work on cloth that is caught.",
        smaller: "Cloth is called caught that would give way.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Parts in a stage up to which the way is also shortened so that nothing tears.
    BODY_PARTS_MOST: u32 = 64, {
        unit: "parts",
        larger: "More work where held vertices tear at the cloth.",
        smaller: "Cloth may be torn.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least part of the way of held vertices that is taken so that nothing tears.
    UNTORN_PART_LEAST: f64 = 1.0 / 64.0, {
        unit: "part of the way",
        larger: "Cloth may be torn.",
        smaller: "More parts.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance of held vertices from their course from which the cloth beside them is taken along.
    OFF_COURSE_EDGES: f64 = 0.05, {
        unit: "mean edges",
        larger: "Held vertices tear at the cloth beside them.",
        smaller: "More solves.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Farthest way of the body towards the cloth in a step.
    BODY_STEP_EDGES: f64 = 0.5, {
        unit: "mean edges",
        larger: "Cloth that is hit is stretched by all of the step.",
        smaller: "More time steps.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance from the body at the start up to which a held vertex is attached to it.
    ATTACHMENT_DISTANCE: f64 = 0.05, {
        unit: "m",
        larger: "Vertices that are held in space move with the body.",
        smaller: "Vertices that hang on the body stay behind.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Sweeps over all contacts that take the separating speed out of an impact.
    IMPACT_SWEEPS: usize = 4, {
        unit: "sweeps",
        larger: "Less rebound is left, at more work.",
        smaller: "More rebound is left where contacts share vertices.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
}
