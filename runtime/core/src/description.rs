//! What a manipulator says about itself: names, units, limits, sources.

use crate::{Component, List, Text};

/// The length unit of a manipulator's poses, Jacobians, variables and errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Metres.
    Metre,
    /// Millimetres.
    Millimetre,
}

impl LengthUnit {
    /// `m` or `mm`.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Millimetre => "mm",
        }
    }

    /// The unit's length in metres.
    pub const fn in_metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Millimetre => 1e-3,
        }
    }
}

/// What rows 4–6 of a Jacobian are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// The small rotation in `F_0` axes; no singularity.
    RotationVector,
    /// Spin σ, roll ρ, pitch π of `R_T = R_y(σ) R_z(ρ) R_x(π)`; singular at cos ρ = 0.
    EulerYzx,
}

impl Orientation {
    /// Its name in a spec file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::RotationVector => "rotation-vector",
            Self::EulerYzx => "euler-yzx",
        }
    }

    /// The names of the six rows of a Jacobian.
    pub const fn rows(self) -> [&'static str; 6] {
        match self {
            Self::RotationVector => ["x", "y", "z", "rotation_x", "rotation_y", "rotation_z"],
            Self::EulerYzx => ["x", "y", "z", "spin", "roll", "pitch"],
        }
    }
}

/// Whether a variable turns or slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableKind {
    /// An angle, rad.
    Revolute,
    /// A length, in the manipulator's unit.
    Prismatic,
}

/// A joint variable. Lengths in the manipulator's unit, angles in rad.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name in the spec.
    pub name: Text,
    /// Revolute or prismatic.
    pub kind: VariableKind,
    /// Lower and upper limit, infinite where the spec has none.
    pub limits: [f64; 2],
    /// Its value at the home configuration.
    pub home: f64,
}

impl Variable {
    /// All its fields, in their order.
    pub const fn new(name: &'static str, kind: VariableKind, limits: [f64; 2], home: f64) -> Self {
        Self { name: Text::Constant(name), kind, limits, home }
    }
}

/// A frame `F_i` of the chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Its name in the spec.
    pub name: Text,
    /// Index of the variable that it declares; none if it is fixed.
    pub variable: Option<usize>,
    /// Whether it is known to be a lower pair, or fixed: `A_i` depends on no variable but its own, and that turns it about
    /// or moves it along an axis which is fixed in `F_{i-1}`, one to one. Of the last frame: and `T` is fixed.
    ///
    /// What cannot be reached is then known without a search.
    pub lower_pair: bool,
}

impl Frame {
    /// A frame that may move in any way.
    pub const fn new(name: &'static str, variable: Option<usize>) -> Self {
        Self { name: Text::Constant(name), variable, lower_pair: false }
    }

    /// A frame that is known to be a lower pair, or fixed.
    pub const fn lower_pair(name: &'static str, variable: Option<usize>) -> Self {
        Self { name: Text::Constant(name), variable, lower_pair: true }
    }
}

/// A structural parameter, in coherent units (the length unit, kg, s, rad, K).
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in the spec.
    pub name: Text,
    /// Its nominal value.
    pub nominal: f64,
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: Text,
}

impl Parameter {
    /// All its fields, in their order.
    pub const fn new(name: &'static str, nominal: f64, unit: &'static str) -> Self {
        Self { name: Text::Constant(name), nominal, unit: Text::Constant(unit) }
    }
}

/// An input: what changes from use to use. Coherent units.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Its name in the spec.
    pub name: Text,
    /// Its default value.
    pub nominal: f64,
    /// The range within which it is accepted, infinite where the spec has none.
    pub range: [f64; 2],
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: Text,
}

impl Input {
    /// All its fields, in their order.
    pub const fn new(name: &'static str, nominal: f64, range: [f64; 2], unit: &'static str) -> Self {
        Self { name: Text::Constant(name), nominal, range, unit: Text::Constant(unit) }
    }
}

/// Whether an error has the same value and sign every time a configuration is visited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Same value and sign every time: sums with sign, can be compensated.
    Repeatable,
    /// Changes unpredictably: adds as root sum of squares, cannot be compensated.
    Random(Distribution),
}

impl Class {
    /// Whether no error is larger than its bound: of a repeatable source there is one only.
    pub const fn is_bounded(self) -> bool {
        match self {
            Self::Repeatable => true,
            Self::Random(distribution) => distribution.is_bounded(),
        }
    }
}

/// How a random error is distributed, and so what its magnitude means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// The magnitude is the half-width.
    Uniform,
    /// The magnitude is the standard deviation.
    Normal,
    /// The magnitude is the half-width; the middle is the most likely.
    Triangular,
    /// The magnitude is the amplitude of a sine whose phase is not known: an eccentricity, say. The ends are the most
    /// likely.
    Arcsine,
}

impl Distribution {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Uniform, Self::Normal, Self::Triangular, Self::Arcsine];

    /// Its name, as in a spec.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Normal => "normal",
            Self::Triangular => "triangular",
            Self::Arcsine => "arcsine",
        }
    }

    /// Whether no error is larger than its [`bound`](Self::bound).
    pub const fn is_bounded(self) -> bool {
        !matches!(self, Self::Normal)
    }

    /// The bound of an error in multiples of its magnitude: 3 (3σ, which 0.27 % of the errors exceed) of a normal one,
    /// 1 of all others.
    pub const fn bound(self) -> f64 {
        if self.is_bounded() { 1.0 } else { 3.0 }
    }

    /// The square of its [`divisor`](Self::divisor).
    pub const fn divisor_squared(self) -> f64 {
        match self {
            Self::Uniform => 3.0,
            Self::Normal => 1.0,
            Self::Triangular => 6.0,
            Self::Arcsine => 2.0,
        }
    }

    /// What the magnitude is divided by for the standard uncertainty (GUM, 4.3.7 and 4.3.9): √3 of a uniform error,
    /// 1 of a normal, √6 of a triangular, √2 of an arcsine one.
    pub const fn divisor(self) -> f64 {
        match self {
            Self::Uniform => 1.732_050_807_568_877_2,
            Self::Normal => 1.0,
            Self::Triangular => 2.449_489_742_783_178,
            Self::Arcsine => core::f64::consts::SQRT_2,
        }
    }
}

/// A physical error source.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Its name in the spec.
    pub name: Text,
    /// Repeatable, or random with a distribution.
    pub class: Class,
    /// Of the standard deviation of a normal error that was estimated from few measurements (GUM, G.3); infinite if it is
    /// known.
    pub degrees_of_freedom: f64,
    /// What it is an error of: `joint q2`, `parameter a2`, `dh of elbow`, `frame elbow`.
    pub at: Text,
    /// Where its numbers come from.
    pub reference: Text,
}

impl Source {
    /// All its fields but the degrees of freedom, in their order; these are infinite.
    pub const fn new(name: &'static str, class: Class, at: &'static str, reference: &'static str) -> Self {
        Self::estimated(name, class, f64::INFINITY, at, reference)
    }

    /// All its fields, in their order.
    pub const fn estimated(
        name: &'static str,
        class: Class,
        degrees_of_freedom: f64,
        at: &'static str,
        reference: &'static str,
    ) -> Self {
        Self {
            name: Text::Constant(name),
            class,
            degrees_of_freedom,
            at: Text::Constant(at),
            reference: Text::Constant(reference),
        }
    }
}

/// One generalized error that a source causes. The effects of one random source share one magnitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effect {
    /// Index of the source.
    pub source: usize,
    /// Index of the frame, 0 for `F_1`.
    pub frame: usize,
    /// Which of the frame's six errors.
    pub component: Component,
}

impl Effect {
    /// All its fields, in their order.
    pub const fn new(source: usize, frame: usize, component: Component) -> Self {
        Self { source, frame, component }
    }
}

/// What a manipulator says about itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Its name: a module and file name.
    pub name: Text,
    /// Its name for people.
    pub title: Text,
    /// The unit of every length.
    pub length: LengthUnit,
    /// What rows 4–6 of its Jacobians are.
    pub orientation: Orientation,
    /// `F_1 … F_n`.
    pub frames: List<Frame>,
    /// `q`, in the order of the frames that declare them.
    pub variables: List<Variable>,
    /// The structural parameters `s`.
    pub parameters: List<Parameter>,
    /// The inputs `u`.
    pub inputs: List<Input>,
    /// The enabled error sources.
    pub sources: List<Source>,
    /// What the sources cause, source by source.
    pub effects: List<Effect>,
}

impl Description {
    /// ε from the values of the effects: of the repeatable sources, six errors per frame.
    ///
    /// Effects and frames that one of the slices does not reach are left out.
    pub fn generalized_errors(&self, effects: &[f64], errors: &mut [[f64; 6]]) {
        errors.fill([0.0; 6]);
        for (effect, value) in self.effects.iter().zip(effects) {
            let repeatable = self.sources[effect.source].class == Class::Repeatable;
            if let Some(error) = errors.get_mut(effect.frame).filter(|_| repeatable) {
                error[effect.component.index()] += value;
            }
        }
    }
}
