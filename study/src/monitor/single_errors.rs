//! The errors that may have changed, each by itself, and what it does to the numbers that are measured.

use abbe::identify::{Model, Place, Unknown};
use abbe::{Component, Description};
use abbe_spec::Spec;

use super::numbers::Numbers;
use super::vectors::{cosine, norm};
use crate::identify::chain_errors;

/// Beyond this cosine two errors count as one: what they do differs by less than a fifth of itself.
const ALIKE: f64 = 0.98;

/// The share of an error that must be left when the station is taken off.
const SEEN: f64 = 1e-3;

/// What does less than this share of the error that does most does nothing.
const ROUNDING: f64 = 1e-9;

/// A number of the machine that may have changed, all others staying what they are.
#[derive(Clone, Debug)]
pub(super) struct SingleError {
    /// `zero of q2`, `e_y3 (elbow)`, `station e_x`.
    pub(super) name: String,
    /// `rad`, or a length.
    pub(super) unit: &'static str,
    /// Whether it belongs to the station or to what is mounted on the tool, and not to the machine.
    pub(super) outside: bool,
    /// What a unit of it does to every number, in units of the instrument's uncertainty; the station taken off.
    pub(super) column: Vec<f64>,
    /// How far a unit of it moves the tool point, at the configuration where that is most. The length unit.
    pub(super) effect: f64,
}

/// All errors of a machine, those that cannot be told apart together.
pub(super) struct SingleErrors {
    /// Every error that can be seen.
    pub(super) list: Vec<SingleError>,
    /// By index: the error that a chart is of, and those that act as it does.
    pub(super) charts: Vec<(usize, Vec<usize>)>,
    /// The names of those that cannot be told from where the instrument stands.
    pub(super) unseen: Vec<String>,
}

impl SingleErrors {
    /// Zeros of joints first, then numbers of the chain, errors of the frames, of the station if it stays where it is, and of
    /// the targets: of those that act alike the first has the chart.
    pub(super) fn new(spec: &Spec, model: &Model, numbers: &Numbers) -> Self {
        let mut all = Self { list: Vec::new(), charts: Vec::new(), unseen: Vec::new() };
        let candidates = candidates(spec, model, numbers);
        let rounding = ROUNDING * candidates.iter().map(|(_, before)| *before).fold(0.0, f64::max);
        for (single, before) in candidates {
            if norm(&single.column) <= SEEN * before || before <= rounding {
                all.unseen.push(single.name);
                continue;
            }
            let index = all.list.len();
            let alike = |(first, _): &&mut (usize, Vec<usize>)| {
                cosine(&all.list[*first].column, &single.column).abs() > ALIKE
            };
            match all.charts.iter_mut().find(alike) {
                Some((_, others)) => others.push(index),
                None => all.charts.push((index, Vec::new())),
            }
            all.list.push(single);
        }
        all
    }
}

/// With the length of the column before the station is taken off.
fn candidates(spec: &Spec, model: &Model, numbers: &Numbers) -> Vec<(SingleError, f64)> {
    let place = |unknown: Unknown| model.unknowns.iter().position(|other| *other == unknown);
    let length = spec.length.symbol();
    let one = |name: String, rotation: bool, outside: bool, parts: &[(usize, f64)]| {
        let column = numbers.column(parts);
        let before = norm(&column);
        let unit = if rotation { "rad" } else { length };
        let effect = numbers.effect(parts);
        (SingleError { name, unit, outside, column: numbers.without_station(column), effect }, before)
    };
    let mut all = Vec::new();
    for number in chain_errors(spec) {
        let parts = Component::ALL.into_iter().zip(number.errors).filter(|(_, error)| *error != 0.0);
        let parts: Option<Vec<(usize, f64)>> = parts
            .map(|(component, error)| Some((place(Unknown::Error(number.frame, component))?, error)))
            .collect();
        all.extend(parts.map(|parts| one(number.name, number.is_angle, false, &parts)));
    }
    let description = model.manipulator.description();
    for (k, unknown) in model.unknowns.iter().enumerate() {
        let (rotation, outside) = match unknown {
            Unknown::Error(_, component) => (component.is_rotation(), false),
            Unknown::Base(_, component) if numbers.fixed_station => (component.is_rotation(), true),
            Unknown::Base(..) | Unknown::Magnitude(_) => continue,
            Unknown::Tool(component) => (component.is_rotation(), true),
            Unknown::Target(..) => (false, true),
            Unknown::Fixture(fixture, _) => {
                (matches!(model.fixtures[*fixture].place, Place::Direction(_)), true)
            }
            Unknown::Zero(reading) => (model.readings[*reading].gauge.is_angle(), true),
        };
        let (single, before) = one(name(model, *unknown, description), rotation, outside, &[(k, 1.0)]);
        // What is mounted on the tool moves what is measured, and not the tool point.
        let effect = if single.effect > 0.0 || rotation { single.effect } else { 1.0 };
        all.push((SingleError { effect, ..single }, before));
    }
    all
}

fn name(model: &Model, unknown: Unknown, description: &Description) -> String {
    let short = model.name(unknown);
    match unknown {
        Unknown::Error(frame, _) => format!("{short} ({})", description.frames[frame].name),
        Unknown::Base(_, component) => format!("station {}", component.name()),
        Unknown::Target(target, axis) => {
            let which = if model.targets.len() == 1 { String::new() } else { format!(" {}", target + 1) };
            format!("target{which} along {}", ["x", "y", "z"][axis])
        }
        _ => short,
    }
}
