//! Names of symbols and steps in generated code.

use std::collections::{HashMap, HashSet};
use std::fmt::Display;

use abbe_core::{Component, Function};
use abbe_spec::{Spec, Symbol};

use crate::program::{Action, Array, Operand, Program, Routine, Stage};

/// Rules for the identifiers of a language.
#[derive(Clone, Copy)]
pub(super) struct Identifiers {
    /// Spells a name of the spec as an identifier.
    pub(super) spelled: fn(&str) -> String,
    /// Returns the same key for names that the language does not distinguish.
    pub(super) key: fn(&str) -> String,
    /// End of a name that makes it distinct from another one.
    pub(super) suffix: &'static str,
}

impl Default for Identifiers {
    fn default() -> Self {
        Self { spelled: str::to_owned, key: str::to_owned, suffix: "_" }
    }
}

/// The names of one routine.
#[derive(Clone)]
pub(super) struct Names<'s> {
    spec: &'s Spec,
    /// Keys of the names that are not available.
    used: HashSet<String>,
    identifiers: Identifiers,
    counter: usize,
    /// Names of the symbols; those of local ones change from block to block.
    symbols: HashMap<Symbol, String>,
}

impl<'s> Names<'s> {
    /// Creates the names of a routine. Reserved words and the names of arrays, called routines and
    /// tables are not available.
    pub(super) fn new(spec: &'s Spec, routine: &Routine, reserved: &str, identifiers: Identifiers) -> Self {
        let signatures: Vec<_> =
            routine.function.into_iter().chain(Function::ALL).map(Function::signature).collect();
        let arrays =
            signatures.iter().flat_map(|signature| signature.arguments.iter().chain(signature.results));
        let arrays = arrays.map(|array| array.name).chain(routine.arrays.iter().map(|array| array.name));
        let called = routine.stages.iter().filter_map(|stage| match stage {
            // Some languages prefix the name of the manipulator.
            Stage::Call { routine, .. } => Some([(*routine).to_owned(), format!("{}_{routine}", spec.name)]),
            _ => None,
        });
        let tables = spec.tables.iter().map(|table| table.constant_name());
        let tables = tables.flat_map(|name| [function_of(&name), name]);
        let taken = reserved.split_whitespace().chain(arrays).map(str::to_owned);
        let taken = taken.chain(called.flatten()).chain(tables);
        let used = taken.map(|name| (identifiers.key)(&name)).collect();
        let mut names = Self { spec, used, identifiers, counter: 0, symbols: HashMap::new() };
        spec.symbols().for_each(|(name, symbol, _)| names.insert(symbol, name));
        names
    }

    fn insert(&mut self, symbol: Symbol, proposed: &str) {
        let name = self.free(proposed);
        self.symbols.insert(symbol, name);
    }

    /// Names the entries of an argument that the spec does not name, by the first letter of the
    /// argument: `v2_s` is the element of `variances` for `e_s` of frame 2, `m1` the magnitude of
    /// the first source. The pose that is to be reached is named by row and column: `t_13`, and
    /// `t_x` of the position.
    pub(super) fn name_entries(&mut self, argument: &str, symbols: &[Symbol]) {
        let letter = &argument[..1];
        for symbol in symbols {
            let name = match *symbol {
                Symbol::Error(i) => format!("{letter}{}_{}", i / 6 + 1, suffix(i % 6)),
                Symbol::Magnitude(i) => format!("{letter}{}", i + 1),
                Symbol::Target(i) => entry_of_pose(letter, i),
                _ => continue,
            };
            self.insert(*symbol, &name);
        }
    }

    /// Clears the names of local symbols at the start of another block.
    pub(super) fn forget_locals(&mut self) {
        self.symbols.retain(|symbol, _| !matches!(symbol, Symbol::Local(_)));
    }

    /// Names the used elements of a row, whose first element is local symbol `first`: poses by row
    /// and column, errors by component, others by x, y, z or number.
    pub(super) fn name_locals(&mut self, array: &Array, first: usize, used: &[bool]) -> Vec<Option<String>> {
        let letter = self.letter(array);
        let singular = array.name.trim_end_matches('s');
        let proposed = |i: usize| match (used.len(), array.name) {
            (_, "passive" | "real_passive") => self.spec.passive[i].name.clone(),
            (12, _) => entry_of_pose(letter, i),
            (6, "errors" | "variances") => format!("{letter}_{}", suffix(i)),
            (3, _) => format!("{singular}_{}", ["x", "y", "z"][i]),
            (1, _) => singular.to_owned(),
            _ => format!("{singular}_{}", i + 1),
        };
        let names: Vec<Option<String>> =
            used.iter().enumerate().map(|(i, used)| used.then(|| self.free(&proposed(i)))).collect();
        self.take_locals(first, &names);
        names
    }

    /// Returns the first letter of an array, or the next letter that no other array uses.
    fn letter(&self, array: &Array) -> char {
        // Links are the transforms A_i.
        let first = if array.name == "links" { 'a' } else { array.name.chars().next().unwrap_or('x') };
        let is_taken = |letter: &char| self.used.contains(&(self.identifiers.key)(&format!("{letter}_x")));
        (first..='z').find(|letter| !is_taken(letter)).unwrap_or(first)
    }

    /// Sets the names of the local symbols from `first` on.
    pub(super) fn take_locals(&mut self, first: usize, names: &[Option<String>]) {
        for (i, name) in names.iter().enumerate().filter_map(|(i, name)| Some((i, name.as_ref()?))) {
            self.used.insert((self.identifiers.key)(name));
            self.symbols.insert(Symbol::Local(first + i), name.clone());
        }
    }

    /// Returns the name of a variable, parameter, input, generalized error, magnitude or local
    /// symbol.
    pub(super) fn symbol(&self, symbol: Symbol) -> &str {
        match symbol {
            Symbol::Passive(i) => &self.symbols[&Symbol::Local(i)],
            // Errors are named before the body is printed, in the functions that take them.
            symbol => &self.symbols[&symbol],
        }
    }

    /// Returns a name for the result of a step: the proposed one, or the next `t…`.
    pub(super) fn step(&mut self, proposed: Option<&str>) -> String {
        match proposed {
            Some(name) => self.free(name),
            None => {
                self.counter += 1;
                self.free(&format!("t{}", self.counter))
            }
        }
    }

    /// Returns names for a sine and cosine: `s2` and `c2` for the variable of frame 2, with or
    /// without an offset, `sin_x` and `cos_x` for a parameter x.
    pub(super) fn sine_and_cosine(&mut self, angle: Operand, program: &Program) -> (String, String) {
        // Avoid two adjacent underscores.
        let of = |name: &str| {
            let name = name.trim_start_matches('_');
            (format!("sin_{name}"), format!("cos_{name}"))
        };
        let (sine, cosine) = match without_offset(angle, program) {
            Operand::Symbol(Symbol::Variable(i)) => {
                let frame = self.spec.variables[i].frame + 1;
                (format!("s{frame}"), format!("c{frame}"))
            }
            Operand::Symbol(Symbol::Parameter(i)) => of(&self.spec.parameters[i].name),
            Operand::Symbol(Symbol::Input(i)) => of(&self.spec.inputs[i].name),
            Operand::Symbol(local @ Symbol::Local(i)) if i < self.spec.passive.len() => {
                of(self.symbol(local))
            }
            _ => {
                self.counter += 1;
                of(&self.counter.to_string())
            }
        };
        (self.free(&sine), self.free(&cosine))
    }

    fn free(&mut self, name: &str) -> String {
        let Identifiers { spelled, key, suffix } = self.identifiers;
        let name = distinct(spelled(name), suffix, |name| self.used.contains(&key(name)));
        self.used.insert(key(&name));
        name
    }
}

/// Returns the name of an entry of a pose, by row and column.
fn entry_of_pose(letter: impl Display, i: usize) -> String {
    match i {
        0..9 => format!("{letter}_{}{}", i % 3 + 1, i / 3 + 1),
        _ => format!("{letter}_{}", ["x", "y", "z"][i - 9]),
    }
}

/// Returns the letter of a generalized error.
fn suffix(component: usize) -> &'static str {
    Component::ALL[component].name().trim_start_matches("e_")
}

/// Returns the name of the function of a lookup table.
pub(super) fn function_of(table: &str) -> String {
    format!("look_up_{table}")
}

/// Returns a name with as many suffixes as it takes to be free.
pub(super) fn distinct(mut name: String, suffix: &str, is_taken: impl Fn(&str) -> bool) -> String {
    while is_taken(&name) {
        name.push_str(suffix);
    }
    name
}

/// Returns the name of a file without its extension: the manipulator's, unless a file of the
/// language has it.
pub(super) fn file_name(spec: &Spec, taken: &str) -> String {
    distinct(spec.name.clone(), "_", |name| taken.split_whitespace().any(|word| word == name))
}

/// Returns a note on a file or a class whose name is not the manipulator's.
pub(super) fn renamed(spec: &Spec, kind: &str, name: &str) -> Option<String> {
    let note =
        || format!("This {kind} is named `{name}`, because `{}` is not available as its name.", spec.name);
    (spec.name != name).then(note)
}

/// Returns the variable of `variable ± something else`, or the angle itself.
fn without_offset(angle: Operand, program: &Program) -> Operand {
    let is_variable = |operand: &Operand| matches!(operand, Operand::Symbol(Symbol::Variable(_)));
    let step = program.steps.iter().find(|step| Operand::Register(step.register) == angle);
    match step.map(|step| step.action) {
        Some(action @ (Action::Add(..) | Action::Sub(..))) => {
            let mut variables = action.operands().filter(is_variable);
            variables.next().filter(|_| variables.next().is_none()).unwrap_or(angle)
        }
        _ => angle,
    }
}
