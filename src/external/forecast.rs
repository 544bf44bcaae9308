//! The forecast of a stage in another program: `PROGRAM forecast`, since protocol 2.

use super::codes;
use super::protocol::Line;
use super::stage::{Desk, Ready};
use toile_garment::bundle::FILE_NAME;
use toile_stage_api::{Cost, Forecast, MeshSize, StageContext, StageError};

/// Asks the program. It sees the garment as files describe it, and may leave in its output folder what it adds to that.
pub(super) fn ask(
    stage: &Ready<'_>,
    forecast: &mut Forecast,
    cx: &mut StageContext<'_>,
) -> Result<Option<Cost>, StageError> {
    let desk = Desk::lay(&forecast.garment, stage.stage.program.stop())?;
    let mut told = Vec::new();
    let request = stage.request(&desk, forecast.mesh, cx)?;
    stage.talk("forecast", &request, &desk, cx, &mut |line| told.push(line))?;
    let Some(Line::Forecast { seconds, mb, mesh }) = told.pop() else { return Ok(None) };
    let sound = |x: f64| x.is_finite() && x >= 0.0;
    let size = |m: MeshSize| sound(m.triangles) && sound(m.edge);
    if !(seconds.is_none_or(sound) && sound(mb) && mesh.is_none_or(size)) {
        return Err(stage.input(codes::PLUGIN_PROTOCOL, "its forecast has a number below 0".to_owned()));
    }
    let left = desk.output.join(FILE_NAME);
    if std::fs::symlink_metadata(&left).is_ok() {
        forecast.garment = stage.read_back(&left)?;
    }
    forecast.mesh = mesh.or(forecast.mesh);
    Ok(seconds.map(|seconds| Cost { seconds, mb }))
}
