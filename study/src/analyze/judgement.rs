//! Judgement of the machine, as built and compensated: verdicts on the tolerances, and the shares
//! of the sources in what is judged.

use abbe::analysis::{
    Budget, Correction, ErrorDistribution, Machines, Measurand, Residual, Subset, Yield, errors_at, sweep,
};

use super::compensated::{CHECKED, CompensatedErrors};
use super::report::{
    CompensatedVerdicts, CompensationBasis, ErrorSites, JudgedErrors, JudgedShares, MachineVerdicts, SEED,
    ToleranceVerdict, Verdict, Verdicts,
};
use super::sweep::AnalysisSweep;
use crate::Result;
use crate::factors::{self, Factors};
use crate::study_file::{Criterion, JudgedMachine};

/// Largest number of configurations for which factors are searched for.
const ALLOCATED: usize = 20_000;

impl AnalysisSweep<'_> {
    /// Returns what says how much compensation leaves, and the correction of the sources; `None` if
    /// nothing does.
    fn correction(&self) -> Option<(CompensationBasis, Vec<Option<Residual>>, Option<f64>)> {
        let description = self.manipulator.description();
        if let Some(stated) = &self.study.compensation {
            return Some((CompensationBasis::Stated, stated.residuals(description), stated.together));
        }
        if self.machine.is_calibrated() {
            let corrected = vec![Some(Residual::Share(0.0)); description.sources.len()];
            return Some((CompensationBasis::Identified, corrected, None));
        }
        Some((CompensationBasis::Published, Vec::new(), Some(self.study.compensated.as_ref()?.residual)))
    }

    /// Evaluates the compensated machine over the workspace, if the study has a tolerance or states
    /// what compensation leaves.
    pub(super) fn compensated(&self) -> Result<Option<(CompensationBasis, CompensatedErrors)>> {
        let tolerances = self.study.tolerances();
        let Some((basis, residuals, together)) = self.correction() else { return Ok(None) };
        if tolerances == [None; 2] && basis != CompensationBasis::Stated {
            return Ok(None);
        }
        let correction = Correction { residuals: &residuals, together };
        let swept = CompensatedErrors::new(self.manipulator, self.workspace, correction, tolerances);
        Ok(Some((basis, swept.map_err(|refused| self.not_evaluated(&refused))?)))
    }

    /// Returns the factors of the sources with which a study that is not met as built would be;
    /// `None` if it is, there are none, or the search would take longer than the analysis.
    pub(super) fn allocation(&self, verdicts: &Verdicts) -> Option<factors::Report> {
        let Self { machine, study, manipulator, workspace, .. } = *self;
        let by_factors = matches!(study.criterion, Criterion::WorstCase | Criterion::RootSumOfSquares);
        let is_searched = by_factors
            && verdicts.verdict == Verdict::NotMet
            && verdicts.unreachable.is_none()
            && !machine.is_calibrated()
            && workspace.len() <= ALLOCATED;
        let search = Factors { machine, study, loosen: false };
        is_searched.then(|| search.over(manipulator, workspace, &mut ()).ok()).flatten()
    }

    /// Returns the distribution of the error at a configuration.
    fn distribution(
        &self,
        index: Option<usize>,
        measurand: Measurand,
        correction: Option<Correction<'_>>,
    ) -> Result<ErrorDistribution> {
        let errors = self.at(index, |configuration| errors_at(self.manipulator, configuration))?;
        Ok(errors.distribution(measurand, correction))
    }

    /// Returns the share of machines that keep all tolerances, if that is the criterion, at no more
    /// configurations than those of [`CompensatedErrors`].
    fn yielded(&self, correction: Option<Correction<'_>>) -> Result<Option<Yield>> {
        let limits = self.study.tolerances();
        if self.study.criterion != Criterion::Yield || limits == [None; 2] {
            return Ok(None);
        }
        let (mut machines, mut configurations) = (Machines::new(self.study.probability), 0);
        let description = self.manipulator.description();
        let subset = Subset { workspace: self.workspace, count: CHECKED };
        let swept = sweep(self.manipulator, &subset, &mut |row| {
            configurations += 1;
            for (measurand, limit) in Measurand::ALL.into_iter().zip(limits) {
                if let Some(limit) = limit.filter(|_| measurand == Measurand::Position || row.oriented) {
                    machines
                        .add(ErrorDistribution::at(description, row.sources, measurand, correction), limit);
                }
            }
        });
        swept.map_err(|refused| self.not_evaluated(&refused))?;
        Ok(Some(machines.yielded(configurations, SEED)))
    }

    /// Returns the shares of the sources in the judged errors of position and orientation, where
    /// they were judged; where the error is largest without a tolerance.
    pub(super) fn shares(&self, budget: &Budget, verdicts: Option<&Verdicts>) -> Result<[JudgedShares; 2]> {
        let by_worst_case = self.study.criterion == Criterion::WorstCase;
        let correction = self
            .correction()
            .filter(|_| verdicts.is_some_and(|verdicts| verdicts.machine == JudgedMachine::Compensated));
        let correction = correction.as_ref();
        let correction =
            correction.map(|(_, residuals, together)| Correction { residuals, together: *together });
        let of = |measurand: Measurand| {
            let (sources, combined) = budget.errors(measurand);
            let largest = if by_worst_case { combined.worst_case_radius } else { combined.radius };
            let judged = verdicts.and_then(|verdicts| verdicts.all().find(|one| one.measurand == measurand));
            let index = judged.map_or(largest.configuration, |verdict| verdict.configuration);
            let distribution = self.distribution(index, measurand, correction)?;
            let is_error = matches!(self.study.criterion, Criterion::WorstCase | Criterion::RootSumOfSquares);
            let tolerance = self.study.tolerances()[measurand as usize].filter(|_| is_error);
            let factor =
                tolerance.map(|tolerance| tolerance / largest.value).filter(|factor| factor.is_finite());
            Ok(JudgedShares::new(&distribution, by_worst_case, factor, sources))
        };
        Ok([of(Measurand::Position)?, of(Measurand::Orientation)?])
    }

    /// Judges the machine as built and, if it is known, compensated; `None` without a tolerance.
    pub(super) fn verdicts(
        &self,
        budget: &Budget,
        sites: &ErrorSites,
        compensated: Option<(CompensationBasis, CompensatedErrors)>,
    ) -> Result<Option<Verdicts>> {
        let as_built = self.machine_verdicts(sites, None, &|measurand, tolerance| {
            let distribution = |index| self.distribution(index, measurand, None);
            JudgedErrors::as_built(budget, measurand, tolerance, distribution)
        })?;
        let compensated = match (compensated, self.correction()) {
            (Some((basis, swept)), Some((_, residuals, together))) => {
                let correction = Some(Correction { residuals: &residuals, together });
                let is_all = swept.checked == budget.configurations;
                let verdicts = self.machine_verdicts(sites, correction, &|measurand, _| {
                    let extremes = &swept.extremes[measurand as usize];
                    let candidates = extremes.candidates().into_iter();
                    let candidates =
                        candidates.map(|index| Ok((index, self.distribution(index, measurand, correction)?)));
                    Ok(JudgedErrors {
                        measurand,
                        radius: extremes.radius,
                        worst_case: extremes.worst_case,
                        // Certain only if no configuration was left out.
                        is_bounded: extremes.is_bounded && is_all,
                        candidates: candidates.collect::<Result<_>>()?,
                    })
                })?;
                Some(CompensatedVerdicts { basis, checked: swept.checked, verdicts })
            }
            _ => None,
        };
        let reach = [budget.configurations, budget.unreachable.count];
        Ok(Verdicts::new(self.study, reach, as_built, compensated))
    }

    /// Judges a machine, whose errors depend on the measurand and its tolerance.
    fn machine_verdicts(
        &self,
        sites: &ErrorSites,
        correction: Option<Correction<'_>>,
        errors: &dyn Fn(Measurand, f64) -> Result<JudgedErrors>,
    ) -> Result<MachineVerdicts> {
        let yielded = self.yielded(correction)?;
        let judge = |measurand: Measurand| {
            let verdict = self.study.tolerances()[measurand as usize].map(|tolerance| {
                let errors = errors(measurand, tolerance)?;
                Ok(ToleranceVerdict::new(errors, sites, tolerance, (self.study, yielded.as_ref())))
            });
            verdict.transpose()
        };
        let [position, orientation] = [judge(Measurand::Position)?, judge(Measurand::Orientation)?];
        Ok(MachineVerdicts { position, orientation, yielded })
    }
}
