//! Tuned numbers and mechanisms of sewing.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "sewing";

    /// Force of the threads at first, per length of seam.
    SEWING_FORCE_FIRST: f64 = 1.0, {
        unit: "N/m",
        larger: "Pieces that are far apart are pulled hard before they are turned.",
        smaller: "More blocks until the pieces come.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest force of the threads while the pieces come together.
    SEWING_FORCE_MOST: f64 = 300.0, {
        unit: "N/m",
        larger: "Cloth is stretched hard where something is in the way.",
        smaller: "Tight seams stay open.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of the force after a block without progress.
    SEWING_FORCE_FACTOR: f64 = 2.5, {
        unit: "factor",
        larger: "The force soon is larger than it need be.",
        smaller: "More blocks.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Steps of a block without progress above which the force grows.
    SEWING_FORCE_BLOCK_STEPS: usize = 3, {
        unit: "steps",
        larger: "The force grows later.",
        smaller: "The force grows although the block hardly moved the cloth.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Mean part of the steps of such a block above which the force grows.
    SEWING_FORCE_MEAN_PART: f64 = 0.3, {
        unit: "part of the full step",
        larger: "The force grows later.",
        smaller: "The force grows although steps fall short.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Force of the threads at the sewing distance while they are drawn tight.
    SEWING_FORCE_TIGHT: f64 = 1e4, {
        unit: "N/m",
        larger: "Steps are short beside the stiffness of the threads.",
        smaller: "Tight seams stay open.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Gap at which the full force acts while the pieces come together.
    GATHERING_REACH: f64 = 0.25, {
        unit: "mean edges",
        larger: "The force fades before the seams are closed.",
        smaller: "The threads are stiffer, and steps shorter.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest τ of the regularisation while the pieces come together.
    GATHERING_TAU_MOST: f64 = 1.0, {
        unit: "dimensionless",
        larger: "Long steps that fall short.",
        smaller: "More steps.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Part of the widest gap after a block above which the block made no progress.
    SEWING_GAP_PROGRESS: f64 = 0.9, {
        unit: "part of the widest gap",
        larger: "The force grows later.",
        smaller: "The force grows although the pieces come by themselves.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Blocks without much progress after which something must be in the way. A standstill counts four times.
    GATHERING_IDLE_MOST: u32 = 80, {
        unit: "blocks",
        larger: "More work before sewing is given up.",
        smaller: "Garments are given up that would still close.",
        tried: "40, 80, 160",
        evidence: "Ten garments pass with each. CPU time of sewing and draping, in the median: 0.90 with 80 and 0.91 with 40 of that with 160.",
    }
    /// Widest gap at which the pieces are together and the threads are drawn tight.
    GATHERED_GAP: f64 = 0.1, {
        unit: "mean edges",
        larger: "Tightening has more to do.",
        smaller: "More blocks of gathering.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Longest move of a vertex in a step of sewing.
    SEWING_STEP_CAP_EDGES: f64 = 0.3, {
        unit: "mean edges",
        larger: "Contacts are passed before they are felt, and flat cloth is stretched instead of bent.",
        smaller: "More steps.",
        tried: "not recorded",
        evidence: "The page on sewing holds the comparison; no table is kept.",
    }
    /// Largest part of a step that is tried first, over the part that was taken last.
    SEWING_STEP_GROWTH: f64 = 1.3, {
        unit: "factor",
        larger: "More trials: a part that was too long for one step is so for the next.",
        smaller: "More short steps.",
        tried: "1.3, infinite",
        evidence: "Cloth that is turned far takes few whole steps. The page on sewing holds the comparison.",
    }

    /// Distance at which cloth feels the body at first.
    STAND_OFF_EDGES: f64 = 0.6, {
        unit: "mean edges",
        larger: "No room is left in a fitted garment.",
        smaller: "Cloth is caught at the body instead of sliding round it.",
        tried: "not recorded",
        evidence: "The page on sewing holds the comparison; no table is kept.",
    }
    /// The same, at most.
    STAND_OFF_MOST: f64 = 0.012, {
        unit: "m",
        larger: "No room is left in a fitted garment on a coarse mesh.",
        smaller: "Cloth on coarse meshes is caught at the body.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// The same, at least.
    STAND_OFF_EDGES_LEAST: f64 = 0.05, {
        unit: "mean edges",
        larger: "Tight garments stay open.",
        smaller: "More rounds in a tight garment.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Factor of that distance each time that the cloth is let nearer to the body.
    STAND_OFF_FACTOR: f64 = 0.7, {
        unit: "factor",
        larger: "More rounds.",
        smaller: "Cloth comes to the body at once.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Force from which cloth that no longer comes is let nearer to the body.
    STAND_OFF_CRAMPED_FORCE: f64 = 40.0, {
        unit: "N/m",
        larger: "Cramped cloth is pulled harder before it gets room.",
        smaller: "Cloth comes to the body while it still has a long way to go.",
        tried: "not recorded",
        evidence: "The page on sewing holds the comparison; no table is kept.",
    }
    /// Widest gap at which a seam that no longer closes lets the cloth nearer to the body.
    STAND_OFF_NARROW_GAP: f64 = 2.0, {
        unit: "mean edges",
        larger: "Cloth comes to the body while seams are far open.",
        smaller: "Seams in narrow places stay open.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// Gap at which a stitch is closed, and its vertices are put on one point.
    CLOSED_GAP: f64 = 0.1, {
        unit: "sewing distance",
        larger: "Vertices jump further when they are joined.",
        smaller: "More tightening.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Energy gained in a block at which a closed garment is sewn well enough to drape.
    SEWN_ENERGY_SHARE: f64 = 0.2, {
        unit: "elastic energy",
        larger: "The drape begins farther from rest.",
        smaller: "More tightening.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Part of the widest gap after a block of tightening above which the gaps no longer shrink.
    TIGHTENING_GAP_PROGRESS: f64 = 0.9, {
        unit: "part of the widest gap",
        larger: "Tightening in vain goes on.",
        smaller: "Tightening ends while gaps still shrink.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Energy gained in a block at which tightening without progress is in vain.
    TIGHTENING_ENERGY_SHARE: f64 = 0.01, {
        unit: "elastic energy",
        larger: "Tightening ends while the cloth still moves.",
        smaller: "Tightening in vain goes on.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Most steps of tightening.
    TIGHTENING_STEPS_MOST: u64 = 200, {
        unit: "steps",
        larger: "More work on seams that stay open.",
        smaller: "Seams stay open that would close.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// Strain of welded cloth over its limit, above which its seams count as open.
    SEWN_STRAIN_MOST: f64 = 3.0, {
        unit: "strain limits",
        larger: "Seams that are much too short are welded, and only the drape's certificate tells.",
        smaller: "Tight garments stay open after sewing.",
        tried: "3",
        evidence: "A belt of three quarters of its girth ends at 18.8 limits, a strapless dress on the hips at 1.07.",
    }
    /// Energy gained in a block at which a settling level gained little.
    SETTLING_ENERGY_SHARE: f64 = 0.01, {
        unit: "elastic energy",
        larger: "The next level begins farther from rest.",
        smaller: "More steps.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance that settling cloth may slide; cloth that slides farther falls off.
    SETTLING_SLIDE_MOST: f64 = 0.15, {
        unit: "m",
        larger: "Cloth that falls off the body is taken for settled.",
        smaller: "Garments stay where sewing left them.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// τ with which settling begins: sewn cloth lies near its rest.
    SETTLING_TAU_FIRST: f64 = 0.1, {
        unit: "dimensionless",
        larger: "Longer first steps, which fall short more often.",
        smaller: "Shorter first steps.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// τ from which one block with little gain ends the settling.
    SETTLING_TAU_FREE: f64 = 1.0, {
        unit: "dimensionless",
        larger: "More blocks.",
        smaller: "Settling ends because the shift is large.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Blocks without a step after which settling ends.
    SETTLING_STUCK_BLOCKS_MOST: u32 = 6, {
        unit: "blocks",
        larger: "More work on cloth that is stuck.",
        smaller: "Settling ends early.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Blocks with little gain after which settling ends.
    SETTLING_QUIET_BLOCKS: u32 = 3, {
        unit: "blocks",
        larger: "More steps.",
        smaller: "The next level begins farther from rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Mean part of the steps of a block whose gain counts.
    SETTLING_MEAN_PART: f64 = 0.3, {
        unit: "part of the full step",
        larger: "Fewer blocks count, and settling takes longer.",
        smaller: "Short steps are taken for rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Most steps of settling.
    SETTLING_STEPS_MOST: u64 = 240, {
        unit: "steps",
        larger: "More work on levels that only lead on.",
        smaller: "The next level begins farther from rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }

    /// Steps in which flat pieces are bent for the initial guess.
    GUESS_STEPS: u32 = 8, {
        unit: "steps",
        larger: "More evaluations.",
        smaller: "A blocked piece stops farther from where it could go.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Directions of the lines about which a piece may be bent, over half a turn.
    GUESS_DIRECTIONS: u32 = 8, {
        unit: "directions",
        larger: "More candidates for each piece.",
        smaller: "Slanting pieces fit less well.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Bends about a line that are tried to each side at first.
    GUESS_BENDS: u32 = 6, {
        unit: "bends",
        larger: "More candidates for each piece.",
        smaller: "A coarser first choice.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Rounds in which pieces are bent to each other.
    GUESS_ROUNDS: usize = 2, {
        unit: "rounds",
        larger: "More work for little gain.",
        smaller: "Pieces fit each other less well.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance of the vertices from a plane up to which a piece is flat.
    GUESS_FLATNESS: f64 = 1e-3, {
        unit: "size of the piece",
        larger: "Curved pieces are bent as if they were flat.",
        smaller: "Pieces that are flat but for rounding are left out.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
}

mechanisms! {
    room "sewing";

    /// Bends flat pieces towards the places that their threads lead to, before the threads pull.
    INITIAL_GUESS = "initial-guess";
    /// Lets cloth feel the body from farther off while it is sewn, so that it slides round it.
    STAND_OFF = "stand-off";
    /// Sews coarser levels first.
    MULTILEVEL_SEWING = "multilevel-sewing";
}
