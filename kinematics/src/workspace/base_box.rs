//! A box of points in the base frame, each reached by inverse kinematics.

use std::sync::OnceLock;

use super::grids::{combinations, combine};
use super::{Axis, Show, Workspace};
use crate::{Configuration, Inverse, ReachError, Target, configuration::in_range};
use abbe_core::{Error, Manipulator, Pose, Quantity};

/// Orientation of the tool at the points of a [`BaseBox`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolOrientation {
    /// Unconstrained: the result is one of all solutions, found from home.
    Free,
    /// Orientation at home.
    Home,
    /// Axes x, y and z of the tool in `F_0`.
    Axes([[f64; 3]; 3]),
    /// One axis of the tool, 0 for x, along a unit vector of `F_0`. The rotation about it is free.
    Along(usize, [f64; 3]),
}

/// Grid of points in `F_0`, with the variables that reach them.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseBox {
    /// Coordinates along x, y and z of `F_0`, in the length unit.
    pub points: [Vec<f64>; 3],
    /// Orientations of the tool at each point.
    pub orientations: Vec<ToolOrientation>,
    /// Grid of approaches: values of fixed variables, such as a table.
    pub approaches: Vec<Axis>,
    /// Variables that move the tool there. All others stay at home.
    pub solved: Vec<usize>,
}

/// Workspace of a box of points in the base frame; see [`base_box`].
pub struct ReachedBox<'a> {
    manipulator: &'a dyn Manipulator,
    region: BaseBox,
    axes: Vec<Axis>,
    /// Pose at home, whose position is replaced.
    pose: Pose,
    /// Search from each approach, or the error that prevents it.
    inverses: Vec<OnceLock<Result<Inverse<'a>, ReachError>>>,
    home: Configuration,
}

/// Creates the workspace of every point of a grid in the base frame, z fastest, in every
/// orientation and approach, approaches fastest. It is reached from home with nominal parameters.
///
/// Returns [`Error::Count`] if an index of a variable is invalid; other errors as for
/// [`Manipulator::pose`].
pub fn base_box<'a>(manipulator: &'a dyn Manipulator, region: &BaseBox) -> Result<ReachedBox<'a>, Error> {
    let description = manipulator.description();
    let indices = region.approaches.iter().map(|axis| axis.index).chain(region.solved.iter().copied());
    in_range(indices, Quantity::Variables, description.variables.len())?;
    let home = Configuration::home(description);
    let pose = manipulator.pose(&home.q, &home.s)?;
    let inverses = (0..combinations(&region.approaches)).map(|_| OnceLock::new()).collect();
    let axes = region.points.iter().enumerate().map(|(index, values)| Axis { index, values: values.clone() });
    Ok(ReachedBox { manipulator, region: region.clone(), axes: axes.collect(), pose, inverses, home })
}

impl<'a> ReachedBox<'a> {
    /// Returns the approach, the orientation and the point of an index.
    fn parts(&self, index: usize) -> (usize, ToolOrientation, [f64; 3]) {
        let (approaches, orientations) = (self.inverses.len().max(1), &self.region.orientations);
        let turned = index / approaches;
        let mut point = self.pose.position();
        combine(turned / orientations.len(), &self.axes, &mut point);
        (index % approaches, orientations[turned % orientations.len()], point)
    }

    fn target(&self, orientation: ToolOrientation, point: [f64; 3]) -> Target {
        let Pose([x, y, z, _]) = self.pose;
        match orientation {
            ToolOrientation::Free => Target::Point(point),
            ToolOrientation::Home => Target::Pose(Pose([x, y, z, point])),
            ToolOrientation::Axes([x, y, z]) => Target::Pose(Pose([x, y, z, point])),
            ToolOrientation::Along(axis, direction) => Target::Axis { point, axis, direction },
        }
    }

    fn inverse(&self, approach: usize) -> &Result<Inverse<'a>, ReachError> {
        self.inverses[approach].get_or_init(|| {
            let mut start = self.home.q.clone();
            combine(approach, &self.region.approaches, &mut start);
            Inverse::new(self.manipulator, &self.home.s, &start, &self.region.solved)
        })
    }
}

impl Workspace for ReachedBox<'_> {
    fn len(&self) -> usize {
        let turned = self.inverses.len().saturating_mul(self.region.orientations.len());
        combinations(&self.axes).saturating_mul(turned)
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        let mut filled = Ok(());
        self.fill_each(&[index], &mut |_, found, result| {
            configuration.copy_from(found);
            filled = result;
        });
        filled
    }

    fn fill_each(&self, indices: &[usize], show: &mut Show<'_>) {
        let parts: Vec<_> = indices.iter().map(|index| self.parts(*index)).collect();
        let mut found: Vec<Result<Vec<f64>, ReachError>> = vec![Ok(Vec::new()); indices.len()];
        for approach in 0..self.inverses.len() {
            let places = (0..indices.len()).filter(|place| parts[*place].0 == approach);
            let places: Vec<usize> = places.collect();
            if places.is_empty() {
                continue;
            }
            let targets = places.iter().map(|place| self.target(parts[*place].1, parts[*place].2));
            let solved = match self.inverse(approach) {
                Ok(inverse) => inverse.solve(&targets.collect::<Vec<_>>()),
                Err(reason) => vec![Err(*reason); places.len()],
            };
            places.iter().zip(solved).for_each(|(place, solved)| found[*place] = solved);
        }
        let mut configuration = self.home.clone();
        for (place, found) in found.into_iter().enumerate() {
            configuration.copy_from(&self.home);
            combine(parts[place].0, &self.region.approaches, &mut configuration.q);
            let filled = found.map(|q| configuration.q = q);
            show(place, &mut configuration, filled);
        }
    }

    fn point(&self, index: usize) -> Option<[f64; 3]> {
        Some(self.parts(index).2)
    }
}
