//! A figure as it is drawn: what was gathered, with its names.

use super::axis::Axis;
use super::data::extremes::Range;
use super::data::gather::Gathered;
use super::subject::Subject;
use abbe_study::study_file::{self, CombinedFigure, Content, Metric};

/// A figure, ready to be drawn.
pub(super) struct Figure<'a> {
    pub(super) asked: &'a study_file::Figure,
    /// What it shows, as words of a file name.
    pub(super) stem: String,
    /// The name of its file, without the ending; no two figures of a report have the same.
    pub(super) name: String,
    pub(super) title: String,
    /// What is to be said of its own workspace, if it has one.
    pub(super) workspace_note: String,
    /// Index of its source; all together if there is none.
    pub(super) source: Option<usize>,
    /// Whether there are only bounds to show.
    pub(super) bounds: bool,
    pub(super) data: Gathered,
}

/// A published figure to draw: the least and the largest that it allows, and what it is called.
pub(super) struct Printed {
    pub(super) range: Range,
    /// Its name, in short lines.
    pub(super) lines: Vec<String>,
}

impl Printed {
    /// Its name in one line.
    pub(super) fn label(&self) -> String {
        self.lines.join(" ")
    }
}

impl<'a> Figure<'a> {
    pub(super) fn new(
        asked: &'a study_file::Figure,
        source: Option<usize>,
        bounds: bool,
        data: Gathered,
        subject: &Subject,
    ) -> Self {
        let of = asked.source.as_deref().unwrap_or("all sources");
        let kept = if bounds { "all random sources" } else { "all repeatable sources" };
        let kept = asked.source.as_deref().unwrap_or(kept);
        let over = |over| Axis::over(over, subject.description).name;
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
                format!("{} in space: {kept}", if bounds { "Bounds" } else { "Errors" }),
            ),
            Content::Histogram => ("histogram", Vec::new(), format!("How often which error occurs: {kept}")),
            Content::Pareto => ("pareto", Vec::new(), "Share of each source".to_owned()),
            Content::Manipulator(_) => ("manipulator", Vec::new(), "The frames at home".to_owned()),
        };
        let words = [kind.to_owned()].into_iter().chain(asked.source.clone()).chain(overs);
        let stem = words.map(|word| slug(&word)).collect::<Vec<_>>().join("-");
        Self {
            asked,
            name: stem.clone(),
            stem,
            title: capital(&title),
            workspace_note: String::new(),
            source,
            bounds,
            data,
        }
    }

    /// What is published on one axis of this figure's source, in the unit of the spec.
    ///
    /// `found` is what the axis spans here: half peak-to-peak is drawn about its middle.
    pub(super) fn printed(&self, axis: usize, found: Range, subject: &Subject) -> Option<Printed> {
        let name = self.asked.source.as_deref()?;
        let published = subject.study.published.iter().find_map(|published| match &published.subject {
            study_file::Subject::Source(of, metric) if of == name => {
                Some((published.figures[axis]?, *metric))
            }
            _ => None,
        });
        let (value, metric) = published?;
        let (middle, about) = match metric {
            Metric::PlainMaximum => (0.0, ""),
            Metric::HalfPeakToPeak => (found.middle(), "about the middle"),
            // It stands for differences, which this figure does not show.
            Metric::RelativeToHome => return None,
        };
        let errors = Axis::errors("", subject.description.length);
        let shown = abbe_study::number::short(errors.show(value));
        Some(Printed {
            range: Range { least: middle - value, largest: middle + value },
            lines: [
                format!("{}:", subject.publisher()),
                format!("±{shown} {}", errors.unit),
                about.to_owned(),
            ]
            .into_iter()
            .filter(|line| !line.is_empty())
            .collect(),
        })
    }

    /// The radius that is published for all sources together, if this figure shows them.
    pub(super) fn printed_radius(&self, subject: &Subject) -> Option<f64> {
        let radius = study_file::Subject::Combined(CombinedFigure::Both);
        let published = subject.study.published.iter().find(|published| published.subject == radius);
        published.filter(|_| self.source.is_none() && self.asked.region.is_none())?.figures[3]
    }

    /// What is done about random errors, if that needs saying.
    pub(super) fn remark(&self) -> &'static str {
        if self.source.is_none() && !self.bounds { ", random errors added" } else { "" }
    }

    /// What the errors are called.
    pub(super) fn errors(&self) -> &'static str {
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
