//! Places that are not where the model has them: an instrument that was moved, a target that
//! slipped.
//!
//! From row k on, a place may differ by δ. With residuals r_i in units of the uncertainty and their
//! derivatives D_i with respect to the place, δ explains of the squares of some rows
//!
//! ```text
//! E = gᵀN⁻¹g,    N = Σ D_iᵀD_i,    g = Σ D_iᵀr_i
//! ```
//!
//! A place that differs in all rows explains the gain G = E of all by p unknowns; one that moved
//! at row k, E of those before and E of those from k on, by 2p. Of either kind, the one with the
//! least `m ln(S − G) + p ln m` is found, for the sum S of m squares (Bayesian information
//! criterion). The F test of one that moved compares with the same difference in all rows; the
//! probability by chance is multiplied by the number of places and rows that were tried
//! (Bonferroni). Residuals of a fit are orthogonal to what was fitted: G is then too small rather
//! than too large.
//!
//! A motion also explains much of a slow drift, and of a single gross error near either end. With
//! the difference δ' before row k, row i shows the share `c_i = δᵀD_iᵀ(r_i − D_i δ')/|D_i δ|²` of the
//! motion: medians of c over the nearest rows tell.

use core::{borrow::Borrow, f64::consts::FRAC_PI_2};

use nalgebra::{DMatrix, DVector};

use super::{Model, Observation, Result, Unknown, f_test};

/// A place that is not where the model has it.
#[derive(Clone, Debug, PartialEq)]
pub struct MovedPlace {
    /// Index of the place among those that were tried.
    pub place: usize,
    /// Index of the first row that shows it; 0 if all rows do.
    pub row: usize,
    /// Changes of the unknowns of the place.
    pub change: Vec<f64>,
    /// Share of the sum of squares that it explains: of the residuals, or of what the same
    /// difference in all rows leaves of them.
    pub share: f64,
    /// Probability of such a change by chance, at any of the places and rows.
    pub p: f64,
    /// Share of the change between the nearest quarters of the rows on either side, less two of its
    /// standard deviations: 1 for a motion, at most a quarter for a drift, 0 for single rows.
    pub sudden: f64,
}

/// Smallest number of rows before and after a change.
const FEWEST: usize = 3;

/// Sums N and g of a place.
#[derive(Clone, Debug)]
struct Sums {
    normal: DMatrix<f64>,
    right: DVector<f64>,
}

impl Sums {
    fn minus(&self, other: &Self) -> Self {
        Self { normal: &self.normal - &other.normal, right: &self.right - &other.right }
    }

    /// Returns `N⁻¹ g`, and E.
    fn solved(&self) -> (DVector<f64>, f64) {
        let scale = self.normal.diagonal().map(|v| if v > 0.0 { v.sqrt().recip() } else { 0.0 });
        let scale = DMatrix::from_diagonal(&scale);
        let unit = (&scale * &self.normal * &scale).symmetric_eigen();
        let inverse = unit.eigenvalues.map(|v| if v > 1e-6 { v.recip() } else { 0.0 });
        let columns = scale * unit.eigenvectors;
        let change = &columns * inverse.component_mul(&columns.tr_mul(&self.right));
        let explained = change.dot(&self.right);
        (change, explained)
    }
}

/// Sums over all rows before one of them.
#[derive(Clone, Debug)]
struct Before {
    /// Sum of squared residuals, and their number.
    squares: f64,
    numbers: f64,
    places: Vec<Sums>,
}

/// Returns the place that explains the rows best if it moves at one of them, with its criterion.
/// `sums` are those before each row and over all.
fn best(sums: &[Before], row: usize) -> Option<(f64, MovedPlace)> {
    let end = sums.last()?;
    let m = end.numbers;
    let places = sums[row].places.iter().zip(&end.places).enumerate().map(|(place, (before, all))| {
        let [(first, gain), (then, rest)] = [before, &all.minus(before)].map(Sums::solved);
        let alike = if row == 0 { 0.0 } else { all.solved().1 };
        let (count, used) = (first.len(), first.len() * (1 + usize::from(row > 0)));
        let left = (end.squares - gain - rest).max(0.0);
        let test = f_test(end.squares - alike, left, count, (m as usize).saturating_sub(used));
        let share = (end.squares - alike - left) / (end.squares - alike).max(f64::MIN_POSITIVE);
        let criterion = m * left.ln() + used as f64 * m.ln();
        let (change, sudden) = ((then - &first).as_slice().to_vec(), 1.0);
        (criterion, MovedPlace { place, row, change, share, p: test.p, sudden })
    });
    places.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Returns [`MovedPlace::sudden`] of a place that moved.
fn suddenness(sums: &[Before], moved: &MovedPlace) -> f64 {
    let MovedPlace { place, row, .. } = *moved;
    let (of, rows) = (|i: usize| &sums[i].places[place], sums.len() - 1);
    let change = DVector::from_column_slice(&moved.change);
    let (first, _) = of(row).solved();
    // The share of the change that a row shows, and its weight.
    let share = |i: usize| {
        let Sums { normal, right } = of(i + 1).minus(of(i));
        let by = &normal * &change;
        let weight = change.dot(&by);
        (weight > 0.0).then(|| ((change.dot(&right) - by.dot(&first)) / weight, weight))
    };
    let nearest = FEWEST.max(row.min(rows - row) / 4);
    let median = |shares: &mut dyn Iterator<Item = (f64, f64)>| {
        let (mut shares, weights): (Vec<f64>, Vec<f64>) = shares.take(nearest).unzip();
        shares.sort_by(f64::total_cmp);
        (shares.get(shares.len() / 2).copied().unwrap_or_default(), weights.iter().sum::<f64>())
    };
    let (after, one) = median(&mut (row..rows).filter_map(share));
    let (before, other) = median(&mut (0..row).rev().filter_map(share));
    let left = (1.0 - moved.share) * (sums[rows].squares - of(rows).solved().1) / sums[rows].numbers;
    // The variance of a median is π/2 times that of a mean.
    after - before - 2.0 * (FRAC_PI_2 * left * (one.recip() + other.recip())).sqrt()
}

/// Finds the place whose motion at some row explains the residuals of rows at `x` best, then the
/// one whose difference in all rows does. Each place is a list of unknowns, which may be among
/// those of the model.
pub fn moved_places<R: Borrow<Observation>>(
    model: &Model,
    rows: &[R],
    x: &[f64],
    places: &[Vec<Unknown>],
) -> Result<[Option<MovedPlace>; 2]> {
    let (mut extended, mut columns) = (model.clone(), Vec::new());
    for place in places {
        let (unknowns, mut own) = (&mut extended.unknowns, Vec::new());
        for unknown in place {
            let known = unknowns.iter().position(|other| other == unknown);
            own.push(known.unwrap_or(unknowns.len()));
            unknowns.extend(known.is_none().then_some(*unknown));
        }
        columns.push(own);
    }
    let mut x = x.to_vec();
    x.resize(extended.unknowns.len(), 0.0);
    let mut at = extended.at(&x);
    let none = |place: &Vec<Unknown>| {
        let count = place.len();
        Sums { normal: DMatrix::zeros(count, count), right: DVector::zeros(count) }
    };
    let mut next = Before { squares: 0.0, numbers: 0.0, places: places.iter().map(none).collect() };
    let mut sums = vec![next.clone()];
    for row in rows {
        at.linear(row.borrow(), |residual, derivatives| {
            next.squares += residual * residual;
            next.numbers += 1.0;
            for (columns, Sums { normal, right }) in columns.iter().zip(&mut next.places) {
                let own = DVector::from_fn(columns.len(), |i, _| derivatives[columns[i]]);
                normal.ger(1.0, &own, &own, 1.0);
                right.axpy(-residual, &own, 1.0);
            }
        })?;
        sums.push(next.clone());
    }
    let moves = (FEWEST..(rows.len() + 1).saturating_sub(FEWEST)).filter_map(|row| best(&sums, row));
    let moved = moves.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, moved)| MovedPlace {
        p: moved.p * (places.len() * rows.len()) as f64,
        sudden: suddenness(&sums, &moved),
        ..moved
    });
    let elsewhere = best(&sums, 0).filter(|_| !rows.is_empty());
    let elsewhere = elsewhere.map(|(_, one)| MovedPlace { p: one.p * places.len() as f64, ..one });
    Ok([moved, elsewhere])
}
