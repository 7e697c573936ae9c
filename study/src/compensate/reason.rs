//! Why a row is not compensated, in words.

use abbe::Description;
use abbe::analysis::{Missing, Obstacle};

use crate::number::{length, of_variable};

/// Joints at their limits, what no joint moves, and what is left.
pub(super) fn reason(description: &Description, q: &[f64], obstacle: &Obstacle) -> String {
    let Description { variables, length: unit, .. } = description;
    let axis = obstacle.axis.map(|share| format!("{:.2}", share + 0.0)).join(", ");
    let held = obstacle.limits.iter().map(|j| {
        let value = of_variable(q[*j], variables[*j].kind, *unit);
        format!("{} is at its limit {value}", variables[*j].name)
    });
    let held = held.collect::<Vec<_>>().join(" and ");
    let why = match (obstacle.limits.len(), obstacle.immobile, obstacle.missing) {
        (1.., _, _) => format!("{held} and would have to go further"),
        (0, true, Missing::Point(_)) => format!("no joint moves the tool point along ({axis}) there"),
        (0, true, Missing::Turn(_)) => {
            format!("no joint turns the tool about ({axis}) there with its point where it is")
        }
        (0, false, _) => "nothing better was found near the command".to_owned(),
    };
    match obstacle.missing {
        Missing::Turn(turn) => format!("{why}; the tool point is there, {turn:.3e} rad are left"),
        Missing::Point(distance) => format!("{why}; {} left", length(distance, *unit)),
    }
}
