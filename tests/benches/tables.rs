//! Lookup in a table of 1,000 points compared with a sine, in lanes, with equidistant and with
//! uneven points.
//!
//! `cargo bench -p abbe-tests --bench tables`

use std::hint::black_box;
use std::time::Duration;

use abbe::analysis::sampling::halton;
use abbe::lanes::{InstructionSet, Kernel, Lanes, Register};
use abbe::{LookupTable, Scalar};
use abbe_spec::Spec;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Number of lookups.
const COUNT: usize = 4096;
/// Number of points of the tables.
const POINTS: usize = 1000;

/// Returns the spec of a table over 0 mm to 999 mm.
fn table(interpolation: &str, place: impl Fn(usize) -> f64) -> Spec {
    let list = |value: &dyn Fn(usize) -> f64| {
        (0..POINTS).map(|k| format!("{:?}", value(k))).collect::<Vec<_>>().join(", ")
    };
    Spec::parse(
        "slide.toml",
        &format!(
            "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n[tables.sag]\nx = {{ unit = \"mm\", values = [{}] }}\n\
             y = {{ unit = \"mm\", values = [{}] }}\ninterpolation = \"{interpolation}\"\n[[frame]]\nname = \"carriage\"\n\
             variable = {{ name = \"d1\", kind = \"prismatic\", limits = [0, 999] }}\ntransform = \"Tx(sag(d1))\"\n",
            list(&place),
            list(&|k| (0.1 * k as f64).sin()),
        ),
    )
    .expect("a spec")
}

/// Sums the values of a function.
#[derive(Clone, Copy)]
struct Sum<'a> {
    table: Option<&'a LookupTable<'a>>,
    x: &'a [f64],
}

impl Kernel for Sum<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<R: Register>(self) -> f64 {
        let mut sum = Lanes::<R>::constant(0.0);
        // The choice is outside the loops, as in a caller's code.
        if let Some(table) = self.table {
            for x in self.x.chunks_exact(R::WIDTH) {
                sum = sum + table.value(Lanes::<R>::from_fn(|lane| x[lane]));
            }
        } else {
            for x in self.x.chunks_exact(R::WIDTH) {
                sum = sum + Lanes::<R>::from_fn(|lane| x[lane]).sin();
            }
        }
        sum.as_slice().iter().sum()
    }
}

fn tables(criterion: &mut Criterion) {
    let uneven = |k| k as f64 + if k % 999 == 0 { 0.0 } else { 0.8 * (halton(k, 0) - 0.5) };
    let specs = [
        ("linear", table("linear", |k| k as f64)),
        ("cubic", table("cubic", |k| k as f64)),
        ("linear, uneven", table("linear", uneven)),
        ("cubic, uneven", table("cubic", uneven)),
    ];
    let x: Vec<f64> = (0..COUNT).map(|k| 999.0 * halton(k, 1)).collect();
    for set in InstructionSet::all() {
        let mut group = criterion.benchmark_group(format!("{set:?}"));
        group.throughput(Throughput::Elements(COUNT as u64));
        group.bench_function("sine", |bencher| {
            bencher.iter(|| set.run(Sum { table: None, x: black_box(&x) }));
        });
        for (name, spec) in &specs {
            let table = spec.tables[0].lookup();
            let sum = Sum { table: Some(&table), x: &x };
            group.bench_function(*name, |bencher| bencher.iter(|| set.run(black_box(sum))));
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .without_plots();
    targets = tables
}
criterion_main!(benches);
