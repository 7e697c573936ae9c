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
use crate::study::{Content, Study};

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
            if let Some(region) = &gather.figure.region {
                let fail = |error: &dyn std::fmt::Display| Failure::of(&subject.spec.file, error);
                let workspace = region.workspace(subject.manipulator).map_err(|error| fail(&error))?;
                let u = sampling::nominal_inputs(&subject.description);
                sweep(subject.manipulator, &workspace.configurations, &u, &mut |row| gather.add(row))
                    .map_err(|error| fail(&error))?;
            }
            let Gather { figure, source, bounds, .. } = gather;
            figures.push(Figure::new(figure, source, bounds, gather.finish(), subject));
        }
        let mut files = Vec::new();
        for figure in &figures {
            let svg = svg::draw(figure, subject).map_err(|error| Failure::of(&figure.name, error))?;
            files.push((format!("{}.svg", figure.name), svg));
        }
        files.push(("report.html".to_owned(), html::page(&figures, &self.left_out, subject)));
        Ok(Rendered(files))
    }
}
