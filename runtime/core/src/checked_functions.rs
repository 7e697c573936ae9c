//! The checked face of a generated module: the same for every manipulator, so it stands here once.

/// Puts checked functions, and the [`Manipulator`](crate::Manipulator) they come from, before the raw functions
/// of a generated module.
///
/// Generated code calls it where `FRAMES`, `ERRORS`, `VARIABLES`, `PARAMETERS`, `INPUTS`, `EFFECTS`,
/// `SOURCES`, `DESCRIPTION`, `Parameters`, `Inputs` and `raw` are defined. Arrays have the right size by their types;
/// numbers that are not finite, inputs outside their range and Euler singularities are [`Error`](crate::Error)s.
#[macro_export]
macro_rules! checked_functions {
    ($(#[$documentation:meta])* $name:ident) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        /// The pose of the tool point in `F_0`.
        ///
        /// An error if a number is not finite.
        pub fn pose(q: &[f64; VARIABLES], s: &Parameters) -> Result<$crate::Pose, $crate::Error> {
            $crate::Manipulator::pose(&$name, q, &s.to_array())
        }

        /// Pose and error Jacobian `J_e = ∂X_T/∂ε`: one `[f64; 6]` per column, six columns per frame.
        ///
        /// An error where Euler rows are singular, or if a number is not finite.
        pub fn error_jacobian(
            q: &[f64; VARIABLES],
            s: &Parameters,
        ) -> Result<($crate::Pose, [[f64; 6]; ERRORS]), $crate::Error> {
            let mut columns = [[0.0; 6]; ERRORS];
            let pose = $crate::Manipulator::error_jacobian(&$name, q, &s.to_array(), &mut columns)?;
            Ok((pose, columns))
        }

        /// Pose and joint Jacobian `J_q = ∂X_T/∂q`: one `[f64; 6]` per variable.
        ///
        /// An error where Euler rows are singular, or if a number is not finite.
        pub fn joint_jacobian(
            q: &[f64; VARIABLES],
            s: &Parameters,
        ) -> Result<($crate::Pose, [[f64; 6]; VARIABLES]), $crate::Error> {
            let mut columns = [[0.0; 6]; VARIABLES];
            let pose = $crate::Manipulator::joint_jacobian(&$name, q, &s.to_array(), &mut columns)?;
            Ok((pose, columns))
        }

        /// Pose and `∂X_T/∂s`: one `[f64; 6]` per structural parameter.
        ///
        /// An error where Euler rows are singular, or if a number is not finite.
        pub fn parameter_jacobian(
            q: &[f64; VARIABLES],
            s: &Parameters,
        ) -> Result<($crate::Pose, [[f64; 6]; PARAMETERS]), $crate::Error> {
            let mut columns = [[0.0; 6]; PARAMETERS];
            let pose = $crate::Manipulator::parameter_jacobian(&$name, q, &s.to_array(), &mut columns)?;
            Ok((pose, columns))
        }

        /// The errors that the sources cause, of random ones the magnitude, in the order of the description's
        /// effects.
        ///
        /// An error if an input is outside its range or a number is not finite.
        pub fn effects(
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
        ) -> Result<[f64; EFFECTS], $crate::Error> {
            let mut effects = [0.0; EFFECTS];
            $crate::Manipulator::effects(&$name, q, &s.to_array(), &u.to_array(), &mut effects)?;
            Ok(effects)
        }

        /// ε, the sum of the repeatable sources: `e_x e_y e_z e_s e_r e_p` of each frame.
        ///
        /// An error if an input is outside its range or a number is not finite.
        pub fn generalized_errors(
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
        ) -> Result<[[f64; 6]; FRAMES], $crate::Error> {
            let mut errors = [[0.0; 6]; FRAMES];
            $crate::Manipulator::generalized_errors(&$name, q, &s.to_array(), &u.to_array(), &mut errors)?;
            Ok(errors)
        }

        $crate::checked_functions! {
            /// `ΔX = J_e ε` for any ε: `e_x e_y e_z e_s e_r e_p` of each frame; rows as those of a Jacobian.
            ///
            /// An error where Euler rows are singular, or if a number is not finite.
            @given errors, displacement: [f64; 6]
        }

        $crate::checked_functions! {
            /// `J_e diag(σ²) J_eᵀ`, the covariance of ΔX, for independent errors of these variances, in the order of ε.
            ///
            /// Exact to rounding errors of the largest variance of its three axes: one that ought to be 0 can come out
            /// that much below it. An error where Euler rows are singular, or if a number is not finite.
            @given variances, covariance: [[f64; 6]; 6]
        }

        $crate::checked_functions! {
            /// `ΔX = J_e ε` of the repeatable sources; rows as those of a Jacobian.
            ///
            /// An error where Euler rows are singular, if an input is outside its range or a number is not finite.
            @sources predicted_displacement: [f64; 6]
        }

        $crate::checked_functions! {
            /// ΔX of each source by itself, of a random one for its magnitude; rows as those of a Jacobian.
            ///
            /// An error where Euler rows are singular, if an input is outside its range or a number is not finite.
            @sources source_displacements: [[f64; 6]; SOURCES]
        }

        /// The pose of the tool point in `F_0` with the errors of the repeatable sources, exactly: equation (6).
        ///
        /// An error if an input is outside its range or a number is not finite.
        pub fn real_pose(
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
        ) -> Result<$crate::Pose, $crate::Error> {
            let (s, u) = (&s.to_array(), &u.to_array());
            $crate::checks::use_case(&DESCRIPTION.inputs, q, s, u)?;
            let mut pose = [[0.0; 3]; 4];
            raw::real_pose(q, s, u, &mut pose);
            $crate::checks::finite($crate::Quantity::Pose, pose.as_flattened())?;
            Ok($crate::Pose(pose))
        }

        /// The real pose, and the nominal `J_q` with rotation-vector rows whatever those of the other functions are.
        ///
        /// A step towards a pose `X*` is `δq = J_q⁺ (X* ⊖ X_real)`, with the rows of
        /// [`deviation`](::abbe::deviation) from the real pose to `X*`. An error if an input is outside its range or
        /// a number is not finite.
        pub fn compensator_step(
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
        ) -> Result<($crate::Pose, [[f64; 6]; VARIABLES]), $crate::Error> {
            let (s, u) = (&s.to_array(), &u.to_array());
            $crate::checks::use_case(&DESCRIPTION.inputs, q, s, u)?;
            let (mut pose, mut columns) = ([[0.0; 3]; 4], [[0.0; 6]; VARIABLES]);
            raw::compensator_step(q, s, u, &mut pose, &mut columns);
            $crate::checks::finite($crate::Quantity::Pose, pose.as_flattened())?;
            $crate::checks::finite($crate::Quantity::Jacobian, columns.as_flattened())?;
            Ok(($crate::Pose(pose), columns))
        }

        /// Joint commands that put the real tool where the ideal one is at `q`, within the limits of the variables.
        ///
        /// The commands, and ΔX at `q` and at them; see [`compensate`](::abbe::compensator::compensate). An error if an input
        /// is outside its range or a number is not finite.
        pub fn compensated(
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
        ) -> Result<$crate::compensator::Compensated<[f64; VARIABLES]>, $crate::Error> {
            compensated_to(&pose(q, s)?, q, s, u)
        }

        /// The same for a pose of the tool in `F_0`, which the commands are sought for from `q` on.
        ///
        /// `q` must be close: where the ideal tool is at `target`, or in the cycle before. Errors as before, and if the target
        /// is not finite.
        pub fn compensated_to(
            target: &$crate::Pose,
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
        ) -> Result<$crate::compensator::Compensated<[f64; VARIABLES]>, $crate::Error> {
            let (s, u) = (&s.to_array(), &u.to_array());
            $crate::checks::use_case(&DESCRIPTION.inputs, q, s, u)?;
            $crate::checks::finite($crate::Quantity::Pose, target.0.as_flattened())?;
            let columns = [[0.0; 6]; VARIABLES];
            $crate::compensator::compensate(&DESCRIPTION, target, q, columns, |q, columns| {
                let mut pose = [[0.0; 3]; 4];
                raw::compensator_step(q, s, u, &mut pose, columns);
                $crate::checks::finite($crate::Quantity::Pose, pose.as_flattened())?;
                $crate::checks::finite($crate::Quantity::Jacobian, columns.as_flattened())?;
                Ok($crate::Pose(pose))
            })
        }

        $crate::lane_functions!($crate::evaluate_functions, $name);

        impl $crate::Manipulator for $name {
            fn description(&self) -> &$crate::Description {
                &DESCRIPTION
            }

            fn transforms(
                &self,
                q: &[f64],
                s: &[f64],
                transforms: &mut [$crate::Pose],
            ) -> Result<(), $crate::Error> {
                let q = $crate::checks::argument($crate::Quantity::Variables, q)?;
                let s = $crate::checks::argument($crate::Quantity::Parameters, s)?;
                let transforms = $crate::checks::result($crate::Quantity::Pose, transforms)?;
                let mut columns = [[[0.0; 3]; 4]; FRAMES + 1];
                raw::transforms(q, s, &mut columns);
                $crate::checks::finite($crate::Quantity::Pose, columns.as_flattened().as_flattened())?;
                *transforms = columns.map($crate::Pose);
                Ok(())
            }

            fn pose(&self, q: &[f64], s: &[f64]) -> Result<$crate::Pose, $crate::Error> {
                let q = $crate::checks::argument($crate::Quantity::Variables, q)?;
                let s = $crate::checks::argument($crate::Quantity::Parameters, s)?;
                let mut pose = [[0.0; 3]; 4];
                raw::pose(q, s, &mut pose);
                $crate::checks::finite($crate::Quantity::Pose, pose.as_flattened())?;
                Ok($crate::Pose(pose))
            }

            $crate::checked_functions!(@jacobian error_jacobian);
            $crate::checked_functions!(@jacobian joint_jacobian);
            $crate::checked_functions!(@jacobian parameter_jacobian);

            fn effects(
                &self,
                q: &[f64],
                s: &[f64],
                u: &[f64],
                effects: &mut [f64],
            ) -> Result<(), $crate::Error> {
                let q = $crate::checks::argument($crate::Quantity::Variables, q)?;
                let s = $crate::checks::argument($crate::Quantity::Parameters, s)?;
                let u = $crate::checks::argument($crate::Quantity::Inputs, u)?;
                let effects = $crate::checks::result($crate::Quantity::Effects, effects)?;
                $crate::checks::inputs(&DESCRIPTION.inputs, u)?;
                raw::effects(q, s, u, effects);
                $crate::checks::finite($crate::Quantity::Effects, effects)
            }

            fn generalized_errors(
                &self,
                q: &[f64],
                s: &[f64],
                u: &[f64],
                errors: &mut [[f64; 6]],
            ) -> Result<(), $crate::Error> {
                let q = $crate::checks::argument($crate::Quantity::Variables, q)?;
                let s = $crate::checks::argument($crate::Quantity::Parameters, s)?;
                let u = $crate::checks::argument($crate::Quantity::Inputs, u)?;
                let errors = $crate::checks::result($crate::Quantity::Errors, errors)?;
                $crate::checks::inputs(&DESCRIPTION.inputs, u)?;
                raw::generalized_errors(q, s, u, errors);
                $crate::checks::finite($crate::Quantity::Errors, errors.as_flattened())
            }

            fn drawn_pose(
                &self,
                q: &[f64],
                s: &[f64],
                u: &[f64],
                magnitudes: &[f64],
            ) -> Result<Option<$crate::Pose>, $crate::Error> {
                let q = $crate::checks::argument($crate::Quantity::Variables, q)?;
                let s = $crate::checks::argument($crate::Quantity::Parameters, s)?;
                let u = $crate::checks::argument($crate::Quantity::Inputs, u)?;
                let magnitudes = $crate::checks::argument($crate::Quantity::Magnitudes, magnitudes)?;
                $crate::checks::inputs(&DESCRIPTION.inputs, u)?;
                let mut pose = [[0.0; 3]; 4];
                raw::drawn_pose(q, s, u, magnitudes, &mut pose);
                $crate::checks::finite($crate::Quantity::Pose, pose.as_flattened())?;
                Ok(Some($crate::Pose(pose)))
            }
        }
    };
    (@jacobian $jacobian:ident) => {
        fn $jacobian(
            &self,
            q: &[f64],
            s: &[f64],
            columns: &mut [[f64; 6]],
        ) -> Result<$crate::Pose, $crate::Error> {
            let q = $crate::checks::argument($crate::Quantity::Variables, q)?;
            let s = $crate::checks::argument($crate::Quantity::Parameters, s)?;
            let columns = $crate::checks::result($crate::Quantity::Jacobian, columns)?;
            let mut pose = [[0.0; 3]; 4];
            $crate::checks::margin(raw::$jacobian(q, s, &mut pose, columns))?;
            $crate::checks::finite($crate::Quantity::Pose, pose.as_flattened())?;
            $crate::checks::finite($crate::Quantity::Jacobian, columns.as_flattened())?;
            Ok($crate::Pose(pose))
        }
    };
    ($(#[$documentation:meta])* @given $given:ident, $function:ident: [$($result:tt)*]) => {
        $(#[$documentation])*
        pub fn $function(
            q: &[f64; VARIABLES],
            s: &Parameters,
            $given: &[[f64; 6]; FRAMES],
        ) -> Result<[$($result)*], $crate::Error> {
            let s = &s.to_array();
            $crate::checks::configuration(q, s)?;
            $crate::checks::finite($crate::Quantity::Errors, $given.as_flattened())?;
            let mut result = $crate::checked_functions!(@zero $($result)*);
            let margin = raw::$function(q, s, $given, &mut result);
            $crate::checks::displacement(margin, $crate::checked_functions!(@flat result: $($result)*))?;
            Ok(result)
        }
    };
    ($(#[$documentation:meta])* @sources $function:ident: [$($result:tt)*]) => {
        $(#[$documentation])*
        pub fn $function(
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
        ) -> Result<[$($result)*], $crate::Error> {
            let (s, u) = (&s.to_array(), &u.to_array());
            $crate::checks::use_case(&DESCRIPTION.inputs, q, s, u)?;
            let mut result = $crate::checked_functions!(@zero $($result)*);
            let margin = raw::$function(q, s, u, &mut result);
            $crate::checks::displacement(margin, $crate::checked_functions!(@flat result: $($result)*))?;
            Ok(result)
        }
    };
    (@zero f64; 6) => { [0.0; 6] };
    (@zero [f64; 6]; $columns:expr) => { [[0.0; 6]; $columns] };
    (@flat $result:ident: f64; 6) => { &$result };
    (@flat $result:ident: [f64; 6]; $columns:expr) => { $result.as_flattened() };
}
