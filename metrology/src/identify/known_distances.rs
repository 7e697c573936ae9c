//! Known distances between the points of instruments: their residuals in a fit.

use abbe::identify::{Fit, Model};
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use super::unread::read;
use crate::data::{Data, Map};
use abbe_study::mistake;

/// Known distance between the points of two instruments, and its residual in the fit.
#[derive(Clone, Debug, Serialize)]
pub struct KnownDistanceFit {
    /// Names of the instruments.
    pub between: [String; 2],
    /// Stated distance, in the length unit.
    pub value: f64,
    /// Its stated standard deviation, in the length unit.
    pub uncertainty: f64,
    /// Distance of the identified points, in the length unit.
    pub found: f64,
    /// Found minus stated distance, in units of the uncertainty.
    pub residual: f64,
}

/// Returns the residuals of the known distances of a map.
pub(super) fn known_distance_fits(model: &Model, fit: &Fit) -> Vec<KnownDistanceFit> {
    let known = model.known_distances.iter().zip(model.distance_residuals(&fit.x));
    known
        .map(|(known, residual)| KnownDistanceFit {
            between: known.fixtures.map(|fixture| model.fixtures[fixture].name.clone()),
            value: known.length,
            uncertainty: known.uncertainty,
            found: known.length + residual * known.uncertainty,
            residual,
        })
        .collect()
}

/// Returns an error if the rows do not read one of the instruments between which the map states a
/// distance: its point could then be anywhere.
pub(super) fn check_known_distances(model: &Model, map: &Map, data: &Data) -> Result<(), Diagnostics> {
    let Some(all) = map.instruments() else { return Ok(()) };
    let read = read(model, &data.observations);
    let fixtures = model.known_distances.iter().flat_map(|known| known.fixtures);
    let instruments = fixtures.filter_map(|fixture| all.instrument_at(fixture));
    let mut unread = instruments.filter(|instrument| !read[all.list[*instrument].observables.start]);
    let Some(instrument) = unread.next() else { return Ok(()) };
    let message = format!(
        "no row reads the instrument `{}`, to which the map states a distance",
        all.list[instrument].name.escape_debug()
    );
    let help = "measure there as well, or remove its [[distance]]";
    Err(mistake::with_help(&data.file, message, help))
}
