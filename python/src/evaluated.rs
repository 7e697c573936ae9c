//! The functions of a machine, as users call them.

use abbe::Function;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::functions::Third;
use crate::machine::Machine;

#[pymethods]
impl Machine {
    /// (…, 4, 4): the nominal pose of the tool in F_0. Rows and columns of a homogeneous matrix; column 3 is the tool point,
    /// in the length unit.
    ///
    /// >>> import abbe
    /// >>> pps = abbe.load("pps")
    /// >>> pps.pose(pps.home)[:3, 3]
    /// array([1128., 1626., 1568.])
    #[pyo3(signature = (q, *, out=None))]
    fn pose<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::Pose, q, &Third::None, out)
    }

    /// (…, n + 1, 4, 4): A_1 … A_n and the tool T, each by itself, lengths in the length unit.
    ///
    /// A_1 takes coordinates in F_1 to F_0, A_i those in F_i to F_{i-1}, T those of the tool to F_n. Rows and columns as those of `pose`.
    #[pyo3(signature = (q, *, out=None))]
    fn transforms<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::Transforms, q, &Third::None, out)
    }

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
    #[pyo3(signature = (q, *, out=None))]
    fn error_jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::ErrorJacobian, q, &Third::None, out)
    }

    /// (…, 6, nq): the joint Jacobian J_q = ∂X_T/∂q in F_0.
    ///
    /// Rows as those of the error Jacobian. Columns: one for each joint variable, per rad or per length unit.
    #[pyo3(signature = (q, *, out=None))]
    fn joint_jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::JointJacobian, q, &Third::None, out)
    }

    /// (…, 6, ns): ∂X_T/∂s in F_0.
    ///
    /// Rows as those of the error Jacobian. Columns: one for each structural parameter in the order of `parameters`, per its
    /// coherent unit.
    #[pyo3(signature = (q, *, out=None))]
    fn parameter_jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::ParameterJacobian, q, &Third::None, out)
    }

    /// (…, 6): ΔX = J_e ε in F_0, for any errors ε.
    ///
    /// `errors`: (6n,) for all configurations or (…, 6n), in the order of `columns`. Rows as those of the error Jacobian: what
    /// the tool is off, real minus ideal, in the length unit and rad.
    #[pyo3(signature = (q, errors, *, out=None))]
    fn displacement<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        errors: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::Displacement, q, &Third::Numbers("errors", errors), out)
    }

    /// (…, 6, 6): the covariance J_e diag(σ²) J_eᵀ of ΔX in F_0, for independent errors.
    ///
    /// `sigma`: the standard deviation of every error, (6n,) or (…, 6n), in the order and units of `columns`. Rows and columns
    /// as the rows of the error Jacobian, in products of their units.
    #[pyo3(signature = (q, sigma, *, out=None))]
    fn covariance<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        sigma: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::Covariance, q, &Third::Squares("sigma", sigma), out)
    }

    /// (…, n, 6): ε of the repeatable sources of the spec: for each frame F_i, in its axes, e_x e_y e_z (length unit) e_s e_r e_p (rad).
    ///
    /// `inputs`: those of the spec by name, a number in coherent units, text with a unit, or an array with a value for each
    /// configuration; nominal if not given. So it is for all functions that take them.
    #[pyo3(signature = (q, *, out=None, **inputs))]
    fn generalized_errors<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        inputs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::GeneralizedErrors, q, &Third::Inputs(inputs), out)
    }

    /// (…, 6): ΔX in F_0 that the repeatable sources of the spec cause, to first order: real minus ideal.
    ///
    /// Rows as those of the error Jacobian, in the length unit and rad. `inputs` as for `generalized_errors`.
    #[pyo3(signature = (q, *, out=None, **inputs))]
    fn predict<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        inputs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::PredictedDisplacement, q, &Third::Inputs(inputs), out)
    }

    /// (…, S, 6): ΔX in F_0 of each source alone (`sources`), of a random one for its magnitude.
    ///
    /// Columns as the rows of the error Jacobian, in the length unit and rad. `inputs` as for `generalized_errors`.
    #[pyo3(signature = (q, *, out=None, **inputs))]
    fn source_displacements<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        inputs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::SourceDisplacements, q, &Third::Inputs(inputs), out)
    }

    /// (…, 4, 4): the pose of the tool in F_0 with the errors of the repeatable sources, exactly: A_1 E_1 … A_n E_n T.
    ///
    /// Rows, columns and units as those of `pose`. `inputs` as for `generalized_errors`.
    #[pyo3(signature = (q, *, out=None, **inputs))]
    fn real_pose<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        inputs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py, Function::RealPose, q, &Third::Inputs(inputs), out)
    }
}
