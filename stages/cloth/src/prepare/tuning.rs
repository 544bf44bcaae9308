//! Tuned numbers and mechanisms of the preparation of a scene.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "prepare";

    /// Length of an edge, over the longest edge of its triangle, below which its ends are draped as one vertex.
    DEGENERATE_EDGE_SHARE: f64 = 2e-3, {
        unit: "longest edges",
        larger: "Narrow cells that drape well are joined.",
        smaller: "Steps turn short edges right over, and a descent gets nowhere.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Length of an edge below which it is left alone, because single precision cannot store its ends.
    DEGENERATE_EDGE_MIN: f64 = 1e-6, {
        unit: "m",
        larger: "More degenerate edges are left in the cloth.",
        smaller: "Ends fall together once they are stored in single precision.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Stretched length over rest length that bounds how far a held part may get.
    ISLAND_STRETCH: f64 = 1.5, {
        unit: "rest lengths",
        larger: "Fewer parts are draped by themselves.",
        smaller: "Parts get farther after all, and all are draped again together.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest number of parts of a scene that are compared with each other.
    ISLANDS_MAX: usize = 500, {
        unit: "parts",
        larger: "Comparing every two parts takes longer.",
        smaller: "Scenes of many parts are draped as one.",
        tried: "not recorded",
        evidence: "No measurement is kept. No garment has as many parts.",
    }
    /// Largest number of rounds in which vertices are pushed out of the body at the start.
    BODY_REPAIR_ROUNDS: usize = 30, {
        unit: "rounds",
        larger: "Hopeless starts are refused later.",
        smaller: "Starts that could be freed are refused.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Growth of the clearance from the body in every round, as a share of the gap.
    BODY_REPAIR_CLEARANCE_GROWTH: f64 = 0.25, {
        unit: "gaps per round",
        larger: "Freed cloth starts farther from the body.",
        smaller: "More rounds are needed at sharp features.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Farthest that two pieces are moved apart at the start.
    PIECES_APART_MAX: f64 = 0.1, {
        unit: "m",
        larger: "Wrong placements are accepted.",
        smaller: "Pieces that overlap in one plane are refused.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// First move of two pieces apart.
    PIECES_APART_FIRST: f64 = 1e-4, {
        unit: "m",
        larger: "Pieces that only touch are moved farther than needed.",
        smaller: "More rounds are taken.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Turns in which a start is freed of itself and then of the body again.
    REPAIR_TURNS: usize = 4, {
        unit: "turns",
        larger: "Starts that cannot be freed are refused later.",
        smaller: "Starts are refused that one turn more would free.",
        tried: "not recorded",
        evidence: "Without a check after one turn a lapel jacket, smoothed longer, kept 53 crossings of the body.",
    }
    /// First move of a piece that starts in the body or in another piece, along one of its axes.
    PIECE_MOVE_FIRST: f64 = 5e-3, {
        unit: "m",
        larger: "Pieces are moved farther than needed.",
        smaller: "More places are tried.",
        tried: "not recorded",
        evidence: "A turtle collar that cuts the neck is free after 25 mm.",
    }
    /// Growth of that move from one round to the next.
    PIECE_MOVE_GROWTH: f64 = 1.3, {
        unit: "factor",
        larger: "Pieces are moved farther than needed.",
        smaller: "More places are tried.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Farthest that a piece is moved.
    PIECE_MOVE_MOST: f64 = 0.4, {
        unit: "m",
        larger: "A piece may land on the other side of the body.",
        smaller: "Pieces that are placed deep in others are refused.",
        tried: "not recorded",
        evidence: "In three public factory files, the farthest move that freed a piece was 0.2 m.",
    }
    /// Growth of the move from round to round.
    PIECES_APART_GROWTH: f64 = 1.5, {
        unit: "factor",
        larger: "Pieces are moved farther than needed.",
        smaller: "More rounds are taken.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Distance by which pieces are moved further than just apart.
    PIECES_CLEARANCE: f64 = 5e-5, {
        unit: "m",
        larger: "Pieces start farther from their places.",
        smaller: "The drape starts with contacts of any stiffness.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Crossing pairs, as a share of the triangles, above which a start is refused instead of drawn out of itself.
    CONTOUR_PAIRS_SHARE_MAX: f64 = 0.08, {
        unit: "share of the triangles",
        larger: "Wrong starts are worked on in vain.",
        smaller: "Coarse levels whose welded seams cross are sewn again from their placement.",
        tried: "0.02, 0.08",
        evidence: "A hoodie whose coarse level has 91 pairs in 3480 triangles is sewn in 17 s instead of 48 s.",
    }
    /// Crossing pairs up to which any start is drawn out of itself; one vertex drawn through the cloth makes up to a dozen.
    CONTOUR_PAIRS_MAX: f64 = 24.0, {
        unit: "pairs",
        larger: "Wrong starts of small cloth are worked on in vain.",
        smaller: "Two pinches in small cloth are refused.",
        tried: "not recorded",
        evidence: "Two pinches at once in a sheet of 288 triangles are resolved (test).",
    }
    /// Largest number of rounds in which contours are shortened.
    CONTOUR_ROUNDS: usize = 150, {
        unit: "rounds",
        larger: "Hopeless starts are refused later.",
        smaller: "Starts that could be freed are refused.",
        tried: "60, 150",
        evidence: "Without smoothing, starts of six garments needed up to 60 rounds; with it a third of the time.",
    }
    /// Longest move of an edge against a triangle in a round, over the length of the edge.
    CONTOUR_STEP_EDGES: f64 = 0.1, {
        unit: "edges",
        larger: "Cloth is drawn through other cloth beside it.",
        smaller: "More rounds are needed, and some contours come to a standstill.",
        tried: "0.02, 0.05, 0.1, falling from 0.15",
        evidence: "Of ten starts of six garments 0.02 left three and 0.1 none (docs/lab/2026-11-30-contours.md).",
    }
    /// Share of the way to the mean of its neighbours that a vertex of a crossing triangle goes in a round.
    CONTOUR_SMOOTHING: f64 = 0.1, {
        unit: "share of the way",
        larger: "The cloth is smoothed more than needed.",
        smaller: "Contours in sharp folds come to a standstill.",
        tried: "0, 0.05, 0.1, 0.2",
        evidence: "Without it the starts took three times as many rounds, and a godet skirt came out torn.",
    }
    /// Sine of the angle of an edge or a face to a triangle below which they count as parallel.
    CONTOUR_SINE_MIN: f64 = 1e-3, {
        unit: "sine",
        larger: "Shallow crossings are left.",
        smaller: "The direction of a contour is that of rounding errors.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
}

mechanisms! {
    room "prepare";

    /// Turns a scene by quarters and sorts its stitches, so that equal scenes come to the same bits.
    CANONICAL_FRAME = "canonical-frame";
    /// Drapes the ends of tiny edges as one vertex.
    DEGENERATE_EDGE_COLLAPSE = "degenerate-edge-collapse";
    /// Drapes parts of cloth that cannot meet each by itself.
    ISLANDS = "islands";
    /// Draws the start out of itself where it crosses at a few places.
    INTERSECTION_RESOLUTION = "intersection-resolution";
}
