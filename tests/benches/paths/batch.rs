//! Batches in lanes: compiled and interpreted, for every instruction set of this machine.

use std::hint::black_box;

use abbe::lanes::{Batches, InstructionSet, Tiles};
use abbe::{Function, Quantity};
use abbe_manipulators::{general6r, iiwa, machine3, panda, pps, puma560, scara, stanford, ur5, wam};
use criterion::Criterion;

use crate::subject::{COUNT, Subject};

/// Returns the manipulator whose module has the name of the subject, with all its functions
/// compiled for lanes.
macro_rules! compiled {
    ($subject:ident; $($module:ident: $robot:ident),+) => {
        match $subject.name {
            $(stringify!($module) => &$module::$robot as &dyn Batches,)+
            other => panic!("{other} has no row here"),
        }
    };
}

pub(crate) fn bench(criterion: &mut Criterion, subject: &Subject) {
    let compiled = compiled!(subject; general6r: General6r, iiwa: Iiwa, machine3: Machine3, panda: Panda, pps: Pps,
        puma560: Puma560, scara: Scara, stanford: Stanford, ur5: Ur5, wam: Wam);
    for function in Function::ALL {
        let mut group = subject.group(criterion, function.name());
        for set in InstructionSet::all() {
            let rows = function.signature().results_len(compiled.description());
            let mut results = Tiles::new(set, rows, COUNT);
            let arguments = arguments(subject, function, set);
            let manipulators: [(&str, &dyn Batches); 2] =
                [("compiled", compiled), ("interpreted", &subject.interpreter)];
            for (name, manipulator) in manipulators {
                group.bench_function(format!("{name}, {}", set.name()), |bencher| {
                    bencher.iter(|| manipulator.batch(function, black_box(&arguments), &mut results));
                });
            }
        }
        group.finish();
    }
}

fn arguments(subject: &Subject, function: Function, set: InstructionSet) -> Tiles {
    let (signature, description) = (function.signature(), subject.compiled.description());
    let mut tiles = Tiles::new(set, signature.arguments_len(description), COUNT);
    for (configuration, q) in subject.variables.iter().enumerate() {
        let values = signature.arguments.iter().flat_map(|array| {
            let values = match array.quantity {
                Quantity::Variables => q,
                Quantity::Parameters => &subject.parameters,
                Quantity::Inputs => &subject.inputs,
                _ => &subject.errors,
            };
            values.iter().take(array.len(description))
        });
        values.enumerate().for_each(|(row, value)| tiles.set_value(row, configuration, *value));
    }
    tiles
}
