//! An error budget over random configurations on one core and on two: blocks are shared among threads.
//!
//! `cargo bench -p abbe-tests --bench threads`

use std::time::Duration;

use abbe::analysis::{Asked, error_budget, random_joint_samples};
use abbe_manipulators::SHIPPED;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rayon::ThreadPoolBuilder;

/// How many configurations are drawn.
const COUNT: usize = 100_000;

fn threads(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("error budget");
    group.throughput(Throughput::Elements(COUNT as u64));
    for shipped in SHIPPED {
        let description = shipped.compiled.description();
        let moved: Vec<usize> = (0..description.variables.len()).collect();
        let workspace = random_joint_samples(shipped.compiled, &moved, COUNT, 1).expect("its own variables");
        for threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            group.bench_function(format!("{}/threads: {threads}", shipped.name), |bencher| {
                bencher.iter(|| {
                    pool.install(|| error_budget(shipped.compiled, &workspace, Asked::default(), &mut ()))
                });
            });
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .without_plots();
    targets = threads
}
criterion_main!(benches);
