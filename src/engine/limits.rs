//! Limits of a run in time and memory: hopeless work is refused before it begins, and stopped where it turns out so.

use super::codes;
use super::exit::Exit;
use super::foresight::Foresight;
use super::memory::available_mb;
use super::meter::peak_mb;
use super::stop::Stop;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use toile_garment::Diagnostic;

/// Foreseen seconds from which a run begins only if it is told so. Forecasts are fitted to meshes of up to 25,000
/// triangles, which take seconds. Half a million are foreseen to take this long, and may take hours.
const ASK_SECONDS: f64 = 500.0;
/// Share of the memory that the system can give which a run may be foreseen to need, if it is not told more. The forecast
/// may be too low, and other programs run beside it.
const ASK_MEMORY_SHARE: f64 = 0.5;
/// How often a run is looked at.
const TICK: Duration = Duration::from_millis(100);

/// Most time and memory of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits {
    /// Wall time, s.
    pub seconds: Option<f64>,
    /// Resident memory, MB.
    pub mb: Option<f64>,
}

/// Where a person allows more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Allow {
    /// `--max-seconds` and `--max-memory`.
    Options,
    /// `[limits]` of a line.
    Line,
    /// Nowhere: the command has no limits of its own.
    Nowhere,
}

impl Allow {
    /// How so many seconds are allowed.
    fn seconds(self, most: f64) -> String {
        let most = amount(most);
        match self {
            Self::Options => format!(", or allow it with --max-seconds {most}"),
            Self::Line => format!(", or allow it in the line: [limits] time = \"{most} s\""),
            Self::Nowhere => String::new(),
        }
    }

    /// How so many MB are allowed.
    fn mb(self, most: f64) -> String {
        match self {
            Self::Options => format!(", or allow it with --max-memory {most:.0}"),
            Self::Line => format!(", or allow it in the line: [limits] memory = \"{most:.0} MB\""),
            Self::Nowhere => String::new(),
        }
    }
}

/// A number in whole ones where it is large, and with the digits that it needs where it is small.
fn amount(x: f64) -> String {
    match x {
        x if x >= 10.0 => format!("{x:.0}"),
        x if x >= 1.0 => format!("{x:.1}"),
        x => format!("{x:.2}"),
    }
}

impl Limits {
    /// Refuses work that is foreseen to need more.
    #[must_use]
    pub fn refuse(&self, seen: &Foresight, allow: Allow) -> Option<Diagnostic> {
        // Files or parameters that are wrong: the run tells of them in its own words.
        if seen.exit != Exit::Good {
            return None;
        }
        let (seconds, mb) = (seen.seconds(), seen.mb());
        let most = self.seconds.unwrap_or(ASK_SECONDS);
        if seconds > most {
            let message = format!("this is foreseen to take about {} s, over {} s", amount(seconds), amount(most));
            let hint = format!(
                "make the mesh coarser (`toile plan` shows what each stage takes){}",
                allow.seconds(1.5 * seconds)
            );
            return Some(Diagnostic::error(codes::OVER_LIMIT, message).hint(hint));
        }
        let free = available_mb();
        let most = self.mb.or(free.map(|free| ASK_MEMORY_SHARE * free)).filter(|most| mb > *most)?;
        let free = free.map_or_else(String::new, |free| format!(" (the system can give {free:.0} MB)"));
        let message = format!("this is foreseen to need about {mb:.0} MB, over {most:.0} MB{free}");
        let hint = format!("make the mesh coarser{}", allow.mb(1.5 * mb));
        Some(Diagnostic::error(codes::OVER_LIMIT, message).hint(hint))
    }

    /// Words for the limit that is passed by now.
    fn over(&self, began: Instant) -> Option<String> {
        let seconds = began.elapsed().as_secs_f64();
        if let Some(most) = self.seconds.filter(|most| seconds > *most) {
            return Some(format!("the run took longer than --max-seconds {most} and was stopped"));
        }
        let most = self.mb.filter(|most| peak_mb().is_some_and(|mb| mb > *most))?;
        Some(format!("the run needed more than --max-memory {most} MB and was stopped"))
    }
}

/// Watches a run until it is dropped.
pub struct Watchdog(Arc<AtomicBool>);

impl Watchdog {
    /// Stops the run as soon as a limit is passed.
    #[must_use]
    pub fn watch(limits: Limits, stop: &Arc<Stop>) -> Self {
        let done = Arc::new(AtomicBool::new(false));
        if limits.seconds.is_some() || limits.mb.is_some() {
            let (done, stop, began) = (Arc::clone(&done), Arc::clone(stop), Instant::now());
            std::thread::spawn(move || {
                while !done.load(Ordering::Relaxed) {
                    if let Some(words) = limits.over(began) {
                        stop.ask_because(words);
                        return;
                    }
                    std::thread::sleep(TICK);
                }
            });
        }
        Self(done)
    }
}

impl Drop for Watchdog {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_stage_api::{Cost, Forecast};

    #[test]
    fn a_refusal_names_the_limit_and_the_way_to_raise_it() {
        let seen = Foresight {
            forecast: Forecast::default(),
            stages: vec![Some(Cost { seconds: 8.0, mb: 40.0 })],
            findings: Vec::new(),
            notes: Vec::new(),
            exit: Exit::Good,
        };
        let told = |limits: Limits, allow| {
            let finding = limits.refuse(&seen, allow).expect("over the limit");
            format!("{} {}", finding.message, finding.hint.unwrap_or_default())
        };
        let short = Limits { seconds: Some(0.5), mb: None };
        assert!(told(short, Allow::Options).contains("about 8.0 s, over 0.50 s"));
        assert!(told(short, Allow::Options).ends_with("--max-seconds 12"));
        assert!(told(short, Allow::Line).ends_with("[limits] time = \"12 s\""));
        assert!(!told(short, Allow::Nowhere).contains("--max"));
        let small = Limits { seconds: None, mb: Some(20.0) };
        assert!(told(small, Allow::Line).ends_with("[limits] memory = \"60 MB\""));
        assert!(small.refuse(&Foresight { stages: Vec::new(), ..seen }, Allow::Line).is_none());
    }
}
