//! Tuned numbers and mechanisms of the coarser levels.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "hierarchy";

    /// Wanted mean edge of a coarser level over that of the finer one.
    LEVEL_EDGE_RATIO: f64 = 2.0, {
        unit: "mean edges of the finer cloth",
        larger: "Levels are coarser, and the finer cloth has more left to do.",
        smaller: "Levels are finer and take longer themselves.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Longest mean edge of a level.
    LEVEL_EDGE_MAX: f64 = 0.045, {
        unit: "m",
        larger: "Folds of the level come out wrong, and the finer cloth keeps them.",
        smaller: "Fewer meshes have a coarser level.",
        tried: "not recorded",
        evidence: "Above about twice the bending length folds come out wrong (docs/hierarchy.md).",
    }
    /// Longest mean edge of a level of a drape, over the bending length of its softest fabric.
    LEVEL_EDGE_BENDING_LENGTHS: f64 = 1.3, {
        unit: "bending lengths",
        larger: "The level finds folds that the finer cloth has to leave again.",
        smaller: "Fewer drapes have a coarser level.",
        tried: "1.3 and 1.7",
        evidence: "At 1.7 folds were others, and the fine cloth took as many steps as without a level.",
    }
    /// Fewest triangles of a level.
    LEVEL_TRIANGLES_MIN: usize = 600, {
        unit: "triangles",
        larger: "Small garments have no coarser level.",
        smaller: "Few and large triangles lock against bending, and the finer cloth keeps the shape.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the triangles of the finer cloth that a level must stay below to be worth its time.
    LEVEL_TRIANGLE_SHARE_MAX: f64 = 0.5, {
        unit: "share of the triangles",
        larger: "Levels that are hardly coarser are used.",
        smaller: "Intricate cloth has no coarser level.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest perturbation of a vertex of a level along each axis.
    PERTURBATION_AMPLITUDE: f64 = 3e-3, {
        unit: "mean edges",
        larger: "From some starts a third more steps are taken.",
        smaller: "Even cloth leaves its saddle late.",
        tried: "0.001, 0.003, 0.005, 0.01 and more",
        evidence: "With 0.005 as many steps are taken; with 0.001, 0.01 and more from some starts a third more.",
    }
    /// Length below which an edge is collapsed, over the wanted length.
    COLLAPSE_EDGE_SHARE: f64 = 0.7, {
        unit: "wanted lengths",
        larger: "Levels are coarser than wanted.",
        smaller: "Levels are finer than wanted.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Longest edge that a collapse may leave, over the wanted length.
    COLLAPSED_EDGE_MAX: f64 = 1.6, {
        unit: "wanted lengths",
        larger: "Levels are less even.",
        smaller: "Fewer edges can be collapsed.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least shape of a triangle after a collapse, unless it had less; 1 is equilateral.
    COLLAPSED_SHAPE_MIN: f64 = 0.35, {
        unit: "shape",
        larger: "Fewer edges can be collapsed.",
        smaller: "Levels have slivers.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Farthest that a collapse may move a border or a seam, over the wanted length.
    BORDER_OFFSET_MAX: f64 = 0.12, {
        unit: "wanted lengths",
        larger: "Borders of a level are cut short at curves.",
        smaller: "Curved borders keep their short edges.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Difference of rest corners up to which two triangles lie in one plane of the cloth.
    REST_CORNER_TOLERANCE: f64 = 1e-7, {
        unit: "m",
        larger: "Edges of separate pieces may count as one.",
        smaller: "Rounding in a file divides a piece.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of inner edges without a common plane above which the rest shape counts as curved.
    CURVED_EDGE_SHARE: f64 = 0.5, {
        unit: "share of the inner edges",
        larger: "Imported meshes are taken for flat pieces.",
        smaller: "Pieces with many seams are taken for curved cloth.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest strain of an edge at which places in space count as those of a curved rest shape.
    REST_SHAPE_STRAIN_MAX: f64 = 1e-3, {
        unit: "strain",
        larger: "The rest shape of a level is less exact.",
        smaller: "More rounds are taken, and strained starts have no level.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Strain up to which an edge is left alone while edges get their rest lengths one by one.
    REST_SHAPE_STRAIN_LEFT: f64 = 7.5e-4, {
        unit: "strain",
        larger: "Nearer to the limit, rounding decides.",
        smaller: "Each correction disturbs its neighbours, and more rounds are taken.",
        tried: "0 and 0.00075",
        evidence: "100,000 triangles take 40 rounds and 0.06 s instead of 153 rounds and 1.1 s.",
    }
    /// Largest number of rounds in which edges get their rest lengths.
    REST_SHAPE_ROUNDS: usize = 400, {
        unit: "rounds",
        larger: "Hopeless starts take longer.",
        smaller: "Strained starts of large cloth have no level.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Farthest that a barycentric weight of an anchor may be outside its triangle.
    ANCHOR_OUTSIDE_MAX: f64 = 0.5, {
        unit: "barycentric weight",
        larger: "Places far outside a triangle are thrown far when it turns.",
        smaller: "Linear maps are not carried over exactly at cut borders.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest strain of a softened level under the weight of cloth as long as its largest part is wide.
    SOFTENED_STRAIN_MAX: f64 = 0.02, {
        unit: "strain",
        larger: "From 3 % on the shape becomes another.",
        smaller: "Heavy cloth is hardly softened and locks into wrong folds.",
        tried: "0.02 to 0.037",
        evidence: "Softer by 0.15 as good as by 0.25; by 0.08 (3.7 %) it finds folds of a third more energy.",
    }
}

mechanisms! {
    room "hierarchy";

    /// Moves the vertices of a coarser level a little, so that even cloth leaves its saddle at once.
    PERTURBATION = "perturbation";
    /// Makes a coarser level softer in its plane, so that its triangles do not lock against folds.
    MEMBRANE_SOFTENING = "membrane-softening";
}
