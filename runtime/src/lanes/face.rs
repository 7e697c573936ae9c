//! The batch functions of a generated module: the same for every manipulator, so they stand here once.

/// The method [`batch`](crate::Manipulator::batch) of a generated manipulator.
#[doc(hidden)]
#[macro_export]
macro_rules! batch_face {
    () => {
        fn batch(
            &self,
            path: $crate::lanes::Path,
            arguments: &$crate::lanes::Tiles,
            results: &mut $crate::lanes::Tiles,
        ) -> Result<(), $crate::Error> {
            path.check(&DESCRIPTION, arguments, results)?;
            $crate::batch_face! {
                path, arguments, results, (q, s, u, errors, out);
                Pose => raw::pose(q, s, columns(out)?),
                ErrorJacobian => raw::error_jacobian(q, s, columns(out)?, columns(out)?),
                DistinctErrorJacobian => raw::error_jacobian_distinct(q, s, columns(out)?, vectors(out)?),
                Displacement => raw::displacement(q, s, errors.as_chunks().0.try_into().ok()?, fill(out)?),
                PredictedDisplacement => raw::predicted_displacement(q, s, u, fill(out)?),
                SourceDisplacements => raw::source_displacements(q, s, u, columns(out)?),
                Covariance => raw::covariance(q, s, errors.as_chunks().0.try_into().ok()?, columns(out)?),
            }
            Ok(())
        }
    };
    ($path:ident, $arguments:ident, $results:ident,
     ($q:ident, $s:ident, $u:ident, $errors:ident, $out:ident);
     $($name:ident => $call:expr,)+) => {
        match $path {
            $($crate::lanes::Path::$name => {
                struct $name;
                impl $crate::lanes::Function for $name {
                    #[inline(always)]
                    #[allow(unused_variables, unused_imports)]
                    fn evaluate<T: $crate::Scalar>(arguments: &[T], mut results: &mut [T]) -> Option<()> {
                        use $crate::lanes::{Margin, fill, fill_columns as columns, fill_vectors as vectors};
                        let ($q, rest) = arguments.split_first_chunk::<VARIABLES>()?;
                        let ($s, rest) = rest.split_first_chunk::<PARAMETERS>()?;
                        let ($u, $errors) = rest.split_first_chunk::<INPUTS>()?;
                        let $out = &mut results;
                        let margin = $call;
                        Margin::<T>::put(margin, $out)
                    }
                }
                $crate::lanes::run::<$name>($arguments, $results);
            })+
        }
    };
}
