//! A box of points in the base frame, each reached by inverse kinematics.

use super::axis::{combinations, combine, in_range};
use super::{Axis, Configuration, Workspace};
use crate::{Inverse, ReachError, Target};
use abbe_core::{Error, Manipulator, Pose, Quantity};

/// What a tool that reaches a point of a [`BaseBox`] has to point at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolOrientation {
    /// Nothing: only the point counts, and of all solutions the search from home finds one.
    Free,
    /// Where it points at home.
    Home,
}

/// A grid of points in `F_0` and how they are reached.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseBox {
    /// The coordinates along x, y and z of `F_0`, in the length unit.
    pub points: [Vec<f64>; 3],
    /// How the tool stands there.
    pub orientation: ToolOrientation,
    /// The variables that bring it there. All others stay at home.
    pub solved: Vec<usize>,
}

/// A box of points in the base frame; see [`base_box`].
pub struct ReachedBox<'a> {
    axes: Vec<Axis>,
    /// The pose at home, whose position is replaced.
    pose: Pose,
    orientation: ToolOrientation,
    /// From home; or why nothing is reached at all.
    inverse: Result<Inverse<'a>, ReachError>,
    home: Configuration,
}

/// Every point of a grid in the base frame, z fastest, reached from home with nominal parameters.
///
/// [`Error::Count`] if `solved` names a variable that there is not; other errors as for [`Manipulator::pose`].
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
