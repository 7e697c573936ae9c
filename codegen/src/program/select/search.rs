//! Which way each class is computed in: what is used how often, what that takes in all, and the way back.

use super::ways::Ways;

/// More than anything takes.
const UNKNOWN: u32 = u32::MAX / 4;

pub(super) struct Search<'w> {
    pub(super) ways: &'w Ways,
    chosen: Vec<u32>,
    uses: Vec<u32>,
    /// What all that is used takes.
    pub(super) cost: u32,
    /// What a class would take that is not used: as it was estimated last, and nothing while it is used.
    price: Vec<u32>,
    estimate: Vec<u32>,
    /// Whether the way of a class stays when it comes into use.
    pub(super) held: Vec<bool>,
    /// Whether it stays at all times.
    fixed: Vec<bool>,
    /// What was before: class, uses, way.
    log: Vec<(u32, u32, u32)>,
}

impl<'w> Search<'w> {
    /// Uses the outputs.
    pub(super) fn new(ways: &'w Ways, chosen: Vec<u32>, fixed: Vec<bool>) -> Self {
        let count = ways.count();
        let mut search = Self {
            ways,
            chosen,
            uses: vec![0; count],
            cost: 0,
            // After all classes there is what a way does not use.
            price: vec![0; count + 1],
            estimate: vec![0; count + 1],
            held: vec![true; count],
            fixed,
            log: Vec::new(),
        };
        ways.outputs.iter().for_each(|output| search.take(*output));
        search.held.fill(false);
        search.estimate();
        search
    }

    /// The way of each class.
    pub(super) fn chosen(&self) -> impl Iterator<Item = u32> {
        self.chosen.iter().copied()
    }

    pub(super) fn way(&self, class: u32) -> u32 {
        self.chosen[class as usize]
    }

    /// Whether the way of a class may be another one.
    pub(super) fn is_free(&self, class: u32) -> bool {
        !self.fixed[class as usize]
    }

    pub(super) fn is_used(&self, class: u32) -> bool {
        self.uses[class as usize] > 0
    }

    /// What a class that is not used was estimated to take.
    pub(super) fn estimated(&self, class: u32) -> u32 {
        self.estimate[class as usize]
    }

    /// One more use of a class. What was not used comes to be computed in the way that seems to take the least.
    pub(super) fn take(&mut self, class: u32) {
        let at = class as usize;
        self.log.push((class, self.uses[at], self.chosen[at]));
        self.uses[at] += 1;
        if self.uses[at] > 1 {
            return;
        }
        // Nothing that it uses may use it.
        self.price[at] = UNKNOWN;
        if !self.held[at] && !self.fixed[at] {
            let ways = self.ways.of(class);
            if ways.len() > 1 {
                let best = ways.min_by_key(|way| self.seems(*way));
                self.chosen[at] = best.unwrap_or(self.chosen[at]);
            }
        }
        let way = self.chosen[at];
        self.cost += self.ways.way(way).cost;
        self.ways.operands(way).for_each(|operand| self.take(operand));
        self.price[at] = 0;
    }

    /// One use less.
    pub(super) fn drop(&mut self, class: u32) {
        let at = class as usize;
        self.log.push((class, self.uses[at], self.chosen[at]));
        self.uses[at] -= 1;
        if self.uses[at] == 0 {
            self.price[at] = self.estimate[at];
            let way = self.chosen[at];
            self.cost -= self.ways.way(way).cost;
            self.ways.operands(way).for_each(|operand| self.drop(operand));
        }
    }

    /// Another way for a class.
    pub(super) fn change(&mut self, class: u32, way: u32) {
        let at = class as usize;
        let old = self.chosen[at];
        if self.uses[at] == 0 {
            self.log.push((class, 0, old));
            self.chosen[at] = way;
            return;
        }
        self.price[at] = UNKNOWN;
        self.ways.operands(way).for_each(|operand| self.take(operand));
        self.price[at] = 0;
        self.log.push((class, self.uses[at], old));
        self.chosen[at] = way;
        self.cost = self.cost + self.ways.way(way).cost - self.ways.way(old).cost;
        self.ways.operands(old).for_each(|operand| self.drop(operand));
    }

    /// From here there is a way back.
    pub(super) fn mark(&self) -> (usize, u32) {
        (self.log.len(), self.cost)
    }

    /// Back to a mark.
    pub(super) fn back(&mut self, (length, cost): (usize, u32)) {
        for (class, uses, chosen) in self.log.drain(length..).rev() {
            let at = class as usize;
            (self.uses[at], self.chosen[at]) = (uses, chosen);
            self.price[at] = if uses > 0 { 0 } else { self.estimate[at] };
        }
        self.cost = cost;
    }

    /// There is no way back to marks that were made.
    pub(super) fn forget(&mut self) {
        self.log.clear();
    }

    /// What a way seems to take.
    pub(super) fn seems(&self, way: u32) -> u32 {
        self.ways.way(way).price(&self.price).min(UNKNOWN)
    }

    /// What a class takes that nothing else needs.
    pub(super) fn alone(&mut self, class: u32) -> u32 {
        let way = self.way(class);
        let [first, second] = self.ways.way(way).operands;
        let is_shared = |operand: u32| self.uses.get(operand as usize).is_none_or(|uses| *uses > 1);
        if first != second && is_shared(first) && is_shared(second) {
            return self.ways.way(way).cost;
        }
        let mark = self.mark();
        self.ways.operands(way).for_each(|operand| self.drop(operand));
        let alone = self.ways.way(way).cost + mark.1 - self.cost;
        self.back(mark);
        alone
    }

    /// Estimates what every class would take that is not used.
    pub(super) fn estimate(&mut self) {
        for (price, uses) in self.price.iter_mut().zip(&self.uses) {
            *price = if *uses > 0 { 0 } else { UNKNOWN };
        }
        // Each after what it uses, as far as that goes; then, in this order again, whatever uses what was found to take less. As soon as
        // that is found, and not in this order, prices would fall again and again, along every way to what they are of.
        let count = self.ways.count();
        let mut open = vec![false; count];
        let mut first = count;
        for class in 0..count {
            if self.lower(class as u32) {
                for user in self.ways.users(class as u32).iter().take_while(|user| **user as usize <= class) {
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
                for user in self.ways.users(class as u32) {
                    open[*user as usize] = true;
                    if *user as usize <= class {
                        first = first.min(*user as usize);
                    }
                }
            }
        }
        self.estimate.copy_from_slice(&self.price);
    }

    /// Whether a class takes less than it was estimated to.
    fn lower(&mut self, class: u32) -> bool {
        let ways = self.ways.list(class).iter();
        let least = ways.fold(UNKNOWN, |least, way| least.min(way.price(&self.price)));
        let price = &mut self.price[class as usize];
        let is_less = least < *price;
        *price = least.min(*price);
        is_less
    }

    /// Whether any of these classes uses itself, or what it uses does.
    pub(super) fn are_circular(&self, classes: impl Iterator<Item = u32>) -> bool {
        const OPEN: u8 = 1;
        const DONE: u8 = 2;
        let mut states = vec![0; self.ways.count()];
        let mut stack: Vec<u32> = classes.collect();
        while let Some(&class) = stack.last() {
            if states[class as usize] != 0 {
                states[class as usize] = DONE;
                stack.pop();
                continue;
            }
            states[class as usize] = OPEN;
            for operand in self.ways.operands(self.way(class)) {
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
