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

impl Limits {
    /// Refuses work that is foreseen to need more.
    #[must_use]
    pub fn refuse(&self, seen: &Foresight) -> Option<Diagnostic> {
        // Files or parameters that are wrong: the run tells of them in its own words.
        if seen.exit != Exit::Good {
            return None;
        }
        let (seconds, mb) = (seen.seconds(), seen.mb());
        let most = self.seconds.unwrap_or(ASK_SECONDS);
        if seconds > most {
            let message = format!("this is foreseen to take about {seconds:.0} s, over {most:.0} s");
            let hint = format!(
                "make the mesh coarser (`toile plan` shows what each stage takes), or allow it with --max-seconds {:.0}",
                1.5 * seconds
            );
            return Some(Diagnostic::error(codes::OVER_LIMIT, message).hint(hint));
        }
        let free = available_mb();
        let most = self.mb.or(free.map(|free| ASK_MEMORY_SHARE * free)).filter(|most| mb > *most)?;
        let free = free.map_or_else(String::new, |free| format!(" (the system can give {free:.0} MB)"));
        let message = format!("this is foreseen to need about {mb:.0} MB, over {most:.0} MB{free}");
        let hint = format!("make the mesh coarser, or allow it with --max-memory {:.0}", 1.5 * mb);
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
