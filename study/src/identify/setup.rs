//! The models that measurements are compared with.

use abbe::analysis::sampling;
use abbe::identify::{
    Failure, Fixture, Gauge, Measurement, Model, Observation, Options, Place, Role, Station, Unknown, fit,
    register, register_pairs,
};
use abbe::{Class, Component, Description, Manipulator, Pose, VariableKind, real_pose};
use abbe_spec::diagnostic::Diagnostics;

use crate::data::{Base, Data, Map};
use crate::mistake;

/// A manipulator, and where the instrument sees it.
pub(crate) struct Setup<'a> {
    pub(crate) description: &'a Description,
    /// Whether whole poses are measured.
    pub(crate) pose: bool,
    /// Whether nothing of what is mounted on the tool is unknown.
    placement: bool,
    /// The ideal chain, without any source.
    pub(crate) ideal: Model<'a>,
    /// The chain with the repeatable sources of its spec.
    pub(crate) real: Model<'a>,
    /// The same before a far start was brought near.
    pub(crate) delivered: Model<'a>,
    /// The sum of the lengths of the chain.
    pub(crate) arm: f64,
    /// How many sources the spec itself has.
    pub(crate) declared: usize,
}

impl<'a> Setup<'a> {
    /// Seen from where the map and the data say that the instrument stands. The last `terms` sources of the manipulator are
    /// no part of the machine: their magnitudes may become unknowns.
    pub(crate) fn new(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        data: &Data,
        terms: usize,
    ) -> Result<Self, Diagnostics> {
        let mut setup = Self::placed(manipulator, map, terms)?;
        let unnamed = [String::new()];
        let names = if data.stations.is_empty() { &unnamed[..] } else { &data.stations };
        let stations = names.iter().enumerate().map(|(i, name)| {
            let pose = match (map.stations.pose(name), map.base) {
                (Some(pose), _) => pose,
                (None, Base::Known | Base::Exact) if !map.stations.stated.is_empty() => {
                    return Err(unstated(map, data, name));
                }
                (None, Base::Known | Base::Exact) => Pose::IDENTITY,
                (None, Base::Unknown) => registered(&setup.real, &data.observations, i)
                    .map_err(|failure| mistake::whole(&data.file, &failure))?
                    .ok_or_else(|| in_line(data, name))?,
            };
            Ok(Station { name: name.clone(), pose, exact: map.base == Base::Exact })
        });
        let stations = stations.collect::<Result<Vec<_>, Diagnostics>>()?;
        setup.stand_at(&stations);
        Ok(setup)
    }

    /// Seen from where the map says, or from `F_0` itself.
    pub(crate) fn at_home(manipulator: &'a dyn Manipulator, map: &Map) -> Result<Self, Diagnostics> {
        Self::standing(manipulator, map, map.station_names())
    }

    /// The same for rows that are to be simulated, from every station that they name. An error if the map states some, and not
    /// that one.
    pub(crate) fn at_stations_of(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        data: &Data,
    ) -> Result<Self, Diagnostics> {
        let is_unstated = |name: &&String| map.stations.pose(name).is_none();
        match data.stations.iter().find(is_unstated) {
            Some(name) if !map.stations.stated.is_empty() => Err(unstated(map, data, name)),
            _ if data.stations.is_empty() => Self::at_home(manipulator, map),
            _ => Self::standing(manipulator, map, data.stations.clone()),
        }
    }

    fn standing(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        names: Vec<String>,
    ) -> Result<Self, Diagnostics> {
        let mut setup = Self::placed(manipulator, map, 0)?;
        let station = |name: String| Station {
            pose: map.stations.pose(&name).unwrap_or(Pose::IDENTITY),
            name,
            exact: map.base == Base::Exact,
        };
        setup.stand_at(&names.into_iter().map(station).collect::<Vec<_>>());
        Ok(setup)
    }

    fn placed(manipulator: &'a dyn Manipulator, map: &Map, terms: usize) -> Result<Self, Diagnostics> {
        let ideal = Model { mounting: map.mounting(), ..ideal(manipulator, map) };
        let description = ideal.manipulator.description();
        let mut real = ideal.clone();
        let declared = description.sources.len() - terms;
        for (source, role) in description.sources[..declared].iter().zip(&mut real.roles) {
            *role = if source.class == Class::Repeatable { Role::Known } else { Role::Off };
        }
        let arm = sampling::arm_length(ideal.manipulator, &ideal.s);
        let arm = arm.map_err(|error| mistake::whole(&description.name, &error))?;
        let placement = map.placement.exact;
        let delivered = real.clone();
        Ok(Self { description, pose: map.is_pose(), placement, ideal, real, delivered, arm, declared })
    }

    fn stand_at(&mut self, stations: &[Station]) {
        for model in [&mut self.ideal, &mut self.real, &mut self.delivered] {
            model.stations = stations.to_vec();
        }
    }

    /// Brings a start near that the data miss by far, in closed form: where the machine stands and what is mounted on its tool
    /// in turn, each the rigid motion that explains the data best beside the other.
    pub(crate) fn come_near(&mut self, data: &Data) -> Result<(), Failure> {
        let rows = &data.observations;
        let far = |model: &Model| Ok(model.figures(rows, &[])?.rms > FAR * self.arm);
        if !far(&self.real)? {
            return Ok(());
        }
        let mut near = self.real.clone();
        for _ in 0..ROUNDS {
            for i in 0..near.stations.len() {
                if !near.stations[i].exact
                    && let Some(pose) = registered(&near, rows, i)?
                {
                    near.stations[i].pose = pose;
                }
            }
            if !self.placement {
                mount(&mut near, rows, self.arm)?;
            }
            if !far(&near)? {
                break;
            }
        }
        for model in [&mut self.ideal, &mut self.real] {
            model.stations.clone_from(&near.stations);
            model.targets.clone_from(&near.targets);
            model.mounting = near.mounting;
        }
        Ok(())
    }

    /// Finds the stations that the map does not state, and the places of what its instruments look at that were not found before,
    /// for the machine as its spec has it.
    pub(crate) fn find_places(&mut self, map: &Map, data: &Data) -> Result<bool, Diagnostics> {
        let open =
            |station: &Station| map.base == Base::Unknown && map.stations.pose(&station.name).is_none();
        let names = self.real.stations.iter().enumerate().filter(|(_, station)| open(station));
        let stations = names.flat_map(|(i, _)| Component::ALL.map(|component| Unknown::Base(i, component)));
        let unknowns: Vec<Unknown> = stations.chain(self.fixtures_to_find(map)).collect();
        if unknowns.is_empty() {
            return Ok(false);
        }
        let model = self.real.with(unknowns);
        let fit = fit(&model, &data.observations, &Options::default());
        let fit = fit.map_err(|failure| mistake::whole(&data.file, &failure))?;
        self.stand_at(&found_stations(&model, &fit.x));
        let fixtures = (0..model.fixtures.len())
            .map(|i| Fixture { place: found_place(&model, &fit.x, i), ..model.fixtures[i].clone() });
        let fixtures: Vec<Fixture> = fixtures.collect();
        let zeros: Vec<f64> = (0..model.readings.len()).map(|i| found_zero(&model, &fit.x, i)).collect();
        for model in [&mut self.ideal, &mut self.real, &mut self.delivered] {
            model.fixtures.clone_from(&fixtures);
            model.readings.iter_mut().zip(&zeros).for_each(|(reading, zero)| reading.zero = *zero);
        }
        Ok(true)
    }

    /// The unknowns of what instruments look at that were not found before.
    fn fixtures_to_find(&self, map: &Map) -> Vec<Unknown> {
        let Some(all) = map.instruments() else { return Vec::new() };
        let open = (0..all.list.len()).filter(|i| !all.found.contains(i));
        let unknowns = open.flat_map(|i| {
            let place = all.fixture_of(i).into_iter().flat_map(|fixture| {
                let count = self.real.fixtures[fixture].place.unknowns();
                (0..count).map(move |coordinate| Unknown::Fixture(fixture, coordinate))
            });
            let zeros =
                all.list[i].readings.clone().filter(|reading| !self.real.readings[*reading].zero_known);
            place.chain(zeros.map(Unknown::Zero)).collect::<Vec<_>>()
        });
        unknowns.collect()
    }

    /// What is unknown of base and tool.
    pub(crate) fn base_and_tool(&self) -> Vec<Unknown> {
        self.but_exact(self.ideal.base_and_tool(self.pose))
    }

    /// What is unknown of base, frames and tool.
    pub(crate) fn constants(&self) -> Vec<Unknown> {
        self.but_exact(self.ideal.constants(self.pose))
    }

    fn but_exact(&self, mut unknowns: Vec<Unknown>) -> Vec<Unknown> {
        unknowns.retain(|unknown| !(self.placement && unknown.is_tool()));
        unknowns
    }

    /// The variables that the data move.
    pub(crate) fn moved(&self, data: &[Observation]) -> Vec<usize> {
        let moves = |i: &usize| {
            let values = data.iter().map(|row| row.q[*i]);
            let (least, largest) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            let unit = match self.description.variables[*i].kind {
                VariableKind::Revolute => 1.0,
                VariableKind::Prismatic => self.arm,
            };
            largest - least > 1e-4 * unit
        };
        (0..self.description.variables.len()).filter(moves).collect()
    }
}

/// The ideal chain, and what the instruments of a map look at.
fn ideal<'a>(manipulator: &'a dyn Manipulator, map: &Map) -> Model<'a> {
    let ideal = Model::ideal(manipulator, map.targets(), map.uncertainty);
    match map.instruments() {
        Some(all) => Model { fixtures: all.fixtures.clone(), readings: all.readings.clone(), ..ideal },
        None => ideal,
    }
}

/// The points that were measured of every target, none of those that were not.
fn points(model: &Model, observation: &Observation) -> Vec<Option<[f64; 3]>> {
    match &observation.measured {
        Measurement::Points(points) => points.to_vec(),
        Measurement::Pose(_) => Vec::new(),
        Measurement::Readings(values) => {
            let coordinate = |j: usize, k: usize| {
                let is_it = |gauge: Gauge| gauge == Gauge::Coordinate { target: j, axis: k };
                let mut of_it = model.readings.iter().zip(values).filter(|(reading, _)| is_it(reading.gauge));
                of_it.find_map(|(_, value)| *value)
            };
            let point = |j: usize| Some([coordinate(j, 0)?, coordinate(j, 1)?, coordinate(j, 2)?]);
            (0..model.targets.len()).map(point).collect()
        }
    }
}

/// A start that misses by more than this share of the arm is far.
const FAR: f64 = 0.01;

/// How often station and tool are found in turn.
const ROUNDS: usize = 50;

/// Puts on the tool what explains the data best: targets at their mean place, or the motion of the frame that is seen.
fn mount(model: &mut Model, rows: &[Observation], arm: f64) -> Result<(), Failure> {
    let mut room = model.room();
    let corners = [[0.0; 3], [arm, 0.0, 0.0], [0.0, arm, 0.0], [0.0, 0.0, arm]];
    let bare = Model { mounting: Pose::IDENTITY, ..model.clone() };
    let (mut from, mut to) = (Vec::new(), Vec::new());
    let mut sums = vec![([0.0; 3], 0.0); model.targets.len()];
    for row in rows {
        let back = bare.pose(&mut room, row, &[])?.inverse();
        for ((sum, count), point) in sums.iter_mut().zip(points(model, row)) {
            let Some(point) = point else { continue };
            let place = back.apply(point);
            *sum = std::array::from_fn(|i| sum[i] + place[i]);
            *count += 1.0;
        }
        if let Measurement::Pose(pose) = &row.measured {
            let seen = back.then(pose);
            from.extend(corners);
            to.extend(corners.map(|corner| seen.apply(corner)));
        }
    }
    for (target, (sum, count)) in model.targets.iter_mut().zip(sums) {
        if count > 0.0 {
            *target = sum.map(|v| v / count);
        }
    }
    if let Some(found) = register(&from, &to) {
        model.mounting = found.pose;
    }
    Ok(())
}

/// The stations of a model with what was found of them.
pub(super) fn found_stations(model: &Model, x: &[f64]) -> Vec<Station> {
    let mut stations = model.stations.clone();
    for (i, station) in stations.iter_mut().enumerate() {
        let of = |component| Unknown::Base(i, component);
        station.pose = station.pose.then(&displaced(model, x, of));
    }
    stations
}

/// Where a fixture of a model was found.
pub(super) fn found_place(model: &Model, x: &[f64], fixture: usize) -> Place {
    let by = |coordinate| value(model, x, Unknown::Fixture(fixture, coordinate));
    model.fixtures[fixture].place.moved(&[by(0), by(1), by(2)])
}

/// The zero of a reading as it was found.
pub(super) fn found_zero(model: &Model, x: &[f64], reading: usize) -> f64 {
    model.readings[reading].zero + value(model, x, Unknown::Zero(reading))
}

/// What was found of an unknown; 0 if it is none of the model's.
fn value(model: &Model, x: &[f64], unknown: Unknown) -> f64 {
    model.unknowns.iter().position(|one| *one == unknown).map_or(0.0, |k| x[k])
}

/// The motion that six unknowns are.
pub(super) fn displaced(model: &Model, x: &[f64], of: impl Fn(Component) -> Unknown) -> Pose {
    let errors = Component::ALL.map(|component| value(model, x, of(component)));
    real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[errors])
}

/// Every point that was measured with its target, none for the position of a pose.
pub(super) fn seen(model: &Model, observation: &Observation, mut take: impl FnMut(Option<usize>, [f64; 3])) {
    if let Measurement::Pose(measured) = &observation.measured {
        take(None, measured.position());
    }
    for (target, point) in points(model, observation).into_iter().enumerate().take(model.targets.len()) {
        if let Some(point) = point {
            take(Some(target), point);
        }
    }
}

/// Where `F_0` is as the instrument sees it from a station, from all points that were measured there: the rigid motion from
/// where they should be. None if they are in line.
pub(super) fn registered(
    model: &Model,
    data: &[Observation],
    station: usize,
) -> Result<Option<Pose>, Failure> {
    let mut room = model.room();
    let model = Model { stations: vec![Station::at(Pose::IDENTITY); station + 1], ..model.clone() };
    let rows = data.iter().filter(|row| row.station as usize == station);
    // The places alone are kept: what was measured is in the rows.
    let (mut from, x) = (Vec::new(), vec![0.0; model.unknowns.len()]);
    for observation in rows.clone() {
        let pose = model.pose(&mut room, observation, &x)?;
        let place = |target: Option<usize>| {
            target.map_or_else(|| pose.position(), |target| pose.apply(model.targets[target]))
        };
        seen(&model, observation, |target, _| from.push(place(target)));
    }
    let to = rows.flat_map(|observation| {
        let mut to = Vec::new();
        seen(&model, observation, |_, point| to.push(point));
        to
    });
    Ok(register_pairs(from.iter().copied().zip(to))
        .filter(|found| found.breadth > 1e-6)
        .map(|found| found.pose))
}

/// The map says where some stations are, and nothing of this one.
fn unstated(map: &Map, data: &Data, name: &str) -> Diagnostics {
    let stated = map.stations.stated.iter().map(|station| format!("`{}`", station.name.escape_debug()));
    let stated = stated.collect::<Vec<_>>().join(", ");
    let message = match name {
        "" => format!("rows without a station, and the map says where {stated} stand"),
        name => format!("rows of station `{}`: the map does not say where it is", name.escape_debug()),
    };
    let help = format!(
        "the map states {stated}: add a [[station]], or let these rows tell it by `base = \"unknown\"`, with `abbe measure` by \
         `--station new`"
    );
    mistake::with_help(&data.file, message, help)
}

fn in_line(data: &Data, name: &str) -> Diagnostics {
    let at = if name.is_empty() { String::new() } else { format!(" (station `{name}`)") };
    let message = format!("where the instrument stands needs three points that are not in line{at}");
    let help = "measure more, or say `base = \"known\"` in the map if it sees in F_0";
    mistake::with_help(&data.file, message, help)
}
