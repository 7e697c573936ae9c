//! The tables of an analysis.

use abbe::analysis::Figures;
use abbe_study::analyze::Report;
use abbe_study::number::{self, fixed, short};
use abbe_study::study_file::{CombinedFigure, Metric, Subject};

use super::super::Table;

/// Three metrics of every source, and under each what is published on it.
pub(super) fn sources(report: &Report) -> String {
    let mut table = Table::new(&["source", "metric", "x", "y", "z", "norm", ""]);
    for source in &report.sources {
        let mut lines = Lines::default();
        for (name, metric) in Metric::ALL {
            let Figures { x, y, z, norm } = source.figures(metric);
            lines.figures(report, name, [x, y, z, norm].map(Some));
            lines.published(report, &Subject::Source(source.name.clone(), metric));
        }
        let (class, distribution) = number::class(source.class);
        let class = distribution.map_or(class.to_owned(), |distribution| format!("{class}, {distribution}"));
        lines.cells[0] = vec![source.name.clone(), class, source.at.clone()];
        table.row(lines.joined());
    }
    table.right(&[2, 3, 4, 5]).unwrapped(&[1, 6]).to_string()
}

pub(super) fn combined(report: &Report) -> String {
    let mut table = Table::new(&["", "x", "y", "z", "norm", ""]);
    let names = [
        (CombinedFigure::Repeatable, "repeatable: signed sum"),
        (CombinedFigure::Random, "random: root sum of squares"),
        (CombinedFigure::Both, "total: repeatable + random"),
    ];
    for (figure, name) in names {
        let ([x, y, z], norm) = report.combined_figure(figure);
        let mut lines = Lines::default();
        lines.figures(report, name, [x, y, z, Some(norm)]);
        lines.published(report, &Subject::Combined(figure));
        table.row(lines.joined().split_off(1));
    }
    let all = &report.combined;
    for (name, axes, norm) in [
        ("random: standard deviation", all.standard_deviation, all.standard_radius),
        ("worst case: sum of absolute values", all.worst_case, all.worst_case_radius),
    ] {
        let mut lines = Lines::default();
        let [x, y, z] = axes.map(Some);
        lines.figures(report, name, [x, y, z, Some(norm)]);
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

    fn figures(&mut self, report: &Report, name: &str, figures: [Option<f64>; 4]) {
        let decimals = report.decimals();
        let [x, y, z, norm] =
            figures.map(|figure| figure.map_or_else(String::new, |value| fixed(value, decimals)));
        self.push([name.to_owned(), x, y, z, norm, String::new()]);
    }

    /// Adds the published figure of a subject, if there is one.
    fn published(&mut self, report: &Report, subject: &Subject) {
        let Some(published) = report.published(subject) else { return };
        let [x, y, z, norm] = published.figures.map(|figure| figure.map_or("–".to_owned(), short));
        self.push([format!("  {}", report.publisher()), x, y, z, norm, published.agreement.text(report)]);
    }

    fn joined(self) -> Vec<String> {
        self.cells.map(|lines| lines.join("\n")).into()
    }
}
