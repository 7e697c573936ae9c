//! The table of functions: name, arguments, results and documentation of each, and the arrays that they take and fill.
//!
//! Everything else that names a function is derived from it: [`Function`](crate::Function) and its
//! [`Signature`](super::Signature), the checked functions of generated modules, functions as types for lanes, and through
//! signatures the printers, the interpreter, batches, laws and the Python module. A new function is an entry here, its nodes
//! in `chain::Model`, and an arm wherever the compiler then asks for one.

/// Hands every function to the macro `$then`, behind an identifier that is passed on.
///
/// `oriented` functions have rows 4–6 as the manipulator's orientation says. A second text is for Rust alone.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_function {
    ($then:path $(, $passed_on:ident)?) => {
        $then! {
            $($passed_on)?:

            Transforms = transforms(q, s) -> (transforms):
                "`A_1 … A_n` and the tool `T`, each by itself: columns x, y, z axis and position.";

            Pose = pose(q, s) -> (pose):
                "Pose of the tool point in `F_0`: columns x, y, z axis and position.";

            ErrorJacobian = error_jacobian(q, s) -> (pose, error_columns) oriented:
                "Pose and error Jacobian `J_e`: six columns per frame, frame 1 first.";

            JointJacobian = joint_jacobian(q, s) -> (pose, joint_columns) oriented:
                "Pose and joint Jacobian `∂X_T/∂q`: one column per variable.";

            ParameterJacobian = parameter_jacobian(q, s) -> (pose, parameter_columns) oriented:
                "Pose and `∂X_T/∂s`: one column per structural parameter.";

            Effects = effects(q, s, u) -> (effects):
                "The errors that the sources cause, one per entry of the description's effects.";

            GeneralizedErrors = generalized_errors(q, s, u) -> (errors):
                "ε of the repeatable sources: `e_x e_y e_z e_s e_r e_p` of each frame.";

            ErrorJacobianDistinct = error_jacobian_distinct(q, s) -> (pose, distinct) oriented:
                "Pose and what of `J_e` is neither zero nor repeated: of each frame its x, y and z axis, then the moments (rows \
                 1–3) of `e_s e_r e_p`, and where rows are Euler angles their rows 4–6. `abbe::distinct` makes the columns of \
                 it.";

            Displacement = displacement(q, s, errors) -> (displacement) oriented:
                "`ΔX = J_e ε` for any ε, `e_x e_y e_z e_s e_r e_p` of each frame: rows as those of a Jacobian.";

            Covariance = covariance(q, s, variances) -> (covariance) oriented:
                "`J_e diag(σ²) J_eᵀ`, column-major, for the variance of each error of each frame, in the order of ε.",
                "Exact to rounding errors of the largest variance of its three axes: one that ought to be 0 can come out that \
                 much below it.";

            PredictedDisplacement = predicted_displacement(q, s, u) -> (displacement) oriented:
                "`ΔX = J_e ε` of the repeatable sources: rows as those of a Jacobian.";

            SourceDisplacements = source_displacements(q, s, u) -> (displacements) oriented:
                "`ΔX` of each source by itself, of a random one for its magnitude: rows as those of a Jacobian.";

            RealPose = real_pose(q, s, u) -> (pose):
                "Pose of the tool point in `F_0` with the errors of the repeatable sources, exactly: `A_1 E_1 … A_n E_n T`.";

            DrawnPose = drawn_pose(q, s, u, magnitudes) -> (pose):
                "Pose of the tool point in `F_0` with the errors of every source times a magnitude of its own, exactly: numbers \
                 of `A_i` as they are, errors elsewhere on its link, then those of the frame.";

            CompensatorStep = compensator_step(q, s, u) -> (pose, joint_columns):
                "The pose of `real_pose`, and the nominal `J_q` with rotation-vector rows: one column per variable.",
                "A step towards a pose `X*` is `δq = J_q⁺ (X* ⊖ X_real)`, with the rows of [`deviation`](::abbe::deviation) \
                 from the real pose to `X*`.";
        }
    };
}

/// Hands an array to the macro `$then`: its name in generated code, what it holds, its shape as a type of Rust, the units of
/// its numbers, and what they are, in which order and frame.
#[doc(hidden)]
#[macro_export]
macro_rules! function_array {
    (q: $($then:tt)+) => {
        $($then)+!("q", Variables, [f64; VARIABLES], "length unit, rad", "The joint variables.")
    };
    (s: $($then:tt)+) => {
        $($then)+!("s", Parameters, [f64; PARAMETERS], "coherent", "The structural parameters.")
    };
    (u: $($then:tt)+) => {
        $($then)+!("u", Inputs, [f64; INPUTS], "coherent", "The inputs.")
    };
    (errors: $($then:tt)+) => {
        $crate::function_array!(by_frame "errors", "length unit, rad": $($then)+)
    };
    (variances: $($then:tt)+) => {
        $crate::function_array!(by_frame "variances", "squares of the length unit, rad²": $($then)+)
    };
    (by_frame $name:literal, $unit:literal: $($then:tt)+) => {
        $($then)+!(
            $name,
            Errors,
            [[f64; 6]; FRAMES],
            $unit,
            "Six per frame, in the order of ε: `e_x e_y e_z e_s e_r e_p`, frame 1 first."
        )
    };
    (magnitudes: $($then:tt)+) => {
        $($then)+!(
            "magnitudes",
            Magnitudes,
            [f64; SOURCES],
            "1",
            "What the errors of each source are multiplied with: 1 of a repeatable source, of a random one what was drawn."
        )
    };
    (transforms: $($then:tt)+) => {
        $($then)+!(
            "transforms",
            Pose,
            [[[f64; 3]; 4]; FRAMES + 1],
            "length unit",
            "`A_i` from `F_i` to `F_{i-1}`, frame 1 first, the tool last."
        )
    };
    (pose: $($then:tt)+) => {
        $($then)+!(
            "pose",
            Pose,
            [[f64; 3]; 4],
            "length unit",
            "Columns x, y, z axis and position in `F_0`."
        )
    };
    (error_columns: $($then:tt)+) => {
        $crate::function_array!(columns ERRORS: $($then)+)
    };
    (joint_columns: $($then:tt)+) => {
        $crate::function_array!(columns VARIABLES: $($then)+)
    };
    (parameter_columns: $($then:tt)+) => {
        $crate::function_array!(columns PARAMETERS: $($then)+)
    };
    (columns $count:ident: $($then:tt)+) => {
        $($then)+!(
            "columns",
            Jacobian,
            [[f64; 6]; $count],
            "length unit or rad, per length unit or rad",
            "Columns of six rows: the tool point in `F_0`, then its orientation."
        )
    };
    (distinct: $($then:tt)+) => {
        $($then)+!(
            "distinct",
            Jacobian,
            [[[f64; 3]; DISTINCT]; FRAMES],
            "length unit or 1 per length unit or rad",
            "The distinct vectors of each frame, frame 1 first."
        )
    };
    (effects: $($then:tt)+) => {
        $($then)+!(
            "effects",
            Effects,
            [f64; EFFECTS],
            "length unit, rad",
            "Of a repeatable source the error, of a random one its magnitude."
        )
    };
    (displacement: $($then:tt)+) => {
        $($then)+!(
            "displacement",
            Displacement,
            [f64; 6],
            "length unit, rad",
            "ΔX of the tool point in `F_0`: real minus ideal."
        )
    };
    (displacements: $($then:tt)+) => {
        $($then)+!(
            "displacements",
            Displacement,
            [[f64; 6]; SOURCES],
            "length unit, rad",
            "ΔX of the tool point in `F_0`, source by source."
        )
    };
    (covariance: $($then:tt)+) => {
        $($then)+!(
            "covariance",
            Displacement,
            [[f64; 6]; 6],
            "products of the length unit and rad",
            "Of ΔX at the tool point in `F_0`: rows and columns as the rows of a Jacobian."
        )
    };
    (corrected: $($then:tt)+) => {
        $($then)+!(
            "corrected",
            Variables,
            [f64; VARIABLES],
            "length unit, rad",
            "The commands to be given instead, in the order of `q`."
        )
    };
    (before: $($then:tt)+) => {
        $($then)+!(
            "before",
            Displacement,
            [f64; 6],
            "length unit, rad",
            "ΔX at `q`, real minus ideal: the tool point in `F_0`, then the rotation vector."
        )
    };
    (after: $($then:tt)+) => {
        $($then)+!("after", Displacement, [f64; 6], "length unit, rad", "ΔX at `corrected`, as `before`.")
    };
}

/// The [`Signature`](super::Signature) of an entry.
macro_rules! signature {
    ($name:ident($($argument:ident),+) -> ($($result:ident),+) $($oriented:ident)?: $documentation:literal) => {
        $crate::function::Signature {
            name: stringify!($name),
            documentation: $documentation,
            arguments: &[$($crate::function_array!($argument: $crate::function::table::constant)),+],
            results: &[$($crate::function_array!($result: $crate::function::table::constant)),+],
            oriented: $crate::function::table::is_oriented!($($oriented)?),
        }
    };
}

/// Whether a function is `oriented`.
macro_rules! is_oriented {
    () => {
        false
    };
    (oriented) => {
        true
    };
}

/// The [`Array`](super::Array) of an entry.
macro_rules! constant {
    ($name:literal, $quantity:ident, $shape:tt, $unit:literal, $documentation:literal) => {
        $crate::function::Array {
            name: $name,
            quantity: $crate::Quantity::$quantity,
            shape: $crate::function::table::counts!($shape),
            unit: $unit,
            documentation: $documentation,
        }
    };
}

/// The dimensions of a type, the outermost first.
macro_rules! counts {
    ([[[f64; $($third:tt)+]; $($second:tt)+]; $($first:tt)+]) => {
        &[
            $crate::function::table::count!($($first)+),
            $crate::function::table::count!($($second)+),
            $crate::function::table::count!($($third)+),
        ]
    };
    ([[f64; $($second:tt)+]; $($first:tt)+]) => {
        &[$crate::function::table::count!($($first)+), $crate::function::table::count!($($second)+)]
    };
    ([f64; $($first:tt)+]) => {
        &[$crate::function::table::count!($($first)+)]
    };
}

/// A dimension by the constant that generated modules have for it.
macro_rules! count {
    (FRAMES) => {
        $crate::function::Count::Frames
    };
    (FRAMES + 1) => {
        $crate::function::Count::FramesAndTool
    };
    (ERRORS) => {
        $crate::function::Count::Errors
    };
    (DISTINCT) => {
        $crate::function::Count::Distinct
    };
    (VARIABLES) => {
        $crate::function::Count::Variables
    };
    (PARAMETERS) => {
        $crate::function::Count::Parameters
    };
    (INPUTS) => {
        $crate::function::Count::Inputs
    };
    (EFFECTS) => {
        $crate::function::Count::Effects
    };
    (SOURCES) => {
        $crate::function::Count::Sources
    };
    ($exactly:literal) => {
        $crate::function::Count::Exactly($exactly)
    };
}

pub(crate) use {constant, count, counts, is_oriented, signature};

/// What generated code has as `compensated`: not a function of nodes, but steps on two of them, `pose` and `compensator_step`, as
/// [`compensator`](crate::compensator) takes them.
///
/// Behind its results it says whether it converged: [`CONVERGED`].
pub const COMPENSATED: super::Signature = signature!(
    compensated(q, s, u) -> (corrected, before, after):
        "Commands that put the real tool where the ideal one is at `q`, within the limits of the variables: a fixed number of \
         steps. Where not all can be had the tool point comes first."
);

/// What it means that corrected commands have converged.
pub const CONVERGED: &str = "Whether the steps came to rest. If not, more of them were needed, at a limit or near a singular pose; \
                             `corrected` is the best that was seen.";
