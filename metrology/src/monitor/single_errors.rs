//! Errors that may have changed, each alone, with their effect on the measured values.

use abbe::Description;
use abbe::identify::{Model, Unknown};
use abbe_spec::Spec;

use super::check_values::CheckValues;
use super::vectors::{cosine, norm};
use crate::identify::{chain_errors, unknowns_of};

/// Absolute cosine of two effects above which errors count as one: they differ by less than a
/// fifth.
const INDISTINGUISHABLE: f64 = 0.98;

/// Smallest share of an effect that must remain without the component of the station.
const OBSERVABLE: f64 = 1e-3;

/// Effects smaller than this share of the largest one are rounding errors.
const ROUNDING: f64 = 1e-9;

/// Error of the machine that may have changed while all others are unchanged.
#[derive(Clone, Debug)]
pub(super) struct SingleError {
    /// Name: `zero of q2`, `e_y3 (elbow)`, `station e_x`.
    pub(super) name: String,
    /// Unit: `rad`, or the length unit.
    pub(super) unit: &'static str,
    /// Is true if the error belongs to the station or to what is mounted on the tool instead of the
    /// machine.
    pub(super) is_placement: bool,
    /// Derivative of every value, in units of the instrument's uncertainty, without the component
    /// of the station.
    pub(super) column: Vec<f64>,
    /// Largest displacement of the tool point per unit of the error over the configurations, in the
    /// length unit.
    pub(super) effect: f64,
}

/// Errors of a machine, grouped by indistinguishability.
pub(super) struct SingleErrors {
    /// Every observable error.
    pub(super) list: Vec<SingleError>,
    /// Groups of indistinguishable errors: the index of the one with the chart, and those of the
    /// others.
    pub(super) charts: Vec<(usize, Vec<usize>)>,
    /// Names of the errors that are indistinguishable from a displacement of the instrument.
    pub(super) unseen: Vec<String>,
}

impl SingleErrors {
    /// Collects zeros of joints, other numbers of the chain, errors of the frames, of a fixed
    /// station, and of the targets. The first of a group of indistinguishable errors has the chart.
    pub(super) fn new(spec: &Spec, model: &Model, numbers: &CheckValues) -> Self {
        let mut all = Self { list: Vec::new(), charts: Vec::new(), unseen: Vec::new() };
        let candidates = candidates(spec, model, numbers);
        let rounding = ROUNDING * candidates.iter().map(|(_, before)| *before).fold(0.0, f64::max);
        for (single, before) in candidates {
            if norm(&single.column) <= OBSERVABLE * before || before <= rounding {
                all.unseen.push(single.name);
                continue;
            }
            let index = all.list.len();
            let is_indistinguishable = |(first, _): &&mut (usize, Vec<usize>)| {
                cosine(&all.list[*first].column, &single.column).abs() > INDISTINGUISHABLE
            };
            match all.charts.iter_mut().find(is_indistinguishable) {
                Some((_, others)) => others.push(index),
                None => all.charts.push((index, Vec::new())),
            }
            all.list.push(single);
        }
        all
    }
}

/// Returns all errors, each with the norm of its column before the component of the station is
/// removed.
fn candidates(spec: &Spec, model: &Model, numbers: &CheckValues) -> Vec<(SingleError, f64)> {
    let index_of = |unknown: Unknown| model.unknowns.iter().position(|other| *other == unknown);
    let length = spec.length.symbol();
    let one = |name: String, rotation: bool, is_placement: bool, parts: &[(usize, f64)]| {
        let column = numbers.column(parts);
        let before = norm(&column);
        let unit = if rotation { "rad" } else { length };
        let effect = numbers.effect(parts);
        (SingleError { name, unit, is_placement, column: numbers.without_station(column), effect }, before)
    };
    let mut all = Vec::new();
    for number in chain_errors(spec) {
        let parts = unknowns_of(&number.errors).map(|(unknown, error)| Some((index_of(unknown)?, error)));
        let parts: Option<Vec<(usize, f64)>> = parts.collect();
        all.extend(parts.map(|parts| one(number.name, number.is_angle, false, &parts)));
    }
    let description = model.manipulator.description();
    for (k, unknown) in model.unknowns.iter().enumerate() {
        let is_known = !numbers.fixed_station && matches!(unknown, Unknown::Base(..));
        if is_known || matches!(unknown, Unknown::Magnitude(_)) {
            continue;
        }
        let (rotation, is_placement) = (model.is_angle(*unknown), unknown.is_placement());
        let (single, before) = one(name(model, *unknown, description), rotation, is_placement, &[(k, 1.0)]);
        // An offset of what is mounted on the tool moves the measured point, not the tool point.
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
