//! All figures of a study in the making, during the sweep and after it.

use abbe::Description;
use abbe::analysis::{Configuration, Row, Sweepable, sweep};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;

use super::figure::{Figure, Figures, Gathered};
use super::gather::{Data, Gather};
use super::stick::Stick;
use crate::mistake;
use crate::study_file::{Content, Study};

/// The figures of a study, in the making.
pub(in crate::analyze) struct Gathering<'a> {
    /// Those over the workspace of the study, and those over one of their own.
    figures: Vec<Gather<'a>>,
    /// The sources that have a figure and are switched off.
    left_out: Vec<String>,
}

impl<'a> Gathering<'a> {
    /// Begins the figures of a study.
    pub(in crate::analyze) fn new(study: &'a Study, description: &Description) -> Self {
        // Without sources there is nothing to see but the manipulator.
        let nothing = description.sources.is_empty();
        let asked = study.figures.iter().filter(|figure| {
            !nothing || figure.source.is_some() || matches!(figure.content, Content::Manipulator(_))
        });
        let (mut figures, mut left_out) = (Vec::new(), Vec::new());
        for figure in asked {
            match Gather::new(figure, description) {
                Some(gather) => figures.push(gather),
                None => left_out.extend(figure.source.clone()),
            }
        }
        Self { figures, left_out }
    }

    /// Takes in what the sweep sees.
    pub(in crate::analyze) fn add(&mut self, row: &Row) {
        let here = self.figures.iter_mut().filter(|gather| gather.figure.region.is_none());
        here.for_each(|gather| gather.add(row));
    }

    /// What was gathered so far, figure by figure.
    pub(in crate::analyze) fn data(self) -> Vec<Data> {
        self.figures.into_iter().map(Gather::data).collect()
    }

    /// Takes in what follows; says whether it is of these figures.
    pub(in crate::analyze) fn append(&mut self, data: Vec<Data>) -> bool {
        let as_many = self.figures.len() == data.len();
        as_many && self.figures.iter_mut().zip(data).all(|(gather, data)| gather.append(data))
    }

    /// Sweeps the workspaces that figures have of their own, and ends the gathering.
    pub(in crate::analyze) fn finish(
        self,
        manipulator: &dyn Sweepable,
        home: &Configuration,
        spec: &Spec,
    ) -> Result<Figures, Diagnostics> {
        let finish = |mut gather: Gather<'a>| {
            let own_workspace = sweep_own(&mut gather, manipulator, spec)?;
            let (asked, bounds) = (gather.figure.clone(), gather.bounds);
            let data = match asked.content {
                Content::Manipulator(_) => {
                    let stick = Stick::at_home(manipulator, home);
                    Gathered::Manipulator(stick.map_err(|error| mistake::whole(&spec.file, &error))?)
                }
                _ => gather.finish(),
            };
            Ok(Figure { asked, bounds, own_workspace, data })
        };
        let figures = self.figures.into_iter().map(finish).collect::<Result<_, _>>()?;
        Ok(Figures { figures, left_out: self.left_out })
    }
}

/// Sweeps the workspace of a figure that has its own: how many configurations were reached, and how many were not.
fn sweep_own(
    gather: &mut Gather,
    manipulator: &dyn Sweepable,
    spec: &Spec,
) -> Result<Option<[usize; 2]>, Diagnostics> {
    let Some(region) = &gather.figure.region else { return Ok(None) };
    let workspace =
        region.workspace(manipulator, None).map_err(|error| mistake::whole(&spec.file, &error))?;
    let unreachable = sweep(manipulator, &*workspace, &mut |row| gather.add(row))
        .map_err(|refused| mistake::whole(&spec.file, &refused.error))?;
    Ok(Some([workspace.len() - unreachable.count, unreachable.count]))
}
