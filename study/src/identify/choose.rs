//! Which richer terms earn their place: by the data alone, on rows left out in turn.

use std::time::{Duration, Instant};

use abbe::identify::{Distances, Factored, Folds, Observation, Offer, Selection, Unknown, select};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;

use super::extended::extended;
use super::magnitude::own_magnitudes;
use super::misread::check_interpretation;
use super::options::Settings;
use super::plausibility::check_plausibility;
use super::setup::Setup;
use super::solve::{explained, solve};
use super::terms::{Basis, ErrorSite, Term};
use crate::Notes;
use crate::data::{Data, Map};

/// How likely it may be that a term is taken in by chance, all stages together.
const CHANCE: f64 = 0.05;

/// Terms that were taken in.
#[derive(Clone, Debug, Default)]
pub(super) struct Chosen {
    /// Group by group, in the order in which they came in.
    pub(super) groups: Vec<(Vec<Term>, Selection)>,
    /// The model with constants alone, if richer terms were tried.
    pub(super) constant: Option<Constant>,
    /// How many groups were tried.
    pub(super) tried: usize,
    /// What must be said.
    pub(super) notes: Vec<String>,
}

/// How the model with constants alone does.
#[derive(Clone, Debug)]
pub(super) struct Constant {
    /// On rows left out in turn.
    pub(super) crossed: Distances,
    /// The lines that it rejects as gross errors.
    pub(super) rejected: Vec<u64>,
}

/// Chooses from `stages` of groups of terms; those that begin when `time` is over are left out.
///
/// Nothing but the terms' errors at places is computed by the spec; what these are multiplied with is a factor of the row.
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
    setup.come_near(data).map_err(|failure| explained(&failure, data))?;
    check_plausibility(&setup, map, data, notes).map_err(|failure| explained(&failure, data))?;
    let solved = solve(&setup, data, &own, &[], settings, notes)?;

    let fitted = solved.model.unknowns.len();
    let magnitudes = (setup.declared + own.len()..).take(carriers.len()).map(Unknown::Magnitude);
    let unknowns = solved.model.unknowns.iter().copied().chain(magnitudes).collect();
    let model = solved.model.with(unknowns);
    let place = |term: &Term| {
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
    let constant = Constant { crossed: solved.crossed.clone(), rejected };
    let mut chosen = Chosen { constant: Some(constant), ..Chosen::default() };
    let groups: usize = stages.iter().map(Vec::len).sum();
    for (i, stage) in stages.iter().enumerate() {
        notes.progress(chosen.tried, groups);
        if over(settings.time) {
            let rest: usize = stages[i..].iter().map(Vec::len).sum();
            chosen.notes.push(format!(
                "note: the time was over before {rest} of {} groups of terms were tried",
                rest + chosen.tried
            ));
            break;
        }
        chosen.tried += stage.len();
        notes.go_on()?;
        let taken: Vec<Factored> =
            chosen.groups.iter().flat_map(|(group, _)| group).filter_map(place).collect();
        let groups: Vec<Vec<Factored>> =
            stage.iter().map(|group| group.iter().filter_map(place).collect()).collect();
        let offer =
            Offer { taken: &taken, groups: &groups, factors: &values, chance: CHANCE / stages.len() as f64 };
        let mut proceed = || !over(settings.time);
        let selected = select(&model, &data.observations, &solved.fit, &folds, &offer, &mut proceed);
        let selected = selected.map_err(|failure| explained(&failure, data))?;
        let group = |selection: Selection| (stage[selection.group].clone(), selection);
        chosen.groups.extend(selected.into_iter().map(group));
    }
    notes.progress(groups, groups);
    Ok(chosen)
}

/// The unknown of a model that a constant term is, if it is one.
fn unknown_error(term: Term) -> Option<Unknown> {
    match (term.place, term.basis) {
        (ErrorSite::Frame(frame, component), Basis::One) => Some(Unknown::Error(frame, component)),
        _ => None,
    }
}

impl Chosen {
    /// All terms, in the order of the stages.
    pub(super) fn terms(&self) -> Vec<Term> {
        self.groups.iter().flat_map(|(group, _)| group).copied().collect()
    }
}
