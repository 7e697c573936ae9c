//! Value of a random source, as stated in the spec.

use abbe::Component;
use abbe::analysis::Contribution;
use abbe_spec::expr::Expression;
use abbe_spec::{ChainNumber, DhNumber, Source, Spec, Uncertain};

/// Value of a source in the spec's coherent units, and its quantity.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SourceValue {
    /// Value of the source; 1 if it causes several errors.
    pub(super) value: f64,
    pub(super) quantity: Quantity,
}

/// Quantity of a source's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// Factor of the errors in the spec.
    Multiple,
    /// Length, in the length unit.
    Length,
    /// Angle, in rad.
    Angle,
    /// Parameter or input in this unit, or a plain number if the unit is empty.
    Parameter(String),
}

impl SourceValue {
    /// Determines the value of a source: the standard deviation of a magnitude; or the uncertainty
    /// of an input; or the deviation of a joint or parameter, if it is the only one and constant;
    /// or the only generalized error at the configuration.
    pub(super) fn new(spec: &Spec, source: &Source, one: &Contribution) -> Self {
        if source.magnitude.is_some() {
            return Self { value: source.factor(), quantity: Quantity::Parameter(String::new()) };
        }
        if let [(Uncertain::Input(input), uncertainty)] = source.propagated[..] {
            return Self {
                value: source.scale * uncertainty,
                quantity: Quantity::Parameter(spec.inputs[input].unit.clone()),
            };
        }
        if let ([], [deviation]) = (&source.effects[..], &source.deviations[..])
            && let Some(value) =
                deviation.error().and_then(Expression::constant).filter(|value| *value != 0.0)
        {
            return Self { value: source.scale * value.abs(), quantity: quantity(spec, deviation.number) };
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
        ChainNumber::Joint(joint) => spec.variables[joint].kind.either(Quantity::Angle, Quantity::Length),
        ChainNumber::Parameter(parameter) => Quantity::Parameter(spec.parameters[parameter].unit.clone()),
        ChainNumber::DenavitHartenberg { number: DhNumber::Theta | DhNumber::Alpha, .. } => Quantity::Angle,
        ChainNumber::DenavitHartenberg { number: DhNumber::D | DhNumber::A, .. } => Quantity::Length,
    }
}
