//! The tables of an analysis.

use abbe::analysis::Admissible;

use super::agreement::{Agreement, of_source};
use super::{Analysis, json};
use crate::table::{Listing, Table};
use abbe_study::number::{self, error_decimals, fixed, short};
use abbe_study::study_file::{CombinedFigure, Metric, Published};

impl Analysis<'_> {
    /// How many decimals errors have: three digits of the smallest source that matters.
    pub(super) fn decimals(&self) -> usize {
        let least = error_decimals(self.description.length);
        let negligible = 1e-6 * self.budget.combined.radius.value;
        let norms = self.budget.sources.iter().map(|errors| errors.plain_max.norm);
        let smallest = norms.filter(|norm| *norm > negligible).fold(f64::INFINITY, f64::min);
        let needed = 2.0 - smallest.log10().floor();
        (needed.max(0.0) as usize).clamp(least, least + 4)
    }
}

/// Three metrics of every source, and under each what is published on it.
pub(super) fn sources(analysis: &Analysis) -> String {
    let mut table = Table::new(&["source", "metric", "x", "y", "z", "norm", ""]);
    for errors in &analysis.budget.sources {
        let source = &analysis.description.sources[errors.source];
        let mut lines = Lines::default();
        for (name, metric) in Metric::ALL {
            let figures = of_source(errors, metric);
            lines.figures(analysis, name, figures.map(Some));
            if let Some(published) = analysis.published_of(&source.name, metric) {
                lines.published(analysis, figures, published);
            }
        }
        let (class, distribution) = json::class(source.class);
        let class = distribution.map_or(class.to_owned(), |distribution| format!("{class}, {distribution}"));
        lines.cells[0] = vec![source.name.to_string(), class];
        table.row(lines.joined());
    }
    table.right(&[2, 3, 4, 5]).unwrapped(&[1, 6]).to_string()
}

/// What the tolerance allows each source, and what is gained by making it smaller.
pub(super) fn allowed(analysis: &Analysis, admissible: &Admissible) -> Listing {
    let times = |scale: Option<f64>| {
        scale.map_or("any".to_owned(), |scale| format!("× {}", number::digits(scale, 3)))
    };
    let row = |source: usize| {
        vec![
            analysis.description.sources[source].name.to_string(),
            times(admissible.alone[source]),
            times(admissible.equal[source]),
            fixed(analysis.budget.gains[source], analysis.decimals() + 1),
        ]
    };
    let rows = analysis.budget.tighten_first().into_iter().map(row).collect();
    Listing {
        header: vec!["source", "alone at most", "equal shares", "gain per percent"],
        rows,
        numbers: 1..4,
    }
}

pub(super) fn combined(analysis: &Analysis) -> String {
    let mut table = Table::new(&["", "x", "y", "z", "norm", ""]);
    let names = [
        (CombinedFigure::Repeatable, "repeatable: sum, with signs"),
        (CombinedFigure::Random, "random: root sum of squares"),
        (CombinedFigure::Both, "radius: both norms, added"),
    ];
    for (figure, name) in names {
        let ([x, y, z], norm) = analysis.combined(figure);
        let mut lines = Lines::default();
        lines.figures(analysis, name, [x, y, z, Some(norm)]);
        if let Some(published) = analysis.published_combined(figure) {
            lines.published(analysis, [0.0, 0.0, 0.0, norm], published);
        }
        table.row(lines.joined().split_off(1));
    }
    let all = &analysis.budget.combined;
    for (name, axes, norm) in [
        ("random: standard deviation", all.standard_deviation, all.standard_radius),
        ("worst case: absolute values, added", all.worst_case, all.worst_case_radius),
    ] {
        let mut lines = Lines::default();
        let [x, y, z] = axes.map(Some);
        lines.figures(analysis, name, [x, y, z, Some(norm.value)]);
        table.row(lines.joined().split_off(1));
    }
    table.right(&[1, 2, 3, 4]).unwrapped(&[0, 5]).to_string()
}

/// The lines of one row of a table, cell by cell: name, metric, x, y, z, norm, verdict.
#[derive(Default)]
struct Lines {
    cells: [Vec<String>; 7],
}

impl Lines {
    fn push(&mut self, line: [String; 6]) {
        for (cell, text) in self.cells[1..].iter_mut().zip(line) {
            cell.push(text);
        }
    }

    fn figures(&mut self, analysis: &Analysis, name: &str, figures: [Option<f64>; 4]) {
        let decimals = analysis.decimals();
        let [x, y, z, norm] =
            figures.map(|figure| figure.map_or_else(String::new, |value| fixed(value, decimals)));
        self.push([name.to_owned(), x, y, z, norm, String::new()]);
    }

    fn published(&mut self, analysis: &Analysis, found: [f64; 4], published: &Published) {
        let [x, y, z, norm] = published.figures.map(|figure| figure.map_or("–".to_owned(), short));
        let verdict = Agreement::of(found, published).text(analysis);
        self.push([format!("  {}", analysis.publisher()), x, y, z, norm, verdict]);
    }

    fn joined(self) -> Vec<String> {
        self.cells.map(|lines| lines.join("\n")).into()
    }
}
