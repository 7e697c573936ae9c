//! Writes `[covariance]`, the joint covariance of the identified errors, for the spec of the
//! identified machine.

use abbe_spec::Spec;
use abbe_spec::edit::TableText;
use abbe_spec::edit::write::{lines, list, number, quoted};

use super::found_model::FoundModel;
use super::spec_writer::{ABOVE, constant_name, source_name};

/// Identified value: its name in the spec, its row in the covariance, and the divisor that makes it
/// relative to a magnitude.
struct Entry {
    text: String,
    row: usize,
    size: f64,
}

impl FoundModel {
    /// Returns the table for all values that are written to the spec; empty if there are none.
    pub(super) fn covariance_table(&self, spec: &Spec) -> String {
        let entries = self.entries(spec);
        if entries.is_empty() {
            return String::new();
        }
        let covariance = |i: usize, j: usize| {
            // Reads one triangle only, so that the written matrix is exactly symmetric.
            let (a, b) = (&entries[i.min(j)], &entries[i.max(j)]);
            number(self.covariance[a.row][b.row] / (a.size * b.size), 5)
        };
        let row = |i: usize| list((0..entries.len()).map(|j| covariance(i, j)));
        let keys = TableText::with_header(&format!("\n{}[covariance]", ABOVE[1]));
        let keys = keys.key("of", lines(entries.iter().map(|entry| format!("{{ {} }}", entry.text))));
        keys.key("rows", lines((0..entries.len()).map(row))).to_string()
    }

    fn entries(&self, spec: &Spec) -> Vec<Entry> {
        let frames = spec.frames.iter().zip(&self.frames);
        let constants = frames.flat_map(|(frame, errors)| {
            let source = source_name(spec, &constant_name(&frame.name));
            errors.iter().map(move |error| {
                let text = format!("source = {}, error = \"{}\"", quoted(&source), error.component.name());
                Entry { text, row: error.row, size: 1.0 }
            })
        });
        let whole = |name: &str, row: usize, size: f64| {
            // A relative deviation of a magnitude of zero is undefined.
            (size != 0.0).then(|| Entry { text: format!("source = {}", quoted(name)), row, size })
        };
        let written = self.terms.iter().filter(|found| self.is_expressible(spec, found));
        // A compliance matrix has no single magnitude.
        let written = written.filter(|found| !self.is_in_full_compliance(found));
        let terms = self.numbers.iter().chain(written);
        let terms = terms.filter_map(|found| {
            whole(&source_name(spec, &self.term_name(spec, found)), found.row, found.magnitude)
        });
        let magnitudes = self
            .magnitudes
            .iter()
            .filter_map(|found| whole(&spec.sources[found.source].name, found.row, found.magnitude));
        let profiles = self.profiles.iter().map(|(row, one)| {
            let source = quoted(&source_name(spec, &one.source_name()));
            let text = format!("source = {source}, joint = {}", quoted(&one.joint));
            Entry { text, row: *row, size: 1.0 }
        });
        constants.chain(terms).chain(magnitudes).chain(profiles).collect()
    }
}
