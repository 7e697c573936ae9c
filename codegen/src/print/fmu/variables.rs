//! Variables of a machine: names, units, limits and start values, in the order of their value
//! references.

use abbe_core::function::Signature;
use abbe_core::{Function, Orientation, Quantity, VariableKind};
use abbe_spec::expr::Dimension;
use abbe_spec::{MAGNITUDE, Spec};

use super::units::Unit;

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
