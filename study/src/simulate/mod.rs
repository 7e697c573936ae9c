//! Measurements of a machine whose errors are known.

use abbe::analysis::{Workspace, random_joint_samples};
use abbe::identify::{Chance, Failure, Observation, Uncertainty, simulate};
use abbe::{Description, Manipulator};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::data::{Data, Map, Table};
use crate::identify::Setup;
use crate::{Machine, Notes, mistake};

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
    /// At so many random configurations within the limits; what the map holds fixed stays so.
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
    pub fn run(&self, _notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, map, .. } = self;
        let interpreter = Interpreter::new(machine.spec.clone());
        let description = interpreter.description();
        let sampled;
        let list = match &self.at {
            Places::Rows(data) => data,
            Places::Samples(count) => {
                sampled = self.sampled(&interpreter, description, *count)?;
                &sampled
            }
        };
        let setup = Setup::at_home(&interpreter, map)?;
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
                mistake::not_evaluated(&list.file, &format!("line {line}"), &error, description)
            }
            failure => mistake::whole(&list.file, failure),
        };
        let observations = simulate(&setup.real, &list.observations, &chance).map_err(fail)?;
        let mut room = setup.ideal.room();
        let row = |observation: &Observation| {
            let ideal = setup.ideal.pose(&mut room, observation, &[])?.position();
            Ok(map.numbers(observation, ideal, true))
        };
        let rows: Result<Vec<_>, Failure> = observations.iter().map(row).collect();
        let table = Table { heading: map.heading(true), rows: rows.map_err(fail)? };
        Ok(Report { table, observations })
    }

    fn sampled(
        &self,
        manipulator: &dyn Manipulator,
        description: &Description,
        count: usize,
    ) -> Result<Data, Diagnostics> {
        let moved: Vec<usize> = self.map.moved().collect();
        let samples = random_joint_samples(manipulator, &moved, count, self.seed);
        let samples = samples.map_err(|error| mistake::whole(&self.machine.origin, error))?.reached();
        let rows = (1..).zip(samples).map(|(line, sample)| self.map.planned(line, sample.q, description));
        Ok(Data { file: "--samples".to_owned(), observations: rows.collect(), ..Data::default() })
    }
}
