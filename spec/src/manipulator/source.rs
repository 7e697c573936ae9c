//! Sources: physical errors, and what each does to the chain.

use abbe_core::{Class, Component};

use super::chain_number::ChainNumber;
use super::frame::Factor;
use crate::diagnostic::Span;
use crate::expr::Expression;

/// A physical error.
#[derive(Clone, Debug)]
pub struct Source {
    /// Its name.
    pub name: String,
    /// Repeatable or random.
    pub class: Class,
    /// Of the standard deviation of a normal error that was estimated from few measurements; infinite if it is known.
    pub degrees_of_freedom: f64,
    /// Whether it takes part; a named alternative does not.
    pub enabled: bool,
    /// What it is.
    pub description: String,
    /// Where its numbers come from.
    pub reference: String,
    /// What its errors are multiplied by, if that is to be found.
    pub magnitude: Option<Magnitude>,
    /// The input that they are multiplied by instead, if that is given at run time.
    pub tuned_by: Option<usize>,
    /// What it does to which frame, in the order of the file.
    pub effects: Vec<Effect>,
    /// Which numbers of the chain it changes, in the order of the file; at least one if there are no effects.
    pub deviations: Vec<Deviation>,
}

/// What a source does to a frame, or to a place on the link behind it.
#[derive(Clone, Debug)]
pub struct Effect {
    /// The frame, from 0.
    pub frame: usize,
    /// Where on the link, as seen from the frame: `L`; no factors if at the frame itself.
    pub at: Vec<Factor>,
    /// The error there.
    pub cause: Cause,
    /// Where in the file it stands.
    pub span: Span,
}

/// How a place on a link moves against where it should be.
#[derive(Clone, Debug)]
pub enum Cause {
    /// By so much: some of the six errors, lengths or rad.
    Errors(Vec<(Component, Expression)>),
    /// As the tip of a beam under the loads beyond it.
    Beam(Beam),
    /// By a compliance times the wrench of the loads beyond it.
    Compliance(Box<Compliance>),
}

impl Cause {
    /// Whether it gives way under loads.
    pub fn is_elastic(&self) -> bool {
        !matches!(self, Self::Errors(_))
    }
}

/// A straight beam that ends where its effect is, clamped at its other end.
#[derive(Clone, Debug)]
pub struct Beam {
    /// The axis along which it comes, 0 = x, 1 = y, 2 = z.
    pub axis: usize,
    /// Its length.
    pub length: Expression,
    /// Bending stiffnesses about the two axes that follow its own in cyclic order.
    pub bending: [Expression; 2],
    /// Torsional stiffness; rigid if there is none.
    pub torsion: Option<Expression>,
    /// Stiffness against extension; rigid if there is none.
    pub extension: Option<Expression>,
    /// Its own mass per length; it weighs nothing if there is none.
    pub mass_per_length: Option<Expression>,
}

/// Six errors per unit of six forces and moments, both in the order of ε; none where zero.
pub type Compliance = [[Option<Expression>; 6]; 6];

/// A number of the nominal chain that is not what the chain says: `A_i(q + δq)` where `A_i(q)` is meant.
#[derive(Clone, Debug)]
pub struct Deviation {
    /// Which number.
    pub number: ChainNumber,
    /// How much more it really is, in the number's own dimension.
    pub error: Expression,
    /// Where in the file it stands.
    pub span: Span,
}

/// What a source is multiplied by: a number that measurements may tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnitude {
    /// The number as far as it is known.
    pub value: f64,
    /// How well: its standard deviation; none if nothing is known.
    pub standard_deviation: Option<f64>,
    /// Of that standard deviation; infinite if it is known.
    pub degrees_of_freedom: f64,
}
