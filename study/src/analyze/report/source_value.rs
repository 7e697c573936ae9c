//! What the value of a random source is, as it stands in the spec.

use abbe::analysis::Contribution;
use abbe::{Component, VariableKind};
use abbe_spec::{ChainNumber, DhNumber, Source, Spec};

/// The value of a source, in the spec's coherent system, and what it is a value of.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SourceValue {
    /// 1 if it causes several errors.
    pub(super) value: f64,
    pub(super) quantity: Quantity,
}

/// The quantity that the value of a source is.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// A multiple of what the spec says.
    Multiple,
    /// A length, in the length unit.
    Length,
    /// An angle, rad.
    Angle,
    /// A parameter, in this unit.
    Parameter(String),
}

impl SourceValue {
    /// The standard deviation of a magnitude, if that is what is not known; the error of a joint or parameter if that is all
    /// the source has and it is constant; else the one generalized error that it causes at the configuration.
    pub(super) fn new(spec: &Spec, source: &Source, one: &Contribution) -> Self {
        if let Some(magnitude) = source.magnitude {
            return Self { value: magnitude.value, quantity: Quantity::Parameter(String::new()) };
        }
        if let ([], [deviation]) = (&source.effects[..], &source.deviations[..])
            && let Some(value) = deviation.error.constant().filter(|value| *value != 0.0)
        {
            return Self { value: value.abs(), quantity: quantity(spec, deviation.number) };
        }
        match one.value {
            None => Self { value: 1.0, quantity: Quantity::Multiple },
            Some((Component::X | Component::Y | Component::Z, value)) => {
                Self { value, quantity: Quantity::Length }
            }
            Some((_, value)) => Self { value, quantity: Quantity::Angle },
        }
    }
}

fn quantity(spec: &Spec, number: ChainNumber) -> Quantity {
    match number {
        ChainNumber::Joint(joint) => match spec.variables[joint].kind {
            VariableKind::Revolute => Quantity::Angle,
            VariableKind::Prismatic => Quantity::Length,
        },
        ChainNumber::Parameter(parameter) => Quantity::Parameter(spec.parameters[parameter].unit.clone()),
        ChainNumber::DenavitHartenberg { number: DhNumber::Theta | DhNumber::Alpha, .. } => Quantity::Angle,
        ChainNumber::DenavitHartenberg { number: DhNumber::D | DhNumber::A, .. } => Quantity::Length,
    }
}
