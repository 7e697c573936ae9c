//! Selection of richer terms by cross-validation on the fitted data alone.

use std::time::{Duration, Instant};

use abbe::identify::{Distances, Factored, Folds, Observation, Offer, Selection, Unknown, select};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;

use super::extended::extended;
use super::instruments::estimate;
use super::interpretation_check::check_interpretation;
use super::magnitude::own_magnitudes;
use super::options::Settings;
use super::plausibility::check_plausibility;
use super::setup::Setup;
use super::solve::{diagnose, solve};
use super::terms::{Basis, ErrorSite, Term};
use crate::Notes;
use crate::data::{Data, Map};

/// Probability of accepting a term by chance, over all stages.
const CHANCE: f64 = 0.05;

/// Terms accepted by the selection.
#[derive(Clone, Debug, Default)]
pub(super) struct Chosen {
    /// Groups in the order of acceptance.
    pub(super) groups: Vec<(Vec<Term>, Selection)>,
    /// Model with constant errors alone, if richer terms were tried.
    pub(super) constant: Option<Constant>,
    /// Number of groups tried.
    pub(super) tried: usize,
    /// Notes for the report.
    pub(super) notes: Vec<String>,
}

/// Accuracy of the model with constant errors alone.
#[derive(Clone, Debug)]
pub(super) struct Constant {
    /// Position errors of the cross-validation.
    pub(super) cross_validated: Distances,
    /// Lines of the rows rejected as outliers.
    pub(super) rejected: Vec<u64>,
}

/// Selects terms from `stages` of groups. Stages that would begin after the time limit are skipped.
///
/// The interpreter computes only the error of each carrier; the basis of a term is a factor that is
/// evaluated per row.
pub(super) fn choose(
    spec: &Spec,
    map: &Map,
    data: &Data,
    stages: &[Vec<Vec<Term>>],
    settings: &Settings,
    notes: &mut dyn Notes,
) -> Result<Chosen, Diagnostics> {
    let start = Instant::now();
    let over = |time: Option<Duration>| time.is_some_and(|time| start.elapsed() >= time);
    let all: Vec<Term> = stages.iter().flatten().flatten().copied().collect();
    let mut carriers: Vec<Term> = Vec::new();
    let mut factors: Vec<Basis> = Vec::new();
    for term in &all {
        let carrier = term.carrier();
        if unknown_error(carrier).is_none() && !carriers.contains(&carrier) {
            carriers.push(carrier);
        }
        if !term.basis.is_elastic() && !factors.contains(&term.basis) {
            factors.push(term.basis);
        }
    }
    let own = own_magnitudes(spec);
    let interpreter = Interpreter::new(extended(spec, &carriers));
    let mut setup = Setup::new(&interpreter, map, data, own.len() + carriers.len())?;
    check_interpretation(&setup, map, data)?;
    setup.come_near(data).map_err(|failure| diagnose(&failure, data))?;
    check_plausibility(&setup, map, data, notes).map_err(|failure| diagnose(&failure, data))?;
    estimate(&mut setup, map, data, settings)?;
    let solved = solve(&setup, data, &own, &[], settings, notes)?;

    let fitted = solved.model.unknowns.len();
    let magnitudes = (setup.declared + own.len()..).take(carriers.len()).map(Unknown::Magnitude);
    let unknowns = solved.model.unknowns.iter().copied().chain(magnitudes).collect();
    let model = solved.model.with(unknowns);
    let factored = |term: &Term| {
        let carrier = term.carrier();
        let unknown = match unknown_error(carrier) {
            Some(error) => model.unknowns.iter().position(|unknown| *unknown == error),
            None => carriers.iter().position(|one| *one == carrier).map(|i| fitted + i),
        };
        let factor = factors.iter().position(|basis| *basis == term.basis);
        unknown.map(|unknown| Factored { unknown, factor })
    };
    let values = |row: &Observation| factors.iter().map(|basis| basis.value(&row.q, &row.u)).collect();
    let folds = Folds::new(&data.observations, settings.folds);
    let rejected = solved.fit.rejected(&data.observations).map(|row| row.line).collect();
    let constant = Constant { cross_validated: solved.cross_validated.clone(), rejected };
    let mut chosen = Chosen { constant: Some(constant), ..Chosen::default() };
    let groups: usize = stages.iter().map(Vec::len).sum();
    for (i, stage) in stages.iter().enumerate() {
        notes.progress(chosen.tried, groups);
        if over(settings.time) {
            let rest: usize = stages[i..].iter().map(Vec::len).sum();
            chosen.notes.push(format!(
                "note: the time limit was reached before {rest} of {} groups of terms were tried",
                rest + chosen.tried
            ));
            break;
        }
        chosen.tried += stage.len();
        notes.go_on()?;
        let taken: Vec<Factored> =
            chosen.groups.iter().flat_map(|(group, _)| group).filter_map(factored).collect();
        let groups: Vec<Vec<Factored>> =
            stage.iter().map(|group| group.iter().filter_map(factored).collect()).collect();
        let offer =
            Offer { taken: &taken, groups: &groups, factors: &values, chance: CHANCE / stages.len() as f64 };
        let mut proceed = || !over(settings.time);
        let selected = select(&model, &data.observations, &solved.fit, &folds, &offer, &mut proceed);
        let selected = selected.map_err(|failure| diagnose(&failure, data))?;
        let group = |selection: Selection| (stage[selection.group].clone(), selection);
        chosen.groups.extend(selected.into_iter().map(group));
    }
    notes.progress(groups, groups);
    Ok(chosen)
}

/// Returns the unknown of a model that a constant term is equivalent to, if there is one.
fn unknown_error(term: Term) -> Option<Unknown> {
    match (term.site, term.basis) {
        (ErrorSite::Frame(frame, component), Basis::One) => Some(Unknown::Error(frame, component)),
        _ => None,
    }
}

impl Chosen {
    /// Returns all terms, in the order of acceptance.
    pub(super) fn terms(&self) -> Vec<Term> {
        self.groups.iter().flat_map(|(group, _)| group).copied().collect()
    }
}
