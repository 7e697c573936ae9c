//! A function of a manipulator, over one configuration or many.

use abbe::lanes::{Batches, InstructionSet, Tiles};
use abbe::{Error, Function, Manipulator, Quantity, checks};
use abbe_interpreter::Interpreter;

use crate::layout::Layout;

/// How many configurations are evaluated at a time: what they give stays in the cache until it is copied.
const CHUNK: usize = 64;

/// An argument of a function.
pub(crate) struct Argument<'a> {
    /// Its values: once, or for every configuration.
    pub(crate) values: &'a [f64],
    /// Whether every configuration has its own.
    pub(crate) each: bool,
}

/// A configuration that could not be evaluated.
pub(crate) struct Refused {
    /// Which one, none if there is only one.
    pub(crate) index: Option<usize>,
    /// Why.
    pub(crate) error: Error,
}

/// A function that is to be evaluated.
pub(crate) struct Batch<'a> {
    /// Whose.
    pub(crate) interpreter: &'a Interpreter,
    /// Which.
    pub(crate) function: Function,
    /// Where its results go.
    pub(crate) layout: &'a Layout,
    /// What it takes.
    pub(crate) arguments: Vec<Argument<'a>>,
}

impl Batch<'_> {
    /// One configuration, by the interpreter's scalar code.
    pub(crate) fn one(&self, array: &mut [f64]) -> Result<(), Refused> {
        let arguments: Vec<&[f64]> = self.arguments.iter().map(|argument| argument.values).collect();
        let refused = |error| Refused { index: None, error };
        let values = self.interpreter.run(self.function, &arguments).map_err(refused)?;
        self.layout.fill(array, &mut Vec::new(), |array| {
            for (place, row) in array.iter_mut().zip(&self.layout.rows) {
                *place = values[*row];
            }
        });
        Ok(())
    }

    /// Many configurations, in lanes.
    pub(crate) fn many(&self, count: usize, array: &mut [f64]) -> Result<(), Refused> {
        let description = self.interpreter.description();
        let (set, signature) = (InstructionSet::best(), self.function.signature());
        let size = CHUNK.min(count);
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
        for first in (0..count).step_by(CHUNK) {
            let size = CHUNK.min(count - first);
            given.resize(size);
            found.resize(size);
            let array = &mut array[length * first..][..length * size];
            self.put(&rows, first, &mut given);
            let done = self.interpreter.batch(self.function, &given, &mut found);
            done.map_err(|error| Refused { index: Some(first), error })?;
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

    /// The rows of each argument.
    fn rows(&self) -> Vec<Vec<usize>> {
        let (description, mut first) = (self.interpreter.description(), 0);
        let arrays = self.function.signature().arguments.iter();
        let rows = arrays.map(|array| {
            let rows = first..first + array.len(description);
            first = rows.end;
            rows.collect()
        });
        rows.collect()
    }

    /// The values of an argument at some configurations.
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

    /// Whether all arguments are finite, and inputs within their ranges.
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

    /// The first configuration that cannot be evaluated, and why, as it is said of one alone.
    fn refused(&self, first: usize, size: usize) -> Refused {
        let alone = |index: usize| {
            let arguments = (0..self.arguments.len()).map(|argument| self.values_of(argument, index));
            self.interpreter
                .run(self.function, &arguments.collect::<Vec<_>>())
                .err()
                .map(|error| (index, error))
        };
        let (index, error) = (first..first + size)
            .find_map(alone)
            .unwrap_or((first, Error::NotFinite { quantity: Quantity::Results, index: 0 }));
        Refused { index: Some(index), error }
    }

    fn values_of(&self, argument: usize, index: usize) -> &[f64] {
        self.values(argument, index, 1)
    }
}
