//! What is known of a machine before it is measured.

use abbe::analysis::variance;
use abbe::identify::{Failure, Fit, Model, Observation, Unknown, cross_validate};
use abbe::{Class, Manipulator};

/// How large errors are expected to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prior {
    /// As a share of the arm's length, and in rad; 0 for no expectation.
    Share(f64),
    /// As the random sources of the spec have it at the frame, joint or parameter; a hundredth where they say nothing.
    Spec,
    /// The share with which rows that are left out in turn fit best.
    Auto,
}

/// The shares that are tried.
const SHARES: [f64; 6] = [3e-2, Prior::DEFAULT_SHARE, 3e-3, 1e-3, 3e-4, 1e-4];

/// Another share is better if rows left out are by more than this.
const BETTER: f64 = 0.01;

impl Prior {
    /// What is expected if nothing is said, as a share of the arm's length and in rad.
    pub(crate) const DEFAULT_SHARE: f64 = 0.01;

    /// What is expected of errors of which nothing else is said; 0 for no expectation.
    pub(super) fn share(self) -> f64 {
        match self {
            Self::Share(share) => share,
            Self::Spec | Self::Auto => Self::DEFAULT_SHARE,
        }
    }

    /// As standard deviations about zero, for the unknowns of a model.
    pub(super) fn of_model(self, model: &Model) -> Result<Vec<Option<f64>>, Failure> {
        match self {
            Self::Share(share) if share > 0.0 => model.priors(share),
            Self::Share(_) => Ok(Vec::new()),
            Self::Auto => model.priors(Self::DEFAULT_SHARE),
            Self::Spec => {
                let mut priors = model.priors(Self::DEFAULT_SHARE)?;
                let stated = stated(model.manipulator, &model.s).map_err(Failure::Machine)?;
                for (unknown, prior) in model.unknowns.iter().zip(&mut priors) {
                    if let Unknown::Error(frame, component) = unknown
                        && stated[*frame][component.index()] > 0.0
                    {
                        *prior = Some(stated[*frame][component.index()].sqrt());
                    }
                }
                Ok(priors)
            }
        }
    }

    /// The share that fits rows best that are left out in turn, if it is to be chosen: of those that are about as good the
    /// largest, which says least. `fitted` fits the model with one.
    pub(super) fn chosen(
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
            let Ok(fit) = fitted(model, Self::Share(share)) else { continue };
            let rms = cross_validate(model, rows, &fit, folds)?.figures().rms;
            if best.is_none_or(|(_, least)| rms < least * (1.0 - BETTER)) {
                best = Some((share, rms));
            }
        }
        Ok(best.map_or(self, |(share, _)| Self::Share(share)))
    }
}

/// The variance of every error at home that the random sources of a spec make, drawing tolerances for example.
fn stated(manipulator: &dyn Manipulator, s: &[f64]) -> Result<Vec<[f64; 6]>, abbe::Error> {
    let description = manipulator.description();
    let q: Vec<f64> = description.variables.iter().map(|variable| variable.home).collect();
    let u: Vec<f64> = description.inputs.iter().map(|input| input.nominal).collect();
    let mut values = vec![0.0; description.effects.len()];
    manipulator.effects(&q, s, &u, &mut values)?;
    let mut variances = vec![[0.0; 6]; description.frames.len()];
    for (effect, value) in description.effects.iter().zip(&values) {
        if let Class::Random(distribution) = description.sources[effect.source].class {
            variances[effect.frame][effect.component.index()] += value * value * variance(distribution);
        }
    }
    Ok(variances)
}
