//! E11: a body of a million triangles.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::scenes::{cotton, del, lying, torso};
use crate::support::program::Ended;
use crate::support::trial::Trial;

pub fn cases() -> Vec<Case> {
    vec![case("E11-body-of-a-million", million).once()]
}

/// Starts of the sheet: how many steps one takes to rest is chance (600 to 1,500).
const STARTS: u64 = 3;

/// The same trunk in 30,300 and in 1,002,000 triangles under the same sheet: less than twice the time, and 2 GB.
fn million(lab: &mut Lab) -> Result<(), String> {
    let mut times = [0.0; 2];
    let over = |(rings, sides)| Trial::new(lying(del(0.6, 0.008), 0.602), cotton()).over(torso(rings, sides));
    let trials = [(100, 150), (500, 1000)].map(over);
    // In turns, since machines have slow minutes.
    for start in 1..=STARTS {
        for (time, trial) in times.iter_mut().zip(&trials) {
            let trial = Lab::shaken_as(trial, start);
            let run = lab.run(&trial, &[])?;
            lab.judge(&trial, &run)?;
            let memory = peak(&run);
            lab.below("memory MB", memory, 2000.0);
            *time += run.cpu;
            let n = trial.body.map_or(0, |b| b.triangles.len());
            lab.note(format!("{n} triangles: {:.1} s, {memory:.0} MB", run.cpu));
        }
    }
    lab.below("time over that on the coarse body", times[1] / times[0], 2.0);
    Ok(())
}

/// Largest resident memory of all stages, MB, as the program tells it.
fn peak(run: &Ended) -> f64 {
    let stages = run.record["stages"].as_array().into_iter().flatten();
    stages.map(|s| s["peak_mb"].as_f64().unwrap_or(f64::INFINITY)).fold(0.0, f64::max)
}
