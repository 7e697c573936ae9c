//! A box of points in the base frame, each reached by inverse kinematics.

use super::axis::{combinations, combine};
use super::{Axis, Workspace};
use crate::Configuration;
use crate::configuration::in_range;
use crate::{Inverse, ReachError, Target};
use abbe_core::{Error, Manipulator, Pose, Quantity};

/// Orientation of the tool at the points of a [`BaseBox`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolOrientation {
    /// Unconstrained: the result is one of all solutions, found from home.
    Free,
    /// Orientation at home.
    Home,
}

/// Grid of points in `F_0`, with the variables that reach them.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseBox {
    /// Coordinates along x, y and z of `F_0`, in the length unit.
    pub points: [Vec<f64>; 3],
    /// Orientation of the tool at the points.
    pub orientation: ToolOrientation,
    /// Variables that move the tool there. All others stay at home.
    pub solved: Vec<usize>,
}

/// Workspace of a box of points in the base frame; see [`base_box`].
pub struct ReachedBox<'a> {
    axes: Vec<Axis>,
    /// Pose at home, whose position is replaced.
    pose: Pose,
    orientation: ToolOrientation,
    /// Search from home, or the error that prevents it.
    inverse: Result<Inverse<'a>, ReachError>,
    home: Configuration,
}

/// Creates the workspace of every point of a grid in the base frame, z fastest, reached from home
/// with nominal parameters.
///
/// Returns [`Error::Count`] if `solved` contains an invalid index; other errors as for
/// [`Manipulator::pose`].
pub fn base_box<'a>(manipulator: &'a dyn Manipulator, region: &BaseBox) -> Result<ReachedBox<'a>, Error> {
    let description = manipulator.description();
    in_range(region.solved.iter().copied(), Quantity::Variables, description.variables.len())?;
    let home = Configuration::home(description);
    let pose = manipulator.pose(&home.q, &home.s)?;
    let inverse = Inverse::new(manipulator, &home.s, &home.q, &region.solved);
    let axes = region.points.iter().enumerate().map(|(index, values)| Axis { index, values: values.clone() });
    Ok(ReachedBox { axes: axes.collect(), pose, orientation: region.orientation, inverse, home })
}

impl ReachedBox<'_> {
    fn at(&self, index: usize) -> [f64; 3] {
        let mut point = self.pose.position();
        combine(index, &self.axes, &mut point);
        point
    }

    fn target(&self, index: usize) -> Target {
        let Pose([x, y, z, _]) = self.pose;
        let point = self.at(index);
        match self.orientation {
            ToolOrientation::Free => Target::Point(point),
            ToolOrientation::Home => Target::Pose(Pose([x, y, z, point])),
        }
    }
}

impl Workspace for ReachedBox<'_> {
    fn len(&self) -> usize {
        combinations(&self.axes)
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

    fn fill_each(
        &self,
        indices: &[usize],
        show: &mut dyn FnMut(usize, &mut Configuration, Result<(), ReachError>),
    ) {
        let targets: Vec<Target> = indices.iter().map(|index| self.target(*index)).collect();
        let found = match &self.inverse {
            Ok(inverse) => inverse.solve(&targets),
            Err(reason) => vec![Err(*reason); targets.len()],
        };
        let mut configuration = self.home.clone();
        for (place, found) in found.into_iter().enumerate() {
            configuration.copy_from(&self.home);
            let filled = found.map(|q| configuration.q = q);
            show(place, &mut configuration, filled);
        }
    }

    fn point(&self, index: usize) -> Option<[f64; 3]> {
        Some(self.at(index))
    }
}
