//! Table of functions: name, arguments, results and documentation of each, and the arrays that they
//! take and fill.
//!
//! All other mentions of functions are derived from this table: [`Function`](crate::Function) and
//! its [`Signature`](super::Signature), the checked functions of generated modules, functions as
//! types for lanes, and through signatures the printers, the interpreter, batches, laws and the
//! Python module. To add a function, add an entry here, its nodes in `chain::Model`, and the match
//! arms that the compiler then requires.

/// Passes groups of functions to the macro `$then`, after an optional identifier: `every` for those
/// of every manipulator, `loops` for those that only manipulators with loops have, `inverse` for
/// that of manipulators whose inverse kinematics has a closed form. The group named last comes
/// first.
///
/// The rows 4–6 of `oriented` functions depend on the manipulator's orientation. A second text is
/// for Rust only.
#[doc(hidden)]
#[macro_export]
macro_rules! for_functions {
    (@ [] $then:path, [$($passed_on:ident)?], { $($entries:tt)* }) => {
        $then! { $($passed_on)?: $($entries)* }
    };
    (@ [loops $($groups:ident)*] $then:path, $passed_on:tt, { $($others:tt)* }) => {
        $crate::for_functions! { @ [$($groups)*] $then, $passed_on, {
            Passive = passive(q, s) -> (passive):
                "Passive variables for which all loops close, reached continuously from home as `q` and `s` move from home to their \
                 values along a straight line.";

            DisplacedPose = displaced_pose(q, s, errors) -> (pose):
                "Exact pose of the tool point in `F_0` with given errors of the frames, all loops closed.";

            LegForces = leg_forces(q, s, u) -> (leg_forces):
                "Forces by which the loops close under the loads, to first order. The force of a leg is positive if it presses its \
                 ends apart.";

            $($others)*
        } }
    };
    (@ [inverse $($groups:ident)*] $then:path, $passed_on:tt, { $($others:tt)* }) => {
        $crate::for_functions! { @ [$($groups)*] $then, $passed_on, {
            Inverse = inverse(q, s, target) -> (solutions, found):
                "All joint variables that bring the tool point to a pose. They are in the turns nearest to `q` that the limits \
                 permit, and a joint that is free to move there stays as in `q`.",
                "A solution exists if its entry of `found` is 1; otherwise it is no solution.";

            $($others)*
        } }
    };
    (@ [every $($groups:ident)*] $then:path, $passed_on:tt, { $($others:tt)* }) => {
        $crate::for_functions! { @ [$($groups)*] $then, $passed_on, {
            Transforms = transforms(q, s) -> (transforms):
                "Local transforms `A_1 … A_n` and the tool `T`: columns x, y, z axis and position.";

            Pose = pose(q, s) -> (pose):
                "Pose of the tool point in `F_0`: columns x, y, z axis and position.";

            ErrorJacobian = error_jacobian(q, s) -> (pose, error_columns) oriented:
                "Pose and error Jacobian `J_e`: six columns per frame, frame 1 first.";

            JointJacobian = joint_jacobian(q, s) -> (pose, joint_columns) oriented:
                "Pose and joint Jacobian `∂X_T/∂q`: one column per variable.";

            ParameterJacobian = parameter_jacobian(q, s) -> (pose, parameter_columns) oriented:
                "Pose and `∂X_T/∂s`: one column per structural parameter.";

            Effects = effects(q, s, u) -> (effects):
                "Errors that each source causes, one per entry of the description's effects.";

            GeneralizedErrors = generalized_errors(q, s, u) -> (errors):
                "Generalized errors ε of the repeatable sources: `e_x e_y e_z` (along x, y, z) and `e_s e_r e_p` (about y, z, x) \
                 of each frame.";

            ErrorJacobianDistinct = error_jacobian_distinct(q, s) -> (pose, distinct) oriented:
                "Pose and the distinct entries of `J_e`, which are neither zero nor repeated: for each frame its x, y and z axis, \
                 then the moments (rows 1–3) of `e_s e_r e_p`, and for Euler angles their rows 4–6. `abbe::distinct` expands \
                 them to columns.";

            Displacement = displacement(q, s, errors) -> (displacement) oriented:
                "Displacement `ΔX = J_e ε` for any ε, with the rows of `J_e`.";

            Covariance = covariance(q, s, variances) -> (covariance) oriented:
                "Covariance `J_e diag(σ²) J_eᵀ` of ΔX, column-major, from the variance of each error of each frame, in the order \
                 of ε.",
                "Rounding errors are relative to the largest variance of the three axes: a variance that should be 0 can be \
                 negative by that much.";

            PredictedDisplacement = predicted_displacement(q, s, u) -> (displacement) oriented:
                "Displacement `ΔX = J_e ε` due to the repeatable sources, with the rows of `J_e`.";

            SourceDisplacements = source_displacements(q, s, u) -> (displacements) oriented:
                "Displacement ΔX due to each source alone, for a random source at its magnitude, with the rows of `J_e`.";

            RealPose = real_pose(q, s, u) -> (pose):
                "Exact pose of the tool point in `F_0` with the errors of the repeatable sources: `A_1 E_1 … A_n E_n T`.";

            DrawnPose = drawn_pose(q, s, u, magnitudes) -> (pose):
                "Exact pose of the tool point in `F_0` with the errors of every source times its magnitude. In each link the \
                 order is: deviations of the numbers of `A_i`, errors elsewhere on the link, errors of the frame.";

            CompensatorStep = compensator_step(q, s, u) -> (pose, joint_columns):
                "Pose of `real_pose`, and nominal `J_q` with rotation-vector rows: one column per variable.",
                "One step towards a pose `X*` is `δq = J_q⁺ (X* ⊖ X_real)`, where `⊖` is [`deviation`](::abbe::deviation) from \
                 the real pose to `X*`.";

            $($others)*
        } }
    };
    ($($groups:ident)+: $then:path $(, $passed_on:ident)?) => {
        $crate::for_functions! { @ [$($groups)+] $then, [$($passed_on)?], {} }
    };
}

/// Passes an array to the macro `$then`: its name in generated code, its quantity, its shape as a
/// Rust type, the units of its elements, and its documentation with order and frame.
#[doc(hidden)]
#[macro_export]
macro_rules! function_array {
    (q: $($then:tt)+) => {
        $($then)+!("q", Variables, [f64; VARIABLES], "length unit, rad", "Joint variables.")
    };
    (passive: $($then:tt)+) => {
        $($then)+!(
            "passive",
            Passive,
            [f64; PASSIVE],
            "length unit, rad",
            "Passive variables, in the order of the frames that declare them."
        )
    };
    (leg_forces: $($then:tt)+) => {
        $($then)+!(
            "leg_forces",
            Passive,
            [f64; PASSIVE],
            "N, N m",
            "One per equation of the loops, in their order: a leg's force, or the force along or moment about the axis of a \
             coordinate."
        )
    };
    (s: $($then:tt)+) => {
        $($then)+!("s", Parameters, [f64; PARAMETERS], "coherent", "Structural parameters.")
    };
    (u: $($then:tt)+) => {
        $($then)+!("u", Inputs, [f64; INPUTS], "coherent", "Inputs.")
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
            "Six per frame, frame 1 first, in the order of ε: `e_x e_y e_z` (along x, y, z), `e_s e_r e_p` (about y, z, x)."
        )
    };
    (magnitudes: $($then:tt)+) => {
        $($then)+!(
            "magnitudes",
            Magnitudes,
            [f64; SOURCES],
            "1",
            "Factor of the errors of each source: 1 for a repeatable source, a random number for a random source."
        )
    };
    (transforms: $($then:tt)+) => {
        $($then)+!(
            "transforms",
            Pose,
            [[[f64; 3]; 4]; FRAMES + 1],
            "length unit",
            "Transforms `A_i` from `F_i` to `F_{i-1}`, frame 1 first, tool last."
        )
    };
    (pose: $($then:tt)+) => {
        $($then)+!("pose", Pose, [[f64; 3]; 4], "length unit", "Columns x, y, z axis and position in `F_0`.")
    };
    (target: $($then:tt)+) => {
        $($then)+!(
            "target",
            Pose,
            [[f64; 3]; 4],
            "length unit",
            "Pose of the tool point: columns x, y, z axis and position in `F_0`."
        )
    };
    (solutions: $($then:tt)+) => {
        $($then)+!(
            "solutions",
            Solutions,
            [[f64; VARIABLES]; SOLUTIONS],
            "length unit, rad",
            "Joint variables, one row per solution."
        )
    };
    (found: $($then:tt)+) => {
        $($then)+!(
            "found",
            Solutions,
            [f64; SOLUTIONS],
            "1",
            "1 for a solution within the limits, 0 for a row that is none."
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
            "Columns of six rows: position of the tool point in `F_0`, then orientation."
        )
    };
    (distinct: $($then:tt)+) => {
        $($then)+!(
            "distinct",
            Jacobian,
            [[[f64; 3]; DISTINCT]; FRAMES],
            "length unit or 1 per length unit or rad",
            "Distinct vectors of each frame, frame 1 first."
        )
    };
    (effects: $($then:tt)+) => {
        $($then)+!(
            "effects",
            Effects,
            [f64; EFFECTS],
            "length unit, rad",
            "Error of a repeatable source, or magnitude of a random source."
        )
    };
    (displacement: $($then:tt)+) => {
        $crate::function_array!(deviation "displacement", "ΔX of the tool point in `F_0`, real minus ideal pose.": $($then)+)
    };
    (displacements: $($then:tt)+) => {
        $($then)+!(
            "displacements",
            Displacement,
            [[f64; 6]; SOURCES],
            "length unit, rad",
            "ΔX of the tool point in `F_0`, one row of six numbers per source."
        )
    };
    (covariance: $($then:tt)+) => {
        $($then)+!(
            "covariance",
            Displacement,
            [[f64; 6]; 6],
            "products of the length unit and rad",
            "Covariance of ΔX at the tool point in `F_0`, in the order of the rows of `J_e`."
        )
    };
    (corrected: $($then:tt)+) => {
        $crate::function_array!(of_variables "corrected", "Commands to use instead of `q`, in the same order.": $($then)+)
    };
    (last: $($then:tt)+) => {
        $crate::function_array!(of_corrections "last", "`correction` of the previous cycle; at first `last` of `begin`, or zeros.": $($then)+)
    };
    (change: $($then:tt)+) => {
        $crate::function_array!(of_corrections "change", "Largest change of each correction from `last`. A number that is not positive permits none.": $($then)+)
    };
    (largest: $($then:tt)+) => {
        $crate::function_array!(of_corrections "largest", "Largest size of each correction. A number that is not positive permits none.": $($then)+)
    };
    (rotations: $($then:tt)+) => {
        $($then)+!(
            "rotations",
            Rotations,
            [f64; 3],
            "1",
            "Weights of the rotations about the x, y and z axis of the tool: 1 to be reached, 0 to be left free. 1 1 1 is the \
             whole pose, 0 0 0 the position, 1 1 0 the position and the direction of the z axis."
        )
    };
    (correction: $($then:tt)+) => {
        $crate::function_array!(of_corrections "correction", "`corrected` minus `q`, or minus its nearest value within the limits: `last` of the next cycle.": $($then)+)
    };
    (before: $($then:tt)+) => {
        $crate::function_array!(deviation "before", "ΔX at `q`, real minus ideal pose: position of the tool point in `F_0`, then rotation vector.": $($then)+)
    };
    (after: $($then:tt)+) => {
        $crate::function_array!(deviation "after", "ΔX at `corrected`, in the form of `before`.": $($then)+)
    };
    (command: $($then:tt)+) => {
        $crate::function_array!(of_variables "command", "Command whose corrected one is `q`, in the same order.": $($then)+)
    };
    (first: $($then:tt)+) => {
        $crate::function_array!(of_corrections "last", "`q` minus `command`: `last` of the first cycle.": $($then)+)
    };
    (left: $($then:tt)+) => {
        $crate::function_array!(deviation "after", "ΔX of the ideal pose at `command`, minus the real one at `q`: position of the tool point in `F_0`, then rotation vector.": $($then)+)
    };
    (of_variables $name:literal, $documentation:literal: $($then:tt)+) => {
        $($then)+!($name, Variables, [f64; VARIABLES], "length unit, rad", $documentation)
    };
    (of_corrections $name:literal, $documentation:literal: $($then:tt)+) => {
        $($then)+!($name, Corrections, [f64; VARIABLES], "length unit, rad", $documentation)
    };
    (deviation $name:literal, $documentation:literal: $($then:tt)+) => {
        $($then)+!($name, Displacement, [f64; 6], "length unit, rad", $documentation)
    };
}

/// Expands to the [`Signature`](super::Signature) of an entry.
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

/// Expands to `true` for an `oriented` function.
macro_rules! is_oriented {
    () => {
        false
    };
    (oriented) => {
        true
    };
}

/// Expands to the [`Array`](super::Array) of an entry.
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

/// Expands to the dimensions of a type, the outermost first.
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

/// Expands to a dimension from its constant in generated modules.
macro_rules! count {
    (FRAMES + 1) => {
        $crate::function::Count::FramesAndTool
    };
    ($exactly:literal) => {
        $crate::function::Count::Exactly($exactly)
    };
    ($count:ident) => {
        $crate::function::Count::$count
    };
}

pub(crate) use {constant, count, counts, is_oriented, signature};

/// Signature of `compensated` in generated code. It is no function of nodes, but an iteration with
/// `pose` and `compensator_step`, as in [`compensator`](crate::compensator).
///
/// In addition to its results it returns a [`Status`](crate::compensator::Status).
pub const COMPENSATED: super::Signature = signature!(
    compensated(q, s, u, last, change, largest, rotations) -> (corrected, correction, before, after):
        "Corrected commands, at which the real tool has the pose of the ideal tool at `q`, for one cycle of a controller. Each \
         is within the limits of its variable, and within `change` of the command corrected by `last`: from one cycle to the \
         next no variable moves further than its command and `change`. At most 6 steps are made, which solve at most 8 \
         systems of equations for each variable and 8 more. If the pose cannot be reached, the position has priority over \
         the orientation."
);

/// Signature of `begin` in generated code, as [`begin`](crate::compensator::begin) computes it. In
/// addition to its results it returns a [`Status`](crate::compensator::Status).
pub const BEGIN: super::Signature = signature!(
    begin(q, s, u, rotations) -> (command, first, left):
        "The command that the drives carry out where they stand, at `q`: the ideal tool is there where the real one is. A path \
         that begins there with `last` moves none of them. Within the limits of the variables."
);
