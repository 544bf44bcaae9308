//! Tuned numbers and mechanisms of collision detection.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "collision";

    /// Share of its distance that a pair keeps in one step.
    DISTANCE_KEPT_PER_STEP: f64 = 0.2, {
        unit: "share of the distance",
        larger: "Cloth approaches contacts in more, shorter steps.",
        smaller: "Steps end closer to the body, where the barrier is stiff. It must stay below 0.8.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance below which a pair approaches only slowly.
    SLOW_APPROACH_DISTANCE: f64 = 2e-5, {
        unit: "m",
        larger: "Cloth under high loads is held further off the body.",
        smaller: "Distances come near the rounding of single precision.",
        tried: "not recorded",
        evidence: "No measurement is kept. It is far above rounding, also in single precision.",
    }
    /// Share of the time of impact that is used.
    IMPACT_FRACTION_USED: f64 = 0.9, {
        unit: "share of the time of impact",
        larger: "Steps reach closer to the impact, and rounding gets less room.",
        smaller: "Steps are shorter.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest number of advances of one continuous test.
    ADVANCES_PER_TEST: usize = 64, {
        unit: "advances",
        larger: "Grazing motions are followed further, at a higher cost.",
        smaller: "Grazing motions end early: the step is shortened without need.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// An advance ends once this share of the room between the distance and the least distance is left.
    ADVANCE_END_SHARE: f64 = 0.05, {
        unit: "share of the room",
        larger: "Tests end sooner with a shorter step.",
        smaller: "Tests take more advances.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// A pair within this share of a distance counts as having reached it.
    REACHED_DISTANCE_TOLERANCE: f64 = 1e-3, {
        unit: "share of the distance",
        larger: "More proofs of clear motion fail.",
        smaller: "Proofs of clear motion take more advances.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// First radius of the search for the nearest place on the body. It is doubled until there is one.
    NEAREST_PLACE_RADIUS: f64 = 1e-3, {
        unit: "diagonal of the body's box",
        larger: "The first search visits more triangles.",
        smaller: "More searches are made for places far from the body.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// A proximity list is made anew when its radius exceeds the wanted one by this factor.
    PROXIMITY_LIST_EXCESS: f64 = 3.0, {
        unit: "1",
        larger: "PackedLists that hold many useless entries are kept.",
        smaller: "PackedLists are made more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// A proximity list of at most this length is kept whatever its radius.
    SHORT_PROXIMITY_LIST: usize = 8, {
        unit: "entries",
        larger: "More wide lists are kept.",
        smaller: "Short lists are made anew although they cost little.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Margin of the proximity lists over the mean edge.
    PROXIMITY_LIST_MARGIN: f64 = 0.12, {
        unit: "mean edges",
        larger: "PackedLists last longer and hold more entries.",
        smaller: "PackedLists are made more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Longest move of a step, over the mean edge, up to which proximity lists get a margin.
    PROXIMITY_LIST_STEP_LIMIT: f64 = 0.3, {
        unit: "mean edges",
        larger: "PackedLists of fast cloth get a margin that one step uses up.",
        smaller: "PackedLists of slow cloth are made at each step.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Square of the sine below which two edges count as parallel.
    PARALLEL_EDGE_SINE_SQUARED: f64 = 1e-3, {
        unit: "1",
        larger: "More pairs of edges only stop each other and do not push.",
        smaller: "The nearest places of nearly parallel edges jump from end to end, and descents come to no rest.",
        tried: "not recorded",
        evidence: "A frictionless sleeve on an elliptic tube rested in 0.5 s instead of 50 s (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// Least cosine between the normals of a smooth patch and their mean.
    /// It is also the least part of a triangle's area seen along the mean.
    NORMAL_CONE_COSINE: f64 = 0.5, {
        unit: "1",
        larger: "Fewer patches are skipped, and more pairs of neighbours are tested.",
        smaller: "Triangles of a skipped patch could come nearer than their gap.",
        tried: "not recorded",
        evidence: "At 0.5 triangles keep at least 0.4 of an altitude, more than any gap (docs/contact.md).",
    }
    /// Largest sum of rest angles around a border vertex of a smooth patch.
    NORMAL_CONE_BORDER_ANGLE: f64 = 1.4 * std::f64::consts::PI, {
        unit: "rad",
        larger: "The two sides of a slit could overlap unseen.",
        smaller: "Fewer patches at borders are skipped.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest sum of rest angles around an inner vertex of a smooth patch.
    NORMAL_CONE_INNER_ANGLE: f64 = 2.2 * std::f64::consts::PI, {
        unit: "rad",
        larger: "A surplus of cloth, which must ruffle, could overlap unseen.",
        smaller: "Fewer patches at seams and darts are skipped.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Side of the cells in which one corner of a smooth body stands for all, over the mean edge of coarser cloth.
    FEATURE_CELL: f64 = 0.15, {
        unit: "mean edges of the cloth",
        larger: "Fewer corners hold coarse cloth off, and it may touch the body.",
        smaller: "Coarse cloth on a fine body is tested against more corners.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest fall of a smooth body below its tangent over the length of such a cell.
    FEATURE_DEPTH: f64 = 0.1, {
        unit: "share of the gap",
        larger: "More edges are left out, and coarse cloth comes nearer to the body.",
        smaller: "Coarse cloth is tested against more edges of the body.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest angle between two faces of a body that count as coplanar.
    COPLANAR_ANGLE: f64 = 1e-6, {
        unit: "rad",
        larger: "Nearly flat faces act as one, and a vertex stands off an edge between them less exactly.",
        smaller: "Rounding of the body's positions separates faces of one plane.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
}

mechanisms! {
    room "collision";

    /// Skips pairs of neighbouring triangles in smooth patches of cloth.
    NORMAL_CONE_CULLING = "normal-cone-culling";
    /// Keeps the features of the body beside each vertex and triangle of the cloth with their distances.
    PROXIMITY_LISTS = "proximity-lists";
    /// Skips listed pairs of cloth and body whose distance has not been used up by motion.
    PAIR_DISTANCE_BOUNDS = "pair-distance-bounds";
    /// Lets nearly parallel edges only stop each other, so that their contact does not jump from end to end.
    PARALLEL_EDGES_ONLY_STOP = "parallel-edges-only-stop";
    /// Lets coplanar faces of a body push a vertex as one face.
    COPLANAR_FACES = "coplanar-faces";
    /// Leaves out edges and corners of a closed body that nothing outside can touch first.
    CONVEX_FEATURES = "convex-features";
    /// Leaves out corners and edges of a smooth, finely meshed body for coarser cloth.
    FEATURE_DECIMATION = "feature-decimation";
}
