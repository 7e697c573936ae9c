//! Richer terms, one group after the other, as long as they help on data that is left out.

use super::left_out::LeftOut;
use super::statistics::score_test;
use super::{FTest, Failure, Fit, Folds, Model, Observation};

/// A term: an unknown of the model times a factor that changes from row to row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factored {
    /// The unknown, by index.
    pub unknown: usize,
    /// The factor, by index; none where it is 1.
    pub factor: Option<usize>,
}

/// Terms that may be taken in.
pub struct Offer<'a> {
    /// Terms that are in already, beside what the fit has kept.
    pub taken: &'a [Factored],
    /// Groups of terms that come together: sine and cosine of a joint, say.
    pub groups: &'a [Vec<Factored>],
    /// The factors of an observation, in order.
    pub factors: &'a dyn Fn(&Observation) -> Vec<f64>,
    /// How likely it may be that the best of all groups is taken in by chance.
    pub chance: f64,
}

/// A group that earned its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Which group, by index.
    pub group: usize,
    /// Root mean square of what is left on left-out data, in units of the uncertainty, before it.
    pub before: f64,
    /// … and with it.
    pub after: f64,
    /// Whether what it explains could be chance.
    pub test: FTest,
}

/// By how much, as a share, the squared error on left-out data must fall for a group to be taken in.
const GAIN: f64 = 0.005;

/// Chooses forward: always the group that helps most on left-out data, until none helps by half a percent, or what it
/// explains could be chance.
///
/// The best of many looks good by chance: p is held against `chance` divided by the number of groups (Bonferroni), with
/// configurations, not rows, as what is independent. `model` has the unknowns of the fit first, then those of terms.
/// Everything is linear about the fit. `proceed` is asked before each round whether there is time.
pub fn select(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    folds: &Folds,
    offer: &Offer,
    proceed: &mut dyn FnMut() -> bool,
) -> Result<Vec<Selection>, Failure> {
    let mut left_out = LeftOut::new(model, data, fit, folds, offer)?;
    let mut selections: Vec<Selection> = Vec::new();
    while proceed() {
        let before = left_out.squares();
        let Some((group, after)) = left_out.best() else { break };
        if after > before * (1.0 - GAIN) {
            break;
        }
        let test = score_test(&left_out.scores(group), left_out.freedom());
        if test.p * offer.groups.len() as f64 > offer.chance {
            break;
        }
        let rms = |squares: f64| (squares / left_out.numbers().max(1) as f64).sqrt();
        selections.push(Selection { group, before: rms(before), after: rms(after), test });
        left_out.take(group);
    }
    Ok(selections)
}
