//! The functions of a machine, as users call them.

use abbe::Function;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::functions::Third;
use crate::machine::Machine;

/// Methods by what they take beside the joints. A method is what is documented and the function that it evaluates.
macro_rules! methods {
    (
        nothing { $($(#[$nothing_documented:meta])* $nothing:ident = $of_joints:ident;)+ }
        errors { $($(#[$errors_documented:meta])* $errors:ident($given:ident: $third:ident) = $of_errors:ident;)+ }
        inputs { $($(#[$inputs_documented:meta])* $inputs:ident = $of_inputs:ident;)+ }
    ) => {
        #[pymethods]
        impl Machine {
            $(
                $(#[$nothing_documented])*
                #[pyo3(signature = (q, *, out=None))]
                fn $nothing<'py>(
                    &self,
                    py: Python<'py>,
                    q: &Bound<'py, PyAny>,
                    out: Option<&Bound<'py, PyAny>>,
                ) -> PyResult<Bound<'py, PyAny>> {
                    self.evaluate(py, Function::$of_joints, q, &Third::None, out)
                }
            )+
            $(
                $(#[$errors_documented])*
                #[pyo3(signature = (q, $given, *, out=None))]
                fn $errors<'py>(
                    &self,
                    py: Python<'py>,
                    q: &Bound<'py, PyAny>,
                    $given: &Bound<'py, PyAny>,
                    out: Option<&Bound<'py, PyAny>>,
                ) -> PyResult<Bound<'py, PyAny>> {
                    let third = Third::$third(stringify!($given), $given);
                    self.evaluate(py, Function::$of_errors, q, &third, out)
                }
            )+
            $(
                $(#[$inputs_documented])*
                #[pyo3(signature = (q, *, out=None, **inputs))]
                fn $inputs<'py>(
                    &self,
                    py: Python<'py>,
                    q: &Bound<'py, PyAny>,
                    out: Option<&Bound<'py, PyAny>>,
                    inputs: Option<&Bound<'py, PyDict>>,
                ) -> PyResult<Bound<'py, PyAny>> {
                    self.evaluate(py, Function::$of_inputs, q, &Third::Inputs(inputs), out)
                }
            )+
        }
    };
}

methods! {
    nothing {
        /// (…, 4, 4): the nominal pose of the tool in F_0. Rows and columns of a homogeneous matrix; column 3 is the tool point,
        /// in the length unit.
        ///
        /// >>> import abbe
        /// >>> pps = abbe.load("pps")
        /// >>> pps.pose(pps.home)[:3, 3]
        /// array([1128., 1626., 1568.])
        pose = Pose;

        /// (…, n + 1, 4, 4): A_1 … A_n and the tool T, each by itself, lengths in the length unit.
        ///
        /// A_1 takes coordinates in F_1 to F_0, A_i those in F_i to F_{i-1}, T those of the tool to F_n. Rows and columns as those of `pose`.
        transforms = Transforms;

        /// (…, 6, 6n): the error Jacobian J_e = ∂X_T/∂ε in F_0.
        ///
        /// Rows: x, y, z of the tool point in the length unit, then three of its orientation in rad (`rows`). Columns: e_x e_y e_z
        /// (length unit) e_s e_r e_p (rad; about Y, Z, X) of frame 1, then of frame 2 … (`columns`). Rows that are Euler angles raise
        /// ValueError where these are singular.
        ///
        /// >>> import abbe
        /// >>> pps = abbe.load("pps")
        /// >>> jacobian = pps.error_jacobian(pps.home)
        /// >>> jacobian.shape, float(jacobian[0, pps.columns.index("e_s1")])
        /// ((6, 36), 1568.0)
        error_jacobian = ErrorJacobian;

        /// (…, 6, nq): the joint Jacobian J_q = ∂X_T/∂q in F_0.
        ///
        /// Rows as those of the error Jacobian. Columns: one for each joint variable, per rad or per length unit.
        joint_jacobian = JointJacobian;

        /// (…, 6, ns): ∂X_T/∂s in F_0.
        ///
        /// Rows as those of the error Jacobian. Columns: one for each structural parameter in the order of `parameters`, per its
        /// coherent unit.
        parameter_jacobian = ParameterJacobian;
    }
    errors {
        /// (…, 6): ΔX = J_e ε in F_0, for any errors ε.
        ///
        /// `errors`: (6n,) for all configurations or (…, 6n), in the order of `columns`. Rows as those of the error Jacobian: what
        /// the tool is off, real minus ideal, in the length unit and rad.
        displacement(errors: Numbers) = Displacement;

        /// (…, 6, 6): the covariance J_e diag(σ²) J_eᵀ of ΔX in F_0, for independent errors.
        ///
        /// `sigma`: the standard deviation of every error, (6n,) or (…, 6n), in the order and units of `columns`. Rows and columns
        /// as the rows of the error Jacobian, in products of their units.
        covariance(sigma: Squares) = Covariance;
    }
    inputs {
        /// (…, n, 6): ε of the repeatable sources of the spec: for each frame F_i, in its axes, e_x e_y e_z (length unit) e_s e_r e_p (rad).
        ///
        /// `inputs`: those of the spec by name, a number in coherent units, text with a unit, or an array with a value for each
        /// configuration; nominal if not given. So it is for all functions that take them.
        generalized_errors = GeneralizedErrors;

        /// (…, 6): ΔX in F_0 that the repeatable sources of the spec cause, to first order: real minus ideal.
        ///
        /// Rows as those of the error Jacobian, in the length unit and rad. `inputs` as for `generalized_errors`.
        predict = PredictedDisplacement;

        /// (…, S, 6): ΔX in F_0 of each source alone (`sources`), of a random one for its magnitude.
        ///
        /// Columns as the rows of the error Jacobian, in the length unit and rad. `inputs` as for `generalized_errors`.
        source_displacements = SourceDisplacements;

        /// (…, 4, 4): the pose of the tool in F_0 with the errors of the repeatable sources, exactly: A_1 E_1 … A_n E_n T.
        ///
        /// Rows, columns and units as those of `pose`. `inputs` as for `generalized_errors`.
        real_pose = RealPose;
    }
}
