//! Summary in a few sentences: the largest error, its main sources, and the worst configuration.

use super::report::{Ledger, LedgerEntry, Report};
use crate::number::{self, percent, unbroken};

/// Number of sources that are named.
const NAMED: usize = 3;

impl Report {
    /// Returns sentences on the largest combined error and the sources that cause most of it; empty
    /// if there is no error.
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
        let together = format!("Largest error{bounds}: {}{share}{}.", self.show(all.max), self.location(all));
        let name = |LedgerEntry { name, max, .. }: &LedgerEntry| format!("\"{name}\", {}", self.show(*max));
        let mut named = sources.iter().filter(|entry| entry.max > 0.0);
        let Some(first) = named.next() else { return vec![together] };
        let mut most = format!("Most of it: {}{}", name(first), self.location(first));
        for next in named.take(NAMED - 1) {
            most += &format!("; then {}", name(next));
        }
        vec![together, most + "."]
    }

    /// Returns `, at q1 = …`; empty without a worst configuration.
    fn location(&self, entry: &LedgerEntry) -> String {
        let worst = self.configuration(entry.configuration);
        worst.map(|worst| format!(", at {}", unbroken(&self.label(worst)))).unwrap_or_default()
    }
}
