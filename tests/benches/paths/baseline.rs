//! Handwritten baseline: the loop gets precomputed `A_i`, whose cost is left out in its favor.

use std::hint::black_box;

use abbe::Function;
use abbe_tests::frame_loop::{Columns, Frame, error_jacobian};
use criterion::Criterion;
use nalgebra::{Matrix6, Vector6};

use crate::subject::Subject;

/// Computes a result at a configuration from `J_e` and errors or variances.
type Finish = fn(&[[f64; 6]], &[f64]) -> [[f64; 6]; 6];

pub(crate) fn bench(criterion: &mut Criterion, subject: &Subject) {
    let transforms = subject.transforms();
    let nothing: Finish = |_, _| [[0.0; 6]; 6];
    let finishes = [
        (Function::ErrorJacobian, nothing),
        (Function::Displacement, displacement as Finish),
        (Function::Covariance, covariance),
    ];
    for (function, finish) in finishes {
        let mut group = subject.group(criterion, function.name());
        let mut poses = vec![Frame::default(); subject.errors.len() / 6 + 1];
        let mut columns = vec![[0.0; 6]; subject.errors.len()];
        group.bench_function("nalgebra loop, matrices given", |bencher| {
            bencher.iter(|| {
                for transforms in &transforms {
                    let transforms: &[Columns] = black_box(transforms);
                    black_box(error_jacobian(transforms, &mut poses, &mut columns));
                    black_box(finish(black_box(&columns), &subject.errors));
                }
            });
        });
        group.finish();
    }
}

/// `ΔX = J_e ε`.
fn displacement(columns: &[[f64; 6]], errors: &[f64]) -> [[f64; 6]; 6] {
    let sum: Vector6<f64> =
        columns.iter().zip(errors).map(|(column, error)| Vector6::from(*column) * *error).sum();
    [sum.into(), [0.0; 6], [0.0; 6], [0.0; 6], [0.0; 6], [0.0; 6]]
}

/// `J_e diag(σ²) J_eᵀ`.
fn covariance(columns: &[[f64; 6]], variances: &[f64]) -> [[f64; 6]; 6] {
    let mut covariance = Matrix6::zeros();
    for (column, variance) in columns.iter().zip(variances) {
        let column = Vector6::from(*column);
        covariance.ger(*variance, &column, &column, 1.0);
    }
    covariance.into()
}
