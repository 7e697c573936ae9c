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
//! A place that differs in all rows explains the gain G = E of all by p unknowns; one that moved at
//! row k, E of those before and E of those from k on, by 2p. Of either kind, the one with the least
//! `m ln(S − G) + p ln m` is returned, for the sum S of m squares (Bayesian information criterion).
//! The F test of one that moved compares with the same difference in all rows; the probability by
//! chance is multiplied by the number of places and rows that were tried (Bonferroni). Residuals of
//! a fit are orthogonal to what was fitted: G is then too small rather than too large.

use nalgebra::{DMatrix, DVector};

use super::statistics::f_test;
use super::{Failure, Model, Observation, Unknown};

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
}

/// Largest number of intervals between whose rows changes are sought first.
const PIECES: usize = 500;

/// Smallest number of rows before and after a change.
const FEWEST: usize = 3;

/// Sums N and g of a place.
#[derive(Clone, Debug)]
struct Sums {
    normal: DMatrix<f64>,
    right: DVector<f64>,
}

impl Sums {
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
    row: usize,
    /// Sum of squared residuals, and their number.
    squares: f64,
    numbers: f64,
    places: Vec<Sums>,
}

impl Before {
    /// Returns the place that explains the rows best if it moves at this row, with its criterion.
    fn best(&self, end: &Self) -> Option<(f64, MovedPlace)> {
        let m = end.numbers;
        let places = self.places.iter().zip(&end.places).enumerate().map(|(place, (before, all))| {
            let after = Sums { normal: &all.normal - &before.normal, right: &all.right - &before.right };
            let [(first, gain), (then, rest)] = [before, &after].map(Sums::solved);
            let (_, alike) = if self.row == 0 { (first.clone(), 0.0) } else { all.solved() };
            let (count, is_step) = (first.len(), usize::from(self.row > 0));
            let left = (end.squares - gain - rest).max(0.0);
            let freedom = (m as usize).saturating_sub(count * (1 + is_step));
            let test = f_test(end.squares - alike, left, count, freedom);
            let share = (end.squares - alike - left) / (end.squares - alike).max(f64::MIN_POSITIVE);
            let criterion = m * left.ln() + (count * (1 + is_step)) as f64 * m.ln();
            let change = (then - first).as_slice().to_vec();
            (criterion, MovedPlace { place, row: self.row, change, share, p: test.p })
        });
        places.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// Finds the place whose motion at some row explains the residuals of rows at `x` best, then the
/// one whose difference in all rows does. Each place is a list of unknowns, which may be among
/// those of the model.
pub fn moved_places(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    places: &[Vec<Unknown>],
) -> Result<Vec<MovedPlace>, Failure> {
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
    let mut sums = |mut before: Before, starts: &mut dyn Iterator<Item = usize>| {
        let mut all = Vec::new();
        for start in starts {
            for observation in &data[before.row..start] {
                at.linear(observation, |residual, derivatives| {
                    before.squares += residual * residual;
                    before.numbers += 1.0;
                    for (columns, Sums { normal, right }) in columns.iter().zip(&mut before.places) {
                        let own = DVector::from_fn(columns.len(), |i, _| derivatives[columns[i]]);
                        normal.ger(1.0, &own, &own, 1.0);
                        right.axpy(-residual, &own, 1.0);
                    }
                })?;
            }
            before.row = start;
            all.push(before.clone());
        }
        Ok::<_, Failure>(all)
    };
    let none = |place: &Vec<Unknown>| {
        let count = place.len();
        Sums { normal: DMatrix::zeros(count, count), right: DVector::zeros(count) }
    };
    let step = data.len().div_ceil(PIECES).max(1);
    let none = Before { row: 0, squares: 0.0, numbers: 0.0, places: places.iter().map(none).collect() };
    let pieces = sums(none, &mut (0..data.len()).step_by(step).chain([data.len()]))?;
    let Some(end) = pieces.last().filter(|end| end.squares > 0.0) else { return Ok(Vec::new()) };
    let best = |pieces: &[Before]| {
        let moves = |before: &&Before| FEWEST <= before.row && before.row + FEWEST <= data.len();
        let found = pieces.iter().filter(moves).filter_map(|before| before.best(end));
        found.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, found)| found)
    };
    let mut moved = best(&pieces);
    if let Some(row) = moved.as_ref().map(|moved| moved.row).filter(|_| step > 1) {
        let near = &pieces[row / step - 1];
        moved = best(&sums(near.clone(), &mut (near.row..data.len().min(row + step)))?);
    }
    let tried = (places.len() * data.len()) as f64;
    let moved = moved.map(|moved| MovedPlace { p: moved.p * tried, ..moved });
    Ok(moved.into_iter().chain(pieces[0].best(end).map(|(_, found)| found)).collect())
}
