//! What the value of a random source is, as it stands in the spec.

use abbe::analysis::Contribution;
use abbe::{Component, VariableKind};
use abbe_spec::{ChainNumber, DhNumber, Spec};

use super::report::Report;

/// The value of a source, in the spec's coherent system, and what it is a value of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SourceValue<'a> {
    /// 1 if it causes several errors.
    pub(super) value: f64,
    pub(super) kind: Kind<'a>,
}

/// What a value is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind<'a> {
    /// A multiple of what the spec says.
    Multiple,
    Length,
    Angle,
    /// Of a parameter in its unit.
    Of(&'a str),
}

impl<'a> SourceValue<'a> {
    /// The standard deviation of a magnitude, if that is what is not known; the error of a joint or parameter if that is all the source has and it is constant; else the one generalized error that it
    /// causes at the configuration.
    pub(super) fn new(report: &'a Report, one: &Contribution) -> Self {
        let source = report.source(one.source);
        if let Some(magnitude) = source.magnitude {
            return Self { value: magnitude.value, kind: Kind::Of("") };
        }
        if let ([], [deviation]) = (&source.effects[..], &source.deviations[..])
            && let Some(value) = deviation.error.constant().filter(|value| *value != 0.0)
        {
            return Self { value: value.abs(), kind: kind(&report.spec, deviation.number) };
        }
        match one.value {
            None => Self { value: 1.0, kind: Kind::Multiple },
            Some((Component::X | Component::Y | Component::Z, value)) => Self { value, kind: Kind::Length },
            Some((_, value)) => Self { value, kind: Kind::Angle },
        }
    }

    /// `|∂ΔX / ∂value|` of the rows and the norm.
    pub(super) fn sensitivity(&self, one: &Contribution) -> [f64; 4] {
        one.standard.map(|u| u * one.distribution.divisor() / self.value)
    }
}

fn kind(spec: &Spec, number: ChainNumber) -> Kind<'_> {
    match number {
        ChainNumber::Joint(joint) => match spec.variables[joint].kind {
            VariableKind::Revolute => Kind::Angle,
            VariableKind::Prismatic => Kind::Length,
        },
        ChainNumber::Parameter(parameter) => Kind::Of(&spec.parameters[parameter].unit),
        ChainNumber::DenavitHartenberg { number: DhNumber::Theta | DhNumber::Alpha, .. } => Kind::Angle,
        ChainNumber::DenavitHartenberg { number: DhNumber::D | DhNumber::A, .. } => Kind::Length,
    }
}
