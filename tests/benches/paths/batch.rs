//! Lanes: compiled and interpreted, for every instruction set of this machine.

use std::hint::black_box;

use abbe::Manipulator;
use abbe::lanes::{InstructionSet, Path, Tiles};
use criterion::Criterion;

use crate::subject::{COUNT, Subject};

pub(crate) fn bench(criterion: &mut Criterion, subject: &Subject) {
    for path in Path::ALL {
        let mut group = subject.group(criterion, path.name());
        for set in InstructionSet::all() {
            let mut results = Tiles::new(set, path.results(subject.compiled.description()), COUNT);
            let arguments = arguments(subject, path, set);
            let manipulators: [(&str, &dyn Manipulator); 2] =
                [("compiled", subject.compiled), ("interpreted", &subject.interpreter)];
            for (name, manipulator) in manipulators {
                group.bench_function(format!("{name}, {}", set.name()), |bencher| {
                    bencher.iter(|| manipulator.batch(path, black_box(&arguments), &mut results));
                });
            }
        }
        group.finish();
    }
}

fn arguments(subject: &Subject, path: Path, set: InstructionSet) -> Tiles {
    let rows = path.arguments(subject.compiled.description());
    let mut tiles = Tiles::new(set, rows, COUNT);
    for (configuration, q) in subject.variables.iter().enumerate() {
        let values = q.iter().chain(&subject.parameters).chain(&subject.inputs).chain(&subject.errors);
        for (row, value) in values.take(rows).enumerate() {
            tiles.set_value(row, configuration, *value);
        }
    }
    tiles
}
