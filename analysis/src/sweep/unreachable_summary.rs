//! Unreachable configurations of a workspace: counted by reason, the first ones listed.

use core::mem::discriminant;

use abbe_core::Description;
use abbe_kinematics::{ReachError, Unreachable};

/// Number of configurations that are listed.
const LISTED: usize = 1000;

/// Summary of the unreachable configurations of a workspace.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnreachableSummary {
    /// Number of unreachable configurations.
    pub count: usize,
    /// Kinds of reasons (out of reach, the variable outside its limits, the kind of error), each
    /// with its first occurrence and its count. The most frequent kind is first.
    pub reasons: Vec<(ReachError, usize)>,
    /// First unreachable configurations, at most 1000.
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

    /// Returns whether the summary is valid for a manipulator. It may come from a file.
    pub(crate) fn is_sound(&self, description: &Description) -> bool {
        let total = self.reasons.iter().try_fold(0, |sum: usize, (_, count)| sum.checked_add(*count));
        let mut reasons =
            self.reasons.iter().map(|(reason, _)| reason).chain(self.first.iter().map(|one| &one.reason));
        total == Some(self.count)
            && self.first.len() <= self.count.min(LISTED)
            && reasons.all(|reason| match reason {
                ReachError::OutsideLimits { variable, .. } => *variable < description.variables.len(),
                ReachError::OutsideSumLimit { limit, .. } => *limit < description.sum_limits.len(),
                _ => true,
            })
    }

    /// Appends the summary of the following configurations.
    pub(crate) fn append(&mut self, other: Self) {
        self.count += other.count;
        other.reasons.into_iter().for_each(|(reason, count)| self.count_reason(reason, count));
        let room = LISTED - self.first.len();
        self.first.extend(other.first.into_iter().take(room));
    }

    /// Sorts the reasons by frequency. Equal ones stay in order of occurrence.
    pub(crate) fn finish(mut self) -> Self {
        self.reasons.sort_by_key(|(_, count)| core::cmp::Reverse(*count));
        self
    }

    fn count_reason(&mut self, reason: ReachError, more: usize) {
        match self.reasons.iter_mut().find(|(known, _)| is_same_kind(known, &reason)) {
            Some((_, count)) => *count += more,
            None => self.reasons.push((reason, more)),
        }
    }
}

/// Returns whether two reasons are of one kind.
fn is_same_kind(a: &ReachError, b: &ReachError) -> bool {
    match (a, b) {
        (ReachError::OutOfReach { .. }, ReachError::OutOfReach { .. }) => true,
        (ReachError::OutsideLimits { variable: a, .. }, ReachError::OutsideLimits { variable: b, .. }) => {
            a == b
        }
        (ReachError::OutsideSumLimit { limit: a, .. }, ReachError::OutsideSumLimit { limit: b, .. }) => {
            a == b
        }
        (ReachError::Evaluation(a), ReachError::Evaluation(b)) => discriminant(a) == discriminant(b),
        _ => false,
    }
}
