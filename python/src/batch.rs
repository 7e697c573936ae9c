//! Evaluation of one function of a manipulator at one or many configurations.

use std::ops::Range;

use abbe::lanes::{Batches, InstructionSet, Tiles, one_by_one};
use abbe::{Error, Function, Manipulator, Quantity, checks};
use abbe_interpreter::Interpreter;

use crate::layout::Layout;

/// Number of configurations evaluated at a time: their results stay in the cache until they are
/// copied.
const CHUNK: usize = 64;

/// Argument of a function.
pub(crate) struct Argument<'a> {
    /// Values: one set, or one set per configuration.
    pub(crate) values: &'a [f64],
    /// True if each configuration has its own values.
    pub(crate) each: bool,
}

impl<'a> Argument<'a> {
    /// Returns the set of `length` values of a configuration.
    pub(crate) fn at(&self, index: usize, length: usize) -> &'a [f64] {
        if self.each { &self.values[length * index..][..length] } else { self.values }
    }
}

/// Configuration that cannot be evaluated.
pub(crate) struct RejectedConfiguration {
    /// Index in the batch; none for a single configuration.
    pub(crate) index: Option<usize>,
    /// Reason.
    pub(crate) error: Error,
}

/// Function to evaluate, with its arguments.
pub(crate) struct Batch<'a> {
    /// Interpreter of the manipulator.
    pub(crate) interpreter: &'a Interpreter,
    /// Function to evaluate.
    pub(crate) function: Function,
    /// Layout of the result array.
    pub(crate) layout: &'a Layout,
    /// Arguments in the order of the function's signature.
    pub(crate) arguments: Vec<Argument<'a>>,
}

impl Batch<'_> {
    /// Evaluates one configuration with the interpreter's scalar code.
    pub(crate) fn one(&self, array: &mut [f64]) -> Result<(), RejectedConfiguration> {
        let arguments: Vec<&[f64]> = self.arguments.iter().map(|argument| argument.values).collect();
        let refused = |error| RejectedConfiguration { index: None, error };
        let values = self.run(&arguments).map_err(refused)?;
        self.layout.fill(array, &mut Vec::new(), |array| {
            for (place, row) in array.iter_mut().zip(&self.layout.rows) {
                *place = values[*row];
            }
        });
        Ok(())
    }

    /// Returns true for the pose with given errors of a machine without loops, which is the product
    /// of its transforms and errors.
    fn is_product(&self) -> bool {
        self.function == Function::DisplacedPose && !self.interpreter.description().has_loops()
    }

    /// Evaluates the function with one set of arguments.
    fn run(&self, arguments: &[&[f64]]) -> Result<Vec<f64>, Error> {
        match *arguments {
            [q, s, errors] if self.is_product() => {
                let pose = self.interpreter.displaced_pose(q, s, errors.as_chunks().0)?;
                Ok(pose.0.concat())
            }
            _ => self.interpreter.run(self.function, arguments),
        }
    }

    /// Evaluates a range of the configurations in lanes; `array` is for that range.
    pub(crate) fn many(&self, range: Range<usize>, array: &mut [f64]) -> Result<(), RejectedConfiguration> {
        let description = self.interpreter.description();
        let (set, signature) = (InstructionSet::best(), self.function.signature());
        let size = CHUNK.min(range.len());
        let mut given = Tiles::new(set, signature.arguments_len(description), size);
        let mut found = Tiles::new(set, signature.results_len(description), size);
        let rows = self.rows();
        for (argument, rows) in self.arguments.iter().zip(&rows) {
            if !argument.each {
                rows.iter().zip(argument.values).for_each(|(row, value)| given.fill_row(*row, *value));
            }
        }
        let margin = signature.has_margin(description.orientation).then(|| found.rows() - 1);
        let (length, mut staged) = (self.layout.len(), Vec::new());
        for first in range.clone().step_by(CHUNK) {
            let size = CHUNK.min(range.end - first);
            given.resize(size);
            found.resize(size);
            let array = &mut array[length * (first - range.start)..][..length * size];
            self.put(&rows, first, &mut given);
            let done = match self.is_product() {
                true => one_by_one(self.interpreter, self.function, &given, &mut found),
                false => self.interpreter.batch(self.function, &given, &mut found),
            };
            done.map_err(|error| RejectedConfiguration { index: Some(first), error })?;
            self.layout.fill(array, &mut staged, |array| found.copy_each(&self.layout.rows, 0, array));
            let margins =
                || margin.is_none_or(|row| (0..size).all(|i| checks::margin(found.get(row, i)).is_ok()));
            if self.accepted(first, size).is_err()
                || !margins()
                || checks::finite(Quantity::Results, array).is_err()
            {
                return Err(self.refused(first, size));
            }
        }
        Ok(())
    }

    /// Returns the tile rows of each argument.
    fn rows(&self) -> Vec<Vec<usize>> {
        let (description, mut first) = (self.interpreter.description(), 0);
        let rows = self.function.signature().arguments.iter().map(|array| {
            let rows = first..first + array.len(description);
            first = rows.end;
            rows.collect()
        });
        rows.collect()
    }

    /// Returns the values of an argument at `size` configurations from `first` on.
    fn values(&self, argument: usize, first: usize, size: usize) -> &[f64] {
        let Argument { values, each } = self.arguments[argument];
        let length = self.function.signature().arguments[argument].len(self.interpreter.description());
        if each { &values[length * first..][..length * size] } else { values }
    }

    fn put(&self, rows: &[Vec<usize>], first: usize, given: &mut Tiles) {
        for (argument, rows) in rows.iter().enumerate().filter(|(i, _)| self.arguments[*i].each) {
            let values = &mut self.values(argument, first, given.count()).iter();
            given.set_each(rows, 0, given.count(), |_| values.next().copied().unwrap_or(f64::NAN));
        }
    }

    /// Checks that all arguments are finite and that inputs are within their ranges.
    fn accepted(&self, first: usize, size: usize) -> Result<(), Error> {
        let inputs = &self.interpreter.description().inputs;
        for (i, array) in self.function.signature().arguments.iter().enumerate() {
            let values = self.values(i, first, size);
            checks::finite(array.quantity, values)?;
            if array.quantity == Quantity::Inputs && !inputs.is_empty() {
                values.chunks_exact(inputs.len()).try_for_each(|u| checks::inputs(inputs, u))?;
            }
        }
        Ok(())
    }

    /// Finds the first configuration that cannot be evaluated. The reason is that of a single
    /// evaluation.
    fn refused(&self, first: usize, size: usize) -> RejectedConfiguration {
        let alone = |index: usize| {
            let arguments = (0..self.arguments.len()).map(|argument| self.values(argument, index, 1));
            self.run(&arguments.collect::<Vec<_>>()).err().map(|error| (index, error))
        };
        let (index, error) = (first..first + size)
            .find_map(alone)
            .unwrap_or((first, Error::NotFinite { quantity: Quantity::Results, index: 0 }));
        RejectedConfiguration { index: Some(index), error }
    }
}
