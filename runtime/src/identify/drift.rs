//! What is left of a fit against the order in which it was measured: does the machine warm up or drift?
//!
//! A row's error is the mean over its targets. Where configurations were visited again, errors are taken about the mean of
//! their configuration, which takes all errors of the model away; elsewhere what grows with a joint or its square is taken
//! away first, so that a way through the workspace is not taken for time. Whether the rest follows time is told by a
//! permutation test (Freedman and Lane, 1983): the largest squared correlation of x, y, z and the distance with `t` and
//! with `exp(−t/T)`, `T` of 3, 10 and 30 % of the time, against that of the same rows in random orders. So its rate of
//! false alarms is the level at which p is held, whatever the errors look like.

use nalgebra::{DMatrix, DVector};
use rand::RngExt;

use super::linearize::by_blocks;
use super::{Configurations, Failure, Model, Observation};
use crate::analysis::sampling::{norm, stream};

/// How what is left follows the order of rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// The correlation of what is left with what is left of the next row.
    pub lag_1: f64,
    /// How likely so large a correlation is, either sign, in a random order.
    pub p_of_lag_1: f64,
    /// What follows time best.
    pub follows: Follows,
    /// The time constant as a share of the time that was taken; none for a straight line.
    pub settling: Option<f64>,
    /// By how much it changes from the first row to the last: the length unit.
    pub change: f64,
    /// How likely it follows time as well in a random order.
    pub p: f64,
    /// The mean distance of the first tenth of the rows, and of the last.
    pub ends: [f64; 2],
}

/// What follows time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Follows {
    /// The error along x, y or z: 0, 1, 2.
    Axis(usize),
    /// The distance between model and measurement.
    Distance,
}

/// The most pieces of time that are told apart: rows of a piece are averaged.
const PIECES: usize = 400;

/// Random orders.
const ORDERS: usize = 999;

/// Fewer rows tell nothing of time.
const FEWEST: usize = 20;

/// Time constants, as shares of the time that was taken.
const SETTLING: [f64; 3] = [0.03, 0.1, 0.3];

/// Judges rows at `x`; none if there are too few to tell.
pub fn drift(model: &Model, rows: &[&Observation], x: &[f64]) -> Result<Option<Drift>, Failure> {
    let block = |first: usize, part: &[&Observation]| {
        let mut room = model.room();
        let mut means = Vec::with_capacity(part.len());
        for (place, row) in (first..).zip(part) {
            let (mut sum, mut count) = ([0.0; 3], 0.0);
            model.each_deviation(&mut room, row, x, |error| {
                sum = core::array::from_fn(|axis| sum[axis] + error[axis]);
                count += 1.0;
            })?;
            if count > 0.0 {
                means.push((row.time().unwrap_or(place as f64), place, sum.map(|sum| sum / count)));
            }
        }
        Ok(means)
    };
    let mut errors: Vec<Timed> = Vec::with_capacity(rows.len());
    by_blocks(rows, block, |means| {
        errors.extend(means.into_iter().map(|(time, place, mean)| (time, rows[place], mean)));
    })?;
    // A stable sort takes room for half of them, and they are in order most of the time.
    if !errors.is_sorted_by(|a, b| a.0.total_cmp(&b.0).is_le()) {
        errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    Ok(judged(&errors))
}

/// Time, row and error, in the order of time.
type Timed<'o> = (f64, &'o Observation, [f64; 3]);

fn judged(errors: &[Timed]) -> Option<Drift> {
    let tenth = errors.len() / 10;
    let distances = |part: &[Timed]| part.iter().map(|e| norm(e.2)).sum::<f64>() / part.len().max(1) as f64;
    let ends = [distances(&errors[..tenth]), distances(&errors[errors.len() - tenth..])];
    let Configurations { count, number } = Configurations::new(errors.iter().map(|e| e.1));
    let mut visits = vec![0_u32; count];
    number.iter().for_each(|at| visits[*at] += 1);
    let again: u32 = visits.iter().filter(|visits| **visits > 1).sum();
    let visited_again = 2 * again as usize > errors.len();
    let of_row = |i: usize| {
        let [x, y, z] = errors[i].2;
        [x, y, z, norm([x, y, z])]
    };
    // By configuration the mean of its visits, where they are taken off.
    let mut means = vec![[0.0; 4]; if visited_again { count } else { 0 }];
    if visited_again {
        for (i, at) in number.iter().enumerate() {
            let value = of_row(i);
            (0..4).for_each(|a| means[*at][a] += value[a] / f64::from(visits[*at]));
        }
    }
    let value = |i: usize, a: usize| of_row(i)[a] - means.get(number[i]).map_or(0.0, |mean| mean[a]);
    let kept: Vec<usize> = (0..errors.len()).filter(|i| !visited_again || visits[number[*i]] > 1).collect();
    if kept.len() < FEWEST {
        return None;
    }
    let pieces: Vec<&[usize]> = kept.chunks(kept.len().div_ceil(PIECES)).collect();
    let n = pieces.len();
    let mean = |piece: &[usize], of: &dyn Fn(usize) -> f64| {
        piece.iter().map(|i| of(*i)).sum::<f64>() / piece.len() as f64
    };
    let joints = errors[0].1.q.len();
    let mut nuisance = vec![DVector::repeat(n, 1.0)];
    if !visited_again && n > 6 * joints {
        for (joint, power) in (0..joints).flat_map(|joint| [(joint, 1), (joint, 2)]) {
            let value = |i: usize| errors[i].1.q[joint].powi(power);
            nuisance.push(DVector::from_iterator(n, pieces.iter().map(|piece| mean(piece, &value))));
        }
    }
    let nuisance = orthonormal(&nuisance);
    let cleaned = |column: DVector<f64>| nuisance.iter().fold(column, |c, z| &c - z * z.dot(&c));
    let values: Vec<DVector<f64>> = (0..4)
        .map(|a| cleaned(DVector::from_iterator(n, pieces.iter().map(|piece| mean(piece, &|i| value(i, a))))))
        .collect();
    let (first, last) = (errors[kept[0]].0, errors[kept[kept.len() - 1]].0);
    let time = |i: usize| if last > first { (errors[i].0 - first) / (last - first) } else { 0.0 };
    let shapes = [None].into_iter().chain(SETTLING.map(Some));
    let shape = |settling: Option<f64>, t: f64| settling.map_or(t, |constant| (-t / constant).exp());
    let bases: Vec<(Option<f64>, DVector<f64>)> = shapes
        .map(|settling| {
            let column = pieces.iter().map(|piece| shape(settling, mean(piece, &time)));
            (settling, cleaned(DVector::from_iterator(n, column)))
        })
        .collect();
    let table = DMatrix::from_columns(&values);
    let squares: Vec<f64> = values.iter().map(DVector::norm_squared).collect();
    // The best of all, and its place.
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
    Some(Drift {
        lag_1,
        p_of_lag_1,
        follows: if a < 3 { Follows::Axis(a) } else { Follows::Distance },
        settling: *settling,
        change: slope * (shape(*settling, 1.0) - shape(*settling, 0.0)),
        p,
        ends,
    })
}

/// Gram and Schmidt; columns that say nothing new are left out.
fn orthonormal(columns: &[DVector<f64>]) -> Vec<DVector<f64>> {
    let mut all: Vec<DVector<f64>> = Vec::new();
    for column in columns {
        let length = column.norm();
        // Twice is enough.
        let rest =
            [(); 2].iter().fold(column.clone(), |rest, ()| all.iter().fold(rest, |c, z| &c - z * z.dot(&c)));
        if rest.norm() > 1e-8 * length {
            all.push(rest.normalize());
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_xoshiro::Xoshiro256PlusPlus;

    use super::{Drift, Follows, judged};
    use crate::identify::{Measurement, Observation};

    /// Rows of a machine of two joints, with an error that the function says of time (0 to 1) and joints.
    fn rows(
        seed: u64,
        count: usize,
        visits: usize,
        error: impl Fn(f64, &[f64]) -> [f64; 3],
    ) -> Option<Drift> {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let places: Vec<[f64; 2]> =
            (0..count / visits).map(|_| [(); 2].map(|()| random.random_range(-1.0..1.0))).collect();
        let row = |i: usize| {
            let configuration = i % places.len();
            let row = Observation::new(
                i as u64,
                places[configuration].to_vec(),
                Vec::new(),
                Measurement::Points(vec![].into()),
            );
            Observation { configuration: configuration as u32, ..row }
        };
        let rows: Vec<Observation> = (0..count).map(row).collect();
        let normal = rand_distr::Normal::new(0.0, 1.0).unwrap();
        let errors = rows.iter().enumerate().map(|(i, row)| {
            let [x, y, z] = error(i as f64 / count as f64, &row.q);
            (i as f64, row, [x, y, z].map(|e| e + random.sample(normal)))
        });
        judged(&errors.collect::<Vec<_>>())
    }

    /// 1 % of orders without drift are called one: of 300, 3 ± 1.7.
    #[test]
    fn false_alarms_are_as_rare_as_stated() {
        for visits in [1, 5] {
            let alarms =
                |seed| rows(seed, 60, visits, |_, q| [3.0 * q[0], 0.0, 2.0 * q[1] * q[1]]).unwrap().p <= 0.01;
            let alarms = (0..300).filter(|seed| alarms(*seed)).count();
            assert!(alarms <= 8, "{visits}: {alarms} of 300");
        }
    }

    #[test]
    fn warming_and_drifting_are_told() {
        let warming = rows(1, 300, 1, |t, _| [0.0, 3.0 * (-t / 0.1).exp(), 0.0]).unwrap();
        assert!(warming.p <= 0.01 && warming.follows == Follows::Axis(1), "{warming:?}");
        assert!(warming.settling == Some(0.1) && (warming.change + 3.0).abs() < 1.2, "{warming:?}");
        let drifting = rows(2, 300, 10, |t, q| [5.0 * q[0], 0.0, 2.0 * t]).unwrap();
        assert!(drifting.p <= 0.01 && drifting.follows == Follows::Axis(2), "{drifting:?}");
        assert!((drifting.change - 2.0).abs() < 0.8);
        assert!(rows(3, 15, 1, |_, _| [0.0; 3]).is_none());
    }

    /// A swing of variance 4.5 in noise of variance 1: neighbours correlate by about 0.8, less what the joints explain of it.
    #[test]
    fn neighbours_tell_what_no_line_and_no_settling_does() {
        let swinging = rows(4, 300, 1, |t, _| [3.0 * (6.0 * t).sin(); 3]).unwrap();
        assert!(swinging.lag_1 > 0.5 && swinging.p_of_lag_1 <= 0.01, "{swinging:?}");
        let still = rows(4, 300, 1, |_, _| [0.0; 3]).unwrap();
        assert!(still.lag_1.abs() < 0.2, "{still:?}");
    }
}
