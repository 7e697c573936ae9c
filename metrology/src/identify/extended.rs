//! Extends a spec by terms as sources. The fit and `analyze` then compute the same model.
//!
//! Sources of the spec with an unknown magnitude.
//!
//! The model contains such a source as declared, `m₀` times its expression, and a copy of the
//! expression. The factor of the copy is the unknown x, the difference between the actual magnitude
//! and `m₀`. The standard deviation in the spec is the prior of x about 0.

use abbe::{Class, Component};
use abbe_spec::expr::{Dimension, Expression, Function, Symbol, Unit};
use abbe_spec::{
    Axes, Cause, ChainNumber, Compliance, Deviation, DeviationCause, Effect, Factor, Load, Magnitude, Point,
    Source, Spec,
};

use super::terms::{Angle, Basis, ErrorSite, HeldJoint, Term, Wave};

/// Returns the spec with additional sources after its own: first a copy of magnitude 1 of every
/// source whose magnitude is unknown, then all terms as repeatable sources of magnitude 1.
///
/// If a term is elastic and the spec has no loads, a load of 1 kg is added at the tool point.
pub fn extended(spec: &Spec, terms: &[Term]) -> Spec {
    let mut extended = spec.clone();
    if terms.iter().any(|term| term.basis.is_elastic()) {
        if spec.loads.is_empty() {
            extended.loads.push(Load {
                mass: Some(Expression::from_number(1.0, Dimension::MASS)),
                force: None,
                moment: None,
                axes: Axes::Frame,
                frame: spec.tool_frame,
                point: Point::Tool,
            });
        }
        let down = || Expression::from_number(-gravity(spec), Dimension::ACCELERATION);
        let none = || Expression::from_number(0.0, Dimension::ACCELERATION);
        extended.gravity.get_or_insert_with(|| [none(), none(), down()]);
    }
    extended.sources.extend(own_magnitudes(spec).into_iter().map(|own| own.unit(spec)));
    extended.sources.extend(terms.iter().map(|term| term.source(spec)));
    extended
}

/// Returns standard gravity, 9.80665 m/s², in the coherent units of a spec.
fn gravity(spec: &Spec) -> f64 {
    in_units(spec, 9.80665, &[("m", 1), ("s", -2)])
}

/// Converts a number from a product of units to the coherent units of a spec.
fn in_units(spec: &Spec, number: f64, units: &[(&str, i32)]) -> f64 {
    let unit = units.iter().fold(Unit::NONE, |product, (name, power)| {
        Unit::named(name).and_then(|unit| product.times(unit, *power)).unwrap_or(product)
    });
    unit.convert(number, spec.length)
}

impl Term {
    /// Returns the term as a source of magnitude 1.
    pub fn source(&self, spec: &Spec) -> Source {
        let (mut effects, mut deviations) = (Vec::new(), Vec::new());
        let error = |dimension: Dimension| match dimension {
            Dimension::NONE => self.basis.expression(spec),
            _ => Expression::from_number(1.0, dimension) * self.basis.expression(spec),
        };
        let mut deviation = |number: ChainNumber| {
            let cause = DeviationCause::Error(error(self.site.dimension(spec)));
            deviations.push(Deviation { number, cause, span: 0..0 });
        };
        let cause = |component: Component| match self.basis {
            Basis::Moment => Cause::Compliance(Box::new(compliance(spec, component, component))),
            Basis::Coupled(other) => Cause::Compliance(Box::new(compliance(spec, component, other))),
            _ => Cause::Errors(vec![(component, error(self.site.dimension(spec)))]),
        };
        match self.site {
            ErrorSite::Joint(joint) => deviation(ChainNumber::Joint(joint)),
            ErrorSite::Parameter(parameter) => deviation(ChainNumber::Parameter(parameter)),
            ErrorSite::DenavitHartenberg(frame, number) => {
                deviation(ChainNumber::DenavitHartenberg { frame, number });
            }
            ErrorSite::Frame(frame, component) => {
                effects.push(Effect {
                    frame,
                    is_of_base: false,
                    at: Vec::new(),
                    cause: cause(component),
                    span: 0..0,
                });
            }
            // E_0 A_1 = A_1 (A_1⁻¹ E_0 A_1): an error of the first frame, located at F_0.
            ErrorSite::Base(component) => {
                let at = spec.frames.first().map_or(Vec::new(), |first| Factor::inverse(&first.factors));
                effects.push(Effect { frame: 0, is_of_base: true, at, cause: cause(component), span: 0..0 });
            }
        }
        Source { effects, deviations, ..Source::repeatable(self.name(spec)) }
    }
}

/// Returns a compliance of 1 µrad per N times the length unit about one axis by the moment about
/// the other, and the symmetric entry.
fn compliance(spec: &Spec, one: Component, other: Component) -> Compliance {
    let value = in_units(spec, 1e-6, &[("N", -1), (spec.length.symbol(), -1)]);
    let dimension = Dimension::NONE.over(Dimension::MOMENT).unwrap_or(Dimension::NONE);
    let mut compliance = Compliance::default();
    for (row, column) in [(one, other), (other, one)] {
        compliance[row.index()][column.index()] = Some(Expression::from_number(value, dimension));
    }
    compliance
}

impl Basis {
    /// Returns the basis as a pure number of a spec; 0 for a compliance, which is not a factor.
    fn expression(self, spec: &Spec) -> Expression {
        match self {
            Self::One => Expression::from_number(1.0, Dimension::NONE),
            Self::Wave(wave) => wave.expression(),
            Self::Product(one, other) => one.expression() * other.expression(),
            Self::Input(input) => {
                let dimension = spec.inputs[input].dimension;
                let value = Expression::from_symbol(Symbol::Input(input), dimension);
                value / Expression::from_number(1.0, dimension)
            }
            Self::Moment | Self::Coupled(_) => Expression::from_number(0.0, Dimension::NONE),
        }
    }
}

impl Wave {
    fn expression(self) -> Expression {
        match self {
            Self::Sine(angle) => angle.expression().call(Function::Sin),
            Self::Cosine(angle) => angle.expression().call(Function::Cos),
            Self::Power { joint, exponent } => {
                let travel = joint.expression(Dimension::LENGTH);
                (travel / Expression::from_number(1000.0, Dimension::LENGTH)).power(f64::from(exponent))
            }
        }
    }
}

impl Angle {
    fn expression(self) -> Expression {
        let joint = |joint: HeldJoint| joint.expression(Dimension::NONE);
        let number = |value: f64| Expression::from_number(value, Dimension::NONE);
        let one = match self.times {
            1 => joint(self.joint),
            times => number(f64::from(times)) * joint(self.joint),
        };
        match self.other {
            Some((other, true)) => one + joint(other),
            Some((other, false)) => one + number(-1.0) * joint(other),
            None => one,
        }
    }
}

impl HeldJoint {
    fn expression(self, dimension: Dimension) -> Expression {
        let joint = Expression::from_symbol(Symbol::Variable(self.variable), dimension);
        self.range.map_or_else(|| joint.clone(), |range| joint.clone().clamped(range))
    }
}

/// Source of the spec with an unknown magnitude.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnMagnitude {
    /// Index among all sources of the spec.
    pub(super) source: usize,
    /// Magnitude declared in the spec.
    pub(crate) declared: Magnitude,
}

/// Returns the enabled repeatable sources with a declared magnitude, in the order of the spec.
pub(crate) fn own_magnitudes(spec: &Spec) -> Vec<OwnMagnitude> {
    let sources = spec.sources.iter().enumerate();
    let known = sources.filter(|(_, source)| source.enabled && source.class == Class::Repeatable);
    known.filter_map(|(i, source)| Some(OwnMagnitude { source: i, declared: source.magnitude? })).collect()
}

impl OwnMagnitude {
    /// Returns the source with magnitude 1.
    pub(super) fn unit(self, spec: &Spec) -> Source {
        Source { magnitude: None, ..spec.sources[self.source].clone() }
    }
}

#[cfg(test)]
mod tests;
