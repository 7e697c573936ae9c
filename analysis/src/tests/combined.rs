//! Tests of combined errors against independent formulas.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::*;
use abbe_core::{Class, Distribution};

const TOLERANCE: f64 = 0.5;

/// Configuration with the position errors of its sources.
type Errors = (Configuration, Vec<Vector3<f64>>);

/// Returns the budget of the paper's sweep, and its rows.
fn papers() -> (Budget, Vec<Errors>) {
    let workspace = presented_volume(&Pps, &presentation()).unwrap();
    let mut rows = Vec::new();
    let budget = error_budget(&OneByOne(Pps), &workspace, BudgetOptions::default(), &mut |row: &Row| {
        let sources = row.sources.iter().map(|source| Vector3::from_row_slice(&source[..3]));
        rows.push((row.configuration.clone(), sources.collect()));
    });
    (budget.unwrap(), rows)
}

fn radius(errors: &[Vector3<f64>], scales: &[f64]) -> f64 {
    let sources = &Pps.description().sources;
    let (mut sum, mut squares) = (Vector3::zeros(), 0.0);
    for ((source, error), scale) in sources.iter().zip(errors).zip(scales) {
        match source.class {
            Class::Repeatable => sum += error * *scale,
            _ => squares += (error * *scale).norm_squared(),
        }
    }
    sum.norm() + squares.sqrt()
}

fn largest(rows: &[Errors], scales: &[f64]) -> f64 {
    rows.iter().map(|(_, errors)| radius(errors, scales)).fold(0.0, f64::max)
}

#[test]
fn covariance_is_that_of_the_error_jacobian() {
    let (budget, rows) = papers();
    let description = Pps.description();
    let (mut deviation, mut trace, mut longest) = (Vector3::<f64>::zeros(), 0.0_f64, 0.0_f64);
    for (Configuration { q, s, .. }, _) in &rows {
        let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
        Pps.error_jacobian(q, s, &mut columns).unwrap();
        let mut effects = vec![0.0; description.effects.len()];
        Pps.effects(q, s, &[], &mut effects).unwrap();
        // Σ of all ε: one column of magnitudes for each random source.
        let mut sigma = DMatrix::<f64>::zeros(columns.len(), columns.len());
        for (k, source) in description.sources.iter().enumerate() {
            let deviation = match source.class {
                Class::Repeatable => 0.0,
                class => match class.distribution().unwrap() {
                    Distribution::Uniform => 1.0 / 3_f64.sqrt(),
                    Distribution::Normal => 1.0,
                    Distribution::Triangular => 1.0 / 6_f64.sqrt(),
                    Distribution::Arcsine => 0.5_f64.sqrt(),
                    Distribution::Ball { .. } => unreachable!("no error of the paper is one"),
                },
            };
            let mut column = DVector::<f64>::zeros(columns.len());
            for (effect, value) in description.effects.iter().zip(&effects).filter(|(e, _)| e.source == k) {
                column[6 * effect.frame + effect.component.index()] += value * deviation;
            }
            sigma += &column * column.transpose();
        }
        let jacobian = DMatrix::from_fn(3, columns.len(), |i, j| columns[j][i]);
        let covariance = Matrix3::from_iterator((&jacobian * sigma * jacobian.transpose()).iter().copied());
        deviation = deviation.sup(&covariance.diagonal().map(f64::sqrt));
        trace = trace.max(covariance.trace());
        longest = longest.max(covariance.symmetric_eigenvalues().max());
    }
    let combined = &budget.combined;
    for i in 0..3 {
        assert!((combined.standard_deviation[i] - deviation[i]).abs() < 1e-12);
    }
    assert!((combined.standard_radius.value - trace.sqrt()).abs() < 1e-12);
    assert!((combined.ellipsoid.semi_axes[0] - (CHI_SQUARED_95[2] * longest).sqrt()).abs() < 1e-12);
}

#[test]
fn sums_and_root_mean_squares() {
    let (budget, rows) = papers();
    let combined = &budget.combined;
    let both = rows.iter().map(|(_, errors)| radius(errors, &[1.0; 7]).powi(2)).sum::<f64>();
    assert!((combined.rms[2] - (both / 999.0).sqrt()).abs() < 1e-12);
}

/// Returns the largest norm over all signs of the random sources, by trying them all.
fn over_all_signs(errors: &[Vector3<f64>]) -> f64 {
    let sources = Pps.description().sources.iter().zip(errors);
    let mut sums = vec![Vector3::zeros()];
    for (source, error) in sources {
        sums = match source.class {
            Class::Repeatable => sums.iter().map(|sum| sum + error).collect(),
            _ => sums.iter().flat_map(|sum| [sum + error, sum - error]).collect(),
        };
    }
    sums.iter().map(Vector3::norm).fold(0.0, f64::max)
}

/// The worst case is the largest over all signs and configurations.
#[test]
fn the_worst_case_is_over_all_signs() {
    let (budget, rows) = papers();
    let combined = &budget.combined;
    let exact = rows.iter().map(|(_, errors)| over_all_signs(errors)).fold(0.0, f64::max);
    assert!(combined.radius.value < exact, "the root sum of squares is no bound");
    assert!((combined.worst_case_radius.value / exact - 1.0).abs() < 1e-12);
}

#[test]
fn both_figures_are_proportional_to_the_errors() {
    let (budget, rows) = papers();
    let together = TOLERANCE / budget.combined.radius.value;
    assert!((largest(&rows, &[together; 7]) - TOLERANCE).abs() < 1e-12);
}

/// Errors whose squares are too large to be compared are no errors of 0.
#[test]
fn the_largest_error_is_kept_however_large_it_is() {
    for first in [1e-3, 1e152] {
        let mut largest = Extreme { value: first, configuration: Some(0) };
        for (index, value) in [1e-9, 1e152, 3.0].into_iter().enumerate() {
            largest.merge(&Extreme { value, configuration: Some(1 + index) });
        }
        assert_eq!(largest.value, 1e152, "{first}");
    }
    let mut none = Extreme::default();
    none.add(7, 1e200);
    assert_eq!(none, Extreme { value: 1e200, configuration: Some(7) });
}
