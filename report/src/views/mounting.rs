//! Sentences about hidden numbers and the place of a target that shows them.

use abbe::Component;
use abbe_metrology::plan::{HiddenNumber, TargetMounting};
use abbe_study::number::{digits, error_unit};

use super::shared::angle_in_mrad;

/// Number of standard deviations in the advice.
const SHOWN: usize = 4;

/// Names what the targets hide: `these rows cannot tell zero of q5 from a of A5`.
pub(super) fn statement(mounting: &TargetMounting) -> String {
    let mut groups: Vec<Vec<&str>> = Vec::new();
    for number in mounting.numbers.iter().filter(|number| number.is_hidden) {
        let mut group: Vec<&str> = vec![&number.name];
        group.extend(number.confused_with.iter().map(String::as_str));
        let (same, others): (Vec<_>, Vec<_>) =
            groups.into_iter().partition(|other| other.iter().any(|name| group.contains(name)));
        let mut merged: Vec<&str> = Vec::new();
        for name in same.into_iter().flatten().chain(group) {
            if !merged.contains(&name) {
                merged.push(name);
            }
        }
        groups = others;
        groups.push(merged);
    }
    let all = |names: &[String]| match names {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        names => names.concat(),
    };
    let named: Vec<Vec<String>> =
        groups.iter().map(|group| group.iter().map(|name| with_axis(name)).collect()).collect();
    let single: Vec<String> = named.iter().filter(|group| group.len() == 1).flatten().cloned().collect();
    let pairs = named.iter().filter(|group| group.len() == 2);
    let pairs: Vec<String> = pairs.map(|pair| format!("{} from {}", pair[0], pair[1])).collect();
    let mut phrases = Vec::new();
    if !single.is_empty() {
        phrases.push(format!("show {}", all(&single)));
    }
    if !pairs.is_empty() {
        phrases.push(format!("tell {}", pairs.join(", ")));
    }
    let larger = named.iter().filter(|group| group.len() > 2);
    phrases.extend(larger.map(|group| format!("tell {} apart", all(group))));
    let hidden = format!("these rows cannot {}", phrases.join(", or "));
    match &mounting.target_on_axis {
        Some(joint) => format!("the target is on the axis of {joint}: {hidden}"),
        None => hidden,
    }
}

/// Adds the axis to the name of a rotation of a frame.
fn with_axis(name: &str) -> String {
    let rotations = Component::ALL.into_iter().filter(|component| component.is_rotation());
    let mut rotations = rotations.filter(|component| name.starts_with(&format!("{} of ", component.name())));
    rotations.next().map_or_else(
        || name.to_owned(),
        |component| format!("{name} (about {})", ["x", "y", "z"][component.axis()]),
    )
}

/// Says where to mount the target, and how well the numbers are known then.
pub(super) fn advice(mounting: &TargetMounting, length: &str) -> String {
    let (factor, unit) = error_unit(length);
    let [x, y, z] = mounting.position.map(|x| digits(x * factor, 4));
    let what = if mounting.is_additional { "an additional target" } else { "the target" };
    let from = match mounting.planned_targets {
        1 if mounting.is_additional => "the planned one",
        1 => "the planned place",
        _ => "the first one",
    };
    let falls = |number: &HiddenNumber| {
        let (factor, unit) = if number.unit == "rad" { angle_in_mrad("rad") } else { (factor, unit) };
        let [before, there] =
            [number.standard_deviation, number.standard_deviation_there].map(|s| digits(factor * s, 2));
        format!("{} from {before} to {there} {unit}", with_axis(&number.name))
    };
    let mut numbers: Vec<String> = mounting.numbers.iter().take(SHOWN).map(falls).collect();
    let more = mounting.numbers.len() - numbers.len();
    if more > 0 {
        numbers.push(format!("{more} more"));
    }
    let exactly = if mounting.is_exact { ", known exactly" } else { "" };
    format!(
        "{what} at ({x}, {y}, {z}) {unit} in the frame of the tool, {} {unit} from {from}{exactly}: at the same configurations σ \
         falls for {}",
        digits(mounting.distance * factor, 3),
        numbers.join(", ")
    )
}
