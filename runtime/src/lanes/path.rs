//! What can be computed for many configurations at once.

use super::Tiles;
use crate::{Description, Error, Orientation, Quantity};

/// A function of a batch: what it takes from each configuration, and what it gives.
///
/// Arguments are the rows q, s, u, one after the other, and for [`Displacement`](Self::Displacement) and
/// [`Covariance`](Self::Covariance) six more per frame. Results are rows in the order of the array that the function
/// of that name fills; where rows 4–6 are Euler angles, all but [`Pose`](Self::Pose) give one row more, `cos ρ`: where
/// it is 0 there are no rows 4–6.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// The pose of the tool point: 12.
    Pose,
    /// Pose and `J_e`: 12 + 36 n.
    ErrorJacobian,
    /// Pose and the numbers of `J_e` that are not zero or repeated: 12 + 18 n, with Euler angles 12 + 27 n.
    DistinctErrorJacobian,
    /// `ΔX = J_e ε` of any ε: 6.
    Displacement,
    /// ΔX of the repeatable sources: 6.
    PredictedDisplacement,
    /// ΔX of each source by itself, of a random one for its magnitude: 6 per source.
    SourceDisplacements,
    /// `J_e diag(σ²) J_eᵀ` of any variances of ε: 36.
    Covariance,
}

impl Path {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Pose,
        Self::ErrorJacobian,
        Self::DistinctErrorJacobian,
        Self::Displacement,
        Self::PredictedDisplacement,
        Self::SourceDisplacements,
        Self::Covariance,
    ];

    /// The name of the generated function.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pose => "pose",
            Self::ErrorJacobian => "error_jacobian",
            Self::DistinctErrorJacobian => "error_jacobian_distinct",
            Self::Displacement => "displacement",
            Self::PredictedDisplacement => "predicted_displacement",
            Self::SourceDisplacements => "source_displacements",
            Self::Covariance => "covariance",
        }
    }

    /// How many rows of arguments it takes.
    pub fn arguments(self, description: &Description) -> usize {
        let Description { variables, parameters, inputs, frames, .. } = description;
        let errors = match self {
            Self::Displacement | Self::Covariance => 6 * frames.len(),
            _ => 0,
        };
        variables.len() + parameters.len() + inputs.len() + errors
    }

    /// How many rows of results it gives.
    pub fn results(self, description: &Description) -> usize {
        let euler = usize::from(description.orientation == Orientation::EulerYzx);
        let frames = description.frames.len();
        match self {
            Self::Pose => 12,
            Self::ErrorJacobian => 12 + 36 * frames + euler,
            Self::DistinctErrorJacobian => 12 + (18 + 9 * euler) * frames + euler,
            Self::Displacement | Self::PredictedDisplacement => 6 + euler,
            Self::SourceDisplacements => 6 * description.sources.len() + euler,
            Self::Covariance => 36 + euler,
        }
    }

    /// [`Error::Count`] unless arguments and results have the rows of this function, as many configurations as each
    /// other, and the layout of one instruction set.
    pub fn check(self, description: &Description, arguments: &Tiles, results: &Tiles) -> Result<(), Error> {
        for (quantity, expected, found) in [
            (Quantity::Arguments, self.arguments(description), arguments.rows()),
            (Quantity::Results, self.results(description), results.rows()),
            (Quantity::Configurations, arguments.count(), results.count()),
            (Quantity::Lanes, arguments.instruction_set().width(), results.instruction_set().width()),
        ] {
            if expected != found {
                return Err(Error::Count { quantity, expected, found });
            }
        }
        Ok(())
    }
}
