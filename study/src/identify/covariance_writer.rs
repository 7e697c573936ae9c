//! `[covariance]` of the identified machine's spec: how well its errors are known, all together.

use abbe_spec::Spec;

use super::found::FoundModel;
use super::spec_writer::{ABOVE, constant_name};

/// Something that was found as the spec names it, where it stands in the covariance, and what that is to be divided by.
struct Entry {
    text: String,
    place: usize,
    size: f64,
}

impl FoundModel {
    /// The table, of all that is written.
    pub(super) fn covariance_table(&self, spec: &Spec) -> String {
        let entries = self.entries(spec);
        if entries.is_empty() {
            return String::new();
        }
        let of: String = entries.iter().map(|entry| format!("  {{ {} }},\n", entry.text)).collect();
        let covariance = |i: usize, j: usize| {
            // The same above and below the diagonal, digit by digit.
            let (a, b) = (&entries[i.min(j)], &entries[i.max(j)]);
            let value = self.covariance[a.place][b.place] / (a.size * b.size);
            format!("{:e}", format!("{value:.4e}").parse::<f64>().unwrap_or(value) + 0.0)
        };
        let row = |i: usize| {
            let numbers: Vec<String> = (0..entries.len()).map(|j| covariance(i, j)).collect();
            format!("  [{}],\n", numbers.join(", "))
        };
        let rows: String = (0..entries.len()).map(row).collect();
        format!("\n{}[covariance]\nof = [\n{of}]\nrows = [\n{rows}]\n", ABOVE[1])
    }

    fn entries(&self, spec: &Spec) -> Vec<Entry> {
        let frames = spec.frames.iter().zip(&self.frames);
        let constants = frames.flat_map(|(frame, errors)| {
            let source = constant_name(spec, &frame.name);
            errors.iter().map(move |error| {
                let text = format!("source = {source:?}, error = {:?}", error.component.name());
                Entry { text, place: error.place, size: 1.0 }
            })
        });
        let whole = |name: &str, place: usize, size: f64| {
            // Of what is nothing no share is known.
            (size != 0.0).then(|| Entry { text: format!("source = {name:?}"), place, size })
        };
        let written = self.terms.iter().filter(|found| self.is_written(spec, found));
        // One number says nothing of a matrix.
        let written = written.filter(|found| !self.is_of_full_compliance(found));
        let terms = self.numbers.iter().chain(written);
        let terms =
            terms.filter_map(|found| whole(&self.term_name(spec, found), found.place, found.magnitude));
        let magnitudes = self
            .magnitudes
            .iter()
            .filter_map(|found| whole(&spec.sources[found.source].name, found.place, found.magnitude));
        constants.chain(terms).chain(magnitudes).collect()
    }
}
