//! Poses as they are in `F_0`.

use abbe::Pose;
use abbe::identify::{Measurement, Observation};

use crate::data::{Data, Map};

/// Poses as the tool has them in `F_0`: without the station from where they are seen and what is mounted on the tool.
pub(super) struct InF0 {
    stations: Vec<Pose>,
    mounting: Pose,
}

impl InF0 {
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
