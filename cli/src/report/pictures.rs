//! The figures of a study: gathered during the sweep, drawn after it.

use abbe::Description;
use abbe::analysis::{Row, sampling, sweep};

use super::data::gather::Gather;
use super::figure::Figure;
use super::files::Rendered;
use super::html;
use super::subject::Subject;
use super::svg;
use crate::failure::Failure;
use abbe_study::study_file::{Content, Study};

/// The figures of a study, in the making.
pub(crate) struct Pictures<'a> {
    /// Those over the workspace of the study, and those over one of their own.
    figures: Vec<Gather<'a>>,
    /// The titles of those whose source is switched off.
    left_out: Vec<&'a str>,
}

impl<'a> Pictures<'a> {
    /// Begins the figures of a study.
    pub(crate) fn new(study: &'a Study, description: &Description) -> Self {
        // Without sources there is nothing to see but the manipulator.
        let nothing = description.sources.is_empty();
        let asked = study.figures.iter().filter(|figure| {
            !nothing || figure.source.is_some() || matches!(figure.content, Content::Manipulator(_))
        });
        let gathers = asked.map(|figure| (figure, Gather::new(figure, description)));
        let (mut figures, mut left_out) = (Vec::new(), Vec::new());
        for (figure, gather) in gathers {
            match (gather, &figure.source) {
                (None, source) => left_out.extend(source.as_deref()),
                (Some(gather), _) => figures.push(gather),
            }
        }
        Self { figures, left_out }
    }

    /// Takes in what the sweep sees.
    pub(crate) fn add(&mut self, row: &Row) {
        let here = self.figures.iter_mut().filter(|gather| gather.figure.region.is_none());
        here.for_each(|gather| gather.add(row));
    }

    /// Draws the figures and writes the report.
    pub(crate) fn render(self, subject: &Subject) -> Result<Rendered, Failure> {
        let mut figures = Vec::new();
        for mut gather in self.figures {
            let mut workspace_note = String::new();
            if let Some(region) = &gather.figure.region {
                let fail = |error: &dyn std::fmt::Display| Failure::of(&subject.spec.file, error);
                let workspace = region.workspace(subject.manipulator, None).map_err(|error| fail(&error))?;
                let u = sampling::nominal_inputs(subject.description);
                let unreachable = sweep(subject.manipulator, &*workspace, &u, &mut |row| gather.add(row))
                    .map_err(|error| fail(&error))?;
                let (unreached, reached) = (unreachable.count, workspace.len() - unreachable.count);
                workspace_note = format!("{reached} configurations of its own, {unreached} unreachable.");
            }
            let Gather { figure, source, bounds, .. } = gather;
            let mut drawn = Figure::new(figure, source, bounds, gather.finish(), subject);
            drawn.workspace_note = workspace_note;
            // Names that differ in signs only would be the same file.
            let same = figures.iter().filter(|other: &&Figure| other.stem == drawn.stem).count();
            if same > 0 {
                drawn.name = format!("{}-{}", drawn.stem, same + 1);
            }
            figures.push(drawn);
        }
        let mut drawings = Vec::new();
        for figure in &figures {
            drawings.push(svg::draw(figure, subject).map_err(|error| Failure::of(&figure.name, error))?);
        }
        let report = html::page(&figures, &drawings, &self.left_out, subject);
        let names = figures.iter().map(|figure| format!("{}.svg", figure.name));
        let mut files = names.zip(drawings).collect::<Vec<_>>();
        files.push(("report.html".to_owned(), report));
        Ok(Rendered(files))
    }
}
