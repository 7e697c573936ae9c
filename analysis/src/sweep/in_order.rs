//! Blocks of work, computed in parallel and consumed in order.

use core::ops::ControlFlow;
#[cfg(feature = "parallel")]
use core::sync::atomic::{AtomicBool, Ordering};
#[cfg(feature = "parallel")]
use core::time::Duration;
#[cfg(feature = "parallel")]
use std::collections::VecDeque;
#[cfg(feature = "parallel")]
use std::sync::mpsc;

#[cfg(feature = "parallel")]
use rayon::Yield;

/// Time for which an idle thread waits for a block before it looks for work again.
#[cfg(feature = "parallel")]
const IDLE: Duration = Duration::from_micros(100);
/// Number of blocks per thread that are computed ahead of those consumed.
#[cfg(feature = "parallel")]
const AHEAD: usize = 8;

/// Computes blocks 0 to `count` − 1 and passes them to `take` in order, each as soon as it and its
/// predecessors are done. Stops at the first error.
///
/// The result does not depend on the number of threads, and the number of blocks in memory is
/// bounded. With the feature `parallel` the threads are those of the current rayon pool.
pub fn in_order<T: Send, E: Send>(
    count: usize,
    make: impl Fn(usize) -> Result<T, E> + Sync,
    mut take: impl FnMut(T),
) -> Result<(), E> {
    in_order_until(count, make, |made| {
        take(made);
        ControlFlow::Continue(())
    })
}

/// Computes blocks as [`in_order`] does until `take` returns `Break`. Blocks in progress are then
/// completed, and no others are begun.
///
/// Blocks should be short: stopping waits for one block per thread.
pub fn in_order_until<T: Send, E: Send>(
    count: usize,
    make: impl Fn(usize) -> Result<T, E> + Sync,
    mut take: impl FnMut(T) -> ControlFlow<()>,
) -> Result<(), E> {
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 && count > 1 {
        return in_parallel(count, &make, &mut take);
    }
    for block in 0..count {
        if take(make(block)?).is_break() {
            break;
        }
    }
    Ok(())
}

/// Computed block, or `None` if the computation panicked.
#[cfg(feature = "parallel")]
type Made<T, E> = (usize, Option<Result<T, E>>);

#[cfg(feature = "parallel")]
fn in_parallel<T: Send, E: Send>(
    count: usize,
    make: &(impl Fn(usize) -> Result<T, E> + Sync),
    take: &mut impl FnMut(T) -> ControlFlow<()>,
) -> Result<(), E> {
    let ahead = AHEAD * rayon::current_num_threads();
    let failed = &AtomicBool::new(false);
    let (sender, receiver) = mpsc::channel();
    rayon::in_place_scope_fifo(|scope| {
        let mut begun = 0;
        // Blocks from the next one to be consumed on.
        let mut ready: VecDeque<Option<Result<T, E>>> = VecDeque::with_capacity(ahead);
        for block in 0..count {
            while begun < count.min(block + ahead) {
                let (number, sender) = (begun, sender.clone());
                scope.spawn_fifo(move |_| {
                    let mut delivery = Delivery { sender, made: (number, None) };
                    if !failed.load(Ordering::Relaxed) {
                        delivery.made.1 = Some(make(number));
                    }
                });
                ready.push_back(None);
                begun += 1;
            }
            while ready.front().is_some_and(Option::is_none) {
                match next(&receiver) {
                    Some((number, Some(made))) => ready[number - block] = Some(made),
                    // The computation panicked: the scope propagates it.
                    Some((_, None)) => {
                        failed.store(true, Ordering::Relaxed);
                        return Ok(());
                    }
                    None => {}
                }
            }
            let goes_on = match ready.pop_front().flatten() {
                Some(Ok(made)) => take(made).is_continue(),
                Some(Err(error)) => {
                    failed.store(true, Ordering::Relaxed);
                    return Err(error);
                }
                None => true,
            };
            if !goes_on {
                failed.store(true, Ordering::Relaxed);
                break;
            }
        }
        Ok(())
    })
}

/// Guard that sends a block when dropped, even by a panic.
#[cfg(feature = "parallel")]
struct Delivery<T, E> {
    sender: mpsc::Sender<Made<T, E>>,
    made: Made<T, E>,
}

#[cfg(feature = "parallel")]
impl<T, E> Drop for Delivery<T, E> {
    fn drop(&mut self) {
        // The receiver is gone after a failure.
        let _ = self.sender.send((self.made.0, self.made.1.take()));
    }
}

/// Returns the next computed block, or `None` if the thread has done other work instead.
#[cfg(feature = "parallel")]
fn next<T>(receiver: &mpsc::Receiver<T>) -> Option<T> {
    receiver.try_recv().ok().or_else(|| match rayon::yield_now() {
        Some(Yield::Executed) => None,
        Some(Yield::Idle) => receiver.recv_timeout(IDLE).ok(),
        // The thread does not belong to the pool.
        None => receiver.recv().ok(),
    })
}

#[cfg(all(test, feature = "parallel"))]
mod tests;
