//! Benchmarks of every path of every shipped manipulator: single configurations, lanes of every
//! instruction set, the interpreter, and a handwritten loop over frames on nalgebra matrices.
//!
//! `cargo bench -p abbe-tests --bench paths`; `-- puma560` for one manipulator, `-- covariance` for
//! one path.

mod baseline;
mod batch;
mod one_by_one;
mod subject;

use std::time::Duration;

use abbe_manipulators::SHIPPED;
use criterion::{Criterion, criterion_group, criterion_main};

use crate::subject::Subject;

fn paths(criterion: &mut Criterion) {
    for shipped in SHIPPED {
        let subject = Subject::new(shipped);
        one_by_one::bench(criterion, &subject);
        batch::bench(criterion, &subject);
        baseline::bench(criterion, &subject);
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(50))
        .measurement_time(Duration::from_millis(200))
        .without_plots();
    targets = paths
}
criterion_main!(benches);
