//! Curves of the two shear tests, and the strip of the bias extension as it stands at the end.

use super::chart::{Chart, FIELD};
use super::mm;
use crate::fabric_test::bias::{Bias, FAST, LENGTH, WIDTH};
use crate::fabric_test::frame::Frame;
use toile_garment::Vec2;

/// Force over extension; the level of 5 gf/cm; the strip in a corner, at a quarter of its size.
#[must_use]
pub fn bias(fabric: &str, read: &Bias) -> String {
    let most = read.readings.last().map_or([1.0, 1.0], |r| [100.0 * r.extension, r.force]);
    let mut chart = Chart::new(most, ["extension, %", "force, N"]);
    let fast = FAST * WIDTH;
    if fast <= most[1] {
        chart.curve("law", [[0.0, fast], [100.0 * read.eb5, fast], [100.0 * read.eb5, 0.0]]);
    }
    chart.curve("measured", read.readings.iter().map(|r| [100.0 * r.extension, r.force]));
    let long = 1e3 * LENGTH * (1.0 + read.params.extension);
    let corner = Vec2::new(FIELD[0] * 0.14, FIELD[1] - 0.25 * long);
    let strip: Vec<Vec2> = read.outline.iter().map(|p| corner + mm(*p) * 0.25).collect();
    chart.canvas.line("shadow", &strip, true);
    let words = format!(
        "EB5 {:.2} %, G after FAST {:.1} N/m, shear angle {:.1} deg at {:.0} %",
        100.0 * read.eb5,
        read.shear_fast,
        read.readings.last().map_or(0.0, |r| r.shear_angle.to_degrees()),
        100.0 * read.params.extension
    );
    chart.finish(fabric, &words)
}

/// Shear stress over shear angle, beside it the force per side as laboratories give it (blue), and what the fabric's G
/// says (dashed).
#[must_use]
pub fn frame(fabric: &str, read: &Frame) -> String {
    let last = read.readings.last().copied().unwrap_or_default();
    let law = read.shear * last.shear_angle;
    let degrees = last.shear_angle.to_degrees();
    let mut chart = Chart::new([degrees, last.shear_force.max(law)], ["shear angle, degrees", "N/m"]);
    chart.curve("weft", read.readings.iter().map(|r| [r.shear_angle.to_degrees(), r.shear_force]));
    chart.curve("measured", read.readings.iter().map(|r| [r.shear_angle.to_degrees(), r.shear_stress]));
    chart.curve("law", [[0.0, 0.0], [degrees, law]]);
    let words = format!(
        "green: shear stress, G {:.1} N/m per rad ({:.1} in the file); blue: force per side",
        read.shear_secant(),
        read.shear
    );
    chart.finish(fabric, &words)
}
