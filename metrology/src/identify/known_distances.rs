//! Known distances between the points of instruments: their residuals in a fit.

use abbe::identify::{Fit, KnownDistance, Model};
use serde::Serialize;

use super::unread::read;
use crate::data::{Data, Map};
use abbe_study::{Result, mistake};

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

/// Returns the known distances whose ends the rows read: others say nothing of the machine.
///
/// Returns an error if an end that no row reads has an unknown position: it could then be anywhere.
pub(super) fn measured_distances(model: &Model, map: &Map, data: &Data) -> Result<Vec<KnownDistance>> {
    let Some(all) = map.instruments() else { return Ok(Vec::new()) };
    let read = read(model, &data.observations);
    let unread = |known: &KnownDistance| {
        let mut instruments = known.fixtures.into_iter().filter_map(|fixture| all.instrument_at(fixture));
        instruments.find(|instrument| !read[all.list[*instrument].observables.start])
    };
    let mut kept = Vec::new();
    for known in &model.known_distances {
        match unread(known) {
            None => kept.push(*known),
            Some(instrument) if all.at_unknown_positions().any(|unknown| unknown == instrument) => {
                let name = all.list[instrument].name.escape_debug();
                let message =
                    format!("no row reads the instrument `{name}`, to which the map states a distance");
                let help = "measure there as well, or remove its [[distance]]";
                return Err(mistake::with_help(&data.file, message, help));
            }
            Some(_) => {}
        }
    }
    Ok(kept)
}
