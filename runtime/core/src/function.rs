//! The functions of a manipulator, and what each takes and gives: told once, here.
//!
//! Printers, the interpreter, batches and laws read the [`Signature`] of a [`Function`]; none of them tells it again.

use crate::{Description, Orientation, Quantity};

/// A function of a manipulator: what is generated, interpreted, and evaluated in batches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// `A_1 … A_n` and the tool `T`, each by itself.
    Transforms,
    /// The pose of the tool point.
    Pose,
    /// Pose and error Jacobian `J_e = ∂X_T/∂ε`.
    ErrorJacobian,
    /// Pose and joint Jacobian `J_q = ∂X_T/∂q`.
    JointJacobian,
    /// Pose and `∂X_T/∂s`.
    ParameterJacobian,
    /// The errors that the sources cause, one by one.
    Effects,
    /// ε of the repeatable sources.
    GeneralizedErrors,
    /// Pose and what of `J_e` is neither zero nor repeated.
    ErrorJacobianDistinct,
    /// `ΔX = J_e ε` for any ε.
    Displacement,
    /// `J_e diag(σ²) J_eᵀ` for any σ².
    Covariance,
    /// `ΔX = J_e ε` of the repeatable sources.
    PredictedDisplacement,
    /// `ΔX` of each source by itself.
    SourceDisplacements,
    /// The pose of the tool point with the errors of the repeatable sources, exactly.
    RealPose,
    /// The same with the errors of all sources, each times a magnitude.
    DrawnPose,
    /// The real pose and the nominal `J_q` with rotation-vector rows.
    CompensatorStep,
}

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
    /// All of them, in the order in which they are generated.
    pub const ALL: [Self; 15] = [
        Self::Transforms,
        Self::Pose,
        Self::ErrorJacobian,
        Self::JointJacobian,
        Self::ParameterJacobian,
        Self::Effects,
        Self::GeneralizedErrors,
        Self::ErrorJacobianDistinct,
        Self::Displacement,
        Self::Covariance,
        Self::PredictedDisplacement,
        Self::SourceDisplacements,
        Self::RealPose,
        Self::DrawnPose,
        Self::CompensatorStep,
    ];

    /// Its name in generated code.
    pub const fn name(self) -> &'static str {
        self.signature().name
    }

    /// What it takes and gives.
    pub const fn signature(self) -> &'static Signature {
        match self {
            Self::Transforms => &Signature {
                name: "transforms",
                documentation: "`A_1 … A_n` and the tool `T`, each by itself: columns x, y, z axis and position.",
                arguments: &[Q, S],
                results: &[Array {
                    name: "transforms",
                    quantity: Quantity::Pose,
                    shape: &[Count::FramesAndTool, Count::Exactly(4), Count::Exactly(3)],
                    unit: "length unit",
                    documentation: "`A_i` from `F_i` to `F_{i-1}`, frame 1 first, the tool last.",
                }],
                oriented: false,
            },
            Self::Pose => &Signature {
                name: "pose",
                documentation: "Pose of the tool point in `F_0`: columns x, y, z axis and position.",
                arguments: &[Q, S],
                results: &[POSE],
                oriented: false,
            },
            Self::ErrorJacobian => &Signature {
                name: "error_jacobian",
                documentation: "Pose and error Jacobian `J_e`: six columns per frame, frame 1 first.",
                arguments: &[Q, S],
                results: &[POSE, ERROR_COLUMNS],
                oriented: true,
            },
            Self::JointJacobian => &Signature {
                name: "joint_jacobian",
                documentation: "Pose and joint Jacobian `∂X_T/∂q`: one column per variable.",
                arguments: &[Q, S],
                results: &[POSE, JOINT_COLUMNS],
                oriented: true,
            },
            Self::ParameterJacobian => &Signature {
                name: "parameter_jacobian",
                documentation: "Pose and `∂X_T/∂s`: one column per structural parameter.",
                arguments: &[Q, S],
                results: &[POSE, PARAMETER_COLUMNS],
                oriented: true,
            },
            Self::Effects => &Signature {
                name: "effects",
                documentation: "The errors that the sources cause, one per entry of the description's effects.",
                arguments: &[Q, S, U],
                results: &[Array {
                    name: "effects",
                    quantity: Quantity::Effects,
                    shape: &[Count::Effects],
                    unit: "length unit, rad",
                    documentation: "Of a repeatable source the error, of a random one its magnitude.",
                }],
                oriented: false,
            },
            Self::GeneralizedErrors => &Signature {
                name: "generalized_errors",
                documentation: "ε of the repeatable sources: `e_x e_y e_z e_s e_r e_p` of each frame.",
                arguments: &[Q, S, U],
                results: &[ERRORS],
                oriented: false,
            },
            Self::ErrorJacobianDistinct => &Signature {
                name: "error_jacobian_distinct",
                documentation: "Pose and what of `J_e` is neither zero nor repeated: of each frame its x, y and z axis, \
                                then the moments (rows 1–3) of `e_s e_r e_p`, and where rows are Euler angles their rows \
                                4–6. `abbe::distinct` makes the columns of it.",
                arguments: &[Q, S],
                results: &[
                    POSE,
                    Array {
                        name: "distinct",
                        quantity: Quantity::Jacobian,
                        shape: &[Count::Frames, Count::Distinct, Count::Exactly(3)],
                        unit: "length unit or 1 per length unit or rad",
                        documentation: "The distinct vectors of each frame, frame 1 first.",
                    },
                ],
                oriented: true,
            },
            Self::Displacement => &Signature {
                name: "displacement",
                documentation: "`ΔX = J_e ε` for any ε, `e_x e_y e_z e_s e_r e_p` of each frame: rows as those of a Jacobian.",
                arguments: &[Q, S, ERRORS],
                results: &[DISPLACEMENT],
                oriented: true,
            },
            Self::Covariance => &Signature {
                name: "covariance",
                documentation: "`J_e diag(σ²) J_eᵀ`, column-major, for the variance of each error of each frame, in the order of ε.",
                arguments: &[Q, S, VARIANCES],
                results: &[Array {
                    name: "covariance",
                    quantity: Quantity::Displacement,
                    shape: &[Count::Exactly(6), Count::Exactly(6)],
                    unit: "products of the length unit and rad",
                    documentation: "Of ΔX at the tool point in `F_0`: rows and columns as the rows of a Jacobian.",
                }],
                oriented: true,
            },
            Self::PredictedDisplacement => &Signature {
                name: "predicted_displacement",
                documentation: "`ΔX = J_e ε` of the repeatable sources: rows as those of a Jacobian.",
                arguments: &[Q, S, U],
                results: &[DISPLACEMENT],
                oriented: true,
            },
            Self::SourceDisplacements => &Signature {
                name: "source_displacements",
                documentation: "`ΔX` of each source by itself, of a random one for its magnitude: rows as those of a Jacobian.",
                arguments: &[Q, S, U],
                results: &[Array {
                    name: "displacements",
                    quantity: Quantity::Displacement,
                    shape: &[Count::Sources, Count::Exactly(6)],
                    unit: "length unit, rad",
                    documentation: "ΔX of the tool point in `F_0`, source by source.",
                }],
                oriented: true,
            },
            Self::RealPose => &Signature {
                name: "real_pose",
                documentation: "Pose of the tool point in `F_0` with the errors of the repeatable sources, exactly: \
                                `A_1 E_1 … A_n E_n T`.",
                arguments: &[Q, S, U],
                results: &[POSE],
                oriented: false,
            },
            Self::DrawnPose => &Signature {
                name: "drawn_pose",
                documentation: "Pose of the tool point in `F_0` with the errors of every source times a magnitude of its \
                                own, exactly: numbers of `A_i` as they are, errors elsewhere on its link, then those of the \
                                frame.",
                arguments: &[Q, S, U, MAGNITUDES],
                results: &[POSE],
                oriented: false,
            },
            Self::CompensatorStep => &Signature {
                name: "compensator_step",
                documentation: "The pose of `real_pose`, and the nominal `J_q` with rotation-vector rows: one column per variable.",
                arguments: &[Q, S, U],
                results: &[POSE, JOINT_COLUMNS],
                oriented: false,
            },
        }
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

const Q: Array = Array {
    name: "q",
    quantity: Quantity::Variables,
    shape: &[Count::Variables],
    unit: "length unit, rad",
    documentation: "The joint variables.",
};

const S: Array = Array {
    name: "s",
    quantity: Quantity::Parameters,
    shape: &[Count::Parameters],
    unit: "coherent",
    documentation: "The structural parameters.",
};

const U: Array = Array {
    name: "u",
    quantity: Quantity::Inputs,
    shape: &[Count::Inputs],
    unit: "coherent",
    documentation: "The inputs.",
};

const MAGNITUDES: Array = Array {
    name: "magnitudes",
    quantity: Quantity::Magnitudes,
    shape: &[Count::Sources],
    unit: "1",
    documentation: "What the errors of each source are multiplied with: 1 of a repeatable source, of a random one what \
                    was drawn.",
};

const POSE: Array = Array {
    name: "pose",
    quantity: Quantity::Pose,
    shape: &[Count::Exactly(4), Count::Exactly(3)],
    unit: "length unit",
    documentation: "Columns x, y, z axis and position in `F_0`.",
};

const DISPLACEMENT: Array = Array {
    name: "displacement",
    quantity: Quantity::Displacement,
    shape: &[Count::Exactly(6)],
    unit: "length unit, rad",
    documentation: "ΔX of the tool point in `F_0`: real minus ideal.",
};

const ERROR_COLUMNS: Array = columns(&[Count::Errors, Count::Exactly(6)]);
const JOINT_COLUMNS: Array = columns(&[Count::Variables, Count::Exactly(6)]);
const PARAMETER_COLUMNS: Array = columns(&[Count::Parameters, Count::Exactly(6)]);
const ERRORS: Array = errors("errors", "length unit, rad");
const VARIANCES: Array = errors("variances", "squares of the length unit, rad²");

const fn columns(shape: &'static [Count]) -> Array {
    Array {
        name: "columns",
        quantity: Quantity::Jacobian,
        shape,
        unit: "length unit or rad, per length unit or rad",
        documentation: "Columns of six rows: the tool point in `F_0`, then its orientation.",
    }
}

const fn errors(name: &'static str, unit: &'static str) -> Array {
    Array {
        name,
        quantity: Quantity::Errors,
        shape: &[Count::Frames, Count::Exactly(6)],
        unit,
        documentation: "Six per frame, in the order of ε: `e_x e_y e_z e_s e_r e_p`, frame 1 first.",
    }
}
