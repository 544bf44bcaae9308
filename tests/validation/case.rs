//! A case and its result.

use crate::lab::Lab;
use crate::options::Options;

/// Runs the scene and takes down its figures; the text says why there is none.
type Run = Box<dyn Fn(&mut Lab) -> Result<(), String>>;

/// A scene with a known answer.
pub struct Case {
    /// `hang-linear`, `cantilever.regular`, …
    pub name: String,
    /// Runs in the normal test command: it takes less than three seconds.
    pub quick: bool,
    run: Run,
}

pub fn case(name: impl Into<String>, run: impl Fn(&mut Lab) -> Result<(), String> + 'static) -> Case {
    Case { name: name.into(), quick: false, run: Box::new(run) }
}

impl Case {
    pub fn quick(self) -> Self {
        Self { quick: true, ..self }
    }
}

/// How wrong a figure may be.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    pub good: f64,
    pub poor: f64,
    pub absolute: bool,
}

/// Relative tolerances.
pub const fn share(good: f64, poor: f64) -> Tolerance {
    Tolerance { good, poor, absolute: false }
}

/// Tolerances in the figure's own unit.
pub const fn within(good: f64, poor: f64) -> Tolerance {
    Tolerance { good, poor, absolute: true }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Good,
    Poor,
    Bad,
}

/// One line of the table.
#[derive(Clone, Debug)]
pub struct Row {
    pub case: String,
    pub target: String,
    /// `None`: the case gave no figure.
    pub measured: Option<f64>,
    pub expected: f64,
    pub error: f64,
    pub tolerance: Tolerance,
    pub verdict: Verdict,
    /// CPU time of the runs behind this figure since the figure before, s.
    pub cpu: f64,
    pub note: String,
}

/// Judges one figure.
pub fn judge(measured: f64, expected: f64, tolerance: Tolerance) -> (f64, Verdict) {
    let error = if tolerance.absolute { measured - expected } else { measured / expected - 1.0 };
    let verdict = match error.abs() {
        e if e <= tolerance.good => Verdict::Good,
        e if e <= tolerance.poor => Verdict::Poor,
        _ => Verdict::Bad,
    };
    (error, verdict)
}

/// Runs a case; a failure becomes a bad row.
pub fn run(case: &Case, options: &Options) -> Vec<Row> {
    let mut lab = Lab::new(&case.name, options);
    if let Err(why) = (case.run)(&mut lab) {
        let cpu = lab.take_cpu();
        lab.rows.push(Row {
            case: case.name.clone(),
            target: "(no result)".to_owned(),
            measured: None,
            expected: f64::NAN,
            error: f64::NAN,
            tolerance: share(f64::NAN, f64::NAN),
            verdict: Verdict::Bad,
            cpu,
            note: why,
        });
    }
    lab.rows
}
