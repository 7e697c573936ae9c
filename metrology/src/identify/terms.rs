//! Terms of richer models: error functions with an unknown magnitude each.

use abbe::{Component, VariableKind};
use abbe_spec::expr::{Dimension, Motion};
use abbe_spec::{ChainNumber, DhNumber, Spec};

/// Error in proportion to a basis, with an unknown magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Quantity with the error.
    pub site: ErrorSite,
    /// Function that the error is proportional to.
    pub basis: Basis,
}

/// Quantity with an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorSite {
    /// Joint, in all transforms that depend on it.
    Joint(usize),
    /// Structural parameter, in all transforms that depend on it.
    Parameter(usize),
    /// One of the four numbers of a Denavit-Hartenberg frame; frames from 0.
    DenavitHartenberg(usize, DhNumber),
    /// Generalized error of a frame; frames from 0.
    Frame(usize, Component),
    /// Generalized error of the base, in `F_0`.
    Base(Component),
}

/// Function that an error is proportional to. An error of magnitude 1 is one length unit or 1 rad
/// times its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// Constant 1.
    One,
    /// Function of the joints.
    Wave(Wave),
    /// Product of two functions of the joints.
    Product(Wave, Wave),
    /// Input, in its unit.
    Input(usize),
    /// Moment of the loads about the error's own axis, a diagonal compliance: magnitude 1 is 1 µrad
    /// per N times the length unit.
    Moment,
    /// Moment of the loads about another axis, and the symmetric entry by reciprocity: an
    /// off-diagonal compliance in the same unit.
    Coupled(Component),
}

/// Function of the joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wave {
    /// Sine of an angle.
    Sine(Angle),
    /// Cosine of an angle.
    Cosine(Angle),
    /// Power of a joint's travel, in 1000 length units.
    Power {
        /// Index of the prismatic joint.
        variable: usize,
        /// Exponent.
        exponent: u8,
    },
}

/// Multiple of a joint angle, or its sum or difference with another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// Index of the revolute joint.
    pub variable: usize,
    /// Number of periods per turn.
    pub times: u16,
    /// Another revolute joint, added (`true`) or subtracted (`false`).
    pub other: Option<(usize, bool)>,
}

impl Angle {
    /// Returns a multiple of one joint angle.
    pub fn times(variable: usize, times: u16) -> Self {
        Self { variable, times, other: None }
    }

    fn value(self, q: &[f64]) -> f64 {
        let one = f64::from(self.times) * q[self.variable];
        match self.other {
            Some((other, true)) => one + q[other],
            Some((other, false)) => one - q[other],
            None => one,
        }
    }

    /// Formats the angle as an expression of a spec.
    fn text(self, spec: &Spec) -> String {
        let name = |variable: usize| spec.variables[variable].name.as_str();
        let one = match self.times {
            1 => name(self.variable).to_owned(),
            times => format!("{times}*{}", name(self.variable)),
        };
        match self.other {
            Some((other, true)) => format!("{one} + {}", name(other)),
            Some((other, false)) => format!("{one} - {}", name(other)),
            None => one,
        }
    }
}

impl Wave {
    /// Evaluates the function at joint values in rad and the spec's length unit.
    pub(super) fn value(self, q: &[f64]) -> f64 {
        match self {
            Self::Sine(angle) => angle.value(q).sin(),
            Self::Cosine(angle) => angle.value(q).cos(),
            Self::Power { variable, exponent } => (q[variable] / 1000.0).powi(i32::from(exponent)),
        }
    }

    fn text(self, spec: &Spec) -> String {
        match self {
            Self::Sine(angle) => format!("sin({})", angle.text(spec)),
            Self::Cosine(angle) => format!("cos({})", angle.text(spec)),
            Self::Power { variable, exponent } => {
                let (name, unit) = (&spec.variables[variable].name, spec.length.symbol());
                format!("({name}/(1000 {unit}))^{exponent}")
            }
        }
    }

    /// Describes the function for the name of a group of terms.
    fn kind(self, spec: &Spec) -> String {
        let name = |variable: usize| &spec.variables[variable].name;
        match self {
            Self::Sine(angle) | Self::Cosine(angle) if angle.other.is_none() => {
                let often = match angle.times {
                    1 => "once".to_owned(),
                    2 => "twice".to_owned(),
                    times => format!("{times} times"),
                };
                format!("{often} per turn of {}", name(angle.variable))
            }
            Self::Sine(angle) | Self::Cosine(angle) => format!("once per turn of {}", angle.text(spec)),
            Self::Power { variable, exponent: 1 } => format!("in proportion to {}", name(variable)),
            Self::Power { variable, exponent: 2 } => format!("with the square of {}", name(variable)),
            Self::Power { variable, .. } => format!("with the cube of {}", name(variable)),
        }
    }
}

impl Basis {
    /// Returns the sine and the cosine of an angle.
    pub(super) fn waves(angle: Angle) -> Vec<Self> {
        vec![Self::Wave(Wave::Sine(angle)), Self::Wave(Wave::Cosine(angle))]
    }

    /// Evaluates the basis at joint values and inputs; 1 for a compliance, which is not a factor.
    pub(super) fn value(self, q: &[f64], u: &[f64]) -> f64 {
        match self {
            Self::One | Self::Moment | Self::Coupled(_) => 1.0,
            Self::Wave(wave) => wave.value(q),
            Self::Product(one, other) => one.value(q) * other.value(q),
            Self::Input(input) => u[input],
        }
    }

    /// Returns true for a compliance.
    pub(super) fn is_elastic(self) -> bool {
        matches!(self, Self::Moment | Self::Coupled(_))
    }

    /// Formats the basis as an expression of a spec; for a compliance, its unit.
    pub(super) fn text(self, spec: &Spec) -> String {
        match self {
            Self::One => "1".to_owned(),
            Self::Wave(wave) => wave.text(spec),
            Self::Product(one, other) => format!("{} * {}", one.text(spec), other.text(spec)),
            Self::Input(input) => {
                let input = &spec.inputs[input];
                let one = if input.unit.is_empty() { "1".to_owned() } else { format!("(1 {})", input.unit) };
                format!("{}/{one}", input.name)
            }
            Self::Moment | Self::Coupled(_) => format!("1e-6/(N*{})", spec.length.symbol()),
        }
    }
}

impl Term {
    /// Returns the constant term that the basis multiplies. A compliance is its own carrier.
    pub(super) fn carrier(self) -> Self {
        if self.basis.is_elastic() { self } else { Self { basis: Basis::One, ..self } }
    }

    /// Returns a name that no other term has.
    pub fn name(&self, spec: &Spec) -> String {
        let (owner, error) = self.site.names(spec);
        match self.basis {
            Basis::One => match self.site {
                ErrorSite::Joint(_) => format!("zero of {owner}"),
                ErrorSite::Parameter(_) => owner.to_owned(),
                _ => format!("{error} of {owner}"),
            },
            Basis::Moment => format!("{owner}: elastic deflection, {error}"),
            Basis::Coupled(other) => {
                format!("{owner}: elastic deflection, {error} coupled with {}", other.name())
            }
            Basis::Input(input) => format!("{owner}: {error} with {}", spec.inputs[input].name),
            Basis::Wave(Wave::Power { variable, exponent }) => {
                format!("{owner}: {error} with {}^{exponent}", spec.variables[variable].name)
            }
            Basis::Wave(_) | Basis::Product(..) => format!("{owner}: {error} with {}", self.basis.text(spec)),
        }
    }

    /// Returns the name of the group of terms that this term belongs to.
    pub fn group(&self, spec: &Spec) -> String {
        let (owner, error) = self.site.names(spec);
        match self.basis {
            Basis::Wave(wave) => format!("{owner}: {}, {error}", wave.kind(spec)),
            Basis::Product(one, other) => {
                format!("{owner}: {} and {}, {error}", one.kind(spec), other.kind(spec))
            }
            Basis::One | Basis::Input(_) | Basis::Moment | Basis::Coupled(_) => self.name(spec),
        }
    }
}

impl ErrorSite {
    /// Returns the site of an error of a number of the chain.
    pub(super) fn from_chain_number(number: ChainNumber) -> Self {
        match number {
            ChainNumber::Joint(joint) => Self::Joint(joint),
            ChainNumber::Parameter(parameter) => Self::Parameter(parameter),
            ChainNumber::DenavitHartenberg { frame, number } => Self::DenavitHartenberg(frame, number),
        }
    }

    /// Returns the dimension of its error; an angle has none.
    pub(super) fn dimension(self, spec: &Spec) -> Dimension {
        let is_angle = match self {
            Self::Joint(joint) => spec.variables[joint].kind == VariableKind::Revolute,
            Self::Parameter(parameter) => return spec.parameters[parameter].dimension,
            Self::DenavitHartenberg(_, number) => number.motion().0 == Motion::Rotation,
            Self::Frame(_, component) | Self::Base(component) => component.is_rotation(),
        };
        if is_angle { Dimension::NONE } else { Dimension::LENGTH }
    }

    /// Returns the name of the quantity and the kind of its error.
    fn names(self, spec: &Spec) -> (&str, &'static str) {
        match self {
            Self::Joint(joint) => (&spec.variables[joint].name, "joint error"),
            Self::Parameter(parameter) => (&spec.parameters[parameter].name, "error"),
            Self::DenavitHartenberg(frame, number) => (&spec.frames[frame].name, number.name()),
            Self::Frame(frame, component) => (&spec.frames[frame].name, component.name()),
            Self::Base(component) => ("foundation", component.name()),
        }
    }
}
