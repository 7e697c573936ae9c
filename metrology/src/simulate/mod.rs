//! The job `simulate`: measurements of a machine with known errors.

pub mod options;

use abbe_spec::{Diagnostics, Input, option::SAMPLES};
use std::borrow::Cow;

use abbe::Manipulator;
use abbe::analysis::{JointSamples, Workspace, random_joint_samples};
use abbe::identify::{Chance, Failure, Measurement, Observation, Simulated, Uncertainty};
use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::data::{Channel, Data, Heading, Instruments, Map, Table};
use crate::identify::{Setup, nothing_readable, readable_configurations};
use abbe_study::{About, Machine, Notes, Result, finite, mistake, number::quantity, workspace::has_range};

/// Number of random configurations tried for each one at which instruments can be read.
const TRIES: usize = 20;

/// Number of random configurations that are tried for each view of a camera: few see the board.
const TRIES_OF_VIEW: usize = 100;

/// Options of `simulate`.
pub struct Simulate {
    /// The machine; its repeatable sources are its errors.
    pub machine: Machine,
    /// Map of the measurements.
    pub map: Map,
    /// Configurations.
    pub at: Places,
    /// Standard deviation of a coordinate, in the length unit; that of the map if none.
    pub noise: Option<f64>,
    /// Share of rows that are outliers.
    pub outliers: f64,
    /// Draw the random sources of the spec anew in each row.
    pub random: bool,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Configurations of a simulation.
#[derive(Clone, Debug)]
pub enum Places {
    /// Commands of a file.
    Rows(Data),
    /// Number of random configurations within the limits of joints and ranges of inputs; constants
    /// of the map stay fixed.
    Samples(usize),
}

/// Simulated measurements.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Measurements in the columns and units of the map.
    pub table: Table,
    /// Measurements as values.
    #[serde(skip)]
    pub observations: Vec<Observation>,
}

/// A simulated row.
pub struct Row<'r> {
    /// Command and measurement.
    pub observation: Observation,
    /// Name of its station, if there is a column of stations.
    pub label: Option<&'r str>,
    /// Numbers in the columns and units of the map.
    pub numbers: Vec<Option<f64>>,
}

/// Number of rows between reports of progress.
const PROGRESS_STEP: usize = 1000;

impl Simulate {
    /// Simulates all rows.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let Heading { names: heading, .. } = self.heading();
        let mut table = Table { heading, ..Table::default() };
        let mut observations = Vec::new();
        self.each(notes, |row| {
            observations.push(row.observation);
            table.labels.extend(row.label.map(str::to_owned));
            table.rows.push(row.numbers);
            Ok::<_, Diagnostics>(())
        })?;
        Ok(Report { table, observations })
    }

    /// Returns the heading of the table.
    pub fn heading(&self) -> Heading {
        let labels = if self.map.stations.column.is_some() { self.stations() } else { Vec::new() };
        Heading { names: self.map.heading(true), labels }
    }

    /// Returns the names of the stations.
    fn stations(&self) -> Vec<String> {
        match &self.at {
            Places::Rows(data) if !data.stations.is_empty() => data.stations.clone(),
            _ => self.map.station_names(),
        }
    }

    /// Simulates row by row and passes each to `take`, with memory independent of their number;
    /// returns that number.
    pub fn each<E: From<Diagnostics>>(
        &self,
        notes: &mut dyn Notes,
        mut take: impl FnMut(Row) -> Result<(), E>,
    ) -> Result<usize, E> {
        let Self { machine, map, .. } = self;
        map.require_joints("a simulation")?;
        if self.noise.is_none() {
            map.require_uncertainty("a simulation without stated noise")?;
        }
        let interpreter = Interpreter::new(machine.spec.clone());
        let description = interpreter.description();
        let (setup, file) = match &self.at {
            Places::Rows(data) => (Setup::at_stations_of(&interpreter, map, data)?, data.file.clone()),
            Places::Samples(_) => {
                let setup = Setup::at_home(&interpreter, map)?;
                self.note_fixed_inputs(notes);
                (setup, SAMPLES.to_string())
            }
        };
        let planned = self.planned(&interpreter, &setup)?;
        let Uncertainty { length, angle } = map.uncertainty;
        let noise = self.noise.unwrap_or(length);
        let chance = Chance {
            noise: Uncertainty { length: noise, angle: angle * noise / length },
            outliers: self.outliers,
            outlier_size: 0.05 * setup.arm,
            random_sources: self.random,
            one_machine: true,
            seed: self.seed,
        };
        let place = |line: u64| match &self.at {
            Places::Rows(data) => data.place(line),
            Places::Samples(_) => format!("row {line}"),
        };
        let fail = |failure: Failure| match failure {
            Failure::Observation { line, error } => {
                mistake::not_evaluated(&file, &place(line), &error, description)
            }
            failure => mistake::whole(&file, &failure),
        };
        if let Some(all) = map.instruments()
            && all.depend_on_previous_row()
            && all.list.iter().any(|instrument| instrument.kind.is_touched())
        {
            let message = "readings relative to the row before cannot be simulated together with contact \
                 instruments";
            return Err(mistake::with_help(map.path(), message, "simulate them with separate maps").into());
        }
        let stations = self.stations();
        let listed = match &planned {
            Planned::Listed(rows) => rows,
            Planned::Sampled { .. } => &[][..],
        };
        let mut simulated = Simulated::new(&setup.real, listed, &chance);
        let mut at = setup.ideal.at(&[]);
        for i in 0..planned.len() {
            if i.is_multiple_of(PROGRESS_STEP) {
                notes.progress(i, planned.len());
                notes.go_on()?;
            }
            let observation = simulated.row(i, &planned.row(i, map)).map_err(fail)?;
            let numbers = map.numbers(&observation, at.pose(&observation).map_err(fail)?.position(), true);
            let numbers = finite(format!("{file}: {}", place(observation.line)), numbers)?;
            let label = map.stations.column.is_some();
            let label = label.then(|| stations.get(observation.station as usize).map_or("", |name| name));
            take(Row { observation, label, numbers })?;
        }
        notes.progress(planned.len(), planned.len());
        Ok(planned.len())
    }

    /// Returns the configurations; random ones are generated on demand where each becomes a row.
    fn planned<'s>(&'s self, interpreter: &Interpreter, setup: &Setup) -> Result<Planned<'s>> {
        let Self { machine, map, .. } = self;
        let list = match &self.at {
            Places::Rows(data) => Cow::Borrowed(data),
            Places::Samples(count) => {
                let has_loops = interpreter.description().has_loops();
                if map.instruments().is_none()
                    && map.sight.is_none()
                    && !map.follows_from_rows()
                    && !has_loops
                {
                    let (samples, stations) = (self.samples(interpreter, *count)?, map.station_names().len());
                    return Ok(Planned::Sampled { samples, stations });
                }
                Cow::Owned(self.sampled(setup, *count)?)
            }
        };
        let rows = match list {
            Cow::Borrowed(data) => match data.completed(map, interpreter, &machine.spec) {
                Cow::Borrowed(data) => Cow::Borrowed(&data.observations[..]),
                Cow::Owned(data) => Cow::Owned(data.observations),
            },
            Cow::Owned(data) => {
                Cow::Owned(data.completed(map, interpreter, &machine.spec).into_owned().observations)
            }
        };
        Ok(Planned::Listed(match map.instruments().is_some_and(Instruments::depend_on_previous_row) {
            true => Cow::Owned(map.in_sequence(rows.into_owned())),
            false => rows,
        }))
    }

    fn samples(&self, manipulator: &dyn Manipulator, count: usize) -> Result<JointSamples> {
        let moved: Vec<usize> = self.map.moved().collect();
        let inputs = self.map.moved_inputs(&self.machine);
        random_joint_samples(manipulator, &moved, count, self.seed)
            .and_then(|samples| samples.inputs(manipulator, &inputs))
            .about(&self.machine.origin)
    }

    /// Notes the inputs that would be drawn within their ranges if the map had a column for them.
    fn note_fixed_inputs(&self, notes: &mut dyn Notes) {
        let Self { machine, map, .. } = self;
        let drawn = map.moved_inputs(machine);
        for (i, input) in machine.spec.inputs.iter().enumerate() {
            if has_range(input) && !drawn.contains(&i) && !machine.fixed_inputs().contains(&i) {
                let Input { name, unit, .. } = input;
                let value = match map.inputs[i] {
                    Channel::Fixed(value) => value,
                    Channel::Column(..) => input.value,
                    Channel::FromRows(_) => continue,
                };
                notes.note(&format!(
                    "`{name}` stays at {}: the map has no column for it; with `{name} = {{ column = \"{name}\", unit = \"{unit}\" }}` \
                     under [inputs] it is drawn within its range",
                    quantity(value, unit),
                ));
            }
        }
    }

    /// Finds configurations at which the instruments can be read, up to `count`.
    fn sampled(&self, setup: &Setup, count: usize) -> Result<Data> {
        let manipulator = setup.ideal.manipulator;
        let tries = match self.map.instruments() {
            Some(all) if all.camera.is_some() => TRIES_OF_VIEW * count,
            None if self.map.sight.is_some() => TRIES_OF_VIEW * count,
            None if manipulator.description().is_chain() => count,
            _ => TRIES * count,
        };
        let stations = self.map.station_names();
        let tried = Planned::Sampled { samples: self.samples(manipulator, tries)?, stations: stations.len() };
        let is_camera = self.map.instruments().is_some_and(|all| all.camera.is_some());
        let rows = (0..tried.len()).map(|i| {
            let row = tried.row(i, &self.map).into_owned();
            // A view has two readings of each corner, and few samples become views.
            if is_camera { Observation { measured: Measurement::Readings(Vec::new()), ..row } } else { row }
        });
        let observations =
            readable_configurations(setup, &self.map, rows.collect(), count).about(&self.machine.origin)?;
        if observations.is_empty() {
            return Err(nothing_readable(&self.map));
        }
        let file = SAMPLES.to_string();
        Ok(Data { file, observations, stations: stations.clone(), ..Data::default() })
    }
}

/// Configurations to be measured.
enum Planned<'a> {
    Listed(Cow<'a, [Observation]>),
    /// Random samples, distributed over the stations.
    Sampled {
        samples: JointSamples,
        stations: usize,
    },
}

impl Planned<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Listed(rows) => rows.len(),
            Self::Sampled { samples, .. } => samples.len(),
        }
    }

    fn row(&self, i: usize, map: &Map) -> Cow<'_, Observation> {
        match self {
            Self::Listed(rows) => Cow::Borrowed(&rows[i]),
            Self::Sampled { samples, stations } => {
                let mut place = samples.home().clone();
                // Samples of joints always exist.
                let _ = samples.fill(i, &mut place);
                let station = (i % stations) as u32;
                Cow::Owned(Observation { station, ..map.planned(i as u64 + 1, place) })
            }
        }
    }
}
