//! Configurations at which the instruments of a map can be read.

use abbe::analysis::sampling;
use abbe::identify::{
    CONTACT, Camera, Failure, Fixture, FixtureGeometry, Measurement, Model, Observable, Observation,
    joints_at_values,
};
use abbe_spec::diagnostic::Diagnostics;

use super::setup::Setup;
use crate::data::{Instruments, Map};
use abbe_study::mistake;

/// Returns the configurations at which the instruments can be read, alternating between the setups.
///
/// Each configuration is moved to where the ideal machine touches its target, stands at an
/// indicator, and gives readings within their ranges. Configurations where this fails are left out;
/// the search ends after `most`.
///
/// Without instruments, or with instruments that can be read anywhere, the configurations stay
/// unchanged. Those where loops do not close, or where targets are out of
/// [sight](crate::data::Sight), are left out.
pub(crate) fn readable_configurations(
    setup: &Setup,
    map: &Map,
    mut configurations: Vec<Observation>,
    most: usize,
) -> Result<Vec<Observation>, Failure> {
    let Model { manipulator, s, .. } = &setup.ideal;
    configurations.retain(|configuration| sampling::closes(*manipulator, &configuration.q, s));
    if let Some(sight) = &map.sight {
        let targets = setup.delivered_points();
        let is_seen = |q: &[f64]| manipulator.pose(q, s).is_ok_and(|tool| sight.sees(&tool, &targets));
        configurations.retain(|configuration| is_seen(&configuration.q));
    }
    let Some(all) = map.instruments() else {
        configurations.truncate(most);
        return Ok(configurations);
    };
    let moved: Vec<usize> = map.moved().collect();
    let sights: Vec<LineOfSight> =
        all.setups().into_iter().map(|(_, read)| LineOfSight::new(setup, all, &read)).collect();
    let mut readable = Vec::new();
    // A map does not say which side of a board is printed: the other one if none sees this.
    for side in [1.0, -1.0] {
        for (i, configuration) in configurations.iter().cloned().enumerate() {
            if readable.len() == most {
                break;
            }
            // Setups are not taken strictly in turn: the bases of Halton's sequence are periodic
            // too, and a setup would then see only half of a joint's travel.
            let turn = (readable.len() as f64 * std::f64::consts::SQRT_2).fract();
            let sight = &sights[((turn * sights.len() as f64) as usize).min(sights.len() - 1)];
            // The golden ratio spreads the readings evenly over their ranges.
            let share = (0.5 + (i / sights.len()) as f64 * 0.618_033_988_749_895).fract();
            let wanted: Vec<Option<f64>> =
                sight.wanted.iter().map(|[a, b]| Some(a + share * (b - a))).collect();
            if let Some(camera) = all.camera {
                let measured = Measurement::Readings(sight.unread.clone());
                let view = Observation { measured, ..configuration };
                readable.extend(with_board_in_view(setup, all, (&camera, side), view, i, &moved)?);
                continue;
            }
            if let Some(q) = joints_at_values(&sight.model, &configuration, &[], &wanted, &moved)? {
                let measured = Measurement::Readings(sight.unread.clone());
                readable.push(Observation { q: q.into(), measured, ..configuration });
            }
        }
        if !readable.is_empty() || all.camera.is_none() {
            break;
        }
    }
    Ok(readable)
}

/// Largest angle between the normal of a board and the line of sight for which corners are found.
const STEEPEST: f64 = 60.0;

/// Returns a configuration if the ideal camera sees the board there, or moves it to where it does;
/// none if it does not reach such a view. The board is seen from behind (1) or from where its z
/// axis points (−1). Number `i` chooses place, size and rotation of the board in the image.
fn with_board_in_view(
    setup: &Setup,
    all: &Instruments,
    (camera, side): (&Camera, f64),
    view: Observation,
    i: usize,
    moved: &[usize],
) -> Result<Option<Observation>, Failure> {
    let is_in_view = |view: &Observation| -> Result<bool, Failure> {
        let tool = setup.ideal.at(&[]).pose(view)?;
        let board = if camera.is_on_tool { tool.inverse() } else { tool };
        Ok(all.observables.chunks_exact(2).all(|corner| {
            let point = board.apply(corner[0].corner);
            let distance = point.iter().map(|x| x * x).sum::<f64>().sqrt();
            let facing = side * (0..3).map(|k| board.0[2][k] * point[k]).sum::<f64>() / distance;
            point[2] > 0.0 && camera.is_inside(camera.pixel(point)) && facing > STEEPEST.to_radians().cos()
        }))
    };
    if is_in_view(&view)? {
        return Ok(Some(view));
    }
    let mut corners = all.observables.chunks_exact(2);
    let (Some(first), Some(last)) = (corners.next(), corners.next_back()) else { return Ok(None) };
    let [width, height] = camera.image;
    // The generalized golden ratio of four dimensions (Roberts, 2018).
    let share = |base: f64| ((i as f64 + 0.5) * base).fract();
    let [x, y, size, angle] = [0.856_674_883_9, 0.733_891_856_6, 0.628_706_721, 0.538_596_978_6].map(share);
    let half = (0.15 + 0.2 * size) * width.min(height);
    let (sine, cosine) = (std::f64::consts::TAU * angle).sin_cos();
    let center = [width * (0.375 + 0.25 * x), height * (0.375 + 0.25 * y)];
    let ends = [-half, half].map(|half| [center[0] + half * cosine, center[1] + half * sine]);
    let model = Model { observables: [first, last].concat(), ..setup.ideal.clone() };
    let wanted: Vec<Option<f64>> = ends.as_flattened().iter().map(|pixel| Some(*pixel)).collect();
    let Some(q) = joints_at_values(&model, &view, &[], &wanted, moved)? else { return Ok(None) };
    let view = Observation { q: q.into(), ..view };
    Ok(is_in_view(&view)?.then_some(view))
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
pub(crate) fn nothing_readable(map: &Map) -> Diagnostics {
    let help = if map.instruments().is_some_and(|all| all.camera.is_some()) {
        "check `[[station]]`, `[placement]` and `mount`: the camera must see the whole board, not too obliquely"
    } else {
        "check that the tool can reach `at` (in F_0) with readings within `range`, and targets `[sight]`"
    };
    let message = "no configuration was found within the joint limits at which these instruments can be read";
    mistake::with_help(map.path(), message, help)
}
