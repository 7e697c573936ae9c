//! Monte Carlo simulation on the exact chain.

mod monte_carlo;
mod quantile;

pub use monte_carlo::{MonteCarlo, monte_carlo};
pub use quantile::Quantile;
