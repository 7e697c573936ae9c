//! Tests of `allocation.rs`.

use super::{Allocation, AllocationCriterion, Allocator, ErrorRow, ScalableSource};
use crate::{Measurand, worst_case};
use abbe_kinematics::sampling::norm;
use rand::rngs::SmallRng;
use rand::{RngExt, SeedableRng};

const CRITERIA: [AllocationCriterion; 2] =
    [AllocationCriterion::WorstCase, AllocationCriterion::RootSumOfSquares];

fn source(k: usize) -> ScalableSource {
    ScalableSource {
        is_repeatable: false,
        has_parts: false,
        follows: k,
        cost: 1.0,
        exponent: 1.0,
        limits: [0.001, 1.0],
    }
}

fn row(errors: Vec<[f64; 3]>) -> ErrorRow {
    ErrorRow { configuration: 0, measurand: Measurand::Position, errors }
}

/// Returns a problem with 2 to 9 sources of different costs and exponents, some of them fixed, and
/// one that follows another one.
fn random_problem(seed: u64, criterion: AllocationCriterion) -> Allocator {
    let mut random = SmallRng::seed_from_u64(seed);
    let count = 2 + seed as usize % 8;
    let mut sources: Vec<ScalableSource> = (0..count)
        .map(|k| ScalableSource {
            is_repeatable: random.random_bool(0.5),
            has_parts: false,
            cost: random.random_range(0.1..10.0),
            exponent: random.random_range(0.3..3.0),
            ..source(k)
        })
        .collect();
    if seed.is_multiple_of(3) {
        sources[0].limits = [1.0; 2];
    }
    if count > 4 {
        sources[count - 1].follows = 1;
    }
    // Small errors among large ones stay at a limit.
    let sizes: Vec<f64> = (0..count).map(|_| 10.0_f64.powf(random.random_range(-3.0..1.0))).collect();
    let mut problem = Allocator::new(criterion, sources);
    for _ in 0..40 {
        let errors = sizes.iter().map(|size| [(); 3].map(|()| size * random.random_range(-1.0..1.0)));
        let mut errors: Vec<[f64; 3]> = errors.collect();
        if seed.is_multiple_of(3) {
            let share = 0.3 / norm(errors[0]);
            errors[0] = errors[0].map(|e| share * e);
        }
        problem.rows.push(row(errors));
    }
    problem
}

fn largest(problem: &Allocator, factors: &[f64]) -> f64 {
    problem.rows.iter().map(|row| problem.value(&row.errors, factors, 0.0)).fold(0.0, f64::max)
}

/// Returns the largest error for any part of each factor: the definition, without pruning.
fn largest_for_parts(problem: &Allocator, parts: &[f64]) -> f64 {
    let value = |row: &ErrorRow| {
        let (mut repeatable, mut others, mut square) = ([0.0; 3], Vec::new(), 0.0);
        for ((v, source), part) in row.errors.iter().zip(&problem.sources).zip(parts) {
            let v = v.map(|v| part * v);
            if source.is_repeatable {
                repeatable = std::array::from_fn(|i| repeatable[i] + v[i]);
            } else {
                others.push(v);
                square += norm(v).powi(2);
            }
        }
        match problem.criterion {
            AllocationCriterion::WorstCase => norm(worst_case(repeatable, &others)),
            AllocationCriterion::RootSumOfSquares => norm(repeatable) + square.sqrt(),
        }
    };
    problem.rows.iter().map(value).fold(0.0, f64::max)
}

#[test]
fn two_errors_along_a_line_by_hand() {
    // Minimizes c1/x1 + c2/x2 with a1 x1 + a2 x2 = 1: x_i = √(c_i/a_i) / Σ √(a_k c_k).
    let (a, c) = ([3.0, 0.8], [1.0, 4.0]);
    for class in 0..3 {
        let mut sources = vec![source(0), source(1)];
        (0..2).for_each(|k| sources[k].cost = c[k]);
        (0..class).for_each(|k| sources[k].is_repeatable = true);
        let mut problem = Allocator::new(AllocationCriterion::WorstCase, sources);
        problem.rows.push(row(vec![[a[0], 0.0, 0.0], [a[1], 0.0, 0.0]]));
        let Allocation { factors, active, residual } = problem.solve().unwrap();
        let sum: f64 = (0..2).map(|k| (a[k] * c[k]).sqrt()).sum();
        for k in 0..2 {
            let expected = (c[k] / a[k]).sqrt() / sum;
            assert!((factors[k] - expected).abs() <= 1e-9 * expected, "{factors:?}");
        }
        assert!(residual <= 1e-9);
        // The cost is sum² / tolerance.
        assert!((problem.cost(&factors) / sum.powi(2) - 1.0).abs() <= 1e-9);
        assert!(active[0].0 == 0 && (active[0].1 / sum.powi(2) - 1.0).abs() <= 1e-8, "{active:?}");
    }
}

#[test]
fn two_errors_by_the_root_sum_of_squares_by_hand() {
    // Minimizes 1/x1 + 1/x2 with (a1 x1)² + (a2 x2)² = 1: x_i ∝ a_i^(−2/3).
    let a = [3.0_f64, 0.9];
    let mut problem = Allocator::new(AllocationCriterion::RootSumOfSquares, vec![source(0), source(1)]);
    problem.sources[0].limits[1] = 10.0;
    problem.sources[1].limits[1] = 10.0;
    problem.rows.push(row(vec![[a[0], 0.0, 0.0], [0.0, a[1], 0.0]]));
    let Allocation { factors, residual, .. } = problem.solve().unwrap();
    let sum = a.iter().map(|a| a.powf(2.0 / 3.0)).sum::<f64>().sqrt();
    for (x, a) in factors.iter().zip(a) {
        let expected = a.powf(-2.0 / 3.0) / sum;
        // The cuts touch the sphere, so the cost is exact and the factors are to its square root.
        assert!((x - expected).abs() <= 1e-4 * expected, "{factors:?}");
    }
    let cost = problem.cost(&factors);
    assert!((cost / sum.powi(3) - 1.0).abs() <= 1e-9, "{cost}, not {}", sum.powi(3));
    assert!(residual <= 1e-9, "{residual:e}");
}

/// Holds the conditions of the optimum, and that the factors and all smaller ones keep the
/// tolerance, none can be larger, and one factor for all costs more.
#[test]
fn random_problems_are_solved() {
    let mut random = SmallRng::seed_from_u64(7);
    for (seed, criterion) in (0..20).flat_map(|seed| CRITERIA.map(|criterion| (seed, criterion))) {
        let mut problem = random_problem(seed, criterion);
        let Allocation { factors, residual, active } = problem.solve().unwrap();
        assert!(residual <= 1e-9, "{seed} {criterion:?}: {residual:e}");
        assert!(largest(&problem, &factors) <= 1.0, "{seed} {criterion:?}");
        assert!(largest_for_parts(&problem, &factors) <= 1.0);
        assert!(!active.is_empty() || factors.iter().all(|x| *x == 1.0));
        for _ in 0..1000 {
            let whole = random.random_bool(0.5);
            let part = |x: &f64| {
                x * if whole { random.random_range(0..2) as f64 } else { random.random_range(0.0..1.0) }
            };
            let parts: Vec<f64> = factors.iter().map(part).collect();
            assert!(largest_for_parts(&problem, &parts) <= 1.0, "{seed} {criterion:?}: {parts:?}");
        }
        for (k, one) in problem.sources.iter().enumerate() {
            if one.follows == k && factors[k] < 1.0 && factors[k] > 0.001 {
                let mut larger = factors.clone();
                larger[k] *= 1.01;
                assert!(largest(&problem, &larger) > 1.0, "{seed} {criterion:?}: source {k}");
            }
        }
        let mut together = problem.with_one_factor();
        let together = together.solve().unwrap().factors;
        assert!(problem.cost(&factors) <= problem.cost(&together) * (1.0 + 1e-9), "{seed} {criterion:?}");
    }
}

#[test]
fn an_error_that_cancels_another_one_is_not_relied_on() {
    let mut sources = vec![source(0), source(1)];
    sources.iter_mut().for_each(|source| source.is_repeatable = true);
    let mut problem = Allocator::new(AllocationCriterion::WorstCase, sources);
    problem.rows.push(row(vec![[5.0, 0.0, 0.0], [-5.0, 0.0, 0.0]]));
    let factors = problem.solve().unwrap().factors;
    assert!(factors.iter().all(|x| (x - 0.2).abs() < 1e-9), "{factors:?}");
}

#[test]
fn fixed_sources_that_exceed_the_tolerance_are_told() {
    let mut problem = Allocator::new(AllocationCriterion::WorstCase, vec![source(0), source(1)]);
    problem.sources[0].limits = [1.0; 2];
    problem.rows.push(row(vec![[1.5, 0.0, 0.0], [2.0, 0.0, 0.0]]));
    let [fixed_alone, at_lower_limits] = problem.solve().unwrap_err();
    assert!((at_lower_limits - 1.502).abs() < 1e-12 && (fixed_alone - 1.5).abs() < 1e-12);
}

#[test]
fn a_tolerance_that_is_kept_changes_nothing() {
    for criterion in CRITERIA {
        let mut problem = Allocator::new(criterion, vec![source(0), source(1)]);
        problem.rows.push(row(vec![[0.3, 0.0, 0.0], [0.0, 0.4, 0.0]]));
        assert_eq!(problem.solve().unwrap().factors, [1.0, 1.0]);
    }
}

/// An optimal factor of exactly 1, and a ball: `0.1 x_1 + 0.4 x_2 = 0.3` with the least `1/x_1 +
/// 1/x_2` at 1 and 1/2, wherever the errors point.
#[test]
fn a_factor_just_at_its_limit_is_found() {
    let sources = vec![source(0), ScalableSource { has_parts: true, ..source(1) }];
    let mut problem = Allocator::new(AllocationCriterion::WorstCase, sources);
    problem.rows.push(row(vec![[0.0, 1.0 / 3.0, 0.0], [4.0 / 3.0, 0.0, 0.0]]));
    let Allocation { factors, residual, .. } = problem.solve().unwrap();
    assert!((factors[0] - 1.0).abs() < 1e-5 && (factors[1] - 0.5).abs() < 1e-5, "{factors:?}");
    assert!(residual < 1e-9, "{residual}");
}
