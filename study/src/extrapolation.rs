//! Configurations outside the fitted ranges of an identified machine, and the uncertainty there.

use abbe::{Manipulator, analysis::sampling};
use abbe_spec::{Spec, expr::Symbol};
use serde::Serialize;

use crate::calibration::{CalibrationErrors, Prediction};
use crate::{Notes, number};

/// Largest number of configurations at which uncertainties are evaluated, inside and outside the
/// ranges.
const SAMPLES: usize = 500;

/// Configurations outside the ranges on which the errors of a spec were fitted.
#[derive(Clone, Debug, Serialize)]
pub struct Extrapolation {
    /// Number of configurations outside the ranges.
    pub count: usize,
    /// Number of all configurations.
    pub all: usize,
    /// Standard deviation of the tool point; `None` if the spec states no covariance.
    pub standard_deviation: Option<ToolPointDeviation>,
    /// Warning in a sentence, for texts and pages.
    #[serde(skip)]
    pub sentence: String,
}

/// Standard deviation of the tool point (√trace of its covariance) caused by the covariance of the
/// identified errors and by the random sources, in the length unit.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ToolPointDeviation {
    /// Root mean square over configurations within the ranges.
    pub within: f64,
    /// Root mean square over the configurations outside the ranges.
    pub extrapolated: f64,
    /// Largest value outside the ranges.
    pub extrapolated_max: f64,
}

/// Counts the configurations outside the ranges on which the errors of a spec were fitted, and
/// warns of them with their uncertainty. `what` names the configurations, in the plural: `rows`.
/// `points` are those whose uncertainty is stated, in the frame of the
/// tool. Returns `None` if there are none.
pub fn warn_of_extrapolation<'r>(
    spec: &Spec,
    manipulator: &dyn Manipulator,
    points: &[[f64; 3]],
    what: &str,
    configurations: impl Iterator<Item = (&'r [f64], &'r [f64])>,
    notes: &mut dyn Notes,
) -> Option<Extrapolation> {
    if spec.fitted.is_empty() {
        return None;
    }
    let (mut all, mut outside, mut counts) = (0, Vec::new(), vec![0; spec.fitted.len()]);
    for (q, u) in configurations {
        let mut any = false;
        for (fitted, count) in spec.fitted.iter().zip(&mut counts) {
            let here = fitted.is_outside(q, u);
            *count += usize::from(here);
            any |= here;
        }
        all += 1;
        if any {
            outside.push((q, u));
        }
    }
    if outside.is_empty() {
        return None;
    }
    let standard_deviation = ToolPointDeviation::new(spec, manipulator, points, &outside);
    let named = spec.fitted.iter().zip(&counts).filter(|(_, count)| **count > 0);
    let named = named.map(|(fitted, count)| {
        let [lower, upper] = fitted.range.map(|end| number::of_symbol(end, fitted.symbol, spec));
        format!("{} beyond {lower} … {upper} in {count}", spec.name_of(fitted.symbol))
    });
    let named = named.collect::<Vec<_>>().join(", ");
    let deviation_there = standard_deviation.map_or(String::new(), |deviation| deviation.sentence(spec));
    let count = outside.len();
    let warning = format!(
        "{count} of {all} {what} are outside the ranges on which the errors of this spec were \
         fitted ({named}); there, predictions are extrapolations{deviation_there}"
    );
    notes.warn(&warning);
    Some(Extrapolation { count, all, standard_deviation, sentence: format!("{warning}.") })
}

impl ToolPointDeviation {
    /// Returns the deviations within the fitted ranges and at configurations outside of them;
    /// `None` if there are none or the spec states no covariance.
    pub fn new(
        spec: &Spec,
        manipulator: &dyn Manipulator,
        points: &[[f64; 3]],
        outside: &[(&[f64], &[f64])],
    ) -> Option<Self> {
        let errors = CalibrationErrors::new(spec);
        let (mut beyond, mut inside) = (Vec::new(), Vec::new());
        for point in points {
            let prediction = Prediction::new(spec, manipulator, &errors, *point)?;
            beyond.extend(prediction.deviations(some(outside)));
            inside.extend(prediction.deviations(within(spec)));
        }
        let extrapolated_max = beyond.iter().fold(0.0, |most: f64, deviation| most.max(*deviation));
        Some(Self { within: rms(&inside)?, extrapolated: rms(&beyond)?, extrapolated_max })
    }

    /// Returns the root mean square deviation of the tool point at configurations; `None` if the
    /// spec states no covariance.
    pub fn at(
        spec: &Spec,
        manipulator: &dyn Manipulator,
        configurations: &[(&[f64], &[f64])],
    ) -> Option<f64> {
        let errors = CalibrationErrors::new(spec);
        rms(&Prediction::new(spec, manipulator, &errors, [0.0; 3])?.deviations(some(configurations)))
    }

    fn sentence(&self, spec: &Spec) -> String {
        let [within, outside, most] = [self.within, self.extrapolated, self.extrapolated_max]
            .map(|value| number::length(value, spec.length));
        let times = number::digits(self.extrapolated / self.within, 2);
        format!(
            ". The covariance of these errors and the random sources give the tool point a standard \
             deviation of {outside} there (at most {most}), {times} times the {within} within the ranges. \
             What the model does not have can be larger outside than where it was measured"
        )
    }
}

/// Returns some of these configurations, evenly chosen.
fn some(all: &[(&[f64], &[f64])]) -> impl Iterator<Item = (Vec<f64>, Vec<f64>)> {
    all.iter().step_by(all.len().div_ceil(SAMPLES).max(1)).map(|(q, u)| (q.to_vec(), u.to_vec()))
}

/// Returns a Halton sequence of configurations within the ranges. Names without a range stay
/// nominal.
fn within(spec: &Spec) -> impl Iterator<Item = (Vec<f64>, Vec<f64>)> {
    (1..=SAMPLES).map(|n| {
        let mut q: Vec<f64> = spec.variables.iter().map(|variable| variable.home).collect();
        let mut u: Vec<f64> = spec.inputs.iter().map(|input| input.value).collect();
        for (dimension, fitted) in spec.fitted.iter().enumerate() {
            let [lower, upper] = fitted.range;
            let value = lower + (upper - lower) * sampling::halton(n, dimension);
            match fitted.symbol {
                Symbol::Variable(i) => q[i] = value,
                Symbol::Input(i) => u[i] = value,
                _ => {}
            }
        }
        (q, u)
    })
}

fn rms(values: &[f64]) -> Option<f64> {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (!values.is_empty()).then(|| (squares / values.len() as f64).sqrt())
}
