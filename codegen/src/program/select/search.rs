//! State of the search: selected alternative and number of uses of each class, total cost, and a
//! log for undo.

use super::Alternatives;

/// Larger than any cost.
const UNKNOWN: u32 = u32::MAX / 4;

pub(super) struct Search<'w> {
    pub(super) alternatives: &'w Alternatives,
    pub(super) chosen: Vec<u32>,
    uses: Vec<u32>,
    /// Total cost of all used classes.
    pub(super) cost: u32,
    /// Marginal cost of using a class: 0 if it is used, else its last estimate.
    price: Vec<u32>,
    pub(super) estimate: Vec<u32>,
    /// Classes that keep their alternative when they come into use.
    pub(super) held: Vec<bool>,
    /// Classes that always keep their alternative.
    fixed: Vec<bool>,
    /// Undo log: class, previous uses, previous alternative.
    log: Vec<(u32, u32, u32)>,
}

impl<'w> Search<'w> {
    /// Starts with the given alternatives and uses the outputs.
    pub(super) fn new(alternatives: &'w Alternatives, chosen: Vec<u32>, fixed: Vec<bool>) -> Self {
        let count = alternatives.count();
        let mut search = Self {
            alternatives,
            chosen,
            uses: vec![0; count],
            cost: 0,
            // The last element is the price of an absent operand.
            price: vec![0; count + 1],
            estimate: vec![0; count + 1],
            held: vec![true; count],
            fixed,
            log: Vec::new(),
        };
        alternatives.outputs.iter().for_each(|output| search.take(*output));
        search.held.fill(false);
        search.estimate();
        search
    }

    pub(super) fn alternative(&self, class: u32) -> u32 {
        self.chosen[class as usize]
    }

    /// Returns `true` if the alternative of a class may change.
    pub(super) fn is_free(&self, class: u32) -> bool {
        !self.fixed[class as usize]
    }

    pub(super) fn is_used(&self, class: u32) -> bool {
        self.uses[class as usize] > 0
    }

    /// Adds a use of a class. A class that was unused takes the alternative with the lowest
    /// estimate.
    pub(super) fn take(&mut self, class: u32) {
        let at = class as usize;
        self.log.push((class, self.uses[at], self.chosen[at]));
        self.uses[at] += 1;
        if self.uses[at] > 1 {
            return;
        }
        // The operands must not use the class.
        self.price[at] = UNKNOWN;
        if !self.held[at] && !self.fixed[at] {
            let alternatives = self.alternatives.of_class(class);
            if alternatives.len() > 1 {
                let best = alternatives.min_by_key(|alternative| self.seems(*alternative));
                self.chosen[at] = best.unwrap_or(self.chosen[at]);
            }
        }
        let alternative = self.chosen[at];
        self.cost += self.alternatives.alternative(alternative).cost;
        self.alternatives.operands(alternative).for_each(|operand| self.take(operand));
        self.price[at] = 0;
    }

    /// Removes a use of a class.
    pub(super) fn drop(&mut self, class: u32) {
        let at = class as usize;
        self.log.push((class, self.uses[at], self.chosen[at]));
        self.uses[at] -= 1;
        if self.uses[at] == 0 {
            self.price[at] = self.estimate[at];
            let alternative = self.chosen[at];
            self.cost -= self.alternatives.alternative(alternative).cost;
            self.alternatives.operands(alternative).for_each(|operand| self.drop(operand));
        }
    }

    /// Switches a class to another alternative.
    pub(super) fn change(&mut self, class: u32, alternative: u32) {
        let at = class as usize;
        let old = self.chosen[at];
        if self.uses[at] == 0 {
            self.log.push((class, 0, old));
            self.chosen[at] = alternative;
            return;
        }
        self.price[at] = UNKNOWN;
        self.alternatives.operands(alternative).for_each(|operand| self.take(operand));
        self.price[at] = 0;
        self.log.push((class, self.uses[at], old));
        self.chosen[at] = alternative;
        self.cost = self.cost + self.alternatives.alternative(alternative).cost
            - self.alternatives.alternative(old).cost;
        self.alternatives.operands(old).for_each(|operand| self.drop(operand));
    }

    /// Returns a mark to which [`back`](Self::back) can return.
    pub(super) fn mark(&self) -> (usize, u32) {
        (self.log.len(), self.cost)
    }

    /// Restores the state at a mark.
    pub(super) fn back(&mut self, (length, cost): (usize, u32)) {
        for (class, uses, chosen) in self.log.drain(length..).rev() {
            let at = class as usize;
            (self.uses[at], self.chosen[at]) = (uses, chosen);
            self.price[at] = if uses > 0 { 0 } else { self.estimate[at] };
        }
        self.cost = cost;
    }

    /// Clears the undo log, which invalidates all marks.
    pub(super) fn forget(&mut self) {
        self.log.clear();
    }

    /// Returns the estimated cost of an alternative.
    pub(super) fn seems(&self, alternative: u32) -> u32 {
        self.alternatives.alternative(alternative).price(&self.price).min(UNKNOWN)
    }

    /// Returns the cost of a class including all operands that nothing else uses.
    pub(super) fn alone(&mut self, class: u32) -> u32 {
        let alternative = self.alternative(class);
        let [first, second] = self.alternatives.alternative(alternative).operands;
        let is_shared = |operand: u32| self.uses.get(operand as usize).is_none_or(|uses| *uses > 1);
        if first != second && is_shared(first) && is_shared(second) {
            return self.alternatives.alternative(alternative).cost;
        }
        let mark = self.mark();
        self.alternatives.operands(alternative).for_each(|operand| self.drop(operand));
        let alone = self.alternatives.alternative(alternative).cost + mark.1 - self.cost;
        self.back(mark);
        alone
    }

    /// Estimates the costs of all unused classes.
    pub(super) fn estimate(&mut self) {
        for (price, uses) in self.price.iter_mut().zip(&self.uses) {
            *price = if *uses > 0 { 0 } else { UNKNOWN };
        }
        // First visit all classes in order, operands before users as far as possible. Then revisit,
        // again in this order, the users of classes whose cost has decreased. Without this order
        // prices would decrease many times along every path.
        let count = self.alternatives.count();
        let mut open = vec![false; count];
        let mut first = count;
        for class in 0..count {
            if self.lower(class as u32) {
                for user in
                    self.alternatives.users(class as u32).iter().take_while(|user| **user as usize <= class)
                {
                    open[*user as usize] = true;
                    first = first.min(*user as usize);
                }
            }
        }
        while first < count {
            for class in std::mem::replace(&mut first, count)..count {
                if !std::mem::take(&mut open[class]) || !self.lower(class as u32) {
                    continue;
                }
                for user in self.alternatives.users(class as u32) {
                    open[*user as usize] = true;
                    if *user as usize <= class {
                        first = first.min(*user as usize);
                    }
                }
            }
        }
        self.estimate.copy_from_slice(&self.price);
    }

    /// Lowers the price of a class to its cheapest alternative; returns `true` if it decreased.
    fn lower(&mut self, class: u32) -> bool {
        let alternatives = self.alternatives.list(class).iter();
        let least =
            alternatives.fold(UNKNOWN, |least, alternative| least.min(alternative.price(&self.price)));
        let price = &mut self.price[class as usize];
        let is_less = least < *price;
        *price = least.min(*price);
        is_less
    }

    /// Returns `true` if any of these classes depends on itself.
    pub(super) fn are_circular(&self, classes: impl Iterator<Item = u32>) -> bool {
        const OPEN: u8 = 1;
        const DONE: u8 = 2;
        let mut states = vec![0; self.alternatives.count()];
        let mut stack: Vec<u32> = classes.collect();
        while let Some(&class) = stack.last() {
            if states[class as usize] != 0 {
                states[class as usize] = DONE;
                stack.pop();
                continue;
            }
            states[class as usize] = OPEN;
            for operand in self.alternatives.operands(self.alternative(class)) {
                match states[operand as usize] {
                    OPEN => return true,
                    DONE => {}
                    _ => stack.push(operand),
                }
            }
        }
        false
    }
}
