//! The paper's workspace: a volume of tool points, each presented at a fixed point of the room.

use super::configurations::Indexed;
use super::grids::{combinations, combine};
use super::{Axis, Workspace};
use crate::configuration::in_range;
use crate::{Configuration, Target, inverse, sampling};
use abbe_core::{Error, Manipulator, Quantity};

/// Tool points, target point and approaches of a presented volume.
#[derive(Clone, Debug, PartialEq)]
pub struct Presentation {
    /// Target of every tool point, in `F_0`: the isocenter.
    pub point: [f64; 3],
    /// Grid of tool points: values of structural parameters.
    pub tool_points: Vec<Axis>,
    /// Grid of approaches: values of fixed variables, such as the spin.
    pub approaches: Vec<Axis>,
    /// Variables that move the tool point to the target. All others stay at home.
    pub solved: Vec<usize>,
}

/// Creates the workspace of every tool point in every approach, presented at one point of `F_0`.
/// Approaches vary fastest.
///
/// Each configuration is solved from home, independently of the others. Returns [`Error::Count`] if
/// an index of a variable or a parameter is invalid; other errors as for
/// [`Manipulator::transforms`].
pub fn presented_volume<'a>(
    manipulator: &'a dyn Manipulator,
    presentation: &Presentation,
) -> Result<impl Workspace + use<'a>, Error> {
    let description = manipulator.description();
    let Presentation { point, tool_points, approaches, solved } = presentation.clone();
    let indices = approaches.iter().map(|axis| axis.index).chain(solved.iter().copied());
    in_range(indices, Quantity::Variables, description.variables.len())?;
    let indices = tool_points.iter().map(|axis| axis.index);
    in_range(indices, Quantity::Parameters, description.parameters.len())?;

    let home = Configuration::home(description);
    sampling::arm_length(manipulator, &home.s)?;
    let count = combinations(&tool_points).saturating_mul(combinations(&approaches));
    let fill = move |index: usize, configuration: &mut Configuration| {
        let tool_point = combine(index, &approaches, &mut configuration.q);
        combine(tool_point, &tool_points, &mut configuration.s);
        let Configuration { q, s, .. } = &*configuration;
        configuration.q = inverse(manipulator, s, q, &solved, &Target::Point(point))?;
        Ok(())
    };
    Ok(Indexed { home, count, fill })
}
