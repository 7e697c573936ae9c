//! Derivatives by the structural parameters.

use abbe::{Function, Manipulator};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};

use crate::arrays::{empty, output_array};
use crate::{Machine, guarded};

#[pymethods]
impl Machine {
    /// (…, ns, 6) or (…, ns, 6, 6n): derivatives of ΔX or of J_e by the structural parameters, in
    /// the order of `parameters`.
    ///
    /// `of`: "predict" for ΔX by the repeatable sources, or "error_jacobian"; units are those of
    /// that function per coherent unit of the parameter. The derivatives are exact; the first call
    /// takes some milliseconds to find them. `inputs`: as for `generalized_errors`. Loops stay
    /// closed.
    ///
    /// >>> import abbe
    /// >>> pps = abbe.load("pps")
    /// >>> pps.parameter_derivatives(pps.home).shape == (len(pps.parameters), 6)
    /// True
    #[pyo3(signature = (q, of="predict", **inputs))]
    fn parameter_derivatives<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        of: &str,
        inputs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let function = match of {
            "predict" => Function::PredictedDisplacement,
            "error_jacobian" => Function::ErrorJacobian,
            other => {
                let message = format!("`of` is {other:?}: give \"predict\" or \"error_jacobian\"");
                return Err(PyValueError::new_err(message));
            }
        };
        let description = self.interpreter.description();
        let given = self.given_joints(q)?;
        let given_inputs = self.given_inputs(q, inputs, &given.lead)?;
        let (joints, inputs) = (given.argument()?, given_inputs.argument()?);
        let layout = self.layout(function);
        let shape = [&given.lead[..], &[self.parameters.len()], &layout.shape].concat();
        let array = empty(py, &shape)?;
        let mut written = output_array(&array, &shape)?;
        let written = written.as_slice_mut()?;
        let results = function.signature().results.iter().map(|array| array.len(description)).sum::<usize>();
        let length = layout.len() * self.parameters.len();
        for index in 0..given.lead.iter().product() {
            py.check_signals()?;
            let q = joints.at(index, description.variables.len());
            let arguments = [q, &self.parameters, inputs.at(index, description.inputs.len())];
            let arguments = &arguments[..function.signature().arguments.len()];
            let found = guarded(|| Ok(self.interpreter.parameter_derivatives(function, arguments)))?;
            let found =
                found.map_err(|error| self.not_evaluated(&format!("configuration {index}"), &error))?;
            let found = found.ok_or_else(|| PyValueError::new_err("this function has no derivatives"))?;
            let places = written[length * index..].iter_mut();
            let rows = found
                .chunks_exact(results.max(1))
                .flat_map(|block| layout.rows.iter().map(|row| block[*row]));
            places.zip(rows).for_each(|(place, value)| *place = value);
        }
        Ok(array)
    }
}
