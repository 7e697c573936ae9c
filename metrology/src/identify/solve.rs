//! Fit and cross-validation on the data alone.

use abbe::VariableKind;
use abbe::identify::{Distances, Failure, Fit, Folds, Loss, Model, Options, Unknown, cross_validate};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::expr::Motion;
use abbe_spec::option::{ONLY_PLACEMENT, ROBUST_TUKEY};

use super::extended::OwnMagnitude;
use super::priors::{Prior, fit_with_places};
use super::row_notes::outlier_warning;
use super::{Basis, ErrorSite, JointProfiles, Settings, Setup, Term};
use crate::data::Data;
use abbe_study::{Notes, Result, mistake, number::digits};

/// Share of the prior of constant terms that are held at zero.
const HELD: f64 = 1e-9;

/// Result of the fit.
pub(super) struct Solved<'a> {
    /// Model with only base and tool unknown, and its solution.
    pub(super) simple: Model<'a>,
    pub(super) simple_x: Vec<f64>,
    /// Complete model and its fit.
    pub(super) model: Model<'a>,
    pub(super) fit: Fit,
    /// Position errors of the cross-validation.
    pub(super) cross_validated: Distances,
    /// Sources of the spec whose magnitudes are unknowns of the model, its first ones.
    pub(super) own: Vec<OwnMagnitude>,
    /// Terms whose magnitudes are the last unknowns of the model.
    pub(super) terms: Vec<Term>,
    /// Profiles of joints, which the manipulator has as known sources.
    pub(super) profiles: Option<JointProfiles>,
    /// Prior standard deviation of the errors of frames, as a share of the size and in rad; none if
    /// it is that of the spec, or if they are held.
    pub(super) prior: Option<f64>,
    /// Notes for the report.
    pub(super) notes: Vec<String>,
}

/// Fits the complete model and cross-validates it.
///
/// The manipulator has the sources of the spec, then copies of the `own` ones, then the `terms`.
/// With too few rows for the errors of the machine, only the places are fitted.
pub(super) fn solve<'a>(
    setup: &Setup<'a>,
    data: &Data,
    own: &[OwnMagnitude],
    terms: &[Term],
    settings: &Settings,
    notes: &mut dyn Notes,
) -> Result<Solved<'a>> {
    let rows = &data.observations;
    let diagnose = |cause: Failure| diagnose(&cause, data);
    let options = Options { loss: settings.loss, ..Options::default() };
    let simple = setup.real.with(setup.base_and_tool());
    let priors = settings.prior.for_model(&simple, setup).map_err(diagnose)?;
    let simple_x = fit_with_places(&simple, rows, Options { priors, ..options.clone() }).map_err(diagnose)?.x;

    let only = settings.only_placement;
    let (own, terms) = if only { Default::default() } else { (own, terms) };
    let mut magnitudes = (setup.declared..).map(Unknown::Magnitude);
    let of_own: Vec<Unknown> = magnitudes.by_ref().take(own.len()).collect();
    let of_terms = magnitudes.take(terms.len());
    // Of equivalent unknowns, magnitudes named in the spec are kept before errors of frames, and
    // terms after them.
    let model = setup
        .real
        .with(of_own.into_iter().chain(setup.unknowns(settings.holds_errors())).chain(of_terms).collect());
    let fitted = |model: &Model, prior: Prior| -> Result<Fit, Failure> {
        let mut priors = prior.for_model(model, setup)?;
        let share = prior.share();
        priors.resize(model.unknowns.len(), None);
        for (prior, own) in priors.iter_mut().zip(own) {
            *prior = own.declared.standard_deviation;
        }
        let first = priors.len() - terms.len();
        for (prior, term) in priors[first..].iter_mut().zip(terms) {
            // Richer terms have 1 mrad, or 1 mm per metre of arm; constants are held with the
            // others.
            let share = match term.basis {
                Basis::One => share.max(HELD),
                _ if share > 0.0 => share.min(1e-3),
                _ => 1e-3,
            };
            *prior = Some(share * term.scale(setup));
        }
        let (at, scaled) = (embedded(&simple, &simple_x, model), prior.scaled(model));
        fit_with_places(model, rows, Options { at, priors, scaled, ..options.clone() })
    };
    let validated = |prior: Prior| {
        let fit = fitted(&model, prior)?;
        let cross_validated = cross_validate(&model, rows, &fit, &Folds::new(rows, settings.folds))?;
        Ok((fit, cross_validated))
    };
    let mut prior = settings.prior;
    let mut found = validated(prior);
    // Errors of both ends of a leg act nearly alike: what tells them apart can be a valley of the
    // cost, too long and too curved to follow.
    let mut smaller = prior.smaller().filter(|_| setup.description.passive().next().is_some());
    while matches!(found, Err(Failure::NotConverged { .. }))
        && let Some(next) = smaller.next()
    {
        prior = next;
        found = validated(prior);
    }
    if let (Err(failure @ Failure::TooFew { .. }), false) = (&found, only || simple.unknowns.is_empty()) {
        let settings = Settings { only_placement: true, ..settings.clone() };
        let mut solved = solve(setup, data, &[], &[], &settings, notes)?;
        solved.notes.push(format!(
            "note: {failure}: no error of the machine was fitted, only the places, as by `{ONLY_PLACEMENT}`"
        ));
        return Ok(solved);
    }
    let warning = match settings.loss {
        Loss::Squares => outlier_warning(&model, data, found.as_ref().ok().map(|(fit, _)| fit)),
        _ => None,
    };
    if let (Err(_), Some(warning)) = (&found, &warning) {
        notes.note(warning);
    }
    let (fit, cross_validated) = found.map_err(diagnose)?;
    let scale = fit.scale;
    let mut solved = Solved {
        cross_validated,
        simple: simple.clone(),
        simple_x: simple_x.clone(),
        model,
        fit,
        own: own.to_vec(),
        terms: terms.to_vec(),
        profiles: None,
        prior: match prior {
            Prior::Share(share) => Some(share).filter(|share| *share > 0.0),
            Prior::Auto => Some(Prior::SCALED_SHARE * scale),
            Prior::Spec => None,
        },
        notes: warning.into_iter().map(|warning| format!("note: {warning}")).collect(),
    };
    if prior != settings.prior {
        solved.notes.push(format!(
            "note: prior standard deviation of the errors: {} % of the length of the arm, the largest of those \
             tried with which the iterations converge",
            digits(100.0 * prior.share(), 2)
        ));
    }
    Ok(solved)
}

impl Solved<'_> {
    /// Returns whether no error of the machine was fitted.
    pub(super) fn is_placement(&self) -> bool {
        self.model.unknowns == self.simple.unknowns
    }

    /// Returns the terms that the fit does not hold at zero.
    pub(super) fn determined_terms(&self) -> Vec<Term> {
        let first = self.model.unknowns.len() - self.terms.len();
        let kept = &self.fit.identifiable.kept;
        kept.iter().filter_map(|k| self.terms.get(k.checked_sub(first)?)).copied().collect()
    }

    /// Returns the source and the declared magnitude of an unknown; none if the unknown is not a
    /// magnitude of the spec.
    pub(super) fn own_magnitude(&self, unknown: usize) -> Option<OwnMagnitude> {
        self.own.get(unknown).copied()
    }

    /// Returns the magnitude of a source of the spec, the unknown k, and its standard deviation;
    /// none if it has no effect of its own.
    ///
    /// Of the sum `x = Σ f m` of magnitudes that act alike, with the variance C, each has a share
    /// by its prior: with `S = Σ f² σ²`, the value `f σ² x/S` and the variance `σ² (1 − f² σ²/S) +
    /// (f σ²/S)² C`.
    pub(super) fn magnitude(&self, k: usize) -> Option<(f64, f64)> {
        let (own, fit) = (self.own_magnitude(k)?, &self.fit);
        let acts = fit.identifiable.kept_coordinates(k);
        let mut of_kept = acts.iter().zip(&fit.identifiable.kept).enumerate();
        let is_sum = |factor: f64, kept: usize| factor != 0.0 && self.own_magnitude(kept).is_some();
        let (i, (factor, kept)) = of_kept.find(|(_, (factor, kept))| is_sum(**factor, **kept))?;
        let (x, variance) = (fit.x[*kept], fit.covariance[(i, i)]);
        let square = |k: usize| Some(self.own_magnitude(k)?.declared.standard_deviation?.powi(2));
        let all = [(*kept, 1.0)].into_iter().chain(self.alike(*kept));
        let all: Option<f64> = all.map(|(k, factor)| Some(factor * factor * square(k)?)).sum();
        let (value, variance) = match (all, square(k)) {
            (Some(all), Some(square)) => {
                let share = factor * square / all;
                (share * x, square * (1.0 - factor * share) + share * share * variance)
            }
            _ if *kept == k => (x, variance),
            _ => return None,
        };
        Some((own.declared.value + value, variance.max(0.0).sqrt()))
    }

    /// Returns the other magnitudes that act as an unknown, with their factors.
    pub(super) fn held_magnitudes(&self, unknown: usize) -> Vec<(OwnMagnitude, f64)> {
        self.alike(unknown).filter_map(|(k, factor)| Some((self.own_magnitude(k)?, factor))).collect()
    }

    /// Returns the unknowns of other magnitudes that act as one, with their factors.
    fn alike(&self, unknown: usize) -> impl Iterator<Item = (usize, f64)> {
        let all = self.fit.identifiable.redundant.iter().filter(|(k, _)| self.own_magnitude(*k).is_some());
        all.filter_map(move |(k, acts_as)| {
            let (_, factor) = acts_as.iter().find(|(kept, _)| *kept == unknown)?;
            Some((*k, *factor))
        })
    }
}

impl Term {
    /// Returns the magnitude of an error as large as the arm length, or of 1 rad; for a compliance,
    /// that of 1 rad by the weight of 1 kg at the end of the arm.
    fn scale(self, setup: &Setup) -> f64 {
        let is_angle = match self.site {
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

/// Returns the values of one model's unknowns in the order of another's, 0 for unknowns it lacks.
fn embedded(from: &Model, x: &[f64], to: &Model) -> Vec<f64> {
    let value = |unknown| from.unknowns.iter().position(|u| u == unknown).map_or(0.0, |k| x[k]);
    to.unknowns.iter().map(value).collect()
}

pub(super) fn diagnose(failure: &Failure, data: &Data) -> Diagnostics {
    match failure {
        Failure::NotConverged { .. } => {
            let help = format!(
                "if the data have outliers, try `{ROBUST_TUKEY}`; if joint zeros or units may be \
             wrong, try `abbe doctor`"
            );
            mistake::with_help(&data.file, failure, help)
        }
        failure => mistake::whole(&data.file, failure),
    }
}
