//! The corrected command: the algorithm of [`abbe_core::compensator`] as procedures.
//!
//! `machine` measures how far the real pose is from the ideal one, `shortest` and `single` solve
//! for the shortest step (in double and in single precision), which `departure` takes within the
//! bounds, `variables` has the intervals, and `cycle` is the algorithm. `begin` is its inverse.

mod begin;
mod cycle;
mod departure;
mod machine;
mod shortest;
mod single;
mod variables;

use abbe_spec::Spec;

pub use self::machine::Precision;
use self::machine::{HUGE, Machine, positive, weigh};
use super::Procedure;

/// Returns the procedures of the corrected command and of its inverse, which come last, each behind
/// those that it calls.
pub fn compensated(spec: &Spec, precision: Precision) -> Vec<Procedure> {
    let (count, metre) = (spec.variables.len(), 1.0 / spec.length.in_metres());
    let machine = Machine { spec, precision, count, metre };
    let shortest = match precision {
        Precision::Double => shortest::shortest(&machine),
        Precision::Single => single::shortest(&machine),
    };
    vec![
        machine::deviation(&machine),
        machine::weighted(&machine),
        machine::cost(),
        shortest,
        cycle::cycle(&machine),
        begin::begin(&machine),
    ]
}
