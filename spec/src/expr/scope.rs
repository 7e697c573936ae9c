//! What a name in an expression can be.

use std::sync::Arc;

use abbe_core::LengthUnit;
use indexmap::IndexMap;

use super::{Dimension, Table};
use crate::diagnostic::Span;

/// What a name stands for, with its index among its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// A joint variable `q`.
    Variable(usize),
    /// A structural parameter `s`.
    Parameter(usize),
    /// An input `u`.
    Input(usize),
    /// A generalized error ε: never in a spec, but in the proof that `J_e` is its derivative.
    Error(usize),
    /// What the errors of a source are multiplied with: never in a spec, but in the exact chain.
    Magnitude(usize),
    /// One of the numbers that the body of a loop reads: never in a spec.
    Local(usize),
}

/// A declared name.
#[derive(Clone, Debug)]
pub struct Name {
    /// What it stands for.
    pub symbol: Symbol,
    /// Its dimension; none if its declaration is itself mistaken, so that it causes no further mistakes.
    pub dimension: Option<Dimension>,
    /// Where it is declared.
    pub span: Span,
    /// Its least and its largest value, infinite without limits.
    pub range: [f64; 2],
}

/// Every declared name of a spec, and its length unit.
#[derive(Clone, Debug)]
pub struct Scope {
    /// What a bare number of length is in.
    pub length: LengthUnit,
    /// The names, in the order of their declaration.
    pub names: IndexMap<String, Name>,
    /// The functions that are given by points.
    pub tables: Vec<Arc<Table>>,
}

impl Scope {
    /// No names yet.
    pub fn new(length: LengthUnit) -> Self {
        Self { length, names: IndexMap::new(), tables: Vec::new() }
    }

    /// The table of that name, and which it is.
    pub(super) fn table(&self, name: &str) -> Option<(u16, &Arc<Table>)> {
        let index = self.tables.iter().position(|table| table.name == name)?;
        Some((u16::try_from(index).ok()?, &self.tables[index]))
    }
}

/// What is expected of an expression that is a whole entry of a spec.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// The dimension it must have; none if any will do.
    pub dimension: Option<Dimension>,
    /// What it is, with its article: `the translation along x`.
    pub what: &'a str,
    /// Which names it may use.
    pub names: Allowed,
}

/// Which names an entry may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Allowed {
    /// None: the entry is a number.
    Nothing,
    /// Variables and parameters: the entry is part of a nominal matrix.
    Geometry,
    /// Inputs too: the entry is a physical error.
    Everything,
}

impl Allowed {
    /// Whether the entry may use `symbol`, or else why not.
    pub(crate) fn check(self, symbol: Symbol) -> Result<(), &'static str> {
        match (self, symbol) {
            (Self::Nothing, _) => Err("only numbers may stand here"),
            (Self::Geometry, Symbol::Input(_)) => {
                Err("a nominal matrix may not depend on an input: say what the input changes in a [[source]]")
            }
            _ => Ok(()),
        }
    }
}
