//! `flatten` as a stage.

use super::codes;
use super::params::FlattenTolerance;
use super::{FlattenParams, flatten_garment, tolerance, verdict};
use toile_garment::{Aspect, Diagnostic, Garment};
use toile_stage_api::{Cost, Forecast, Stage, StageContext, StageError, StageInfo};

/// Flattens the draped surface back to 2D pieces.
pub struct Flatten;

impl Stage for Flatten {
    type Params = FlattenParams;
    const INFO: StageInfo = StageInfo::new(
        "flatten",
        "flatten the draped surface back to 2D pieces through the stored darts",
        &[Aspect::Mesh, Aspect::Drape],
        &[Aspect::Flat],
        2,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        _: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        // Later stages are told that there will be flat pieces.
        forecast.garment.flat.get_or_insert_default();
        check(params)?;
        Ok(forecast.by_triangles(0.005, 0.005, 1.0))
    }

    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        check(params)?;
        let (progress, cancel) = (&mut *cx.progress, cx.cancel);
        let mut watch = |round: u32, motion: f64| {
            let words = format!("motion {:.2e} mm, goal {:.0e} mm", 1e3 * motion, 1e3 * params.stop_motion.0);
            progress.update(u64::from(round), 0, &words);
            !cancel.load(std::sync::atomic::Ordering::Relaxed)
        };
        let mut flat = flatten_garment(&garment, params, cx.report, &mut watch)?;
        flat.verdicts = verdict::verdicts(&garment, &flat, &params.tolerance)?;
        let over = tolerance::judge(&garment, &flat, &params.tolerance, cx.report);
        flat.over_tolerance = (params.tolerance != FlattenTolerance::default()).then_some(over);
        Ok(Garment { flat: Some(flat), ..garment })
    }
}

fn check(params: &FlattenParams) -> Result<(), StageError> {
    let mut wrong = Vec::new();
    let mut need = |good: bool, words: String| {
        if !good {
            wrong.push(Diagnostic::error(codes::FLATTEN_PARAMETER, words));
        }
    };
    let motion = params.stop_motion.0;
    need(
        (1e-12..=1e-3).contains(&motion),
        format!("stop_motion is {:e} mm; it must lie in 1e-9 to 1 mm", 1e3 * motion),
    );
    let smooth = params.smooth.0;
    need((0.0..=0.2).contains(&smooth), format!("smooth is {} mm; it must lie in 0 to 200 mm", 1e3 * smooth));
    need((1..=10_000).contains(&params.max_rounds), format!("max_rounds is {}; 1 to 10000", params.max_rounds));
    let stiffness = params.pair_stiffness;
    need((0.0..=1e8).contains(&stiffness), format!("pair_stiffness is {stiffness}; it must lie in 0 to 1e8"));
    let limit = params.strain_limit.0;
    need(limit > 0.0 && limit.is_finite(), format!("strain_limit is {} %; it must be positive", 100.0 * limit));
    if wrong.is_empty() { Ok(()) } else { Err(StageError::Parameter(wrong)) }
}
