//! A drape that begins with stiffer cloth.
//!
//! Cloth has many rests, and which folds it finds depends on the way there. Coarse cloth does not make the small folds that
//! fine cloth makes on its way, so each mesh ends elsewhere. Stiff cloth has few and large folds, which all meshes hold. Where
//! it gets softer by steps, the smaller folds grow out of these.

use super::DrapeParams;
use crate::solve::Follow;
use toile_cloth::{Bending, ClothError, Curve, Material, Scene, Settings, StopReason};
use toile_stage_api::StageContext;

/// How many times as stiff in bending the cloth is, one rest after the other. On the long skirt the mesh with edges of 22 mm
/// then ends 7 mm (p95) from that of 8 mm, instead of 24; with 8 alone 15 (`docs/lab/2026-12-01-stiffer-first.md`).
/// T-shirt and bodice gain nothing.
const TIMES: [f64; 2] = [16.0, 4.0];

/// Drapes that come before the drape itself.
pub(super) fn more_rests(params: &DrapeParams) -> f64 {
    if params.stiffer_first { TIMES.len() as f64 } else { 0.0 }
}

/// Takes the cloth of a scene to where it rests as stiffer cloth, where that is asked for.
pub(super) fn lead(
    scene: &mut Scene,
    params: &DrapeParams,
    settings: &Settings,
    cx: &mut StageContext<'_>,
) -> Result<(), ClothError> {
    for times in TIMES.into_iter().filter(|_| params.stiffer_first) {
        let materials = scene.materials.iter().map(|m| stiffer(m, times)).collect();
        let stiff = Scene { materials, ..scene.clone() };
        let rest = toile_cloth::drape(&stiff, settings, &mut Follow::new(cx))?;
        // Cloth that falls is told of by the drape itself.
        if rest.stop_reason == StopReason::Unheld {
            break;
        }
        scene.positions = rest.positions;
    }
    Ok(())
}

/// The same cloth, so many times as stiff in bending. Its yarns rub as before.
fn stiffer(m: &Material, times: f64) -> Material {
    let curve = |c: &Option<Curve>| c.as_ref().map(|c| c.times(times));
    let soft = &m.bending;
    let bending = Bending {
        warp: times * soft.warp,
        weft: times * soft.weft,
        bias: soft.bias.map(|b| times * b),
        curve: [curve(&soft.curve[0]), curve(&soft.curve[1])],
        ..*soft
    };
    Material { bending, ..m.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_bending_gets_stiffer() {
        let soft = Bending { bias: Some(3e-6), ..Bending::isotropic(4e-6) };
        let cloth = Material { bending: soft.clone(), ..Material::isotropic(0.15, 500.0, 0.2, 4e-6) };
        let stiff = stiffer(&cloth, 16.0);
        assert_eq!((stiff.bending.warp, stiff.bending.weft, stiff.bending.bias), (6.4e-5, 6.4e-5, Some(4.8e-5)));
        assert_eq!(Material { bending: soft, ..stiff }, cloth);
    }
}
