//! Errors that the data determine too weakly; they are held at zero.

use abbe::LengthUnit;
use abbe::identify::{Identifiable, Model, Unknown};
use serde::Serialize;

/// An error that these data determine no better than to half of what is expected of it: it is held at zero and not written.
#[derive(Clone, Debug, Serialize)]
pub struct WeaklyDetermined {
    /// The error.
    pub name: String,
    /// The standard deviation that the data alone would give it, beside all that is found.
    pub told: f64,
    /// What is expected of it before: a standard deviation about zero.
    pub expected: f64,
    /// The length unit, or rad.
    pub unit: &'static str,
}

impl WeaklyDetermined {
    pub(crate) fn all(model: &Model, identifiable: &Identifiable, length: LengthUnit) -> Vec<Self> {
        // Of an instrument's direction no more need be known than is expected of it.
        let matters = |k: usize| !matches!(model.unknowns[k], Unknown::Fixture(..) | Unknown::Zero(_));
        let weak = identifiable.weak.iter();
        let weak = weak.filter(|weak| weak.expected.is_finite() && matters(weak.unknown));
        let not_known = weak.map(|weak| {
            let unknown = model.unknowns[weak.unknown];
            let rotation = match unknown {
                Unknown::Base(_, component) | Unknown::Error(_, component) | Unknown::Tool(component) => {
                    component.is_rotation()
                }
                Unknown::Target(..) | Unknown::Magnitude(_) | Unknown::Fixture(..) | Unknown::Zero(_) => {
                    false
                }
            };
            Self {
                name: model.name(unknown),
                told: weak.told,
                expected: weak.expected,
                unit: match unknown {
                    Unknown::Magnitude(_) => "",
                    _ if rotation => "rad",
                    _ => length.symbol(),
                },
            }
        });
        not_known.collect()
    }
}
