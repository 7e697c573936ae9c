//! Tests of `in_order.rs`.

use core::ops::ControlFlow;

use super::{in_order, in_order_until};

/// Checks that only some hundred of a thousand blocks are begun beyond the last one consumed.
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

/// Checks that blocks are consumed while others are computed: the other thread computes a block
/// only after the eighth before it is consumed. In waves of 16, all blocks of a wave would be
/// consumed after all 16 are computed, and it would wait forever.
#[test]
fn blocks_are_taken_as_soon_as_they_are_made() {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;
    use std::time::{Duration, Instant};

    let taken = AtomicUsize::new(0);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    pool.install(|| {
        let (consumer, begun) = (thread::current().id(), Instant::now());
        let make = |i: usize| {
            while thread::current().id() != consumer && taken.load(Ordering::SeqCst) + 8 <= i {
                assert!(begun.elapsed() < Duration::from_secs(600), "block {i} waits forever");
                thread::yield_now();
            }
            Ok::<usize, ()>(i)
        };
        in_order(40, make, |i| assert_eq!(taken.fetch_add(1, Ordering::SeqCst), i))
    })
    .unwrap();
    assert_eq!(taken.into_inner(), 40);
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
