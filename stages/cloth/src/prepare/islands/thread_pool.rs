//! A thread pool for independent pieces of work. Results and their order do not depend on the number of threads.

use crate::{ClothError, Vec3, Watch};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::time::Duration;

/// Time between two questions to the watch, if the run should stop.
const CANCELLATION_POLL: Duration = Duration::from_millis(50);

/// A message of a piece of work on its way.
pub(crate) enum Word {
    /// Step, and progress in words.
    Progress(u64, String),
    /// Part of the work that is done.
    Done(f64),
    /// Places of the vertices, m, and triangles of the mesh.
    Look(Vec<Vec3>, usize),
}

/// Watches one piece of work from its thread.
struct Told<'a> {
    item: usize,
    tell: &'a Sender<(usize, Word)>,
    stop: &'a AtomicBool,
    looks: bool,
}

impl Told<'_> {
    fn send(&self, word: Word) {
        // The receiver lives until all work is done.
        drop(self.tell.send((self.item, word)));
    }
}

impl Watch for Told<'_> {
    fn progress(&mut self, step: u64, words: &str) {
        self.send(Word::Progress(step, words.into()));
    }

    fn cancelled(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn done(&mut self, part: f64) {
        self.send(Word::Done(part));
    }

    fn looks(&self) -> bool {
        self.looks
    }

    fn look(&mut self, positions: &[Vec3], triangles: usize) {
        if self.looks {
            self.send(Word::Look(positions.to_vec(), triangles));
        }
    }
}

/// Does `count` pieces of work, begun in their order, `threads` at a time. Returns their results in order.
///
/// `told` gets the messages of each with its number. After one that failed none is begun.
pub(crate) fn work<T: Send>(
    count: usize,
    threads: usize,
    watch: &mut dyn Watch,
    work: impl Fn(usize, &mut dyn Watch) -> Result<T, ClothError> + Sync,
    mut told: impl FnMut(usize, Word, &mut dyn Watch),
) -> Vec<Result<T, ClothError>> {
    let (next, stop, failed) = (AtomicUsize::new(0), AtomicBool::new(false), AtomicBool::new(false));
    let (tell, heard) = mpsc::channel();
    let looks = watch.looks();
    let mut all = std::thread::scope(|scope| {
        let hands: Vec<_> = (0..threads.clamp(1, count.max(1)))
            .map(|_| {
                let (tell, next, stop, failed, work) = (tell.clone(), &next, &stop, &failed, &work);
                scope.spawn(move || {
                    let mut mine = Vec::new();
                    while !failed.load(Ordering::Relaxed) {
                        let item = next.fetch_add(1, Ordering::Relaxed);
                        if item >= count {
                            break;
                        }
                        let done = work(item, &mut Told { item, tell: &tell, stop, looks });
                        failed.fetch_or(done.is_err(), Ordering::Relaxed);
                        mine.push((item, done));
                    }
                    mine
                })
            })
            .collect();
        drop(tell);
        loop {
            match heard.recv_timeout(CANCELLATION_POLL) {
                Ok((item, word)) => told(item, word, watch),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            stop.fetch_or(watch.cancelled(), Ordering::Relaxed);
        }
        hands.into_iter().flat_map(|h| h.join().unwrap_or_else(|e| std::panic::resume_unwind(e))).collect::<Vec<_>>()
    });
    all.sort_by_key(|(item, _)| *item);
    all.into_iter().map(|(_, done)| done).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;

    #[test]
    fn all_is_done_in_its_order_at_any_number_of_threads() {
        for threads in [0, 1, 2, 5, 40] {
            let mut heard = vec![0; 20];
            let square = |k: usize, watch: &mut dyn Watch| {
                watch.done(0.5);
                Ok(k * k)
            };
            let done = work(20, threads, &mut Silent, square, |k, _, _| heard[k] += 1);
            let done: Vec<usize> = done.into_iter().map(|d| d.expect("no error")).collect();
            assert_eq!(done, (0..20).map(|k| k * k).collect::<Vec<_>>());
            assert_eq!(heard, [1; 20]);
        }
    }

    /// The first that fails is the one that one after the other would have met.
    #[test]
    fn the_first_failure_in_order_is_reported_and_nothing_is_begun_after_it() {
        for threads in [1, 2, 5] {
            let fails = |k: usize, _: &mut dyn Watch| {
                if k >= 7 { Err(ClothError::Cancelled { step: k as u64 }) } else { Ok(k) }
            };
            let done = work(1000, threads, &mut Silent, fails, |_, _, _| {});
            let first = done.iter().find_map(|d| d.as_ref().err());
            assert!(matches!(first, Some(ClothError::Cancelled { step: 7 })), "{first:?}");
            assert!(done.len() < 7 + 2 * threads + 1, "{}", done.len());
        }
    }

    /// Says stop as soon as it hears of anything.
    struct Stops(bool);

    impl Watch for Stops {
        fn progress(&mut self, _: u64, _: &str) {
            self.0 = true;
        }

        fn cancelled(&self) -> bool {
            self.0
        }
    }

    #[test]
    fn a_stop_reaches_all_that_is_at_work() {
        let mut watch = Stops(false);
        let waits = |k: usize, watch: &mut dyn Watch| {
            watch.progress(0, "begun");
            while !watch.cancelled() {
                std::thread::yield_now();
            }
            Err::<(), _>(ClothError::Cancelled { step: k as u64 })
        };
        let done = work(4, 2, &mut watch, waits, |_, word, watch| {
            if let Word::Progress(step, words) = word {
                watch.progress(step, &words);
            }
        });
        assert!(!done.is_empty() && done.iter().all(Result::is_err));
    }
}
