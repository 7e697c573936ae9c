//! Errors that the data determine poorly.

use abbe::LengthUnit;
use abbe::identify::{FixtureGeometry, Identifiable, Model, Unknown};
use serde::Serialize;

/// Error whose standard deviation from the data alone exceeds half of the prior's.
#[derive(Clone, Debug, Serialize)]
pub struct WeaklyDetermined {
    /// Name of the error.
    pub name: String,
    /// Standard deviation from the data alone, beside all kept unknowns, in `unit`.
    pub standard_deviation: f64,
    /// Standard deviation of the prior about zero, in `unit`.
    pub expected: f64,
    /// Unit: the length unit, rad, or empty.
    pub unit: &'static str,
}

impl WeaklyDetermined {
    pub(crate) fn all(model: &Model, identifiable: &Identifiable, length: LengthUnit) -> Vec<Self> {
        // A direction or a zero need not be known better than its prior.
        let matters = |k: usize| match model.unknowns[k] {
            Unknown::Fixture(fixture, _) => {
                matches!(model.fixtures[fixture].geometry, FixtureGeometry::Point(_))
            }
            Unknown::Zero(_) | Unknown::Intrinsic(_) => false,
            _ => true,
        };
        let weak = identifiable.weak.iter();
        let weak = weak.filter(|weak| weak.expected.is_finite() && matters(weak.unknown));
        let determined_weakly = weak.map(|weak| {
            let unknown = model.unknowns[weak.unknown];
            Self {
                name: model.name(unknown),
                standard_deviation: weak.deviation,
                expected: weak.expected,
                unit: match unknown {
                    Unknown::Magnitude(_) => "",
                    _ if unknown.is_rotation() => "rad",
                    _ => length.symbol(),
                },
            }
        });
        determined_weakly.collect()
    }
}
