//! The answer in a few sentences: how large the error is, which source it is of, and where.

use abbe::analysis::Extreme;

use super::ledger::{self, Entry};
use super::report::Report;
use crate::number::{self, percent, unbroken};

/// How many sources are named.
const NAMED: usize = 3;

impl Report {
    /// The largest error of all sources together, and the sources that make most of it; nothing if there is none.
    pub fn summary(&self) -> Vec<String> {
        let [.., all, _] = ledger::sums(self);
        if self.budget.sources.is_empty() || all.largest.value == 0.0 {
            return Vec::new();
        }
        let share = match self.study.tolerance {
            Some(tolerance) => format!(
                ", {} of the tolerance of {}",
                percent(all.largest.value, tolerance),
                number::length(tolerance, self.spec.length)
            ),
            None => String::new(),
        };
        let bounds = match self.budget.combined.random_radius.value {
            0.0 => "",
            _ => ", random sources at their bounds",
        };
        let largest = all.largest;
        let together =
            format!("Largest error{bounds}: {}{share}{}.", self.show(largest.value), self.place(largest));
        let sources = ledger::sources(self);
        let name =
            |Entry { name, largest, .. }: &Entry<'_>| format!("\"{name}\", {}", self.show(largest.value));
        let mut named = sources.iter().filter(|entry| entry.largest.value > 0.0);
        let Some(first) = named.next() else { return vec![together] };
        let mut most = format!("Most of it: {}{}", name(first), self.place(first.largest));
        for next in named.take(NAMED - 1) {
            most += &format!("; then {}", name(next));
        }
        vec![together, most + "."]
    }

    /// ` at q1 = …`; nothing where all configurations are as good.
    fn place(&self, largest: Extreme) -> String {
        let worst = self.configuration(largest.configuration);
        worst.map(|worst| format!(", at {}", unbroken(&self.label(worst)))).unwrap_or_default()
    }
}
