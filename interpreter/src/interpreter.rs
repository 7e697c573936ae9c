//! A spec as a [`Manipulator`].

use std::sync::{Arc, OnceLock};

use abbe::analysis::Sweepable;
use abbe::lanes::{self, Batches, Tiles};
use abbe::{Description, Error, Function, Input, Manipulator, Parameter, Pose, Quantity, checks};
use abbe_codegen::chain::Model;
use abbe_codegen::program::{Routines, parameter_derivatives};
use abbe_spec::Spec;

use crate::lanes::{Batch, Block};
use crate::operation::Tape;

/// Result of evaluating a configuration.
type Result<T, E = Error> = std::result::Result<T, E>;

/// A manipulator that runs from its spec, without a compiler.
#[derive(Clone, Debug)]
pub struct Interpreter {
    spec: Arc<Spec>,
    description: Arc<Description>,
    code: Arc<Code>,
}

/// Routines, and the tapes of all functions, built at first use.
#[derive(Debug)]
struct Code {
    routines: Routines,
    tapes: [OnceLock<Tape>; Function::COUNT],
    /// Derivatives by the parameters; `None` if there are none.
    derivatives: [OnceLock<Option<Tape>>; Function::COUNT],
}

impl Interpreter {
    /// Prepares a spec.
    pub fn new(spec: impl Into<Arc<Spec>>) -> Self {
        Self::with(spec.into(), Routines::new)
    }

    /// Prepares a spec without loops over the frames for any length of the chain, for checks of the
    /// loops.
    pub fn without_loops(spec: impl Into<Arc<Spec>>) -> Self {
        Self::with(spec.into(), Routines::without_loops)
    }

    fn with(spec: Arc<Spec>, routines: impl Fn(&Spec, &Model) -> Routines) -> Self {
        let routines = routines(&spec, &Model::new(&spec));
        let description = Arc::new(routines.description.clone());
        let code = Code {
            routines,
            tapes: [const { OnceLock::new() }; Function::COUNT],
            derivatives: [const { OnceLock::new() }; Function::COUNT],
        };
        Self { spec, description, code: Arc::new(code) }
    }

    /// Returns an interpreter of the spec with other nominal values of its parameters and inputs.
    /// `spec` must not differ in anything else.
    ///
    /// Nothing is compiled again, except for closed loops: the steps in which they are closed
    /// depend on the values.
    pub fn with_values(&self, spec: Arc<Spec>) -> Self {
        if self.description.has_loops() {
            return Self::new(spec);
        }
        let mut description = Description::clone(&self.description);
        let parameters = description.parameters.iter().zip(&spec.parameters);
        description.parameters =
            parameters.map(|(old, new)| Parameter { nominal: new.value, ..old.clone() }).collect();
        let inputs = description.inputs.iter().zip(&spec.inputs);
        description.inputs = inputs.map(|(old, new)| Input { nominal: new.value, ..old.clone() }).collect();
        Self { spec, description: Arc::new(description), code: self.code.clone() }
    }

    /// Returns the spec.
    pub fn spec(&self) -> &Arc<Spec> {
        &self.spec
    }

    /// Returns the routines that the interpreter runs. Their description has the nominal values
    /// with which they were compiled.
    pub fn routines(&self) -> &Routines {
        &self.code.routines
    }

    /// Returns the tape of a function.
    fn tape(&self, function: Function) -> &Tape {
        let routines = &self.code.routines;
        self.code.tapes[function as usize].get_or_init(|| Tape::new(routines, routines.function(function)))
    }

    /// Evaluates a function: arguments and results are concatenated, and the margin is last. Only
    /// the number of arguments is checked; results may be infinite or NaN.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Count`] if the number of arguments differs from the function's signature.
    pub fn evaluate_unchecked(&self, function: Function, arguments: &[f64]) -> Result<Vec<f64>> {
        let tape = self.tape(function);
        checks::length(Quantity::Arguments, [tape.arguments, 1], arguments.len())?;
        Ok(evaluated(tape, arguments.iter()))
    }

    /// Evaluates a function at one configuration with all checks of [`Manipulator`]. `arguments`
    /// has one slice for each argument of the signature. The results are concatenated, finite and
    /// not singular; the margin, if there is one, is last.
    ///
    /// # Errors
    ///
    /// Returns the errors of the corresponding function of [`Manipulator`].
    pub fn run(&self, function: Function, arguments: &[&[f64]]) -> Result<Vec<f64>> {
        let values = self.unchecked(function, arguments)?;
        self.check(function, &values).map_err(|error| self.named(error, function, arguments))?;
        Ok(values)
    }

    /// Returns the derivatives of the results of a function by the structural parameters: for each
    /// parameter one after the other, all results in their order, without the margin. Returns
    /// `None` for poses with errors of machines with loops. The first call differentiates the
    /// function, which takes some milliseconds.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`run`](Self::run), and [`Error::NotFinite`] if a derivative is not
    /// finite.
    pub fn parameter_derivatives(
        &self,
        function: Function,
        arguments: &[&[f64]],
    ) -> Result<Option<Vec<f64>>> {
        // With its checks.
        self.run(function, arguments)?;
        let tape = self.code.derivatives[function as usize].get_or_init(|| {
            Some(Tape::new(&self.code.routines, &parameter_derivatives(&self.spec, function)?))
        });
        let Some(tape) = tape else { return Ok(None) };
        let values = evaluated(tape, arguments.iter().copied().flatten());
        checks::finite(Quantity::Results, &values)?;
        Ok(Some(values))
    }

    /// Returns the exact pose of the tool point with the errors of the repeatable sources.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Manipulator::effects`].
    pub fn real_pose(&self, q: &[f64], s: &[f64], u: &[f64]) -> Result<Pose> {
        let mut pose = Pose::IDENTITY;
        self.evaluate(Function::RealPose, &[q, s, u], &mut [pose.0.as_flattened_mut()])?;
        Ok(pose)
    }

    /// Evaluates a function; only its arguments are checked.
    fn unchecked(&self, function: Function, arguments: &[&[f64]]) -> Result<Vec<f64>> {
        let arrays = function.signature().arguments;
        for (i, array) in arrays.iter().enumerate() {
            let values = arguments.get(i).copied().unwrap_or_default();
            checks::length(array.quantity, array.rows(&self.description), values.len())?;
            checks::given(&self.description, array.quantity, values)?;
        }
        Ok(evaluated(self.tape(function), arguments[..arrays.len()].iter().copied().flatten()))
    }

    /// Returns the error of the passive variables instead of that of a function that needs them.
    fn named(&self, error: Error, function: Function, arguments: &[&[f64]]) -> Error {
        match arguments {
            [q, s, ..] if error == Error::NotClosed && function != Function::Passive => {
                self.run(Function::Passive, &[q, s]).err().unwrap_or(error)
            }
            _ => error,
        }
    }

    /// Checks that the results of a function are finite and not singular.
    fn check(&self, function: Function, values: &[f64]) -> Result<()> {
        let signature = function.signature();
        let mut rest = values;
        if signature.has_margin(self.description.orientation)
            && let Some((margin, results)) = values.split_last()
        {
            checks::margin(*margin)?;
            rest = results;
        }
        for array in signature.results {
            let (result, others) = rest.split_at(array.len(&self.description));
            checks::result_is_finite(&self.description, array.quantity, result)?;
            rest = others;
        }
        Ok(())
    }
}

impl Manipulator for Interpreter {
    fn description(&self) -> &Description {
        &self.description
    }

    fn evaluate(&self, function: Function, arguments: &[&[f64]], results: &mut [&mut [f64]]) -> Result<()> {
        let arrays = function.signature().results;
        for (i, array) in arrays.iter().enumerate() {
            let found = results.get(i).map_or(0, |values| values.len());
            checks::length(array.quantity, array.rows(&self.description), found)?;
        }
        let values = self.unchecked(function, arguments)?;
        let mut rest = values.iter();
        for result in results.iter_mut().take(arrays.len()) {
            result.iter_mut().zip(rest.by_ref()).for_each(|(result, value)| *result = *value);
        }
        self.check(function, &values).map_err(|error| self.named(error, function, arguments))
    }
}

impl Batches for Interpreter {
    fn batch(&self, function: Function, arguments: &Tiles, results: &mut Tiles) -> Result<()> {
        lanes::check(function, &self.description, arguments, results)?;
        arguments.instruction_set().run(Batch { tape: self.tape(function), arguments, results });
        Ok(())
    }
}

impl Sweepable for Interpreter {
    fn poses(&self, arguments: &Tiles, poses: &mut Tiles) -> Result<()> {
        self.batch(Function::Pose, arguments, poses)
    }

    fn source_displacements(&self, arguments: &Tiles, displacements: &mut Tiles) -> Result<()> {
        self.batch(Function::SourceDisplacements, arguments, displacements)
    }
}

/// Runs a tape; `arguments` must have as many numbers as the tape expects.
fn evaluated<'a>(tape: &Tape, arguments: impl Iterator<Item = &'a f64>) -> Vec<f64> {
    let mut rows = vec![[0.0]; tape.slots];
    let mut block = Block::new(tape, &mut rows);
    for (slot, value) in arguments.enumerate() {
        block.set(slot, 0, *value);
    }
    block.run(tape);
    tape.outputs.iter().map(|slot| block.value(*slot, 0)).collect()
}
