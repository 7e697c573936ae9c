//! Writes `[undetermined]`, the errors that the measurements could not determine, for the spec of
//! the identified machine.

use abbe_spec::Spec;
use abbe_spec::edit::TableText;
use abbe_spec::edit::write::{lines, list, number, quoted};

use super::found_model::FoundModel;
use super::spec_writer::{ABOVE, DIGITS, source_name};
use super::undetermined::{Column, UndeterminedDirections};

impl FoundModel {
    /// Returns the table `[undetermined]` for the spec; empty if everything is determined.
    pub(super) fn undetermined_table(&self, spec: &Spec) -> String {
        let UndeterminedDirections { points, of, rows } = &self.undetermined;
        let entries = of.iter().enumerate();
        let entries = entries.filter_map(|(i, column)| Some((i, self.column(spec, *column)?)));
        let entries: Vec<(usize, (String, f64))> = entries.collect();
        if rows.is_empty() || entries.is_empty() {
            return String::new();
        }
        let numbers = |numbers: &mut dyn Iterator<Item = f64>| list(numbers.map(|n| number(n, DIGITS)));
        let row = |row: &Vec<f64>| numbers(&mut entries.iter().map(|(i, (_, size))| row[*i] / size));
        let keys = TableText::with_header(&format!("\n{}[undetermined]", ABOVE[2]));
        let keys = keys.key("points", lines(points.iter().map(|point| numbers(&mut point.iter().copied()))));
        let keys = keys.key("of", lines(entries.iter().map(|(_, (text, _))| format!("{{ {text} }}"))));
        keys.key("rows", lines(rows.iter().map(row))).to_string()
    }

    /// Returns a column as the spec names it, and the divisor of its numbers; none for what the
    /// spec does not have.
    fn column(&self, spec: &Spec, column: Column) -> Option<(String, f64)> {
        let source =
            |name: &str, size: f64| (size != 0.0).then(|| (format!("source = {}", quoted(name)), size));
        match column {
            Column::Base(component) => Some((format!("error = \"{}\"", component.name()), 1.0)),
            Column::Error(frame, component) => {
                let frame = quoted(&spec.frames[frame].name);
                Some((format!("frame = {frame}, error = \"{}\"", component.name()), 1.0))
            }
            Column::Held(of, size) => source(&spec.sources[of].name, size),
            Column::Fitted(row) => {
                let own = self.magnitudes.iter().find(|found| found.row == row);
                let term = self.terms.iter().find(|found| {
                    found.row == row && self.is_expressible(spec, found) && !self.is_in_full_compliance(found)
                });
                match (own, term) {
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
