//! Measured poses expressed in `F_0`.

use abbe::Pose;
use abbe::identify::{Measurement, Observation};

use crate::data::{Data, Map};

/// Converts measured poses to poses of the tool in `F_0`: removes the station and the mounting of
/// the target.
pub(super) struct BaseFramePoses {
    stations: Vec<Pose>,
    mounting: Pose,
}

impl BaseFramePoses {
    pub(super) fn new(map: &Map, data: &Data) -> Self {
        let stands = |station: usize| data.stations.get(station).and_then(|name| map.stations.pose(name));
        let stations =
            (0..data.stations.len().max(1)).map(|i| stands(i).unwrap_or(Pose::IDENTITY).inverse()).collect();
        Self { stations, mounting: map.mounting().inverse() }
    }

    pub(super) fn row(&self, mut row: Observation) -> Observation {
        if let Measurement::Pose(pose) = &mut row.measured {
            **pose = self.stations[row.station as usize].then(pose).then(&self.mounting);
        }
        row
    }
}
