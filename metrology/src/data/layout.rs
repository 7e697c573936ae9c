//! Conversion between the columns of a data file and measurements.

use abbe::Pose;
use abbe::identify::{Measurement, Observation};

use super::{Channel, Layout, Map, rotation};

impl Map {
    /// Converts the numbers of the measured columns to a measurement, without hidden targets; or
    /// returns the reason of the failure.
    pub(super) fn measurement(&self, numbers: &[Option<f64>]) -> Result<Measurement, String> {
        let known: Vec<f64> = numbers.iter().flatten().copied().collect();
        let point = |factor: f64| std::array::from_fn(|i| known[i] * factor);
        Ok(match &self.layout {
            Layout::Point(_, factor) => Measurement::Points(vec![Some(point(*factor))].into()),
            Layout::Difference(_, _, factor) => {
                let actual = std::array::from_fn(|i| (known[i] - known[3 + i]) * factor);
                Measurement::Points(vec![Some(actual)].into())
            }
            Layout::Targets(targets) => {
                let points = numbers.chunks_exact(3).zip(targets).map(|(three, target)| match three {
                    [Some(x), Some(y), Some(z)] => Some([x, y, z].map(|value| value * target.factor)),
                    _ => None,
                });
                Measurement::Points(points.collect())
            }
            Layout::Pose(_, factor, turn) => {
                let [x, y, z] = rotation::from_numbers(turn, &known[3..])?;
                Measurement::Pose(Box::new(Pose([x, y, z, point(*factor)])))
            }
            Layout::Instruments(all) => Measurement::Readings(all.read(numbers)?),
        })
    }

    /// Returns the heading: joints and inputs, and the measured columns unless it is a plan.
    pub fn heading(&self, measured: bool) -> Vec<String> {
        let station = self.stations.column.iter();
        let mut names: Vec<String> =
            station.chain(self.commanded()).map(|column| column.name.clone()).collect();
        if measured {
            names.extend(self.measured().into_iter().map(|column| column.name.clone()));
        } else {
            names.extend(self.setup().map(|column| column.name.clone()));
        }
        names
    }

    /// Returns the name of the station of each row if they have a column; `names` by index.
    pub fn labels<'o>(
        &self,
        rows: impl IntoIterator<Item = &'o Observation>,
        names: &[String],
    ) -> Vec<String> {
        let name = |row: &Observation| names.get(row.station as usize).cloned().unwrap_or_default();
        rows.into_iter().filter(|_| self.stations.column.is_some()).map(name).collect()
    }

    /// Returns the numbers of a row; `ideal` is the commanded tool point, for differences.
    pub fn numbers(&self, row: &Observation, ideal: [f64; 3], measured: bool) -> Vec<Option<f64>> {
        let channels = self.joints.iter().zip(row.q.iter()).chain(self.inputs.iter().zip(row.u.iter()));
        let commanded = channels.filter_map(|(channel, value)| match channel {
            Channel::Column(_, scale) => Some(Some(scale.number(*value))),
            Channel::Fixed(_) | Channel::FromRows(_) => None,
        });
        let mut numbers: Vec<Option<f64>> = commanded.collect();
        if let (Layout::Instruments(all), Measurement::Readings(readings)) = (&self.layout, &row.measured) {
            match measured {
                true => numbers.extend(all.numbers(readings)),
                false => numbers.extend(self.setup().map(|_| all.setup_of(readings))),
            }
        }
        if !measured {
            return numbers;
        }
        match (&self.layout, &row.measured) {
            (Layout::Point(_, factor), Measurement::Points(points)) => {
                numbers.extend(spread(points.first().copied().flatten(), *factor));
            }
            (Layout::Difference(_, _, factor), Measurement::Points(points)) => {
                let point = points.first().copied().flatten();
                let difference = point.map(|point| std::array::from_fn(|i| ideal[i] - point[i]));
                numbers.extend(spread(Some(ideal), *factor));
                numbers.extend(spread(difference, *factor));
            }
            (Layout::Targets(targets), Measurement::Points(points)) => {
                for (target, point) in targets.iter().zip(points.iter()) {
                    numbers.extend(spread(*point, target.factor));
                }
            }
            (Layout::Pose(_, factor, turn), Measurement::Pose(pose)) => {
                let [x, y, z, position] = pose.0;
                numbers.extend(spread(Some(position), *factor));
                numbers.extend(rotation::to_numbers(turn, &[x, y, z]).into_iter().map(Some));
            }
            _ => {}
        }
        numbers
    }
}

/// Returns the coordinates of a point, or three empty cells.
fn spread(point: Option<[f64; 3]>, factor: f64) -> [Option<f64>; 3] {
    std::array::from_fn(|i| point.map(|point| point[i] / factor))
}
