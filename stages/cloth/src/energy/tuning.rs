//! Tuned numbers and mechanisms of the energies.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "energy";

    /// Strain over which cloth comes to be locked, as a share of its limit.
    LOCK_WIDTH_SHARE: f64 = 0.004, {
        unit: "share of the limit",
        larger: "Cloth is held short of its limit.",
        smaller: "Locks are stiffer, and single precision loses the soft motions beside them.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest width of a lock as a share of its limit; limits of 1.2 % and less have it.
    LOCK_WIDTH_SHARE_MAX: f64 = 0.1, {
        unit: "share of the limit",
        larger: "Cloth with a small limit is held short of it.",
        smaller: "Few triangles at a corner are many times as stiff as all others.",
        tried: "0.1 and 0.15",
        evidence: "At 0.15, locked 0.25 % before the limit, a limit of 1 % was passed by 1.8 % (stability B11).",
    }
    /// Width of a lock times the squared limit, for limits in between.
    LOCK_WIDTH_SMALL_LIMIT: f64 = 2e-7, {
        unit: "strain³",
        larger: "Limits of about 2 % have wider locks.",
        smaller: "Limits of about 2 % have stiffer locks.",
        tried: "not recorded",
        evidence: "It makes 2.5 % of a limit of 2 % and a tenth of one of 1.2 %.",
    }
    /// Widths before its limit at which cloth is locked; it then carries three times as much at the limit.
    LOCK_BEFORE_WIDTHS: f64 = 0.5, {
        unit: "widths",
        larger: "Cloth is held short of its limit.",
        smaller: "Limits are passed under load.",
        tried: "0.5, and 0.25 % of the limit",
        evidence: "Locked only 0.25 % before the limit, a limit of 1 % was passed by 1.8 % (stability B11).",
    }
    /// Tension of locked cloth over that of its curve, as a multiple of what the curve has at the limit.
    LOCK_TENSION_CURVES: f64 = 7.0, {
        unit: "tensions of the curve",
        larger: "The lock is stiffer than the cloth has to bear, and costs steps.",
        smaller: "Limits are passed under load.",
        tried: "2.5, 4 and 7",
        evidence: "4 and 2.5 cost as many steps and held a limit of 1 % less well under a load (stability B11).",
    }
    /// Least tension of locked cloth over that of its curve.
    LOCK_TENSION_MIN: f64 = 50.0, {
        unit: "N/m",
        larger: "Soft cloth locks harder than it has to.",
        smaller: "Soft cloth passes its limit under load.",
        tried: "25, 30 and 50",
        evidence: "30 and 25 held a limit of 1 % less well under a load (stability B11).",
    }
    /// Largest tension of locked cloth over that of its curve.
    LOCK_TENSION_MAX: f64 = 900.0, {
        unit: "N/m",
        larger: "The lock is stiffer than the cloth has to bear, and costs steps.",
        smaller: "Stiff cloth passes its limit under load.",
        tried: "not recorded",
        evidence: "A fixed 900 N/m over 2 % of a small limit cost 43 to 95 s in sewn panels of 12,000 triangles.",
    }
    /// Additional growth of the tension just after cloth is locked, so that a band over gathers stays within its limit.
    LOCK_SHUTTING: f64 = 4.0, {
        unit: "locked tensions per squared width",
        larger: "Cloth that begins far beyond its limit finds back later.",
        smaller: "Bands drawn over gathers pass their limit.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Widths after the lock over which the tension grows faster.
    LOCK_SHUTTING_WIDTHS: f64 = 0.5, {
        unit: "widths",
        larger: "Cloth that begins far beyond its limit finds back later.",
        smaller: "Bands drawn over gathers pass their limit.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Cells of the table of a curve that is given by a formula.
    LAW_CELLS: usize = 256, {
        unit: "cells",
        larger: "Tables take more memory and are more exact.",
        smaller: "Tension and energy depart from the curve.",
        tried: "not recorded",
        evidence: "With 256 cells the tension is within 1e-4 of the curve (test).",
    }
    /// Cells of the table of a measured curve, whose kinks need more of them.
    LAW_CELLS_OF_SAMPLES: usize = 1024, {
        unit: "cells",
        larger: "Tables take more memory and are more exact.",
        smaller: "Kinks of the curve are rounded.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Strain up to which a table goes, over the strain limit.
    LAW_REACH_LIMITS: f64 = 1.5, {
        unit: "strain limits",
        larger: "Cells are wider.",
        smaller: "Strained starts leave the table for its straight continuation.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Strain up to which the table of a fabric without a limit goes.
    LAW_REACH_UNLIMITED: f64 = 0.5, {
        unit: "strain",
        larger: "Cells are wider.",
        smaller: "Strained cloth leaves the table for its straight continuation.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Added firmness of a triangle in bending per softening of its mesh.
    FIRMNESS_LINEAR: f64 = 0.4, {
        unit: "per softening",
        larger: "Meshes bend too stiffly.",
        smaller: "Meshes bend too softly.",
        tried: "not recorded",
        evidence: "Cantilevers on Delaunay meshes shaken by 0 to 0.3 cells stay within 1 % (docs/bending.md).",
    }
    /// Added firmness of a triangle in bending per squared softening of its mesh.
    FIRMNESS_QUADRATIC: f64 = 2.5, {
        unit: "per squared softening",
        larger: "Uneven meshes bend too stiffly.",
        smaller: "Uneven meshes bend too softly.",
        tried: "not recorded",
        evidence: "Cantilevers on Delaunay meshes shaken by 0.4 cells stay within 2 % (docs/bending.md).",
    }
    /// Largest softening of a mesh that counts for its firmness.
    FIRMNESS_SOFTENING_MAX: f64 = 0.5, {
        unit: "softening",
        larger: "Cells a hundredth as wide as their neighbours come out a thousand times too firm.",
        smaller: "Uneven meshes bend too softly.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least altitude of a triangle whose bending Hessian a surrogate of springs may replace.
    SURROGATE_ALTITUDE_MIN: f64 = 0.5, {
        unit: "bending lengths",
        larger: "Finer meshes keep the full Hessian, whose factor is larger.",
        smaller: "Descents take more steps.",
        tried: "0.36 to 0.74",
        evidence: "At 0.36 they took twice as many steps, at 0.74 as many as with the full Hessian.",
    }
    /// One triangle in this many may be narrower where the surrogate is used.
    SURROGATE_NARROW_PARTS: usize = 20, {
        unit: "triangles",
        larger: "Fewer meshes use the surrogate.",
        smaller: "Descents on uneven meshes take more steps.",
        tried: "not recorded",
        evidence: "More narrow triangles beside wide ones took twice as many steps.",
    }
    /// Stiffness of a surrogate spring over that of its fold.
    SURROGATE_SPRING_SHARE: f64 = 0.5, {
        unit: "share of the fold's stiffness",
        larger: "Directions of a descent are shorter.",
        smaller: "Directions of a descent are longer, and more steps fail.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Altitude over longest side below which the bending of a triangle is summed by itself instead of as springs.
    SLIM_ALTITUDE_SHARE: f64 = 0.05, {
        unit: "longest sides",
        larger: "More triangles take three times the sums.",
        smaller: "Energies are small differences of large numbers.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Least normed determinant of a patch whose curvature is solved.
    PATCH_DETERMINANT_MIN: f64 = 0.02, {
        unit: "normed determinant",
        larger: "More patches fall back to one spring per fold.",
        smaller: "Patches whose six points lie nearly on one conic get huge coefficients.",
        tried: "not recorded",
        evidence: "No patch of a Delaunay mesh was below it (docs/bending.md).",
    }
    /// Change of curvature over which friction in bending builds up, times the bending length.
    FRICTION_BUILD_UP: f64 = 0.02, {
        unit: "per bending length",
        larger: "Friction holds folds less firmly.",
        smaller: "States of rest are left undecided.",
        tried: "not recorded",
        evidence: "It is far below the curvature of folds (about 1) and above what a state of rest leaves undecided.",
    }
}

mechanisms! {
    room "energy";

    /// Makes triangles of uneven meshes firmer in bending, so that a mesh bends like the cloth.
    BENDING_FIRMNESS = "bending-firmness";
}
