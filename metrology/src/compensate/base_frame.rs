//! Measured poses expressed in `F_0`.

use abbe::Pose;
use abbe::identify::{Measurement, Observation};

use crate::data::{Data, Map};

/// Converts measured poses to poses of the tool in `F_0`: removes the station and the mounting of
/// the target.
pub(super) struct BaseFramePoses {
    stations: Vec<Pose>,
    mountings: Vec<Pose>,
}

impl BaseFramePoses {
    pub(super) fn new(map: &Map, data: &Data) -> Self {
        let names: Vec<&str> =
            (0..data.stations.len().max(1)).map(|i| data.stations.get(i).map_or("", |name| name)).collect();
        let stands = |name: &&str| map.stations.pose(name).unwrap_or(Pose::IDENTITY).inverse();
        Self {
            stations: names.iter().map(stands).collect(),
            mountings: names.iter().map(|name| map.mounting_at(name).inverse()).collect(),
        }
    }

    pub(super) fn row(&self, mut row: Observation) -> Observation {
        if let Measurement::Pose(pose) = &mut row.measured {
            let station = row.station as usize;
            **pose = self.stations[station].then(pose).then(&self.mountings[station]);
        }
        row
    }
}
