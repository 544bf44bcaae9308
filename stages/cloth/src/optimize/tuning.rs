//! Tuned numbers and mechanisms of the optimisation.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "optimize";

    /// Pairs of a step and its change of the gradient that the L-BFGS history keeps.
    LBFGS_PAIRS: usize = 6, {
        unit: "pairs",
        larger: "Every solve costs two more passes over all vertices for each pair.",
        smaller: "Directions rest on the preconditioner alone.",
        tried: "3, 6, 12, 30",
        evidence: "3 and 12 pairs took as many steps as 6; 30 pairs took more.",
    }
    /// Steps of a block between two factorisations.
    BLOCK_STEPS: usize = 8, {
        unit: "steps",
        larger: "Fewer factorisations, and steps with an older Hessian.",
        smaller: "More factorisations.",
        tried: "8, 12",
        evidence: "12 took a sixth less for a skirt of 2,200 triangles, but up to an eighth more for garments that are sewn.",
    }
    /// Steps of a block on a coarser level that is not large.
    BLOCK_STEPS_COARSE: usize = 12, {
        unit: "steps",
        larger: "Fewer factorisations of the coarser level.",
        smaller: "More factorisations of the coarser level.",
        tried: "8, 12",
        evidence: "Coarser levels took 12.2 CPU seconds with 12 and 13.8 with 8.",
    }
    /// Steps of a block of large cloth.
    BLOCK_STEPS_LARGE: usize = 16, {
        unit: "steps",
        larger: "Fewer factorisations, and steps with an older Hessian.",
        smaller: "More factorisations, each as dear as many steps.",
        tried: "12 to 24",
        evidence: "40,000 triangles take as long with 12, 20 or 24.",
    }
    /// Vertices above which cloth counts as large: a factorisation then takes as long as many steps.
    LARGE_CLOTH_VERTICES: usize = 4_500, {
        unit: "vertices",
        larger: "Blocks of 8 steps, and coarse levels left early, for larger cloth.",
        smaller: "Blocks of 16 steps for smaller cloth.",
        tried: "not recorded",
        evidence: "From about here a factorisation takes as long as many steps. No table is kept.",
    }
    /// Longest move of a vertex in a step.
    STEP_CAP_EDGES: f64 = 1.0, {
        unit: "mean edges",
        larger: "Steps may turn triangles over.",
        smaller: "More steps for cloth that falls far.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Part of a step below which its block ends: the preconditioner says too little of this place.
    BLOCK_END_PART: f64 = 0.1, {
        unit: "part of the full step",
        larger: "More factorisations.",
        smaller: "More short steps with an old Hessian.",
        tried: "0.05, 0.1, 0.2",
        evidence: "0.2 took twice the factorisations; 0.05 took more steps on falling cloth.",
    }

    /// First τ of the shift mass / (τ · unit).
    TAU_FIRST: f64 = 1e-2, {
        unit: "dimensionless",
        larger: "Longer first steps, which fall short more often.",
        smaller: "Shorter first steps.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// τ from which the shift no longer matters, and which rest asks for.
    TAU_FREE: f64 = 30.0, {
        unit: "dimensionless",
        larger: "Rest is asked for with less regularisation, and more factorisations come before it.",
        smaller: "Rest may be called while the shift still shortens the Newton step.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least τ; below it no regularisation helps.
    TAU_LEAST: f64 = 1e-8, {
        unit: "dimensionless",
        larger: "A descent is given up earlier where the Hessian cannot be factorised.",
        smaller: "More attempts before it is given up.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest τ.
    TAU_MOST: f64 = 1e4, {
        unit: "dimensionless",
        larger: "More blocks until the shift acts again after bad steps.",
        smaller: "The shift never vanishes.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of τ after a block of nearly whole steps.
    TAU_FACTOR: f64 = 4.0, {
        unit: "factor",
        larger: "The regularisation leaves sooner, and steps fall short more often.",
        smaller: "More blocks with a shift.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of τ in large cloth once a Newton step would gain as little as at rest.
    TAU_FACTOR_AT_REST: f64 = 100.0, {
        unit: "factor",
        larger: "One factorisation fewer on the way to the free Hessian.",
        smaller: "More factorisations at the end of a drape.",
        tried: "4, 100",
        evidence: "With other changes at rest, seven starts of 100,000 triangles took 13.1 factorisations instead of 16.6.",
    }
    /// Factor of τ after a block that took no step.
    TAU_AFTER_STUCK_BLOCK: f64 = 0.1, {
        unit: "factor",
        larger: "More blocks without a step.",
        smaller: "More regularisation than is needed.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Factor of τ after a block of one short step.
    TAU_AFTER_ONE_SHORT_STEP: f64 = 0.15, {
        unit: "factor",
        larger: "More short blocks.",
        smaller: "More regularisation than is needed.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Factor of τ after a block of several short steps.
    TAU_AFTER_SHORT_STEPS: f64 = 0.4, {
        unit: "factor",
        larger: "More short blocks.",
        smaller: "More regularisation than is needed.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Factor of τ where the convex Hessian cannot be factorised.
    TAU_AFTER_FAILED_FACTOR: f64 = 0.1, {
        unit: "factor",
        larger: "More failed factorisations.",
        smaller: "More regularisation than is needed.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Mean part of the steps of a block above which the regularisation is lowered.
    WHOLE_BLOCK_PART: f64 = 0.8, {
        unit: "part of the full step",
        larger: "Regularisation stays longer.",
        smaller: "It is lowered although steps still fall short.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Mean part of the steps of a block below which the regularisation is raised.
    SHORT_BLOCK_PART: f64 = 0.4, {
        unit: "part of the full step",
        larger: "Regularisation is raised more often.",
        smaller: "More short steps.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// First share of the stretch stiffness that acts in all directions after short steps.
    ISOTROPIC_SHARE_FIRST: f64 = 1e-3, {
        unit: "share of the stretch stiffness",
        larger: "Flat cloth turns in shorter steps.",
        smaller: "More blocks until it helps.",
        tried: "not recorded",
        evidence: "No measurement is kept. With all of the share the Hessian is that of projective dynamics (Liu et al. 2017).",
    }
    /// Largest share of the stretch stiffness that acts in all directions.
    ISOTROPIC_SHARE_MOST: f64 = 0.1, {
        unit: "share of the stretch stiffness",
        larger: "Cloth turns in very short steps.",
        smaller: "τ shrinks instead.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth and decay of that share from block to block.
    ISOTROPIC_SHARE_FACTOR: f64 = 8.0, {
        unit: "factor",
        larger: "Coarser choice of the share.",
        smaller: "More blocks until it fits.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// Decrement over the elastic energy below which the full Hessian is tried instead of its convex projection.
    FULL_HESSIAN_DECREMENT: f64 = 0.05, {
        unit: "elastic energy",
        larger: "More failed factorisations far from rest.",
        smaller: "The last steps are too short: the convex projection is too stiff.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Most blocks until the full Hessian is tried again after it was indefinite.
    FULL_HESSIAN_WAIT_MOST: u32 = 8, {
        unit: "blocks",
        larger: "The full Hessian comes late.",
        smaller: "More failed factorisations.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance from where a factor was made, over the longest move at rest, up to which it may serve another block.
    REUSE_DRIFT: f64 = 3.0, {
        unit: "move tolerance",
        larger: "Fewer factorisations, with older factors.",
        smaller: "Every block takes a factorisation.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Mean part of the steps of a block above which its factor may serve another one.
    REUSE_MEAN_PART: f64 = 0.8, {
        unit: "part of the full step",
        larger: "Fewer blocks reuse a factor.",
        smaller: "Factors serve although steps fall short.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest net force after a block over that before, below which its factor may serve another one.
    REUSE_FORCE_SHARE: f64 = 0.3, {
        unit: "net force before",
        larger: "Factors serve although forces hardly shrink.",
        smaller: "Fewer blocks reuse a factor.",
        tried: "0.3, infinite",
        evidence: "Without this test, needles of 179.99 degrees came to the step limit in 8 of 60 drapes.",
    }

    /// Least part of what the slope promises that a step must gain (Armijo).
    ARMIJO_SHARE: f64 = 0.25, {
        unit: "share of the slope's promise",
        larger: "More steps are taken back.",
        smaller: "Steps may end far up the other side.",
        tried: "1e-4, 0.25",
        evidence: "With 1e-4 most drapes took more steps, up to a third.",
    }
    /// Trials of a line search before it is given up.
    LINE_SEARCH_TRIALS: usize = 8, {
        unit: "trials",
        larger: "Longer searches for tiny steps.",
        smaller: "More blocks without a step.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least part of a step that fell short which the next trial takes.
    BACKTRACKING_LEAST: f64 = 0.1, {
        unit: "part of the last trial",
        larger: "More trials for steps that are far too long.",
        smaller: "Steps may become needlessly short.",
        tried: "not recorded",
        evidence: "No measurement is kept. Nocedal and Wright advise bounds of this kind.",
    }
    /// Largest part of a step that fell short which the next trial takes.
    BACKTRACKING_MOST: f64 = 0.7, {
        unit: "part of the last trial",
        larger: "More trials.",
        smaller: "Shorter steps.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Rounds in which single vertices are held back before the whole step is shortened.
    HOLD_BACK_ROUNDS: usize = 3, {
        unit: "rounds",
        larger: "More evaluations for a step in a crowded place.",
        smaller: "A few vertices stop all others.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Part of a step below which single vertices are held back instead of all.
    HOLD_BACK_UNDER: f64 = 0.1, {
        unit: "part of the step",
        larger: "Directions are bent more often, and steps lead less far.",
        smaller: "A few vertices stop all others.",
        tried: "not recorded",
        evidence: "Held back vertices spoil the direction, so it is done only where little of the step would be left.",
    }

    /// Blocks in a row without any step after which nothing more can be gained.
    STUCK_BLOCKS_MOST: u32 = 12, {
        unit: "blocks",
        larger: "More work before cloth is given up.",
        smaller: "Cloth is given up that would still come to rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Net force at rest, over the tolerance, below which the free Hessian is tried at once.
    NEARLY_AT_REST_RESIDUAL: f64 = 10.0, {
        unit: "residual tolerance",
        larger: "The regularisation leaves earlier.",
        smaller: "More blocks with regularisation near rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Way of a vertex over the size of the scene after which the cloth is given up as falling.
    FALL_DISTANCE_SIZES: f64 = 3.0, {
        unit: "size of the scene",
        larger: "Falling cloth is seen later.",
        smaller: "Cloth that swings far may be given up.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// Decrement over the elastic energy above which contact loads of the start did not hold it in balance.
    LOADS_BALANCE_DECREMENT: f64 = 1.0, {
        unit: "elastic energy",
        larger: "Loads are kept although the cloth did not rest on them.",
        smaller: "Cloth that rested loses its loads.",
        tried: "not recorded",
        evidence: "A step that gains more than all elastic energy shows that the start was no rest.",
    }
    /// Decrement over the elastic energy below which tight contacts are stiffened: they are tight under a load then.
    LOADED_DECREMENT: f64 = 1.0, {
        unit: "elastic energy",
        larger: "Contacts become stiff because the cloth began near.",
        smaller: "Contacts under load stay soft for longer.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Gap updates at rest, at most.
    GAP_UPDATE_ROUNDS: u32 = 2, {
        unit: "updates",
        larger: "Gaps under load come closer to what they should be, at the price of further descents.",
        smaller: "Tight girths come out too small.",
        tried: "1, 2",
        evidence: "A tight sleeve shows its tension within 1 % with two rounds, 19 % too little without.",
    }
    /// Net force over the tolerance at which large cloth makes its first gap update.
    GAP_UPDATE_EARLY_RESIDUAL: f64 = 2000.0, {
        unit: "residual tolerance",
        larger: "The update comes while the cloth still moves.",
        smaller: "The motion that it starts comes to rest by itself, with one more factorisation.",
        tried: "not recorded",
        evidence: "With this value large cloth takes one factorisation less.",
    }

    /// Decrement over the elastic energy above which the strain-limit barrier is off.
    STRAIN_LIMIT_OFF_DECREMENT: f64 = 0.5, {
        unit: "elastic energy",
        larger: "The barrier acts on falling cloth.",
        smaller: "Cloth near rest loses its limits for a while.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Decrement over the elastic energy below which the barrier acts again.
    STRAIN_LIMIT_ON_DECREMENT: f64 = 2e-3, {
        unit: "elastic energy",
        larger: "The barrier acts while the cloth still moves.",
        smaller: "Cloth comes to rest without limits first.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Steps after which cloth with the law's own barrier is given a wide one.
    STRAIN_LIMIT_SLOW_STEPS: u64 = 400, {
        unit: "steps",
        larger: "Single triangles at their limit are slow for longer.",
        smaller: "Cloth that would have settled goes through the homotopy.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the limits over which the widest barrier acts.
    STRAIN_LIMIT_WIDE_SHARE: f64 = 0.6, {
        unit: "share of the strain limit",
        larger: "The barrier is softer.",
        smaller: "The barrier is stiffer, and steps are shorter.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Factor by which the wide barrier narrows.
    STRAIN_LIMIT_NARROWING: f64 = 0.3, {
        unit: "factor",
        larger: "More stages.",
        smaller: "Larger jumps between stages.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share below which the barrier becomes the law's own.
    STRAIN_LIMIT_WIDE_SHARE_LEAST: f64 = 0.01, {
        unit: "share of the strain limit",
        larger: "Fewer stages, with a larger last jump.",
        smaller: "More stages.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Decrement over the elastic energy below which the wide barrier narrows.
    STRAIN_LIMIT_NARROW_DECREMENT: f64 = 1e-3, {
        unit: "elastic energy",
        larger: "It narrows while the cloth still moves.",
        smaller: "More steps at each stage.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// First and longest move of held vertices that must get elsewhere.
    PIN_MOVE_FIRST: f64 = 0.5, {
        unit: "mean edges",
        larger: "Triangles beside held vertices are torn.",
        smaller: "More rounds until they are at their places.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least move of held vertices.
    PIN_MOVE_LEAST: f64 = 1e-3, {
        unit: "mean edges",
        larger: "Cloth that follows slowly is torn.",
        smaller: "Held vertices may stand still.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Longest move of held vertices while friction acts: sliding contacts are held by the pressure before the move.
    PIN_MOVE_FRICTION: f64 = 0.1, {
        unit: "mean edges",
        larger: "Contacts slide too far in a move.",
        smaller: "More rounds.",
        tried: "0.1, 0.5",
        evidence: "With long moves a strip pulled round a cylinder lost up to 3.5 % of its tension.",
    }
    /// Mean part of the steps of a block below which the cloth did not follow.
    PIN_FOLLOW_PART: f64 = 0.1, {
        unit: "part of the full step",
        larger: "Held vertices wait more often.",
        smaller: "They go on although the cloth stays behind.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Part of the way of held vertices after which the steps of a descent count anew.
    PIN_WAY_PART: f64 = 0.1, {
        unit: "part of the way that is left",
        larger: "Cloth that is led far over a rough body is given up on its way.",
        smaller: "Cloth that hardly follows is given up later.",
        tried: "0.1",
        evidence: "A sheet 280 mm long, pushed over a table by 260 mm, takes more than 5,000 steps.",
    }
    /// Decrement over the elastic energy above which held vertices wait.
    PIN_HALT_DECREMENT: f64 = 0.5, {
        unit: "elastic energy",
        larger: "They go on although the cloth is taut.",
        smaller: "They wait for nearly every block.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Rise of the energy in a move of held vertices, over the elastic energy and the work of lifting the cloth, up to which
    /// the move does not tear.
    PIN_ENERGY_RISE_MOST: f64 = 10.0, {
        unit: "elastic energy and lifting work",
        larger: "Single triangles may be torn.",
        smaller: "Moves are shortened without need.",
        tried: "not recorded",
        evidence: "A corner moved by itself over a bed of needles tore at its two triangles with a thousand times the strain limit.",
    }
    /// Times that a move of held vertices is quartered.
    PIN_SHORTENINGS: usize = 4, {
        unit: "times",
        larger: "More evaluations in a move.",
        smaller: "Moves may still tear.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Strain above which held vertices wait, and the cloth counts as held back.
    PIN_HALT_STRAIN: f64 = 3.0, {
        unit: "strain",
        larger: "Cloth that is held back is pulled further, at great cost.",
        smaller: "Elastic yarns may be halted.",
        tried: "3, infinite",
        evidence: "A cotton sheet drawn through a ring of 38 mm ends after 7 seconds instead of 131. Elastane breaks near this strain.",
    }
    /// Part of its strain to which cloth that is held back must ease.
    PIN_STRAIN_EASED: f64 = 0.9, {
        unit: "part of the least strain",
        larger: "Slow easing counts, and the descent goes on.",
        smaller: "Cloth that eases slowly is given up.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Rounds in which it must ease.
    PIN_STRAIN_ROUNDS: u32 = 12, {
        unit: "rounds",
        larger: "Held back cloth is given up later.",
        smaller: "Cloth that would come through is given up.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Part of a move of held vertices by which its change of the forces is probed.
    PIN_PROBE_PART: f64 = 1e-3, {
        unit: "part of the move",
        larger: "The probe leaves the linear range.",
        smaller: "The probe loses digits.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// Blocks without self-contact before speculation begins again, the first time that cloth was taken back.
    SPECULATION_WAIT_FIRST: u32 = 4, {
        unit: "blocks",
        larger: "Detection accompanies more steps without need.",
        smaller: "Cloth is taken back more often.",
        tried: "not recorded",
        evidence: "Of eight garments at 12 mm, 607 blocks went ahead and 6 were taken back.",
    }
    /// The same, at most; it doubles each time.
    SPECULATION_WAIT_MOST: u32 = 64, {
        unit: "blocks",
        larger: "Detection accompanies more steps without need.",
        smaller: "Cloth is taken back more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Blocks to one check of a drape, at first.
    SPECULATION_BLOCKS_FIRST: u32 = 2, {
        unit: "blocks",
        larger: "More steps are lost when cloth is taken back.",
        smaller: "More checks.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Blocks to one check of a drape, at most.
    SPECULATION_BLOCKS_MOST: u32 = 4, {
        unit: "blocks",
        larger: "More steps are lost when cloth is taken back.",
        smaller: "More checks.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// Saddles that are left in a descent, at most.
    SADDLES_MOST: u32 = 8, {
        unit: "saddles",
        larger: "More descents before cloth is called at rest on a saddle.",
        smaller: "Cloth may rest on a saddle.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Power iterations for the direction of most negative curvature.
    CURVATURE_POWER_ROUNDS: usize = 12, {
        unit: "iterations",
        larger: "A better direction, each round a solve.",
        smaller: "The direction may not lead down.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// First move along that direction.
    CURVATURE_MOVE_FIRST: f64 = 0.1, {
        unit: "mean edges",
        larger: "The move may pass the valley beside the saddle.",
        smaller: "More steps to leave the saddle.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Times that the move is halved.
    CURVATURE_HALVINGS: u32 = 6, {
        unit: "times",
        larger: "More evaluations where no way leads down.",
        smaller: "Narrow valleys are missed.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least energy that leaving a saddle must gain.
    CURVATURE_GAIN_LEAST: f64 = 1e-6, {
        unit: "elastic energy",
        larger: "Shallow saddles count as rest.",
        smaller: "Rounding may count as a way down.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// Steps of conjugate gradients after which only a factorisation can tell how far cloth is from rest.
    BOUND_STEPS: usize = 30, {
        unit: "steps",
        larger: "More work where the bound does not reach.",
        smaller: "More factorisations of large cloth.",
        tried: "not recorded",
        evidence: "From usual starts the first step is enough.",
    }
    /// Margin of the bound over what it is to prove: the factor is in single precision.
    BOUND_MARGIN: f64 = 1.05, {
        unit: "factor",
        larger: "Fewer starts are seen to be far from rest.",
        smaller: "Rounding may decide.",
        tried: "not recorded",
        evidence: "It must be more than the rounding of single precision.",
    }
    /// Decrement over the elastic energy above which a coarser level finds the way first.
    COARSE_FIRST_DECREMENT: f64 = 0.5, {
        unit: "elastic energy",
        larger: "Shaken starts go without a coarser level.",
        smaller: "Starts near rest take the detour.",
        tried: "0.5, 1",
        evidence: "A shaken start of 100,000 triangles took 92 CPU seconds without a coarser level, 36 with one.",
    }
    /// Tolerances of a coarser level over those of the finer one.
    COARSE_TOLERANCE_FACTOR: f64 = 3.0, {
        unit: "factor",
        larger: "The finer level has more to do.",
        smaller: "The coarser level takes more steps.",
        tried: "3, 10, 30",
        evidence: "Ten times the tolerances gains nothing, thirty times loses.",
    }
    /// Tolerances of the first large coarser level over those of the finer one.
    COARSE_TOLERANCE_FACTOR_LARGE: f64 = 0.1, {
        unit: "factor",
        larger: "Errors that are left take the finer cloth many times as long.",
        smaller: "The coarser level takes more steps.",
        tried: "0.1 to 3",
        evidence: "100,000 triangles took 203 steps on the finest level with it, 589 where the coarser level was left at 3e-4.",
    }
}

mechanisms! {
    room "optimize";

    /// Adapts the shift by the mass and the isotropic share to how far steps went. Without it the Hessian stays as it is.
    REGULARISATION = "regularisation";
    /// Uses the full Hessian near rest where it is positive definite.
    FULL_HESSIAN = "full-hessian";
    /// Lets a factor serve several blocks near rest.
    FACTOR_REUSE = "factor-reuse";
    /// Uses a bending Hessian with fewer couplings until the cloth is nearly at rest.
    SURROGATE_HESSIAN = "surrogate-hessian";
    /// Takes steps ahead of detection of self-contact, and takes them back where it was needed.
    SPECULATION = "speculative-steps";
    /// Finds the way on coarser levels first.
    COARSE_LEVELS = "coarse-levels";
    /// Gives cloth that starts in balance the contact loads that hold it.
    CONTACT_WARM_START = "contact-warm-start";
    /// Stiffens contacts that are pressed nearly shut.
    ADAPTIVE_STIFFNESS = "adaptive-stiffness";
    /// Moves contacts out that gave way under their load.
    GAP_UPDATE = "gap-update";
    /// Switches the strain-limit barrier off while cloth falls, and widens it where cloth is slow to settle.
    STRAIN_LIMIT_HOMOTOPY = "strain-limit-homotopy";
    /// Leaves saddles along the direction of most negative curvature.
    NEGATIVE_CURVATURE = "negative-curvature";
}
