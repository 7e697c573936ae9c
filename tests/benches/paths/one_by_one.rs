//! Generated code, one configuration after the other, without checks.

use std::hint::black_box;

use abbe_manipulators::{general6r, iiwa, machine3, panda, pps, puma560, scara, stanford, ur5, wam};
use criterion::Criterion;

use crate::subject::Subject;

/// Selects the module with the name of the subject.
macro_rules! modules {
    ($criterion:ident, $subject:ident; $($module:ident),+) => {
        match $subject.name {
            $(stringify!($module) => functions!($criterion, $subject, $module),)+
            other => panic!("{other} has no row here"),
        }
    };
}

macro_rules! functions {
    ($criterion:ident, $subject:ident, $module:ident) => {{
        use $module::{DISTINCT, ERRORS, FRAMES, SOURCES, VARIABLES, raw};
        let s = $subject.parameters.as_slice().try_into().expect("all parameters");
        let u = $subject.inputs.as_slice().try_into().expect("all inputs");
        let errors: &[[f64; 6]; FRAMES] = $subject.errors.as_chunks().0.try_into().expect("six a frame");
        let mut pose = [[0.0; 3]; 4];
        let mut columns = [[0.0; 6]; ERRORS];
        let mut distinct = [[[0.0; 3]; DISTINCT]; FRAMES];
        let mut shift = [0.0; 6];
        let mut shifts = [[0.0; 6]; SOURCES];
        let mut covariance = [[0.0; 6]; 6];
        let mut twists = [[0.0; 6]; VARIABLES];
        functions! { @each $criterion, $subject, q: [f64; VARIABLES];
            "pose" => raw::pose(q, s, &mut pose), pose;
            "error_jacobian" => raw::error_jacobian(q, s, &mut pose, &mut columns), columns;
            "error_jacobian_distinct" => raw::error_jacobian_distinct(q, s, &mut pose, &mut distinct), distinct;
            "displacement" => raw::displacement(q, s, errors, &mut shift), shift;
            "predicted_displacement" => raw::predicted_displacement(q, s, u, &mut shift), shift;
            "source_displacements" => raw::source_displacements(q, s, u, &mut shifts), shifts;
            "covariance" => raw::covariance(q, s, errors, &mut covariance), covariance;
            "compensator_step" => raw::compensator_step(q, s, u, &mut pose, &mut twists), twists;
        }
    }};
    (@each $criterion:ident, $subject:ident, $q:ident: $array:ty;
     $($name:literal => $call:expr, $result:ident;)+) => {
        $({
            let mut group = $subject.group($criterion, $name);
            group.bench_function("compiled, one by one", |bencher| {
                bencher.iter(|| {
                    for q in &$subject.variables {
                        let $q: &$array = black_box(q.as_slice()).try_into().expect("all variables");
                        black_box($call);
                        black_box(&mut $result);
                    }
                });
            });
            group.finish();
        })+
    };
}

pub(crate) fn bench(criterion: &mut Criterion, subject: &Subject) {
    modules!(criterion, subject; general6r, iiwa, machine3, panda, pps, puma560, scara, stanford, ur5, wam);
}
