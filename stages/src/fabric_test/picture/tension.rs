//! The tension curves of a fabric file.

use super::chart::Chart;
use toile_garment::fabric::{Fabric, StretchLaw};

/// Tension at the right end of the chart, N/m: that of EMT (500 gf/cm).
const MOST: f64 = 490.332_5;
/// Points of a curve.
const POINTS: u32 = 60;

/// Tension over strain, warp green and weft blue, up to 500 gf/cm.
#[must_use]
pub fn tension(fabric: &Fabric) -> String {
    let ends = [&fabric.stretch_warp, &fabric.stretch_weft].map(strain_at);
    let most = ends[0].max(ends[1]);
    let mut chart = Chart::new([100.0 * most, MOST], ["strain, %", "tension, N/m"]);
    for ((name, law), end) in [("warp", &fabric.stretch_warp), ("weft", &fabric.stretch_weft)].into_iter().zip(ends) {
        let point = |k: u32| end * f64::from(k) / f64::from(POINTS);
        chart.curve(name, (0..=POINTS).map(|k| [100.0 * point(k), law.tension(point(k))]));
    }
    chart.finish(&fabric.name, "tension with the width held: warp green, weft blue")
}

/// Strain at which a law reaches the largest tension; at most 300 %.
fn strain_at(law: &StretchLaw) -> f64 {
    let (mut low, mut high) = (0.0, 3.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if law.tension(middle) < MOST { low = middle } else { high = middle }
    }
    high
}
