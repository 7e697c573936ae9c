//! What a checked spec holds. Numbers are in its coherent system: its length unit, kg, s, rad, K.

use std::path::PathBuf;
use std::sync::Arc;

use abbe_core::{Class, Component, LengthUnit, Orientation, VariableKind};

use super::{Covariance, Fitted};
use crate::diagnostic::Span;
use crate::expr::{Dimension, Elementary, Expression, Motion, Symbol, Table};

/// A manipulator as its file describes it.
#[derive(Clone, Debug)]
pub struct Spec {
    /// Its name: a lower snake case identifier.
    pub name: String,
    /// Its name for people.
    pub title: String,
    /// What it is.
    pub description: String,
    /// Where its numbers come from.
    pub reference: String,
    /// The unit of every length.
    pub length: LengthUnit,
    /// What rows 4–6 of the Jacobians are.
    pub orientation: Orientation,
    /// The structural parameters `s`.
    pub parameters: Vec<Parameter>,
    /// The inputs `u`.
    pub inputs: Vec<Input>,
    /// The joint variables `q`, in the order of the frames that declare them.
    pub variables: Vec<Variable>,
    /// `A_1 … A_n`, base to tip.
    pub frames: Vec<Frame>,
    /// `T`, from `F_n` to the tool point; no factors if there is none.
    pub tool: Vec<Factor>,
    /// The physical errors, those that are switched off among them.
    pub sources: Vec<Source>,
    /// What weighs on the structure.
    pub loads: Vec<Load>,
    /// The acceleration of gravity in `F_0`.
    pub gravity: Option<[Expression; 3]>,
    /// Where the errors of an identified machine were fitted; nothing if they were not.
    pub fitted: Vec<Fitted>,
    /// How well these errors are known; of nothing if they were not identified.
    pub covariance: Covariance,
    /// Functions that are given by points.
    pub tables: Vec<Arc<Table>>,
    /// The file's name, without its folder.
    pub file: String,
    /// Further files that were read: those of tables.
    pub beside: Vec<PathBuf>,
    /// SHA-256 of the file's text and of what is in the files of its tables, in hexadecimal.
    pub hash: String,
}

/// A structural parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its nominal value.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: String,
    /// What it is.
    pub description: String,
}

/// An input.
#[derive(Clone, Debug)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its default value.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: String,
    /// Lower and upper end of its range, infinite if it has none.
    pub range: [f64; 2],
    /// What it is.
    pub description: String,
}

/// A joint variable.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Revolute or prismatic.
    pub kind: VariableKind,
    /// Lower and upper limit, infinite if it has none.
    pub limits: [f64; 2],
    /// Its value at home.
    pub home: f64,
    /// What it is.
    pub description: String,
    /// The frame that declares it, from 0.
    pub frame: usize,
}

/// A frame `F_i` and the way to it from `F_{i-1}`.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Its name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// The variable that it declares.
    pub variable: Option<usize>,
    /// `A_i` as a product.
    pub factors: Vec<Factor>,
    /// Which product, if it is given by Denavit-Hartenberg numbers.
    pub convention: Option<DhConvention>,
}

/// A factor of an `A_i`.
#[derive(Clone, Debug, PartialEq)]
pub enum Factor {
    /// A motion along or about x, y or z.
    Elementary(Elementary),
    /// A motion along or about any other axis.
    About {
        /// Translation or rotation.
        motion: Motion,
        /// The axis, of length 1.
        axis: [f64; 3],
        /// How far.
        amount: Expression,
    },
    /// Any rigid motion.
    Matrix(Box<Matrix>),
}

/// The upper three rows of a homogeneous matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Three rows of four.
    pub rows: [[Expression; 4]; 3],
    /// Where it stands.
    pub span: Span,
}

impl Factor {
    /// Every expression in it.
    pub fn expressions(&self) -> Vec<&Expression> {
        match self {
            Self::Elementary(factor) => vec![&factor.amount],
            Self::About { amount, .. } => vec![amount],
            Self::Matrix(matrix) => matrix.rows.iter().flatten().collect(),
        }
    }
}

impl Spec {
    /// The joint variables on which each of `A_1 … A_n` and `T` depends.
    pub fn variables_of_transforms(&self) -> Vec<Vec<usize>> {
        let variables = |factors: &Vec<Factor>| {
            let symbols = factors.iter().flat_map(Factor::expressions).flat_map(Expression::symbols);
            let variable = |symbol| match symbol {
                Symbol::Variable(variable) => Some(variable),
                _ => None,
            };
            symbols.filter_map(variable).collect()
        };
        self.frames.iter().map(|frame| &frame.factors).chain([&self.tool]).map(variables).collect()
    }
}

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

/// What acts on the structure: the weight of a mass, a force, a moment.
#[derive(Clone, Debug)]
pub struct Load {
    /// What weighs under gravity.
    pub mass: Option<Expression>,
    /// A force, along x, y and z.
    pub force: Option<[Expression; 3]>,
    /// A moment, about x, y and z.
    pub moment: Option<[Expression; 3]>,
    /// Whose axes force and moment are in.
    pub axes: Axes,
    /// The frame it moves with, from 0.
    pub frame: usize,
    /// Where it acts.
    pub point: Point,
}

/// The axes of a force or moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// Those of its load's frame: it turns with that.
    Frame,
    /// Those of `F_0`.
    Base,
}

/// Where a load acts.
#[derive(Clone, Debug)]
pub enum Point {
    /// Here, as seen from its frame.
    Here([Expression; 3]),
    /// At the tool point; its frame is the last one.
    Tool,
}

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

/// A number of the nominal chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ChainNumber {
    /// A joint variable, wherever a transform depends on it.
    Joint(usize),
    /// A structural parameter, wherever a transform depends on it.
    Parameter(usize),
    /// One of the four numbers of a frame that is given by them.
    DenavitHartenberg {
        /// The frame, from 0.
        frame: usize,
        /// Which of the four.
        number: DhNumber,
    },
}

/// One of the four Denavit-Hartenberg numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DhNumber {
    /// The turn about z.
    Theta,
    /// The shift along z.
    D,
    /// The shift along x.
    A,
    /// The turn about x.
    Alpha,
}

impl DhNumber {
    /// All four.
    pub const ALL: [Self; 4] = [Self::Theta, Self::D, Self::A, Self::Alpha];

    /// Its key in a spec.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Theta => "theta",
            Self::D => "d",
            Self::A => "a",
            Self::Alpha => "alpha",
        }
    }

    /// What it does, and along or about which axis: 0 = x, 1 = y, 2 = z.
    pub const fn motion(self) -> (Motion, usize) {
        match self {
            Self::Theta => (Motion::Rotation, 2),
            Self::D => (Motion::Translation, 2),
            Self::A => (Motion::Translation, 0),
            Self::Alpha => (Motion::Rotation, 0),
        }
    }
}

/// Which product of its four numbers a Denavit-Hartenberg frame is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DhConvention {
    /// `Rz(theta) Tz(d) Tx(a) Rx(alpha)`.
    Standard,
    /// Craig's: `Rx(alpha) Tx(a) Rz(theta) Tz(d)`.
    Modified,
}

impl DhConvention {
    /// The numbers in the order of the frame's factors, one factor each.
    pub const fn order(self) -> [DhNumber; 4] {
        match self {
            Self::Standard => [DhNumber::Theta, DhNumber::D, DhNumber::A, DhNumber::Alpha],
            Self::Modified => [DhNumber::Alpha, DhNumber::A, DhNumber::Theta, DhNumber::D],
        }
    }
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
