//! Prior knowledge of a machine before it is measured.

use abbe::Manipulator;
use abbe::analysis::variance;
use abbe::identify::{Failure, Fit, Model, Observation, Options, Unknown, fit};

use super::setup::Setup;

/// Expected size of errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Prior {
    /// Share of the arm length for lengths, and the same number in rad for angles; 0 holds the
    /// errors of frames at zero.
    Share(f64),
    /// Standard deviation of the spec's random sources at each error; the default share where there
    /// is none.
    Spec,
    /// 1 mm per metre of arm and 1 mrad, times a scale that the data choose.
    #[default]
    Auto,
}

impl Prior {
    /// Share of the arm length, and angle in rad, that errors are expected to have where no data
    /// say more.
    pub(crate) const DEFAULT_SHARE: f64 = 0.01;

    /// Share that is multiplied by the scale.
    pub(super) const SCALED_SHARE: f64 = 1e-3;

    /// Returns the share for errors without a more specific prior.
    pub(super) fn share(self) -> f64 {
        match self {
            Self::Share(share) => share,
            Self::Spec | Self::Auto => Self::DEFAULT_SHARE,
        }
    }

    /// Returns smaller shares, the largest first.
    pub(super) fn smaller(self) -> impl Iterator<Item = Self> {
        let share = self.share();
        [3e-3, 1e-3, 3e-4, 1e-4].into_iter().filter(move |smaller| *smaller < share).map(Self::Share)
    }

    /// Returns the unknowns whose priors have a scale that the data choose.
    pub(super) fn scaled(self, model: &Model) -> Vec<usize> {
        let is_error = |k: &usize| self == Self::Auto && matches!(model.unknowns[*k], Unknown::Error(..));
        (0..model.unknowns.len()).filter(is_error).collect()
    }

    /// Returns standard deviations about zero for the unknowns of a model. Places that neither map
    /// nor drawing states are known to the length of the arm and to a radian.
    pub(super) fn for_model(self, model: &Model, setup: &Setup) -> Result<Vec<Option<f64>>, Failure> {
        let mut priors = self.for_machine(model)?;
        for (prior, unknown) in
            priors.iter_mut().zip(&model.unknowns).filter(|(_, one)| setup.open.has(**one))
        {
            *prior = Some(if unknown.is_rotation() { 1.0 } else { setup.arm });
        }
        Ok(priors)
    }

    fn for_machine(self, model: &Model) -> Result<Vec<Option<f64>>, Failure> {
        match self {
            Self::Share(share) => model.priors(share),
            Self::Auto => model.priors(Self::SCALED_SHARE),
            Self::Spec => {
                let mut priors = model.priors(Self::DEFAULT_SHARE)?;
                let spec_variances = spec_variances(model.manipulator, &model.s).map_err(Failure::Machine)?;
                for (unknown, prior) in model.unknowns.iter().zip(&mut priors) {
                    if let Unknown::Error(frame, component) = unknown
                        && spec_variances[*frame][component.index()] > 0.0
                    {
                        *prior = Some(spec_variances[*frame][component.index()].sqrt());
                    }
                }
                Ok(priors)
            }
        }
    }
}

/// Fits a model. Where the iterations do not converge because rows hardly determine a place, it is
/// expected to be ten times, then a hundred times nearer to where it is stated.
pub(super) fn fit_with_places(
    model: &Model,
    rows: &[Observation],
    mut options: Options,
) -> Result<Fit, Failure> {
    for _ in 0..2 {
        match fit(model, rows, &options) {
            Err(Failure::NotConverged { .. }) => {}
            found => return found,
        }
        let places = options.priors.iter_mut().zip(&model.unknowns).filter(|(_, one)| one.is_placement());
        places.for_each(|(prior, _)| *prior = prior.map(|sigma| 0.1 * sigma));
    }
    fit(model, rows, &options)
}

/// Computes the variance of every generalized error of every frame at home that the random sources
/// of a spec cause.
fn spec_variances(manipulator: &dyn Manipulator, s: &[f64]) -> Result<Vec<[f64; 6]>, abbe::Error> {
    let description = manipulator.description();
    let q: Vec<f64> = description.variables.iter().map(|variable| variable.home).collect();
    let u: Vec<f64> = description.inputs.iter().map(|input| input.nominal).collect();
    let mut values = vec![0.0; description.effects.len()];
    manipulator.effects(&q, s, &u, &mut values)?;
    let mut variances = vec![[0.0; 6]; description.frames.len()];
    for (effect, value) in description.effects.iter().zip(&values) {
        if let Some(distribution) = description.sources[effect.source].class.distribution() {
            variances[effect.frame][effect.component.index()] += value * value * variance(distribution);
        }
    }
    Ok(variances)
}
