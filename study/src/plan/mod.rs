//! Where to measure, and how well the errors of the machine will then be known where it is used.

mod keys;
pub mod options;
mod report;
mod sets;

use abbe::analysis::{Configuration, Workspace, joint_samples, random_joint_samples};
use abbe::identify::{
    Criterion, Design, Failure, Figures, Identifiable, Measurement, Model, Objective, Observation, knowable,
    optimal, whole,
};
use abbe::{Description, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;

use crate::data::{Instruments, Map};
use crate::identify::{
    Counts, Prior, Setup, WeaklyDetermined, indistinguishable, nothing_readable, readable_configurations,
    scale_note,
};
use crate::workspace::has_range;
use crate::{Machine, Notes, Study, finite, mistake};

pub use keys::TABLES;
pub use report::{Input, Predicted, Report, Unseen};
pub use sets::{Counted, Sets};

/// The most configurations of the workspace of use that are looked at.
const USED: usize = 1000;

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
    /// What the identified model will leave of the tool point by itself, as the root mean square of its distance in the length
    /// unit: what an earlier fit has left beside the instrument's noise. Independent from configuration to configuration.
    pub model_error: f64,
    /// The seed of the samples that are chosen from, which are spread evenly without one, and of the study's random samples.
    pub seed: Option<u64>,
}

/// How configurations are chosen.
#[derive(Clone, Debug)]
pub enum Choice {
    /// Those of a plan file.
    Sets(Sets),
    /// The configurations that tell most.
    Optimal {
        /// What is made small or large.
        criterion: Criterion,
        /// How many.
        count: usize,
        /// From how many samples within the limits.
        candidates: usize,
    },
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
        let fail = |failure: Failure| mistake::whole(&machine.origin, &failure);
        let used = self.used(&interpreter, description)?;
        let tool_points = model.tool_points(&used).map_err(fail)?;
        // The same along each axis.
        let model_error = self.model_error / 3.0_f64.sqrt();
        let objective = Objective { criterion: Criterion::Variance, used: &tool_points, model_error };
        let Chosen { title, sets, rows, identifiable, design } =
            self.choose(&interpreter, &setup, &model, objective, notes)?;
        let numbers = rows.iter().map(Observation::count).sum::<usize>();
        let Some(design) = design.filter(|_| numbers > identifiable.rank) else {
            let rank = identifiable.rank;
            let message = format!("so few configurations cannot determine {rank} combinations of errors");
            return Err(mistake::with_help(&machine.origin, message, "plan more of them"));
        };
        let own = self.model_error;
        // What these rows tell, as an identification will judge it: sets were not chosen from anything else.
        let (observed, told) = match &self.choice {
            Choice::Sets(_) => (identifiable.clone(), Some(design.clone())),
            Choice::Optimal { .. } => {
                let observed = determined(&model, &rows).map_err(fail)?;
                let told = whole(&model, &rows, &observed, &objective, &mut |_, _| {}).map_err(fail)?;
                (observed, told)
            }
        };
        let (judged, covariance) = match &told {
            Some(told) => (&observed, &told.covariance),
            None => (&identifiable, &design.covariance),
        };
        let spread = tool_points.deviations(judged, covariance);
        let spread = Figures::from_norms(spread.into_iter().map(|deviation| deviation.hypot(own)).collect());
        let sizes = model.priors(Prior::DEFAULT_SHARE).map_err(fail)?;
        let unseen = tool_points.unseen(judged, |k| sizes[k].unwrap_or(1.0));
        // A millionth of what the instrument can tell is rounding.
        let matters =
            |(k, moves): &(usize, f64)| moves * sizes[*k].unwrap_or(1.0) > 1e-6 * map.uncertainty.length;
        let unseen =
            unseen.into_iter().filter(matters).map(|(k, moves)| Unseen::new(&model, k, moves)).collect();
        let moved = setup.moved(&rows);
        if let Some(note) = scale_note(&setup.ideal, &rows, &moved).map_err(fail)? {
            notes.note(&note);
        }
        let alike =
            rows.first().map_or(Ok(Vec::new()), |row| indistinguishable(&model, &row.q, &moved, setup.pose));
        let alike = alike.map_err(|error| mistake::whole(&machine.origin, &error))?;
        let report = Report {
            name: machine.spec.name.clone(),
            length: machine.spec.length.symbol(),
            title,
            rows: rows.len(),
            sets,
            inputs: self.inputs(&rows),
            rank: observed.rank,
            unknowns: model.unknowns.len(),
            machine: Counts::new(&model, &observed),
            not_known: WeaklyDetermined::all(&model, &observed, machine.spec.length),
            condition: observed.observability.condition,
            log_det: design.log_det,
            exchanges: design.exchanges,
            model_error: self.model_error,
            unseen,
            used: used.len(),
            predicted: Predicted { mean: spread.mean, rms: spread.rms, max: spread.max, p95: spread.p95 },
            groups: alike,
            observations: rows,
        };
        finite(&machine.origin, report)
    }

    fn aimed(&self, setup: &Setup, list: Vec<Observation>) -> Result<Vec<Observation>, Diagnostics> {
        let most = list.len();
        let aimed = readable_configurations(setup, &self.map, list, most);
        let aimed = aimed.map_err(|failure| mistake::whole(&self.machine.origin, &failure))?;
        if aimed.is_empty() { Err(nothing_readable(self.map.path())) } else { Ok(aimed) }
    }

    fn choose(
        &self,
        manipulator: &Interpreter,
        setup: &Setup,
        model: &Model,
        objective: Objective<'_>,
        notes: &mut dyn Notes,
    ) -> Result<Chosen, Diagnostics> {
        let description = manipulator.description();
        let fail = |failure: Failure| mistake::whole(&self.machine.origin, &failure);
        match &self.choice {
            Choice::Sets(sets) => {
                let (asked, counts) = sets.rows(manipulator, description, notes)?;
                let rows = (1..).zip(asked).map(|(line, asked): (u64, Configuration)| {
                    let u = asked.u.clone();
                    Observation { u: u.into(), ..self.map.planned(line, asked) }
                });
                let rows = self.map.in_sequence(self.aimed(setup, rows.collect())?);
                let rows = seen_nominally(model, rows.into_iter()).map_err(fail)?;
                let identifiable = determined(model, &rows).map_err(fail)?;
                let progress = &mut |done, total| notes.progress(done, total);
                let design = whole(model, &rows, &identifiable, &objective, progress).map_err(fail)?;
                Ok(Chosen { title: sets.title.clone(), sets: counts, rows, identifiable, design })
            }
            Choice::Optimal { criterion, count, candidates } => {
                if self.map.instruments().is_some_and(Instruments::count_from_before) {
                    let message = "what is read as a displacement depends on the row before: single configurations cannot be chosen";
                    let help = "plan rows in an order of your own with `--sets`";
                    return Err(mistake::with_help(self.map.path(), message, help));
                }
                let moved: Vec<usize> = self.map.moved().collect();
                let inputs = self.map.moved_inputs(&self.machine);
                let samples = match self.seed {
                    Some(seed) => random_joint_samples(manipulator, &moved, *candidates, seed),
                    None => joint_samples(manipulator, &moved, *candidates),
                };
                let samples = samples.and_then(|samples| samples.inputs(manipulator, &inputs));
                let samples =
                    samples.map_err(|error| mistake::whole(&self.machine.origin, &error))?.reached();
                let list = (1..).zip(samples).map(|(line, sample)| self.map.planned(line, sample));
                let list = self.aimed(setup, list.collect())?;
                if *count > list.len() {
                    let message =
                        format!("{count} configurations cannot be chosen from {} samples", list.len());
                    let help = "each is chosen once at most: ask for more `--candidates`, or for fewer configurations";
                    return Err(mistake::with_help(&self.machine.origin, message, help));
                }
                let list = seen_nominally(model, list.into_iter()).map_err(fail)?;
                let identifiable = determined(model, &list).map_err(fail)?;
                let objective = Objective { criterion: *criterion, ..objective };
                let progress = &mut |done, total| notes.progress(done, total);
                let design =
                    optimal(model, &list, &identifiable, *count, &objective, progress).map_err(fail)?;
                let chosen = design.iter().flat_map(|design| &design.chosen);
                let rows = chosen.map(|i| list[*i].clone()).collect();
                let name = match criterion {
                    Criterion::Variance => "V-optimal",
                    Criterion::Determinant => "D-optimal",
                };
                let title = format!("{name}: {count} of {} samples", list.len());
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
        let fail = |error: abbe::Error| mistake::whole(&self.machine.origin, &error);
        let mut region = self.study.region.clone();
        region.fix(self.machine.fixed_inputs());
        let workspace = region.workspace(manipulator, self.seed).map_err(fail)?;
        let step = workspace.len().div_ceil(USED).max(1);
        let places = (0..workspace.len()).step_by(step).filter_map(|i| workspace.configuration(i).ok());
        let mut places: Vec<_> = places.collect();
        if places.is_empty() {
            let every: Vec<usize> = (0..description.variables.len()).collect();
            places = joint_samples(manipulator, &every, 100).map_err(fail)?.reached();
        }
        let nothing = || Measurement::Points(Vec::new().into());
        let rows = (1..).zip(places).map(|(line, place)| Observation::new(line, place.q, place.u, nothing()));
        Ok(rows.collect())
    }
}

fn determined(model: &Model, rows: &[Observation]) -> Result<Identifiable, Failure> {
    let expected = model.expected(&model.priors(Prior::DEFAULT_SHARE)?)?;
    knowable(model, rows, &vec![0.0; model.unknowns.len()], &expected, 1.0)
}

/// As the nominal machine would be seen.
fn seen_nominally(
    model: &Model,
    rows: impl Iterator<Item = Observation>,
) -> Result<Vec<Observation>, Failure> {
    let mut room = model.room();
    rows.map(|row| model.nominally_seen(&mut room, &row)).collect()
}
