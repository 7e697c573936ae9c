//! Fitted and judged: by the data alone.

use abbe::VariableKind;
use abbe::identify::{Distances, Failure, Fit, Loss, Model, Options, Unknown, cross_validate, fit};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::expr::Motion;

use super::magnitude::OwnMagnitude;
use super::options::Settings;
use super::outliers;
use super::priors::Prior;
use super::setup::Setup;
use super::terms::{Basis, ErrorSite, Term};
use crate::data::Data;
use crate::number::digits;
use crate::{Notes, mistake};

/// What the data say.
pub(super) struct Solved<'a> {
    /// Base and tool alone.
    pub(super) simple: Model<'a>,
    pub(super) simple_x: Vec<f64>,
    /// Everything.
    pub(super) model: Model<'a>,
    pub(super) fit: Fit,
    /// On rows left out in turn.
    pub(super) crossed: Distances,
    /// Sources of the spec whose magnitudes are unknowns of the model.
    pub(super) own: Vec<OwnMagnitude>,
    /// The terms whose magnitudes are the last unknowns of the model.
    pub(super) terms: Vec<Term>,
    /// What must be said.
    pub(super) notes: Vec<String>,
}

/// Behind the sources of the spec the manipulator has `own` ones of them once more, and then `terms`.
pub(super) fn solve<'a>(
    setup: &Setup<'a>,
    data: &Data,
    own: &[OwnMagnitude],
    terms: &[Term],
    settings: &Settings,
    notes: &mut dyn Notes,
) -> Result<Solved<'a>, Diagnostics> {
    let rows = &data.observations;
    let explained = |cause: Failure| explained(&cause, data);
    let options = Options { loss: settings.loss, ..Options::default() };
    let simple = setup.real.with(setup.base_and_tool());
    let expected = simple.expected(&[]).map_err(explained)?;
    let simple_x = fit(&simple, rows, &Options { expected, ..options.clone() }).map_err(explained)?.x;

    let mut magnitudes = (setup.declared..).map(Unknown::Magnitude);
    let of_own: Vec<Unknown> = magnitudes.by_ref().take(own.len()).collect();
    let of_terms = magnitudes.take(terms.len());
    // What somebody has named is kept before errors of frames that act alike, what was tried behind them.
    let model = setup.real.with(of_own.into_iter().chain(setup.constants()).chain(of_terms).collect());
    let fitted = |model: &Model, prior: Prior| -> Result<Fit, Failure> {
        let mut priors = prior.of_model(model)?;
        let share = prior.share();
        priors.resize(model.unknowns.len(), None);
        for (prior, own) in priors.iter_mut().zip(own) {
            *prior = own.declared.standard_deviation;
        }
        let first = priors.len() - terms.len();
        for (prior, term) in priors[first..].iter_mut().zip(terms).filter(|_| share > 0.0) {
            *prior = Some(share * term.scale(setup));
        }
        let at = embedded(&simple, &simple_x, model);
        let expected = model.expected(&priors)?;
        fit(model, rows, &Options { at, priors, expected, ..options.clone() })
    };
    let crossed =
        |model: &Model, fit: &Fit| cross_validate(model, rows, fit, settings.folds).map_err(explained);
    let prior = settings.prior.chosen(&model, rows, settings.folds, fitted).map_err(explained)?;
    let found = fitted(&model, prior);
    let warning = match settings.loss {
        Loss::Squares => outliers::warning(&model, data, found.as_ref().ok()),
        _ => None,
    };
    if let (Err(_), Some(warning)) = (&found, &warning) {
        notes.note(warning);
    }
    let fit = found.map_err(explained)?;
    let mut solved = Solved {
        crossed: crossed(&model, &fit)?,
        simple: simple.clone(),
        simple_x: simple_x.clone(),
        model,
        fit,
        own: own.to_vec(),
        terms: terms.to_vec(),
        notes: warning.into_iter().map(|warning| format!("note: {warning}")).collect(),
    };
    if let (Prior::Auto, Prior::Share(share)) = (settings.prior, prior) {
        solved.notes.push(format!(
            "note: errors are expected to be {} % of the arm's length: of all that was tried, rows left out in turn fit \
             best with it, or as well as with less",
            digits(100.0 * share, 2)
        ));
    }
    Ok(solved)
}

impl Solved<'_> {
    /// The magnitude of a source of the spec that an unknown is about, if it is about one: which one, and what the spec says.
    pub(super) fn own_magnitude(&self, unknown: usize) -> Option<OwnMagnitude> {
        self.own.get(unknown).copied()
    }
}

impl Term {
    /// The magnitude of an error as large as the arm is long, or of 1 rad; of a compliance, by the weight of 1 kg at the end
    /// of the arm.
    fn scale(self, setup: &Setup) -> f64 {
        let is_angle = match self.place {
            ErrorSite::Joint(joint) => setup.description.variables[joint].kind == VariableKind::Revolute,
            ErrorSite::Frame(_, component) | ErrorSite::Base(component) => component.is_rotation(),
            ErrorSite::DenavitHartenberg(_, number) => number.motion().0 == Motion::Rotation,
            ErrorSite::Parameter(_) => false,
        };
        match self.basis {
            Basis::Moment | Basis::Coupled(_) => 1e6 / (9.80665 * setup.arm),
            _ if is_angle => 1.0,
            _ => setup.arm,
        }
    }
}

/// The values of one model's unknowns in the order of another's.
fn embedded(from: &Model, x: &[f64], to: &Model) -> Vec<f64> {
    let value = |unknown| from.unknowns.iter().position(|u| u == unknown).map_or(0.0, |k| x[k]);
    to.unknowns.iter().map(value).collect()
}

pub(super) fn explained(failure: &Failure, data: &Data) -> Diagnostics {
    match failure {
        Failure::Observation { .. } | Failure::Machine(_) | Failure::Untouched { .. } => {
            mistake::whole(&data.file, failure)
        }
        Failure::TooFew { numbers, configurations, rank } => {
            let message = format!(
                "{numbers} independent numbers were measured, at {configurations} configurations, for {rank} or more \
                 unknowns: nothing is left to judge the result by"
            );
            let help = "measure at more configurations, until there are twice as many numbers as unknowns; visits of the same \
                        configuration do not count";
            mistake::with_help(&data.file, message, help)
        }
        Failure::NotConverged { .. } => {
            let help = "gross errors in the data? `--robust tukey` can do without them";
            mistake::with_help(&data.file, failure, help)
        }
    }
}
