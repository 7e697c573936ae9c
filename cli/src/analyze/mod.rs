//! `abbe analyze`: section 5 of the paper. What every source does over a workspace, alone and together.
//!
//! The sweep runs once; `first_order` and `files` look at every configuration on the way. `agreement` compares
//! with published figures; `tables`, `text` and `json` show the results, `report` hands them to the pictures.

mod agreement;
mod files;
mod first_order;
mod json;
mod report;
mod tables;
mod text;
mod unreachable;

use abbe::analysis::{Budget, Configuration, Unevaluated, Workspace, error_budget, sampling};
use abbe::{Description, Manipulator};
use abbe_interpreter::Interpreter;

use crate::arguments::Analyze;
use crate::changes::Changes;
use crate::failure::Failure;
use crate::manipulator;
use crate::number;
use crate::output::{self, Outcome};
use crate::report::Pictures;
use crate::study::Study;

use files::Files;
use first_order::FirstOrder;

/// What was found over a workspace.
struct Analysis<'a> {
    description: Description<'a>,
    study: &'a Study,
    /// The workspace in a sentence.
    region: String,
    workspace: Workspace,
    /// Indices of the parameters that the workspace moves.
    varying: &'a [usize],
    budget: Budget,
    first_order: FirstOrder<'a>,
}

pub(crate) fn run(arguments: &Analyze) -> Result<Outcome, Failure> {
    let mut found = manipulator::find(&arguments.spec)?;
    let study = Study::find(arguments.study.as_deref(), &found)?;
    let changes = Changes::from_arguments(&arguments.changes, &found.spec)?;
    study.changes.apply(&mut found.spec);
    changes.apply(&mut found.spec);

    let interpreter = Interpreter::new(&found.spec);
    let description = interpreter.description();
    let workspace =
        study.region.workspace(&interpreter).map_err(|error| Failure::of(&found.origin, error))?;
    if workspace.configurations.is_empty() {
        let reasons = unreachable::summary(&workspace, &description);
        let message = format!("no configuration of the workspace can be reached: {reasons}");
        return Err(Failure::of(&found.origin, message));
    }

    let varying = varying(&workspace);
    let mut first_order = FirstOrder::new(&interpreter, workspace.configurations.len());
    let mut files = match &arguments.out {
        Some(folder) => Some(Files::create(folder, &description, &varying)?),
        None => None,
    };
    let mut pictures = arguments.out.as_ref().map(|_| Pictures::new(&study, &description));
    let u = sampling::nominal_inputs(&description);
    let budget = error_budget(&interpreter, &workspace, &u, &mut |row| {
        first_order.add(row, &u);
        files.iter_mut().for_each(|files| files.configuration(row));
        pictures.iter_mut().for_each(|pictures| pictures.add(row));
    })
    .map_err(|refused| unevaluated(&refused, &workspace, &description, &found.origin))?;

    let region = study.region.describe(&found.spec);
    let analysis =
        Analysis { description, study: &study, region, workspace, varying: &varying, budget, first_order };
    if let (Some(folder), Some(files), Some(pictures)) = (&arguments.out, files, pictures) {
        let report = pictures.render(&report::subject(&analysis, &found.spec))?.write(folder)?;
        files.finish(&analysis)?;
        report.finish()?;
    }
    let text = if arguments.json { output::json(&json::of(&analysis))? } else { text::of(&analysis) };
    Ok(Outcome::passed(text))
}

/// The parameters that are not the same everywhere.
fn varying(workspace: &Workspace) -> Vec<usize> {
    let Workspace { configurations, home, .. } = workspace;
    let varies = |i: &usize| configurations.iter().any(|configuration| configuration.s[*i] != home.s[*i]);
    (0..home.s.len()).filter(varies).collect()
}

fn unevaluated(
    refused: &Unevaluated,
    workspace: &Workspace,
    description: &Description,
    origin: &str,
) -> Failure {
    let at = match refused.configuration.and_then(|index| workspace.configurations.get(index)) {
        Some(configuration) => number::configuration(configuration, &workspace.home, description),
        None => "home".to_owned(),
    };
    Failure::evaluation(origin, &at, &refused.error, description)
}

impl Analysis<'_> {
    /// The configuration where a source, or everything, is worst.
    fn configuration(&self, index: Option<usize>) -> Option<&Configuration> {
        self.workspace.configurations.get(index?)
    }
}
