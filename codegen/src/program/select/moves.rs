//! Moves of the search. A move is kept only if it saves operations.
//!
//! The moves are: switch a class to another alternative; provide an unused value for free and keep
//! it if its users save more than it costs; switch a proposed group together; recompute results
//! after all others.

use super::Search;
use crate::graph::Graph;

/// Largest cost of a value that is provided for free. More expensive values hardly ever pay.
const LARGEST_GIFT: u32 = 5;

/// Amount by which the actual cost of an alternative may be below its estimate, because its
/// operands share operations.
const SHARED: u32 = 4;

/// Amount by which a move may increase the cost at first.
const FURTHER: u32 = 3;

impl Search<'_> {
    /// Switches alternatives as long as that saves operations.
    pub(super) fn descend(&mut self) {
        let several = self.alternatives.several();
        self.forget();
        while self.improve(&several) {
            self.forget();
        }
    }

    /// Tries to improve these classes; returns `true` if that saved operations.
    fn improve(&mut self, classes: &[u32]) -> bool {
        let before = self.cost;
        for &class in classes {
            if !self.is_used(class) || !self.is_free(class) {
                continue;
            }
            let mut alone = self.alone(class);
            for alternative in self.alternatives.of_class(class) {
                if alternative == self.alternative(class) || self.seems(alternative) >= alone + SHARED {
                    continue;
                }
                let mark = self.mark();
                self.change(class, alternative);
                if self.cost < mark.1 && !self.are_circular(std::iter::once(class)) {
                    alone = self.alone(class);
                } else {
                    self.back(mark);
                }
            }
        }
        self.cost < before
    }

    /// Switches the proposed groups together, and then improves the rest.
    pub(super) fn change_together(&mut self, graph: &Graph) {
        let before = self.cost;
        let several = self.alternatives.several();
        for nodes in graph.together() {
            self.forget();
            let mark = self.mark();
            let changes: Vec<(u32, u32)> =
                nodes.iter().filter_map(|node| self.alternatives.find(graph, *node)).collect();
            if changes.len() < nodes.len() {
                // The group belongs to another function.
                continue;
            }
            for &(class, alternative) in &changes {
                self.held[class as usize] = true;
                if alternative != self.alternative(class) && self.is_free(class) {
                    self.change(class, alternative);
                }
            }
            changes.iter().for_each(|(class, _)| self.held[*class as usize] = false);
            let used = changes.iter().map(|(class, _)| *class).filter(|class| self.is_used(*class));
            let circular = self.are_circular(used);
            if !circular && self.cost < mark.1 + FURTHER {
                self.improve(&several);
            }
            if circular || self.cost >= mark.1 {
                self.back(mark);
            }
        }
        self.finish(before);
    }

    /// Recomputes results after all others: first all of them, then each half.
    pub(super) fn compute_anew(&mut self) {
        let before = self.cost;
        let (outputs, several) = (self.alternatives.outputs.clone(), self.alternatives.several());
        let halves = outputs.chunks(outputs.len().div_ceil(2).max(1));
        for group in std::iter::once(&outputs[..]).chain(halves) {
            self.forget();
            let mark = self.mark();
            group.iter().for_each(|output| self.drop(*output));
            self.estimate();
            group.iter().for_each(|output| self.take(*output));
            if self.cost < mark.1 + FURTHER {
                self.improve(&several);
            }
            if self.cost >= mark.1 || self.are_circular(group.iter().copied()) {
                self.back(mark);
            }
        }
        self.finish(before);
    }

    /// Provides each unused value for free and keeps it if that pays.
    pub(super) fn give(&mut self) {
        let before = self.cost;
        for gift in 0..self.alternatives.count() as u32 {
            if self.is_used(gift) || self.estimate[gift as usize] > LARGEST_GIFT {
                continue;
            }
            let users = self.used_users(gift);
            if users.len() < 2 {
                // A single user has been tried by the other moves.
                continue;
            }
            self.forget();
            let mark = self.mark();
            self.take(gift);
            self.improve(&users);
            self.drop(gift);
            if self.cost >= mark.1 {
                self.back(mark);
            }
        }
        self.finish(before);
    }

    /// Estimates costs and descends again if moves were kept.
    fn finish(&mut self, before: u32) {
        if self.cost < before {
            self.estimate();
            self.descend();
        }
    }

    /// Returns the used classes with an alternative that uses a class, directly or through up to
    /// two unused ones.
    fn used_users(&self, class: u32) -> Vec<u32> {
        let mut found = Vec::new();
        let mut stack = vec![(class, 0)];
        while let Some((class, depth)) = stack.pop() {
            for &user in self.alternatives.users(class) {
                if self.is_used(user) {
                    found.push(user);
                } else if depth < 2 {
                    stack.push((user, depth + 1));
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }
}
