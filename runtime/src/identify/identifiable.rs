//! Which unknowns the data determine, and what the others are grouped with.

use nalgebra::{DMatrix, DVector};

use super::linearize::linearize;
use super::{Failure, Model, Observability, Observation};

/// Singular values of the matrix with columns of unit length at or below this share of the largest count as zero.
pub const THRESHOLD: f64 = 1e-8;

/// What data of this kind determine.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiable {
    /// How many combinations of the unknowns are determined.
    pub rank: usize,
    /// The unknowns that stand for them, by index, in ascending order: the others can be held at zero.
    pub kept: Vec<usize>,
    /// Those held at zero, each with what it acts as: `column = Σ factor × column of a kept one`.
    pub held: Vec<(usize, Vec<(usize, f64)>)>,
    /// All singular values of the matrix with columns of unit length, largest first.
    pub singular_values: Vec<f64>,
    /// Condition number and observability of the kept columns, each of unit length.
    pub observability: Observability,
    /// The smallest singular value that counts over the largest that does not; infinite if all count.
    pub gap: f64,
}

/// Finds what data of this kind determine at `x`; see [`Options::at`](super::Options::at).
///
/// Of unknowns that act alike, those of base and fixtures are kept, then those of the frames nearest to the tool.
pub fn identifiable(model: &Model, data: &[Observation], x: &[f64]) -> Result<Identifiable, Failure> {
    let triangle = linearize(model, data, x, None)?;
    let p = model.unknowns.len();
    let rows = data.iter().map(Observation::count).sum();
    Ok(Identifiable::from_triangle(&triangle.finish().columns(0, p).into_owned(), &order(model), rows))
}

/// The order in which unknowns are kept.
fn order(model: &Model) -> Vec<usize> {
    use super::Unknown::{Base, Error, Fixture, Magnitude, Target, Tool, Zero};
    let frames = model.manipulator.description().frames.len();
    let mut order: Vec<usize> = (0..model.unknowns.len()).collect();
    order.sort_by_key(|k| match model.unknowns[*k] {
        Base(station, component) => (0, 6 * station + component.index()),
        Fixture(fixture, coordinate) => (1, 3 * fixture + coordinate),
        Zero(reading) => (1, 3 * model.fixtures.len() + reading),
        Error(frame, component) => (1 + frames - frame, component.index()),
        Magnitude(source) => (frames + 2, source),
        Target(target, axis) => (frames + 3, 3 * target + axis),
        Tool(component) => (frames + 3, component.index()),
    });
    order
}

impl Identifiable {
    /// From a triangle of the derivatives.
    fn from_triangle(triangle: &DMatrix<f64>, order: &[usize], rows: usize) -> Self {
        let p = triangle.ncols();
        let mut scaled = triangle.clone();
        let lengths: Vec<f64> = scaled.column_iter().map(|column| column.norm()).collect();
        let largest = lengths.iter().copied().fold(0.0, f64::max);
        // A column of rounding errors is none.
        for (mut column, length) in scaled.column_iter_mut().zip(&lengths) {
            column.scale_mut(if *length > largest * 1e-14 { 1.0 / length } else { 0.0 });
        }
        let singular_values = singular_values(&scaled);
        let threshold = singular_values.first().map_or(0.0, |first| first * THRESHOLD);
        let rank = singular_values.iter().filter(|value| **value > threshold).count();
        let gap = match (rank.checked_sub(1), singular_values.get(rank)) {
            (Some(last), Some(next)) if *next > 0.0 => singular_values[last] / next,
            _ => f64::INFINITY,
        };

        // Gram and Schmidt in the order of preference; what adds little new waits for a later pass.
        let mut rest = scaled.clone();
        let mut kept: Vec<usize> = Vec::new();
        let mut pass = 0.1;
        while kept.len() < rank {
            for &k in order {
                let new = rest.column(k).norm();
                if kept.len() == rank || kept.contains(&k) || new <= pass {
                    continue;
                }
                let direction = rest.column(k) / new;
                for mut column in rest.column_iter_mut() {
                    let along = direction.dot(&column);
                    column.axpy(-along, &direction, 1.0);
                }
                kept.push(k);
            }
            pass *= 0.1;
            if pass < 1e-16 {
                break;
            }
        }
        kept.sort_unstable();
        let basis = scaled.select_columns(&kept);
        let held = (0..p)
            .filter(|k| !kept.contains(k))
            .map(|k| (k, combination(&basis, &scaled, k, &kept, &lengths)));
        let held = held.collect();
        let observability = Observability::from_singular_values(&self::singular_values(&basis), rows);
        Self { rank: kept.len(), held, kept, singular_values, observability, gap }
    }
}

/// `column k = Σ factor × kept column`, in the units of the unknowns; what is nothing beside the rest is left out.
fn combination(
    basis: &DMatrix<f64>,
    scaled: &DMatrix<f64>,
    k: usize,
    kept: &[usize],
    lengths: &[f64],
) -> Vec<(usize, f64)> {
    if kept.is_empty() {
        return Vec::new();
    }
    let qr = basis.clone().qr();
    let mut right: DVector<f64> = scaled.column(k).into_owned();
    qr.q_tr_mul(&mut right);
    let count = kept.len();
    let solution = qr.r().solve_upper_triangular(&right.rows(0, count));
    let solution = solution.unwrap_or_else(|| DVector::zeros(count));
    let shares = kept.iter().zip(solution.iter()).filter(|(_, share)| share.abs() > 1e-6);
    shares.map(|(j, share)| (*j, share * lengths[k] / lengths[*j])).collect()
}

/// Largest first.
fn singular_values(matrix: &DMatrix<f64>) -> Vec<f64> {
    if matrix.is_empty() {
        return Vec::new();
    }
    let mut values = matrix.singular_values().as_slice().to_vec();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}
