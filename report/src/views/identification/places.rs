//! Places of the machine, of what is mounted on its tool, and of instruments, with their standard
//! deviations.

use abbe_metrology::identify::{FoundInstrument, PlacementAtStation, Report};
use abbe_study::number::{digits, error_unit, fixed};

use crate::document::Table;

/// Tabulates all places that were fitted: positions in the frame that the map states them in.
pub(super) fn places(report: &Report) -> Table {
    let (factor, unit) = error_unit(report.length);
    let columns = ["place", ">x", ">y", ">z", "", "± 1 σ"];
    let row = |name: String, at: [f64; 3], variances: [f64; 3]| {
        let [x, y, z] = at.map(|value| fixed(factor * value, 3));
        let deviations = variances.map(|variance| match variance > 0.0 {
            true => digits(factor * variance.sqrt(), 2),
            false => "held".to_owned(),
        });
        let is_fitted = variances.iter().any(|variance| *variance > 0.0);
        is_fitted.then(|| [name, x, y, z, unit.to_owned(), deviations.join(", ")])
    };
    let named =
        |what: &str, name: &str| if name.is_empty() { what.to_owned() } else { format!("{what} {name}") };
    let placed = &report.placed;
    let stations = placed.stations.iter().map(|station| {
        let of = |i: usize| station.covariance[i][i];
        row(named("machine", &station.name), [0, 1, 2].map(|i| station.pose[i][3]), [of(0), of(1), of(2)])
    });
    let on_tool = placed.placements();
    let on_tool = on_tool.iter().flat_map(|PlacementAtStation { station, targets, mounting, covariance }| {
        let targets = targets.iter().enumerate().map(move |(j, at)| {
            let what = if targets.len() > 1 { format!("target {}", j + 1) } else { "target".to_owned() };
            row(named(&what, station), *at, [0, 1, 2].map(|i| covariance[3 * j + i][3 * j + i]))
        });
        let frame = mounting.map(|pose| {
            let what = named("measured frame", station);
            row(what, [0, 1, 2].map(|i| pose[i][3]), [0, 1, 2].map(|i| covariance[i][i]))
        });
        targets.chain(frame)
    });
    let instruments =
        placed.instruments.iter().filter_map(|FoundInstrument { name, position, covariance, .. }| {
            Some(row(name.clone(), (*position)?, [0, 1, 2].map(|i| covariance[i][i])))
        });
    let rows: Vec<_> = stations.chain(on_tool).chain(instruments).flatten().collect();
    Table::new("", columns).rows(rows)
}
