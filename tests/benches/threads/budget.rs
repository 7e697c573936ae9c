//! Error budgets over random configurations of every shipped manipulator.

use abbe::analysis::{BudgetOptions, error_budget, random_joint_samples};
use abbe_manipulators::SHIPPED;
use criterion::{Criterion, Throughput};

use crate::on_one_and_two;

/// Number of configurations.
const COUNT: usize = 100_000;

pub(crate) fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("error budget");
    group.throughput(Throughput::Elements(COUNT as u64));
    for shipped in SHIPPED {
        let description = shipped.compiled.description();
        let moved: Vec<usize> = (0..description.variables.len()).collect();
        let workspace = random_joint_samples(shipped.compiled, &moved, COUNT, 1).expect("its own variables");
        on_one_and_two(&mut group, shipped.name, || {
            error_budget(shipped.compiled, &workspace, BudgetOptions::default(), &mut ())
        });
    }
    group.finish();
}
