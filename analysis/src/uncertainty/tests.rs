//! Tests of uncertainty statements against draws.

use rand::RngExt;
use rand_distr::ChiSquared;

use super::errors_at::{RandomError, covariance};
use super::statement::degrees_of_freedom;
use super::*;
use crate::thorough::{sample_size, thorough};
use crate::{Measurand, NormalVector, StudentVector};
use abbe_core::{Class, Description, Distribution, LengthUnit, List, Orientation, Source, Text};
use abbe_kinematics::sampling::{draw, norm, stream};

/// Returns a machine without frames that has these sources.
fn machine(sources: Vec<Source>) -> Description {
    Description {
        name: Text::Constant("budget"),
        title: Text::Constant("budget"),
        length: LengthUnit::Millimetre,
        orientation: Orientation::RotationVector,
        frames: List::Constant(&[]),
        variables: List::Constant(&[]),
        sum_limits: List::Constant(&[]),
        parameters: List::Constant(&[]),
        inputs: List::Constant(&[]),
        sources: sources.into_iter().collect(),
        effects: List::Constant(&[]),
        solutions: 0,
    }
}

fn source(class: Class) -> Source {
    Source::new("source", class, "", "")
}

/// Returns errors of the sources in a subspace of dimension `rank`.
fn errors(description: &Description, rank: usize, seed: u64) -> ErrorsAt<'_> {
    let mut random = stream(seed, 0);
    let mut any = || 2.0 * random.random::<f64>() - 1.0;
    let base = [0; 3].map(|_| [0; 3].map(|_| any()));
    let one = |class: Class, any: &mut dyn FnMut() -> f64| {
        let bound = match class {
            Class::Repeatable => 1.0,
            Class::Tolerance(distribution) | Class::Random(distribution) => distribution.bound(),
        };
        let mut row = [0.0; 6];
        for direction in &base[..rank] {
            let t = any() * bound;
            for measurand in Measurand::ALL {
                (0..3).for_each(|i| row[measurand.first() + i] += t * direction[i]);
            }
        }
        row
    };
    let sources = description.sources.iter().map(|source| one(source.class, &mut any)).collect();
    ErrorsAt { description, sources, effects: Vec::new() }
}

/// Returns the share of draws whose norm is within a radius, and the largest norm. The random
/// numbers are not those of the library.
fn drawn(errors: &ErrorsAt, bias: f64, radius: f64, count: usize, seed: u64) -> (f64, f64) {
    let mut random = stream(!seed, 77);
    let (mut within, mut largest) = (0, 0.0_f64);
    for _ in 0..count {
        let mut sum = [0.0; 3];
        for (source, row) in errors.description.sources.iter().zip(&errors.sources) {
            let t = match source.class {
                Class::Repeatable => bias,
                Class::Tolerance(distribution) | Class::Random(distribution) => {
                    draw(distribution, &mut random) / distribution.bound()
                }
            };
            (0..3).for_each(|i| sum[i] += t * row[i]);
        }
        let error = norm(sum);
        largest = largest.max(error);
        within += usize::from(error <= radius);
    }
    (within as f64 / count as f64, largest)
}

/// Checks twenty budgets of two to nine normal sources of ranks 1, 2 and 3: U covers 95 ± 0.5 % of
/// the draws, about the bias and along each axis.
#[test]
fn the_stated_uncertainty_holds_what_it_says() {
    for seed in 0..20 {
        let rank = 1 + seed as usize % 3;
        let sources = (0..2 + seed as usize % 8).map(|_| source(Class::Random(Distribution::Normal)));
        let description = machine(sources.chain([source(Class::Repeatable)]).collect());
        let errors = errors(&description, rank, seed);
        let statement = Statement::new(&errors, Measurand::Position, seed);
        let (share, _) = drawn(&errors, 0.0, statement.expanded()[3], sample_size(1_000_000), seed);
        assert!((share - COVERAGE).abs() < 0.005, "rank {rank}: {share}");
        assert!((statement.coverage.probability - COVERAGE).abs() < 1e-8);
        assert!(statement.coverage.draws.is_none());
        let shares = statement.contributions.iter().map(|one| one.share).sum::<f64>();
        assert!((shares - 1.0).abs() < 1e-12);
        // Along an axis: the other rows of the draws are zero.
        let mut flat = errors.clone();
        flat.sources.iter_mut().for_each(|row| row[1..3].fill(0.0));
        let (share, _) = drawn(&flat, 0.0, statement.expanded()[0], sample_size(1_000_000), seed);
        assert!((share - COVERAGE).abs() < 0.005, "along x: {share}");
    }
}

/// Checks the stated coverage of U for other distributions.
#[test]
fn the_coverage_of_other_distributions_is_stated() {
    for seed in 0..12 {
        let any = |i: usize| source(Class::Random(Distribution::ALL[(i + seed as usize) % 4]));
        let description = machine((0..1 + seed as usize % 5).map(any).collect());
        let errors = errors(&description, 1 + seed as usize % 3, seed);
        let statement = Statement::new(&errors, Measurand::Orientation, seed);
        let (share, _) = drawn(&errors, 0.0, statement.expanded()[3], sample_size(1_000_000), seed);
        let Compliance { probability, error, .. } = statement.coverage;
        let spread = error.hypot((share * (1.0 - share) / sample_size(1_000_000) as f64).sqrt());
        assert!((share - probability).abs() < 4.0 * spread + 1e-5, "{share} {probability}");
    }
}

/// Compares the probability of meeting a tolerance, with a bias, with draws.
#[test]
fn a_probability_is_that_of_draws() {
    for (seed, kinds) in (0..).zip([
        vec![Distribution::Normal; 4],
        vec![Distribution::Uniform, Distribution::Normal, Distribution::Arcsine],
        vec![Distribution::Triangular; 2],
    ]) {
        let sources = kinds.iter().map(|kind| source(Class::Random(*kind)));
        let description = machine(sources.chain([source(Class::Repeatable)]).collect());
        let errors = errors(&description, 3, 40 + seed);
        let typical = norm(errors.bias(Measurand::Position)) + 0.3;
        for limit in [0.5 * typical, typical, 1.5 * typical] {
            let Compliance { probability, error, draws } =
                errors.distribution(Measurand::Position, None).coverage(limit, seed).0;
            assert_eq!(draws.is_none(), seed == 0);
            let (share, _) = drawn(&errors, 1.0, limit, sample_size(1_000_000), seed);
            let spread = error + (share * (1.0 - share) / sample_size(1_000_000) as f64).sqrt() + 1e-6;
            assert!((share - probability).abs() < 4.0 * spread, "{share} {probability}");
        }
    }
}

/// Normal sources: axis, standard deviation and degrees of freedom.
type Estimated = [(usize, f64, f64)];

/// Figure whose coverage is tested.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Figure {
    Norm,
    FirstRow,
}

/// Returns the coverage of U for a figure when the estimated standard deviations of the sources are
/// `scales` times the true ones.
fn covered(sources: &Estimated, scales: &[f64], figure: Figure) -> f64 {
    let errors = |scales: &[f64]| {
        let one = |((axis, deviation, degrees_of_freedom), scale): (&(usize, f64, f64), &f64)| {
            let mut magnitude = [0.0; 3];
            magnitude[*axis] = deviation * scale;
            let (source, distribution) = (0, Distribution::Normal);
            RandomError {
                source,
                distribution,
                degrees_of_freedom: *degrees_of_freedom,
                is_calibration: false,
                is_of_machine: false,
                parts: [magnitude, [0.0; 3], [0.0; 3]],
            }
        };
        sources.iter().zip(scales).map(one).collect::<Vec<_>>()
    };
    let (stated, known) = (errors(scales), covariance(&errors(&vec![1.0; scales.len()])));
    let matrix = covariance(&stated);
    let [row, .., norm] = degrees_of_freedom(&stated, matrix);
    match figure {
        Figure::Norm => {
            let expanded = StudentVector::new(matrix, norm).quantile(COVERAGE);
            NormalVector::new([0.0; 3], known).within(expanded)
        }
        Figure::FirstRow => {
            let line = NormalVector::new([0.0; 3], [[known[0][0], 0.0, 0.0], [0.0; 3], [0.0; 3]]);
            line.within(student_95(row) * matrix[0][0].sqrt())
        }
    }
}

/// Returns the mean coverage over the estimates of the first two standard deviations: an integral
/// over `s = √(χ²/ν)` with the density `s^(ν − 1) exp(−ν s²/2)`.
fn mean_coverage(sources: &Estimated, figure: Figure) -> f64 {
    let scales = |i: usize| -> Vec<(f64, f64)> {
        let degrees_of_freedom = sources[i].2;
        if degrees_of_freedom.is_infinite() {
            return vec![(1.0, 1.0)];
        }
        let reach = 1.0 + 4.5 / degrees_of_freedom.sqrt();
        // Below three degrees of freedom the density is not smooth at 0.
        let count = if degrees_of_freedom < 3.0 { 60 } else { 10 };
        let points = (0..count).map(|k| reach * (f64::from(k) + 0.5) / f64::from(count));
        points
            .map(|s| (s, s.powf(degrees_of_freedom - 1.0) * (-degrees_of_freedom * s * s / 2.0).exp()))
            .collect()
    };
    let (mut sum, mut weights) = (0.0, 0.0);
    for (first, a) in scales(0) {
        for (second, b) in scales(1) {
            let mut all = vec![1.0; sources.len()];
            (all[0], all[1]) = (first, second);
            sum += a * b * covered(sources, &all, figure);
            weights += a * b;
        }
    }
    sum / weights
}

/// Checks that U of the norm covers at least 94.5 % with estimated standard deviations of three or
/// more degrees of freedom, in line, in a plane and in space.
#[test]
fn estimated_standard_deviations_are_covered() {
    const KNOWN: f64 = f64::INFINITY;
    let cases = [
        &[(0, 1.0, 3.0), (0, 1.0, KNOWN)][..],
        &[(0, 1.0, 3.0), (0, 0.5, KNOWN)],
        &[(0, 1.0, 3.0), (0, 0.25, KNOWN)],
        &[(0, 1.0, 3.0), (0, 1.0, 3.0)],
        &[(0, 1.0, 3.0), (1, 1.0, 3.0)],
        &[(0, 1.0, 3.0), (1, 1.0, KNOWN)],
        &[(0, 1.0, 3.0), (1, 0.3, KNOWN)],
        &[(0, 0.7, 3.0), (1, 1.0, KNOWN)],
        &[(0, 1.0, 4.0), (1, 0.6, 9.0), (2, 0.3, KNOWN)],
        &[(0, 1.0, 3.0), (1, 1.0, KNOWN), (2, 1.0, KNOWN)],
    ];
    for sources in cases.into_iter().step_by(if thorough() { 1 } else { 3 }) {
        let coverage = mean_coverage(sources, Figure::Norm);
        assert!((0.945..0.99).contains(&coverage), "{sources:?}: {coverage}");
    }
    // All three estimated: by draws, with a standard error of 0.25 %.
    let sources = [(0, 1.0, 4.0), (1, 0.8, 6.0), (2, 0.5, 12.0)];
    let mut random = stream(31, 0);
    let mut draw = |degrees: f64| (random.sample(ChiSquared::new(degrees).unwrap()) / degrees).sqrt();
    let mut one = || covered(&sources, &sources.map(|(.., degrees)| draw(degrees)), Figure::Norm);
    let mean = (0..120).map(|_| one()).sum::<f64>() / 120.0;
    assert!((0.945..0.99).contains(&mean), "{mean}");
    // Documented coverages for fewer degrees of freedom, and for the formula of the GUM along an
    // axis, each at its worst.
    for (degrees, known, figure, expected) in [
        (2.0, 0.25, Figure::Norm, 0.942),
        (1.0, 0.18, Figure::Norm, 0.908),
        (9.0, 0.5, Figure::FirstRow, 0.948),
        (4.0, 0.5, Figure::FirstRow, 0.942),
        (2.0, 0.33, Figure::FirstRow, 0.921),
    ] {
        let found = mean_coverage(&[(0, 1.0, degrees), (0, known, KNOWN)], figure);
        assert!((found - expected).abs() < 3e-3, "{degrees}, {figure:?}: {found}");
    }
}

/// Checks the coverage of draws from Student's t-distribution by its quantiles.
#[test]
fn an_estimated_error_is_drawn_after_student() {
    let one = Source { degrees_of_freedom: 5.0, ..source(Class::Random(Distribution::Normal)) };
    let description = machine(vec![one]);
    let errors = errors(&description, 1, 3);
    let statement = Statement::new(&errors, Measurand::Position, 3);
    assert_eq!(statement.contributions[0].degrees_of_freedom, 5.0);
    let factors = statement.coverage_factors.map(|k| (k - 2.570_581_836).abs() < 1e-8);
    assert_eq!((factors, statement.coverage.draws), ([true; 4], Some(DRAWS)));
    let Compliance { probability, error, .. } = statement.coverage;
    assert!((probability - COVERAGE).abs() < 4.0 * error, "{probability}");
}

/// Checks equal shares of bounded sources: neither millions of draws nor any signs of the bounds
/// exceed the tolerance.
#[test]
fn certain_is_never_exceeded() {
    let kinds =
        [Distribution::Uniform, Distribution::Triangular, Distribution::Arcsine, Distribution::Uniform];
    let sources = kinds.iter().map(|kind| source(Class::Random(*kind)));
    let description = machine(sources.chain([source(Class::Repeatable)]).collect());
    let mut errors = errors(&description, 1, 5);
    let tolerance = 0.5;
    // Each source at its share T/n, all in line: the tolerance is fully used.
    for row in &mut errors.sources {
        let size = norm(Measurand::Position.rows(row));
        row.iter_mut().for_each(|value| *value *= tolerance / 5.0 / size);
    }
    let corner = |signs: u32| {
        let row =
            |i: usize| if signs >> i & 1 == 1 { errors.sources[i] } else { errors.sources[i].map(|v| -v) };
        norm([0, 1, 2].map(|axis| (0..5).map(|i| row(i)[axis]).sum::<f64>()))
    };
    let extreme = (0..32).map(corner).fold(0.0, f64::max);
    assert!((extreme - tolerance).abs() < 1e-12);
    let (_, largest) = drawn(&errors, 1.0, tolerance, sample_size(10_000_000), 5);
    assert!(largest <= tolerance * (1.0 + 1e-12), "{largest}");
    assert!(largest > 0.7 * tolerance);
}

/// Shares of the worst case and of the radius add up to 1, and are their logarithmic derivatives:
/// a source that is one millionth larger makes the error larger by its share of that.
#[test]
fn shares_are_derivatives() {
    for seed in 0..60 {
        let class = |i: usize| match (i + seed as usize) % 4 {
            0 | 1 => Class::Repeatable,
            2 => Class::Tolerance(Distribution::Uniform),
            _ => Class::Random(Distribution::ALL[i % 4]),
        };
        let description = machine((0..3 + seed as usize % 8).map(|i| source(class(i))).collect());
        let errors = errors(&description, 3, seed);
        let residuals: Vec<Option<Residual>> = (0..description.sources.len())
            .map(|i| match i % 3 {
                0 => Some(Residual::Share(0.3)),
                1 => Some(Residual::Bound(0.2)),
                _ => None,
            })
            .collect();
        let correction = (seed % 2 == 0).then_some(Correction { residuals: &residuals, together: None });
        let of = |errors: &ErrorsAt<'_>| errors.distribution(Measurand::Position, correction);
        let sums = |shares: &[(usize, f64)]| {
            let mut sums = vec![0.0; description.sources.len()];
            shares.iter().for_each(|(source, share)| sums[*source] += share);
            sums
        };
        let here = of(&errors);
        let (worst, radius) = (here.worst_case(), here.radius());
        for (is_worst, shares) in [(true, sums(&worst.shares)), (false, sums(&here.shares()))] {
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{seed}: {shares:?}");
            for (k, share) in shares.iter().enumerate() {
                // A residual with a stated bound does not depend on its source.
                if correction.is_some() && k % 3 == 1 && description.sources[k].class.can_be_compensated() {
                    continue;
                }
                let mut larger = errors.clone();
                larger.sources[k] = larger.sources[k].map(|row| row * (1.0 + 1e-6));
                let there = of(&larger);
                let ratio = match is_worst {
                    true => there.worst_case().norm / worst.norm,
                    false => there.radius() / radius,
                };
                assert!(((ratio - 1.0) * 1e6 - share).abs() < 1e-4, "{seed}, {k}, {is_worst}: {share}");
            }
        }
    }
}

/// A tolerance of ±1, twice as large at a second configuration, keeps a limit of 0.6 in 30 % of the
/// machines; with a random error that is uniform within ±0.2, of which one end may leave 5 %
/// outside, if `2 t + 0.9 · 0.2 ≤ 0.6`, in 21 %.
#[test]
fn yield_in_closed_form() {
    let sources = [Class::Tolerance(Distribution::Uniform), Class::Random(Distribution::Uniform)];
    let description = machine(sources.map(source).to_vec());
    for (random, exact) in [(0.0, 0.3), (0.2, 0.21)] {
        let mut machines = Machines::new(0.95);
        for scale in [1.0, 2.0, 0.1] {
            let rows = [[scale, 0.0, 0.0, 0.0, 0.0, 0.0], [random, 0.0, 0.0, 0.0, 0.0, 0.0]];
            machines.add(ErrorDistribution::at(&description, &rows, Measurand::Position, None), 0.6);
        }
        let Yield { share, interval: [from, to], .. } = machines.yielded(3, 3);
        assert!(from < exact && exact < to && to - from < 0.02, "{share}, not {exact}");
    }
}

/// Yields of twenty machines with tolerances, random errors, or both, at several configurations,
/// compared with a simulation in plain loops.
#[test]
fn yield_is_that_of_a_simulation() {
    for seed in 0..20 {
        let class = |i: usize| match (i + seed as usize) % 3 {
            0 => Class::Repeatable,
            1 => Class::Tolerance(Distribution::ALL[(i + seed as usize) % 4]),
            _ => Class::Random(Distribution::ALL[i % 4]),
        };
        let description = machine((0..4).map(|i| source(class(i))).collect());
        let rows: Vec<ErrorsAt<'_>> = (0..3).map(|i| errors(&description, 3, 100 * seed + i)).collect();
        let largest = rows.iter().map(|row| row.distribution(Measurand::Position, None).simple_bound());
        let limit = 0.6 * largest.fold(0.0, f64::max);
        let mut machines = Machines::new(0.9);
        for row in &rows {
            machines.add(row.distribution(Measurand::Position, None), limit);
        }
        let found = machines.yielded(3, 7);
        let mut numbers = stream(!seed, 5);
        let (count, draws) = (1000, 300);
        // Machines that certainly keep the limit, and those that may, as far as the draws say.
        let (mut sure, mut possible) = (0, 0);
        for _ in 0..count {
            let mut value = |class: Class| match class {
                Class::Repeatable => 1.0,
                class => draw(class.distribution().unwrap(), &mut numbers) / class.bound(),
            };
            let fixed: Vec<f64> = description.sources.iter().map(|source| value(source.class)).collect();
            let least = rows.iter().map(|row| {
                let within = (0..draws).filter(|_| {
                    let mut sum = [0.0; 3];
                    for (k, error) in row.sources.iter().enumerate() {
                        let t = match description.sources[k].class {
                            class @ Class::Random(_) => value(class),
                            _ => fixed[k],
                        };
                        (0..3).for_each(|i| sum[i] += t * error[i]);
                    }
                    norm(sum) <= limit
                });
                within.count() as f64 / f64::from(draws)
            });
            let least = least.fold(1.0, f64::min);
            let room = 3.0 * (0.09 / f64::from(draws)).sqrt();
            sure += u32::from(least >= (0.9 + room).min(1.0));
            possible += u32::from(least >= 0.9 - room);
        }
        let [least, most] = [sure, possible].map(|kept| f64::from(kept) / f64::from(count));
        let room = 4.0 * (0.25 / f64::from(count)).sqrt();
        let is_within = found.share > least - room && found.share < most + room;
        assert!(is_within, "{seed}: {found:?}, not {least} to {most}");
    }
}

/// A ball and a disc are one error each, with other sources between their parts: `B x`, of which
/// `‖x‖ ≤ 1`. No draw exceeds the worst case, which is exact for a ball with one radius in all
/// directions, that of the others plus this radius; probabilities, standard uncertainties and
/// yields are those of plain loops.
#[test]
fn a_ball_is_one_error() {
    let ball = |part, parts| Distribution::Ball { part, parts };
    let classes = [
        Class::Repeatable,
        Class::Tolerance(ball(0, 3)),
        Class::Random(Distribution::Uniform),
        Class::Random(ball(0, 2)),
        Class::Tolerance(ball(1, 3)),
        Class::Tolerance(ball(2, 3)),
        Class::Random(ball(1, 2)),
    ];
    let description = machine(classes.map(source).to_vec());
    assert_eq!([0, 1, 2, 3, 4, 5, 6].map(|k| description.whole(k)), [0, 1, 2, 3, 1, 1, 3]);
    for seed in 0..12 {
        let mut errors = errors(&description, 3, seed);
        let is_exact = seed % 2 == 0;
        if is_exact {
            // A ball in turned axes, and no disc.
            let axes = nalgebra::Rotation3::new(nalgebra::Vector3::from_row_slice(&errors.sources[1][..3]));
            for (column, k) in [1, 4, 5].into_iter().enumerate() {
                (0..3).for_each(|row| errors.sources[k][row] = 0.7 * axes[(row, column)]);
            }
            [3, 6].into_iter().for_each(|k| errors.sources[k] = [0.0; 6]);
        }
        let distribution = errors.distribution(Measurand::Position, None);
        let mut numbers = stream(!seed, 9);
        let mut inside = |count: usize, is_on_surface: bool| loop {
            let x: [f64; 3] =
                core::array::from_fn(|i| if i < count { 2.0 * numbers.random::<f64>() - 1.0 } else { 0.0 });
            let length = norm(x);
            if (0.1..=1.0).contains(&length) && is_on_surface {
                return x.map(|x| x / length);
            } else if length <= 1.0 && !is_on_surface {
                return x;
            }
        };
        let sum = |sizes: [f64; 7]| {
            norm([0, 1, 2].map(|row| (0..7).map(|k| sizes[k] * errors.sources[k][row]).sum::<f64>()))
        };
        let count = 100_000;
        let worst = distribution.worst_case();
        let (mut largest, mut squares, mut within) = (0.0_f64, 0.0, 0);
        let limit = 0.5 * worst.norm;
        let mut uniform = stream(!seed, 10);
        for _ in 0..count {
            let ([a, b, c], [d, e, _]) = (inside(3, true), inside(2, true));
            for sign in [1.0, -1.0] {
                largest = largest.max(sum([1.0, a, sign, d, b, c, e]));
            }
            let ([a, b, c], [d, e, _], t) =
                (inside(3, false), inside(2, false), uniform.random_range(-1.0..1.0));
            let drawn = sum([0.0, a, t, d, b, c, e]);
            squares += drawn * drawn;
            within += usize::from(sum([1.0, a, t, d, b, c, e]) <= limit);
        }
        assert!(largest <= worst.norm * (1.0 + 1e-12), "{seed}: {largest} exceeds {}", worst.norm);
        if is_exact {
            assert!(largest > worst.norm * 0.999, "{seed}: {largest}, not {}", worst.norm);
            let others = [1.0, -1.0].map(|sign| sum([1.0, 0.0, sign, 0.0, 0.0, 0.0, 0.0]));
            assert!((worst.norm - others[0].max(others[1]) - 0.7).abs() < 1e-12);
        }
        let close = |a: f64, b: f64, error: f64| assert!((a - b).abs() < error, "{seed}: {a}, not {b}");
        close(worst.shares.iter().map(|(_, share)| share).sum(), 1.0, 1e-12);
        close(distribution.shares().iter().map(|(_, share)| share).sum(), 1.0, 1e-12);
        let statement = Statement::new(&errors, Measurand::Position, seed);
        close((squares / f64::from(count)).sqrt() / statement.standard[3], 1.0, 0.01);
        let (compliance, _) = distribution.coverage(limit, seed);
        let share = within as f64 / f64::from(count);
        close(compliance.probability, share, 5.0 * (0.25 / f64::from(count)).sqrt());
        // With the tolerance alone, the yield is the probability.
        let mut fixed = errors.clone();
        [2, 3, 6].into_iter().for_each(|k| fixed.sources[k] = [0.0; 6]);
        let alone = fixed.distribution(Measurand::Position, None);
        let mut machines = Machines::new(0.95);
        machines.add(alone.clone(), limit);
        let Yield { interval: [from, to], .. } = machines.yielded(1, seed);
        let (Compliance { probability, .. }, _) = alone.coverage(limit, seed);
        assert!(
            probability > from - 0.01 && probability < to + 0.01,
            "{seed}: {probability}, {from} to {to}"
        );
    }
}

/// The residual of a ball, as a length, is there if any of its parts has an effect, and only then.
#[test]
fn the_residual_of_a_ball_asks_all_parts() {
    let ball = |part| Class::Tolerance(Distribution::Ball { part, parts: 3 });
    let description = machine([ball(0), ball(1), ball(2)].map(source).to_vec());
    let residuals = [Some(Residual::Bound(0.01)), None, None];
    let correction = Correction { residuals: &residuals, together: None };
    for parts in 0..8_usize {
        let mut errors = errors(&description, 3, 4);
        (0..3).filter(|k| parts >> k & 1 == 0).for_each(|k| errors.sources[k] = [0.0; 6]);
        let left = errors.distribution(Measurand::Position, Some(correction)).worst_case().norm;
        assert_eq!(left, if parts == 0 { 0.0 } else { 0.01 }, "{parts:03b}");
    }
}
