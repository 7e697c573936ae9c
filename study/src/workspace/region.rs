//! The workspace of a study.

use abbe::analysis::{
    Axis, BaseBox, Presentation, ToolOrientation, Workspace, base_box, joint_grid, joint_samples, listed,
    presented_volume, random_joint_samples,
};
use abbe::{Error, Manipulator};
use abbe_codegen::spec::Spec;

use super::path::Path;
use crate::number;

/// How many joint samples are looked at if nobody says.
const SAMPLES: usize = 1000;

/// The most configurations that are analyzed: none is stored, but time is finite.
pub(super) const LARGEST: usize = 1_000_000_000;

/// Which configurations are looked at.
#[derive(Clone, Debug)]
pub enum Region {
    /// A volume of tool points, each presented at a point of the room.
    Presented(Presentation),
    /// Every combination of values of some variables.
    Grid(Vec<Axis>),
    /// Samples of some variables within their limits: random ones if there is a seed.
    Samples {
        /// Indices of the variables that move.
        moved: Vec<usize>,
        /// How many samples.
        count: usize,
        /// The seed of random ones.
        seed: Option<u64>,
    },
    /// A box of points in the base frame.
    Box(BaseBox),
    /// Configurations from a file.
    Path(Path),
}

impl Region {
    /// All variables, sampled.
    pub fn samples(spec: &Spec) -> Self {
        Self::Samples { moved: (0..spec.variables.len()).collect(), count: SAMPLES, seed: None }
    }

    /// How many configurations are asked for, if they are not too many.
    pub(super) fn count(&self) -> Option<usize> {
        let sizes: Vec<usize> = match self {
            Self::Presented(Presentation { tool_points, approaches, .. }) => {
                tool_points.iter().chain(approaches).map(|axis| axis.values.len()).collect()
            }
            Self::Grid(axes) => axes.iter().map(|axis| axis.values.len()).collect(),
            Self::Box(region) => region.points.iter().map(Vec::len).collect(),
            Self::Samples { count, .. } => vec![*count],
            Self::Path(path) => vec![path.configurations.len()],
        };
        sizes.into_iter().try_fold(1, usize::checked_mul).filter(|count| *count <= LARGEST)
    }

    /// The configurations; a seed replaces that of the study.
    pub fn workspace<'a>(
        &self,
        manipulator: &'a dyn Manipulator,
        seed: Option<u64>,
    ) -> Result<Box<dyn Workspace + 'a>, Error> {
        Ok(match self {
            Self::Presented(presentation) => Box::new(presented_volume(manipulator, presentation)?),
            Self::Grid(axes) => Box::new(joint_grid(manipulator, axes)?),
            Self::Samples { moved, count, seed: None } => {
                Box::new(joint_samples(manipulator, moved, *count)?)
            }
            Self::Samples { moved, count, seed: Some(own) } => {
                Box::new(random_joint_samples(manipulator, moved, *count, seed.unwrap_or(*own))?)
            }
            Self::Box(region) => Box::new(base_box(manipulator, region)?),
            Self::Path(path) => Box::new(listed(manipulator, path.configurations(manipulator))?),
        })
    }

    /// The parameters that are not nominal everywhere.
    pub fn varying(&self, spec: &Spec) -> Vec<usize> {
        let mut varying = match self {
            Self::Presented(Presentation { tool_points, .. }) => {
                let nominal = |axis: &Axis| spec.parameters[axis.index].value;
                let varies = |axis: &&Axis| axis.values.iter().any(|value| *value != nominal(axis));
                tool_points.iter().filter(varies).map(|axis| axis.index).collect()
            }
            Self::Path(path) => path.parameters().collect(),
            _ => Vec::new(),
        };
        varying.sort_unstable();
        varying
    }

    /// The workspace in a sentence.
    pub fn describe(&self, spec: &Spec) -> String {
        let variable = |i: &usize| spec.variables[*i].name.as_str();
        match self {
            Self::Presented(Presentation { point, tool_points, approaches, solved }) => {
                let sizes = |axes: &[Axis]| axes.iter().map(|axis| axis.values.len()).product::<usize>();
                let parameters = tool_points.iter().map(|axis| spec.parameters[axis.index].name.as_str());
                let held = approaches.iter().map(|axis| variable(&axis.index));
                let [x, y, z] = point.map(number::short);
                format!(
                    "{} tool points ({}) in {} approaches ({}), each brought to ({x}, {y}, {z}) {} by {}",
                    sizes(tool_points),
                    names(parameters),
                    sizes(approaches),
                    names(held),
                    spec.length.symbol(),
                    names(solved.iter().map(variable)),
                )
            }
            Self::Grid(axes) => {
                let axes =
                    axes.iter().map(|axis| format!("{} × {}", axis.values.len(), variable(&axis.index)));
                format!("grid of {}", names(axes))
            }
            Self::Samples { moved, count, seed } => {
                let random = if seed.is_some() { "random " } else { "" };
                format!(
                    "{count} {random}samples of {} within their limits",
                    names(moved.iter().map(variable))
                )
            }
            Self::Box(BaseBox { points, orientation, solved }) => {
                let [x, y, z] = points.each_ref().map(Vec::len);
                let turned = match orientation {
                    ToolOrientation::Free => "in any orientation",
                    ToolOrientation::Home => "in the orientation of home",
                };
                let solved = names(solved.iter().map(variable));
                format!("box of {x} × {y} × {z} points in F_0, each reached {turned} by {solved}")
            }
            Self::Path(path) => {
                format!("{} configurations of {}", path.configurations.len(), path.file)
            }
        }
    }
}

fn names(names: impl Iterator<Item = impl Into<String>>) -> String {
    let names = names.map(Into::into).collect::<Vec<_>>();
    if names.is_empty() { "nothing".to_owned() } else { names.join(", ") }
}
