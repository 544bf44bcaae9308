//! Two pieces of work that hang on nothing of each other, on two threads.

use crate::report::cost::Lap;
use std::panic::resume_unwind;
use std::sync::Mutex;
use std::thread::{Builder, scope};

/// Does both, side by side where there are threads for it; CPU seconds of the other thread, if there was one.
pub(crate) fn both(threads: usize, one: impl FnOnce(), other: impl FnOnce() + Send) -> f64 {
    if threads < 2 {
        one();
        other();
        return 0.0;
    }
    let other = Mutex::new(Some(other));
    let go = || {
        let mut lap = Lap::start();
        other.lock().ok().and_then(|mut o| o.take()).map(|o| o()).map(|()| lap.next())
    };
    scope(|s| {
        let hand = Builder::new().spawn_scoped(s, go).ok();
        one();
        let beside = hand.and_then(|h| h.join().unwrap_or_else(|panic| resume_unwind(panic)));
        beside.unwrap_or_else(|| {
            // No thread was to be had.
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
            let beside = both(threads, || one += 1, || other += 1);
            assert!((one, other) == (1, 1) && beside >= 0.0);
        }
    }

    #[test]
    #[should_panic(expected = "told")]
    fn what_goes_wrong_on_the_other_thread_is_told() {
        both(2, || (), || panic!("told"));
    }
}
