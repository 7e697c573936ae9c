//! A figure of an analysis: what was gathered, with its names.

use abbe::analysis::Measurand;
use abbe_study::analyze::figures::{Figure, Gathered, Range};
use abbe_study::analyze::{Report, unit};
use abbe_study::study_file::{self, CombinedFigure, Content, Metric};

use super::Quantity;

/// A figure, ready to be drawn.
pub(crate) struct Named<'a> {
    pub(crate) asked: &'a study_file::Figure,
    /// The name of its file, without the ending; no two figures of a report have the same.
    pub(crate) name: String,
    pub(crate) title: String,
    /// What is to be said of its own workspace, if it has one.
    pub(crate) workspace_note: String,
    /// Whether there are only bounds to show.
    pub(crate) bounds: bool,
    pub(crate) data: &'a Gathered,
}

/// A published figure to draw: the least and the largest that it allows, and what it is called.
pub(super) struct Printed {
    pub(super) range: Range,
    /// Its name.
    pub(super) label: String,
}

impl<'a> Named<'a> {
    /// The figures of a report, in their order.
    pub(crate) fn all(figures: &'a [Figure], report: &Report) -> Vec<Self> {
        let mut stems = Vec::new();
        let named = figures.iter().map(|figure| {
            let mut named = Self::new(figure, report);
            stems.push(named.name.clone());
            // Names that differ in signs only would be the same file.
            let same = stems.iter().filter(|stem| **stem == named.name).count();
            if same > 1 {
                named.name = format!("{}-{same}", named.name);
            }
            named
        });
        named.collect()
    }

    /// Its file is named by what it shows.
    fn new(figure: &'a Figure, report: &Report) -> Self {
        let Figure { asked, bounds, own_workspace, data } = figure;
        let of = asked.source.as_deref().unwrap_or("all sources");
        let kept = if *bounds { "all random sources" } else { "all repeatable sources" };
        let kept = asked.source.as_deref().unwrap_or(kept);
        let over = |over| Quantity::over(over, &report.spec).name;
        let (kind, overs, title) = match asked.content {
            Content::Travel(first) => ("travel", vec![over(first)], format!("{of}, over {}", over(first))),
            Content::Surface([first, second]) => {
                let [first, second] = [over(first), over(second)];
                let title = format!("{of}, over {first} and {second}");
                ("surface", vec![first, second], title)
            }
            Content::Cloud => (
                "cloud",
                Vec::new(),
                format!("{} in space: {kept}", if *bounds { "Bounds" } else { "Errors" }),
            ),
            Content::Histogram => ("histogram", Vec::new(), format!("How often which error occurs: {kept}")),
            Content::Pareto => ("pareto", Vec::new(), "Share of each source".to_owned()),
            Content::Manipulator(_) => ("manipulator", Vec::new(), "The frames at home".to_owned()),
        };
        let (rows, title) = match asked.measurand {
            Measurand::Position => (None, title),
            Measurand::Orientation => (Some("orientation".to_owned()), format!("orientation: {title}")),
        };
        let words = [kind.to_owned()].into_iter().chain(rows).chain(asked.source.clone()).chain(overs);
        let workspace_note = own_workspace.map(|[reached, unreached]| {
            format!("{reached} configurations of its own, {unreached} unreachable.")
        });
        Self {
            asked,
            name: words.map(|word| slug(&word)).collect::<Vec<_>>().join("-"),
            title: capital(&title),
            workspace_note: workspace_note.unwrap_or_default(),
            bounds: *bounds,
            data,
        }
    }

    /// What is published on one axis of this figure's source, in the unit of the spec.
    ///
    /// `found` is what the axis spans here: half peak-to-peak is drawn about its middle.
    pub(super) fn printed(&self, axis: usize, found: Range, report: &Report) -> Option<Printed> {
        // Nobody prints orientations.
        let name = self.asked.source.as_deref().filter(|_| self.asked.measurand == Measurand::Position)?;
        let published = report.study.published.iter().find_map(|published| match &published.subject {
            study_file::Subject::Source(of, metric) if of == name => {
                Some((published.figures[axis]?, *metric))
            }
            _ => None,
        });
        let (value, metric) = published?;
        let (middle, about) = match metric {
            Metric::PlainMaximum => (0.0, ""),
            Metric::HalfPeakToPeak => (found.middle(), " about the middle"),
            // It stands for differences, which this figure does not show.
            Metric::RelativeToHome => return None,
        };
        let errors = self.errors(report);
        let shown = abbe_study::number::short(errors.show(value));
        Some(Printed {
            range: Range { least: middle - value, largest: middle + value },
            label: format!("{}: ±{shown} {}{about}", report.publisher(), errors.unit),
        })
    }

    /// The radius that is published for all sources together, if this figure shows them.
    pub(super) fn printed_radius(&self, report: &Report) -> Option<f64> {
        let radius = study_file::Subject::Combined(CombinedFigure::Both);
        let published = report.study.published.iter().find(|published| published.subject == radius);
        let all = self.asked.source.is_none() && self.asked.region.is_none();
        published.filter(|_| all && self.asked.measurand == Measurand::Position)?.figures[3]
    }

    /// Its errors, in their unit.
    pub(super) fn errors(&self, report: &Report) -> Quantity {
        Quantity::errors(self.asked.measurand, &report.spec)
    }

    /// The names of the three rows.
    pub(super) fn rows(&self, report: &Report) -> [&'static str; 3] {
        unit::rows(report, self.asked.measurand)
    }

    /// What is done about random errors, if that needs saying.
    pub(super) fn remark(&self) -> &'static str {
        if self.asked.source.is_none() && !self.bounds { ", random errors added" } else { "" }
    }

    /// What the errors are called.
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
