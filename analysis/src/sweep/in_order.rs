//! Blocks of work, done in parallel and taken in order.

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

/// How long a thread without work waits for a block before it looks for work again.
#[cfg(feature = "parallel")]
const IDLE: Duration = Duration::from_micros(100);
/// How many blocks every thread works ahead of those that are taken.
#[cfg(feature = "parallel")]
const AHEAD: usize = 8;

/// Makes blocks 0 to `count` − 1, the first first, and takes them in order, each as soon as it and all before it are made; ends with the first
/// that fails.
///
/// What is taken is the same for any number of threads; only so many blocks are held. With the feature `parallel` the
/// threads are those of the rayon pool that it is called in.
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

/// The same until one that is taken is to be the last: those that are being made then are made, and no others.
///
/// Blocks are to be short: whoever wants the work to end waits for as many as there are threads.
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

/// A block that was made, or nothing if that panicked.
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
        // Blocks from the next one to be taken on.
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
                    // It panicked: the scope passes that on.
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

/// Sends what was made when it goes, whatever makes it go.
#[cfg(feature = "parallel")]
struct Delivery<T, E> {
    sender: mpsc::Sender<Made<T, E>>,
    made: Made<T, E>,
}

#[cfg(feature = "parallel")]
impl<T, E> Drop for Delivery<T, E> {
    fn drop(&mut self) {
        // Nobody waits for it where another one has failed.
        let _ = self.sender.send((self.made.0, self.made.1.take()));
    }
}

/// The next block that was made; none if there is none yet and the thread has done something else instead.
#[cfg(feature = "parallel")]
fn next<T>(receiver: &mpsc::Receiver<T>) -> Option<T> {
    receiver.try_recv().ok().or_else(|| match rayon::yield_now() {
        Some(Yield::Executed) => None,
        Some(Yield::Idle) => receiver.recv_timeout(IDLE).ok(),
        // Not one of the threads that make blocks.
        None => receiver.recv().ok(),
    })
}

#[cfg(all(test, feature = "parallel"))]
mod tests {
    use core::ops::ControlFlow;

    use super::{in_order, in_order_until};

    /// Of a thousand blocks some hundred may be ahead of the one that is the last: not all.
    #[test]
    fn no_block_is_begun_behind_the_last() {
        use std::sync::atomic::{AtomicUsize, Ordering};

        for threads in [1, 2, 5] {
            let (begun, mut taken) = (AtomicUsize::new(0), 0);
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let ended = pool.install(|| {
                let make = |i: usize| {
                    begun.fetch_add(1, Ordering::SeqCst);
                    Ok::<usize, ()>(i)
                };
                in_order_until(1000, make, |i| {
                    taken += 1;
                    if i == 20 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                })
            });
            assert_eq!((ended, taken), (Ok(()), 21));
            assert!(begun.load(Ordering::SeqCst) <= 21 + threads * super::AHEAD, "{begun:?}");
        }
    }

    #[test]
    fn blocks_come_in_order_whatever_the_number_of_threads() {
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let taken = pool.install(|| {
                let mut taken = Vec::new();
                let failed = in_order(100, |i| if i == 70 { Err(i) } else { Ok(i) }, |i| taken.push(i));
                (taken, failed)
            });
            assert_eq!(taken, ((0..70).collect(), Err(70)));
        }
    }

    /// Blocks are taken while others are made: not only when all are.
    #[test]
    fn blocks_are_taken_as_soon_as_they_are_made() {
        use std::sync::atomic::{AtomicUsize, Ordering};

        let made = AtomicUsize::new(0);
        let mut ahead = Vec::new();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        pool.install(|| {
            let make = |i: usize| {
                std::thread::sleep(std::time::Duration::from_millis(2));
                made.fetch_add(1, Ordering::SeqCst);
                Ok::<usize, ()>(i)
            };
            in_order(40, make, |i| ahead.push(made.load(Ordering::SeqCst) - i))
        })
        .unwrap();
        assert_eq!(ahead.len(), 40);
        // In waves of 16 the first would be taken when 16 are made, and all others of the wave, too.
        assert!(ahead.iter().filter(|made| **made < 8).count() > 20, "{ahead:?}");
    }

    #[test]
    fn a_panic_is_passed_on() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let ended = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            pool.install(|| {
                let make = |i: usize| if i == 9 { panic!("block 9") } else { Ok::<usize, ()>(i) };
                in_order(40, make, |_| {})
            })
        }));
        assert!(ended.is_err());
    }
}
