//! Forward selection of terms by cross-validation.
//!
//! The linear model is cross-validated column by column, by the residuals of each fold under the
//! fit of all others. Gram-Schmidt orthogonalization runs once for each fold. With the inner
//! products `⟨·,·⟩` over the rows outside the fold, adding column k changes every other column j by
//!
//! ```text
//! z_j = (⟨k, j⟩ − Σ_i z_ik z_ij) / d,   d² = ⟨k, k⟩ − Σ_i z_ik²,      j ← j − k z_j/d   on the rows of the fold
//! ```
//!
//! so that, on the fold, the right side becomes the residual under the fit of the others. For a
//! group g that is not yet included, the same products give `N = ⟨g, g⟩` and `b = ⟨g, r⟩`, both
//! reduced by the included columns, and its residual is `r − g N⁻¹ b`. Rows of known distances and
//! of the prior belong to no fold.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::{FTest, Fit, Folds, Model, Observation, REJECTED, Result, statistics::Scores};

/// A term: an unknown of the model times a factor that changes from row to row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModelTerm {
    /// Index of the unknown.
    pub unknown: usize,
    /// Index of the factor; none where it is 1.
    pub factor: Option<usize>,
}

/// Terms that [`select`](super::select()) can add.
pub struct CandidateTerms<'a> {
    /// Terms that the model already has, beside the unknowns kept by the fit.
    pub taken: &'a [ModelTerm],
    /// Groups of terms that are added together, such as the sine and cosine of a joint.
    pub groups: &'a [Vec<ModelTerm>],
    /// Computes the factors of an observation, in order.
    pub factors: &'a dyn Fn(&Observation) -> Vec<f64>,
    /// Significance level of the selection of the best group.
    pub chance: f64,
}

/// A selected group of terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Index of the group.
    pub group: usize,
    /// Root mean square of the cross-validation residuals before its selection, in units of the
    /// uncertainty.
    pub before: f64,
    /// Root mean square of the cross-validation residuals with it.
    pub after: f64,
    /// Significance test of the group.
    pub test: FTest,
}

/// Smallest relative decrease of the squared cross-validation error for a selection.
const GAIN: f64 = 0.005;

/// Selects groups of terms forward: in each round the group with the smallest cross-validation
/// error, until none reduces it by half a percent, or the group is not significant.
///
/// The significance level is `chance` divided by the number of groups (Bonferroni), with
/// configurations instead of rows as independent units. `model` has the unknowns of the fit first,
/// then those of the terms. Everything is linearized about the fit. Each round calls `proceed`,
/// which returns false to stop.
pub fn select(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    folds: &Folds,
    candidates: &CandidateTerms,
    proceed: &mut dyn FnMut() -> bool,
) -> Result<Vec<Selection>> {
    let mut left_out = LeftOut::new(model, data, fit, folds, candidates)?;
    let mut selections: Vec<Selection> = Vec::new();
    while proceed() {
        let before = left_out.squares();
        let Some((group, after)) = left_out.best() else { break };
        if after > before * (1.0 - GAIN) {
            break;
        }
        let test = left_out.scores(group).test(left_out.freedom());
        if test.p * candidates.groups.len() as f64 > candidates.chance {
            break;
        }
        let rms = |squares: f64| (squares / left_out.numbers().max(1) as f64).sqrt();
        selections.push(Selection { group, before: rms(before), after: rms(after), test });
        left_out.take(group);
    }
    Ok(selections)
}

/// Largest number of stored values: 48 MB.
const NUMBERS: usize = 6_000_000;

/// Smallest squared residual of a column of unit length that is independent of the included
/// columns.
const NEW: f64 = 1e-9;

/// Columns and their residuals, fold by fold.
struct LeftOut {
    /// Columns of unit length, the right side last; rows are sorted by fold, and those of no fold
    /// are last.
    columns: DMatrix<f64>,
    /// Columns reduced, on each fold, by the fit of the other folds.
    rest: DMatrix<f64>,
    folds: Vec<Fold>,
    /// Orthonormal basis of the included columns, over all rows.
    basis: Vec<DVector<f64>>,
    groups: Vec<Range<usize>>,
    free: Vec<bool>,
    /// Configuration of each row of the columns, numbered from 0 without gaps.
    configuration: Vec<usize>,
    configurations: usize,
    /// Norm of the right side, by which it was divided.
    size: f64,
}

struct Fold {
    rows: Range<usize>,
    /// `z` of each included column.
    z: Vec<DVector<f64>>,
    /// `N` and `b` of each group.
    normal: Vec<(DMatrix<f64>, DVector<f64>)>,
}

impl LeftOut {
    fn new(
        model: &Model,
        data: &[Observation],
        fit: &Fit,
        folds: &Folds,
        candidates: &CandidateTerms,
    ) -> Result<Self> {
        let plain = |unknown: &usize| ModelTerm { unknown: *unknown, factor: None };
        let mut terms: Vec<ModelTerm> = fit.identifiable.kept.iter().map(plain).collect();
        terms.extend(candidates.taken);
        let taken = terms.len();
        let mut groups = Vec::new();
        for group in candidates.groups {
            groups.push(terms.len()..terms.len() + group.len());
            terms.extend(group);
        }
        let rows = chosen_rows(data, fit, folds, NUMBERS / (terms.len() + 1));
        let numbers: usize = rows.iter().flatten().map(|i| data[*i].count()).sum();
        let always = model.known_distances.len() + fit.prior.nrows();
        let mut columns = DMatrix::zeros(numbers + always, terms.len() + 1);
        let (mut at, mut ranges, mut configuration) = (0, Vec::new(), Vec::new());
        let mut x = fit.x.clone();
        x.resize(model.unknowns.len(), 0.0);
        let mut at_fit = model.at(&x);
        for fold in &rows {
            let first = at;
            for &i in fold {
                let weight = fit.weights[i].sqrt();
                let factors = (candidates.factors)(&data[i]);
                // f(here) ∂g(here) − f(there) ∂g(there), for a number that refers to another row.
                let there = data[i].from().map(candidates.factors);
                at_fit.linear_by_row(&data[i], |residual, derivatives, of_there| {
                    for (j, ModelTerm { unknown, factor }) in terms.iter().enumerate() {
                        let here = factor.map_or(1.0, |factor| factors[factor]);
                        let mut derivative = derivatives[*unknown] * here;
                        if let (Some(factor), Some(there), false) = (factor, &there, of_there.is_empty()) {
                            derivative += of_there[*unknown] * (there[*factor] - here);
                        }
                        columns[(at, j)] = weight * derivative;
                    }
                    columns[(at, terms.len())] = -weight * residual;
                    configuration.push(data[i].configuration as usize);
                    at += 1;
                })?;
            }
            ranges.push(first..at);
        }
        model.distance_rows(&x, |residual, derivatives| {
            for (j, ModelTerm { unknown, factor }) in terms.iter().enumerate() {
                columns[(at, j)] = if factor.is_none() { derivatives[*unknown] } else { 0.0 };
            }
            columns[(at, terms.len())] = -residual;
            at += 1;
        });
        let (prior, (_, kept)) = (&fit.prior, fit.of_kept(model));
        columns.view_mut((at, 0), prior.shape()).copy_from(prior);
        let right = -(prior * DVector::from_vec(kept));
        columns.view_mut((at, terms.len()), (prior.nrows(), 1)).copy_from(&right);
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
        let (mut rest, free) = (columns.clone(), vec![true; groups.len()]);
        rest.rows_range_mut(configuration.len()..).fill(0.0);
        Self { columns, rest, folds, basis: Vec::new(), groups, free, configuration, configurations, size }
    }

    /// Includes the columns of a group.
    fn take(&mut self, group: usize) {
        self.free[group] = false;
        self.groups[group].clone().for_each(|column| self.take_column(column));
    }

    fn take_column(&mut self, k: usize) {
        let width = self.columns.ncols();
        let products: Vec<DVector<f64>> =
            self.folds.iter().map(|fold| self.products(&fold.rows, k)).collect();
        let always = self.products(&(self.numbers()..self.columns.nrows()), k);
        let all = products.iter().fold(always, |all, own| all + own);
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
        let new = self.beside_included(k);
        let length = new.norm();
        if length * length > NEW {
            self.basis.push(new / length);
        }
    }

    /// Returns column k projected onto the complement of the included columns.
    fn beside_included(&self, k: usize) -> DVector<f64> {
        let mut column = self.columns.column(k).into_owned();
        // Two passes suffice for orthogonality.
        for _ in 0..2 {
            self.basis.iter().for_each(|one| column.axpy(-one.dot(&column), one, 1.0));
        }
        column
    }

    /// Returns the inner products of column k with all columns, over a range of rows.
    fn products(&self, rows: &Range<usize>, k: usize) -> DVector<f64> {
        let of_k = self.columns.view((rows.start, k), (rows.len(), 1));
        let with = |j: usize| self.columns.view((rows.start, j), (rows.len(), 1)).dot(&of_k);
        DVector::from_fn(self.columns.ncols(), |j, _| with(j))
    }

    /// Returns the sum of squared residuals of all folds under the fits of the others.
    fn squares(&self) -> f64 {
        self.rest.column(self.rest.ncols() - 1).norm_squared() * self.size * self.size
    }

    /// Returns the group with the smallest sum of squares if it is included, and that sum.
    fn best(&self) -> Option<(usize, f64)> {
        let free = (0..self.groups.len()).filter(|group| self.free[*group]);
        let left = free
            .filter_map(|group| Some((group, self.rest_with(group)?.norm_squared() * self.size * self.size)));
        left.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Returns the residuals of all folds under the fits of the others with a group included; none
    /// if the group depends on the included columns in some fold.
    fn rest_with(&self, group: usize) -> Option<DVector<f64>> {
        let columns = self.groups[group].clone();
        let last = self.rest.ncols() - 1;
        let mut rest = self.rest.column(last).into_owned();
        for fold in &self.folds {
            let (n, b) = &fold.normal[group];
            if n.diagonal().min() < NEW {
                return None;
            }
            let x = n.clone().cholesky()?.solve(b);
            for (j, x) in columns.clone().zip(x.iter()) {
                fold.rows.clone().for_each(|i| rest[i] -= self.rest[(i, j)] * x);
            }
        }
        Some(rest)
    }

    /// Returns the scores `Σ g r` of the magnitudes of a group, one row for each configuration:
    /// with the residuals under the fit of the included columns, and with the residuals of each
    /// fold under the fits of the others with the group. Columns are projected onto the complement
    /// of the included ones.
    fn scores(&self, group: usize) -> Scores {
        let before = self.beside_included(self.columns.ncols() - 1);
        let after = self.rest_with(group).unwrap_or_else(|| before.clone());
        let columns = &self.groups[group];
        let zero = DMatrix::zeros(self.configurations, columns.len());
        let mut scores = Scores { before: zero.clone(), after: zero };
        for (place, k) in columns.clone().enumerate() {
            for (i, (value, configuration)) in
                self.beside_included(k).iter().zip(&self.configuration).enumerate()
            {
                let at = (*configuration, place);
                scores.before[at] += value * before[i];
                scores.after[at] += value * after[i];
            }
        }
        scores
    }

    /// Returns the number of configurations less the degrees of freedom used by the included
    /// columns.
    fn freedom(&self) -> f64 {
        let each = self.numbers() as f64 / self.configurations.max(1) as f64;
        let used = self.basis.iter().map(|one| one.rows(0, self.numbers()).norm_squared()).sum::<f64>();
        self.configurations as f64 - used / each.max(1.0)
    }

    /// Returns the number of measured numbers.
    fn numbers(&self) -> usize {
        self.configuration.len()
    }
}

/// Returns the observations of each fold without rejected ones; if there are too many, a regular
/// subset of the configurations with about `most` numbers.
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
