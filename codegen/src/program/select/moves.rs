//! How fewer operations are found: each move stays only if it leaves fewer.
//!
//! A class is computed in another way; each value that is not computed yet is given for nothing once, and if what could
//! use it saves more than it takes, it stays; what was proposed together is changed together; and results are computed
//! anew as if they were the last.

use super::search::Search;
use crate::graph::Graph;

/// A value that takes more is never a gift: hardly more than this is saved.
const LARGEST_GIFT: u32 = 5;

/// So much less than it seems a way may take, as what it uses shares operations.
const SHARED: u32 = 4;

/// So much more a move may take at first.
const FURTHER: u32 = 3;

impl Search<'_> {
    /// Changes ways as long as that leaves fewer operations.
    pub(super) fn descend(&mut self) {
        let several = self.ways.several();
        self.forget();
        while self.improve(&several) {
            self.forget();
        }
    }

    /// Whether any of these classes is computed in a better way.
    fn improve(&mut self, classes: &[u32]) -> bool {
        let before = self.cost;
        for &class in classes {
            if !self.is_used(class) || !self.is_free(class) {
                continue;
            }
            let mut alone = self.alone(class);
            for way in self.ways.of(class) {
                if way == self.way(class) || self.seems(way) >= alone + SHARED {
                    continue;
                }
                let mark = self.mark();
                self.change(class, way);
                if self.cost < mark.1 && !self.are_circular(std::iter::once(class)) {
                    alone = self.alone(class);
                } else {
                    self.back(mark);
                }
            }
        }
        self.cost < before
    }

    /// Changes to what was proposed together, with all that follows from it.
    pub(super) fn change_together(&mut self, graph: &Graph) {
        let before = self.cost;
        let several = self.ways.several();
        for nodes in graph.together() {
            self.forget();
            let mark = self.mark();
            let changes: Vec<(u32, u32)> =
                nodes.iter().filter_map(|node| self.ways.find(graph, *node)).collect();
            if changes.len() < nodes.len() {
                // Of another function.
                continue;
            }
            for &(class, way) in &changes {
                self.held[class as usize] = true;
                if way != self.way(class) && self.is_free(class) {
                    self.change(class, way);
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

    /// Computes results anew after all others: all of them, then each half.
    pub(super) fn compute_anew(&mut self) {
        let before = self.cost;
        let (outputs, several) = (self.ways.outputs.clone(), self.ways.several());
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

    /// Gives each value that is not used for nothing.
    pub(super) fn give(&mut self) {
        let before = self.cost;
        for gift in 0..self.ways.count() as u32 {
            if self.is_used(gift) || self.estimated(gift) > LARGEST_GIFT {
                continue;
            }
            let users = self.used_users(gift);
            if users.len() < 2 {
                // Whether that one uses it was tried.
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

    /// What follows from moves that stayed.
    fn finish(&mut self, before: u32) {
        if self.cost < before {
            self.estimate();
            self.descend();
        }
    }

    /// The classes in use that have a way to use one, by some that are not in use.
    fn used_users(&self, class: u32) -> Vec<u32> {
        let mut found = Vec::new();
        let mut stack = vec![(class, 0)];
        while let Some((class, depth)) = stack.pop() {
            for &user in self.ways.users(class) {
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
