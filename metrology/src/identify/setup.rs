//! Models that measurements are compared with.

use abbe::analysis::sampling::range_of;
use abbe::identify::{Failure, Model, Observation, Role, Station, Unknown};
use abbe::{Class, Description, Manipulator, Pose};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::option::{IDENTIFY_OUT, STATION_NEW};

use super::board_check::check_board;
use super::known_distances::measured_distances;
use super::registered::{OpenPlaces, register_in_turn, registered};
use super::scale::reference_length;
use crate::data::{Base, Data, Map};
use abbe_study::{About, Result, mistake};

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
    /// Stations, and places on the tool, that neither map nor drawing states.
    pub(super) open: OpenPlaces,
    /// Size of the machine, in the length unit.
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
    ) -> Result<Self> {
        let mut setup = Self::without_stations(manipulator, map, &data.observations, terms)?;
        let names = if data.stations.is_empty() { vec![String::new()] } else { data.stations.clone() };
        setup.name_stations(map, &names);
        check_board(&setup.real, data)?;
        let measured = setup.real.as_poses(&data.observations);
        let mut stations = setup.real.stations.clone();
        for (i, station) in stations.iter_mut().enumerate() {
            if setup.open.stations[i] {
                station.pose = registered(&setup.real, &measured, i)
                    .about(&data.file)?
                    .ok_or_else(|| collinear(data, &station.name))?;
            } else if map.stations.pose(&station.name).is_none() && !map.stations.stated.is_empty() {
                return Err(missing_station(map, data, &station.name));
            }
        }
        setup.set_stations(&stations);
        setup.place_tool(map, data).about(&data.file)?;
        let known = measured_distances(&setup.real, map, data)?;
        setup.models().into_iter().for_each(|model| model.known_distances.clone_from(&known));
        setup.place_fixtures(map, data).about(&data.file)?;
        if let Some(row) = data.observations.first() {
            let length = reference_length(&setup.ideal, &row.q, &setup.moved(&data.observations));
            let length = length.about(&data.file)?;
            setup.models().into_iter().for_each(|model| model.reference_length = length);
        }
        Ok(setup)
    }

    /// Places the manipulator as the map states, or at `F_0` of the instrument.
    pub(crate) fn at_home(manipulator: &'a dyn Manipulator, map: &Map) -> Result<Self> {
        Self::with_stations(manipulator, map, &map.station_names())
    }

    /// Places the manipulator at every station named in rows that are to be simulated. Returns an
    /// error if the map states some stations, but not one of these.
    pub(crate) fn at_stations_of(manipulator: &'a dyn Manipulator, map: &Map, data: &Data) -> Result<Self> {
        let is_unstated = |name: &&String| map.stations.pose(name).is_none();
        match data.stations.iter().find(is_unstated) {
            Some(name) if !map.stations.stated.is_empty() => Err(missing_station(map, data, name)),
            _ if data.stations.is_empty() => Self::at_home(manipulator, map),
            _ => Self::with_stations(manipulator, map, &data.stations),
        }
    }

    fn with_stations(manipulator: &'a dyn Manipulator, map: &Map, names: &[String]) -> Result<Self> {
        if let Some(all) = map.instruments()
            && let Some(instrument) = all.at_unknown_positions().next()
        {
            let message = format!("the position of the contact \"{}\" is unknown", all.list[instrument].name);
            let help = "without measured rows it must be stated: add `at` to its table, in the axes of F_0";
            return Err(mistake::with_help(map.path(), &message, help));
        }
        let unknown = names.iter().find_map(|name| map.unknown_targets_at(name).iter().position(|one| *one));
        if let Some(target) = unknown {
            let message = format!("the position of target {} on the tool is unknown", target + 1);
            let help = format!(
                "without measured rows it must be stated: write three lengths in the frame of the tool \
                 as its `position`, or take the map that `{IDENTIFY_OUT}` writes"
            );
            return Err(mistake::with_help(map.path(), message, help));
        }
        let mut setup = Self::without_stations(manipulator, map, &[], 0)?;
        if setup.ideal.camera.is_some() && !map.is_placed() {
            return Err(unplaced(map));
        }
        setup.name_stations(map, names);
        Ok(setup)
    }

    fn without_stations(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        rows: &[Observation],
        terms: usize,
    ) -> Result<Self> {
        let mut ideal = ideal_model(manipulator, map);
        ideal.ranges = ranges(rows);
        ideal.stated_freedom *= f64::from(u8::from(map.states_uncertainty()));
        let description = ideal.manipulator.description();
        let mut real = ideal.clone();
        let declared = description.sources.len() - terms;
        for (source, role) in description.sources[..declared].iter().zip(&mut real.roles) {
            *role = if source.class == Class::Repeatable { Role::Known } else { Role::Off };
        }
        let arm = ideal.arm_length().about(&description.name)?;
        let placement = map.placement.exact;
        let (delivered, open) = (real.clone(), OpenPlaces::default());
        Ok(Self { description, pose: map.is_pose(), placement, ideal, real, delivered, open, arm, declared })
    }

    /// Sets the stations, and the placements on the tool, as the map states them; stations at `F_0`
    /// if it does not.
    fn name_stations(&mut self, map: &Map, names: &[String]) {
        let is_per_station = map.placement.is_per_station;
        let station = |(i, name): (usize, &String)| Station {
            name: name.clone(),
            pose: map.stations.pose(name).unwrap_or(Pose::IDENTITY),
            exact: map.base == Base::Exact,
            placement: if is_per_station { i } else { 0 },
        };
        let stations: Vec<Station> = names.iter().enumerate().map(station).collect();
        let placements = if is_per_station { names } else { &names[..1] };
        let targets: Vec<[f64; 3]> = placements.iter().flat_map(|name| map.targets_at(name)).collect();
        let mountings: Vec<Pose> = placements.iter().map(|name| map.mounting_at(name)).collect();
        for model in self.models() {
            model.stations.clone_from(&stations);
            model.targets.clone_from(&targets);
            model.mountings.clone_from(&mountings);
        }
        let is_open = |name: &String| is_per_station && map.placement.at(name).is_none();
        let are_open = |name: &String| {
            let unknown = map.unknown_targets_at(name).into_iter();
            unknown.map(|unknown| !self.pose && (unknown || is_open(name))).collect::<Vec<_>>()
        };
        self.open = OpenPlaces {
            stations: names
                .iter()
                .map(|name| map.base == Base::Unknown && map.stations.pose(name).is_none())
                .collect(),
            targets: placements.iter().flat_map(are_open).collect(),
            mountings: placements.iter().map(|name| is_open(name) && self.pose).collect(),
        };
    }

    /// Returns whether a place on the tool is neither in the map nor in a drawing.
    pub(crate) fn is_tool_open(&self) -> bool {
        self.open.targets.contains(&true) || self.open.mountings.contains(&true)
    }

    /// Returns whether the pose of a station is not in the map.
    pub(crate) fn is_station_open(&self) -> bool {
        self.open.stations.contains(&true)
    }

    /// Returns the three models.
    pub(super) fn models(&mut self) -> [&mut Model<'a>; 3] {
        [&mut self.ideal, &mut self.real, &mut self.delivered]
    }

    pub(super) fn set_stations(&mut self, stations: &[Station]) {
        self.models().into_iter().for_each(|model| model.stations = stations.to_vec());
    }

    /// Returns whether the residuals are larger than errors of a machine.
    fn is_far(&self, model: &Model, rows: &[Observation]) -> Result<bool, Failure> {
        Ok(model.figures(rows, &[])?.rms > FAR * self.arm)
    }

    /// Registers the places that are open, if any on the tool is, and is unknown or far from the
    /// data.
    fn place_tool(&mut self, map: &Map, data: &Data) -> Result<(), Failure> {
        let mut stations = self.real.stations.iter();
        let is_unknown = stations.any(|station| map.unknown_targets_at(&station.name).contains(&true));
        if !self.is_tool_open() || (!is_unknown && !self.is_far(&self.real, &data.observations)?) {
            return Ok(());
        }
        let mut near = self.real.clone();
        let is_near = |near: &Model| Ok(!self.is_far(near, &data.observations)?);
        register_in_turn(&mut near, &data.observations, self.arm, &self.open, is_near)?;
        self.models().into_iter().for_each(|model| take_places(model, &near));
        Ok(())
    }

    /// Improves a placement that is far from the data, in closed form.
    ///
    /// The station poses and the placement on the tool are registered in turn: each is the rigid
    /// motion that explains the data best given the other.
    pub(crate) fn come_near(&mut self, data: &Data) -> Result<(), Failure> {
        if !self.is_far(&self.real, &data.observations)? {
            return Ok(());
        }
        let rows = &*self.real.as_poses(&data.observations);
        let mut near = self.real.clone();
        if near.camera.is_some()
            && !self.placement
            && !near.stations[0].exact
            && let Some([base, mounting]) = near.hand_eye(rows, 0)?
        {
            (near.stations[0].pose, near.mountings[0]) = (base, mounting);
        }
        let open = OpenPlaces {
            stations: near.stations.iter().map(|station| !station.exact).collect(),
            targets: vec![!self.placement; near.targets.len()],
            mountings: vec![!self.placement; near.mountings.len()],
        };
        let is_near = |near: &Model| Ok(!self.is_far(near, &data.observations)?);
        register_in_turn(&mut near, rows, self.arm, &open, is_near)?;
        for model in [&mut self.ideal, &mut self.real] {
            take_places(model, &near);
        }
        Ok(())
    }

    /// Returns the measured points in the frame of the tool, as the map states them: targets, or
    /// the origin of the measured frame.
    pub(crate) fn delivered_points(&self) -> Vec<[f64; 3]> {
        let Model { mountings, targets, .. } = &self.delivered;
        match self.pose {
            true => mountings.iter().map(Pose::position).collect(),
            false => self.delivered.mounted(targets),
        }
    }

    /// Returns the unknowns of base and tool.
    pub(crate) fn base_and_tool(&self) -> Vec<Unknown> {
        self.without_exact(self.ideal.base_and_tool(self.pose))
    }

    /// Returns the unknowns of base and tool, and of frames unless only places are fitted.
    pub(crate) fn unknowns(&self, only_placement: bool) -> Vec<Unknown> {
        let Self { ideal, pose, .. } = self;
        self.without_exact(if only_placement { ideal.base_and_tool(*pose) } else { ideal.constants(*pose) })
    }

    fn without_exact(&self, mut unknowns: Vec<Unknown>) -> Vec<Unknown> {
        unknowns.retain(|unknown| !(self.placement && unknown.is_tool()));
        unknowns
    }

    /// Returns the indices of the variables that move in the data.
    pub(crate) fn moved(&self, data: &[Observation]) -> Vec<usize> {
        let unit = |i: usize| self.description.variables[i].kind.either(1.0, self.arm);
        let ranges = ranges(data).into_iter().enumerate();
        ranges.filter(|(i, [least, largest])| largest - least > 1e-4 * unit(*i)).map(|(i, _)| i).collect()
    }
}

/// Returns the range of each joint variable; empty without rows.
fn ranges(rows: &[Observation]) -> Vec<[f64; 2]> {
    let values = |i: usize| rows.iter().map(move |row| row.q[i]);
    (0..rows.first().map_or(0, |row| row.q.len())).map(|i| range_of(values(i))).collect()
}

/// Residual, as a share of the arm length, above which an initial placement is far.
const FAR: f64 = 0.01;

/// Takes the stations and the placements on the tool of another model.
fn take_places(model: &mut Model, other: &Model) {
    model.stations.clone_from(&other.stations);
    model.targets.clone_from(&other.targets);
    model.mountings.clone_from(&other.mountings);
}

/// Returns the ideal chain with the fixtures and readings of a map.
fn ideal_model<'a>(manipulator: &'a dyn Manipulator, map: &Map) -> Model<'a> {
    let ideal = Model::ideal(manipulator, map.targets(), map.uncertainty);
    match map.instruments() {
        Some(all) => Model {
            fixtures: all.fixtures.clone(),
            known_distances: all.known_distances.clone(),
            observables: all.observables.clone(),
            camera: all.camera,
            ..ideal
        },
        None => ideal,
    }
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
         \"unknown\"` (in `abbe measure` by `{STATION_NEW}`)"
    );
    mistake::with_help(&data.file, message, help)
}

/// Returns the error that a map does not state where its camera and its board are.
fn unplaced(map: &Map) -> Diagnostics {
    let message = "this map does not state where the camera and the board are";
    let help = format!(
        "add `[[station]]` and `[placement]`, or take the map that `{IDENTIFY_OUT}` writes from \
        about ten first views"
    );
    mistake::with_help(map.path(), message, help)
}

fn collinear(data: &Data, name: &str) -> Diagnostics {
    let at = if name.is_empty() { String::new() } else { format!(" (station `{name}`)") };
    let message = format!("to locate the instrument, three points that are not collinear are needed{at}");
    let help = "measure more points, or set `base = \"known\"` in the map if it measures in F_0";
    mistake::with_help(&data.file, message, help)
}
