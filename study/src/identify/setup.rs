//! Models that measurements are compared with.

use abbe::analysis::sampling;
use abbe::identify::{
    Failure, FixtureGeometry, INTRINSICS, Measurement, Model, Observable, Observation, Role, Station,
    Unknown, register, register_pairs,
};
use abbe::{Class, Component, Description, Manipulator, Pose, VariableKind, real_pose};
use abbe_spec::diagnostic::Diagnostics;

use super::board_check::check_board;
use super::scale::reference_length;
use crate::data::{Base, Data, Map};
use crate::mistake;

/// Manipulator and its placement relative to the instrument.
pub(crate) struct Setup<'a> {
    pub(crate) description: &'a Description,
    /// Is true if whole poses are measured.
    pub(crate) pose: bool,
    /// Is true if the placement on the tool is known exactly.
    pub(super) placement: bool,
    /// Ideal chain, without any source.
    pub(crate) ideal: Model<'a>,
    /// Chain with the repeatable sources of its spec.
    pub(crate) real: Model<'a>,
    /// The real chain before [`Setup::come_near`] improved its placement.
    pub(crate) delivered: Model<'a>,
    /// Sum of the lengths of the chain, in the length unit.
    pub(crate) arm: f64,
    /// Number of sources of the spec itself.
    pub(crate) declared: usize,
}

impl<'a> Setup<'a> {
    /// Places the manipulator at the stations that the map and the data state.
    ///
    /// The last `terms` sources of the manipulator are not part of the machine: their magnitudes
    /// may become unknowns.
    pub(crate) fn new(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        data: &Data,
        terms: usize,
    ) -> Result<Self, Diagnostics> {
        let mut setup = Self::without_stations(manipulator, map, terms)?;
        check_board(&setup.real, data)?;
        let measured = setup.real.as_poses(&data.observations);
        let unnamed = [String::new()];
        let names = if data.stations.is_empty() { &unnamed[..] } else { &data.stations };
        let stations = names.iter().enumerate().map(|(i, name)| {
            let pose = match (map.stations.pose(name), map.base) {
                (Some(pose), _) => pose,
                (None, Base::Known | Base::Exact) if !map.stations.stated.is_empty() => {
                    return Err(missing_station(map, data, name));
                }
                (None, Base::Known | Base::Exact) => Pose::IDENTITY,
                (None, Base::Unknown) => registered(&setup.real, &measured, i)
                    .map_err(|failure| mistake::whole(&data.file, &failure))?
                    .ok_or_else(|| collinear(data, name))?,
            };
            Ok(Station { name: name.clone(), pose, exact: map.base == Base::Exact })
        });
        let stations = stations.collect::<Result<Vec<_>, Diagnostics>>()?;
        setup.set_stations(&stations);
        setup.place_fixtures(map, data).map_err(|failure| mistake::whole(&data.file, &failure))?;
        if let Some(row) = data.observations.first() {
            let length = reference_length(&setup.ideal, &row.q, &setup.moved(&data.observations));
            let length = length.map_err(|error| mistake::whole(&data.file, &error))?;
            for model in [&mut setup.ideal, &mut setup.real, &mut setup.delivered] {
                model.reference_length = length;
            }
        }
        Ok(setup)
    }

    /// Places the manipulator as the map states, or at `F_0` of the instrument.
    pub(crate) fn at_home(manipulator: &'a dyn Manipulator, map: &Map) -> Result<Self, Diagnostics> {
        Self::with_stations(manipulator, map, map.station_names())
    }

    /// Places the manipulator at every station named in rows that are to be simulated. Returns an
    /// error if the map states some stations, but not one of these.
    pub(crate) fn at_stations_of(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        data: &Data,
    ) -> Result<Self, Diagnostics> {
        let is_unstated = |name: &&String| map.stations.pose(name).is_none();
        match data.stations.iter().find(is_unstated) {
            Some(name) if !map.stations.stated.is_empty() => Err(missing_station(map, data, name)),
            _ if data.stations.is_empty() => Self::at_home(manipulator, map),
            _ => Self::with_stations(manipulator, map, data.stations.clone()),
        }
    }

    fn with_stations(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        names: Vec<String>,
    ) -> Result<Self, Diagnostics> {
        if let Some(all) = map.instruments()
            && let Some(instrument) = all.at_unknown_positions().next()
        {
            let message = format!("the position of the contact \"{}\" is unknown", all.list[instrument].name);
            let help = "without measured rows it must be stated: add `at` to its table, in the axes of F_0";
            return Err(mistake::with_help(map.path(), &message, help));
        }
        let mut setup = Self::without_stations(manipulator, map, 0)?;
        if setup.ideal.camera.is_some() && !map.is_placed() {
            return Err(unplaced(map));
        }
        let station = |name: String| Station {
            pose: map.stations.pose(&name).unwrap_or(Pose::IDENTITY),
            name,
            exact: map.base == Base::Exact,
        };
        setup.set_stations(&names.into_iter().map(station).collect::<Vec<_>>());
        Ok(setup)
    }

    fn without_stations(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        terms: usize,
    ) -> Result<Self, Diagnostics> {
        let ideal = Model { mounting: map.mounting(), ..ideal_model(manipulator, map) };
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

    pub(super) fn set_stations(&mut self, stations: &[Station]) {
        for model in [&mut self.ideal, &mut self.real, &mut self.delivered] {
            model.stations = stations.to_vec();
        }
    }

    /// Improves a placement that is far from the data, in closed form.
    ///
    /// The station poses and the placement on the tool are registered in turn: each is the rigid
    /// motion that explains the data best given the other.
    pub(crate) fn come_near(&mut self, data: &Data) -> Result<(), Failure> {
        let far = |model: &Model| Ok(model.figures(&data.observations, &[])?.rms > FAR * self.arm);
        if !far(&self.real)? {
            return Ok(());
        }
        let rows = &*self.real.as_poses(&data.observations);
        let mut near = self.real.clone();
        if near.camera.is_some()
            && !self.placement
            && !near.stations[0].exact
            && let Some([base, mounting]) = near.hand_eye(rows, 0)?
        {
            (near.stations[0].pose, near.mounting) = (base, mounting);
        }
        for _ in 0..ROUNDS {
            for i in 0..near.stations.len() {
                if !near.stations[i].exact
                    && let Some(pose) = registered(&near, rows, i)?
                {
                    near.stations[i].pose = pose;
                }
            }
            if !self.placement {
                register_tool(&mut near, rows, self.arm)?;
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

    /// Returns the measured points in the frame of the tool, as the map states them: targets, or
    /// the origin of the measured frame.
    pub(crate) fn delivered_points(&self) -> Vec<[f64; 3]> {
        let Model { mounting, targets, .. } = &self.delivered;
        match self.pose {
            true => vec![mounting.position()],
            false => targets.iter().map(|target| mounting.apply(*target)).collect(),
        }
    }

    /// Returns the unknowns of base and tool.
    pub(crate) fn base_and_tool(&self) -> Vec<Unknown> {
        self.without_exact(self.ideal.base_and_tool(self.pose))
    }

    /// Returns the unknowns of base, frames and tool.
    pub(crate) fn constants(&self) -> Vec<Unknown> {
        self.without_exact(self.ideal.constants(self.pose))
    }

    fn without_exact(&self, mut unknowns: Vec<Unknown>) -> Vec<Unknown> {
        unknowns.retain(|unknown| !(self.placement && unknown.is_tool()));
        unknowns
    }

    /// Returns the indices of the variables that move in the data.
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

/// Returns the ideal chain with the fixtures and readings of a map.
fn ideal_model<'a>(manipulator: &'a dyn Manipulator, map: &Map) -> Model<'a> {
    let ideal = Model::ideal(manipulator, map.targets(), map.uncertainty);
    match map.instruments() {
        Some(all) => Model {
            fixtures: all.fixtures.clone(),
            observables: all.observables.clone(),
            camera: all.camera,
            ..ideal
        },
        None => ideal,
    }
}

/// Returns the measured point of every target, in the frame of the instrument; none for targets
/// that were not measured.
fn points(model: &Model, observation: &Observation) -> Vec<Option<[f64; 3]>> {
    match &observation.measured {
        Measurement::Points(points) => points.to_vec(),
        Measurement::Pose(_) => Vec::new(),
        Measurement::Readings(values) => {
            let coordinate = |j: usize, k: usize| {
                let is_it = |o: &Observable| o.kind.sees_base && (o.targets[0], o.axis) == (j, k);
                let mut own =
                    model.observables.iter().zip(values).filter(|(observable, _)| is_it(observable));
                own.find_map(|(_, value)| *value)
            };
            let point = |j: usize| Some([coordinate(j, 0)?, coordinate(j, 1)?, coordinate(j, 2)?]);
            (0..model.targets.len()).map(point).collect()
        }
    }
}

/// Residual, as a share of the arm length, above which an initial placement is far.
const FAR: f64 = 0.01;

/// Largest number of alternating registrations of stations and tool.
const ROUNDS: usize = 50;

/// Registers the placement on the tool: targets at their mean position, or the pose of the measured
/// frame.
fn register_tool(model: &mut Model, rows: &[Observation], arm: f64) -> Result<(), Failure> {
    let mut scratch = model.scratch();
    let corners = [[0.0; 3], [arm, 0.0, 0.0], [0.0, arm, 0.0], [0.0, 0.0, arm]];
    let bare = Model { mounting: Pose::IDENTITY, ..model.clone() };
    let (mut from, mut to) = (Vec::new(), Vec::new());
    let mut sums = vec![([0.0; 3], 0.0); model.targets.len()];
    for row in rows {
        let back = bare.pose(&mut scratch, row, &[])?.inverse();
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

/// Returns the stations of a model with their identified poses.
pub(super) fn fitted_stations(model: &Model, x: &[f64]) -> Vec<Station> {
    let mut stations = model.stations.clone();
    for (i, station) in stations.iter_mut().enumerate() {
        let of = |component| Unknown::Base(i, component);
        station.pose = station.pose.then(&error_pose(model, x, of));
    }
    stations
}

/// Returns the identified place of a fixture.
pub(super) fn fitted_fixture(model: &Model, x: &[f64], fixture: usize) -> FixtureGeometry {
    let by = |coordinate| value(model, x, Unknown::Fixture(fixture, coordinate));
    model.fixtures[fixture].geometry.displaced(&[by(0), by(1), by(2)])
}

/// Returns the identified zero of a reading.
pub(super) fn fitted_zero(model: &Model, x: &[f64], reading: usize) -> f64 {
    model.observables[reading].zero + value(model, x, Unknown::Zero(reading))
}

/// Returns the identified intrinsic parameters of the camera, if it has unknown ones.
pub(super) fn fitted_intrinsics(model: &Model, x: &[f64]) -> Option<[f64; INTRINSICS]> {
    let camera = model.camera.filter(|camera| !camera.is_known)?;
    Some(std::array::from_fn(|i| camera.intrinsics[i] + value(model, x, Unknown::Intrinsic(i))))
}

/// Returns the value of an unknown; 0 if the model does not have it.
fn value(model: &Model, x: &[f64], unknown: Unknown) -> f64 {
    model.unknowns.iter().position(|one| *one == unknown).map_or(0.0, |k| x[k])
}

/// Returns the rigid motion given by six unknown errors.
pub(super) fn error_pose(model: &Model, x: &[f64], of: impl Fn(Component) -> Unknown) -> Pose {
    let errors = Component::ALL.map(|component| value(model, x, of(component)));
    real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[errors])
}

/// Calls `take` with every measured point and its target; the target is none for the position of a
/// pose.
pub(super) fn for_each_point(
    model: &Model,
    observation: &Observation,
    mut take: impl FnMut(Option<usize>, [f64; 3]),
) {
    if let Measurement::Pose(measured) = &observation.measured {
        take(None, measured.position());
    }
    for (target, point) in points(model, observation).into_iter().enumerate().take(model.targets.len()) {
        if let Some(point) = point {
            take(Some(target), point);
        }
    }
}

/// Registers a station: returns the pose of `F_0` in the frame of the instrument that maps the
/// predicted points onto all points measured there. None if the points are collinear.
pub(super) fn registered(
    model: &Model,
    data: &[Observation],
    station: usize,
) -> Result<Option<Pose>, Failure> {
    let mut scratch = model.scratch();
    let model = Model { stations: vec![Station::at(Pose::IDENTITY); station + 1], ..model.clone() };
    let rows = data.iter().filter(|row| row.station as usize == station);
    // The measured points stay in the rows; only the predicted ones are stored.
    let (mut from, x) = (Vec::new(), vec![0.0; model.unknowns.len()]);
    for observation in rows.clone() {
        let pose = model.pose(&mut scratch, observation, &x)?;
        let place = |target: Option<usize>| {
            target.map_or_else(|| pose.position(), |target| pose.apply(model.targets[target]))
        };
        for_each_point(&model, observation, |target, _| from.push(place(target)));
    }
    let to = rows.flat_map(|observation| {
        let mut to = Vec::new();
        for_each_point(&model, observation, |_, point| to.push(point));
        to
    });
    Ok(register_pairs(from.iter().copied().zip(to))
        .filter(|found| found.breadth > 1e-6)
        .map(|found| found.pose))
}

/// Returns the error that the map states some stations, but not this one.
fn missing_station(map: &Map, data: &Data, name: &str) -> Diagnostics {
    let stated = map.stations.stated.iter().map(|station| format!("`{}`", station.name.escape_debug()));
    let stated = stated.collect::<Vec<_>>().join(", ");
    let message = match name {
        "" => format!(
            "these rows name no station, and the map gives the poses of the stations \
            {stated} only"
        ),
        name => {
            format!("the map does not give the pose of the station `{}` of these rows", name.escape_debug())
        }
    };
    let help = format!(
        "add a [[station]] to those of the map ({stated}), or fit it to these rows by `base = \
         \"unknown\"` (in `abbe measure` by `--station new`)"
    );
    mistake::with_help(&data.file, message, help)
}

/// Returns the error that a map does not state where its camera and its board are.
fn unplaced(map: &Map) -> Diagnostics {
    let message = "this map does not state where the camera and the board are";
    let help = "add `[[station]]` and `[placement]`, or take the map that `abbe identify --out` writes from \
        about ten first views";
    mistake::with_help(map.path(), message, help)
}

fn collinear(data: &Data, name: &str) -> Diagnostics {
    let at = if name.is_empty() { String::new() } else { format!(" (station `{name}`)") };
    let message = format!("to locate the instrument, three points that are not collinear are needed{at}");
    let help = "measure more points, or set `base = \"known\"` in the map if it measures in F_0";
    mistake::with_help(&data.file, message, help)
}
