//! Variables of a machine: names, units, limits and start values, in the order of their value
//! references.
//!
//! Units as FMI defines them: a product of powers of SI base units and a factor.

use std::collections::BTreeSet;

use abbe_core::{Function, LengthUnit, Orientation, Quantity, VariableKind, function::Signature};
use abbe_spec::{Dimension, MAGNITUDE, Spec};

use super::xml::Element;

/// Causality of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Causality {
    Independent,
    Input,
    Parameter,
    Output,
}

/// A variable of the machine.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) name: String,
    pub(super) causality: Causality,
    pub(super) unit: Option<Unit>,
    /// Start value of an input or parameter.
    pub(super) start: Option<f64>,
    /// Range; infinite where there is no limit.
    pub(super) range: [f64; 2],
    pub(super) description: String,
}

/// The variables of a machine, and the start of each array of them.
#[derive(Debug)]
pub(super) struct Variables {
    pub(super) list: Vec<Variable>,
    /// Arrays of the C functions by name, with the index of their first element.
    pub(super) places: Vec<(&'static str, usize)>,
    /// Index of the first output.
    pub(super) outputs: usize,
    /// `true` if there are corrected commands, followed by an integer status.
    pub(super) corrected: bool,
}

/// Functions whose results are outputs, and the names of the outputs.
pub(super) const OUTPUTS: [(Function, &str); 3] = [
    (Function::PredictedDisplacement, "displacement"),
    (Function::Pose, "pose"),
    (Function::RealPose, "real_pose"),
];

/// Name of the corrected commands.
pub(super) const CORRECTED: &str = "corrected";

/// Name and description of the status of the corrected commands.
pub(super) const CORRECTION: (&str, &str) = (
    "correction",
    "0: reached to 1 um and 10 urad; not reached: 4 further steps would help, 5 a limit holds a variable, 7 no variable \
     helps; 6: the inputs are beyond the limits",
);

impl Variables {
    pub(super) fn new(spec: &Spec) -> Self {
        let length = Some(Unit::coherent(Dimension::LENGTH, spec.length));
        let number = |name: String, causality, description: &str| Variable {
            name,
            causality,
            unit: None,
            start: None,
            range: [f64::NEG_INFINITY, f64::INFINITY],
            description: description.replace('`', ""),
        };
        let of_kind = |kind: VariableKind| kind.either(Some(Unit::angle()), length.clone());
        let time = Some(Unit::coherent(Dimension::TIME, spec.length));
        let mut list = vec![Variable { unit: time, ..number("time".into(), Causality::Independent, "Time") }];
        let mut places = vec![("q", list.len())];
        list.extend(spec.variables.iter().map(|variable| Variable {
            unit: of_kind(variable.kind),
            start: Some(variable.home),
            range: variable.limits,
            ..number(format!("q.{}", variable.name), Causality::Input, &variable.description)
        }));
        places.push(("u", list.len()));
        list.extend(spec.inputs.iter().enumerate().map(|(k, input)| {
            let is_magnitude = spec.sources.iter().any(|source| source.tuned_by == Some(k));
            let (name, causality) = match input.name.strip_prefix(MAGNITUDE) {
                Some(source) if is_magnitude => (format!("magnitude.{source}"), Causality::Parameter),
                _ => (format!("u.{}", input.name), Causality::Input),
            };
            let unit = Unit::some(input.dimension, spec.length);
            let (start, range) = (Some(input.value), input.range);
            Variable { unit, start, range, ..number(name, causality, &input.description) }
        }));
        places.push(("s", list.len()));
        list.extend(spec.parameters.iter().map(|parameter| Variable {
            unit: Unit::some(parameter.dimension, spec.length),
            start: Some(parameter.value),
            ..number(format!("s.{}", parameter.name), Causality::Parameter, &parameter.description)
        }));
        let outputs = list.len();
        for (function, name) in OUTPUTS {
            let Signature { documentation, results, .. } = function.signature();
            places.push((name, list.len()));
            let [result] = results else { unreachable!("each of these has one result") };
            let what = match result.quantity {
                Quantity::Pose => documentation,
                _ => &result.documentation,
            };
            let results = parts(result.quantity, spec.orientation).into_iter();
            list.extend(results.map(|(part, measure)| Variable {
                unit: match measure {
                    Measure::Length => length.clone(),
                    Measure::Angle => Some(Unit::angle()),
                    Measure::Number => None,
                },
                ..number(format!("{name}.{part}"), Causality::Output, what)
            }));
        }
        places.push((CORRECTED, list.len()));
        let what = "Command at which the real tool has the ideal pose";
        list.extend(spec.variables.iter().map(|variable| Variable {
            unit: of_kind(variable.kind),
            ..number(format!("{CORRECTED}.{}", variable.name), Causality::Output, what)
        }));
        Self { list, places, outputs, corrected: !spec.variables.is_empty() }
    }
}

enum Measure {
    Length,
    Angle,
    Number,
}

/// Returns the names of the numbers of a result, in order.
fn parts(quantity: Quantity, orientation: Orientation) -> Vec<(String, Measure)> {
    let xyz = ["x", "y", "z"].map(|axis| (axis.to_owned(), Measure::Length));
    if quantity == Quantity::Pose {
        let turns = (0..9).map(|k| (format!("R{}{}", k % 3 + 1, k / 3 + 1), Measure::Number));
        turns.chain(xyz).collect()
    } else {
        let angles = orientation.rows().into_iter().skip(3);
        xyz.into_iter().chain(angles.map(|row| (row.to_owned(), Measure::Angle))).collect()
    }
}

/// A unit.
#[derive(Clone, Debug)]
pub(super) struct Unit {
    pub(super) name: String,
    /// Powers of m, kg, s and K, and the factor; `None` for a square root of a unit.
    base: Option<([i32; 4], f64)>,
}

impl Unit {
    /// Returns the coherent unit of a dimension.
    pub(super) fn coherent(dimension: Dimension, length: LengthUnit) -> Self {
        let factor = |powers: [i32; 4]| match length {
            LengthUnit::Metre => 1.0,
            LengthUnit::Millimetre => format!("1e{}", -3 * powers[0]).parse().expect("this is a number"),
        };
        let base = dimension.whole_exponents().map(|powers| (powers, factor(powers)));
        Self { name: dimension.unit(length.symbol()), base }
    }

    /// Returns the coherent unit of a dimension, or `None` for a dimensionless number.
    pub(super) fn some(dimension: Dimension, length: LengthUnit) -> Option<Self> {
        (dimension != Dimension::NONE).then(|| Self::coherent(dimension, length))
    }

    /// Returns the unit of an angle.
    pub(super) fn angle() -> Self {
        Self { name: "rad".to_owned(), base: None }
    }

    fn element(&self) -> Element {
        let unit = Element::new("Unit").with("name", &self.name);
        if self.name == "rad" {
            let degrees = Element::new("DisplayUnit").with("name", "deg").with("factor", 1f64.to_degrees());
            return unit.containing([Element::new("BaseUnit").with("rad", 1), degrees]);
        }
        unit.containing(self.base.map(|(powers, factor)| {
            let powers = ["m", "kg", "s", "K"].into_iter().zip(powers).filter(|(_, power)| *power != 0);
            let base = powers.fold(Element::new("BaseUnit"), |base, (name, power)| base.with(name, power));
            if factor == 1.0 { base } else { base.with("factor", format!("{factor:?}")) }
        }))
    }
}

/// Returns the definitions of all units, without duplicates.
pub(super) fn definitions<'u>(units: impl Iterator<Item = &'u Unit>) -> Element {
    let mut defined = BTreeSet::new();
    let once = units.filter(|unit| defined.insert(unit.name.clone()));
    Element::new("UnitDefinitions").containing(once.map(Unit::element))
}
