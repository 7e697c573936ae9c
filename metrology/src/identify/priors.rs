//! Prior knowledge of a machine before it is measured.

use abbe::Manipulator;
use abbe::analysis::variance;
use abbe::identify::{Failure, Fit, Folds, Model, Observation, Unknown, cross_validate};

/// Expected size of errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prior {
    /// Share of the arm length for lengths, and the same number in rad for angles; 0 for no prior.
    Share(f64),
    /// Standard deviation of the spec's random sources at each error; the default share where there
    /// is none.
    Spec,
    /// Share with the smallest error in cross-validation.
    Auto,
}

/// Shares that `Auto` tries.
const SHARES: [f64; 6] = [3e-2, Prior::DEFAULT_SHARE, 3e-3, 1e-3, 3e-4, 1e-4];

/// Relative improvement of the cross-validation error by which a smaller share must be better.
const BETTER: f64 = 0.01;

impl Prior {
    /// Default share of the arm length, and angle in rad.
    pub(crate) const DEFAULT_SHARE: f64 = 0.01;

    /// Returns the share for errors without a more specific prior; 0 for no prior.
    pub(super) fn share(self) -> f64 {
        match self {
            Self::Share(share) => share,
            Self::Spec | Self::Auto => Self::DEFAULT_SHARE,
        }
    }

    /// Returns smaller shares, the largest first.
    pub(super) fn smaller(self) -> impl Iterator<Item = Self> {
        let share = self.share();
        SHARES.into_iter().filter(move |smaller| *smaller < share).map(Self::Share)
    }

    /// Returns standard deviations about zero for the unknowns of a model.
    pub(super) fn for_model(self, model: &Model) -> Result<Vec<Option<f64>>, Failure> {
        match self {
            Self::Share(share) if share > 0.0 => model.priors(share),
            Self::Share(_) => Ok(Vec::new()),
            Self::Auto => model.priors(Self::DEFAULT_SHARE),
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

    /// Resolves `Auto` to the share with the smallest cross-validation error, and returns any other
    /// prior unchanged. Of shares that are about as good, the largest is chosen because it assumes
    /// least. `fitted` fits the model with a prior.
    pub(super) fn resolve(
        self,
        model: &Model,
        rows: &[Observation],
        folds: usize,
        fitted: impl Fn(&Model, Self) -> Result<Fit, Failure>,
    ) -> Result<Self, Failure> {
        if self != Self::Auto {
            return Ok(self);
        }
        let mut best: Option<(f64, f64)> = None;
        for share in SHARES {
            let validated = |fit| cross_validate(model, rows, &fit, &Folds::new(rows, folds));
            let Ok(found) = fitted(model, Self::Share(share)).and_then(validated) else { continue };
            let rms = found.figures().rms;
            if best.is_none_or(|(_, least)| rms < least * (1.0 - BETTER)) {
                best = Some((share, rms));
            }
        }
        Ok(best.map_or(self, |(share, _)| Self::Share(share)))
    }
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
