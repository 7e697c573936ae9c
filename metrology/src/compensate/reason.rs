//! Reasons for incomplete compensation, in words.

use abbe::Description;
use abbe::analysis::{Missing, Obstacle};

use abbe_study::number::{length, of_variable};

/// Describes the obstacle: joints at their limits, or a direction that no joint moves; and the
/// remaining error.
pub(super) fn reason(description: &Description, q: &[f64], obstacle: &Obstacle) -> String {
    let Description { variables, length: unit, .. } = description;
    let axis = obstacle.axis.map(|share| format!("{:.2}", share + 0.0)).join(", ");
    let held = obstacle.limits.iter().map(|j| {
        let value = of_variable(q[*j], variables[*j].kind, *unit);
        format!("{} is at its limit {value}", variables[*j].name)
    });
    let held = held.collect::<Vec<_>>().join(" and ");
    let why = match (obstacle.limits.len(), obstacle.immobile, obstacle.missing) {
        (1.., _, _) => format!("{held} and would have to exceed it"),
        (0, true, Missing::Point(_)) => format!("no joint moves the tool point along ({axis}) there"),
        (0, true, Missing::Turn(_)) => {
            format!("no joint rotates the tool about ({axis}) there with its point fixed")
        }
        (0, false, _) => "no better solution was found near the command".to_owned(),
    };
    match obstacle.missing {
        Missing::Turn(turn) => {
            format!("{why}; the tool point is reached, {turn:.3e} rad of the orientation error remain")
        }
        Missing::Point(distance) => format!("{why}; {} left", length(distance, *unit)),
    }
}
