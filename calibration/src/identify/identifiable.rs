//! Identifiability: unknowns that the data determine, and those that act as combinations of them.
//!
//! Two criteria apply. The rank decides which combinations this kind of data can determine at all.
//! The prior decides which of them are worth fitting: with columns `J_k σ_k / σ`, where σ_k is the
//! expected size of unknown k and σ the uncertainty of the instrument, a column whose component
//! orthogonal to all others is shorter than 2 reduces the uncertainty of its unknown to no better
//! than half of its expected size.

use nalgebra::{DMatrix, DVector};

use super::{Failure, Model, Observation, Result, Unknown, linearize};
use abbe_analysis::decompose::singular_values;

/// Relative threshold of the singular values of the matrix with columns of unit length; smaller
/// ones count as zero.
pub const THRESHOLD: f64 = 1e-8;

/// Relative threshold of the residual of a column; a column with a smaller one is a combination of
/// the others.
const INDISTINGUISHABLE: f64 = 1e-6;

/// Largest standard deviation of a fitted unknown, as a share of its expected size.
///
/// At this limit, the data carry three times the information of the prior.
const WEAK: f64 = 0.5;

/// Identifiable combinations of unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiable {
    /// Number of identifiable combinations of the unknowns.
    pub rank: usize,
    /// Number of identifiable combinations of the errors of base and frames, if nothing of the tool
    /// is unknown.
    pub errors: usize,
    /// Indices of the unknowns that represent these combinations, ascending; of a fit with priors,
    /// all that are fitted. All others are fixed at zero.
    pub kept: Vec<usize>,
    /// Unknowns fixed at zero, each with its equivalent:
    /// `column = Σ factor × column of a kept unknown`.
    pub redundant: Vec<(usize, Vec<(usize, f64)>)>,
    /// Unknowns fixed at zero that have no equivalent but are weakly determined by these data, one
    /// for each combination.
    pub weak: Vec<Weak>,
    /// Singular values of the matrix with columns of unit length, largest first.
    pub singular_values: Vec<f64>,
    /// Condition number of the kept columns, each of unit length: the ratio of the largest and the
    /// smallest singular value; 0 without any.
    pub condition: f64,
    /// Ratio of the smallest nonzero singular value to the largest one that counts as zero;
    /// infinite if none does.
    pub gap: f64,
}

impl Identifiable {
    /// Returns the combination of kept unknowns that an unknown is equivalent to, as a factor for
    /// each kept unknown.
    pub fn kept_coordinates(&self, unknown: usize) -> Vec<f64> {
        let redundant = self.redundant.iter().find(|(redundant, _)| *redundant == unknown);
        let factor = |kept: &usize| match redundant {
            Some((_, acts_as)) => acts_as.iter().find(|(k, _)| k == kept).map_or(0.0, |(_, factor)| *factor),
            None => f64::from(u8::from(*kept == unknown)),
        };
        self.kept.iter().map(factor).collect()
    }
}

/// An unknown that the data determine no better than to half of its expected size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weak {
    /// Index of the unknown.
    pub unknown: usize,
    /// Standard deviation from the data alone, with all kept unknowns free.
    pub deviation: f64,
    /// Expected size, as a standard deviation.
    pub expected: f64,
}

/// Finds the unknowns that this kind of data determines, linearized at `x`; see
/// [`Options::at`](super::Options::at).
///
/// Among indistinguishable unknowns, the preference is: base, fixtures and tool; magnitudes that
/// precede the errors of frames in [`Model::unknowns`]; errors of frames, from the tool towards the
/// base, and the error of the [reference length](super::ReferenceLength); other magnitudes. An
/// error is attributed to the machine only if neither the placement of the machine nor the mounting
/// on its tool explains it.
pub fn identifiable(model: &Model, data: &[Observation], x: &[f64]) -> Result<Identifiable> {
    knowable(model, data, x, &[])
}

/// Finds the unknowns that these data determine better than their expected sizes.
///
/// `expected` has the size of each unknown, as from [`Model::priors`]. Plans use this criterion.
pub fn knowable(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    expected: &[Option<f64>],
) -> Result<Identifiable> {
    Ok(Columns::of_rows(model, data, x)?.with_expected(expected).knowable(model))
}

/// Returns the unknowns in order of preference.
pub(super) fn by_preference(model: &Model) -> Vec<usize> {
    use super::Unknown::{Base, Error, Fixture, Intrinsic, Magnitude, Target, Tool, Zero};
    let frames = model.manipulator.description().frames.len();
    let mut order: Vec<usize> = (0..model.unknowns.len()).collect();
    let last = model.unknowns.iter().rposition(|unknown| matches!(unknown, Error(..)));
    let reference = model.reference_length.map(|reference| reference.error);
    let named = |k: usize| last.is_some_and(|last| k < last);
    order.sort_by_key(|k| match model.unknowns[*k] {
        Base(station, component) => (0, 6 * station + component.index()),
        Fixture(fixture, coordinate) => (1, 3 * fixture + coordinate),
        Zero(reading) => (1, 3 * model.fixtures.len() + reading),
        Target(target, axis) => (2, 3 * target + axis),
        Tool(placement, component) => (2, 6 * placement + component.index()),
        Intrinsic(parameter) => (2, 6 * model.mountings.len() + parameter),
        Magnitude(source) if named(*k) => (3, source),
        // Where the size of the machine is free, all lengths are relative to this one.
        error @ Error(..) if reference == Some(error) => (4 + frames, 6),
        Error(frame, component) => (4 + frames - frame, component.index()),
        Magnitude(source) => (frames + 5, source),
    });
    order
}

/// Derivatives, as columns of unit length.
pub(super) struct Columns {
    unit: DMatrix<f64>,
    pub(super) lengths: Vec<f64>,
    /// Length of each column times the expected size of its unknown; infinite without an
    /// expectation.
    worth: Vec<f64>,
    expected: Vec<Option<f64>>,
    singular_values: Vec<f64>,
    /// Number of singular values above the threshold.
    exact: usize,
}

impl Columns {
    /// Computes the derivatives of rows at `x`.
    pub(super) fn of_rows(model: &Model, data: &[Observation], x: &[f64]) -> Result<Self> {
        let p = model.unknowns.len();
        let all = linearize(model, data, x, None)?.finish().columns(0, p).into_owned();
        Self::of_matrix(all).ok_or_else(|| Failure::not_finite(data))
    }

    /// Returns some columns of these rows and of other ones together; none if they are not finite.
    pub(super) fn joined(&self, other: &Self, columns: &[usize]) -> Option<Self> {
        let part = |of: &Self, i: usize, k: usize| of.unit[(i, k)] * of.lengths[k];
        let rows = self.unit.nrows();
        let entry = |i: usize, j: usize| match i.checked_sub(rows) {
            None => part(self, i, columns[j]),
            Some(i) => part(other, i, columns[j]),
        };
        let all = DMatrix::from_fn(rows + other.unit.nrows(), columns.len(), entry);
        Self::of_matrix(all.qr().unpack_r())
    }

    fn of_matrix(mut unit: DMatrix<f64>) -> Option<Self> {
        let p = unit.ncols();
        let lengths: Vec<f64> = unit.column_iter().map(|column| column.norm()).collect();
        let largest = lengths.iter().copied().fold(0.0, f64::max);
        // Columns of rounding errors count as zero.
        for (mut column, length) in unit.column_iter_mut().zip(&lengths) {
            column.scale_mut(if *length > largest * 1e-14 { 1.0 / length } else { 0.0 });
        }
        let singular_values = singular_values(unit.clone())?;
        let threshold = singular_values.first().map_or(0.0, |first| first * THRESHOLD);
        let exact = singular_values.iter().filter(|value| **value > threshold).count();
        let (worth, expected) = (vec![f64::INFINITY; p], vec![None; p]);
        Some(Self { unit, lengths, worth, expected, singular_values, exact })
    }

    /// Sets the expected size of each unknown.
    pub(super) fn with_expected(mut self, expected: &[Option<f64>]) -> Self {
        self.expected.iter_mut().zip(expected).for_each(|(own, expected)| *own = *expected);
        let worth = self.lengths.iter().zip(&self.expected);
        self.worth = worth.map(|(length, size)| size.map_or(f64::INFINITY, |size| length * size)).collect();
        self
    }

    /// Finds the unknowns that the rows determine.
    pub(super) fn knowable(&self, model: &Model) -> Identifiable {
        let all = by_preference(model);
        let is_placement = |k: &usize| model.unknowns[*k].is_placement();
        let (first, then): (Vec<usize>, Vec<usize>) = all.iter().copied().partition(is_placement);
        let is_error = |k: &usize| matches!(model.unknowns[*k], Unknown::Base(..) | Unknown::Error(..));
        let errors: Vec<usize> = all.into_iter().filter(is_error).collect();
        let kept = self.kept(&[&first, &then]);
        let errors = self.kept(&[&errors]).len();
        self.identifiable(kept, errors)
    }

    /// Returns the sorted columns that represent all others, from groups in order of falling
    /// preference.
    ///
    /// Gram-Schmidt orthogonalization runs in order of preference and postpones columns with a
    /// small residual to a later pass. Then weakly determined columns are removed, the weakest
    /// first, because several nearly parallel columns can each have passed.
    pub(super) fn kept(&self, groups: &[&[usize]]) -> Vec<usize> {
        let mut rest = self.unit.clone();
        let mut kept: Vec<usize> = Vec::new();
        for group in groups {
            let mut pass = 0.1;
            while kept.len() < self.exact && pass > 1e-9 {
                for &k in *group {
                    let new = rest.column(k).norm();
                    let is_determined = new * self.worth[k] * WEAK > 1.0;
                    if kept.len() < self.exact && !kept.contains(&k) && new > pass && is_determined {
                        take_out(&mut rest, k);
                        kept.push(k);
                    }
                }
                pass *= 0.1;
            }
        }
        let first = groups.first().copied().unwrap_or_default();
        while let Some(worst) = self.worst(&kept, first) {
            kept.remove(worst);
        }
        kept.sort_unstable();
        kept
    }

    /// Returns the position of the most weakly determined kept column, if it is below the limit;
    /// columns of the first group only if no other is.
    fn worst(&self, kept: &[usize], first: &[usize]) -> Option<usize> {
        if kept.iter().all(|k| self.worth[*k].is_infinite()) {
            return None;
        }
        let r = self.unit.select_columns(kept).qr().unpack_r();
        let inverse = r.solve_upper_triangular(&DMatrix::identity(kept.len(), kept.len()))?;
        let share = |i: usize| inverse.row(i).norm() / self.worth[kept[i]];
        let bad = (0..kept.len()).filter(|i| share(*i) > WEAK);
        bad.max_by(|a, b| {
            let key = |i: usize| (!first.contains(&kept[i]), share(i));
            let ((other_a, told_a), (other_b, told_b)) = (key(*a), key(*b));
            other_a.cmp(&other_b).then(told_a.total_cmp(&told_b))
        })
    }

    /// Returns the columns that are not kept, each with its combination of kept ones.
    pub(super) fn redundant(&self, kept: &[usize]) -> Vec<(usize, Vec<(usize, f64)>)> {
        let basis = self.unit.select_columns(kept);
        let rest = (0..self.unit.ncols()).filter(|k| !kept.contains(k));
        rest.map(|k| (k, self.combination(&basis, k, kept))).collect()
    }

    /// Returns what remains of column k beside a combination of columns, as factors of other ones.
    pub(super) fn rest_as(&self, k: usize, parts: &[(usize, f64)], others: &[usize]) -> Vec<(usize, f64)> {
        let column = |k: usize, factor: f64| self.unit.column(k) * (self.lengths[k] * factor);
        let rest = parts.iter().fold(column(k, 1.0), |rest, (j, factor)| rest - column(*j, *factor));
        if others.is_empty() {
            return Vec::new();
        }
        let solved = self.unit.select_columns(others).svd(true, true).solve(&rest, INDISTINGUISHABLE);
        let Ok(solved) = solved else { return Vec::new() };
        let factors = others.iter().zip(solved.iter()).map(|(j, share)| (*j, share / self.lengths[*j]));
        let least = INDISTINGUISHABLE * self.lengths[k];
        factors.filter(|(j, factor)| factor.abs() * self.lengths[*j] > least).collect()
    }

    /// Returns the columns that are independent of some others and of each other.
    pub(super) fn beside(&self, others: &[usize], columns: impl Iterator<Item = usize>) -> Vec<usize> {
        let mut rest = self.unit.clone();
        let mut take = |k: &usize| {
            let is_new = rest.column(*k).norm() > INDISTINGUISHABLE;
            is_new.then(|| take_out(&mut rest, *k)).is_some()
        };
        others.iter().for_each(|k| _ = take(k));
        columns.filter(|k| !others.contains(k) && take(k)).collect()
    }

    fn identifiable(&self, kept: Vec<usize>, errors: usize) -> Identifiable {
        let gap = match (kept.len().checked_sub(1), self.singular_values.get(kept.len())) {
            (Some(last), Some(next)) if *next > 0.0 => self.singular_values[last] / next,
            _ => f64::INFINITY,
        };
        let basis = self.unit.select_columns(&kept);
        let values = singular_values(basis).unwrap_or_default();
        let condition = values.first().zip(values.last()).map_or(0.0, |(first, last)| first / last);
        let mut rest = self.unit.clone();
        kept.iter().for_each(|k| take_out(&mut rest, *k));
        Identifiable {
            rank: kept.len(),
            errors,
            weak: self.weak(kept.len(), rest),
            redundant: self.redundant(&kept),
            kept,
            singular_values: self.singular_values.clone(),
            condition,
            gap,
        }
    }

    /// Returns the columns independent of the kept ones, one for each combination, the best
    /// determined first. `rest` are the columns without their parts along the kept ones.
    fn weak(&self, kept: usize, mut rest: DMatrix<f64>) -> Vec<Weak> {
        let mut weak = Vec::new();
        while kept + weak.len() < self.exact {
            let strength = |k: &usize| rest.column(*k).norm() * self.worth[*k];
            let Some(k) = inexact(&rest).max_by(|a, b| strength(a).total_cmp(&strength(b))) else { break };
            let deviation = self.expected[k].unwrap_or(f64::INFINITY) / strength(&k).max(f64::MIN_POSITIVE);
            weak.push(Weak { unknown: k, deviation, expected: self.expected[k].unwrap_or(f64::INFINITY) });
            take_out(&mut rest, k);
        }
        weak
    }

    /// Returns the factors of `column k = Σ factor × kept column`, in the units of the unknowns,
    /// without negligible ones.
    fn combination(&self, basis: &DMatrix<f64>, k: usize, kept: &[usize]) -> Vec<(usize, f64)> {
        if kept.is_empty() {
            return Vec::new();
        }
        let qr = basis.clone().qr();
        let mut right: DVector<f64> = self.unit.column(k).into_owned();
        qr.q_tr_mul(&mut right);
        let count = kept.len();
        let solution = qr.r().solve_upper_triangular(&right.rows(0, count));
        let solution = solution.unwrap_or_else(|| DVector::zeros(count));
        let shares = kept.iter().zip(solution.iter()).filter(|(_, share)| share.abs() > INDISTINGUISHABLE);
        shares.map(|(j, share)| (*j, share * self.lengths[k] / self.lengths[*j])).collect()
    }
}

/// Returns the columns that are not exact combinations of those taken out of `rest`.
fn inexact(rest: &DMatrix<f64>) -> impl Iterator<Item = usize> {
    (0..rest.ncols()).filter(|k| rest.column(*k).norm() > INDISTINGUISHABLE)
}

/// Projects all columns onto the complement of column `k`.
fn take_out(columns: &mut DMatrix<f64>, k: usize) {
    let new = columns.column(k).norm();
    if new <= 0.0 {
        return;
    }
    let direction = columns.column(k) / new;
    for mut column in columns.column_iter_mut() {
        let along = direction.dot(&column);
        column.axpy(-along, &direction, 1.0);
    }
}
