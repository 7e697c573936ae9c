//! Rows of one check, each with its configuration.

use abbe::Pose;
use abbe::identify::{Measurement, Observation};
use abbe_spec::diagnostic::Diagnostics;

use super::checks::Check;
use super::configurations::{Configurations, MOST, TooManyConfigurations};
use crate::identify::Setup;
use abbe_study::mistake;

/// Rows of one check.
pub(super) struct Visits<'c> {
    pub(super) check: &'c Check,
    /// Pose of every station's instrument in `F_0`, which converts measurements to `F_0`.
    to_base: Vec<Pose>,
    /// Configuration of every row; none if a target was hidden.
    configurations: Vec<Option<u32>>,
}

impl<'c> Visits<'c> {
    /// Assigns rows to configurations; new ones are appended. Rows with hidden targets are skipped.
    pub(super) fn new(
        check: &'c Check,
        setup: &Setup,
        known: &mut Configurations,
    ) -> Result<Self, Diagnostics> {
        let configuration = |row: &Observation| match &row.measured {
            Measurement::Points(points) if !points.iter().all(Option::is_some) => Ok(None),
            Measurement::Readings(readings) if readings.iter().any(Option::is_none) => Ok(None),
            _ => known.find_or_insert(&row.q).map(Some),
        };
        let found = check.data.observations.iter().map(configuration).collect::<Result<_, _>>();
        let help = format!(
            "use the same few configurations in every check (joints within 1 mrad), at most \
             {MOST}; or identify the machine from all rows by `abbe identify`"
        );
        let many = |TooManyConfigurations| {
            let message = format!("more than {MOST} different configurations up to this check");
            mistake::with_help(&check.data.file, message, help)
        };
        let to_base = setup.real.stations.iter().map(|station| station.pose.inverse()).collect();
        Ok(Self { check, to_base, configurations: found.map_err(many)? })
    }

    /// Iterates over the used rows, each with its configuration.
    pub(super) fn rows(&self) -> impl Iterator<Item = (&'c Observation, usize)> {
        let rows = self.check.data.observations.iter().zip(&self.configurations);
        rows.filter_map(|(row, configuration)| Some((row, (*configuration)? as usize)))
    }

    /// Counts the rows of each configuration.
    pub(super) fn counts(&self, count: usize) -> Vec<u32> {
        let mut counts = vec![0; count];
        self.rows().for_each(|(_, configuration)| counts[configuration] += 1);
        counts
    }

    /// Converts a row to the frame `F_0`.
    pub(super) fn in_f0(&self, row: &Observation) -> Observation {
        let to_base = &self.to_base[row.station as usize];
        let measured = match &row.measured {
            Measurement::Points(points) => Measurement::Points(
                points.iter().map(|point| point.map(|point| to_base.apply(point))).collect(),
            ),
            Measurement::Pose(pose) => Measurement::Pose(Box::new(to_base.then(pose))),
            // The fixtures are already in F_0.
            readings @ Measurement::Readings(_) => readings.clone(),
        };
        Observation { measured, station: 0, ..row.clone() }
    }
}
