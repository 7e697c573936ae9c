//! Names that an expression may use.

use std::sync::Arc;

use abbe_core::LengthUnit;
use indexmap::IndexMap;

use super::{Dimension, Table};
use crate::diagnostic::Span;

/// Kind of a name, with its index within the kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// A joint variable `q`.
    Variable(usize),
    /// A passive joint variable `p`, which the loops determine.
    Passive(usize),
    /// A structural parameter `s`.
    Parameter(usize),
    /// An input `u`.
    Input(usize),
    /// A generalized error ε. Not in specs, but in the test that `J_e` is the derivative by it.
    Error(usize),
    /// The magnitude that multiplies the errors of a source. Not in specs, but in the exact chain.
    Magnitude(usize),
    /// An entry of the pose that inverse kinematics is to reach. Not in specs.
    Target(usize),
    /// One of the numbers that the body of a loop reads. Not in specs.
    Local(usize),
}

impl Symbol {
    /// Returns `true` for joint variables, commanded or passive.
    pub fn is_joint(self) -> bool {
        matches!(self, Self::Variable(_) | Self::Passive(_))
    }
}

/// A declared name.
#[derive(Clone, Debug)]
pub struct Name {
    /// The symbol.
    pub symbol: Symbol,
    /// Dimension; `None` if its declaration has a mistake, so that no further ones are reported.
    pub dimension: Option<Dimension>,
    /// Location of the declaration.
    pub span: Span,
    /// Least and largest value; infinite without limits.
    pub range: [f64; 2],
}

/// Declared names of a spec, and its length unit.
#[derive(Clone, Debug)]
pub struct Scope {
    /// Unit of a bare length.
    pub length: LengthUnit,
    /// Names in the order of their declaration.
    pub names: IndexMap<String, Name>,
    /// Tables of the spec.
    pub tables: Vec<Arc<Table>>,
}

impl Scope {
    /// Creates a scope without names.
    pub fn new(length: LengthUnit) -> Self {
        Self { length, names: IndexMap::new(), tables: Vec::new() }
    }

    /// Returns the table with this name, and its index.
    pub(super) fn table(&self, name: &str) -> Option<(u16, &Arc<Table>)> {
        let index = self.tables.iter().position(|table| table.name == name)?;
        Some((u16::try_from(index).ok()?, &self.tables[index]))
    }
}

/// Requirements on an expression that is a whole entry of a spec.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// Required dimension; `None` for any.
    pub dimension: Option<Dimension>,
    /// Name of the entry with its article: `the translation along x`.
    pub what: &'a str,
    /// Names that it may use.
    pub names: Allowed,
}

impl<'a> Entry<'a> {
    /// Creates requirements.
    pub fn new(dimension: impl Into<Option<Dimension>>, what: &'a str, names: Allowed) -> Self {
        Self { dimension: dimension.into(), what, names }
    }
}

/// Names that an entry may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Allowed {
    /// No names: the entry is a constant.
    Nothing,
    /// Variables, passive ones too, and parameters: the entry is part of a nominal transform.
    Geometry,
    /// Variables, parameters and inputs: the entry is a physical error.
    Everything,
}

impl Allowed {
    /// Checks whether the entry may use `symbol`; the error is the reason.
    pub(crate) fn check(self, symbol: Symbol) -> Result<(), &'static str> {
        match (self, symbol) {
            (Self::Nothing, _) => Err("expected a constant"),
            (Self::Geometry, Symbol::Input(_)) => {
                Err("a nominal transform cannot depend on an input: use the input in a [[source]]")
            }
            _ => Ok(()),
        }
    }
}
