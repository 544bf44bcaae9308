//! Fork–join: two independent pieces of work on two threads.

use crate::report::cost::CpuTimer;
use std::panic::resume_unwind;
use std::sync::Mutex;
use std::thread::{Builder, scope};

/// Does both pieces of work, side by side from two threads on. Returns the CPU seconds of the second thread, or 0.
pub(crate) fn fork_join(threads: usize, one: impl FnOnce(), other: impl FnOnce() + Send) -> f64 {
    if threads < 2 {
        one();
        other();
        return 0.0;
    }
    let other = Mutex::new(Some(other));
    let go = || {
        let mut lap = CpuTimer::start();
        other.lock().ok().and_then(|mut o| o.take()).map(|o| o()).map(|()| lap.next())
    };
    scope(|s| {
        let helper = Builder::new().spawn_scoped(s, go).ok();
        one();
        let seconds = helper.and_then(|h| h.join().unwrap_or_else(|panic| resume_unwind(panic)));
        seconds.unwrap_or_else(|| {
            // The system gave no thread.
            go();
            0.0
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_are_done_at_any_number_of_threads() {
        for threads in [0, 1, 2, 9] {
            let (mut one, mut other) = (0, 0);
            let seconds = fork_join(threads, || one += 1, || other += 1);
            assert!((one, other) == (1, 1) && seconds >= 0.0);
        }
    }

    #[test]
    #[should_panic(expected = "second")]
    fn a_panic_of_the_second_thread_is_passed_on() {
        fork_join(2, || (), || panic!("second"));
    }
}
