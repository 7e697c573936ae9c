//! The checked functions of a generated module, which are the same for every manipulator.
//!
//! Each entry of the table of functions yields one checked function. `checked` contains the code
//! that it shares with the method of [`Manipulator`](crate::Manipulator).

/// Defines the checked functions of a generated module, and the type that implements
/// [`Manipulator`](crate::Manipulator) by its raw functions.
///
/// A manipulator with loops is followed by the word `loops`, one with inverse kinematics in closed
/// form by `inverse`, one with both by `loops inverse`. Generated code invokes it where
/// `FRAMES`, `ERRORS`, `VARIABLES`, `PARAMETERS`, `INPUTS`, `EFFECTS`, `SOURCES`, `DESCRIPTION`,
/// `Parameters`, `Inputs` and `raw` are defined. The types of arrays fix their sizes. Numbers that
/// are not finite, inputs outside their range and Euler singularities are [`Error`](crate::Error)s.
#[macro_export]
macro_rules! checked_functions {
    ($(#[$documentation:meta])* $name:ident $($with:ident)*) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        $crate::for_functions!(every: $crate::checked_function);

        $($crate::checked_functions!(@outside $with);)*

        /// Functions that fill arrays and check the results.
        mod checked {
            use super::{DISTINCT, EFFECTS, ERRORS, FRAMES, INPUTS, PARAMETERS, SOURCES, VARIABLES, raw};
            $crate::for_functions!(every: $crate::checked_arrays, of_all);
            $($crate::checked_functions!(@inside $with);)*
        }

        $($crate::checked_functions!(@lanes $name $with);)*

        /// Returns the first cycle of a controller. In each later one,
        /// [`last`](::abbe::compensator::Cycle::last) is the correction that the one before
        /// returned.
        pub fn first_cycle() -> $crate::compensator::Cycle<[f64; VARIABLES]> {
            $crate::compensator::Cycle::first(&DESCRIPTION)
        }

        /// Computes joint commands that put the real tool where the ideal one is at `q`, within the
        /// limits of the variables and the bounds of `cycle`.
        ///
        /// Returns the commands, with ΔX at `q` and at the commands, and a
        /// [`Status`](::abbe::compensator::Status); see
        /// [`compensate`](::abbe::compensator::compensate). Fails if an input is outside its range
        /// or a number is not finite, except the bounds.
        pub fn compensated(
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
            cycle: &$crate::compensator::Cycle<[f64; VARIABLES]>,
        ) -> Result<$crate::compensator::Compensated<[f64; VARIABLES]>, $crate::Error> {
            compensated_to(&pose(q, s)?, q, s, u, cycle)
        }

        /// Computes joint commands that put the real tool at `target`, a pose in `F_0`, starting
        /// from `q`.
        ///
        /// `q` must be near the solution: a configuration where the ideal tool is at `target`, or
        /// the commands of the previous cycle. Fails as [`compensated`] does, and if the target is
        /// not finite.
        pub fn compensated_to(
            target: &$crate::Pose,
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
            cycle: &$crate::compensator::Cycle<[f64; VARIABLES]>,
        ) -> Result<$crate::compensator::Compensated<[f64; VARIABLES]>, $crate::Error> {
            let (s, u) = (&s.to_array(), &u.to_array());
            $crate::checks::use_case(&DESCRIPTION, q, s, u)?;
            $crate::checks::finite($crate::Quantity::Pose, target.0.as_flattened())?;
            $crate::checks::finite($crate::Quantity::Corrections, &cycle.last)?;
            $crate::checks::finite($crate::Quantity::Rotations, &cycle.rotations)?;
            let columns = [[0.0; 6]; VARIABLES];
            $crate::compensator::compensate(&DESCRIPTION, target, q, cycle, columns, |q, columns| {
                let mut pose = [[0.0; 3]; 4];
                checked::compensator_step(q, s, u, &mut pose, columns)?;
                Ok($crate::Pose(pose))
            })
        }

        /// Computes the command that [`compensated`] answers with the drives where they stand: the
        /// ideal tool is there where the real one is with the drives at `drives`. A path that
        /// begins there moves none of them, if [`last`](::abbe::compensator::Cycle::last) of the
        /// first cycle is that of the result and `rotations` are those of the cycle.
        ///
        /// Returns the command within the limits of the variables, with what is left at it; see
        /// [`begin`](::abbe::compensator::begin). Fails if an input is outside its range or a
        /// number is not finite.
        pub fn begin(
            drives: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
            rotations: [f64; 3],
        ) -> Result<$crate::compensator::Begun<[f64; VARIABLES]>, $crate::Error> {
            $crate::checks::finite($crate::Quantity::Rotations, &rotations)?;
            let target = real_pose(drives, s, u)?;
            let (s, u, columns) = (&s.to_array(), &u.to_array(), [[0.0; 6]; VARIABLES]);
            $crate::compensator::begin(&DESCRIPTION, &target, drives, rotations, columns, |q, columns| {
                let mut pose = [[0.0; 3]; 4];
                checked::compensator_step(q, s, u, &mut pose, columns)?;
                checked::pose(q, s, &mut pose)?;
                Ok($crate::Pose(pose))
            })
        }

        $crate::for_functions!(every: $crate::evaluate_functions, $name);

        impl $crate::Manipulator for $name {
            fn description(&self) -> &$crate::Description {
                &DESCRIPTION
            }

            fn evaluate(
                &self,
                function: $crate::Function,
                arguments: &[&[f64]],
                results: &mut [&mut [f64]],
            ) -> Result<(), $crate::Error> {
                match function {
                    $crate::Function::Passive
                    | $crate::Function::DisplacedPose
                    | $crate::Function::LegForces => {
                        $crate::checked_functions!(@of_loops $($with)*: function, arguments, results)
                    }
                    $crate::Function::Inverse => {
                        $crate::checked_functions!(@of_inverse $($with)*: function, arguments, results)
                    }
                    _ => checked::of_all(function, arguments, results),
                }
            }
        }
    };
    (@outside loops) => {
        $crate::for_functions!(loops: $crate::checked_function);
    };
    (@outside inverse) => {
        $crate::for_functions!(inverse: $crate::checked_function);
    };
    (@lanes $name:ident loops) => {};
    (@lanes $name:ident inverse) => {
        $crate::for_functions!(inverse: $crate::evaluate_functions, $name);
    };
    (@inside loops) => {
        use super::PASSIVE;
        $crate::for_functions!(loops: $crate::checked_arrays, of_loops);
    };
    (@inside inverse) => {
        use super::SOLUTIONS;
        $crate::for_functions!(inverse: $crate::checked_arrays, of_inverse);
    };
    (@of_loops loops $(inverse)?: $($arguments:ident),+) => {
        checked::of_loops($($arguments),+)
    };
    (@of_inverse $(loops)? inverse: $($arguments:ident),+) => {
        checked::of_inverse($($arguments),+)
    };
    (@$list:ident $($with:ident)*: $function:ident, $($arguments:ident),+) => {
        Err($crate::Error::NoFunction($function))
    };
}

/// Defines the checked function of each entry of the table.
#[doc(hidden)]
#[macro_export]
macro_rules! checked_function {
    (: $($function:ident = $name:ident($($argument:ident),+) -> ($($result:ident),+) $($oriented:ident)?:
        $documentation:literal $(, $note:literal)?;)+) => {$(
        #[doc = $documentation]
        $(
            #[doc = ""]
            #[doc = $note]
        )?
        #[doc = ""]
        #[doc = "An error if a number is not finite, where an input is outside its range, and where rows 4–6 would be Euler \
            angles that are singular."]
        pub fn $name(
            $($argument: &$crate::function_array!($argument: $crate::argument_type)),+
        ) -> Result<($($crate::function_array!($result: $crate::result_type)),+), $crate::Error> {
            $(
                let $argument = $crate::as_array!($argument: $argument);
                $crate::checks::given(
                    &DESCRIPTION,
                    $crate::function_array!($argument: $crate::array_quantity),
                    $crate::checks::FlatArray::as_flat($argument),
                )?;
            )+
            $(let mut $result: $crate::function_array!($result: $crate::array_type) = $crate::checks::Zeroable::zeroed();)+
            checked::$name($($argument,)+ $(&mut $result),+)?;
            Ok(($($crate::as_result!($result: $result)),+))
        }
    )+};
}

/// Defines the functions that take their results as arguments, which have been checked, and the one
/// that evaluates any of them.
#[doc(hidden)]
#[macro_export]
macro_rules! checked_arrays {
    ($any:ident: $($function:ident = $name:ident($($argument:ident),+) -> ($($result:ident),+) $($oriented:ident)?:
        $documentation:literal $(, $note:literal)?;)+) => {
        $(
            pub(super) fn $name(
                $($argument: &$crate::function_array!($argument: $crate::array_type),)+
                $($result: &mut $crate::function_array!($result: $crate::array_type)),+
            ) -> Result<(), $crate::Error> {
                $crate::checks::margin(raw::$name($($argument,)+ $($result),+))?;
                $($crate::checks::result_is_finite(
                    &super::DESCRIPTION,
                    $crate::function_array!($result: $crate::array_quantity),
                    $crate::checks::FlatArray::as_flat($result),
                )?;)+
                Ok(())
            }
        )+

        #[inline]
        pub(super) fn $any(
            function: $crate::Function,
            arguments: &[&[f64]],
            results: &mut [&mut [f64]],
        ) -> Result<(), $crate::Error> {
            let (mut arguments, mut results) = (arguments.iter(), results.iter_mut());
            match function {
                $($crate::Function::$function => $name(
                    $($crate::checks::argument(
                        &super::DESCRIPTION,
                        $crate::function_array!($argument: $crate::array_quantity),
                        arguments.next(),
                    )?,)+
                    $($crate::checks::result(
                        $crate::function_array!($result: $crate::array_quantity),
                        results.next(),
                    )?),+
                ),)+
                _ => Err($crate::Error::NoFunction(function)),
            }
        }
    };
}

/// Expands to the [`Quantity`](crate::Quantity) of an array of the table.
#[doc(hidden)]
#[macro_export]
macro_rules! array_quantity {
    ($name:literal, $quantity:ident, $type:ty, $unit:literal, $documentation:literal) => {
        $crate::Quantity::$quantity
    };
}

/// Expands to the type of an array.
#[doc(hidden)]
#[macro_export]
macro_rules! array_type {
    ($name:literal, $quantity:ident, $type:ty, $unit:literal, $documentation:literal) => {
        $type
    };
}

/// Expands to the type of an array as an argument: parameters and inputs have named fields.
#[doc(hidden)]
#[macro_export]
macro_rules! argument_type {
    ("s", $($rest:tt)*) => {
        Parameters
    };
    ("u", $($rest:tt)*) => {
        Inputs
    };
    ($name:literal, $quantity:ident, $type:ty, $unit:literal, $documentation:literal) => {
        $type
    };
}

/// Expands to the type of an array as a result: poses are [`Pose`](crate::Pose)s.
#[doc(hidden)]
#[macro_export]
macro_rules! result_type {
    ("pose", $($rest:tt)*) => {
        $crate::Pose
    };
    ("transforms", $($rest:tt)*) => {
        [$crate::Pose; FRAMES + 1]
    };
    ($name:literal, $quantity:ident, $type:ty, $unit:literal, $documentation:literal) => {
        $type
    };
}

/// Converts an argument to its array.
#[doc(hidden)]
#[macro_export]
macro_rules! as_array {
    (s: $value:ident) => {
        &$value.to_array()
    };
    (u: $value:ident) => {
        &$value.to_array()
    };
    ($array:ident: $value:ident) => {
        $value
    };
}

/// Converts an array to its result.
#[doc(hidden)]
#[macro_export]
macro_rules! as_result {
    (pose: $value:ident) => {
        $crate::Pose($value)
    };
    (transforms: $value:ident) => {
        $value.map($crate::Pose)
    };
    ($array:ident: $value:ident) => {
        $value
    };
}
