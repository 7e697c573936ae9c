//! Terms of richer models: errors of one unit each, whose magnitudes are unknown.

use abbe::Component;
use abbe_spec::{ChainNumber, DhNumber, Spec};

/// An error in proportion to a basis; its magnitude is to be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// What it is an error of.
    pub place: ErrorSite,
    /// What it is in proportion to.
    pub basis: Basis,
}

/// What a term is an error of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorSite {
    /// A joint, wherever transforms depend on it.
    Joint(usize),
    /// A structural parameter, likewise.
    Parameter(usize),
    /// One of the four numbers of a Denavit-Hartenberg frame, from 0.
    DenavitHartenberg(usize, DhNumber),
    /// One of the six errors of a frame, from 0.
    Frame(usize, Component),
    /// One of the six errors of the base, in `F_0`.
    Base(Component),
}

/// What an error is in proportion to. Of magnitude 1 it is one length unit or 1 rad, times this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// Nothing: it is always the same.
    One,
    /// A number that changes with the joints.
    Wave(Wave),
    /// The product of two.
    Product(Wave, Wave),
    /// An input, in its unit.
    Input(usize),
    /// The moment that weights have about the frame, in 10⁶ N times the length unit: a compliance.
    Moment,
    /// The moment about another axis, and the other way round, by reciprocity: what a compliance has off its diagonal, in the same
    /// unit.
    Coupled(Component),
}

/// A number that changes with the joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wave {
    /// The sine of an angle.
    Sine(Angle),
    /// The cosine.
    Cosine(Angle),
    /// A power of a joint's travel, in 1000 length units.
    Power {
        /// The prismatic joint.
        variable: usize,
        /// The exponent.
        exponent: u8,
    },
}

/// So many times a joint angle, or the sum or difference of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// The revolute joint.
    pub variable: usize,
    /// How many periods a turn of it has.
    pub times: u16,
    /// Another revolute joint, added or (`false`) taken off.
    pub other: Option<(usize, bool)>,
}

impl Angle {
    /// So many times one joint angle.
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

    /// As a spec has it.
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
    /// At joint values, of a spec whose length unit makes 1000 of them one.
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

    /// Of a group of terms: once per turn of a joint, in proportion to it, with a sum of two.
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
    /// The sine and cosine of an angle.
    pub(super) fn waves(angle: Angle) -> Vec<Self> {
        vec![Self::Wave(Wave::Sine(angle)), Self::Wave(Wave::Cosine(angle))]
    }

    /// Its value where joints and inputs are these; 1 of what is no factor of an error but its cause.
    pub(super) fn value(self, q: &[f64], u: &[f64]) -> f64 {
        match self {
            Self::One | Self::Moment | Self::Coupled(_) => 1.0,
            Self::Wave(wave) => wave.value(q),
            Self::Product(one, other) => one.value(q) * other.value(q),
            Self::Input(input) => u[input],
        }
    }

    /// Whether it is a compliance.
    pub(super) fn is_elastic(self) -> bool {
        matches!(self, Self::Moment | Self::Coupled(_))
    }

    /// As an expression of a spec; a compliance is none, it is one per this.
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
    /// The error that its basis is a factor of, by itself: a compliance is its own.
    pub(super) fn carrier(self) -> Self {
        if self.basis.is_elastic() { self } else { Self { basis: Basis::One, ..self } }
    }

    /// What it is called: a name that no other term has.
    pub fn name(&self, spec: &Spec) -> String {
        let (owner, error) = self.place.names(spec);
        match self.basis {
            Basis::One => match self.place {
                ErrorSite::Joint(_) => format!("zero of {owner}"),
                ErrorSite::Parameter(_) => owner.to_owned(),
                _ => format!("{error} of {owner}"),
            },
            Basis::Moment => format!("{owner}: gives way under weight, {error}"),
            Basis::Coupled(other) => {
                format!("{owner}: gives way under weight, {error} with {}", other.name())
            }
            Basis::Input(input) => format!("{owner}: {error} with {}", spec.inputs[input].name),
            Basis::Wave(Wave::Power { variable, exponent }) => {
                format!("{owner}: {error} with {}^{exponent}", spec.variables[variable].name)
            }
            Basis::Wave(_) | Basis::Product(..) => format!("{owner}: {error} with {}", self.basis.text(spec)),
        }
    }

    /// What the group is called that it comes in.
    pub fn group(&self, spec: &Spec) -> String {
        let (owner, error) = self.place.names(spec);
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
    /// A number of the chain.
    pub(super) fn of_number(number: ChainNumber) -> Self {
        match number {
            ChainNumber::Joint(joint) => Self::Joint(joint),
            ChainNumber::Parameter(parameter) => Self::Parameter(parameter),
            ChainNumber::DenavitHartenberg { frame, number } => Self::DenavitHartenberg(frame, number),
        }
    }

    /// What the term belongs to, and which of its errors it is.
    fn names(self, spec: &Spec) -> (&str, &'static str) {
        match self {
            Self::Joint(joint) => (&spec.variables[joint].name, "joint error"),
            Self::Parameter(parameter) => (&spec.parameters[parameter].name, "error"),
            Self::DenavitHartenberg(frame, number) => (&spec.frames[frame].name, number.name()),
            Self::Frame(frame, component) => (&spec.frames[frame].name, component.name()),
            Self::Base(component) => ("what the machine stands on", component.name()),
        }
    }
}
