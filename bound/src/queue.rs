//! Queue of the boxes of a search.

use std::collections::BTreeMap;

/// Items by a bound: that with the least bound comes first, among equal bounds the oldest.
pub(crate) struct Queue<T> {
    items: BTreeMap<(i64, usize), T>,
    pushed: usize,
}

impl<T> Default for Queue<T> {
    fn default() -> Self {
        Self { items: BTreeMap::new(), pushed: 0 }
    }
}

impl<T> Queue<T> {
    pub(crate) fn push(&mut self, bound: f64, item: T) {
        self.pushed += 1;
        // Integers in the total order of the numbers, as `f64::total_cmp` compares them.
        let bits = bound.to_bits() as i64;
        self.items.insert((bits ^ (((bits >> 63) as u64) >> 1) as i64, self.pushed), item);
    }

    pub(crate) fn first(&self) -> Option<&T> {
        self.items.first_key_value().map(|(_, item)| item)
    }

    pub(crate) fn pop(&mut self) -> Option<T> {
        self.items.pop_first().map(|(_, item)| item)
    }
}
