//! Test of the residuals against the stated uncertainty.

use abbe::identify::{Failure, Fit, Observation, Options, deviation_beyond, fit};
use serde::Serialize;

use crate::data::Map;
use crate::identify::Setup;

/// Test of the errors minus the repeatable sources against the uncertainty of the instrument: the
/// χ² test by which `identify` assesses its own residuals.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ResidualTest {
    /// Factor of the stated uncertainty that explains the residuals.
    pub factor: f64,
    /// Degrees of freedom, counted as in an identification.
    pub freedom: f64,
    /// Probability of a factor at least as far from 1 by chance.
    pub p: f64,
}

impl ResidualTest {
    /// Tests the residuals of the machine as specified. `placed` is the fit of stations and
    /// fixtures to these rows, if there was one.
    ///
    /// Returns none if the map states no uncertainty, or for too few rows.
    pub(super) fn new(
        setup: &Setup,
        map: &Map,
        rows: &[Observation],
        placed: Option<&Fit>,
    ) -> Result<Option<Self>, Failure> {
        if !map.states_uncertainty() {
            return Ok(None);
        }
        let of_fit = |fit: &Fit| {
            let (factor, freedom) = (fit.sigma, fit.freedom);
            (freedom > 0.0).then(|| Self { factor, freedom, p: deviation_beyond(factor, freedom) })
        };
        if let Some(placed) = placed {
            return Ok(of_fit(placed));
        }
        // A fit without unknowns counts degrees of freedom and combines repeated visits.
        match fit(&setup.real.with(Vec::new()), rows, &Options::default()) {
            Ok(fit) => Ok(of_fit(&fit)),
            Err(Failure::TooFew { .. }) => Ok(None),
            Err(failure) => Err(failure),
        }
    }
}
