//! `abbe analyze`: section 5 of the paper. What every source does over a workspace, alone and together.
//!
//! The sweep runs once; `first_order` and `files` look at every configuration on the way. `agreement` compares
//! with published figures; `ledger` ranks the sources; `tables`, `text` and `json` show the results, `report` hands
//! them to the pictures.

mod agreement;
mod conclusions;
mod drawn;
mod files;
mod first_order;
mod json;
mod ledger;
mod report;
mod tables;
mod text;
mod unreachable;

use abbe::Description;
use abbe::analysis::{
    Admissible, Budget, Configuration, MonteCarlo, Row, Unevaluated, Watch, Workspace, error_budget,
    monte_carlo, sampling,
};

use crate::arguments::Analyze;
use crate::failure::Failure;
use crate::output::{self, Outcome, note};
use crate::progress::Progress;
use crate::report::Pictures;
use abbe_study::Machine;
use abbe_study::Study;
use abbe_study::number;

use files::Files;
use first_order::FirstOrder;

/// What was found over a workspace.
struct Analysis<'a> {
    description: &'a Description,
    study: &'a Study,
    /// The workspace in a sentence.
    region: String,
    workspace: &'a dyn Workspace,
    /// Indices of the parameters that the workspace moves.
    varying: &'a [usize],
    budget: Budget,
    first_order: FirstOrder<'a>,
    /// What the tolerance of the study allows.
    admissible: Option<Admissible>,
    drawn: Option<Drawn>,
}

/// Who is shown every configuration, if anybody is, and how far the sweep is.
struct Watching<'a> {
    files: Option<Files<'a>>,
    pictures: Option<Pictures<'a>>,
    progress: Progress,
}

impl Watch for Watching<'_> {
    fn rows(&self) -> bool {
        self.files.is_some() || self.pictures.is_some()
    }

    fn row(&mut self, row: &Row) {
        self.files.iter_mut().for_each(|files| files.configuration(row));
        self.pictures.iter_mut().for_each(|pictures| pictures.add(row));
    }

    fn done(&mut self, before: usize) {
        self.progress.reached(before);
    }
}

/// What was drawn at the worst configuration and at home.
struct Drawn {
    seed: u64,
    worst: MonteCarlo,
    home: MonteCarlo,
}

pub(crate) fn run(arguments: &Analyze) -> Result<Outcome, Failure> {
    let mut found = Machine::find(&arguments.spec)?;
    let mut study = Study::find(arguments.study.as_deref(), &found)?;
    let changes = arguments.changes.read(&found.spec)?;
    if !changes.is_empty() && study.forget_published() {
        note("note: published figures are left out: --set, --enable and --disable make another machine");
    }
    found.change(&study.changes);
    found.change(&changes);
    if let Some(threads) = arguments.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
        pool.build_global().map_err(|error| Failure::of("--threads", error))?;
    }

    let manipulator = found.evaluator(!arguments.interpret);
    let manipulator = &*manipulator;
    let description = manipulator.description();
    let workspace = study.region.workspace(manipulator, arguments.seed);
    let workspace = workspace.map_err(|error| Failure::of(&found.origin, error))?;
    let varying = study.region.varying(&found.spec);
    let u = sampling::nominal_inputs(description);
    let mut watching = Watching {
        files: match &arguments.out {
            Some(folder) => Some(Files::create(folder, description, &varying)?),
            None => None,
        },
        pictures: arguments.out.as_ref().map(|_| Pictures::new(&study, description)),
        progress: Progress::new(workspace.len()),
    };
    let residuals = study.compensation.as_ref().map(|left| left.of(description));
    let budget = error_budget(manipulator, &*workspace, &u, residuals.as_deref(), &mut watching);
    let Watching { files, pictures, progress } = watching;
    drop(progress);
    let unevaluated = |refused: &Unevaluated| {
        let at = match refused.configuration.and_then(|index| workspace.configuration(index).ok()) {
            Some(configuration) => number::configuration(&configuration, workspace.home(), description),
            None => "home".to_owned(),
        };
        Failure::evaluation(&found.origin, &at, &refused.error, description)
    };
    let budget = budget.map_err(|refused| unevaluated(&refused))?;
    if budget.configurations == 0 {
        let reasons = unreachable::summary(&budget.unreachable, description);
        let message = format!("no configuration of the workspace can be reached: {reasons}");
        return Err(Failure::of(&found.origin, message));
    }

    let first_order =
        FirstOrder::over(manipulator, &*workspace, &u).map_err(|refused| unevaluated(&refused))?;
    let drawn = match arguments.monte_carlo {
        Some(draws) => {
            let seed = arguments.seed.unwrap_or(0);
            let draw = |index: Option<usize>| {
                let configuration = index.and_then(|index| workspace.configuration(index).ok());
                let configuration = configuration.unwrap_or_else(|| workspace.home().clone());
                monte_carlo(manipulator, &configuration, &u, draws as usize, seed)
                    .map_err(|error| unevaluated(&Unevaluated { configuration: index, error }))
            };
            Some(Drawn { seed, worst: draw(budget.combined.radius.configuration)?, home: draw(None)? })
        }
        None => None,
    };
    let analysis = Analysis {
        region: study.region.describe(&found.spec),
        workspace: &*workspace,
        varying: &varying,
        admissible: study.tolerance.map(|tolerance| Admissible::new(&budget, tolerance)),
        description,
        study: &study,
        budget,
        first_order,
        drawn,
    };
    if let (Some(folder), Some(files), Some(pictures)) = (&arguments.out, files, pictures) {
        let report = pictures.render(&report::subject(&analysis, &found.spec))?.write(folder)?;
        files.finish(&analysis)?;
        report.finish()?;
    }
    analysis.warn(arguments.out.is_some());
    let text = if arguments.json { output::json(&json::of(&analysis))? } else { text::of(&analysis) };
    Ok(Outcome::passed(text))
}

impl Analysis<'_> {
    /// The configuration where a source, or everything, is worst.
    fn configuration(&self, index: Option<usize>) -> Option<Configuration> {
        self.workspace.configuration(index?).ok()
    }

    /// Says on stderr what a reader of the results must know.
    fn warn(&self, files: bool) {
        let length = |value| number::length(value, self.description.length);
        let neglected = self.first_order.largest;
        if let Some(tolerance) = self.study.tolerance.filter(|tolerance| neglected > tolerance / 10.0) {
            note(&format!(
                "warning: first order is off by up to {}, more than a tenth of the tolerance of {}; \
                 look at --monte-carlo",
                length(neglected),
                length(tolerance),
            ));
        }
        let (listed, count) = (self.budget.unreachable.first.len(), self.budget.unreachable.count);
        if files && listed < count {
            note(&format!("note: unreachable.csv has the first {listed} of {count}"));
        }
    }
}
