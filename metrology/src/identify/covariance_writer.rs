//! Writes `[covariance]`, the covariance of the errors of the identified machine, for its spec.

use abbe::Component;
use abbe_spec::Spec;
use abbe_spec::edit::TableText;
use abbe_spec::edit::write::{lines, list, number, quoted};

use super::found_covariance::Uncertain;
use super::found_model::{FoundModel, FoundTerm};
use super::spec_writer::{ABOVE, source_name};

/// Digits of a covariance: what two errors have in common can be a small part of both.
const DIGITS: usize = 13;

impl FoundModel {
    /// Returns the table for the errors that are written to the spec; empty if there are none.
    pub(super) fn covariance_table(&self, spec: &Spec) -> String {
        // The name of each error, its row, and the divisor that makes it relative to a magnitude.
        let rows = self.covariance.of.iter().enumerate();
        let rows: Vec<(usize, (String, f64))> =
            rows.filter_map(|(i, of)| Some((i, self.named(spec, *of)?))).collect();
        let profiles: Vec<String> = self
            .profiles
            .iter()
            .map(|one| {
                let source = quoted(&source_name(spec, &one.source_name()));
                format!("{{ source = {source}, joint = {} }}", quoted(&one.joint))
            })
            .collect();
        let count = rows.len() + profiles.len();
        if count == 0 {
            return String::new();
        }
        let covariance = |i: usize, j: usize| match (rows.get(i), rows.get(j)) {
            (Some((a, (_, of_a))), Some((b, (_, of_b)))) => self.covariance.between(*a, *b) / (of_a * of_b),
            (None, None) if i == j => self.profiles[i - rows.len()].standard_deviation.powi(2),
            _ => 0.0,
        };
        // Reads one triangle only, so that the written matrix is exactly symmetric.
        let row = |i: usize| list((0..count).map(|j| number(covariance(i.min(j), i.max(j)), DIGITS)));
        let keys = TableText::with_header(&format!("\n{}[covariance]", ABOVE[1]));
        let names = rows.iter().map(|(_, (text, _))| format!("{{ {text} }}")).chain(profiles);
        keys.key("of", lines(names)).key("rows", lines((0..count).map(row))).to_string()
    }

    /// Returns an error as the spec names it, and the divisor of its numbers; none for what the
    /// spec does not have.
    fn named(&self, spec: &Spec, of: Uncertain) -> Option<(String, f64)> {
        // A relative deviation of a magnitude of zero is undefined.
        let source = |name: &str, size| (size != 0.0).then(|| (format!("source = {}", quoted(name)), size));
        let error = |component: Component| format!("error = \"{}\"", component.name());
        match of {
            Uncertain::Base(component) => Some((error(component), 1.0)),
            Uncertain::Error(frame, component) => {
                Some((format!("frame = {}, {}", quoted(&spec.frames[frame].name), error(component)), 1.0))
            }
            Uncertain::Fitted(row) => {
                let own = self.magnitudes.iter().find(|found| found.row == Some(row));
                // A compliance matrix has no single magnitude.
                let is_written = |found: &&FoundTerm| {
                    found.row == row && self.is_expressible(spec, found) && !self.is_in_full_compliance(found)
                };
                match (own, self.terms.iter().find(is_written)) {
                    (Some(own), _) => source(&spec.sources[own.source].name, own.magnitude),
                    (_, Some(term)) => {
                        source(&source_name(spec, &self.term_name(spec, term)), term.magnitude)
                    }
                    _ => None,
                }
            }
        }
    }
}
