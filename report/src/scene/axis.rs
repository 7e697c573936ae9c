//! Axis of a panel.

use abbe_study::number;
use serde::Serialize;

/// Axis with its name, unit, range and scale.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// Name; may be empty.
    pub name: String,
    /// Unit; empty for numbers without one.
    pub unit: String,
    /// Values at both ends, in the unit.
    pub range: [f64; 2],
    /// Scale.
    pub scale: Scale,
    /// True if tick labels are shown; otherwise the panel below has them.
    pub numbered: bool,
}

/// Scale of an axis.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic.
    Logarithmic,
    /// Linear in days since 1970-01-01.
    Dates,
    /// Linear, with names at 0, 1, 2, …; an axis without names has no labels.
    Names(Vec<String>),
}

impl Axis {
    /// Creates an axis of numbers.
    pub(crate) fn linear(name: impl Into<String>, unit: impl Into<String>, range: [f64; 2]) -> Self {
        Self { name: name.into(), unit: unit.into(), range, scale: Scale::Linear, numbered: true }
    }

    /// Changes the scale.
    pub(crate) fn scaled(self, scale: Scale) -> Self {
        Self { scale, ..self }
    }

    /// Formats name and unit: `d1 (mm)`.
    pub(crate) fn title(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} ({})", self.name, self.unit) }
    }

    /// Returns the relative position of a value: 0 at the start, 1 at the end.
    pub(crate) fn share(&self, value: f64) -> f64 {
        let place = |value: f64| if self.scale == Scale::Logarithmic { value.log10() } else { value };
        let [from, to] = self.range.map(place);
        (place(value) - from) / (to - from)
    }

    /// Describes the axis: `x error from -0.1 to 0.3 mm`.
    pub(crate) fn text(&self) -> String {
        let Self { name, unit, range, scale, .. } = self;
        match scale {
            Scale::Names(names) => names.join(", "),
            Scale::Dates => {
                let [from, to] = range.map(|day| abbe_study::date::Calendar::Dates.show(day));
                format!("{name} from {from} to {to}").trim_start().to_owned()
            }
            Scale::Linear | Scale::Logarithmic => {
                let [from, to] = range.map(|end| number::digits(end, 3));
                format!("{name} from {from} to {to} {unit}").trim().to_owned()
            }
        }
    }
}

/// Extends a range on both sides by a fraction of its width. The result is never empty.
pub(crate) fn with_margin([least, largest]: [f64; 2], share: f64) -> [f64; 2] {
    if !(least.is_finite() && largest.is_finite() && least <= largest) {
        return [-1.0, 1.0];
    }
    let room = (largest - least) * share;
    let room = if room > 0.0 {
        room
    } else if least < largest {
        0.0
    } else if least == 0.0 {
        1e-3
    } else {
        least.abs() * share.max(1e-3)
    };
    [least - room, largest + room]
}
