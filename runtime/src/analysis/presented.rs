//! The paper's workspace: a volume of tool points, each presented at a fixed point of the room.

use super::workspace::{combinations, in_range};
use super::{Axis, Configuration, Target, Unreachable, Workspace, inverse, sampling};
use crate::{Error, Manipulator, Quantity};

/// What is presented where, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Presentation {
    /// Where every tool point is to be brought, in `F_0`: the isocentre.
    pub point: [f64; 3],
    /// The grid of tool points: values of structural parameters.
    pub tool_points: Vec<Axis>,
    /// The grid of approaches: values of variables that are held, the spin say.
    pub approaches: Vec<Axis>,
    /// The variables that bring the tool point there. All others stay at home.
    pub solved: Vec<usize>,
}

/// Every tool point in every approach, presented at one point of `F_0`; approaches vary fastest.
///
/// What cannot be presented is counted in [`Workspace::unreachable`] with its reason. [`Error::Count`] if an
/// index names a variable or a parameter that there is not; other errors as for [`Manipulator::transforms`].
pub fn presented_volume(
    manipulator: &dyn Manipulator,
    presentation: &Presentation,
) -> Result<Workspace, Error> {
    let description = manipulator.description();
    let Presentation { point, tool_points, approaches, solved } = presentation;
    let indices = approaches.iter().map(|axis| axis.index).chain(solved.iter().copied());
    in_range(indices, Quantity::Variables, description.variables.len())?;
    let indices = tool_points.iter().map(|axis| axis.index);
    in_range(indices, Quantity::Parameters, description.parameters.len())?;

    let home = Configuration::home(&description);
    sampling::arm_length(manipulator, &home.s)?;
    let target = Target::Point(*point);
    let (mut configurations, mut unreachable) = (Vec::new(), Vec::new());
    for s in combinations(&home.s, tool_points) {
        for start in combinations(&home.q, approaches) {
            match inverse(manipulator, &s, &start, solved, &target) {
                Ok(q) => configurations.push(Configuration { q, s: s.clone() }),
                Err(reason) => {
                    let asked = Configuration { q: start, s: s.clone() };
                    unreachable.push(Unreachable { asked, reason });
                }
            }
        }
    }
    Ok(Workspace { configurations, home, unreachable })
}
