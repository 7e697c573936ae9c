//! Drift test: correlation of the residuals of a fit with time.
//!
//! The error of a row is the mean over its targets. If configurations are visited repeatedly,
//! errors are taken about the mean of their configuration, which removes all errors of the model;
//! otherwise, regressions on each joint and its square are removed, so that a systematic path
//! through the workspace is not taken for drift. A permutation test (Freedman and Lane, 1983)
//! compares the largest squared correlation of x, y, z and the distance with `t` and `exp(−t/T)`,
//! for `T` of 3, 10 and 30 % of the duration, with those of random orders of the same rows. Its
//! false-alarm rate is the significance level, for any distribution of the errors.

use core::borrow::Borrow;

use nalgebra::{DMatrix, DVector};
use rand::RngExt;

use super::{Configurations, Model, Observation, Result, by_blocks};
use abbe_analysis::sampling::{norm, stream};

/// Correlation of residuals with time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Drift {
    /// Autocorrelation of the residuals of consecutive rows.
    pub lag_1: f64,
    /// Two-sided p-value of the autocorrelation, from random orders.
    pub p_of_lag_1: f64,
    /// Component that correlates most with time: the error along `x`, `y` or `z`, or the `distance`
    /// between model and measurement.
    pub follows: &'static str,
    /// Time constant of the best exponential, as a share of the duration; none for a straight line.
    pub settling: Option<f64>,
    /// Fitted change of the residuals from the first interval to the last, in the length unit: what
    /// the regressions on the joints do not explain.
    pub change: f64,
    /// p-value of the correlation, from random orders.
    pub p: f64,
    /// Mean distances of the first and of the last tenth of the rows, in the length unit.
    pub ends: [f64; 2],
}

/// Largest number of time intervals; rows within an interval are averaged.
const PIECES: usize = 400;

/// Number of random orders.
const ORDERS: usize = 999;

/// Smallest number of rows for a test.
const FEWEST: usize = 20;

/// Time constants, as shares of the duration.
const SETTLING: [f64; 3] = [0.03, 0.1, 0.3];

/// Tests the residuals of rows at `x` for drift; returns none for fewer than 20 rows.
///
/// Errors are recomputed when needed instead of stored, so that memory does not grow with the
/// number of rows.
pub fn drift<R: Borrow<Observation> + Sync>(model: &Model, rows: &[R], x: &[f64]) -> Result<Option<Drift>> {
    let row = |i: u32| rows[i as usize].borrow();
    let time = |i: u32| row(i).time().unwrap_or(f64::from(i));
    let mut order: Vec<u32> = (0..rows.len() as u32).filter(|i| model.has_deviations(row(*i))).collect();
    // A stable sort allocates half of the list, which usually is sorted already.
    if !order.is_sorted_by(|a, b| time(*a).total_cmp(&time(*b)).is_le()) {
        order.sort_by(|a, b| time(*a).total_cmp(&time(*b)));
    }
    // One time for all rows is no order.
    let is_timed = order.iter().all(|i| row(*i).time().is_some());
    if let (true, Some(first), Some(last)) = (is_timed, order.first(), order.last())
        && time(*first) == time(*last)
    {
        return Ok(None);
    }
    let errors = |take: &mut dyn FnMut([f64; 3])| {
        let block = |_: usize, order: &[u32]| {
            let mut at = model.at(x);
            let mean = |i: &u32| {
                let (mut sum, mut count) = ([0.0; 3], 0.0);
                at.each_deviation(row(*i), |error| {
                    sum = core::array::from_fn(|axis| sum[axis] + error[axis]);
                    count += 1.0;
                })?;
                Ok(sum.map(|sum| sum / count))
            };
            order.iter().map(mean).collect::<Result<Vec<_>, _>>()
        };
        by_blocks(&order, block, |means| means.into_iter().for_each(&mut *take))
    };
    let (row, time) = (|place: usize| row(order[place]), |place: usize| time(order[place]));
    test_drift(&Timed { count: order.len(), row: &row, time: &time, errors: &errors })
}

/// Rows in order of time.
struct Timed<'o> {
    count: usize,
    row: &'o dyn Fn(usize) -> &'o Observation,
    time: &'o dyn Fn(usize) -> f64,
    /// Passes the error of each row to a function, in order.
    errors: &'o Errors<'o>,
}

type Errors<'o> = dyn Fn(&mut dyn FnMut([f64; 3])) -> Result<()> + 'o;

fn test_drift(&Timed { count, row, time, errors }: &Timed) -> Result<Option<Drift>> {
    let configurations = Configurations::new((0..count).map(row));
    let visits = configurations.visits();
    let at = |i: usize| configurations.number[i] as usize;
    let again: u32 = visits.iter().filter(|visits| **visits > 1).sum();
    let visited_again = 2 * again as usize > count;
    let with_norm = |[x, y, z]: [f64; 3]| [x, y, z, norm([x, y, z])];
    // Mean error of each configuration, if these are subtracted.
    let mut means = vec![[-0.0; 4]; if visited_again { configurations.count } else { 0 }];
    if visited_again {
        let mut rows = 0..count;
        errors(&mut |error| {
            let (at, value) = (rows.next().map_or(0, at), with_norm(error));
            (0..4).for_each(|a| means[at][a] += value[a]);
        })?;
        means
            .iter_mut()
            .zip(&visits)
            .for_each(|(mean, visits)| *mean = mean.map(|sum| sum / f64::from(*visits)));
    }
    let is_kept = |i: usize| !visited_again || visits[at(i)] > 1;
    let kept = if visited_again { again as usize } else { count };
    if kept < FEWEST {
        return Ok(None);
    }
    let length = kept.div_ceil(PIECES);
    let n = kept.div_ceil(length);
    let first = (0..count).find(|i| is_kept(*i)).map_or(0.0, time);
    let last = (0..count).rfind(|i| is_kept(*i)).map_or(0.0, time);
    let since = |i: usize| if last > first { (time(i) - first) / (last - first) } else { 0.0 };
    let joints = row(0).q.len();
    let joints = if !visited_again && n > 6 * joints { joints } else { 0 };
    // Averages in each interval: error, norm, time, each joint and its square.
    let mut pieces = DMatrix::repeat(n, 5 + 2 * joints, -0.0);
    let (mut ends, tenth) = ([-0.0; 2], count / 10);
    let (mut i, mut place) = (0, 0);
    errors(&mut |error| {
        let value = with_norm(error);
        ends[0] += if i < tenth { value[3] } else { -0.0 };
        ends[1] += if i >= count - tenth { value[3] } else { -0.0 };
        if is_kept(i) {
            let mut piece = pieces.row_mut(place / length);
            let mean = means.get(at(i)).copied().unwrap_or_default();
            (0..4).for_each(|a| piece[a] += value[a] - mean[a]);
            piece[4] += since(i);
            for (joint, q) in row(i).q[..joints].iter().enumerate() {
                piece[5 + 2 * joint] += q;
                piece[6 + 2 * joint] += q.powi(2);
            }
            place += 1;
        }
        i += 1;
    })?;
    let ends = ends.map(|sum| sum / tenth.max(1) as f64);
    for (k, mut piece) in pieces.row_iter_mut().enumerate() {
        piece /= length.min(kept - k * length) as f64;
    }
    let column = |k: usize| pieces.column(k).into_owned();
    let mut nuisance = vec![DVector::repeat(n, 1.0)];
    nuisance.extend((0..2 * joints).map(|k| column(5 + k)));
    let nuisance = orthonormal(&nuisance);
    let cleaned = |column: DVector<f64>| nuisance.iter().fold(column, |c, z| &c - z * z.dot(&c));
    let values: Vec<DVector<f64>> = (0..4).map(|a| cleaned(column(a))).collect();
    let shapes = [None].into_iter().chain(SETTLING.map(Some));
    let shape = |settling: Option<f64>, t: f64| settling.map_or(t, |constant| (-t / constant).exp());
    let bases: Vec<(Option<f64>, DVector<f64>)> =
        shapes.map(|settling| (settling, cleaned(column(4).map(|t| shape(settling, t))))).collect();
    let table = DMatrix::from_columns(&values);
    let squares: Vec<f64> = values.iter().map(DVector::norm_squared).collect();
    // Largest squared correlation, and its position.
    let best = |order: &[usize]| {
        let mut best = (0.0, 0, 0);
        for (j, (_, basis)) in bases.iter().enumerate() {
            let length = basis.norm_squared();
            for a in (0..4).filter(|a| squares[*a] > 0.0 && length > 1e-9) {
                let along: f64 = order.iter().zip(basis.iter()).map(|(i, b)| table[(*i, a)] * b).sum();
                let share = along * along / (length * squares[a]);
                best = if share > best.0 { (share, j, a) } else { best };
            }
        }
        best
    };
    let neighbours = |order: &[usize]| {
        let products = order
            .windows(2)
            .map(|pair| (0..3).map(|a| table[(pair[0], a)] * table[(pair[1], a)]).sum::<f64>());
        products.sum::<f64>() / squares[..3].iter().sum::<f64>().max(f64::MIN_POSITIVE)
    };
    let mut order: Vec<usize> = (0..n).collect();
    let ((share, j, a), lag_1) = (best(&order), neighbours(&order));
    let mut random = stream(0x0064_7269_6674, 0);
    let mut reached = [1.0; 2];
    for _ in 0..ORDERS {
        (1..n).for_each(|i| order.swap(i, random.random_range(0..=i)));
        reached[0] += f64::from(u8::from(best(&order).0 >= share));
        reached[1] += f64::from(u8::from(neighbours(&order).abs() >= lag_1.abs()));
    }
    let [p, p_of_lag_1] = reached.map(|count| count / (ORDERS + 1) as f64);
    let (settling, basis) = &bases[j];
    let slope = basis.dot(&values[a]) / basis.norm_squared().max(f64::MIN_POSITIVE);
    Ok(Some(Drift {
        lag_1,
        p_of_lag_1,
        follows: ["x", "y", "z", "distance"][a],
        settling: *settling,
        change: slope * (basis[n - 1] - basis[0]),
        p,
        ends,
    }))
}

/// Orthonormalizes columns by Gram-Schmidt; omits dependent ones.
fn orthonormal(columns: &[DVector<f64>]) -> Vec<DVector<f64>> {
    let mut all: Vec<DVector<f64>> = Vec::new();
    for column in columns {
        let length = column.norm();
        // Two passes suffice for orthogonality.
        let rest =
            [(); 2].iter().fold(column.clone(), |rest, ()| all.iter().fold(rest, |c, z| &c - z * z.dot(&c)));
        if rest.norm() > 1e-8 * length {
            all.push(rest.normalize());
        }
    }
    all
}

#[cfg(test)]
mod tests;
