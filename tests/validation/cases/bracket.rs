//! A threshold between two outcomes, found by trying values around it.

use crate::case::Tolerance;
use crate::lab::Lab;

/// Tries the values at the edge of the good range, further out those at the edge of the poor one. What is measured is
/// the middle between the highest value that `holds` and the lowest that does not.
pub fn bracket(
    lab: &mut Lab,
    target: &str,
    expected: f64,
    tolerance: Tolerance,
    holds: impl Fn(&mut Lab, f64) -> Result<bool, String>,
) -> Result<(), String> {
    let scale = if tolerance.absolute { 1.0 } else { expected };
    let at = |share: f64| expected + share * scale;
    let middle = 0.5 * (tolerance.good + tolerance.poor);
    let low = holds(lab, at(-tolerance.good))?;
    let high = holds(lab, at(tolerance.good))?;
    let measured = match (low, high) {
        (true, false) => expected,
        (true, true) if !holds(lab, at(tolerance.poor))? => at(middle),
        (true, true) => at(2.0 * tolerance.poor),
        (false, _) if holds(lab, at(-tolerance.poor))? => at(-middle),
        (false, _) => at(-2.0 * tolerance.poor),
    };
    let near = |share: f64| format!("{:.4}", at(share));
    if (low, high) == (true, false) {
        lab.note(format!("between {} and {}", near(-tolerance.good), near(tolerance.good)));
    } else {
        lab.note("bracket at the bounds of the tolerances");
    }
    lab.figure(target, measured, expected, tolerance);
    Ok(())
}
