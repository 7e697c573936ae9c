//! Fitted, judged and chosen: by the data alone.

use abbe::identify::{
    Failure, Figures, Fit, Loss, Model, Options, Selection, Unknown, cross_validate, fit, select,
};
use abbe_codegen::diagnostic::Diagnostics;

use super::gross;
use super::priors::Prior;
use super::setup::Setup;
use super::terms::Term;
use crate::data::Data;
use crate::number::digits;
use crate::{Notes, mistake};

/// How it is done.
#[derive(Clone, Debug)]
pub struct Settings {
    /// What a residual costs.
    pub loss: Loss,
    /// How large errors are expected to be.
    pub prior: Prior,
    /// Into how many parts the rows are dealt, each left out in turn.
    pub folds: usize,
}

/// What the data say.
pub(super) struct Solved<'a> {
    /// Base and tool alone.
    pub(super) simple: Model<'a>,
    pub(super) simple_fit: Fit,
    /// Everything.
    pub(super) model: Model<'a>,
    pub(super) fit: Fit,
    /// Of the model with constants alone, if richer terms were tried.
    pub(super) constant: Option<Figures>,
    /// On rows left out in turn.
    pub(super) crossed: Figures,
    /// The groups of terms that were taken in, in the order of their gain.
    pub(super) chosen: Vec<(Vec<Term>, Selection)>,
    /// The terms whose magnitudes are the last unknowns of the model.
    pub(super) terms: Vec<Term>,
    /// What must be said.
    pub(super) notes: Vec<String>,
}

/// `candidates` are the last sources of the manipulator, group by group.
pub(super) fn solve<'a>(
    setup: &Setup<'a>,
    data: &Data,
    candidates: &[Vec<Term>],
    settings: &Settings,
    notes: &mut dyn Notes,
) -> Result<Solved<'a>, Diagnostics> {
    let rows = &data.observations;
    let explained = |cause: Failure| explained(&cause, data);
    let options = Options { loss: settings.loss, ..Options::default() };
    let simple = setup.real.with(setup.base_and_tool());
    let expected = simple.expected(&[]).map_err(explained)?;
    let simple_fit = fit(&simple, rows, &Options { expected, ..options.clone() }).map_err(explained)?;

    let fitted = |model: &Model, prior: Prior| -> Result<Fit, Failure> {
        let priors = prior.of_model(model)?;
        let at = embedded(&simple, &simple_fit.x, model);
        let expected = model.expected(&priors)?;
        let options = Options { at, priors, expected, ..options.clone() };
        let found = fit(model, rows, &options)?;
        // What is worse than stated tells less.
        if found.sigma < 1.5 {
            return Ok(found);
        }
        fit(model, rows, &Options { noise: found.sigma, at: found.x, ..options })
    };
    let crossed =
        |model: &Model, fit: &Fit| cross_validate(model, rows, fit, settings.folds).map_err(explained);
    let constants = setup.constants();
    let model = setup.real.with(constants.clone());
    let prior = settings.prior.chosen(&model, rows, settings.folds, fitted).map_err(explained)?;
    let found = fitted(&model, prior);
    let warning = match settings.loss {
        Loss::Squares => gross::warning(&model, data, found.as_ref().ok()),
        _ => None,
    };
    if let (Err(_), Some(warning)) = (&found, &warning) {
        notes.note(warning);
    }
    let fit = found.map_err(explained)?;
    let mut solved = Solved {
        crossed: crossed(&model, &fit)?,
        simple: simple.clone(),
        simple_fit: simple_fit.clone(),
        model,
        fit,
        constant: None,
        chosen: Vec::new(),
        terms: Vec::new(),
        notes: warning.into_iter().map(|warning| format!("note: {warning}")).collect(),
    };
    if let (Prior::Auto, Prior::Share(share)) = (settings.prior, prior) {
        solved.notes.push(format!(
            "note: errors are expected to be {} of the arm's length: of all that was tried, rows left out in turn fit \
             best with it, or as well as with less",
            format!("{} %", digits(100.0 * share, 2))
        ));
    }
    if candidates.is_empty() {
        return Ok(solved);
    }

    // The magnitude of every term, by group.
    let count = candidates.iter().map(Vec::len).sum::<usize>();
    let mut sources = setup.description.sources.len() - count..;
    let magnitudes: Vec<Vec<(Term, Unknown)>> = candidates
        .iter()
        .map(|group| group.iter().copied().zip(sources.by_ref().map(Unknown::Magnitude)).collect())
        .collect();
    let with = |terms: &[(Term, Unknown)]| {
        let magnitudes = terms.iter().map(|(_, magnitude)| *magnitude);
        setup.real.with(constants.iter().copied().chain(magnitudes).collect())
    };
    let mut next = constants.len()..;
    let offered: Vec<Vec<usize>> =
        candidates.iter().map(|group| next.by_ref().take(group.len()).collect()).collect();
    let rich = with(&magnitudes.concat());
    let selected = select(&rich, rows, &solved.fit, &offered, settings.folds, 40).map_err(explained)?;
    solved.constant = Some(solved.crossed);
    // In the order of the spec, not of their gain.
    let taken = (0..candidates.len()).filter(|i| selected.iter().any(|selection| selection.candidate == *i));
    let taken: Vec<(Term, Unknown)> = taken.flat_map(|i| magnitudes[i].clone()).collect();
    if !taken.is_empty() {
        solved.model = with(&taken);
        solved.fit = fitted(&solved.model, prior).map_err(explained)?;
        solved.crossed = crossed(&solved.model, &solved.fit)?;
    }
    solved.terms = taken.into_iter().map(|(term, _)| term).collect();
    let group = |selection: Selection| (candidates[selection.candidate].clone(), selection);
    solved.chosen = selected.into_iter().map(group).collect();
    Ok(solved)
}

/// The values of one model's unknowns in the order of another's.
fn embedded(from: &Model, x: &[f64], to: &Model) -> Vec<f64> {
    let value = |unknown| from.unknowns.iter().position(|u| u == unknown).map_or(0.0, |k| x[k]);
    to.unknowns.iter().map(value).collect()
}

fn explained(failure: &Failure, data: &Data) -> Diagnostics {
    match failure {
        Failure::Observation { .. } | Failure::Machine(_) => mistake::whole(&data.file, failure),
        Failure::TooFew { numbers, rank } => {
            let message = format!(
                "{numbers} numbers were measured for {rank} or more unknowns: nothing is left to judge the result by"
            );
            let help = "measure more configurations: twice as many numbers as unknowns at least";
            mistake::with_help(&data.file, message, help)
        }
        Failure::NotConverged { .. } => {
            let help = "gross errors in the data? `--robust tukey` can do without them";
            mistake::with_help(&data.file, failure, help)
        }
    }
}
