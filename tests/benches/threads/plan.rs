//! Optimal choice of 3,000 of 100,000 configurations.

use abbe::identify::{Criterion as Kind, Objective, identifiable, optimal};
use criterion::{Criterion, Throughput};

use crate::measurements::{ROWS, asked, ideal};
use crate::on_one_and_two;

/// Number of configurations chosen.
const CHOSEN: usize = 3000;

pub(crate) fn bench(criterion: &mut Criterion) {
    let ideal = ideal();
    let model = ideal.with(ideal.constants(false));
    let list = asked(&ideal);
    let known = identifiable(&model, &list, &vec![0.0; model.unknowns.len()]).expect("what can be known");
    let used = model.tool_points(&list[..1000]).expect("tool points");
    let objective = Objective { criterion: Kind::Variance, used: &used, model_error: 0.0 };
    let mut group = criterion.benchmark_group("plan");
    group.throughput(Throughput::Elements(ROWS as u64));
    on_one_and_two(&mut group, "variance", || {
        optimal(&model, &list, &known, CHOSEN, &objective, &mut |_, _| {}).expect("a plan")
    });
    group.finish();
}
