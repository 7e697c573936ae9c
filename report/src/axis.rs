//! How the numbers of a figure are shown: names, units, ticks, colours.

use abbe::VariableKind;
use abbe::analysis::Measurand;
use abbe_spec::Spec;

use abbe_study::study_file::Over;

/// Colours that those who confuse red and green can tell apart as well (Okabe and Ito): of x, y and z.
pub(crate) const XYZ: [(u8, u8, u8); 3] = [(213, 94, 0), (0, 158, 115), (0, 114, 178)];
/// Of the norm, and of all together.
pub(crate) const INK: (u8, u8, u8) = (40, 44, 52);
/// Of what is printed elsewhere.
pub(super) const PUBLISHED: (u8, u8, u8) = (160, 70, 130);
/// Of bars.
pub(crate) const BAR: (u8, u8, u8) = (86, 140, 190);
/// Of axes and their numbers.
pub(super) const GREY: (u8, u8, u8) = (110, 114, 122);
/// Of the lines of a grid.
pub(super) const FAINT: (u8, u8, u8) = (226, 228, 232);
/// Of tolerances.
pub(super) const TOLERANCE: (u8, u8, u8) = (120, 120, 120);

/// As CSS has it.
pub(crate) fn css((red, green, blue): (u8, u8, u8), opacity: f64) -> String {
    format!("rgba({red},{green},{blue},{opacity})")
}

/// The unit of an axis, and what numbers are multiplied with to be in it.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) factor: f64,
}

impl Axis {
    /// Of the errors: mm, whatever the spec's unit, because they are small; of the orientation mrad.
    pub(super) fn errors(measurand: Measurand, spec: &Spec) -> Self {
        let (unit, factor) = match measurand {
            Measurand::Position => ("mm", 1e3 * spec.length.in_metres()),
            Measurand::Orientation => ("mrad", 1e3),
        };
        Self { name: String::new(), unit: unit.to_owned(), factor }
    }

    /// Of a length in the spec's unit.
    pub(super) fn length(name: &str, spec: &Spec) -> Self {
        Self { name: name.to_owned(), unit: spec.length.symbol().to_owned(), factor: 1.0 }
    }

    /// Of a variable, a parameter or an input; angles of joints in degrees.
    pub(super) fn over(over: Over, spec: &Spec) -> Self {
        let (name, unit, factor) = match over {
            Over::Variable(i) => match spec.variables[i].kind {
                VariableKind::Revolute => (&spec.variables[i].name, "deg", 180.0 / std::f64::consts::PI),
                VariableKind::Prismatic => (&spec.variables[i].name, spec.length.symbol(), 1.0),
            },
            Over::Parameter(i) => (&spec.parameters[i].name, spec.parameters[i].unit.as_str(), 1.0),
            Over::Input(i) => (&spec.inputs[i].name, spec.inputs[i].unit.as_str(), 1.0),
        };
        Self { name: name.to_owned(), unit: unit.to_owned(), factor }
    }

    /// `d1 (mm)`.
    pub(super) fn title(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} ({})", self.name, self.unit) }
    }

    /// A value in the unit of the axis.
    pub(super) fn show(&self, value: f64) -> f64 {
        value * self.factor
    }

    /// Round numbers within a range in the unit of the axis, at most about so many.
    pub(super) fn ticks(&self, [least, largest]: [f64; 2], about: usize) -> Ticks {
        if about == 0 {
            return Ticks { values: Vec::new(), decimals: 0 };
        }
        let span = (largest - least) / about as f64;
        let step = if self.unit == "deg" && (1.0..90.0).contains(&span) {
            let steps = [2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0];
            steps.into_iter().find(|step| *step >= span).unwrap_or(90.0)
        } else {
            let power = 10f64.powf(span.log10().floor());
            let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
            steps.into_iter().find(|step| *step >= span * 0.98).unwrap_or(span)
        };
        if !(step > 0.0 && step.is_finite()) {
            return Ticks { values: vec![least], decimals: 0 };
        }
        let (first, last) = ((least / step - 1e-9).ceil() as i64, (largest / step + 1e-9).floor() as i64);
        let values = (first..=last).map(|i| i as f64 * step).collect();
        Ticks { values, decimals: (-(step * 1.0001).log10().floor()).max(0.0) as usize }
    }
}

/// Where an axis is labelled.
pub(super) struct Ticks {
    pub(super) values: Vec<f64>,
    decimals: usize,
}

impl Ticks {
    /// The label of a value.
    pub(super) fn label(&self, value: f64) -> String {
        if self.decimals > 6 {
            abbe_study::number::short(value)
        } else {
            abbe_study::number::fixed(value, self.decimals)
        }
    }
}

/// A range with some room on both sides; never empty.
pub(super) fn with_room([least, largest]: [f64; 2], share: f64) -> [f64; 2] {
    if !(least.is_finite() && largest.is_finite() && least <= largest) {
        return [-1.0, 1.0];
    }
    let room = (largest - least) * share;
    let room = if room > 0.0 {
        room
    } else if least == 0.0 {
        1e-3
    } else {
        least.abs() * share.max(1e-3)
    };
    [least - room, largest + room]
}

#[cfg(test)]
mod tests {
    use super::Axis;

    #[test]
    fn ticks_are_round() {
        let axis = Axis { name: "d1".into(), unit: "mm".into(), factor: 1.0 };
        let ticks = axis.ticks([0.0, 2256.0], 6);
        assert_eq!(ticks.values, [0.0, 500.0, 1000.0, 1500.0, 2000.0]);
        let ticks = axis.ticks([-0.123, 0.34], 5);
        let labels = ticks.values.iter().map(|value| ticks.label(*value)).collect::<Vec<_>>();
        assert_eq!(labels, ["-0.1", "0", "0.1", "0.2", "0.3"]);
        let axis = Axis { name: "q4".into(), unit: "deg".into(), factor: 1.0 };
        assert_eq!(axis.ticks([-90.0, 90.0], 7).values, [-90.0, -60.0, -30.0, 0.0, 30.0, 60.0, 90.0]);
        assert_eq!(axis.ticks([1.0, 1.0], 5).values, [1.0]);
    }
}
