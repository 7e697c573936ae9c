//! Speedup of blocks of work shared among threads: the same work on one core and on two, with the
//! same results.
//!
//! `cargo bench -p abbe-tests --bench threads`; `-- identification` for one of them.

mod budget;
mod identification;
mod measurements;
mod plan;

use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use rayon::ThreadPoolBuilder;

/// Measures the same work on one core and on two.
fn on_one_and_two<T: Send>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    work: impl Fn() -> T + Send + Sync,
) {
    for threads in [1, 2] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        group.bench_function(format!("{name}/threads: {threads}"), |bencher| {
            bencher.iter(|| pool.install(&work));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_secs(1))
        .without_plots();
    targets = budget::bench, identification::bench, plan::bench
}
criterion_main!(benches);
