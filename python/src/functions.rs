//! Evaluation of a function of a machine with arguments from Python.

use abbe::{Description, Error, Function, Manipulator, Quantity, function::Array};
use abbe_study::{mistake, options::quantity};
use numpy::{PyArrayDyn, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyInt, PyList, PyString};

use crate::arrays::{empty, numbers, output_array, tuple};
use crate::batch::{Argument, Batch, RejectedConfiguration};
use crate::{Machine, guarded, spec_error};

/// Number of configurations from which other Python threads may run during an evaluation.
const MANY: usize = 32;

/// Number of configurations after which signals are checked, so that Ctrl-C ends an evaluation.
const BLOCK: usize = 1 << 17;

/// ThirdArgument argument of a function, after the joints and the parameters.
pub(crate) enum ThirdArgument<'a, 'py> {
    /// No third argument.
    None,
    /// Named array with six numbers per frame.
    Numbers(&'static str, &'a Bound<'py, PyAny>),
    /// Named array, whose squares are the argument.
    Squares(&'static str, &'a Bound<'py, PyAny>),
    /// Inputs by their names.
    Inputs(Option<&'a Bound<'py, PyDict>>),
}

/// Values in the order of a batch.
enum Values<'py> {
    Array(PyReadonlyArrayDyn<'py, f64>),
    Own(Vec<f64>),
}

/// Argument, with the shape of its configurations.
pub(crate) struct ArgumentValues<'py> {
    values: Values<'py>,
    /// Leading dimensions; empty if one set of values is for every configuration.
    pub(crate) lead: Vec<usize>,
}

impl Machine {
    /// Evaluates a function at the configurations `q`.
    pub(crate) fn evaluate<'py>(
        &self,
        py: Python<'py>,
        function: Function,
        q: &Bound<'py, PyAny>,
        third: &ThirdArgument<'_, 'py>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let description = self.interpreter.description();
        let signature = function.signature();
        let needs_loops = Function::OF_LOOPS.contains(&function) && function != Function::DisplacedPose;
        if needs_loops && !description.has_loops() {
            let message = format!("this machine has no closed loops, so it has no `{}`", signature.name);
            return Err(PyValueError::new_err(message));
        }
        let given = self.given_joints(q)?;
        let mut lead = given.lead.clone();
        let third = match *third {
            ThirdArgument::None => None,
            ThirdArgument::Numbers(name, value) => {
                let given = vec_of(numbers(value, name, None)?, name, &signature.arguments[2], description)?;
                // Sources have errors, too: what is not finite here is no fault of theirs.
                if let Some(at) = given.values.slice()?.iter().position(|value| !value.is_finite()) {
                    let argument = &signature.arguments[2];
                    let (row, index) = (at / argument.len(description), at % argument.len(description));
                    let at =
                        given.lead.first().map(|_| format!("at configuration {row}: ")).unwrap_or_default();
                    let error = Error::NotFinite { quantity: argument.quantity, index };
                    return Err(PyValueError::new_err(at + &mistake::named(&error, description)));
                }
                Some(given)
            }
            ThirdArgument::Squares(name, value) => {
                let array = numbers(value, name, None)?;
                let given = standard_deviations(&array, name, signature.arguments[2].len(description));
                given?;
                let mut given = vec_of(array, name, &signature.arguments[2], description)?;
                given.values = Values::Own(given.values.slice()?.iter().map(|value| value * value).collect());
                Some(given)
            }
            ThirdArgument::Inputs(inputs) => Some(self.given_inputs(q, inputs, &lead)?),
        };
        if let Some(third) = &third
            && third.lead != lead
            && !third.lead.is_empty()
        {
            if !lead.is_empty() {
                let message = format!(
                    "`q` is for configurations of shape {}, and the other argument for {}",
                    tuple(&lead),
                    tuple(&third.lead)
                );
                return Err(PyValueError::new_err(message));
            }
            lead.clone_from(&third.lead);
        }

        let layout = self.layout(function);
        let shape = [&lead[..], &layout.shape].concat();
        let array = match out {
            Some(out) => out.clone(),
            None => empty(py, &shape)?,
        };
        let mut written = output_array(&array, &shape)?;
        let written = written.as_slice_mut()?;
        let mut arguments = vec![given.argument()?, Argument { values: &self.parameters, each: false }];
        arguments.extend(third.as_ref().map(ArgumentValues::argument).transpose()?);
        let batch = Batch { interpreter: &self.interpreter, function, layout, arguments };
        let count = lead.iter().try_fold(1_usize, |count, length| count.checked_mul(*length));
        let count = count.ok_or_else(|| PyValueError::new_err("too many configurations"))?;
        let done = guarded(|| {
            Ok(match lead.is_empty() {
                true => batch.one(written),
                false if count < MANY => batch.many(0..count, written),
                false => {
                    let length = written.len() / count;
                    for first in (0..count).step_by(BLOCK) {
                        let range = first..count.min(first + BLOCK);
                        let block = &mut written[length * first..length * range.end];
                        if let Err(rejected) = py.detach(|| batch.many(range, block)) {
                            return Ok(Err(rejected));
                        }
                        py.check_signals()?;
                    }
                    Ok(())
                }
            })
        })?;
        done.map_err(|RejectedConfiguration { index, error }| {
            let at = index.map_or("this configuration".to_owned(), |index| format!("configuration {index}"));
            self.not_evaluated(&at, &error)
        })?;
        Ok(array)
    }

    /// Creates the ValueError of a configuration that cannot be evaluated.
    pub(crate) fn not_evaluated(&self, at: &str, error: &Error) -> PyErr {
        let refused = mistake::not_evaluated(&self.machine.origin, at, error, self.interpreter.description());
        PyValueError::new_err(refused.list.into_iter().map(|one| one.message).collect::<String>())
    }

    /// Returns the configurations of an array (…, nq), or of a table with columns of the joints.
    pub(crate) fn given_joints<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<ArgumentValues<'py>> {
        let joints = &Function::RealPose.signature().arguments[0];
        let array = numbers(q, "q", Some(self.variable_names.bind(q.py())))?;
        vec_of(array, "q", joints, self.interpreter.description())
    }

    /// Returns the inputs: the nominal values, replaced by columns of the table `q` and by those
    /// given by name. If any is an array, every configuration gets its own set.
    pub(crate) fn given_inputs<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        inputs: Option<&Bound<'py, PyDict>>,
        lead: &[usize],
    ) -> PyResult<ArgumentValues<'py>> {
        let description = self.interpreter.description();
        let mut nominal: Vec<f64> = description.inputs.iter().map(|input| input.nominal).collect();
        let mut columns = Vec::new();
        for (name, value) in self.with_columns(q, inputs)?.iter().flatten() {
            let name: String = name.extract()?;
            let input = self.input(&name)?;
            if value.is_exact_instance_of::<PyFloat>() || value.is_exact_instance_of::<PyInt>() {
                nominal[input] = value.extract()?;
            } else if let Ok(text) = value.cast::<PyString>() {
                nominal[input] = self.quantity(value.py(), input, text.to_str()?)?;
            } else {
                let array = numbers(&value, &name, None)?;
                match array.shape() {
                    [] => nominal[input] = array.as_slice()?[0],
                    shape if shape == lead => columns.push((input, array)),
                    shape => {
                        let (shape, lead) = (tuple(shape), tuple(lead));
                        let message = format!(
                            "`{name}` has shape {shape}: give one number, or shape {lead} as the configurations"
                        );
                        return Err(PyValueError::new_err(message));
                    }
                }
            }
        }
        if columns.is_empty() {
            return Ok(ArgumentValues { values: Values::Own(nominal), lead: Vec::new() });
        }
        let mut values = nominal.repeat(lead.iter().product());
        for (input, array) in &columns {
            for (u, value) in values.chunks_exact_mut(nominal.len()).zip(array.as_slice()?) {
                u[*input] = *value;
            }
        }
        Ok(ArgumentValues { values: Values::Own(values), lead: lead.to_vec() })
    }

    /// Adds the columns of the table `q` that are named as inputs.
    fn with_columns<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        inputs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let known = &self.interpreter.description().inputs;
        if known.is_empty() || q.is_exact_instance_of::<PyArrayDyn<f64>>() || q.is_instance_of::<PyList>() {
            return Ok(inputs.cloned());
        }
        let (py, names) = (q.py(), known.iter().map(|input| &*input.name).collect::<Vec<_>>());
        let columns = py.import("abbe._arrays")?.getattr("among")?.call1((q, names))?;
        let all = columns.cast_into::<PyDict>().map_err(PyErr::from)?;
        inputs.map_or(Ok(()), |inputs| all.update(inputs.as_mapping()))?;
        Ok(Some(all))
    }

    fn input(&self, name: &str) -> PyResult<usize> {
        let inputs = &self.interpreter.description().inputs;
        inputs.iter().position(|input| *input.name == *name).ok_or_else(|| {
            let known: Vec<&str> = inputs.iter().map(|input| &*input.name).collect();
            let known = if known.is_empty() {
                "it has none".to_owned()
            } else {
                format!("inputs: {}", known.join(", "))
            };
            PyTypeError::new_err(format!("{} has no input `{name}`; {known}", self.machine.spec.name))
        })
    }

    /// Parses `3 kg`.
    fn quantity(&self, py: Python<'_>, input: usize, text: &str) -> PyResult<f64> {
        let spec = &self.machine.spec;
        let declared = &spec.inputs[input];
        let what = format!("the value of `{}`", declared.name);
        quantity(&declared.name, text, spec.length, declared.dimension, &what)
            .map_err(|mistakes| spec_error(py, &mistakes))
    }
}

/// Checks that an array has standard deviations, not a covariance.
fn standard_deviations(array: &PyReadonlyArrayDyn<'_, f64>, name: &str, count: usize) -> PyResult<()> {
    let is_square = matches!(*array.shape(), [rows, columns] if rows == count && columns == count);
    if is_square {
        let values = array.as_slice()?;
        let is_diagonal = (0..count).all(|i| (0..i).all(|j| values[count * i + j] == values[count * j + i]));
        if is_diagonal {
            return Err(PyValueError::new_err(format!(
                "`{name}` is a symmetric matrix: give standard deviations, shape (…, {count}), of independent errors; for a full \
                 covariance Σ compute J Σ Jᵀ with J = error_jacobian(q)"
            )));
        }
    }
    if array.as_slice()?.iter().any(|value| *value < 0.0) {
        return Err(PyValueError::new_err(format!("`{name}` has a negative standard deviation")));
    }
    Ok(())
}

/// Checks that the last dimension of an array is the length of the argument, or that the last two
/// are frames and their six errors.
fn vec_of<'py>(
    array: PyReadonlyArrayDyn<'py, f64>,
    name: &str,
    argument: &Array,
    description: &Description,
) -> PyResult<ArgumentValues<'py>> {
    let needed = argument.len(description);
    match array.shape() {
        [lead @ .., last] if *last == needed => {
            Ok(ArgumentValues { lead: lead.to_vec(), values: Values::Array(array) })
        }
        // As `generalized_errors` returns them.
        [lead @ .., frames, 6] if argument.quantity == Quantity::Errors && 6 * frames == needed => {
            Ok(ArgumentValues { lead: lead.to_vec(), values: Values::Array(array) })
        }
        shape => {
            let per = match argument.quantity {
                Quantity::Variables => "one for each joint variable",
                _ => "six for each frame",
            };
            let message =
                format!("`{name}` has shape {}, and shape (…, {needed}) is needed: {per}", tuple(shape));
            Err(PyValueError::new_err(message))
        }
    }
}

impl Values<'_> {
    fn slice(&self) -> PyResult<&[f64]> {
        match self {
            Self::Array(array) => Ok(array.as_slice()?),
            Self::Own(values) => Ok(values),
        }
    }
}

impl ArgumentValues<'_> {
    pub(crate) fn argument(&self) -> PyResult<Argument<'_>> {
        Ok(Argument { values: self.values.slice()?, each: !self.lead.is_empty() })
    }
}
