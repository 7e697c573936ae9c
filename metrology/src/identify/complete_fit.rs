//! Complete fit: constant errors together with selected terms.

use abbe::identify::{Comparison, Distances, Folds, cross_validate};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

use super::{
    Settings, Setup, Solved, Term, check_interpretation, check_plausibility, diagnose, extended,
    own_magnitudes, solve,
};
use super::{as_joint_errors::number_terms, instruments::estimate};
use crate::data::{Data, Map};
use abbe_study::{About, Notes, Result};

/// Spec with derived inputs, and the rows that a model is fitted to.
#[derive(Clone, Copy)]
pub(super) struct FitInput<'a> {
    pub(super) spec: &'a Spec,
    pub(super) map: &'a Map,
    pub(super) data: &'a Data,
    pub(super) settings: &'a Settings,
}

impl FitInput<'_> {
    /// Returns the interpreter of the spec with these terms and the numbers of the chain, for
    /// [`complete_fit`](Self::complete_fit).
    pub(super) fn interpreter(&self, terms: &[Term]) -> Interpreter {
        Interpreter::new(extended(self.spec, &[terms, &number_terms(self.spec)].concat()))
    }

    /// Places the machine of the interpreter, whose last `added` sources are not part of it. Checks
    /// the interpretation and the plausibility of the data if `checked`.
    pub(super) fn setup<'i>(
        &self,
        interpreter: &'i Interpreter,
        added: usize,
        checked: bool,
        notes: &mut dyn Notes,
    ) -> Result<Setup<'i>> {
        let Self { map, data, settings, .. } = *self;
        let mut setup = Setup::new(interpreter, map, data, added)?;
        if checked {
            check_interpretation(&setup, map, data)?;
        }
        setup.come_near(data).about(&data.file)?;
        if checked {
            check_plausibility(&setup, map, data, notes).about(&data.file)?;
        }
        estimate(&mut setup, map, data, settings)?;
        Ok(setup)
    }

    /// Fits constant errors together with the terms. The interpreter is
    /// [that of the terms](Self::interpreter).
    pub(super) fn complete_fit<'i>(
        &self,
        interpreter: &'i Interpreter,
        terms: &[Term],
        checked: bool,
        notes: &mut dyn Notes,
    ) -> Result<(Setup<'i>, Solved<'i>)> {
        let own = own_magnitudes(self.spec);
        let added = own.len() + terms.len() + number_terms(self.spec).len();
        let setup = self.setup(interpreter, added, checked, notes)?;
        let solved = solve(&setup, self.data, &own, terms, self.settings, notes)?;
        Ok((setup, solved))
    }
}

/// Number of regions of joint space, and of runs of rows, by which models are compared.
pub(super) const BLOCKS: usize = 8;

/// Accuracy of a complete fit on rows that it leaves out.
#[derive(Clone, Debug)]
pub(super) struct Assessed {
    /// Position errors of the cross-validation.
    pub(super) cross_validated: Distances,
    /// Position errors of regions of joint space, and of runs of rows, each left out as a whole;
    /// the blocks are the independent samples.
    by_block: [Distances; 2],
    /// Lines of the rows rejected as outliers.
    pub(super) rejected: Vec<u64>,
}

impl Assessed {
    pub(super) fn new(solved: &Solved, data: &Data) -> Result<Self> {
        let Solved { model, fit, cross_validated, .. } = solved;
        let rows = &data.observations;
        let by_block = |folds: Folds| {
            let distances =
                cross_validate(model, rows, fit, &folds).map_err(|failure| diagnose(&failure, data))?;
            Ok(folds.distances_by_fold(rows, distances))
        };
        Ok(Self {
            cross_validated: cross_validated.clone(),
            by_block: [by_block(Folds::by_region(rows, BLOCKS))?, by_block(Folds::by_order(rows, BLOCKS))?],
            rejected: fit.rejected(rows).map(|row| row.line).collect(),
        })
    }

    /// Returns the mean error of the blocks.
    pub(super) fn mean(&self) -> f64 {
        self.by_block.each_ref().map(|one| one.figures().mean).iter().sum::<f64>() / 2.0
    }

    /// Returns whether this model predicts blocks better than a simpler one by more than the
    /// standard error of the difference, in regions and in runs; true if the fits reject different
    /// rows.
    pub(super) fn is_better_than(&self, simpler: &Self) -> bool {
        let is_better = |(own, other): (&Distances, &Distances)| {
            let Comparison { gain, standard_error, .. } = own.compared_with(other);
            gain > standard_error
        };
        self.rejected != simpler.rejected || self.by_block.iter().zip(&simpler.by_block).all(is_better)
    }
}
