//! Data of all figures of a study, during the sweep and after it.

use abbe::Description;
use abbe::analysis::{Configuration, Row, Sweepable, sweep};
use abbe_spec::Spec;

use super::figure_builder::{FigureBuilder, PartialFigure};
use super::{Figure, FigureData, Figures, Stick};
use crate::study_file::{Content, Study};
use crate::{About, Result, mistake};

/// Figures of a study while their data are gathered.
pub(in crate::analyze) struct FiguresBuilder<'a> {
    /// Figures over the study's workspace, and figures with their own.
    figures: Vec<FigureBuilder<'a>>,
    /// Names of sources with a figure that are switched off.
    left_out: Vec<String>,
}

impl<'a> FiguresBuilder<'a> {
    /// Creates the figures of a study.
    pub(in crate::analyze) fn new(study: &'a Study, description: &Description) -> Self {
        // Without sources only the manipulator can be drawn.
        let nothing = description.sources.is_empty();
        let requests = study.figures.iter().filter(|figure| {
            !nothing || figure.source.is_some() || matches!(figure.content, Content::Manipulator(_))
        });
        let (mut figures, mut left_out) = (Vec::new(), Vec::new());
        for figure in requests {
            match FigureBuilder::new(figure, description) {
                Some(builder) => figures.push(builder),
                None => left_out.extend(figure.source.clone()),
            }
        }
        Self { figures, left_out }
    }

    /// Adds a configuration of the sweep.
    pub(in crate::analyze) fn add(&mut self, row: &Row) {
        let here = self.figures.iter_mut().filter(|builder| builder.figure.region.is_none());
        here.for_each(|builder| builder.add(row));
    }

    /// Returns the data gathered so far, one entry per figure.
    pub(in crate::analyze) fn data(self) -> Vec<PartialFigure> {
        self.figures.into_iter().map(|builder| builder.data).collect()
    }

    /// Appends the data that follow. Returns false if they belong to other figures.
    pub(in crate::analyze) fn append(&mut self, data: Vec<PartialFigure>) -> bool {
        let as_many = self.figures.len() == data.len();
        as_many && self.figures.iter_mut().zip(data).all(|(builder, data)| builder.data.append(data))
    }

    /// Sweeps the figures' own workspaces and returns the finished figures.
    pub(in crate::analyze) fn finish(
        self,
        manipulator: &dyn Sweepable,
        home: &Configuration,
        spec: &Spec,
    ) -> Result<Figures> {
        let finish = |mut builder: FigureBuilder<'a>| {
            let own_workspace = sweep_own(&mut builder, manipulator, spec)?;
            let (request, bounds) = (builder.figure.clone(), builder.bounds);
            let data = match request.content {
                Content::Manipulator(_) => {
                    FigureData::Manipulator(Stick::at_home(manipulator, home, spec).about(&spec.file)?)
                }
                _ => builder.finish(),
            };
            Ok(Figure { request, bounds, own_workspace, data })
        };
        let figures = self.figures.into_iter().map(finish).collect::<Result<_, _>>()?;
        Ok(Figures { figures, left_out: self.left_out })
    }
}

/// Sweeps the workspace of a figure that has its own. Returns the numbers of reached and
/// unreachable configurations.
fn sweep_own(
    builder: &mut FigureBuilder,
    manipulator: &dyn Sweepable,
    spec: &Spec,
) -> Result<Option<[usize; 2]>> {
    let Some(region) = &builder.figure.region else { return Ok(None) };
    let workspace = region.workspace(manipulator, None).about(&spec.file)?;
    let unreachable = sweep(manipulator, &*workspace, &mut |row| builder.add(row))
        .map_err(|refused| mistake::whole(&spec.file, &refused.error))?;
    Ok(Some([workspace.len() - unreachable.count, unreachable.count]))
}
