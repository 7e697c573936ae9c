//! The signature of a function: its arguments and results as arrays.

use crate::{Description, Orientation, Quantity};

/// Arguments and results of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Name in generated code.
    pub name: &'static str,
    /// Description in one or two sentences.
    pub documentation: &'static str,
    /// Arguments, in order.
    pub arguments: &'static [Array],
    /// Results, in order.
    pub results: &'static [Array],
    /// `true` if rows 4–6 of the results depend on the manipulator's [`Orientation`]. If they are
    /// Euler angles, the function returns one more number after its results, the margin `cos ρ`;
    /// rows 4–6 are undefined where it is 0.
    pub oriented: bool,
}

/// Array that a function takes or fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Array {
    /// Name in generated code.
    pub name: &'static str,
    /// Quantity, for error messages.
    pub quantity: Quantity,
    /// Dimensions, the outermost first: a column-major 6 × 6n Jacobian is `[Errors, Exactly(6)]`.
    pub shape: &'static [Count],
    /// Units of the numbers.
    pub unit: &'static str,
    /// Meaning of the numbers, their order and frame.
    pub documentation: &'static str,
}

/// Dimension of an array: a constant, or a count of the manipulator's parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Constant, independent of the manipulator.
    Exactly(usize),
    /// Frames: n.
    Frames,
    /// Frames and the tool: n + 1.
    FramesAndTool,
    /// Base, frames and the tool: n + 2.
    BaseToTool,
    /// Generalized errors: 6n.
    Errors,
    /// Vectors of a frame's six columns of `J_e` that are neither zero nor repeated, see
    /// [`distinct`](crate::distinct).
    Distinct,
    /// Joint variables.
    Variables,
    /// Passive variables.
    Passive,
    /// Structural parameters.
    Parameters,
    /// Inputs.
    Inputs,
    /// Effects of the sources.
    Effects,
    /// Enabled sources.
    Sources,
    /// Solutions of inverse kinematics.
    Solutions,
}

impl Signature {
    /// Returns the number of values in all arguments.
    pub fn arguments_len(&self, description: &Description) -> usize {
        self.arguments.iter().map(|array| array.len(description)).sum()
    }

    /// Returns the number of values in all results, including the margin.
    pub fn results_len(&self, description: &Description) -> usize {
        let results: usize = self.results.iter().map(|array| array.len(description)).sum();
        results + usize::from(self.has_margin(description.orientation))
    }

    /// Returns whether the function returns the margin, such as `cos ρ`, after its results.
    pub const fn has_margin(&self, orientation: Orientation) -> bool {
        self.oriented && orientation.last_axis().is_some()
    }
}

impl Array {
    /// Returns the number of values.
    pub fn len(&self, description: &Description) -> usize {
        self.shape.iter().map(|count| count.value(description)).product()
    }

    /// Returns the number of rows, and of values in each.
    pub fn rows(&self, description: &Description) -> [usize; 2] {
        let value = |count: &Count| count.value(description);
        [self.shape.first().map_or(0, value), self.shape.iter().skip(1).map(value).product()]
    }

    /// Returns whether the array is empty for this manipulator.
    pub fn is_empty(&self, description: &Description) -> bool {
        self.len(description) == 0
    }
}

/// The counts by their constants in generated modules.
impl Count {
    pub(crate) const FRAMES: Self = Self::Frames;
    pub(crate) const ERRORS: Self = Self::Errors;
    pub(crate) const DISTINCT: Self = Self::Distinct;
    pub(crate) const VARIABLES: Self = Self::Variables;
    pub(crate) const PASSIVE: Self = Self::Passive;
    pub(crate) const PARAMETERS: Self = Self::Parameters;
    pub(crate) const INPUTS: Self = Self::Inputs;
    pub(crate) const EFFECTS: Self = Self::Effects;
    pub(crate) const SOURCES: Self = Self::Sources;
    pub(crate) const SOLUTIONS: Self = Self::Solutions;
}

impl Count {
    /// Returns the value of the dimension for a manipulator.
    pub fn value(self, description: &Description) -> usize {
        match self {
            Self::Exactly(count) => count,
            Self::Frames => description.frames.len(),
            Self::FramesAndTool => description.frames.len() + 1,
            Self::BaseToTool => description.frames.len() + 2,
            Self::Errors => 6 * description.frames.len(),
            Self::Distinct => crate::distinct::vectors_of(description),
            Self::Variables => description.variables.len(),
            Self::Passive => description.passive().count(),
            Self::Parameters => description.parameters.len(),
            Self::Inputs => description.inputs.len(),
            Self::Effects => description.effects.len(),
            Self::Sources => description.sources.len(),
            Self::Solutions => description.solutions,
        }
    }
}
