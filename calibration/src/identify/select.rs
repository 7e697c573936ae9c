//! Forward selection of terms by cross-validation.

use super::left_out::LeftOut;
use super::{CandidateTerms, FTest, Failure, Fit, Folds, Model, Observation};

/// A selected group of terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Index of the group.
    pub group: usize,
    /// Root mean square of the cross-validation residuals before its selection, in units of the
    /// uncertainty.
    pub before: f64,
    /// Root mean square of the cross-validation residuals with it.
    pub after: f64,
    /// Significance test of the group.
    pub test: FTest,
}

/// Smallest relative decrease of the squared cross-validation error for a selection.
const GAIN: f64 = 0.005;

/// Selects groups of terms forward: in each round the group with the smallest cross-validation
/// error, until none reduces it by half a percent, or the group is not significant.
///
/// The significance level is `chance` divided by the number of groups (Bonferroni), with
/// configurations instead of rows as independent units. `model` has the unknowns of the fit first,
/// then those of the terms. Everything is linearized about the fit. Each round calls `proceed`,
/// which returns false to stop.
pub fn select(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    folds: &Folds,
    candidates: &CandidateTerms,
    proceed: &mut dyn FnMut() -> bool,
) -> Result<Vec<Selection>, Failure> {
    let mut left_out = LeftOut::new(model, data, fit, folds, candidates)?;
    let mut selections: Vec<Selection> = Vec::new();
    while proceed() {
        let before = left_out.squares();
        let Some((group, after)) = left_out.best() else { break };
        if after > before * (1.0 - GAIN) {
            break;
        }
        let test = left_out.scores(group).test(left_out.freedom());
        if test.p * candidates.groups.len() as f64 > candidates.chance {
            break;
        }
        let rms = |squares: f64| (squares / left_out.numbers().max(1) as f64).sqrt();
        selections.push(Selection { group, before: rms(before), after: rms(after), test });
        left_out.take(group);
    }
    Ok(selections)
}
