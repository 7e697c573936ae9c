//! Kind, limits and home of a joint.

use std::f64::consts::PI;

use abbe::LengthUnit;
use abbe_spec::Variable;
use abbe_study::number::{quantity, short};

/// Returns the kind, the limits and the home of a joint, in deg or in the length unit.
pub(super) fn joint(variable: &Variable, length: LengthUnit) -> [String; 3] {
    let (kind, scale, unit) =
        variable.kind.either(("revolute", 180.0 / PI, "deg"), ("prismatic", 1.0, length.symbol()));
    let [lower, upper] = variable.limits.map(|limit| short(limit * scale));
    let limits = match variable.limits.map(f64::is_finite) {
        [false, false] => "no limits".to_owned(),
        _ if lower == upper => format!("{lower} {unit}"),
        _ => format!("{lower} … {upper} {unit}"),
    };
    [kind.to_owned(), limits, quantity(variable.home * scale, unit)]
}
