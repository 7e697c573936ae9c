//! The variables of a machine: their names, units, limits and starts, in the order of their value references.

use abbe_core::function::Signature;
use abbe_core::{Function, Orientation, Quantity, VariableKind};
use abbe_spec::expr::Dimension;
use abbe_spec::{MAGNITUDE, Spec};

use super::units::Unit;

/// What a variable is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Causality {
    Independent,
    Input,
    Parameter,
    Output,
}

/// A number of the machine.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) name: String,
    pub(super) causality: Causality,
    pub(super) unit: Option<Unit>,
    /// What it is before it is set; of inputs and parameters.
    pub(super) start: Option<f64>,
    /// Infinite where there is no end.
    pub(super) range: [f64; 2],
    pub(super) description: String,
}

/// All variables, and where arrays of them begin.
#[derive(Debug)]
pub(super) struct Variables {
    pub(super) list: Vec<Variable>,
    /// Arrays of the functions of C by their names: index of the first number.
    pub(super) places: Vec<(&'static str, usize)>,
    /// Index of the first output.
    pub(super) outputs: usize,
    /// Whether there are corrected commands, and behind all others a whole number that says how good they are.
    pub(super) corrected: bool,
}

/// The functions whose results are outputs, and what their outputs are called.
pub(super) const OUTPUTS: [(Function, &str); 3] = [
    (Function::PredictedDisplacement, "displacement"),
    (Function::Pose, "pose"),
    (Function::RealPose, "real_pose"),
];

/// The corrected commands.
pub(super) const CORRECTED: &str = "corrected";

/// The whole number that says how good they are.
pub(super) const CORRECTION: (&str, &str) = (
    "correction",
    "0: corrected puts the real tool where pose is; 4: at a limit, or singular, the best that was found",
);

impl Variables {
    pub(super) fn new(spec: &Spec) -> Self {
        let length = Some(Unit::of(Dimension::LENGTH, spec.length));
        let number = |name: String, causality, description: &str| Variable {
            name,
            causality,
            unit: None,
            start: None,
            range: [f64::NEG_INFINITY, f64::INFINITY],
            description: description.replace('`', ""),
        };
        let of_kind = |kind| match kind {
            VariableKind::Revolute => Some(Unit::angle()),
            VariableKind::Prismatic => length.clone(),
        };
        let time = Some(Unit::of(Dimension::TIME, spec.length));
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
        let what = "The command that puts the real tool where the ideal one is";
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

/// The names of the numbers of a result, in its order.
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
