//! The answer in a few sentences: how large the error is, which source it is of, and where.

use super::report::{Ledger, LedgerEntry, Report};
use crate::number::{self, percent, unbroken};

/// How many sources are named.
const NAMED: usize = 3;

impl Report {
    /// The largest error of all sources together, and the sources that make most of it; nothing if there is none.
    pub fn summary(&self) -> Vec<String> {
        let Ledger { sources, sums: [.., all, _] } = &self.ledger;
        if sources.is_empty() || all.max == 0.0 {
            return Vec::new();
        }
        let share = match self.position_tolerance {
            Some(tolerance) => format!(
                ", {} of the tolerance of {}",
                percent(all.max, tolerance),
                number::length(tolerance, self.spec.length)
            ),
            None => String::new(),
        };
        let bounds = match self.combined.radii.random_radius {
            0.0 => "",
            _ => ", random sources at their bounds",
        };
        let together = format!("Largest error{bounds}: {}{share}{}.", self.show(all.max), self.place(all));
        let name = |LedgerEntry { name, max, .. }: &LedgerEntry| format!("\"{name}\", {}", self.show(*max));
        let mut named = sources.iter().filter(|entry| entry.max > 0.0);
        let Some(first) = named.next() else { return vec![together] };
        let mut most = format!("Most of it: {}{}", name(first), self.place(first));
        for next in named.take(NAMED - 1) {
            most += &format!("; then {}", name(next));
        }
        vec![together, most + "."]
    }

    /// ` at q1 = …`; nothing where all configurations are as good.
    fn place(&self, entry: &LedgerEntry) -> String {
        let worst = self.configuration(entry.configuration);
        worst.map(|worst| format!(", at {}", unbroken(&self.label(worst)))).unwrap_or_default()
    }
}
