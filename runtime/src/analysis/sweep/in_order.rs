//! Blocks of work, done in parallel and taken in order.

/// How many blocks every thread works ahead of those that are taken.
#[cfg(feature = "parallel")]
const AHEAD: usize = 8;

/// Makes blocks 0 to `count` − 1 and takes them in order; ends with the first that fails.
///
/// What is taken is the same for any number of threads; no more than two waves of blocks are held. With the
/// feature `parallel` the threads are those of the rayon pool that it is called in.
pub(crate) fn in_order<T: Send, E: Send>(
    count: usize,
    make: impl Fn(usize) -> Result<T, E> + Sync,
    mut take: impl FnMut(T),
) -> Result<(), E> {
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 && count > 1 {
        return in_waves(count, &make, &mut take);
    }
    (0..count).try_for_each(|block| make(block).map(&mut take))
}

/// While one wave of blocks is taken the next one is made.
#[cfg(feature = "parallel")]
fn in_waves<T: Send, E: Send>(
    count: usize,
    make: &(impl Fn(usize) -> Result<T, E> + Sync),
    take: &mut impl FnMut(T),
) -> Result<(), E> {
    let wave = AHEAD * rayon::current_num_threads();
    let mut ready: Vec<Option<Result<T, E>>> = Vec::new();
    let mut first = 0;
    while first < count || !ready.is_empty() {
        let mut next: Vec<_> = (first..count.min(first + wave)).map(|_| None).collect();
        rayon::in_place_scope(|scope| {
            for (i, slot) in next.iter_mut().enumerate() {
                scope.spawn(move |_| *slot = Some(make(first + i)));
            }
            ready.drain(..).flatten().try_for_each(|made| made.map(&mut *take))
        })?;
        first += next.len();
        ready = next;
    }
    Ok(())
}

#[cfg(all(test, feature = "parallel"))]
mod tests {
    use super::in_order;

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
}
