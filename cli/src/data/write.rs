//! A data file as its map has it: for plans and for simulated measurements.

use abbe::identify::{Observation, Seen};

use super::map::{Channel, Layout, Map};
use super::rotation;

impl Map {
    /// The heading: joints and inputs, and what is measured unless this is a plan.
    pub(crate) fn heading(&self, measured: bool) -> Vec<String> {
        let mut names: Vec<String> = self.commanded().map(|column| column.name.clone()).collect();
        if measured {
            names.extend(self.measured().into_iter().map(|column| column.name.clone()));
        }
        names
    }

    /// The numbers of a row; `ideal` is the commanded tool point, for differences.
    pub(crate) fn numbers(&self, row: &Observation, ideal: [f64; 3], measured: bool) -> Vec<Option<f64>> {
        let channels = self.joints.iter().zip(&row.q).chain(self.inputs.iter().zip(&row.u));
        let commanded = channels.filter_map(|(channel, value)| match channel {
            Channel::Column(_, factor) => Some(Some(value / factor)),
            Channel::Fixed(_) => None,
        });
        let mut numbers: Vec<Option<f64>> = commanded.collect();
        if !measured {
            return numbers;
        }
        match (&self.layout, &row.seen) {
            (Layout::Point(_, factor), Seen::Points(points)) => {
                numbers.extend(spread(points.first().copied().flatten(), *factor));
            }
            (Layout::Difference(_, _, factor), Seen::Points(points)) => {
                let point = points.first().copied().flatten();
                let difference = point.map(|point| std::array::from_fn(|i| ideal[i] - point[i]));
                numbers.extend(spread(Some(ideal), *factor));
                numbers.extend(spread(difference, *factor));
            }
            (Layout::Targets(targets), Seen::Points(points)) => {
                for (target, point) in targets.iter().zip(points) {
                    numbers.extend(spread(*point, target.factor));
                }
            }
            (Layout::Pose(_, factor, turn), Seen::Pose(pose)) => {
                let [x, y, z, position] = pose.0;
                numbers.extend(spread(Some(position), *factor));
                numbers.extend(rotation::to_numbers(turn, &[x, y, z]).into_iter().map(Some));
            }
            _ => {}
        }
        numbers
    }
}

/// The coordinates of a point, or three empty fields.
fn spread(point: Option<[f64; 3]>, factor: f64) -> [Option<f64>; 3] {
    std::array::from_fn(|i| point.map(|point| point[i] / factor))
}
