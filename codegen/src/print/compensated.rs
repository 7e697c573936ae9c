//! Corrected commands: the template of a language with a manipulator's numbers.
//!
//! The algorithm and its constants are those of [`abbe_core::compensator`].

use abbe_core::VariableKind;
use abbe_core::compensator::{DAMPING, ITERATIONS, LEAST_SINE, LEVER, PASSES, REACHED, REST, Status};
use abbe_spec::Spec;

/// Tolerances that depend on the precision.
pub(super) struct Tolerances {
    /// Damping of the steps, in metres and radians: λ, or its square root where no squares are
    /// formed.
    pub(super) damping: f64,
    /// Step size for convergence, in radians and metres.
    pub(super) rest: f64,
    /// Largest error of a pose that is reached: position in metres, rotation in rad.
    pub(super) reached: [f64; 2],
    /// Below this value the square of twice the sine of an angle underflows, and the angle itself
    /// is used.
    pub(super) least_sine: f64,
}

impl Tolerances {
    /// Tolerances of double precision.
    pub(super) const DOUBLE: Self =
        Self { damping: DAMPING, rest: REST, reached: REACHED, least_sine: LEAST_SINE };
}

/// Returns 1 rad or 1 m in the unit of each variable.
pub(super) fn units(spec: &Spec) -> impl Iterator<Item = f64> {
    spec.variables.iter().map(|variable| match variable.kind {
        VariableKind::Revolute => 1.0,
        VariableKind::Prismatic => metre(spec),
    })
}

/// Replaces the words in capitals of a template by numbers in the syntax of the language.
pub(super) fn numbered(
    text: &str,
    spec: &Spec,
    Tolerances { damping, rest, reached, least_sine }: &Tolerances,
    number: impl Fn(f64) -> String,
) -> String {
    let units: Vec<String> = units(spec).map(&number).collect();
    let placed = [
        ("COUNT", units.len().to_string()),
        ("UNIT_LIST", units.join(", ")),
        ("ITERATIONS", ITERATIONS.to_string()),
        ("PASSES", PASSES.to_string()),
        ("REACHED_POSITION", number(reached[0])),
        ("REACHED_ROTATION", number(reached[1] * LEVER)),
        ("METRE", number(1.0 / metre(spec))),
        ("LEVER", number(LEVER)),
        ("DAMPING", number(*damping)),
        ("REST", number(*rest)),
        ("LEAST_SINE", number(*least_sine)),
    ];
    placed.iter().fold(text.to_owned(), |text, (word, value)| text.replace(word, value))
}

/// Returns the statuses with their numbers and meanings.
pub(super) fn statuses(tolerances: &Tolerances) -> String {
    let one =
        |status: Status| format!("{} `{}`: {}", status.code(), status.name(), meaning(status, tolerances));
    Status::ALL.map(one).join(" ")
}

/// Returns the meaning of a status, with the bound of what is left where it is reached.
pub(super) fn meaning(
    status: Status,
    Tolerances { reached: [position, rotation], .. }: &Tolerances,
) -> String {
    match status {
        Status::Reached => format!(
            "{} At most {} μm and {} μrad of the rotations are left, up to rounding errors.",
            status.meaning(),
            (position * 1e6).round(),
            (rotation * 1e6).round()
        ),
        _ => status.meaning().to_owned(),
    }
}

/// Returns a metre in the manipulator's unit.
fn metre(spec: &Spec) -> f64 {
    1.0 / spec.length.in_metres()
}
