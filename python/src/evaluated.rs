//! Functions of a machine, as Python methods.

use abbe::Function;
use pyo3::{prelude::*, types::PyDict};

use crate::{functions::ThirdArgument, machine::Machine};

/// Defines methods by their arguments besides the joints: none, an array and its form, or inputs.
/// Each has its documentation and the function that it evaluates.
macro_rules! methods {
    ($(
        $(#[$documented:meta])*
        $name:ident($($given:ident: $form:ident)? $(**$inputs:ident)?) = $function:ident;
    )+) => {
        #[pymethods]
        impl Machine {$(
            $(#[$documented])*
            #[pyo3(signature = (q, $($given,)? *, out=None $(, **$inputs)?))]
            fn $name<'py>(
                &self,
                py: Python<'py>,
                q: &Bound<'py, PyAny>,
                $($given: &Bound<'py, PyAny>,)?
                out: Option<&Bound<'py, PyAny>>,
                $($inputs: Option<&Bound<'py, PyDict>>,)?
            ) -> PyResult<Bound<'py, PyAny>> {
                let third = methods!(@third $($given: $form)? $($inputs)?);
                self.evaluate(py, Function::$function, q, &third, out)
            }
        )+}
    };
    (@third) => { ThirdArgument::None };
    (@third $given:ident: $form:ident) => { ThirdArgument::$form(stringify!($given), $given) };
    (@third $inputs:ident) => { ThirdArgument::Inputs($inputs) };
}

methods! {
    /// (…, 4, 4): nominal pose of the tool in F_0, as rows and columns of a homogeneous matrix.
    /// Column 3 is the tool point, in the length unit.
    ///
    /// >>> import abbe
    /// >>> pps = abbe.load("pps")
    /// >>> pps.pose(pps.home)[:3, 3]
    /// array([1128., 1626., 1568.])
    pose() = Pose;

    /// (…, n + 1, 4, 4): transforms A_1 … A_n and the tool T, with lengths in the length unit.
    ///
    /// A_1 maps coordinates in F_1 to F_0, A_i those in F_i to F_{i-1}, and T those of the tool
    /// to F_n. Rows and columns as for `pose`.
    transforms() = Transforms;

    /// (…, 6, 6n): error Jacobian J_e = ∂X_T/∂ε in F_0.
    ///
    /// Rows: x, y, z of the tool point in the length unit, then three rows of its orientation
    /// in rad (`rows`). Columns: e_x e_y e_z (length unit) e_s e_r e_p (rad; about Y, Z, X) of
    /// frame 1, then of frame 2 … (`columns`). If the orientation rows are Euler angles, their
    /// singularities raise ValueError.
    ///
    /// >>> import abbe
    /// >>> pps = abbe.load("pps")
    /// >>> jacobian = pps.error_jacobian(pps.home)
    /// >>> jacobian.shape, float(jacobian[0, pps.columns.index("e_s1")])
    /// ((6, 36), 1568.0)
    error_jacobian() = ErrorJacobian;

    /// (…, 6, nq): joint Jacobian J_q = ∂X_T/∂q in F_0.
    ///
    /// Rows as for `error_jacobian`. Columns: one per joint variable, per rad or
    /// per length unit.
    joint_jacobian() = JointJacobian;

    /// (…, 6, ns): parameter Jacobian ∂X_T/∂s in F_0.
    ///
    /// Rows as for `error_jacobian`. Columns: one per structural parameter in the order of
    /// `parameters`, per coherent unit.
    parameter_jacobian() = ParameterJacobian;

    /// (…, np): values of the passive variables for which all loops close, reached continuously
    /// from home, in the length unit and rad.
    ///
    /// One for each passive variable, in the order of the frames that declare them.
    /// Configurations where the loops do not close raise ValueError, and so does a machine
    /// without loops.
    passive() = Passive;

    /// (…, 6): displacement ΔX = J_e ε in F_0 for given errors ε, real minus ideal.
    ///
    /// `errors`: (6n,) for all configurations or (…, 6n), in the order of `columns`, or (…, n,
    /// 6) as `generalized_errors` returns them. Rows as for `error_jacobian`, in the
    /// length unit and rad.
    displacement(errors: Numbers) = Displacement;

    /// (…, 4, 4): exact pose of the tool in F_0 with given errors ε of the frames: by the chain
    /// A_1 E_1 … A_n E_n T, with all loops closed.
    ///
    /// `errors`: as for `displacement`. Rows, columns and units as for `pose`.
    displaced_pose(errors: Numbers) = DisplacedPose;

    /// (…, 6, 6): covariance J_e diag(σ²) J_eᵀ of ΔX in F_0 for independent errors.
    ///
    /// `sigma`: standard deviation of every error, (6n,) or (…, 6n), in the order and units of
    /// `columns`, not negative. Rows and columns as the rows of `error_jacobian`, in products
    /// of their units.
    covariance(sigma: Squares) = Covariance;

    /// (…, np): forces that close the loops under the loads, to first order, in units N and
    /// N·m.
    ///
    /// One for each equation of the loops, in their order; that of a leg is positive if it
    /// presses its ends apart. `inputs`: as for `generalized_errors`. Configurations where the
    /// loops do not close raise ValueError, and so does a machine without loops.
    leg_forces(**inputs) = LegForces;

    /// (…, n, 6): errors ε of the repeatable sources of the spec: for each frame F_i, in its
    /// axes, e_x e_y e_z (length unit) e_s e_r e_p (rad).
    ///
    /// `inputs`: inputs of the spec by name, each a number in coherent units, text with a unit,
    /// or an array with one value per configuration; by default the column of that name if `q`
    /// is a table, or else nominal. The same holds for all functions with inputs.
    generalized_errors(**inputs) = GeneralizedErrors;

    /// (…, 6): displacement ΔX in F_0 by the repeatable sources of the spec, to first order,
    /// real minus ideal.
    ///
    /// Rows as for `error_jacobian`, in the length unit and rad. `inputs`: as for
    /// `generalized_errors`.
    predict(**inputs) = PredictedDisplacement;

    /// (…, S, 6): displacement ΔX in F_0 by each source of `sources` alone; for a random
    /// source, by its magnitude.
    ///
    /// Columns as the rows of `error_jacobian`, in the length unit and rad. `inputs`: as for
    /// `generalized_errors`.
    source_displacements(**inputs) = SourceDisplacements;

    /// (…, 4, 4): pose of the tool in F_0 with the errors of the repeatable sources, by the
    /// exact chain A_1 E_1 … A_n E_n T.
    ///
    /// Rows, columns and units as for `pose`. `inputs`: as for `generalized_errors`.
    real_pose(**inputs) = RealPose;
}
