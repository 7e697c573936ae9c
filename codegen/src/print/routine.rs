//! Prints the statements of routines: what is the same in every language with flat arrays.

use super::{Flat, Invocation, Printer, Results, Statement, Value};
use crate::program::{ArrayRows, Role, Sums};

/// Prints statements, and returns the margin if it is returned.
pub(super) fn statements<'s, L: Printer>(
    language: &mut L,
    flat: Flat<'_>,
    list: &'s [Statement],
) -> Option<&'s str> {
    let mut margin = None;
    for statement in list {
        match statement {
            Statement::Return(value) => margin = Some(value.as_str()),
            other => Walker { language, flat }.statement(other),
        }
    }
    margin
}

struct Walker<'p, L> {
    language: &'p mut L,
    flat: Flat<'p>,
}

impl<L: Printer> Walker<'_, L> {
    fn name(&self, array: usize) -> String {
        let Flat { routine, .. } = self.flat;
        self.language.array(routine, routine.arrays[array].name)
    }

    /// Returns entry `index` of a table of the file.
    fn constant(&self, name: &str, index: &str) -> String {
        self.language.at(&self.language.constant(name), index)
    }

    /// Returns element k of row `index` of a place.
    fn place(&self, place: ArrayRows, index: usize, k: usize) -> String {
        let listed = |table: &str, column| self.constant(&format!("{table}_{column}"), "i");
        self.language.at(&self.name(place.array), &self.flat.index(place, index, k, listed))
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Unpack { names, from } => {
                let role = self.flat.routine.arrays[from.array].role;
                let value = |k| self.language.read(self.place(*from, 0, k), role);
                let named = names.iter().enumerate();
                let named = named.filter_map(|(k, name)| Some((name.clone()?, value(k))));
                let bindings: Vec<(String, String)> = named.collect();
                self.language.bind(&bindings);
            }
            Statement::Comment(text) => self.language.comment(text),
            Statement::Let { name, value } => self.language.bind(&[(name.clone(), value.clone())]),
            Statement::SinCos(pairs) => self.language.sines(pairs),
            Statement::Declare(array) => self.declare(*array),
            Statement::Copy { from, to, fresh } => {
                let (range, len) = (self.flat.range(*from), self.flat.len(from.array));
                let [to, from] = [*to, from.array].map(|array| self.name(array));
                self.language.copy_rows(&to, &from, range, len, *fresh);
            }
            Statement::Assign { to, index, values, fresh } => {
                let place = |(k, value)| (self.place(*to, *index, k), value);
                let mut entries: Vec<(String, &Value)> = values.iter().enumerate().map(place).collect();
                if *fresh {
                    let name = self.name(to.array);
                    return self.language.create(&name, &entries);
                }
                let has_zeros = self.has_zeros(to.array);
                entries.retain(|(_, value)| !(has_zeros && value.is_zero));
                self.language.assign_all(&entries);
            }
            Statement::Call { routine, arrays, fresh } => self.call(routine, arrays, fresh),
            Statement::Sums { sums, terms, entries } => self.sums(*sums, *terms, *entries),
            Statement::For { repeated, body } => {
                let count = repeated.count.value(&self.flat.routines.description);
                let range = [0.into(), count.into()];
                if count > 0 && !body.is_empty() {
                    let flat = self.flat;
                    let going = repeated.while_positive.map(|array| self.language.at(&self.name(array), "0"));
                    self.language.repeat("i", &range, repeated.backwards, |language| {
                        statements(language, flat, body);
                        if let Some(going) = going {
                            let zero = language.number(0.0).text;
                            let ended = language.negated(&format!("{going} > {zero}"));
                            language.guard(&ended, L::LEAVE);
                        }
                    });
                }
            }
            // Arrays are cleared where they are declared; columns go to arrays.
            Statement::Clear(_) | Statement::Return(_) | Statement::Column { .. } => {}
        }
    }

    /// Returns `true` if zeros need not be assigned to an array.
    fn has_zeros(&self, array: usize) -> bool {
        self.flat.routine.arrays[array].role == Role::Result
            && match L::RESULTS {
                Results::Created => true,
                Results::Given => !self.flat.begins_whole(array) || self.flat.keeps_zeros(array),
                Results::Kept => self.flat.keeps_zeros(array),
            }
    }

    fn keeps_zeros(&self, array: usize) -> bool {
        L::RESULTS == Results::Kept && self.flat.keeps_zeros(array)
    }

    /// Declares a local array, or clears a result that has entries that are not written.
    fn declare(&mut self, array: usize) {
        let (name, len) = (self.name(array), self.flat.len(array));
        if L::RESULTS == Results::Created || self.flat.routine.arrays[array].role == Role::Zeros {
            self.language.zeros(&name, len);
        } else if !self.flat.begins_whole(array) && !self.keeps_zeros(array) {
            self.language.clear(&name, len);
        }
    }

    fn call(&mut self, routine: &str, arrays: &[usize], fresh: &[usize]) {
        let callee = self.flat.routines.named(routine);
        if L::RESULTS == Results::Given {
            let is_local = |array: &&usize| self.flat.routine.arrays[**array].role == Role::Zeros;
            fresh.iter().filter(is_local).for_each(|array| self.declare(*array));
        }
        let (mut given, mut filled) = (vec![], vec![]);
        for (array, other) in arrays.iter().zip(&callee.arrays) {
            let (len, name) = (self.flat.len(*array), self.name(*array));
            match other.role {
                _ if L::SKIPS_EMPTY && len == 0 => {}
                Role::Argument => given.push((other.name, name)),
                // The status covers the margin.
                Role::Margin if L::RESULTS == Results::Given => {}
                _ => filled.push((other.name, len, name)),
            }
        }
        let is_function = callee.function.is_some();
        let call = Invocation { routine: callee.name, is_function, given, filled, in_procedure: false };
        self.language.invoke(&call);
    }

    /// Prints sums: the constant of each entry, plus factors times terms.
    fn sums(&mut self, sums: usize, terms: usize, entries: usize) {
        let Sums { name, constants, factors } = &self.flat.routines.sums[sums];
        let [terms, entries] = [terms, entries].map(|array| self.name(array));
        let at = |list: &str| self.constant(&format!("{name}_{list}"), "k");
        let entry = |index: &str| self.language.at(&entries, index);
        let (first, constant) = (entry("k"), at("CONSTANTS"));
        let (place, term) = (entry(&at("ENTRIES")), self.language.at(&terms, &at("TERMS")));
        let product = format!("{} * {term}", at("FACTORS"));
        let range = |count: usize| [0.into(), count.into()];
        if !constants.is_empty() {
            self.language.repeat("k", &range(constants.len()), false, |language| {
                language.assign(&first, &constant, None);
            });
        }
        if !factors.is_empty() {
            self.language.repeat("k", &range(factors.len()), false, |language| {
                language.assign(&place, &format!("{place} + {product}"), Some(&product));
            });
        }
    }
}
