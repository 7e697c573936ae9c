//! The functions of a manipulator: what each takes and gives, as its [`Signature`] says.
//!
//! `table` has an entry for each of them, which all else is derived from.

mod table;

pub use table::{COMPENSATED, CONVERGED};

use crate::{Description, Orientation, Quantity};

macro_rules! functions {
    (: $($function:ident = $name:ident($($argument:ident),+) -> ($($result:ident),+) $($oriented:ident)?:
        $documentation:literal $(, $note:literal)?;)+) => {
        /// A function of a manipulator: what is generated, interpreted, and evaluated in batches.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Function {
            $(#[doc = $documentation] $function,)+
        }

        impl Function {
            /// All of them, in the order in which they are generated.
            pub const ALL: [Self; [$(Self::$function),+].len()] = [$(Self::$function),+];

            /// What it takes and gives.
            pub const fn signature(self) -> &'static Signature {
                match self {
                    $(Self::$function => &table::signature!(
                        $name($($argument),+) -> ($($result),+) $($oriented)?: $documentation
                    ),)+
                }
            }
        }
    };
}

crate::for_each_function!(functions);

/// What a function takes and gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Its name in generated code.
    pub name: &'static str,
    /// What it computes, in one or two sentences.
    pub documentation: &'static str,
    /// What it takes, in this order.
    pub arguments: &'static [Array],
    /// What it fills, in this order.
    pub results: &'static [Array],
    /// Whether rows 4–6 of its results are as the manipulator's [`Orientation`] says. Where they are Euler angles it gives
    /// one number more behind its results, the margin `cos ρ`: where that is 0 there are no rows 4–6.
    pub oriented: bool,
}

/// An array that a function takes or fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Array {
    /// Its name in generated code.
    pub name: &'static str,
    /// What it holds, for errors that are about it.
    pub quantity: Quantity,
    /// Its dimensions, the outermost first: a column-major 6 × 6n Jacobian is `[Errors, Exactly(6)]`.
    pub shape: &'static [Count],
    /// The units of its numbers.
    pub unit: &'static str,
    /// What its numbers are, in which order and frame.
    pub documentation: &'static str,
}

/// A dimension of an array: how many of something there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// So many of any manipulator.
    Exactly(usize),
    /// Its frames: n.
    Frames,
    /// Its frames and the tool: n + 1.
    FramesAndTool,
    /// Its base, its frames and the tool: n + 2.
    BaseToTool,
    /// Its generalized errors: 6n.
    Errors,
    /// Vectors of a frame's six columns of `J_e` that are neither zero nor repeated: see [`distinct`](crate::distinct).
    Distinct,
    /// Its joint variables.
    Variables,
    /// Its structural parameters.
    Parameters,
    /// Its inputs.
    Inputs,
    /// The errors that its sources cause.
    Effects,
    /// Its enabled sources.
    Sources,
}

impl Function {
    /// Its name in generated code.
    pub const fn name(self) -> &'static str {
        self.signature().name
    }
}

impl Signature {
    /// How many numbers it takes.
    pub fn arguments_len(&self, description: &Description) -> usize {
        self.arguments.iter().map(|array| array.len(description)).sum()
    }

    /// How many numbers it gives, the margin included.
    pub fn results_len(&self, description: &Description) -> usize {
        let results: usize = self.results.iter().map(|array| array.len(description)).sum();
        results + usize::from(self.has_margin(description.orientation))
    }

    /// Whether it gives the margin `cos ρ` behind its results.
    pub const fn has_margin(&self, orientation: Orientation) -> bool {
        self.oriented && matches!(orientation, Orientation::EulerYzx)
    }
}

impl Array {
    /// How many numbers it holds.
    pub fn len(&self, description: &Description) -> usize {
        self.shape.iter().map(|count| count.value(description)).product()
    }

    /// Whether it holds nothing for this manipulator.
    pub fn is_empty(&self, description: &Description) -> bool {
        self.len(description) == 0
    }
}

impl Count {
    /// How many there are of this manipulator.
    pub fn value(self, description: &Description) -> usize {
        match self {
            Self::Exactly(count) => count,
            Self::Frames => description.frames.len(),
            Self::FramesAndTool => description.frames.len() + 1,
            Self::BaseToTool => description.frames.len() + 2,
            Self::Errors => 6 * description.frames.len(),
            Self::Distinct => crate::distinct::vectors(description.orientation),
            Self::Variables => description.variables.len(),
            Self::Parameters => description.parameters.len(),
            Self::Inputs => description.inputs.len(),
            Self::Effects => description.effects.len(),
            Self::Sources => description.sources.len(),
        }
    }
}
