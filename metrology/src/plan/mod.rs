//! Plans a measurement and predicts how well it determines the errors of the machine in its
//! workspace of use.

mod keys;
pub mod options;
mod report;
mod sets;

use abbe::Manipulator;
use abbe::analysis::sampling::{closes, range_of};
use abbe::analysis::{Configuration, Workspace, joint_samples, random_joint_samples};
use abbe::identify::{
    Criterion, Design, Failure, Figures, Identifiable, Measurement, Model, Objective, Observation, Unknown,
    knowable, optimal, whole,
};
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::option::{CANDIDATES, SETS};

use crate::data::{Instruments, Map};
use crate::identify::{
    Counts, Prior, Setup, WeaklyDetermined, extended, indistinguishable, nothing_readable, own_magnitudes,
    readable_configurations, redundant, scale_note,
};
use abbe_study::{About, Machine, Notes, Result, Study, finite, mistake, workspace::has_range};

pub use keys::{rules, tables};
pub use report::{Input, Predicted, Report, UndeterminedError};
pub use sets::{SetSize, Sets};

/// Largest number of configurations of the workspace of use that are evaluated.
const USED: usize = 1000;

/// Planning of a measurement.
pub struct Plan {
    /// Nominal machine.
    pub machine: Machine,
    /// Quantities to be measured, and their uncertainty.
    pub map: Map,
    /// Selection of the configurations.
    pub choice: Choice,
    /// Study whose workspace is the workspace of use.
    pub study: Study,
    /// Error of the identified model itself: root mean square position error in the length unit
    /// that remains beside the noise of the instrument, known from an earlier fit. It is taken as
    /// independent between configurations.
    pub model_error: f64,
    /// Seed for random candidates and for the random samples of the study; without it, candidates
    /// follow a low-discrepancy sequence.
    pub seed: Option<u64>,
}

/// Selection of configurations.
#[derive(Clone, Debug)]
pub enum Choice {
    /// Sets of a plan file.
    Sets(Sets),
    /// Optimal design.
    Optimal {
        /// Optimality criterion.
        criterion: Criterion,
        /// Number of configurations.
        count: usize,
        /// Number of candidate samples within the joint limits.
        candidates: usize,
    },
    /// Optimal design among the rows of a plan file.
    Among {
        /// Rows to choose from.
        sets: Sets,
        /// Optimality criterion.
        criterion: Criterion,
        /// Number of configurations.
        count: usize,
    },
}

impl Choice {
    /// Evaluates all `sets`, or chooses `count` configurations from them or else from `candidates`.
    pub fn new(sets: Option<Sets>, count: Option<usize>, criterion: Criterion, candidates: usize) -> Self {
        match (sets, count) {
            (Some(sets), None) => Self::Sets(sets),
            (Some(sets), Some(count)) => Self::Among { sets, criterion, count },
            (None, count) => {
                Self::Optimal { criterion, count: count.unwrap_or(options::COUNT.default), candidates }
            }
        }
    }
}

/// Selected rows by title and sets, and what they determine.
struct Chosen {
    title: String,
    sets: Vec<SetSize>,
    rows: Vec<Observation>,
    identifiable: Identifiable,
    design: Option<Design>,
}

impl Plan {
    /// Selects the configurations and predicts the uncertainty after the measurement.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let Self { machine, map, .. } = self;
        map.require_uncertainty("a plan")?;
        map.require_joints("a plan")?;
        // Magnitudes that the spec leaves open are unknowns, as in an identification.
        let own = own_magnitudes(&machine.spec);
        let interpreter = Interpreter::new(extended(&machine.spec, &[]));
        let setup = Setup::at_home(&interpreter, map)?;
        let magnitudes = (machine.spec.sources.len()..).take(own.len()).map(Unknown::Magnitude);
        let model = setup.ideal.with(magnitudes.chain(setup.unknowns(false)).collect());
        let mut sizes = model.priors(Prior::DEFAULT_SHARE).about(&machine.origin)?;
        sizes.iter_mut().zip(&own).for_each(|(size, own)| *size = own.declared.standard_deviation);
        let used = self.configurations_of_use(&interpreter)?;
        let tool_points = model.tool_points(&used).about(&machine.origin)?;
        // Per coordinate.
        let model_error = self.model_error / 3.0_f64.sqrt();
        let objective = Objective { criterion: Criterion::Variance, used: &tool_points, model_error };
        let Chosen { title, sets, rows, identifiable, design } =
            self.choose(&interpreter, &setup, (&model, &sizes), objective, notes)?;
        let numbers = rows.iter().map(Observation::count).sum::<usize>();
        let Some(design) = design.filter(|_| numbers > identifiable.rank) else {
            let rank = identifiable.rank;
            let message = format!("too few configurations to determine {rank} combinations of errors");
            return Err(mistake::with_help(&machine.origin, message, "choose more configurations"));
        };
        let own = self.model_error;
        // An optimal design is assessed again on its own rows, as an identification would do it.
        // Sets need no second assessment.
        let (observed, own_design) = match &self.choice {
            Choice::Sets(_) => (identifiable.clone(), Some(design.clone())),
            Choice::Optimal { .. } | Choice::Among { .. } => {
                let observed = identifiable_from(&model, &rows, &sizes).about(&machine.origin)?;
                let own_design =
                    whole(&model, &rows, &observed, &objective, &mut |_, _| {}).about(&machine.origin)?;
                (observed, own_design)
            }
        };
        let (assessed, covariance) = match &own_design {
            Some(own_design) => (&observed, &own_design.covariance),
            None => (&identifiable, &design.covariance),
        };
        let spread = tool_points.deviations(assessed, covariance);
        let spread = Figures::from_norms(spread.into_iter().map(|deviation| deviation.hypot(own)).collect());
        let unseen = tool_points.unseen(assessed, |k| sizes[k].unwrap_or(1.0));
        // Effects below a millionth of the instrument's uncertainty are rounding errors.
        let matters =
            |(k, moves): &(usize, f64)| moves * sizes[*k].unwrap_or(1.0) > 1e-6 * map.uncertainty.length;
        let unseen = unseen
            .into_iter()
            .filter(matters)
            .map(|(k, moves)| UndeterminedError::new(&model, k, moves))
            .collect();
        let moved = setup.moved(&rows);
        if let Some(note) = scale_note(&setup.ideal, &rows, &moved).about(&machine.origin)? {
            notes.note(&note);
        }
        let groups =
            rows.first().map_or(Ok(Vec::new()), |row| indistinguishable(&model, &row.q, &moved, setup.pose));
        let groups = groups.about(&machine.origin)?;
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
            weakly_determined: WeaklyDetermined::all(&model, &observed, machine.spec.length),
            condition: observed.condition,
            log_det: design.log_det,
            exchanges: design.exchanges,
            model_error: self.model_error,
            unseen,
            used: used.len(),
            predicted: Predicted { mean: spread.mean, rms: spread.rms, max: spread.max, p95: spread.p95 },
            sums: redundant(&model, &observed)
                .into_iter()
                .filter(|one| machine.spec.sources.iter().any(|source| source.name == one.name))
                .collect(),
            groups,
            observations: rows,
        };
        finite(&machine.origin, report)
    }

    fn readable(&self, setup: &Setup, list: Vec<Observation>) -> Result<Vec<Observation>> {
        let most = list.len();
        let readable = readable_configurations(setup, &self.map, list, most).about(&self.machine.origin)?;
        if readable.is_empty() { Err(nothing_readable(&self.map)) } else { Ok(readable) }
    }

    fn choose(
        &self,
        manipulator: &Interpreter,
        setup: &Setup,
        (model, sizes): (&Model, &[Option<f64>]),
        objective: Objective<'_>,
        notes: &mut dyn Notes,
    ) -> Result<Chosen> {
        let of_sets = |sets: &Sets, notes: &mut dyn Notes| {
            let (configurations, counts) = sets.rows(manipulator, notes)?;
            let rows = (1..).zip(configurations).map(|(line, configuration): (u64, Configuration)| {
                let u = configuration.u.clone();
                Observation { u: u.into(), ..self.map.planned(line, configuration) }
            });
            let all: Vec<Observation> = rows.collect();
            let count = all.len();
            let readable = self.readable(setup, all)?;
            if readable.len() < count {
                let left = count - readable.len();
                notes.note(&format!(
                    "{}: {left} of {count} rows cannot be measured and are left out",
                    sets.title
                ));
            }
            Ok::<_, Diagnostics>((readable, counts))
        };
        match &self.choice {
            Choice::Sets(sets) => {
                let (rows, counts) = of_sets(sets, notes)?;
                let rows = self.map.in_sequence(rows);
                let rows = with_nominal_measurements(model, rows.into_iter()).about(&self.machine.origin)?;
                let identifiable = identifiable_from(model, &rows, sizes).about(&self.machine.origin)?;
                let progress = &mut |done, total| notes.progress(done, total);
                let design =
                    whole(model, &rows, &identifiable, &objective, progress).about(&self.machine.origin)?;
                Ok(Chosen { title: sets.title.clone(), sets: counts, rows, identifiable, design })
            }
            Choice::Optimal { criterion, count, .. } | Choice::Among { criterion, count, .. } => {
                if self.map.instruments().is_some_and(Instruments::depend_on_previous_row) {
                    let message = "this instrument reads relative to the row before, so single \
                        configurations cannot be chosen";
                    let help = format!("plan ordered rows with `{SETS}`");
                    return Err(mistake::with_help(self.map.path(), message, help));
                }
                let (list, from) = match &self.choice {
                    Choice::Sets(sets) | Choice::Among { sets, .. } => {
                        (of_sets(sets, notes)?.0, format!("rows of {}", sets.title))
                    }
                    Choice::Optimal { candidates, .. } => {
                        (self.readable(setup, self.samples(manipulator, *candidates)?)?, "samples".to_owned())
                    }
                };
                if *count > list.len() {
                    let message = format!("cannot choose {count} configurations from {} {from}", list.len());
                    let help = format!(
                        "each one is chosen at most once: increase `{CANDIDATES}` or the sets, or \
                        choose fewer configurations"
                    );
                    return Err(mistake::with_help(&self.machine.origin, message, help));
                }
                let list = with_nominal_measurements(model, list.into_iter()).about(&self.machine.origin)?;
                let identifiable = identifiable_from(model, &list, sizes).about(&self.machine.origin)?;
                let objective = Objective { criterion: *criterion, ..objective };
                let progress = &mut |done, total| notes.progress(done, total);
                let design = optimal(model, &list, &identifiable, *count, &objective, progress)
                    .about(&self.machine.origin)?;
                let chosen = design.iter().flat_map(|design| &design.chosen);
                let rows = chosen.map(|i| list[*i].clone()).collect();
                let name = match criterion {
                    Criterion::Variance => "V-optimal",
                    Criterion::Determinant => "D-optimal",
                };
                let title = format!("{name}: {count} of {} {from}", list.len());
                Ok(Chosen { title, sets: Vec::new(), rows, identifiable, design })
            }
        }
    }

    /// Returns candidate samples within the limits of the joints and inputs that move.
    fn samples(&self, manipulator: &Interpreter, candidates: usize) -> Result<Vec<Observation>> {
        let moved: Vec<usize> = self.map.moved().collect();
        let inputs = self.map.moved_inputs(&self.machine);
        let samples = match self.seed {
            Some(seed) => random_joint_samples(manipulator, &moved, candidates, seed),
            None => joint_samples(manipulator, &moved, candidates),
        };
        let samples = samples.and_then(|samples| samples.inputs(manipulator, &inputs));
        let samples = samples.about(&self.machine.origin)?.reached();
        Ok((1..).zip(samples).map(|(line, sample)| self.map.planned(line, sample)).collect())
    }

    /// Returns the range of each input over these rows.
    fn inputs(&self, rows: &[Observation]) -> Vec<Input> {
        let inputs = self.machine.spec.inputs.iter().enumerate().filter(|(_, input)| has_range(input));
        let inputs = inputs.map(|(i, input)| {
            let between = range_of(rows.iter().map(|row| row.u[i]));
            Input { name: input.name.clone(), unit: input.unit.clone(), between }
        });
        inputs.collect()
    }

    /// Returns the configurations of the workspace of use, without measurements.
    fn configurations_of_use(&self, manipulator: &dyn Manipulator) -> Result<Vec<Observation>> {
        let mut region = self.study.region.clone();
        region.fix(self.machine.fixed_inputs());
        let workspace = region.workspace(manipulator, self.seed).about(&self.machine.origin)?;
        let step = workspace.len().div_ceil(USED).max(1);
        let configurations =
            (0..workspace.len()).step_by(step).filter_map(|i| workspace.configuration(i).ok());
        let configurations = configurations.filter(|Configuration { q, s, .. }| closes(manipulator, q, s));
        let mut configurations: Vec<_> = configurations.collect();
        if configurations.is_empty() {
            let every: Vec<usize> = (0..manipulator.description().variables.len()).collect();
            configurations = joint_samples(manipulator, &every, 100).about(&self.machine.origin)?.reached();
            configurations.retain(|Configuration { q, s, .. }| closes(manipulator, q, s));
        }
        let nothing = || Measurement::Points(Vec::new().into());
        let rows = (1..)
            .zip(configurations)
            .map(|(line, configuration)| Observation::new(line, configuration.q, configuration.u, nothing()));
        Ok(rows.collect())
    }
}

/// Returns what these rows determine of unknowns of these sizes.
fn identifiable_from(
    model: &Model,
    rows: &[Observation],
    sizes: &[Option<f64>],
) -> Result<Identifiable, Failure> {
    knowable(model, rows, &vec![0.0; model.unknowns.len()], sizes)
}

/// Fills in the measurements of the nominal machine.
fn with_nominal_measurements(
    model: &Model,
    rows: impl Iterator<Item = Observation>,
) -> Result<Vec<Observation>, Failure> {
    let mut nominal = model.at(&vec![0.0; model.unknowns.len()]);
    rows.map(|row| nominal.nominally_seen(&row)).collect()
}
