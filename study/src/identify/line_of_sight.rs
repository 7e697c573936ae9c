//! Configurations at which the instruments of a map can be read.

use abbe::identify::{Failure, Fixture, Gauge, Measurement, Model, Observation, Place, Reading, touched};
use abbe_spec::diagnostic::Diagnostics;

use super::setup::Setup;
use crate::data::{Instruments, Kind, Map};
use crate::mistake;

/// The same configurations, each in one setup after the other and moved to where the ideal machine touches what it is to
/// touch, stands at an indicator, and has readings within their ranges. Those that cannot are left out; `most` are enough.
///
/// Without instruments, or with such as are read anywhere, nothing is changed.
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
        // The next setup when the last one has its row; not in turn, for the bases of Halton's sequence are turns as well, and a
        // setup would see one half of a joint's travel.
        let turn = (readable.len() as f64 * std::f64::consts::SQRT_2).fract();
        let sight = &sights[((turn * sights.len() as f64) as usize).min(sights.len() - 1)];
        // The golden ratio spreads readings evenly over their ranges.
        let share = (0.5 + (i / sights.len()) as f64 * 0.618_033_988_749_895).fract();
        let wanted: Vec<Option<f64>> = sight.wanted.iter().map(|[a, b]| Some(a + share * (b - a))).collect();
        if let Some(q) = touched(&sight.model, &configuration, &[], &wanted, &moved)? {
            let measured = Measurement::Readings(sight.unread.clone());
            readable.push(Observation { q: q.into(), measured, ..configuration });
        }
    }
    Ok(readable)
}

/// The conditions under which the instruments of a setup can be read.
struct LineOfSight<'a> {
    /// The ideal machine, with a reading for each condition.
    model: Model<'a>,
    /// Between what each is to be.
    wanted: Vec<[f64; 2]>,
    /// The readings that are made.
    unread: Vec<Option<f64>>,
}

impl<'a> LineOfSight<'a> {
    fn new(setup: &Setup<'a>, all: &Instruments, read: &[usize]) -> Self {
        let mut model = Model { readings: Vec::new(), ..setup.ideal.clone() };
        let mut wanted = Vec::new();
        for instrument in read.iter().map(|i| &all.list[*i]) {
            let readings = &all.readings[instrument.readings.clone()];
            let [lower, upper] = instrument.range.unwrap_or_default();
            match (instrument.kind, instrument.at) {
                (Kind::Indicator, Some(at)) => {
                    // Not only along the direction: the target must be before the tip.
                    let Gauge::Along { target, direction, .. } = readings[0].gauge else { continue };
                    let Place::Direction(n) = all.fixtures[direction].place else { continue };
                    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
                    let from = model.fixtures.len();
                    model.fixtures.push(Fixture { name: instrument.name.clone(), place: Place::Point(at) });
                    for (axis, n) in n.iter().enumerate() {
                        let gauge = Gauge::Apart { target, from, axis };
                        model.readings.push(Reading { gauge, zero: 0.0, ..readings[0].clone() });
                        wanted.push([lower, upper].map(|reading| reading * n / length));
                    }
                }
                _ if instrument.kind.is_touched() || instrument.range.is_some() => {
                    model.readings.extend(readings.iter().cloned());
                    wanted.extend(readings.iter().map(|_| [lower, upper]));
                }
                _ => {}
            }
        }
        Self { model, wanted, unread: all.unread(read) }
    }
}

/// The mistake that no configuration can be measured.
pub(crate) fn nothing_readable(map: &str) -> Diagnostics {
    let help = "is `at` a place that the tool reaches, in F_0? can `range` be met there?";
    mistake::with_help(
        map,
        "within the limits of the joints, no configuration was found at which these instruments can be read",
        help,
    )
}
