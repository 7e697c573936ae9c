//! The columns of a linear model, fitted to all folds but one, and what that leaves on the fold that is left out.
//!
//! Gram and Schmidt, once for every fold: with the inner products `⟨·,·⟩` of the rows that are not in the fold, a column k
//! that is taken in changes every other column j by
//!
//! ```text
//! z_j = (⟨k, j⟩ − Σ_i z_ik z_ij) / d,   d² = ⟨k, k⟩ − Σ_i z_ik²,      j ← j − k z_j/d   on the rows of the fold
//! ```
//!
//! so that on the fold the right side becomes what the fit of the others leaves there. For a group g that is not yet in, the
//! same products give `N = ⟨g, g⟩` and `b = ⟨g, r⟩` less what is explained, and `r − g N⁻¹ b` is what it would leave.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::fit::REJECTED;
use super::{Factored, Failure, Fit, Folds, Model, Observation, Offer};

/// The most numbers that are held: 48 MB.
const NUMBERS: usize = 6_000_000;

/// A column of unit length of which less than this is new, squared, counts as one of those before it.
const NEW: f64 = 1e-9;

/// Columns, fold by fold.
pub(super) struct LeftOut {
    /// Columns of unit length, the right side last; rows in the order of the folds.
    columns: DMatrix<f64>,
    /// The same, on every fold less what the fit of the others explains.
    rest: DMatrix<f64>,
    folds: Vec<Fold>,
    /// An orthonormal basis of the columns that are in, over all rows.
    basis: Vec<DVector<f64>>,
    groups: Vec<Range<usize>>,
    free: Vec<bool>,
    /// The configuration of every row of the columns, from 0 without gaps.
    configuration: Vec<usize>,
    configurations: usize,
    /// What a unit of the right side is.
    size: f64,
}

struct Fold {
    rows: Range<usize>,
    /// `z` of every column that is in.
    z: Vec<DVector<f64>>,
    /// `N` and `b` of every group.
    normal: Vec<(DMatrix<f64>, DVector<f64>)>,
}

impl LeftOut {
    pub(super) fn new(
        model: &Model,
        data: &[Observation],
        fit: &Fit,
        folds: &Folds,
        offer: &Offer,
    ) -> Result<Self, Failure> {
        let plain = |unknown: &usize| Factored { unknown: *unknown, factor: None };
        let mut terms: Vec<Factored> = fit.identifiable.kept.iter().map(plain).collect();
        terms.extend(offer.taken);
        let taken = terms.len();
        let mut groups = Vec::new();
        for group in offer.groups {
            groups.push(terms.len()..terms.len() + group.len());
            terms.extend(group);
        }
        let rows = chosen_rows(data, fit, folds, NUMBERS / (terms.len() + 1));
        let numbers = rows.iter().flatten().map(|i| data[*i].count()).sum();
        let mut columns = DMatrix::zeros(numbers, terms.len() + 1);
        let (mut at, mut ranges, mut configuration) = (0, Vec::new(), Vec::new());
        let mut x = fit.x.clone();
        x.resize(model.unknowns.len(), 0.0);
        let mut room = model.room();
        for fold in &rows {
            let first = at;
            for &i in fold {
                let weight = fit.weights[i].sqrt();
                let factors = (offer.factors)(&data[i]);
                model.linear(&mut room, &data[i], &x, |residual, derivatives| {
                    for (j, term) in terms.iter().enumerate() {
                        let factor = term.factor.map_or(weight, |factor| weight * factors[factor]);
                        columns[(at, j)] = derivatives[term.unknown] * factor;
                    }
                    columns[(at, terms.len())] = -weight * residual;
                    configuration.push(data[i].configuration as usize);
                    at += 1;
                })?;
            }
            ranges.push(first..at);
        }
        let mut known = configuration.clone();
        known.sort_unstable();
        known.dedup();
        configuration.iter_mut().for_each(|one| *one = known.binary_search(one).unwrap_or_default());
        let mut left_out = Self::with_columns(columns, ranges, groups, (configuration, known.len()));
        (0..taken).for_each(|column| left_out.take_column(column));
        Ok(left_out)
    }

    fn with_columns(
        mut columns: DMatrix<f64>,
        ranges: Vec<Range<usize>>,
        groups: Vec<Range<usize>>,
        (configuration, configurations): (Vec<usize>, usize),
    ) -> Self {
        let last = columns.ncols() - 1;
        let size = columns.column(last).norm();
        for mut column in columns.column_iter_mut() {
            let length = column.norm();
            if length > 0.0 {
                column.scale_mut(1.0 / length);
            }
        }
        let products = |rows: &Range<usize>, group: &Range<usize>| {
            let g = columns.view((rows.start, group.start), (rows.len(), group.len()));
            let r = columns.view((rows.start, last), (rows.len(), 1));
            (g.tr_mul(&g), DVector::from_column_slice(g.tr_mul(&r).as_slice()))
        };
        let all: Vec<_> = groups.iter().map(|group| products(&(0..columns.nrows()), group)).collect();
        let fold = |rows: Range<usize>| {
            let normal = groups.iter().zip(&all).map(|(group, (n, b))| {
                let (own_n, own_b) = products(&rows, group);
                (n - own_n, b - own_b)
            });
            Fold { normal: normal.collect(), z: Vec::new(), rows }
        };
        let folds = ranges.into_iter().map(fold).collect();
        let (rest, free) = (columns.clone(), vec![true; groups.len()]);
        Self { columns, rest, folds, basis: Vec::new(), groups, free, configuration, configurations, size }
    }

    /// Takes a group in.
    pub(super) fn take(&mut self, group: usize) {
        self.free[group] = false;
        self.groups[group].clone().for_each(|column| self.take_column(column));
    }

    fn take_column(&mut self, k: usize) {
        let width = self.columns.ncols();
        let products: Vec<DVector<f64>> =
            self.folds.iter().map(|fold| self.products(&fold.rows, k)).collect();
        let all = products.iter().fold(DVector::zeros(width), |all, own| all + own);
        for (fold, own) in self.folds.iter_mut().zip(products) {
            let mut z = &all - own;
            fold.z.iter().for_each(|before| z.axpy(-before[k], before, 1.0));
            let square = z[k];
            if square < NEW {
                continue;
            }
            z.scale_mut(square.sqrt().recip());
            for (group, (n, b)) in self.groups.iter().zip(&mut fold.normal) {
                let own = z.rows(group.start, group.len());
                n.ger(-1.0, &own, &own, 1.0);
                b.axpy(-z[width - 1], &own, 1.0);
            }
            let (start, count) = (fold.rows.start, fold.rows.len());
            let column = self.rest.view((start, k), (count, 1)).into_owned();
            for (j, share) in z.iter().enumerate() {
                let mut other = self.rest.view_mut((start, j), (count, 1));
                other.zip_apply(&column, |value, of_k| *value -= of_k * share / square.sqrt());
            }
            fold.z.push(z);
        }
        let mut new = self.columns.column(k).into_owned();
        // Twice is enough.
        for _ in 0..2 {
            self.basis.iter().for_each(|one| new.axpy(-one.dot(&new), one, 1.0));
        }
        let length = new.norm();
        if length * length > NEW {
            self.basis.push(new / length);
        }
    }

    /// Of column k with every column, on some rows.
    fn products(&self, rows: &Range<usize>, k: usize) -> DVector<f64> {
        let of_k = self.columns.view((rows.start, k), (rows.len(), 1));
        let with = |j: usize| self.columns.view((rows.start, j), (rows.len(), 1)).dot(&of_k);
        DVector::from_fn(self.columns.ncols(), |j, _| with(j))
    }

    /// The squares that are left on every fold under the fit of the others, added up.
    pub(super) fn squares(&self) -> f64 {
        self.rest.column(self.rest.ncols() - 1).norm_squared() * self.size * self.size
    }

    /// The group that would leave least, and how much.
    pub(super) fn best(&self) -> Option<(usize, f64)> {
        let free = (0..self.groups.len()).filter(|group| self.free[*group]);
        let left = free.filter_map(|group| Some((group, self.squares_with(group)? * self.size * self.size)));
        left.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// None if the group says nothing new of some fold.
    fn squares_with(&self, group: usize) -> Option<f64> {
        let columns = &self.groups[group];
        let last = self.rest.ncols() - 1;
        let squares = self.folds.iter().map(|fold| {
            let (n, b) = &fold.normal[group];
            if n.diagonal().min() < NEW {
                return None;
            }
            let x = n.clone().cholesky()?.solve(b);
            let rest = |i: usize| {
                let explained: f64 = columns.clone().zip(x.iter()).map(|(j, x)| self.rest[(i, j)] * x).sum();
                self.rest[(i, last)] - explained
            };
            Some(fold.rows.clone().map(|i| rest(i).powi(2)).sum::<f64>())
        });
        squares.sum()
    }

    /// What every configuration says for the magnitudes of a group, a row each: `Σ g r` over its rows, of columns and right
    /// side less what the columns that are in explain of all data.
    pub(super) fn scores(&self, group: usize) -> DMatrix<f64> {
        let free_of = |k: usize| {
            let mut column = self.columns.column(k).into_owned();
            for _ in 0..2 {
                self.basis.iter().for_each(|one| column.axpy(-one.dot(&column), one, 1.0));
            }
            column
        };
        let residual = free_of(self.columns.ncols() - 1);
        let columns = &self.groups[group];
        let mut scores = DMatrix::zeros(self.configurations, columns.len());
        for (place, k) in columns.clone().enumerate() {
            for (i, value) in free_of(k).iter().enumerate() {
                scores[(self.configuration[i], place)] += value * residual[i];
            }
        }
        scores
    }

    /// How many configurations are left when the columns that are in have used theirs.
    pub(super) fn freedom(&self) -> f64 {
        let each = self.columns.nrows() as f64 / self.configurations.max(1) as f64;
        self.configurations as f64 - self.basis.len() as f64 / each.max(1.0)
    }

    /// How many numbers were measured.
    pub(super) fn numbers(&self) -> usize {
        self.columns.nrows()
    }
}

/// The observations of every fold, rejected ones left out; of many an even share of the configurations, so that there are
/// about `most` numbers.
fn chosen_rows(data: &[Observation], fit: &Fit, folds: &Folds, most: usize) -> Vec<Vec<usize>> {
    let numbers: usize = data.iter().map(Observation::count).sum();
    let step = numbers.div_ceil(most.max(1)).max(1);
    let mut rows = vec![Vec::new(); folds.count];
    for i in (0..data.len())
        .filter(|i| fit.weights[*i] >= REJECTED && (data[*i].configuration as usize).is_multiple_of(step))
    {
        rows[folds.fold[i] as usize].push(i);
    }
    rows
}
