//! Selection of richer terms by cross-validation on the fitted data alone.

use std::time::Instant;

use abbe::identify::{CandidateTerms, Folds, Model, ModelTerm, Observation, Selection, Unknown, select};
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;

use super::{
    Assessed, Basis, ErrorSite, FitInput, Solved, Stages, Term, diagnose, extended, own_magnitudes, solve,
};
use abbe_study::{Notes, Result};

/// Probability of accepting a term by chance, over all stages.
const CHANCE: f64 = 0.05;

/// Terms accepted by the selection.
#[derive(Clone, Debug, Default)]
pub(super) struct Chosen {
    /// Groups in the order of acceptance.
    pub(super) groups: Vec<(Vec<Term>, Selection)>,
    /// Accuracy of the model with constant errors alone, if richer terms were tried.
    pub(super) constant: Option<Assessed>,
    /// Number of groups tried.
    pub(super) tried: usize,
    /// Names of the families that have them.
    pub(super) families: String,
    /// Notes for the report.
    pub(super) notes: Vec<String>,
}

/// Selects terms forward among each of the sets of candidates, and returns the selection whose
/// complete fit predicts the rows that it leaves out best.
///
/// The first set has the terms of all families. A family alone can be better: among more
/// candidates, its best term can lose to one of another family that fits as well at first. The
/// terms of all families are preferred only if they are significantly better than the best family.
pub(super) fn choose(input: &FitInput, sets: &[(String, Stages)], notes: &mut dyn Notes) -> Result<Chosen> {
    let FitInput { spec, data, settings, .. } = *input;
    let offered = Offered::new(sets);
    let own = own_magnitudes(spec);
    let interpreter = Interpreter::new(extended(spec, &offered.carriers));
    let setup = input.setup(&interpreter, own.len() + offered.carriers.len(), true, notes)?;
    let solved = solve(&setup, data, &own, &[], settings, notes)?;
    if solved.is_placement() {
        return Ok(Chosen::default());
    }
    let constant = Assessed::new(&solved, data)?;
    let groups = sets.iter().flat_map(|(_, stages)| stages).map(Vec::len).sum();
    let model = offered.model(&solved, setup.declared + own.len());
    let begin = Instant::now();
    let mut selector = Selector { input, offered, solved: &solved, model, groups, tried: 0, begin };
    let (mut skipped, mut selected) = (Vec::new(), Vec::new());
    let mut tried = 0;
    for (i, (families, stages)) in sets.iter().enumerate() {
        if i > 0 && selector.is_over() {
            break;
        }
        let chosen = selector.forward(stages, notes).and_then(|mut chosen| {
            skipped.append(&mut chosen.notes);
            chosen.determined(input, &constant, notes)
        });
        if i == 0 {
            // Those of the families alone are among them.
            tried = selector.tried;
        }
        selected.push(chosen.unwrap_or_else(|mistake| {
            skipped.push(failed(families, &mistake));
            None
        }));
        notes.go_on()?;
    }
    notes.progress(groups, groups);
    let mut selected = selected.into_iter();
    let together = selected.next().flatten();
    let alone = selected.flatten().min_by(|(_, a), (_, b)| a.mean().total_cmp(&b.mean()));
    let best = match (together, alone) {
        (Some(together), Some(alone)) if !together.1.is_better_than(&alone.1) => Some(alone),
        (together, alone) => together.or(alone),
    };
    let best = best.map(|(chosen, _)| chosen).unwrap_or_default();
    let families = sets.first().map(|(families, _)| families.clone()).unwrap_or_default();
    Ok(Chosen { constant: Some(constant), tried, families, notes: skipped, ..best })
}

/// Returns the note that the fit with terms of some families failed.
fn failed(families: &str, mistake: &Diagnostics) -> String {
    let reason = mistake.to_string();
    let reason = reason.lines().next().unwrap_or_default().trim_start_matches("error: ");
    format!("note: no terms of `{families}`: their fit failed: {reason}")
}

/// Distinct carriers and factors of the candidate terms. The interpreter computes only the error of
/// each carrier; the basis of a term is a factor that is evaluated per row.
struct Offered {
    /// Constant terms and compliances that are no unknowns of the constant model.
    carriers: Vec<Term>,
    factors: Vec<Basis>,
}

impl Offered {
    fn new(sets: &[(String, Stages)]) -> Self {
        let (mut carriers, mut factors) = (Vec::new(), Vec::new());
        for term in sets.iter().flat_map(|(_, stages)| stages).flatten().flatten() {
            let carrier = term.carrier();
            if unknown_error(carrier).is_none() && !carriers.contains(&carrier) {
                carriers.push(carrier);
            }
            if !term.basis.is_elastic() && !factors.contains(&term.basis) {
                factors.push(term.basis);
            }
        }
        Self { carriers, factors }
    }

    /// Returns the model of the fit of constant errors with a magnitude of each carrier, the first
    /// of which is that of this source.
    fn model<'a>(&self, solved: &Solved<'a>, first: usize) -> Model<'a> {
        let magnitudes = (first..).take(self.carriers.len()).map(Unknown::Magnitude);
        solved.model.with(solved.model.unknowns.iter().copied().chain(magnitudes).collect())
    }
}

/// Forward selection about the fit of constant errors.
struct Selector<'a> {
    input: &'a FitInput<'a>,
    offered: Offered,
    /// Fit of constant errors alone.
    solved: &'a Solved<'a>,
    /// Its model, followed by the magnitudes of the carriers.
    model: Model<'a>,
    /// Number of groups in all sets.
    groups: usize,
    /// Number of groups tried.
    tried: usize,
    begin: Instant,
}

impl Selector<'_> {
    /// Returns whether the time limit is over.
    fn is_over(&self) -> bool {
        self.input.settings.time.is_some_and(|time| self.begin.elapsed() >= time)
    }

    /// Selects terms from stages of groups. Stages that would begin after the time limit are
    /// skipped.
    fn forward(&mut self, stages: &Stages, notes: &mut dyn Notes) -> Result<Chosen> {
        let FitInput { data, settings, .. } = *self.input;
        let rows = &data.observations;
        let factors = &self.offered.factors;
        let values = |row: &Observation| factors.iter().map(|basis| basis.value(&row.q, &row.u)).collect();
        let folds = Folds::new(rows, settings.folds);
        let mut chosen = Chosen::default();
        for (i, stage) in stages.iter().enumerate() {
            notes.progress(self.tried, self.groups);
            if self.is_over() {
                let rest: usize = stages[i..].iter().map(Vec::len).sum();
                chosen.notes.push(format!(
                    "note: the time limit was reached before {rest} of {} groups of terms were tried",
                    rest + self.tried
                ));
                break;
            }
            self.tried += stage.len();
            notes.go_on()?;
            let factored = |group: &Vec<Term>| group.iter().filter_map(|term| self.factored(term)).collect();
            let taken: Vec<ModelTerm> =
                chosen.terms().iter().filter_map(|term| self.factored(term)).collect();
            let groups: Vec<Vec<ModelTerm>> = stage.iter().map(factored).collect();
            let candidates = CandidateTerms {
                taken: &taken,
                groups: &groups,
                factors: &values,
                chance: CHANCE / stages.len() as f64,
            };
            let mut proceed = || !self.is_over();
            let selected = select(&self.model, rows, &self.solved.fit, &folds, &candidates, &mut proceed);
            let selected = selected.map_err(|failure| diagnose(&failure, data))?;
            let group = |selection: Selection| (stage[selection.group].clone(), selection);
            chosen.groups.extend(selected.into_iter().map(group));
        }
        Ok(chosen)
    }

    /// Returns the unknown and the factor of a term.
    fn factored(&self, term: &Term) -> Option<ModelTerm> {
        let Offered { carriers, factors } = &self.offered;
        let carrier = term.carrier();
        let unknown = match unknown_error(carrier) {
            Some(error) => self.model.unknowns.iter().position(|unknown| *unknown == error),
            None => {
                let first = self.model.unknowns.len() - carriers.len();
                carriers.iter().position(|one| *one == carrier).map(|i| first + i)
            }
        };
        let factor = factors.iter().position(|basis| *basis == term.basis);
        unknown.map(|unknown| ModelTerm { unknown, factor })
    }
}

/// Returns the unknown of a model that a constant term is equivalent to, if there is one.
fn unknown_error(term: Term) -> Option<Unknown> {
    match (term.site, term.basis) {
        (ErrorSite::Frame(frame, component), Basis::One) => Some(Unknown::Error(frame, component)),
        _ => None,
    }
}

impl Chosen {
    /// Removes groups that the complete fit holds at zero, and the last groups as long as constant
    /// errors alone predict better. Returns the rest with the accuracy of its fit; none if nothing
    /// is left.
    fn determined(
        mut self,
        input: &FitInput,
        constant: &Assessed,
        notes: &mut dyn Notes,
    ) -> Result<Option<(Self, Assessed)>> {
        while !self.groups.is_empty() {
            notes.go_on()?;
            let (terms, count) = (self.terms(), self.groups.len());
            let interpreter = input.interpreter(&terms);
            let (_, solved) = input.complete_fit(&interpreter, &terms, false, &mut ())?;
            let determined = solved.determined_terms();
            self.groups.retain(|(group, _)| group.iter().any(|term| determined.contains(term)));
            if self.groups.len() < count {
                continue;
            }
            let assessed = Assessed::new(&solved, input.data)?;
            match assessed.is_better_than(constant) {
                true => return Ok(Some((self, assessed))),
                false => drop(self.groups.pop()),
            }
        }
        Ok(None)
    }

    /// Returns all terms, in the order of acceptance.
    pub(super) fn terms(&self) -> Vec<Term> {
        self.groups.iter().flat_map(|(group, _)| group).copied().collect()
    }
}
