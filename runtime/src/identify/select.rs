//! Richer terms, one group after the other, as long as they help on data that is left out.

use nalgebra::{DMatrix, DVector};

use super::{FTest, Failure, Fit, Folds, Model, Observation, f_test};

/// A group that earned its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Which candidate, by index.
    pub candidate: usize,
    /// Root mean square of what is left on left-out data, in units of the uncertainty, before it.
    pub before: f64,
    /// … and with it.
    pub after: f64,
    /// Whether what it explains could be chance.
    pub test: FTest,
}

/// By how much, as a share, the squared error on left-out data must fall for a group to be taken in.
const GAIN: f64 = 0.01;

/// How likely it may be that the best of all candidates is taken in by chance.
const CHANCE: f64 = 0.05;

/// Rows that are gathered before they are summed.
const BLOCK: usize = 256;

/// Chooses forward: always the candidate that helps most on left-out data, until none helps by one percent, or what it
/// explains of all data could be chance.
///
/// A candidate is a group of unknowns that come together, by index: sine and cosine of a joint, say. `model` has those of
/// all candidates behind those of `fit`, whose model it extends. Everything is linear about that fit, so one pass over the data decides all of it.
pub fn select(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    candidates: &[Vec<usize>],
    folds: usize,
    most: usize,
) -> Result<Vec<Selection>, Failure> {
    let mut x = fit.x.clone();
    x.resize(model.unknowns.len(), 0.0);
    let folds = Folds::new(data.len(), folds);
    let sums = Sums::new(model, data, &x, &fit.weights, &folds)?;
    let mut chosen = fit.identifiable.kept.clone();
    let mut selections: Vec<Selection> = Vec::new();
    let mut before = sums.left_out(&chosen).unwrap_or(f64::INFINITY);
    while selections.len() < most {
        let new = |i: &usize| selections.iter().all(|selection| selection.candidate != *i);
        let with = |i: usize| [&chosen[..], &candidates[i]].concat();
        let all = (0..candidates.len()).filter(new);
        let scored = all.filter_map(|i| Some((i, sums.left_out(&with(i))?)));
        let Some((best, after)) = scored.min_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if after > before * (1.0 - GAIN) {
            break;
        }
        let (all, terms) = (with(best), candidates[best].len());
        let freedom = sums.rows.saturating_sub(all.len());
        let test = f_test(sums.cost(&chosen), sums.cost(&all), terms, freedom);
        // The best of many looks good by chance: each of them has had its try (Bonferroni).
        if test.p * candidates.len() as f64 > CHANCE {
            break;
        }
        let rms = |square: f64| (square / sums.rows.max(1) as f64).sqrt();
        selections.push(Selection { candidate: best, before: rms(before), after: rms(after), test });
        (chosen, before) = (all, after);
    }
    Ok(selections)
}

/// `[J | r]ᵀ [J | r]` of every fold, columns of `J` of unit length over all folds.
struct Sums {
    folds: Vec<DMatrix<f64>>,
    all: DMatrix<f64>,
    rows: usize,
}

impl Sums {
    fn new(
        model: &Model,
        data: &[Observation],
        x: &[f64],
        weights: &[f64],
        folds: &Folds,
    ) -> Result<Self, Failure> {
        let p = model.unknowns.len();
        let mut sums = vec![DMatrix::zeros(p + 1, p + 1); folds.count];
        let mut room = model.room();
        let mut rows = 0;
        for (fold, sum) in sums.iter_mut().enumerate() {
            let mut block = DMatrix::zeros(BLOCK, p + 1);
            let mut filled = 0;
            for (i, observation) in data.iter().enumerate().filter(|(i, _)| folds.fold[*i] == fold) {
                let weight = weights[i].sqrt();
                let take = |residual: f64, derivative: &mut dyn FnMut(usize) -> f64| {
                    for k in 0..p {
                        block[(filled, k)] = weight * derivative(k);
                    }
                    block[(filled, p)] = -weight * residual;
                    filled += 1;
                    rows += usize::from(weight > 0.0);
                    if filled == BLOCK {
                        sum.gemm(1.0, &block.transpose(), &block, 1.0);
                        filled = 0;
                    }
                };
                model.residuals(&mut room, observation, x, take)?;
            }
            let rest = block.rows(0, filled).into_owned();
            sum.gemm(1.0, &rest.transpose(), &rest, 1.0);
        }
        let all = sums.iter().fold(DMatrix::zeros(p + 1, p + 1), |all, sum| all + sum);
        let length =
            |k: usize| Some(all[(k, k)].sqrt()).filter(|length: &f64| k < p && *length > 0.0).unwrap_or(1.0);
        let lengths = DVector::from_fn(p + 1, |k, _| 1.0 / length(k));
        let scale =
            |sum: DMatrix<f64>| DMatrix::from_fn(p + 1, p + 1, |i, j| sum[(i, j)] * lengths[i] * lengths[j]);
        Ok(Self { all: scale(all), folds: sums.into_iter().map(scale).collect(), rows })
    }

    /// The squares that are left on every fold under the fit of the others, added up.
    fn left_out(&self, columns: &[usize]) -> Option<f64> {
        let last = self.all.ncols() - 1;
        let pick = |sum: &DMatrix<f64>| {
            let n = sum.select_rows(columns).select_columns(columns);
            let g = DVector::from_iterator(columns.len(), columns.iter().map(|k| sum[(*k, last)]));
            (n, g)
        };
        let (n, g) = pick(&self.all);
        let squares = self.folds.iter().map(|fold| {
            let (own_n, own_g) = pick(fold);
            let x = solve(&n - &own_n, &(&g - &own_g))?;
            Some((fold[(last, last)] - 2.0 * own_g.dot(&x) + x.dot(&(own_n * &x))).max(0.0))
        });
        squares.sum()
    }

    /// The squares that are left of all data.
    fn cost(&self, columns: &[usize]) -> f64 {
        let last = self.all.ncols() - 1;
        let n = self.all.select_rows(columns).select_columns(columns);
        let g = DVector::from_iterator(columns.len(), columns.iter().map(|k| self.all[(*k, last)]));
        let explained = solve(n, &g).map_or(0.0, |x| g.dot(&x));
        (self.all[(last, last)] - explained).max(0.0)
    }
}

/// Normal equations; columns that depend on others make no difference.
fn solve(mut n: DMatrix<f64>, g: &DVector<f64>) -> Option<DVector<f64>> {
    for k in 0..n.ncols() {
        n[(k, k)] += 1e-10;
    }
    Some(n.cholesky()?.solve(g))
}
