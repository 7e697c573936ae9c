//! Measurements of a machine whose errors are known.

use abbe::Manipulator;
use abbe::analysis::{Workspace, random_joint_samples};
use abbe::identify::{Chance, Failure, Observation, Uncertainty, simulate};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::spec::Input;
use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::data::{Channel, Data, Map, Table};
use crate::identify::{Setup, aimed, unaimed};
use crate::number::quantity;
use crate::workspace::has_range;
use crate::{Machine, Notes, finite, mistake};

/// How many configurations are tried for one at which instruments can be read.
const TRIES: usize = 20;

/// What would an instrument measure of this machine?
pub struct Simulate {
    /// The machine: its repeatable sources are its errors.
    pub machine: Machine,
    /// What is measured.
    pub map: Map,
    /// Where.
    pub at: Places,
    /// One standard deviation of a coordinate, in the length unit; that of the map if there is none.
    pub noise: Option<f64>,
    /// Which share of the rows is grossly wrong.
    pub outliers: f64,
    /// Whether the random sources of the spec are drawn too, anew in every row.
    pub random: bool,
    /// Where the random numbers begin.
    pub seed: u64,
}

/// Where is measured.
#[derive(Clone, Debug)]
pub enum Places {
    /// At the commands of a file.
    Rows(Data),
    /// At so many random configurations within the limits, with inputs within their ranges; what the map holds fixed
    /// stays so.
    Samples(usize),
}

/// Simulated measurements.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// In the columns and units of the map.
    pub table: Table,
    /// The same as values.
    #[serde(skip)]
    pub observations: Vec<Observation>,
}

impl Simulate {
    /// Measures row by row.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, map, .. } = self;
        let interpreter = Interpreter::new(machine.spec.clone());
        let description = interpreter.description();
        let setup = match &self.at {
            Places::Rows(data) => Setup::at_stations_of(&interpreter, map, data)?,
            Places::Samples(_) => Setup::at_home(&interpreter, map)?,
        };
        let sampled;
        let list = match &self.at {
            Places::Rows(data) => data,
            Places::Samples(count) => {
                self.note_fixed_inputs(notes);
                sampled = self.sampled(&interpreter, &setup, *count)?;
                &sampled
            }
        };
        let list = &list.completed(map, &interpreter, &machine.spec);
        let Uncertainty { length, angle } = map.uncertainty;
        let noise = self.noise.unwrap_or(length);
        let chance = Chance {
            noise: Uncertainty { length: noise, angle: angle * noise / length },
            outliers: self.outliers,
            gross: 0.05 * setup.arm,
            random_sources: self.random,
            seed: self.seed,
        };
        let fail = |failure: Failure| match failure {
            Failure::Observation { line, error } => {
                mistake::not_evaluated(&list.file, &list.place(line), &error, description)
            }
            failure => mistake::whole(&list.file, &failure),
        };
        if let Some(all) = map.instruments()
            && all.count_from_before()
            && all.list.iter().any(|instrument| instrument.kind.is_touched())
        {
            let message =
                "displacements from row to row cannot be simulated beside instruments that are touched";
            let help = "simulate them in a map of their own";
            return Err(mistake::with_help(map.path(), message, help));
        }
        let asked = map.in_sequence(list.observations.clone());
        let observations = simulate(&setup.real, &asked, &chance).map_err(fail)?;
        let mut room = setup.ideal.room();
        let row = |observation: &Observation| {
            let ideal = setup.ideal.pose(&mut room, observation, &[])?.position();
            Ok(map.numbers(observation, ideal, true))
        };
        let rows: Result<Vec<_>, Failure> = observations.iter().map(row).collect();
        let names = if list.stations.is_empty() { map.station_names() } else { list.stations.clone() };
        let labels = map.labels(&observations, &names);
        let table = Table { heading: map.heading(true), rows: rows.map_err(fail)?, labels };
        finite(&list.file, Report { table, observations })
    }

    /// Says which inputs could be drawn within their ranges if the map had a column for them.
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

    /// Where instruments must be aimed, as many as that leads to.
    fn sampled(
        &self,
        manipulator: &dyn Manipulator,
        setup: &Setup,
        count: usize,
    ) -> Result<Data, Diagnostics> {
        let moved: Vec<usize> = self.map.moved().collect();
        let inputs = self.map.moved_inputs(&self.machine);
        let tries = if self.map.instruments().is_some() { TRIES * count } else { count };
        let samples = random_joint_samples(manipulator, &moved, tries, self.seed)
            .and_then(|samples| samples.inputs(manipulator, &inputs));
        let samples = samples.map_err(|error| mistake::whole(&self.machine.origin, &error))?.reached();
        let stations = self.map.station_names();
        let rows = (1..).zip(samples).enumerate().map(|(i, (line, sample))| {
            let station = i % stations.len();
            Observation { station, ..self.map.planned(line, sample) }
        });
        let observations = aimed(setup, &self.map, rows.collect(), count)
            .map_err(|failure| mistake::whole(&self.machine.origin, &failure))?;
        if observations.is_empty() {
            return Err(unaimed(self.map.path()));
        }
        let file = "--samples".to_owned();
        Ok(Data { file, observations, stations: stations.clone(), ..Data::default() })
    }
}
