//! What of a workspace could not be reached: counted by reason, the first of it listed.

use core::mem::discriminant;

use super::Configuration;
use crate::ReachError;

/// A configuration that was asked for and could not be had.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unreachable {
    /// Its index in the workspace.
    pub index: usize,
    /// The point of `F_0` that the tool was to be brought to, if that differs from one to the next.
    pub point: Option<[f64; 3]>,
    /// What was asked for; the variables to be solved for are where the search began.
    pub asked: Configuration,
    /// Why it could not be had.
    pub reason: ReachError,
}

/// How many are listed one by one.
const LISTED: usize = 1000;

/// What of a workspace could not be reached.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnreachableSummary {
    /// How many.
    pub count: usize,
    /// The kinds of reasons (out of reach, the variable outside its limits, the kind of error), each with the
    /// first of its kind and how many there are; the most frequent kind first.
    pub reasons: Vec<(ReachError, usize)>,
    /// The first ones, 1000 at most.
    pub first: Vec<Unreachable>,
}

impl UnreachableSummary {
    pub(crate) fn add(&mut self, unreachable: Unreachable) {
        self.count += 1;
        self.count_reason(unreachable.reason, 1);
        if self.first.len() < LISTED {
            self.first.push(unreachable);
        }
    }

    /// Whether it, which may come from a file, can be of a manipulator with so many variables.
    pub(crate) fn is_sound(&self, variables: usize) -> bool {
        let total = self.reasons.iter().try_fold(0, |sum: usize, (_, count)| sum.checked_add(*count));
        let mut reasons =
            self.reasons.iter().map(|(reason, _)| reason).chain(self.first.iter().map(|one| &one.reason));
        total == Some(self.count)
            && self.first.len() <= self.count.min(LISTED)
            && reasons.all(|reason| match reason {
                ReachError::OutsideLimits { variable, .. } => *variable < variables,
                _ => true,
            })
    }

    /// Takes in what follows.
    pub(crate) fn append(&mut self, other: Self) {
        self.count += other.count;
        other.reasons.into_iter().for_each(|(reason, count)| self.count_reason(reason, count));
        let room = LISTED - self.first.len();
        self.first.extend(other.first.into_iter().take(room));
    }

    /// The most frequent kind first, of equals the earlier: so far they are in the order in which they came.
    pub(crate) fn finish(mut self) -> Self {
        self.reasons.sort_by_key(|(_, count)| core::cmp::Reverse(*count));
        self
    }

    fn count_reason(&mut self, reason: ReachError, more: usize) {
        match self.reasons.iter_mut().find(|(known, _)| alike(known, &reason)) {
            Some((_, count)) => *count += more,
            None => self.reasons.push((reason, more)),
        }
    }
}

/// Whether two reasons are of one kind.
fn alike(a: &ReachError, b: &ReachError) -> bool {
    match (a, b) {
        (ReachError::OutOfReach { .. }, ReachError::OutOfReach { .. }) => true,
        (ReachError::OutsideLimits { variable: a, .. }, ReachError::OutsideLimits { variable: b, .. }) => {
            a == b
        }
        (ReachError::Evaluation(a), ReachError::Evaluation(b)) => discriminant(a) == discriminant(b),
        _ => false,
    }
}
