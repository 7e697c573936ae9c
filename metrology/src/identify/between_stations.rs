//! Difference of a machine between the stations at which it was measured, in the covariance of the
//! fit.

use abbe::identify::{Failure, between_stations};

use super::{Prior, Setup, Solved};
use crate::data::Data;
use abbe_study::number::{self, digits};
use abbe_study::{About, Result};

/// Largest probability of a difference between stations by chance at which it is included in the
/// covariance.
const CHANCE: f64 = 0.05;

/// Adds the variance component between the stations of the rows to the covariance of the fit, with
/// a note.
pub(super) fn include_between_stations(solved: &mut Solved, setup: &Setup, data: &Data) -> Result<()> {
    let found = || -> Result<_, Failure> {
        let sizes = solved.model.priors(Prior::DEFAULT_SHARE)?;
        between_stations(&solved.model, &data.observations, &solved.fit, &sizes)
    };
    let found = found().about(&data.file)?;
    let Some(between) = found.filter(|between| between.p < CHANCE) else { return Ok(()) };
    solved.fit.covariance = between.covariance;
    let share = between.share * Prior::DEFAULT_SHARE;
    solved.notes.push(format!(
        "note: the machine differs between its {} stations by more than the noise explains, by {} and {} mrad \
         in each error (one standard deviation, p {}). All standard deviations include this difference",
        between.stations,
        number::length(share * setup.arm, setup.description.length),
        digits(1e3 * share, 2),
        digits(between.p, 2)
    ));
    Ok(())
}
