//! The functions of a manipulator as types, for what is compiled where it is named.

/// A [`Function`](crate::Function) as a type: what [`run`](super::run) compiles, and nothing else.
pub trait Named {
    /// The function.
    const FUNCTION: crate::Function;
}

/// Every function, its name in generated code, and what it takes and fills, as its
/// [`Signature`](crate::function::Signature) says; handed to the macro `$then`.
#[doc(hidden)]
#[macro_export]
macro_rules! lane_functions {
    ($then:path $(, $manipulator:ident)?) => {
        $then! {
            $($manipulator)?:
            Transforms transforms(q, s; transforms)
            Pose pose(q, s; pose)
            ErrorJacobian error_jacobian(q, s; pose, columns)
            JointJacobian joint_jacobian(q, s; pose, columns)
            ParameterJacobian parameter_jacobian(q, s; pose, columns)
            Effects effects(q, s, u; effects)
            GeneralizedErrors generalized_errors(q, s, u; errors)
            ErrorJacobianDistinct error_jacobian_distinct(q, s; pose, distinct)
            Displacement displacement(q, s, errors; displacement)
            Covariance covariance(q, s, variances; covariance)
            PredictedDisplacement predicted_displacement(q, s, u; displacement)
            SourceDisplacements source_displacements(q, s, u; displacements)
            RealPose real_pose(q, s, u; pose)
            DrawnPose drawn_pose(q, s, u, magnitudes; pose)
            CompensatorStep compensator_step(q, s, u; pose, columns)
        }
    };
}

/// Lets the functions of a generated module be named for batches.
#[doc(hidden)]
#[macro_export]
macro_rules! evaluate_functions {
    ($manipulator:ident: $($function:ident $raw:ident($($argument:ident),+; $($result:ident),+))+) => {$(
        impl $crate::lanes::Evaluate<$crate::lanes::$function> for $manipulator {
            #[inline(always)]
            fn evaluate<T: $crate::Scalar>(&self, mut arguments: &[T], mut results: &mut [T]) -> Option<()> {
                $(let $argument = $crate::lanes::Rows::<T>::take(&mut arguments)?;)+
                $(let $result = $crate::lanes::Rows::<T>::fill(&mut results)?;)+
                $crate::lanes::put_margin::<T, _>(raw::$raw::<T>($($argument,)+ $($result),+), results)
            }
        }
    )+};
}

macro_rules! names {
    (: $($function:ident $raw:ident $arrays:tt)+) => {
        $(
            #[doc = concat!("[`Function::", stringify!($function), "`](crate::Function::", stringify!($function), ").")]
            #[derive(Clone, Copy, Debug)]
            pub struct $function;

            impl Named for $function {
                const FUNCTION: crate::Function = crate::Function::$function;
            }
        )+

        /// All functions of a manipulator in batches, by value: whoever makes a trait object of it has all of them
        /// compiled. For tests; programs name what they need and [`run`](super::run) it.
        pub trait Batches: crate::Manipulator {
            /// Evaluates a function in all configurations. Errors as for [`run`](super::run).
            fn batch(
                &self,
                function: crate::Function,
                arguments: &super::Tiles,
                results: &mut super::Tiles,
            ) -> Result<(), crate::Error>;
        }

        impl<M: $(super::Evaluate<$function> +)+> Batches for M {
            fn batch(
                &self,
                function: crate::Function,
                arguments: &super::Tiles,
                results: &mut super::Tiles,
            ) -> Result<(), crate::Error> {
                match function {
                    $(crate::Function::$function => super::run(self, $function, arguments, results),)+
                }
            }
        }
    };
}
crate::lane_functions!(names);
