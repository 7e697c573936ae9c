//! What a manipulator says about itself: names, units, limits, sources.

use crate::Component;

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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variable<'a> {
    /// Its name in the spec.
    pub name: &'a str,
    /// Revolute or prismatic.
    pub kind: VariableKind,
    /// Lower and upper limit, infinite where the spec has none.
    pub limits: [f64; 2],
    /// Its value at the home configuration.
    pub home: f64,
}

impl<'a> Variable<'a> {
    /// All its fields, in their order.
    pub const fn new(name: &'a str, kind: VariableKind, limits: [f64; 2], home: f64) -> Self {
        Self { name, kind, limits, home }
    }
}

/// A frame `F_i` of the chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<'a> {
    /// Its name in the spec.
    pub name: &'a str,
    /// Index of the variable that it declares; none if it is fixed.
    pub variable: Option<usize>,
}

impl<'a> Frame<'a> {
    /// All its fields, in their order.
    pub const fn new(name: &'a str, variable: Option<usize>) -> Self {
        Self { name, variable }
    }
}

/// A structural parameter, in coherent units (the length unit, kg, s, rad, K).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter<'a> {
    /// Its name in the spec.
    pub name: &'a str,
    /// Its nominal value.
    pub nominal: f64,
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: &'a str,
}

impl<'a> Parameter<'a> {
    /// All its fields, in their order.
    pub const fn new(name: &'a str, nominal: f64, unit: &'a str) -> Self {
        Self { name, nominal, unit }
    }
}

/// An input: what changes from use to use. Coherent units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input<'a> {
    /// Its name in the spec.
    pub name: &'a str,
    /// Its default value.
    pub nominal: f64,
    /// The range within which it is accepted, infinite where the spec has none.
    pub range: [f64; 2],
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: &'a str,
}

impl<'a> Input<'a> {
    /// All its fields, in their order.
    pub const fn new(name: &'a str, nominal: f64, range: [f64; 2], unit: &'a str) -> Self {
        Self { name, nominal, range, unit }
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

/// How a random error is distributed, and so what its magnitude means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// The magnitude is the half-width.
    Uniform,
    /// The magnitude is the standard deviation.
    Normal,
}

impl Distribution {
    /// The bound of an error in multiples of its magnitude: 1 for a uniform one, 3 (3σ) for a normal one.
    pub const fn bound(self) -> f64 {
        match self {
            Self::Uniform => 1.0,
            Self::Normal => 3.0,
        }
    }
}

/// A physical error source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source<'a> {
    /// Its name in the spec.
    pub name: &'a str,
    /// Repeatable, or random with a distribution.
    pub class: Class,
    /// Where its numbers come from.
    pub reference: &'a str,
}

impl<'a> Source<'a> {
    /// All its fields, in their order.
    pub const fn new(name: &'a str, class: Class, reference: &'a str) -> Self {
        Self { name, class, reference }
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description<'a> {
    /// Its name: a module and file name.
    pub name: &'a str,
    /// Its name for people.
    pub title: &'a str,
    /// The unit of every length.
    pub length: LengthUnit,
    /// What rows 4–6 of its Jacobians are.
    pub orientation: Orientation,
    /// `F_1 … F_n`.
    pub frames: &'a [Frame<'a>],
    /// `q`, in the order of the frames that declare them.
    pub variables: &'a [Variable<'a>],
    /// The structural parameters `s`.
    pub parameters: &'a [Parameter<'a>],
    /// The inputs `u`.
    pub inputs: &'a [Input<'a>],
    /// The enabled error sources.
    pub sources: &'a [Source<'a>],
    /// What the sources cause, source by source.
    pub effects: &'a [Effect],
}

impl Description<'_> {
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
