//! Figure of an analysis: its data with title and file name.

use crate::unit;
use abbe::analysis::Measurand;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::{Figure, FigureData, Range};
use abbe_study::study_file::{self, CombinedFigure, Content, Metric};

use super::Quantity;

/// Figure of an analysis with title and file name.
pub(crate) struct NamedFigure<'a> {
    pub(crate) request: &'a study_file::Figure,
    /// File name without extension, unique in the report.
    pub(crate) name: String,
    pub(crate) title: String,
    /// Sentence about a workspace of its own; empty if it has none.
    pub(crate) workspace_note: String,
    /// True if the figure shows only bounds of random errors.
    pub(crate) bounds: bool,
    pub(crate) data: &'a FigureData,
}

/// Published figure: its range, and its label.
pub(super) struct PublishedRange {
    pub(super) range: Range,
    /// Label with the publisher.
    pub(super) label: String,
}

impl<'a> NamedFigure<'a> {
    /// Names the figures of a report, in their order.
    pub(crate) fn all(figures: &'a [Figure], report: &Report) -> Vec<Self> {
        let mut stems = Vec::new();
        let named = figures.iter().map(|figure| {
            let mut named = Self::new(figure, report);
            stems.push(named.name.clone());
            // Names that differ only in punctuation would have the same file name.
            let same = stems.iter().filter(|stem| **stem == named.name).count();
            if same > 1 {
                named.name = format!("{}-{same}", named.name);
            }
            named
        });
        named.collect()
    }

    /// Derives title and file name from the content.
    fn new(figure: &'a Figure, report: &Report) -> Self {
        let Figure { request, bounds, own_workspace, data } = figure;
        let of = request.source.as_deref().unwrap_or("all sources");
        let kept = if *bounds { "all random sources" } else { "all repeatable sources" };
        let kept = request.source.as_deref().unwrap_or(kept);
        let over = |over| Quantity::over(over, &report.spec).name;
        let (kind, overs, title) = match request.content {
            Content::Travel(first) => ("travel", vec![over(first)], format!("{of} over {}", over(first))),
            Content::Surface([first, second]) => {
                let [first, second] = [over(first), over(second)];
                let title = format!("{of} over {first} and {second}");
                ("surface", vec![first, second], title)
            }
            Content::Cloud => (
                "cloud",
                Vec::new(),
                format!("{} in space: {kept}", if *bounds { "Bounds" } else { "Errors" }),
            ),
            Content::Histogram => ("histogram", Vec::new(), format!("Distribution of errors: {kept}")),
            Content::Pareto => ("pareto", Vec::new(), "Share of each source".to_owned()),
            Content::Manipulator(_) => ("manipulator", Vec::new(), "Frames at home".to_owned()),
        };
        let (rows, title) = match request.measurand {
            Measurand::Position => (None, title),
            Measurand::Orientation => (Some("orientation".to_owned()), format!("orientation: {title}")),
        };
        let words = [kind.to_owned()].into_iter().chain(rows).chain(request.source.clone()).chain(overs);
        let workspace_note = own_workspace.map(|[reached, unreached]| {
            format!("Own workspace: {reached} configurations, {unreached} unreachable.")
        });
        Self {
            request,
            name: words.map(|word| slug(&word)).collect::<Vec<_>>().join("-"),
            title: capital(&title),
            workspace_note: workspace_note.unwrap_or_default(),
            bounds: *bounds,
            data,
        }
    }

    /// Returns the published range on one axis of this figure's source, in the unit of the spec.
    ///
    /// `found` is the computed range on this axis: half peak-to-peak values are centered on its
    /// middle.
    pub(super) fn published_range(
        &self,
        axis: usize,
        found: Range,
        report: &Report,
    ) -> Option<PublishedRange> {
        // Published figures are positions.
        let name =
            self.request.source.as_deref().filter(|_| self.request.measurand == Measurand::Position)?;
        let published = report.study.published.iter().find_map(|published| match &published.subject {
            study_file::Subject::Source(of, metric) if of == name => {
                Some((published.figures[axis]?, *metric))
            }
            _ => None,
        });
        let (value, metric) = published?;
        let (middle, about) = match metric {
            Metric::PlainMaximum => (0.0, ""),
            Metric::HalfPeakToPeak => (found.middle(), " about the mean of the range"),
            // This metric is about differences from home, which the figure does not show.
            Metric::RelativeToHome => return None,
        };
        let errors = self.errors(report);
        let shown = abbe_study::number::short(errors.show(value));
        Some(PublishedRange {
            range: Range { least: middle - value, largest: middle + value },
            label: format!("{}: ±{shown} {}{about}", report.publisher(), errors.unit),
        })
    }

    /// Returns the published total of all sources, if the figure shows all sources over the whole
    /// workspace.
    pub(super) fn published_total(&self, report: &Report) -> Option<f64> {
        let radius = study_file::Subject::Combined(CombinedFigure::Both);
        let published = report.study.published.iter().find(|published| published.subject == radius);
        let all = self.request.source.is_none() && self.request.region.is_none();
        published.filter(|_| all && self.request.measurand == Measurand::Position)?.figures[3]
    }

    /// Returns the unit of the errors.
    pub(super) fn errors(&self, report: &Report) -> Quantity {
        Quantity::errors(self.request.measurand, &report.spec)
    }

    /// Returns the names of the three rows.
    pub(super) fn rows(&self, report: &Report) -> [&'static str; 3] {
        unit::row_names(report, self.request.measurand)
    }

    /// Returns the remark on random errors, if it is needed.
    pub(super) fn remark(&self) -> &'static str {
        if self.request.source.is_none() && !self.bounds { ", including random errors" } else { "" }
    }

    /// Returns "bound" for random sources, "error" otherwise.
    pub(super) fn what(&self) -> &'static str {
        if self.bounds { "bound" } else { "error" }
    }
}

fn slug(text: &str) -> String {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty());
    words.map(str::to_ascii_lowercase).collect::<Vec<_>>().join("-")
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
