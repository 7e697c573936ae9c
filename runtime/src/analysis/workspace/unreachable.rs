//! What of a workspace could not be reached: counted by reason, the first of it listed.

use core::mem::discriminant;

use super::Configuration;
use crate::analysis::ReachError;

/// A configuration that was asked for and could not be had.
#[derive(Clone, Debug, PartialEq)]
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
    pub(in crate::analysis) fn add(&mut self, unreachable: Unreachable) {
        self.count += 1;
        let reason = unreachable.reason;
        match self.reasons.iter().position(|(known, _)| alike(known, &reason)) {
            Some(mut place) => {
                self.reasons[place].1 += 1;
                // Kept in order, of equals the earlier first.
                while place > 0 && self.reasons[place - 1].1 < self.reasons[place].1 {
                    self.reasons.swap(place - 1, place);
                    place -= 1;
                }
            }
            None => self.reasons.push((reason, 1)),
        }
        if self.first.len() < LISTED {
            self.first.push(unreachable);
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
