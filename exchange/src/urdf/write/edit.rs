//! Replaces the numbers of `xyz` and `rpy` in the text of a URDF; every other byte stays.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use abbe::{Orientation, Pose, analysis::sampling::vectors::norm, deviation};

use crate::export::report::{DECIMALS, rounded};
use crate::placement::{placed, roll_pitch_yaw};

/// Nominal and new origin of a joint, in m and rad.
pub(super) struct NewOrigin<'a> {
    pub(super) name: &'a str,
    pub(super) xyz: [f64; 3],
    pub(super) rpy: [f64; 3],
    pub(super) new: Pose,
}

/// Edited text.
pub(super) struct Edited {
    pub(super) text: String,
    /// Hunks of a diff, one per joint.
    pub(super) changes: Vec<String>,
}

/// Change in m or rad that is rounding.
const ROUNDING: f64 = 1e-13;

impl NewOrigin<'_> {
    /// Returns the distance of the two origins in m.
    pub(super) fn distance(&self) -> f64 {
        self.change()[0]
    }

    /// Returns distance and angle between the two origins.
    fn change(&self) -> [f64; 2] {
        let [x, y, z, a, b, c] =
            deviation(Orientation::RotationVector, &placed(self.xyz, self.rpy), &self.new);
        [[x, y, z], [a, b, c]].map(norm)
    }
}

/// Writes new origins into a text that has been read as URDF.
pub(super) fn edit(text: &str, origins: &[NewOrigin<'_>]) -> Edited {
    let mut edits: Vec<(Range<usize>, String, &str)> = Vec::new();
    let document = roxmltree::Document::parse(text).ok();
    let root = document.as_ref().map(roxmltree::Document::root_element);
    for joint in origins {
        let [distance, angle] = joint.change();
        let node = root
            .into_iter()
            .flat_map(|root| root.children())
            .find(|node| node.has_tag_name("joint") && node.attribute("name") == Some(joint.name));
        let Some(node) = node.filter(|_| distance > ROUNDING || angle > ROUNDING) else { continue };
        let mut numbers = Vec::new();
        if distance > ROUNDING {
            numbers.push(("xyz", joint.new.position()));
        }
        if angle > ROUNDING {
            numbers.push(("rpy", nearest(roll_pitch_yaw(&joint.new), joint.rpy)));
        }
        match node.children().find(|child| child.has_tag_name("origin")) {
            Some(origin) => {
                for (name, values) in numbers {
                    match origin.attributes().find(|attribute| attribute.name() == name) {
                        Some(attribute) => edits.push((attribute.range_value(), three(values), joint.name)),
                        None => {
                            let last = origin.attributes().next_back().map(|attribute| attribute.range().end);
                            let tag = origin.range().start + "<origin".len();
                            let at = last.unwrap_or(tag);
                            edits.push((at..at, format!(" {name}=\"{}\"", three(values)), joint.name));
                        }
                    }
                }
            }
            None => {
                // Insert an origin before the first child, on a line of its own.
                let Some(first) = node.first_element_child().map(|child| child.range().start) else {
                    continue;
                };
                let line = text[..first].rfind('\n').map_or(first, |end| end + 1);
                let indent = &text[line..first];
                let indent = if indent.trim().is_empty() { format!("\n{indent}") } else { String::new() };
                let numbers = numbers.iter().map(|(name, values)| format!(" {name}=\"{}\"", three(*values)));
                edits.push((
                    first..first,
                    format!("<origin{}/>{indent}", numbers.collect::<String>()),
                    joint.name,
                ));
            }
        }
    }
    edits.sort_by_key(|(range, ..)| range.start);
    let changes = changes(text, &edits);
    let mut new = text.to_owned();
    for (range, with, _) in edits.into_iter().rev() {
        new.replace_range(range, &with);
    }
    Edited { text: new, changes }
}

/// Returns the hunks of a diff, one per joint.
fn changes(text: &str, edits: &[(Range<usize>, String, &str)]) -> Vec<String> {
    let joints = edits.chunk_by(|a, b| a.2 == b.2);
    let change = |edits: &[(Range<usize>, String, &str)]| {
        let (first, last) = (edits.first()?, edits.last()?);
        let start = text[..first.0.start].rfind('\n').map_or(0, |at| at + 1);
        let end = text[last.0.end..].find('\n').map_or(text.len(), |at| last.0.end + at);
        let mut new = text[start..end].to_owned();
        for (range, with, _) in edits.iter().rev() {
            new.replace_range(range.start - start..range.end - start, with);
        }
        let marked = |lines: &str, mark: &str| {
            lines.lines().map(|line| format!("{mark}{}\n", line.trim_end())).collect::<String>()
        };
        let number = text[..start].matches('\n').count() + 1;
        let heading = format!("@@ line {number}: joint {} @@\n", first.2);
        Some(heading + &marked(&text[start..end], "-") + &marked(&new, "+"))
    };
    joints.filter_map(change).collect()
}

/// Returns the angles of the same rotation that are closest to the old ones; `(r, p, y)` is also
/// `(r + π, π − p, y + π)`.
fn nearest(rpy: [f64; 3], old: [f64; 3]) -> [f64; 3] {
    let [r, p, y] = rpy;
    let near =
        |angles: [f64; 3]| std::array::from_fn(|i| angles[i] + TAU * ((old[i] - angles[i]) / TAU).round());
    let [one, other]: [[f64; 3]; 2] = [near([r, p, y]), near([r + PI, PI - p, y + PI])];
    let distance = |angles: [f64; 3]| angles.iter().zip(old).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    if distance(one) <= distance(other) { one } else { other }
}

/// Writes three numbers of an attribute.
pub(super) fn three(numbers: [f64; 3]) -> String {
    let [x, y, z] = numbers.map(|number| rounded(number, DECIMALS));
    format!("{x} {y} {z}")
}
