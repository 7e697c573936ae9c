//! Configurations at which the instruments of a map can be read.

use abbe::identify::{
    CONTACT, Failure, Fixture, FixtureGeometry, Measurement, Model, Observable, Observation, joints_at_values,
};
use abbe_spec::diagnostic::Diagnostics;

use super::setup::Setup;
use crate::data::{Instruments, Map};
use crate::mistake;

/// Returns the configurations at which the instruments can be read, alternating between the setups.
///
/// Each configuration is moved to where the ideal machine touches its target, stands at an
/// indicator, and gives readings within their ranges. Configurations where this fails are left out;
/// the search ends after `most`.
///
/// Without instruments, or with instruments that can be read anywhere, the configurations stay
/// unchanged.
pub(crate) fn readable_configurations(
    setup: &Setup,
    map: &Map,
    mut configurations: Vec<Observation>,
    most: usize,
) -> Result<Vec<Observation>, Failure> {
    let Some(all) = map.instruments() else {
        configurations.truncate(most);
        return Ok(configurations);
    };
    let moved: Vec<usize> = map.moved().collect();
    let sights: Vec<LineOfSight> =
        all.setups().into_iter().map(|(_, read)| LineOfSight::new(setup, all, &read)).collect();
    let mut readable = Vec::new();
    for (i, configuration) in configurations.into_iter().enumerate() {
        if readable.len() == most {
            break;
        }
        // Setups are not taken strictly in turn: the bases of Halton's sequence are periodic too,
        // and a setup would then see only half of a joint's travel.
        let turn = (readable.len() as f64 * std::f64::consts::SQRT_2).fract();
        let sight = &sights[((turn * sights.len() as f64) as usize).min(sights.len() - 1)];
        // The golden ratio spreads the readings evenly over their ranges.
        let share = (0.5 + (i / sights.len()) as f64 * 0.618_033_988_749_895).fract();
        let wanted: Vec<Option<f64>> = sight.wanted.iter().map(|[a, b]| Some(a + share * (b - a))).collect();
        if let Some(q) = joints_at_values(&sight.model, &configuration, &[], &wanted, &moved)? {
            let measured = Measurement::Readings(sight.unread.clone());
            readable.push(Observation { q: q.into(), measured, ..configuration });
        }
    }
    Ok(readable)
}

/// Conditions under which the instruments of a setup can be read.
struct LineOfSight<'a> {
    /// Ideal machine, with a reading for each condition.
    model: Model<'a>,
    /// Range of each condition's reading.
    wanted: Vec<[f64; 2]>,
    /// Readings of the setup, still without values.
    unread: Vec<Option<f64>>,
}

impl<'a> LineOfSight<'a> {
    fn new(setup: &Setup<'a>, all: &Instruments, read: &[usize]) -> Self {
        let mut model = Model { observables: Vec::new(), ..setup.ideal.clone() };
        let mut wanted = Vec::new();
        for instrument in read.iter().map(|i| &all.list[*i]) {
            let kind = instrument.kind;
            let observables = &all.observables[instrument.observables.clone()];
            let geometry = observables[0].fixture.map(|fixture| all.fixtures[fixture].geometry);
            let [lower, upper] = instrument.range.unwrap_or_default();
            match geometry {
                Some(FixtureGeometry::Direction(n)) if kind.has("at") && !kind.is_touched() => {
                    // All three coordinates: the target must be in front of the tip.
                    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
                    let fixture = Some(model.fixtures.len());
                    let geometry = FixtureGeometry::Point(observables[0].at);
                    model.fixtures.push(Fixture { name: instrument.name.clone(), geometry });
                    for (axis, n) in n.iter().enumerate() {
                        let contact = Observable { kind: &CONTACT, axis, fixture, ..observables[0].clone() };
                        model.observables.push(Observable { zero: 0.0, ..contact });
                        wanted.push([lower, upper].map(|reading| reading * n / length));
                    }
                }
                _ if kind.is_touched() || instrument.range.is_some() => {
                    model.observables.extend(observables.iter().cloned());
                    wanted.extend(observables.iter().map(|_| [lower, upper]));
                }
                _ => {}
            }
        }
        Self { model, wanted, unread: all.unread(read) }
    }
}

/// Returns the error that the instruments can be read at no configuration.
pub(crate) fn nothing_readable(map: &str) -> Diagnostics {
    let help = "check that the tool can reach `at` (in F_0) with readings within `range`";
    mistake::with_help(
        map,
        "no configuration was found within the joint limits at which these instruments can be read",
        help,
    )
}
