//! Seconds and memory from the number of triangles, `a + b (n / 1000)^p`.
//!
//! The constants are fitted to `stages[].cpu_seconds` and `peak_mb` of `run.json`, two threads, after
//! `toile run pipelines/long-skirt/v1.toml --set triangulate.triangles=N` (N = 550, 2200) and
//! `toile run pipelines/t-shirt/v1.toml` (5,900 triangles); they agree within a factor of 1.5 with these. A tight garment
//! costs more: `pipelines/fitted-bodice/v1.toml` took three times as long to sew and six times to drape.

use super::{Expected, MeshSize};
use toile_garment::Garment;

/// Cost of one stage.
struct Cost {
    stage: &'static str,
    /// Seconds whatever the size.
    fixed: f64,
    /// Seconds for 1000 triangles.
    per_thousand: f64,
    power: f64,
    /// MB for 1000 triangles.
    mb_per_thousand: f64,
}

const fn cost(stage: &'static str, fixed: f64, per_thousand: f64, power: f64, mb_per_thousand: f64) -> Cost {
    Cost { stage, fixed, per_thousand, power, mb_per_thousand }
}

const COSTS: [Cost; 15] = [
    cost("import-dxf", 0.03, 0.0, 1.0, 0.0),
    cost("import-garmentcode", 0.01, 0.0, 1.0, 0.0),
    cost("import-mesh", 0.01, 0.005, 1.0, 1.0),
    cost("triangulate", 0.01, 0.01, 1.0, 1.0),
    cost("assemble", 0.001, 0.001, 1.0, 1.0),
    cost("stitch", 0.05, 1.9, 1.0, 2.5),
    cost("drape", 0.05, 1.2, 1.3, 2.5),
    // One second of 30 frames.
    cost("animate", 0.1, 5.0, 1.2, 3.0),
    cost("texture", 0.002, 0.001, 1.0, 1.0),
    cost("export-gltf", 0.01, 0.005, 1.0, 1.0),
    cost("export-obj", 0.005, 0.005, 1.0, 1.0),
    cost("flatten", 0.005, 0.005, 1.0, 1.0),
    cost("export-dxf", 0.02, 0.001, 1.0, 1.0),
    cost("export-print", 0.02, 0.0, 1.0, 0.0),
    cost("export-report", 0.02, 0.002, 1.0, 1.0),
];

/// The program, its libraries and a pattern, MB.
const PROGRAM_MB: f64 = 13.0;
/// A body with its search tree, MB for 1000 triangles: the bodies of `samples/` have about 12,000.
const BODY_MB_PER_THOUSAND: f64 = 0.3;

/// The expectation for a stage; `None` for stages of other makers, and where the mesh is not known yet.
pub fn of(stage: &str, mesh: Option<MeshSize>, garment: &Garment) -> Option<Expected> {
    let cost = COSTS.iter().find(|c| c.stage == stage)?;
    let thousands = match mesh {
        Some(size) => size.triangles * 1e-3,
        None if cost.per_thousand == 0.0 => 0.0,
        None => return None,
    };
    let body = garment.body.as_ref().map_or(0, |b| b.triangles.len()) as f64 * 1e-3;
    Some(Expected {
        seconds: cost.fixed + cost.per_thousand * libm::pow(thousands, cost.power),
        mb: PROGRAM_MB + cost.mb_per_thousand * thousands + BODY_MB_PER_THOUSAND * body,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_stage_has_a_cost() {
        for stage in crate::builtin().iter() {
            let name = stage.info().name;
            assert!(COSTS.iter().any(|c| c.stage == name), "{name}");
        }
        let mesh = Some(MeshSize { triangles: 2100.0, edge: 0.02 });
        let drape = of("drape", mesh, &Garment::default()).expect("known");
        // 0.05 + 1.2 · 2.1^1.3
        assert!((drape.seconds - 3.198229).abs() < 1e-6);
        assert_eq!(of("drape", None, &Garment::default()), None);
        assert_eq!(of("acme.dye", mesh, &Garment::default()), None);
    }
}
