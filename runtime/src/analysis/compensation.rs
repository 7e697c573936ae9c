//! What is left after compensation.

use super::Row;
use super::combined::Extreme;
use super::sampling::norm;
use super::single::position;

/// What compensation leaves of a repeatable source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Residual {
    /// This share of its error, with unknown sign: `f ‖r_k(q)‖`.
    Share(f64),
    /// An error of at most this norm, in the length unit, wherever there is one at all.
    Bound(f64),
}

impl Residual {
    fn of(self, error: f64) -> f64 {
        match self {
            Self::Share(share) => share * error,
            Self::Bound(bound) if error > 0.0 => bound,
            Self::Bound(_) => 0.0,
        }
    }
}

/// What compensation leaves of all sources, and the total absolute accuracy, gathered configuration by
/// configuration. Random errors cannot be compensated: they remain as they are.
#[derive(Clone, Debug)]
pub struct Compensation {
    residuals: Vec<Option<Residual>>,
    /// max √(Σ ρ_k²) with the residuals ρ_k of the repeatable sources: their signs are unknown and independent.
    pub residual: Extreme,
    /// max Σ ρ_k: all in one direction.
    pub residual_sum: Extreme,
    /// max √(Σ ρ_k²) + ‖RSS random‖, the total as the paper adds it up.
    pub total: Extreme,
}

impl Compensation {
    /// With what is left of each source, in their order; of random ones it must be none.
    pub fn new(residuals: Vec<Option<Residual>>) -> Self {
        let none = Extreme::default();
        Self { residuals, residual: none, residual_sum: none, total: none }
    }

    /// Takes in a configuration.
    pub fn add(&mut self, row: &Row) {
        let residuals = self.residuals.iter().zip(row.sources);
        let residuals = residuals
            .map(|(residual, source)| residual.map_or(0.0, |residual| residual.of(norm(position(source)))));
        let (sum, squares) = residuals
            .fold((0.0, 0.0), |(sum, squares), residual| (sum + residual, squares + residual * residual));
        self.residual.add(row.index, squares.sqrt());
        self.residual_sum.add(row.index, sum);
        self.total.add(row.index, squares.sqrt() + norm(position(&row.random)));
    }
}
