//! Local search for a maximum: each step maximizes a quadratic model within a trust region that
//! grows and shrinks with the success of the steps.

use crate::problem::{Point, Problem};
use crate::unknowns::Buffers;

/// Number of sample points before the ascents.
const SAMPLES: usize = 512;
/// Number of sample points where unknowns have to be found for each.
const SAMPLES_OF_UNKNOWNS: usize = 64;
/// Number of sample points from which an ascent starts.
const ASCENTS: usize = 6;
/// Number of values of each name that are scanned from the start.
const SCANNED: usize = 33;
/// Maximum number of steps of an ascent.
const STEPS: usize = 60;

/// Returns the largest value found by ascents from the start and from points spread over the box.
pub(crate) fn highest<const N: usize>(problem: &Problem) -> Point {
    let mut points = Buffers::default();
    let (samples, scanned) = match problem.unknowns {
        None => (SAMPLES, SCANNED),
        Some(_) => (SAMPLES_OF_UNKNOWNS, 0),
    };
    let mut samples: Vec<Point> = (0..samples)
        .map(|sample| {
            let at =
                (0..problem.domain.len()).map(|i| share(problem, i, spread(sample, i))).collect::<Vec<_>>();
            Point { value: problem.value_at(&mut points, &at)[0], at }
        })
        .filter(|point| point.value.is_finite())
        .collect();
    samples.sort_by(|a, b| b.value.total_cmp(&a.value));
    samples.truncate(ASCENTS);
    // Scan from the start along each name as well, because a slope of 0 there does not exclude
    // larger values.
    let along = (0..problem.domain.len()).flat_map(|name| (0..scanned).map(move |i| (name, i)));
    let along = along.map(|(name, i)| {
        let mut at = problem.start.clone();
        at[name] = share(problem, name, i as f64 / (SCANNED - 1) as f64);
        at
    });
    let start = std::iter::once(problem.start.clone()).chain(along).map(|at| {
        let value = problem.value_at(&mut points, &at)[0];
        Point { value, at }
    });
    let start = start.filter(|point| point.value.is_finite());
    samples.extend(start.max_by(|a, b| a.value.total_cmp(&b.value)));
    let ascents = samples.into_iter().map(|point| ascend::<N>(problem, point));
    let none = Point { value: f64::NEG_INFINITY, at: problem.domain.iter().map(|range| range[0]).collect() };
    ascents.fold(none, |best, point| if point.value > best.value { point } else { best })
}

fn share(problem: &Problem, name: usize, share: f64) -> f64 {
    let [low, high] = problem.domain[name];
    (low + share * (high - low)).clamp(low, high)
}

/// Ascends to a local maximum.
pub(crate) fn ascend<const N: usize>(problem: &Problem, mut best: Point) -> Point {
    let widths: Vec<f64> = problem.domain.iter().map(|[low, high]| high - low).collect();
    let (mut buffers, mut points, mut reach) = (Buffers::<N>::default(), Buffers::default(), 0.1);
    for _ in 0..STEPS {
        let halves: Vec<f64> = widths.iter().map(|width| 1e-6 * width).collect();
        let slopes = problem.slopes_near(&mut buffers, &best.at, &halves);
        // A name that stands still has no width.
        let per_unit = |a: &f64, half: f64| if half > 0.0 { a / half } else { 0.0 };
        let second = |i: usize, j: usize| slopes[i].slopes.get(j).map_or(0.0, |a| per_unit(a, halves[j]));
        let mut step = vec![0.0; widths.len()];
        for _ in 0..8 {
            for i in 0..step.len() {
                let others: f64 = (0..step.len()).filter(|j| *j != i).map(|j| second(i, j) * step[j]).sum();
                let (slope, curve) = (slopes[i].centre + others, second(i, i));
                let limit = reach * widths[i];
                let wanted = if curve < 0.0 { -slope / curve } else { slope.signum() * limit };
                let [low, high] = problem.domain[i];
                let (from, to) = ((low - best.at[i]).max(-limit), (high - best.at[i]).min(limit));
                step[i] = if wanted.is_finite() { wanted.max(from).min(to) } else { 0.0 };
            }
        }
        let at = best.at.iter().zip(&step).zip(&problem.domain);
        let at: Vec<f64> = at.map(|((x, step), [low, high])| (x + step).clamp(*low, *high)).collect();
        let value = problem.value_at(&mut points, &at)[0];
        if value > best.value {
            let gained = value - best.value;
            best = Point { value, at };
            reach = (2.0 * reach).min(0.5);
            if gained <= 1e-14 * value.abs() {
                break;
            }
        } else {
            reach *= 0.25;
            if reach < 1e-10 {
                break;
            }
        }
    }
    best
}

/// Returns an evenly spread fraction: multiples of the fractional parts of roots of primes.
fn spread(sample: usize, name: usize) -> f64 {
    const PRIMES: [f64; 16] =
        [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0, 41.0, 43.0, 47.0, 53.0];
    let root = PRIMES[name % PRIMES.len()].sqrt() * (1 + name / PRIMES.len()) as f64;
    ((sample + 1) as f64 * root).fract()
}
