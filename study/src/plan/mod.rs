//! Where to measure, and how well the errors of the machine will then be known where it is used.

mod keys;
mod sets;

use abbe::analysis::{Configuration, Workspace, joint_samples};
use abbe::identify::{
    Design, Failure, Figures, Identifiable, Measurement, Model, Observation, Unknown, d_optimal, groups,
    knowable, predicted, whole,
};
use abbe::{Description, Manipulator};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::data::{Map, Table};
use crate::identify::{Alike, Counts, NotKnown, Setup};
use crate::workspace::has_range;
use crate::{Machine, Notes, Study, mistake, number};

pub use keys::TABLES;
pub use sets::{Counted, Sets};

/// The most configurations of the workspace of use that are looked at.
const USED: usize = 1000;

/// How large errors are expected to be, as a share of the arm's length and in rad: what an identification expects that is
/// told nothing else.
const EXPECTED: f64 = 0.01;

/// Where should this machine be measured?
pub struct Plan {
    /// The nominal machine.
    pub machine: Machine,
    /// What will be measured, and how well.
    pub map: Map,
    /// How the configurations are chosen.
    pub choice: Choice,
    /// Where the machine is to be used: the workspace of this study.
    pub study: Study,
}

/// How configurations are chosen.
#[derive(Clone, Debug)]
pub enum Choice {
    /// Those of a plan file.
    Sets(Sets),
    /// The configurations that tell most, D-optimal.
    Optimal {
        /// How many.
        count: usize,
        /// From how many samples within the limits.
        candidates: usize,
    },
}

/// What is to be measured, and what it will tell.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The length unit of everything.
    pub length: &'static str,
    /// What the plan is called.
    pub title: String,
    /// How many rows are to be measured.
    pub rows: usize,
    /// Set by set.
    pub sets: Vec<Counted>,
    /// Where the inputs are that have a range.
    pub inputs: Vec<Input>,
    /// How many combinations of the unknowns they determine.
    pub rank: usize,
    /// Of how many unknowns.
    pub unknowns: usize,
    /// Of base and frames alone, without the targets on the tool.
    pub machine: Counts,
    /// Errors of which these rows will tell less than is known before.
    pub not_known: Vec<NotKnown>,
    /// The condition number.
    pub condition: f64,
    /// `ln det` of the information of columns of unit length.
    pub log_det: f64,
    /// How many exchanges led to a D-optimal plan.
    pub exchanges: usize,
    /// How many configurations of use were looked at.
    pub used: usize,
    /// Standard deviation of the identified tool point there, the length unit.
    pub predicted: Predicted,
    /// What cannot be told apart, and why.
    #[serde(skip)]
    pub groups: Vec<Alike>,
    /// What is to be measured.
    #[serde(skip)]
    pub observations: Vec<Observation>,
}

/// Where an input that has a range is in the rows of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: String,
    /// Its least and its largest value: the same of one that stays where it is.
    pub between: [f64; 2],
}

impl Input {
    /// `payload goes from 0 kg to 5 kg`, or `payload stays at 0 kg`.
    pub fn sentence(&self) -> String {
        let [least, largest] = self.between.map(|value| number::quantity(value, &self.unit));
        match self.between[0] == self.between[1] {
            true => format!("{} stays at {least}", self.name),
            false => format!("{} goes from {least} to {largest}", self.name),
        }
    }
}

/// Figures of a standard deviation.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Predicted {
    /// The mean.
    pub mean: f64,
    /// The root mean square.
    pub rms: f64,
    /// The largest.
    pub max: f64,
    /// What 95 % do not exceed.
    pub p95: f64,
}

/// What is to be measured, by title and sets, and what it determines.
struct Chosen {
    title: String,
    sets: Vec<Counted>,
    rows: Vec<Observation>,
    identifiable: Identifiable,
    design: Option<Design>,
}

impl Plan {
    /// Chooses the configurations and predicts what they will tell.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, map, .. } = self;
        let interpreter = Interpreter::new(machine.spec.clone());
        let description = interpreter.description();
        let setup = Setup::at_home(&interpreter, map)?;
        let model = setup.ideal.with(setup.constants());
        let fail = |failure: Failure| mistake::whole(&machine.origin, failure);
        let Chosen { title, sets, rows, identifiable, design } = self.choose(&interpreter, &model, notes)?;
        let Some(design) = design else {
            let rank = identifiable.rank;
            let message = format!("so few configurations cannot determine {rank} combinations of errors");
            return Err(mistake::with_help(&machine.origin, message, "plan more of them"));
        };
        let used = self.used(&interpreter, description)?;
        // What these rows tell, as an identification will judge it.
        let observed = determined(&model, &rows).map_err(fail)?;
        let told = whole(&model, &rows, &observed).map_err(fail)?.unwrap_or(design.clone());
        let spread = Figures::from_norms(at_the_tool(&model, &observed, &told, &used).map_err(fail)?);
        let moved = setup.moved(&rows);
        let alike = rows.first().map_or(Ok(Vec::new()), |row| groups(&model, &row.q, &moved, setup.pose));
        let alike = alike.map_err(|error| mistake::whole(&machine.origin, error))?;
        Ok(Report {
            name: machine.spec.name.clone(),
            length: machine.spec.length.symbol(),
            title,
            rows: rows.len(),
            sets,
            inputs: self.inputs(&rows),
            rank: observed.rank,
            unknowns: model.unknowns.len(),
            machine: Counts::new(&model, &observed),
            not_known: NotKnown::all(&model, &observed, machine.spec.length),
            condition: observed.observability.condition,
            log_det: design.log_det,
            exchanges: design.exchanges,
            used: used.len(),
            predicted: Predicted { mean: spread.mean, rms: spread.rms, max: spread.max, p95: spread.p95 },
            groups: alike.iter().map(|group| Alike::new(group, &model, description)).collect(),
            observations: rows,
        })
    }

    fn choose(
        &self,
        manipulator: &Interpreter,
        model: &Model,
        notes: &mut dyn Notes,
    ) -> Result<Chosen, Diagnostics> {
        let description = manipulator.description();
        let fail = |failure: Failure| mistake::whole(&self.machine.origin, failure);
        match &self.choice {
            Choice::Sets(sets) => {
                let (asked, counts) = sets.rows(manipulator, description, notes)?;
                let rows: Vec<Observation> = (1..)
                    .zip(asked)
                    .map(|(line, asked): (u64, Configuration)| {
                        let u = asked.u.clone();
                        Observation { u, ..self.map.planned(line, asked) }
                    })
                    .collect();
                let identifiable = determined(model, &rows).map_err(fail)?;
                let design = whole(model, &rows, &identifiable).map_err(fail)?;
                Ok(Chosen { title: sets.title.clone(), sets: counts, rows, identifiable, design })
            }
            Choice::Optimal { count, candidates } => {
                let moved: Vec<usize> = self.map.moved().collect();
                let inputs = self.map.moved_inputs(&self.machine);
                let samples = joint_samples(manipulator, &moved, *candidates)
                    .and_then(|samples| samples.inputs(manipulator, &inputs));
                let samples = samples.map_err(|error| mistake::whole(&self.machine.origin, error))?.reached();
                let list: Vec<Observation> =
                    (1..).zip(samples).map(|(line, sample)| self.map.planned(line, sample)).collect();
                let identifiable = determined(model, &list).map_err(fail)?;
                let design = d_optimal(model, &list, &identifiable, *count).map_err(fail)?;
                let chosen = design.iter().flat_map(|design| &design.chosen);
                let rows = chosen.map(|i| list[*i].clone()).collect();
                let title = format!("D-optimal: {count} of {} samples", list.len());
                Ok(Chosen { title, sets: Vec::new(), rows, identifiable, design })
            }
        }
    }

    /// Where the inputs are in these rows.
    fn inputs(&self, rows: &[Observation]) -> Vec<Input> {
        let inputs = self.machine.spec.inputs.iter().enumerate().filter(|(_, input)| has_range(input));
        let inputs = inputs.map(|(i, input)| {
            let values = rows.iter().map(|row| row.u[i]);
            let between = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, largest], value| {
                [least.min(value), largest.max(value)]
            });
            Input { name: input.name.clone(), unit: input.unit.clone(), between }
        });
        inputs.collect()
    }

    /// Where the machine is to be used: nothing is measured there.
    fn used(
        &self,
        manipulator: &dyn Manipulator,
        description: &Description,
    ) -> Result<Vec<Observation>, Diagnostics> {
        let fail = |error: abbe::Error| mistake::whole(&self.machine.origin, error);
        let mut region = self.study.region.clone();
        region.fix(self.machine.fixed_inputs());
        let workspace = region.workspace(manipulator, None).map_err(fail)?;
        let step = workspace.len().div_ceil(USED).max(1);
        let places = (0..workspace.len()).step_by(step).filter_map(|i| workspace.configuration(i).ok());
        let mut places: Vec<_> = places.collect();
        if places.is_empty() {
            let every: Vec<usize> = (0..description.variables.len()).collect();
            places = joint_samples(manipulator, &every, 100).map_err(fail)?.reached();
        }
        let nothing = || Measurement::Points(Vec::new());
        let rows = (1..).zip(places).map(|(line, place)| Observation::new(line, place.q, place.u, nothing()));
        Ok(rows.collect())
    }
}

impl Report {
    /// What is to be measured, in the columns and units of the map.
    pub fn table(&self, map: &Map) -> Table {
        let rows = self.observations.iter().map(|row| map.numbers(row, [0.0; 3], false));
        let labels = map.labels(&self.observations, &map.station_names());
        Table { heading: map.heading(false), rows: rows.collect(), labels }
    }
}

fn determined(model: &Model, rows: &[Observation]) -> Result<Identifiable, Failure> {
    let expected = model.expected(&model.priors(EXPECTED)?)?;
    knowable(model, rows, &vec![0.0; model.unknowns.len()], &expected, 1.0)
}

/// The standard deviation of the tool point: a target of its own, which nothing was measured with.
fn at_the_tool(
    model: &Model,
    identifiable: &Identifiable,
    design: &Design,
    used: &[Observation],
) -> Result<Vec<f64>, Failure> {
    let mut model = model.clone();
    // A single target at zero is the tool point; where it is on the tool has been measured with the rest.
    let single =
        model.targets.len() == 1 && !model.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Tool(_)));
    let place = if single { 0 } else { model.targets.len() };
    if !single {
        model.targets.push([0.0; 3]);
    }
    let mut points = vec![None; model.targets.len()];
    points[place] = Some([0.0; 3]);
    let list: Vec<Observation> = used
        .iter()
        .map(|row| Observation { measured: Measurement::Points(points.clone()), ..row.clone() })
        .collect();
    predicted(&model, identifiable, &design.covariance, &list)
}
