//! Corrected commands: a text that a language has for them, with a manipulator's numbers.
//!
//! The steps are those of [`abbe_core::compensator`]; their constants stand there.

use abbe_core::VariableKind;
use abbe_core::compensator::{DAMPING, ITERATIONS, LEAST_SINE, LEVER, REST};
use abbe_spec::Spec;

/// Numbers that depend on how many digits there are.
pub(super) struct Tolerances {
    /// What keeps steps bounded, in metres and rad: λ, or its root where no squares are made.
    pub(super) damping: f64,
    /// The step below which there is rest, in rad and metres.
    pub(super) rest: f64,
    /// Below this, twice the sine of an angle has no square, and is the angle's double.
    pub(super) least_sine: f64,
}

impl Tolerances {
    /// Those of double precision.
    pub(super) const DOUBLE: Self = Self { damping: DAMPING, rest: REST, least_sine: LEAST_SINE };
}

/// One rad or one metre in the unit of each variable.
pub(super) fn units(spec: &Spec) -> impl Iterator<Item = f64> {
    spec.variables.iter().map(|variable| match variable.kind {
        VariableKind::Revolute => 1.0,
        VariableKind::Prismatic => metre(spec),
    })
}

/// A text with numbers, as the language writes them, in place of words in capitals.
pub(super) fn numbered(
    text: &str,
    spec: &Spec,
    Tolerances { damping, rest, least_sine }: &Tolerances,
    number: impl Fn(f64) -> String,
) -> String {
    let units: Vec<String> = units(spec).map(&number).collect();
    let placed = [
        ("COUNT", units.len().to_string()),
        ("UNIT_LIST", units.join(", ")),
        ("ITERATIONS", ITERATIONS.to_string()),
        ("METRE", number(1.0 / metre(spec))),
        ("LEVER", number(LEVER)),
        ("DAMPING", number(*damping)),
        ("REST", number(*rest)),
        ("LEAST_SINE", number(*least_sine)),
    ];
    placed.iter().fold(text.to_owned(), |text, (word, value)| text.replace(word, value))
}

/// A metre in the manipulator's unit.
fn metre(spec: &Spec) -> f64 {
    1.0 / spec.length.in_metres()
}
