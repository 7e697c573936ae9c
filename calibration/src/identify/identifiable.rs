//! Which unknowns the data determine, and what the others are grouped with.
//!
//! Two rules. What data of a kind determine at all is a matter of rank. What these data tell is held against what was known
//! before: with columns `J_k σ_k / σ` (σ_k expected of unknown k, σ of the instrument) a column whose part beyond all others
//! is shorter than 2 is told no better than to half of what was known.

use nalgebra::{DMatrix, DVector};

use super::linearize::linearize;
use super::{Failure, Model, Observability, Observation, Unknown};
use abbe_analysis::decompose::singular_values;
use abbe_core::{Error, Quantity};

/// Singular values of the matrix with columns of unit length at or below this share of the largest count as zero.
pub const THRESHOLD: f64 = 1e-8;

/// The part of a column beyond others, as a share of its length, below which it acts as they do.
const ALIKE: f64 = 1e-6;

/// The share of what is expected of it to which an unknown must be told to be worth fitting: at this, the data say three times
/// as much of it as was known.
const TOLD: f64 = 0.5;

/// What data of this kind determine.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiable {
    /// How many combinations of the unknowns are determined.
    pub rank: usize,
    /// How many combinations of the errors of base and frames are determined, whatever is unknown of the tool.
    pub errors: usize,
    /// The unknowns that stand for them, by index, in ascending order: the others can be held at zero.
    pub kept: Vec<usize>,
    /// Those held at zero, each with what it acts as: `column = Σ factor × column of a kept one`.
    pub held: Vec<(usize, Vec<(usize, f64)>)>,
    /// Those of them that act as nothing else, but of which these data tell too little beside what is known before; one for
    /// every combination.
    pub weak: Vec<Weak>,
    /// Those held at zero that act only about as the combination that stands with them.
    pub inexact: Vec<usize>,
    /// All singular values of the matrix with columns of unit length, largest first.
    pub singular_values: Vec<f64>,
    /// Condition number and observability of the kept columns, each of unit length.
    pub observability: Observability,
    /// The smallest singular value that counts over the largest that does not; infinite if all count.
    pub gap: f64,
}

/// An unknown of which data tell too little beside what is known before: no better than to half of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weak {
    /// Which, by index.
    pub unknown: usize,
    /// The standard deviation that the data alone would give it beside all that is kept.
    pub told: f64,
    /// What is expected before.
    pub expected: f64,
}

/// Finds what data of this kind determine at `x`; see [`Options::at`](super::Options::at).
///
/// Of unknowns that act alike, those of base, fixtures and tool are kept, then magnitudes that stand before errors of frames, then
/// these, those nearest to the tool first, then other magnitudes: an error of the machine is only what cannot be where it stands or
/// what is mounted on it.
pub fn identifiable(model: &Model, data: &[Observation], x: &[f64]) -> Result<Identifiable, Failure> {
    judged(model, data, x, &[], 1.0)
}

/// The same, judged by what was known before: `expected` by unknown as [`Model::expected`] says, `noise` times the stated
/// uncertainty being what the data are worth. Plans and fits ask this one.
pub fn knowable(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    expected: &[Option<f64>],
    noise: f64,
) -> Result<Identifiable, Failure> {
    judged(model, data, x, expected, noise)
}

fn judged(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    expected: &[Option<f64>],
    noise: f64,
) -> Result<Identifiable, Failure> {
    let triangle = linearize(model, data, x, None)?;
    let p = model.unknowns.len();
    let columns = Columns::new(&triangle.finish().columns(0, p).into_owned(), expected, noise);
    let columns = columns.ok_or_else(|| Failure::Observation {
        line: data.first().map_or(0, |first| first.line),
        error: Error::NotFinite { quantity: Quantity::Jacobian, index: 0 },
    })?;
    let rows = data.iter().map(Observation::count).sum();
    let all = order(model);
    let is_placement = |k: &usize| model.unknowns[*k].is_placement();
    let (first, then): (Vec<usize>, Vec<usize>) = all.iter().copied().partition(is_placement);
    let is_error = |k: &usize| matches!(model.unknowns[*k], Unknown::Base(..) | Unknown::Error(..));
    let errors: Vec<usize> = all.into_iter().filter(is_error).collect();
    let kept = columns.kept(&[&first, &then]);
    let errors = columns.kept(&[&errors]).len();
    Ok(columns.identifiable(kept, errors, rows))
}

/// The order in which unknowns are kept.
fn order(model: &Model) -> Vec<usize> {
    use super::Unknown::{Base, Error, Fixture, Magnitude, Target, Tool, Zero};
    let frames = model.manipulator.description().frames.len();
    let mut order: Vec<usize> = (0..model.unknowns.len()).collect();
    let last = model.unknowns.iter().rposition(|unknown| matches!(unknown, Error(..)));
    let named = |k: usize| last.is_some_and(|last| k < last);
    order.sort_by_key(|k| match model.unknowns[*k] {
        Base(station, component) => (0, 6 * station + component.index()),
        Fixture(fixture, coordinate) => (1, 3 * fixture + coordinate),
        Zero(reading) => (1, 3 * model.fixtures.len() + reading),
        Target(target, axis) => (2, 3 * target + axis),
        Tool(component) => (2, component.index()),
        Magnitude(source) if named(*k) => (3, source),
        Error(frame, component) => (4 + frames - frame, component.index()),
        Magnitude(source) => (frames + 5, source),
    });
    order
}

/// The derivatives, in columns of unit length.
struct Columns {
    unit: DMatrix<f64>,
    lengths: Vec<f64>,
    /// By column: its length times what is expected of it, over the noise; infinite where nothing is.
    worth: Vec<f64>,
    expected: Vec<Option<f64>>,
    singular_values: Vec<f64>,
    /// How many singular values count.
    exact: usize,
}

impl Columns {
    /// None if a derivative is not finite beside the noise.
    fn new(triangle: &DMatrix<f64>, expected: &[Option<f64>], noise: f64) -> Option<Self> {
        let p = triangle.ncols();
        let mut unit = triangle.clone();
        let lengths: Vec<f64> = unit.column_iter().map(|column| column.norm()).collect();
        let largest = lengths.iter().copied().fold(0.0, f64::max);
        // A column of rounding errors is none.
        for (mut column, length) in unit.column_iter_mut().zip(&lengths) {
            column.scale_mut(if *length > largest * 1e-14 { 1.0 / length } else { 0.0 });
        }
        let singular_values = singular_values(unit.clone())?;
        let threshold = singular_values.first().map_or(0.0, |first| first * THRESHOLD);
        let exact = singular_values.iter().filter(|value| **value > threshold).count();
        let expected: Vec<Option<f64>> = (0..p).map(|k| expected.get(k).copied().flatten()).collect();
        let worth = lengths.iter().zip(&expected);
        let worth = worth.map(|(length, expected)| expected.map_or(f64::INFINITY, |e| length * e / noise));
        let worth = worth.collect();
        Some(Self { unit, lengths, worth, expected, singular_values, exact })
    }

    /// The columns that stand for all, in groups of falling preference, sorted.
    ///
    /// Gram and Schmidt in the order of preference; what adds little new waits for a later pass. Then what is told worse than
    /// it was known goes, the worst first, as long as there is any: of several nearly alike, each may have looked new.
    fn kept(&self, groups: &[&[usize]]) -> Vec<usize> {
        let mut rest = self.unit.clone();
        let mut kept: Vec<usize> = Vec::new();
        for group in groups {
            let mut pass = 0.1;
            while kept.len() < self.exact && pass > 1e-9 {
                for &k in *group {
                    let new = rest.column(k).norm();
                    let told = new * self.worth[k] * TOLD > 1.0;
                    if kept.len() < self.exact && !kept.contains(&k) && new > pass && told {
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

    /// The place of the kept column that is told worst, if worse than it was known; those of the first group only if there is
    /// no other.
    fn worst(&self, kept: &[usize], first: &[usize]) -> Option<usize> {
        if kept.iter().all(|k| self.worth[*k].is_infinite()) {
            return None;
        }
        let r = self.unit.select_columns(kept).qr().unpack_r();
        let inverse = r.solve_upper_triangular(&DMatrix::identity(kept.len(), kept.len()))?;
        let told = |i: usize| inverse.row(i).norm() / self.worth[kept[i]];
        let bad = (0..kept.len()).filter(|i| told(*i) > TOLD);
        bad.max_by(|a, b| {
            let key = |i: usize| (!first.contains(&kept[i]), told(i));
            let ((other_a, told_a), (other_b, told_b)) = (key(*a), key(*b));
            other_a.cmp(&other_b).then(told_a.total_cmp(&told_b))
        })
    }

    fn identifiable(self, kept: Vec<usize>, errors: usize, rows: usize) -> Identifiable {
        let basis = self.unit.select_columns(&kept);
        let all = 0..self.unit.ncols();
        let held: Vec<(usize, Vec<(usize, f64)>)> =
            all.filter(|k| !kept.contains(k)).map(|k| (k, self.combination(&basis, k, &kept))).collect();
        let gap = match (kept.len().checked_sub(1), self.singular_values.get(kept.len())) {
            (Some(last), Some(next)) if *next > 0.0 => self.singular_values[last] / next,
            _ => f64::INFINITY,
        };
        let observability =
            Observability::from_singular_values(&singular_values(basis).unwrap_or_default(), rows);
        let weak = self.weak(&kept);
        let inexact = self.inexact(&kept);
        Identifiable {
            rank: kept.len(),
            errors,
            weak,
            inexact,
            kept,
            held,
            singular_values: self.singular_values,
            observability,
            gap,
        }
    }

    /// The columns that are no combination of those kept.
    fn inexact(&self, kept: &[usize]) -> Vec<usize> {
        let mut rest = self.unit.clone();
        kept.iter().for_each(|k| take_out(&mut rest, *k));
        (0..rest.ncols()).filter(|k| rest.column(*k).norm() > ALIKE).collect()
    }

    /// What acts as nothing that is kept, one for every combination: the best told first.
    fn weak(&self, kept: &[usize]) -> Vec<Weak> {
        let mut rest = self.unit.clone();
        kept.iter().for_each(|k| take_out(&mut rest, *k));
        let mut weak = Vec::new();
        while kept.len() + weak.len() < self.exact {
            let strength = |k: &usize| rest.column(*k).norm() * self.worth[*k];
            let free = (0..rest.ncols()).filter(|k| rest.column(*k).norm() > ALIKE);
            let Some(k) = free.max_by(|a, b| strength(a).total_cmp(&strength(b))) else { break };
            let told = self.expected[k].unwrap_or(f64::INFINITY) / strength(&k).max(f64::MIN_POSITIVE);
            weak.push(Weak { unknown: k, told, expected: self.expected[k].unwrap_or(f64::INFINITY) });
            take_out(&mut rest, k);
        }
        weak
    }

    /// `column k = Σ factor × kept column`, in the units of the unknowns; what is nothing beside the rest is left out.
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
        let shares = kept.iter().zip(solution.iter()).filter(|(_, share)| share.abs() > ALIKE);
        shares.map(|(j, share)| (*j, share * self.lengths[k] / self.lengths[*j])).collect()
    }
}

/// Takes the direction of a column out of all.
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
