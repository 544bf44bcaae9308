//! Tuned numbers and mechanisms of the paper's explicit scheme.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "explicit";

    /// Stiffness of a contact in units of its effective mass over the square of the time step.
    EXPLICIT_CONTACT_STIFFNESS: f64 = 0.15, {
        unit: "mass / step²",
        larger: "Contacts are pressed in less, and the step comes nearer to the limit of stability.",
        smaller: "Contacts are pressed in deeper, and impulses stop more approaches.",
        tried: "not recorded",
        evidence: "No measurement is kept. A single spring is unstable from 4 on; several contacts share a vertex.",
    }
    /// Share of the distance to other cloth that a vertex may move before distances are measured again.
    CLOTH_BALL_SHARE: f64 = 0.45, {
        unit: "share of the distance",
        larger: "Distances are measured less often; from 0.5 on two vertices could meet.",
        smaller: "Distances are measured more often.",
        tried: "not recorded",
        evidence: "Both sides move, so the share must stay below one half.",
    }
    /// Share of the distance to the body that a vertex may move before distances are measured again.
    BODY_BALL_SHARE: f64 = 0.9, {
        unit: "share of the distance",
        larger: "Distances are measured less often; from 1 on a vertex could pass the body.",
        smaller: "Distances are measured more often.",
        tried: "not recorded",
        evidence: "The body stands still, so the share must stay below one.",
    }
    /// Share of the gap of its vertices at which an edge or a face is held off.
    EXPLICIT_EDGE_GAP_SHARE: f64 = 0.5, {
        unit: "share of the gap",
        larger: "Edges and faces carry over a curved body, and vertices hang in the air.",
        smaller: "Edges come nearer to sharp features of the body.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least number of steps between two measurements of the distances.
    DISTANCE_MEASURE_STEPS_MIN: u32 = 5, {
        unit: "steps",
        larger: "More vertices are held back in their balls, and less time goes into distances.",
        smaller: "Fewer vertices are held back, and more time goes into distances.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of its gap below which a contact is hard: impulses take any approach out of the velocities.
    HARD_CONTACT_SHARE: f64 = 0.25, {
        unit: "share of the gap",
        larger: "Impulses act earlier, and contacts feel harder.",
        smaller: "Springs alone carry more of the load, and tight cloth comes nearer to the body.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the missing distance by which a hard contact is let out in one step.
    HARD_CONTACT_RELEASE_SHARE: f64 = 0.05, {
        unit: "share of the missing distance per step",
        larger: "Contacts recover sooner and bring in energy.",
        smaller: "Contacts recover later.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest speed at which a hard contact is let out.
    HARD_CONTACT_RELEASE_SPEED: f64 = 0.1, {
        unit: "m/s",
        larger: "Contacts recover sooner and bring in energy.",
        smaller: "Contacts recover later.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance that is taken off every measured distance before its ball is made.
    DISTANCE_FLOOR: f64 = 2e-6, {
        unit: "m",
        larger: "Cloth within that distance hardly moves.",
        smaller: "Rounding of the lists, which are partly in single precision, comes into reach.",
        tried: "not recorded",
        evidence: "The value is far above the rounding of single precision at a metre, 6e-8 m.",
    }
    /// Least share of a measured distance that is left once `DISTANCE_FLOOR` has been taken off.
    DISTANCE_FLOOR_SHARE: f64 = 0.1, {
        unit: "share of the distance",
        larger: "Cloth below the floor keeps more of its freedom.",
        smaller: "Cloth below the floor is held in place.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Sum of contact weights at a vertex above which each of its contacts is made softer.
    CONTACT_CROWD: f64 = 6.0, {
        unit: "contacts",
        larger: "Many contacts at one vertex together may pass the limit of stability.",
        smaller: "Contacts are softer where several meet.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Motion, in steps at the present speed, for which a list of near pairs holds.
    PAIR_LIST_STEPS: f64 = 40.0, {
        unit: "steps",
        larger: "Lists are made less often and hold more pairs.",
        smaller: "Lists are made more often and hold fewer pairs.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least motion for which a list of near pairs holds.
    PAIR_LIST_SLACK_MIN: f64 = 0.12, {
        unit: "mean edges",
        larger: "Lists of cloth at rest hold more pairs.",
        smaller: "Lists of slow cloth are made more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest motion for which a list of near pairs holds.
    PAIR_LIST_SLACK_MAX: f64 = 0.5, {
        unit: "mean edges",
        larger: "Lists of fast cloth hold more pairs.",
        smaller: "Lists of fast cloth are made more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Reach of the lists in units of the largest gap.
    PAIR_REACH_GAPS: f64 = 1.5, {
        unit: "gaps",
        larger: "Lists hold more pairs, and balls of free cloth are larger.",
        smaller: "Contacts are found late; below 1 some are missed.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least reach of the lists.
    PAIR_REACH_MIN: f64 = 0.2, {
        unit: "mean edges",
        larger: "Lists hold more pairs, and balls of free cloth are larger.",
        smaller: "Distances are measured more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Reach of the lists of moving cloth, in steps at the present speed.
    PAIR_REACH_STEPS: f64 = 30.0, {
        unit: "steps",
        larger: "Lists hold more pairs, and balls of free cloth are larger.",
        smaller: "Distances are measured more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest reach of the lists that speed calls for.
    PAIR_REACH_MAX: f64 = 0.8, {
        unit: "mean edges",
        larger: "Lists of fast cloth hold more pairs.",
        smaller: "Distances of fast cloth are measured more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance, in gaps, within which two primitives become a contact pair.
    CONTACT_PAIR_GAPS: f64 = 2.0, {
        unit: "gaps",
        larger: "Pairs are made earlier, and more of them carry nothing.",
        smaller: "Cloth may pass into a gap between two measurements without a force.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// A vertex that is stiffer per mass than this many times the median gets more inertia.
    MASS_SCALING_STIFFNESS_RATIO: f64 = 2.0, {
        unit: "median stiffness per mass",
        larger: "Fewer vertices get inertia, and small triangles rule the time step.",
        smaller: "More vertices get inertia, and the cloth moves more slowly.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Speed at which a held vertex is led to its place.
    HELD_VERTEX_SPEED: f64 = 1.0, {
        unit: "m/s",
        larger: "Held vertices arrive sooner and pull harder at the cloth.",
        smaller: "Held vertices arrive later.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance from its place at which a held vertex counts as placed.
    HELD_VERTEX_DISTANCE: f64 = 1e-6, {
        unit: "m",
        larger: "Rest is found while held vertices are still on their way.",
        smaller: "Rounding could keep a vertex from its place.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Steps between two checks of the energy, and steps of one round of velocity reduction at the end.
    ENERGY_CHECK_STEPS: u64 = 64, {
        unit: "steps",
        larger: "An unstable step is found later.",
        smaller: "More time goes into energies.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of the energy between two checks that proves a step too long.
    ENERGY_GROWTH_SHARE: f64 = 0.2, {
        unit: "share of kinetic and elastic energy",
        larger: "Instability is found later.",
        smaller: "Sound motion is taken for instability, and the step is halved without need.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of the energy between two checks that is always allowed.
    ENERGY_GROWTH_FLOOR: f64 = 1e-9, {
        unit: "J",
        larger: "Instability of very small cloth is found later.",
        smaller: "Rounding of cloth at rest is taken for instability.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the estimated stable step that a motion takes at most.
    MOTION_STEP_FRACTION: f64 = 0.9, {
        unit: "share of the stable step",
        larger: "Steps are fewer; from 1 on the fastest waves grow.",
        smaller: "Steps are more and no better.",
        tried: "0.11, 0.28, 0.89, 0.98 and 1.09",
        evidence: "A level sheet of 4 m falls 4.905 m in a second with 0.11 to 0.89. With 0.98 its fall is wrong by \
                   0.4 %, and with 1.09 it is torn apart.",
    }
    /// Largest number of halvings of the time step.
    STEP_HALVINGS_MAX: u32 = 10, {
        unit: "halvings",
        larger: "A hopeless run ends later.",
        smaller: "A run that a smaller step would save ends.",
        tried: "not recorded",
        evidence: "No measurement is kept. Ten halvings make a thousandth of the stable step.",
    }
    /// Simulated time between two tests of rest: one film frame.
    REST_WINDOW: f64 = 1.0 / 24.0, {
        unit: "s",
        larger: "Rest is found later and more surely.",
        smaller: "A turning point of a swing may pass for rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Quiet windows in a row that count as rest.
    REST_WINDOWS: u32 = 3, {
        unit: "windows",
        larger: "Rest is found later and more surely.",
        smaller: "A turning point of a swing may pass for rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the largest elastic energy so far that at least scales the change of the elastic energy.
    REST_PEAK_ENERGY_SHARE: f64 = 0.01, {
        unit: "share of the peak",
        larger: "Cloth that stored much on its way rests sooner.",
        smaller: "A flat piece, which stores next to nothing at rest, hardly comes to rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the speed tolerance below which open seams are given up.
    OPEN_SEAM_SPEED_SHARE: f64 = 0.1, {
        unit: "share of the speed tolerance",
        larger: "Seams that still close slowly are given up.",
        smaller: "Hopeless seams are given up later.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Factor on the damping in every window whose energy rests while vertices still move.
    DAMPING_GROWTH: f64 = 1.15, {
        unit: "factor per window",
        larger: "Trembling dies sooner, and slow motion may be stopped.",
        smaller: "Trembling keeps a run going for longer.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Speed up to which motion counts as trembling, in units of the speed tolerance.
    TREMBLING_SPEED: f64 = 10.0, {
        unit: "speed tolerances",
        larger: "Cloth that falls or swings is damped, too.",
        smaller: "Faster trembling keeps a run going.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest damping rate that growth may reach.
    DAMPING_RATE_MAX: f64 = 100.0, {
        unit: "1/s",
        larger: "Real motion could pass for rest.",
        smaller: "Trembling keeps a run going for longer.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest number of rounds of velocity reduction at the end.
    VELOCITY_REDUCTION_ROUNDS: u32 = 40, {
        unit: "rounds",
        larger: "Forces balance better at the end of a slow run.",
        smaller: "More imbalance may be left.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the velocity that is left after every step of velocity reduction.
    VELOCITY_REDUCTION_SHARE: f64 = 0.5, {
        unit: "share",
        larger: "The cloth creeps on for longer.",
        smaller: "Forces balance more slowly.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Net force over the mean weight of a vertex at which velocity reduction ends.
    BALANCED_RESIDUAL: f64 = 0.02, {
        unit: "mean vertex weights",
        larger: "A run ends with more imbalance.",
        smaller: "More rounds are taken.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Ratio of the residual to the best so far above which a round of velocity reduction gained nothing.
    BALANCE_GAIN: f64 = 0.9, {
        unit: "ratio",
        larger: "More rounds are taken for little.",
        smaller: "Slow gains are given up.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Residual, in units of `BALANCED_RESIDUAL`, below which rounds without a gain end.
    BALANCE_GIVE_UP: f64 = 10.0, {
        unit: "balanced residuals",
        larger: "Rounds end sooner where nothing is gained.",
        smaller: "Rounds go on although nothing is gained.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Time after which the cap of the sewing force begins to double.
    SEWING_CAP_DELAY: f64 = 0.5, {
        unit: "s",
        larger: "Tight seams close later.",
        smaller: "Pieces that are still far apart are pulled hard.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Time in which the cap of the sewing force doubles, so that a tight seam closes in the end.
    SEWING_CAP_DOUBLING: f64 = 0.15, {
        unit: "s",
        larger: "Tight seams close later.",
        smaller: "The force outruns the motion that it causes.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest number of doublings of the cap of the sewing force.
    SEWING_CAP_DOUBLINGS: f64 = 11.0, {
        unit: "doublings",
        larger: "Hopeless seams are pulled harder and given up later.",
        smaller: "Tight seams stay open.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of the sewing stiffness c_s once the cap has doubled most often.
    SEWING_STIFFNESS_GROWTH: f64 = 4.0, {
        unit: "times its first value, added",
        larger: "The sewing force may become unstable.",
        smaller: "Last gaps close more slowly.",
        tried: "not recorded",
        evidence: "Five times in all is as far as the time step allows (docs/sewing.md).",
    }
    /// Distance at which pairs are joined once the sewing force has grown to its most.
    LAST_RESORT_DISTANCE: f64 = 0.7, {
        unit: "mean edges",
        larger: "Cloth is distorted where seams are joined from far apart.",
        smaller: "Tight seams stay open.",
        tried: "not recorded",
        evidence: "No measurement is kept. The pull is then as strong as it must be (docs/sewing.md).",
    }
    /// Time that is left for joining at the last distance.
    LAST_RESORT_TIME: f64 = 0.5, {
        unit: "s",
        larger: "Hopeless seams are given up later.",
        smaller: "Seams that still close are given up.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of its gap that a joined pair closes in a step.
    JOINED_CLOSING_SHARE: f64 = 0.1, {
        unit: "share per step",
        larger: "Joined pairs close with a jolt.",
        smaller: "Joined pairs close later.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance at which a joined pair is put on one point.
    JOINED_SNAP_DISTANCE: f64 = 1e-9, {
        unit: "m",
        larger: "The jump on to one point could be felt.",
        smaller: "Rounding could keep a pair apart.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Steps after which all triangles are tested for elongation again; those near the limit are tested in every step.
    ELONGATION_WATCH_STEPS: u32 = 16, {
        unit: "steps",
        larger: "A triangle may pass its limit before it is watched.",
        smaller: "More time goes into triangles far from the limit.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the allowed elongation from which a triangle is watched.
    ELONGATION_WATCH_SHARE: f64 = 0.8, {
        unit: "share of the limit",
        larger: "A triangle may pass its limit before it is watched.",
        smaller: "More triangles are watched in every step.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest number of passes over the watched triangles in a step.
    ELONGATION_PASSES: usize = 6, {
        unit: "passes",
        larger: "Less elongation is left over, and steps take longer.",
        smaller: "More elongation is left over.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the limit to which elongation is corrected: what a few passes leave over must stay inside the limit.
    ELONGATION_TARGET_SHARE: f64 = 0.95, {
        unit: "share of the limit",
        larger: "Elongation may pass the limit by what the passes leave over.",
        smaller: "The cloth locks earlier than its limit.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest number of passes over the watched triangles for the balance of a state at rest.
    ELONGATION_PASSES_AT_REST: usize = 500, {
        unit: "passes",
        larger: "The balance of forces is told more exactly.",
        smaller: "The balance of forces counts what the passes leave over.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
}

mechanisms! {
    room "explicit";

    /// Gives inertia, not weight, to vertices that are much stiffer per mass than the median, so that they do not
    /// rule the time step.
    MASS_SCALING = "explicit-mass-scaling";
    /// Halves the time step and goes back to the last sound state where the energy grows.
    STEP_HALVING = "explicit-step-halving";
    /// Raises the damping while the energy rests and single vertices still tremble.
    DAMPING_RAISE = "explicit-damping-growth";
    /// Takes half of the velocity out of every step at the end of a drape, until forces balance.
    VELOCITY_REDUCTION = "explicit-velocity-reduction";
    /// Takes any approach out of the velocities of contacts that are pressed nearly shut.
    HARD_CONTACT = "explicit-hard-contact";
    /// Makes contacts softer where many meet on one vertex.
    CROWD_SOFTENING = "explicit-crowd-softening";
    /// Doubles the cap of the sewing force again and again while seams stay open.
    SEWING_FORCE_GROWTH = "explicit-sewing-force-growth";
    /// Joins the pairs that are left within a share of an edge once the sewing force has grown to its most.
    LAST_RESORT_JOINING = "explicit-last-resort-joining";
}
