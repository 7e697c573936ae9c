//! Quantity on an axis: its name, its unit, and the conversion to that unit.

use abbe::analysis::Measurand;
use abbe_spec::Spec;
use abbe_study::study_file::Over;

use crate::scene::Axis;

/// Quantity with its unit of display.
#[derive(Clone, Debug)]
pub(super) struct Quantity {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) factor: f64,
}

impl Quantity {
    /// Returns the quantity of errors: mm for every spec, because errors are small; mrad for
    /// orientations.
    pub(super) fn errors(measurand: Measurand, spec: &Spec) -> Self {
        let (unit, factor) = match measurand {
            Measurand::Position => ("mm", 1e3 * spec.length.in_metres()),
            Measurand::Orientation => ("mrad", 1e3),
        };
        Self { name: String::new(), unit: unit.to_owned(), factor }
    }

    /// Returns the quantity of a variable, a parameter or an input; degrees for revolute joints.
    pub(super) fn over(over: Over, spec: &Spec) -> Self {
        let (name, unit, factor) = match over {
            Over::Variable(i) => spec.variables[i].kind.either(
                (&spec.variables[i].name, "deg", 180.0 / std::f64::consts::PI),
                (&spec.variables[i].name, spec.length.symbol(), 1.0),
            ),
            Over::Parameter(i) => (&spec.parameters[i].name, spec.parameters[i].unit.as_str(), 1.0),
            Over::Input(i) => (&spec.inputs[i].name, spec.inputs[i].unit.as_str(), 1.0),
        };
        Self { name: name.to_owned(), unit: unit.to_owned(), factor }
    }

    /// Renames the quantity.
    pub(super) fn named(&self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self.clone() }
    }

    /// Converts a value to the unit of display.
    pub(super) fn show(&self, value: f64) -> f64 {
        value * self.factor
    }

    /// Creates an axis with this range, in the unit of display.
    pub(super) fn axis(&self, range: [f64; 2]) -> Axis {
        Axis::linear(&self.name, &self.unit, range)
    }
}
