//! 100,000 rows of a UR5 with three targets: its errors by least squares and without gross errors, on one core and on two.
//!
//! `cargo bench -p abbe-tests --bench identification`

use std::time::Duration;

use abbe::analysis::sampling::{arm_length, joint_sample, nominal_parameters};
use abbe::identify::{
    Chance, Loss, Measurement, Model, Observation, Options, Uncertainty, cross_validate, fit, simulate,
};
use abbe_manipulators::ur5::Ur5;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rayon::ThreadPoolBuilder;

/// How many rows are fitted.
const ROWS: usize = 100_000;
/// Where the targets are, mm.
const TARGETS: [[f64; 3]; 3] = [[40.0, 0.0, 20.0], [-30.0, 35.0, 25.0], [-20.0, -45.0, 60.0]];

/// Rows all over the joints' ranges, 0.02 mm of noise, and a share of gross errors up to 20 mm.
fn rows(model: &Model, outliers: f64) -> Vec<Observation> {
    let description = model.manipulator.description();
    let arm = arm_length(model.manipulator, &nominal_parameters(description)).expect("an arm");
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let asked = |i: usize| {
        let q = joint_sample(description, arm, &moved, i);
        let seen = Measurement::Points(vec![Some([0.0; 3]); TARGETS.len()]);
        Observation::new(i as u64 + 1, q, Vec::new(), seen)
    };
    let asked: Vec<Observation> = (0..ROWS).map(asked).collect();
    let chance = Chance { noise: model.uncertainty, outliers, gross: 20.0, random_sources: false, seed: 1 };
    simulate(model, &asked, &chance).expect("measurements")
}

fn identification(criterion: &mut Criterion) {
    let ideal = Model::ideal(&Ur5, TARGETS.to_vec(), Uncertainty { length: 0.02, angle: 1.0 });
    let model = ideal.with(ideal.constants(false));
    let mut group = criterion.benchmark_group("identification");
    group.throughput(Throughput::Elements(ROWS as u64));
    for (name, loss, outliers) in [("squares", Loss::Squares, 0.0), ("tukey", Loss::Tukey, 0.02)] {
        let data = rows(&ideal, outliers);
        let options = Options { loss, ..Options::default() };
        for threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            group.bench_function(format!("{name}/threads: {threads}"), |bencher| {
                bencher.iter(|| {
                    pool.install(|| {
                        let found = fit(&model, &data, &options).expect("a fit");
                        cross_validate(&model, &data, &found, 10).expect("its figures")
                    })
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
        .measurement_time(Duration::from_secs(1))
        .without_plots();
    targets = identification
}
criterion_main!(benches);
