//! Position errors of the fitted and of the delivered machine on the same rows.

use abbe::{LengthUnit, identify::Model};
use abbe_spec::option::TERMS;

use super::{Compared, Setup, Solved};
use crate::data::Data;
use abbe_study::{About, Result, mistake, number};

/// Probability by chance at which terms count as worse than constant errors on the test rows.
const WORSE: f64 = 0.05;

/// Compares a fit, and a fit of constant errors alone if there is one, with the machine as
/// delivered on the rows that `used` accepts.
pub(super) fn compare(
    solved: &Solved,
    constant: Option<&Solved>,
    delivered: &Model,
    data: &Data,
    used: impl Fn(usize) -> bool + Sync,
) -> Result<Compared> {
    let rows = &data.observations;
    let distances =
        |model: &Model, x: &[f64]| model.distances_where(rows, |i| used(i).then_some(x)).about(&data.file);
    // Few models at a time, to limit the memory for a million rows.
    let before = distances(delivered, &[])?.into_figures();
    let simple = distances(&solved.simple, &solved.simple_x)?;
    let after = distances(&solved.model, &solved.fit.x)?;
    let gain = after.compared_with(&simple);
    let base_and_tool = simple.into_figures();
    let constant = constant.map(|constant| distances(&constant.model, &constant.fit.x)).transpose()?;
    let gain_of_terms = constant.as_ref().map(|constant| after.compared_with(constant).into());
    let left = after.into_figures();
    Ok(Compared {
        rows: (0..rows.len()).filter(|i| used(*i)).count(),
        configurations: left.configurations,
        before: before.into(),
        base_and_tool: base_and_tool.into(),
        constant: constant.map(|constant| constant.into_figures().into()),
        after: left.into(),
        gain: gain.into(),
        gain_of_terms,
    })
}

/// Returns an error if the fit ends worse than it began: the model then does not describe these
/// data.
pub(super) fn refuse_worse(compared: &Compared, data: &Data, setup: &Setup) -> Result<()> {
    let (before, after) = (compared.before.rms, compared.after.rms);
    if after <= 1.5 * before || after <= 10.0 * setup.real.uncertainty.length {
        return Ok(());
    }
    let length = |value| number::length(value, setup.description.length);
    let message = format!(
        "the fit increases the errors: the root mean square is {} with the nominal machine and {} \
         with the fitted one",
        length(before),
        length(after)
    );
    let help = if setup.pose {
        "check the orientation convention and `angle_uncertainty`: positions and orientations \
         contradict each other"
    } else {
        "check `uncertainty`, and check that these are measurements of this machine"
    };
    Err(mistake::with_help(&data.file, message, help))
}

impl Compared {
    /// Returns a note if constant errors alone leave significantly less on these rows, which were
    /// not fitted.
    pub(super) fn note_on_terms(&self, unit: LengthUnit) -> Option<String> {
        let (constant, gain) = (self.constant?, self.gain_of_terms?);
        let length = |value| number::length(value, unit);
        (gain.mean < 0.0 && gain.p <= WORSE).then(|| {
            format!(
                "note: on the test rows, constant errors alone leave {} in the mean, and {} with the \
                 terms: for such configurations, identify without `{TERMS}`",
                length(constant.mean),
                length(self.after.mean)
            )
        })
    }
}
