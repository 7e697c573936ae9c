//! Terms of richer models: error functions with an unknown magnitude each.

use abbe::{Component, VariableKind, analysis::sampling::range_of, identify::Observation};
use abbe_spec::edit::write::number;
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
    /// Power of the travel of a prismatic joint, in 1000 length units.
    Power {
        /// Travel.
        joint: HeldJoint,
        /// Exponent.
        exponent: u8,
    },
}

/// Joint variable, held at the ends of a range outside of it: what rows say of a function within
/// the range that they cover says nothing of it beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldJoint {
    /// Index of the variable.
    pub variable: usize,
    /// Range, in rad or the length unit; none if the function continues everywhere.
    pub range: Option<[f64; 2]>,
}

impl HeldJoint {
    /// Returns a joint that is held nowhere.
    pub fn free(variable: usize) -> Self {
        Self { variable, range: None }
    }

    fn within(self, ranges: &[Option<[f64; 2]>]) -> Self {
        Self { range: ranges.get(self.variable).copied().flatten(), ..self }
    }

    fn value(self, q: &[f64]) -> f64 {
        let value = q[self.variable];
        self.range.map_or(value, |[least, most]| value.clamp(least, most))
    }

    fn text(self, spec: &Spec) -> String {
        let name = &spec.variables[self.variable].name;
        let Some(ends) = self.range else { return name.clone() };
        let unit = spec.variables[self.variable].kind.either("", spec.length.symbol());
        let [least, most] = ends.map(|end| format!("{end} {unit}").trim_end().to_owned());
        format!("min(max({name}, {least}), {most})")
    }
}

/// Smallest share of a turn, or of the limits, that rows cover where functions of a joint continue
/// beyond these rows.
const COVERED: f64 = 0.9;

/// Smallest range of a joint, in rad, over which waves of frames are told from constant errors.
const TOLD: f64 = core::f64::consts::FRAC_PI_4;

/// Returns the range of each joint outside of which functions of it are held: that of the rows,
/// unless they cover nearly all of its turn or of its limits.
pub(super) fn held_ranges(spec: &Spec, rows: &[Observation]) -> Vec<Option<[f64; 2]>> {
    let of_joint = |(i, variable): (usize, &abbe_spec::Variable)| {
        let [least, most] = range_of(rows.iter().map(|row| row.q[i]));
        let limits = variable.limits[1] - variable.limits[0];
        let whole = variable.kind.either(limits.min(core::f64::consts::TAU), limits);
        let round = |end: f64| number(end, 4).parse().unwrap_or(end);
        (most - least < COVERED * whole).then(|| [round(least), round(most)])
    };
    spec.variables.iter().enumerate().map(of_joint).collect()
}

/// Multiple of a joint angle, or its sum or difference with another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// Revolute joint.
    pub joint: HeldJoint,
    /// Number of periods per turn.
    pub times: u16,
    /// Another revolute joint, added (`true`) or subtracted (`false`).
    pub other: Option<(HeldJoint, bool)>,
}

impl Angle {
    /// Returns a multiple of one joint angle.
    pub fn times(variable: usize, times: u16) -> Self {
        Self { joint: HeldJoint::free(variable), times, other: None }
    }

    fn within(self, ranges: &[Option<[f64; 2]>]) -> Self {
        let other = self.other.map(|(other, plus)| (other.within(ranges), plus));
        Self { joint: self.joint.within(ranges), other, ..self }
    }

    fn value(self, q: &[f64]) -> f64 {
        let one = f64::from(self.times) * self.joint.value(q);
        match self.other {
            Some((other, true)) => one + other.value(q),
            Some((other, false)) => one - other.value(q),
            None => one,
        }
    }

    /// Formats the angle as an expression of a spec.
    fn text(self, spec: &Spec) -> String {
        let joint = self.joint.text(spec);
        let one = if self.times == 1 { joint } else { format!("{}*{joint}", self.times) };
        match self.other {
            Some((other, true)) => format!("{one} + {}", other.text(spec)),
            Some((other, false)) => format!("{one} - {}", other.text(spec)),
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
            Self::Power { joint, exponent } => (joint.value(q) / 1000.0).powi(i32::from(exponent)),
        }
    }

    fn text(self, spec: &Spec) -> String {
        match self {
            Self::Sine(angle) => format!("sin({})", angle.text(spec)),
            Self::Cosine(angle) => format!("cos({})", angle.text(spec)),
            Self::Power { joint, exponent } => {
                format!("({}/(1000 {}))^{exponent}", joint.text(spec), spec.length.symbol())
            }
        }
    }

    fn within(self, ranges: &[Option<[f64; 2]>]) -> Self {
        match self {
            Self::Sine(angle) => Self::Sine(angle.within(ranges)),
            Self::Cosine(angle) => Self::Cosine(angle.within(ranges)),
            Self::Power { joint, exponent } => Self::Power { joint: joint.within(ranges), exponent },
        }
    }

    /// Describes the function for the name of a group of terms.
    fn kind(self, spec: &Spec) -> String {
        let name = |joint: HeldJoint| &spec.variables[joint.variable].name;
        match self {
            Self::Sine(angle) | Self::Cosine(angle) if angle.other.is_none() => {
                let often = match angle.times {
                    1 => "once".to_owned(),
                    2 => "twice".to_owned(),
                    times => format!("{times} times"),
                };
                format!("{often} per turn of {}", name(angle.joint))
            }
            Self::Sine(angle) | Self::Cosine(angle) => {
                format!("once per turn of {}", angle.within(&[]).text(spec))
            }
            Self::Power { joint, exponent: 1 } => format!("in proportion to {}", name(joint)),
            Self::Power { joint, exponent: 2 } => format!("with the square of {}", name(joint)),
            Self::Power { joint, .. } => format!("with the cube of {}", name(joint)),
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

    /// Returns the function with its joints held outside of these ranges.
    fn within(self, ranges: &[Option<[f64; 2]>]) -> Self {
        match self {
            Self::Wave(wave) => Self::Wave(wave.within(ranges)),
            Self::Product(one, other) => Self::Product(one.within(ranges), other.within(ranges)),
            Self::One | Self::Input(_) | Self::Moment | Self::Coupled(_) => self,
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
    /// Returns the term with its joints held outside of these ranges.
    pub(super) fn within(self, ranges: &[Option<[f64; 2]>]) -> Self {
        Self { basis: self.basis.within(ranges), ..self }
    }

    /// Returns whether rows within the ranges can hardly tell it from constant errors: a wave of a
    /// frame over a small part of a turn.
    pub(super) fn is_hidden(self) -> bool {
        let (ErrorSite::Frame(..), Basis::Wave(Wave::Sine(angle) | Wave::Cosine(angle))) =
            (self.site, self.basis)
        else {
            return false;
        };
        angle.joint.range.is_some_and(|[least, most]| most - least < TOLD)
    }

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
            Basis::Wave(Wave::Power { joint, exponent }) => {
                format!("{owner}: {error} with {}^{exponent}", spec.variables[joint.variable].name)
            }
            Basis::Wave(_) | Basis::Product(..) => {
                format!("{owner}: {error} with {}", self.basis.within(&[]).text(spec))
            }
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
