//! Identification from 100,000 rows: by least squares, with a robust loss, and with
//! cross-validation.

use abbe::identify::{Chance, Folds, Loss, Options, cross_validate, fit, simulate};
use criterion::{Criterion, Throughput};

use crate::measurements::{ROWS, asked, ideal};
use crate::on_one_and_two;

pub(crate) fn bench(criterion: &mut Criterion) {
    let ideal = ideal();
    let model = ideal.with(ideal.constants(false));
    let asked = asked(&ideal);
    let mut group = criterion.benchmark_group("identification");
    group.throughput(Throughput::Elements(ROWS as u64));
    for (name, loss, outliers) in [("squares", Loss::Squares, 0.0), ("tukey", Loss::Tukey, 0.02)] {
        let noise = model.uncertainty;
        let chance =
            Chance { noise, outliers, outlier_size: 20.0, random_sources: false, one_machine: true, seed: 1 };
        let data = simulate(&ideal, &asked, &chance).expect("measurements");
        let options = Options { loss, ..Options::default() };
        on_one_and_two(&mut group, name, || {
            let found = fit(&model, &data, &options).expect("a fit");
            cross_validate(&model, &data, &found, &Folds::new(&data, 10)).expect("its figures")
        });
    }
    group.finish();
}
