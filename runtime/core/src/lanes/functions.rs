//! The functions of a manipulator as types, for static dispatch.

use super::Named;

/// Implements [`Evaluate`](crate::lanes::Evaluate) for every function of a generated module.
#[doc(hidden)]
#[macro_export]
macro_rules! evaluate_functions {
    ($manipulator:ident: $($function:ident = $name:ident($($argument:ident),+) -> ($($result:ident),+) $($oriented:ident)?:
        $documentation:literal $(, $note:literal)?;)+) => {$(
        impl $crate::lanes::Evaluate<$crate::lanes::$function> for $manipulator {
            #[inline(always)]
            fn evaluate_lanes<T: $crate::Scalar>(&self, mut arguments: &[T], mut results: &mut [T]) -> Option<()> {
                $(let $argument = $crate::checks::FlatArray::<T>::take(&mut arguments)?;)+
                $(let $result = $crate::checks::FlatArray::<T>::fill(&mut results)?;)+
                $crate::lanes::put_margin::<T, _>(raw::$name::<T>($($argument,)+ $($result),+), results)
            }
        }
    )+};
}

macro_rules! types {
    (: $($function:ident = $name:ident $arguments:tt -> $results:tt $($oriented:ident)?:
        $documentation:literal $(, $note:literal)?;)+) => {
        $(
            #[doc = concat!("[`Function::", stringify!($function), "`](crate::Function::", stringify!($function), ").")]
            #[derive(Clone, Copy, Debug)]
            pub struct $function;

            impl Named for $function {
                const FUNCTION: crate::Function = crate::Function::$function;
            }
        )+
    };
}
crate::for_functions!(every: types);
crate::for_functions!(inverse: types);

macro_rules! batches {
    (: $($function:ident = $name:ident $arguments:tt -> $results:tt $($oriented:ident)?:
        $documentation:literal $(, $note:literal)?;)+) => {
        /// The functions of a manipulator in batches, selected at run time. A trait object of it
        /// compiles all functions. It is for tests; programs call [`run`](super::run) with the
        /// functions they need.
        pub trait Batches: crate::Manipulator {
            /// Evaluates a function at all configurations. Errors as for [`run`](super::run).
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
                    other => super::one_by_one(self, other, arguments, results),
                }
            }
        }
    };
}
crate::for_functions!(every: batches);
