//! Fitted, judged and chosen: by the data alone.

use abbe::identify::{
    Candidate, Failure as Cause, Figures, Fit, Loss, Model, Options, Selection, Unknown, cross_validate, fit,
    select,
};

use super::setup::Setup;
use super::terms::Source;
use crate::arguments::{Identify, Robust};
use crate::data::{Data, Map};
use crate::failure::Failure;
use crate::output::note;

/// What the data say.
pub(super) struct Solved<'a> {
    pub(super) simple: Model<'a>,
    pub(super) simple_fit: Fit,
    pub(super) model: Model<'a>,
    pub(super) fit: Fit,
    /// Of the model with constants alone, if richer terms were tried.
    pub(super) constant: Option<Figures>,
    /// On rows left out in turn.
    pub(super) crossed: Figures,
    pub(super) folds: usize,
    /// The groups of terms that were taken in, by name.
    pub(super) chosen: Vec<(String, Selection)>,
    /// The candidates whose magnitude is in the model.
    pub(super) magnitudes: Vec<usize>,
    /// What must be said.
    pub(super) notes: Vec<String>,
}

/// The most rows on which gross errors are looked for.
const ROWS: usize = 400;

pub(super) fn solve<'a>(
    setup: &Setup<'a>,
    map: &Map,
    data: &Data,
    candidates: &[Source],
    arguments: &Identify,
) -> Result<Solved<'a>, Failure> {
    let rows = &data.observations;
    let loss = match arguments.robust {
        Robust::None => Loss::Squares,
        Robust::Huber => Loss::Huber,
        Robust::Tukey => Loss::Tukey,
    };
    let options = Options { loss, ..Options::default() };
    let simple = setup.ideal.with(setup.base_and_tool());
    let simple_fit = fit(&simple, rows, &options).map_err(|cause| explained(&cause, data))?;

    let constants = setup.constants();
    let fitted = |model: &Model, loss: Loss| -> Result<Fit, Cause> {
        let priors = if arguments.prior > 0.0 {
            model.priors(arguments.prior).map_err(|error| Cause::Row(0, error))?
        } else {
            Vec::new()
        };
        let at = Setup::embedded(&simple, &simple_fit.x, model);
        fit(model, rows, &Options { at, priors, loss, ..Options::default() })
    };
    let mut model = setup.real.with(constants.clone());
    let mut found = fitted(&model, loss);
    let mut notes = Vec::new();
    if loss == Loss::Squares {
        notes.extend(gross(setup, &model, data, found.as_ref().ok(), map));
    }
    if let (Err(cause), Some(warning)) = (&found, notes.first()) {
        note(warning);
        return Err(explained(cause, data));
    }
    let mut first = found.map_err(|cause| explained(&cause, data))?;
    let cross = |model: &Model, fit: &Fit| {
        cross_validate(model, rows, fit, arguments.folds).map_err(|cause| explained(&cause, data))
    };
    let mut crossed = cross(&model, &first)?;

    let (mut constant, mut chosen, mut magnitudes) = (None, Vec::new(), Vec::new());
    if !candidates.is_empty() {
        let own = setup.description.sources.len() - setup.candidates;
        let names = groups(candidates);
        let offer =
            |(_, which): &(String, Vec<usize>)| which.iter().map(|i| constants.len() + i).collect::<Vec<_>>();
        let offered: Vec<Candidate> =
            names.iter().map(|group| Candidate { name: group.0.clone(), unknowns: offer(group) }).collect();
        let all = (0..candidates.len()).map(|i| Unknown::Magnitude(own + i));
        let rich = setup.real.with(constants.iter().copied().chain(all).collect());
        let selected = select(&rich, rows, &first, &offered, arguments.folds, 40);
        let selected = selected.map_err(|cause| explained(&cause, data))?;
        magnitudes = selected.iter().flat_map(|selection| names[selection.candidate].1.clone()).collect();
        magnitudes.sort_unstable();
        if !magnitudes.is_empty() {
            let unknowns = magnitudes.iter().map(|i| Unknown::Magnitude(own + i));
            model = setup.real.with(constants.iter().copied().chain(unknowns).collect());
            found = fitted(&model, loss);
            first = found.map_err(|cause| explained(&cause, data))?;
            constant = Some(crossed);
            crossed = cross(&model, &first)?;
        }
        chosen =
            selected.into_iter().map(|selection| (names[selection.candidate].0.clone(), selection)).collect();
        if constant.is_none() {
            constant = Some(crossed);
        }
    }
    Ok(Solved {
        simple,
        simple_fit,
        model,
        fit: first,
        constant,
        crossed,
        folds: arguments.folds.min(rows.len()),
        chosen,
        magnitudes,
        notes,
    })
}

/// Candidates that come together.
fn groups(candidates: &[Source]) -> Vec<(String, Vec<usize>)> {
    let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
    for (i, candidate) in candidates.iter().enumerate() {
        match groups.last_mut() {
            Some((name, which)) if *name == candidate.group => which.push(i),
            _ => groups.push((candidate.group.clone(), vec![i])),
        }
    }
    groups
}

/// Rows far from a fit that they cannot pull at, if the plain fit looks as if there were any.
fn gross(setup: &Setup, model: &Model, data: &Data, plain: Option<&Fit>, map: &Map) -> Option<String> {
    let residuals = |fit: &Fit, robust: bool| -> Option<(f64, Vec<f64>)> {
        let norms = super::setup::norms(model, data, &fit.x).ok()?;
        let mut all = norms.clone();
        let scale = abbe::identify::robust_scale(&mut all);
        Some((if robust { fit.sigma * map.uncertainty.length } else { scale }, norms))
    };
    if let Some(plain) = plain {
        let (scale, norms) = residuals(plain, false)?;
        let rms = (norms.iter().map(|n| n * n).sum::<f64>() / norms.len().max(1) as f64).sqrt();
        // Norms of Gaussian errors: the root mean square is 1.13 / 0.6745⁻¹ times that scale, about 0.76.
        if rms < 1.6 * scale {
            return None;
        }
    }
    let step = data.observations.len().div_ceil(ROWS).max(1);
    let part: Vec<_> = data.observations.iter().step_by(step).cloned().collect();
    let priors = model.priors(0.01).ok()?;
    let robust = fit(model, &part, &Options { loss: Loss::Tukey, priors, ..Options::default() }).ok()?;
    let (scale, norms) = residuals(&robust, true)?;
    let points = norms.len() / data.lines.len().max(1);
    let far = |i: &usize| norms[i * points..(i + 1) * points].iter().any(|norm| *norm > 10.0 * scale);
    let wrong: Vec<u64> = (0..data.lines.len()).filter(far).map(|i| data.lines[i]).collect();
    if wrong.is_empty() || points == 0 || setup.pose && wrong.len() == data.lines.len() {
        return None;
    }
    Some(format!(
        "note: {} of {} rows lie more than ten standard deviations from a fit that leaves them out (lines {}); \
         `--robust tukey` does without them",
        wrong.len(),
        data.lines.len(),
        some(&wrong)
    ))
}

/// Some numbers, and how many more.
pub(super) fn some(lines: &[u64]) -> String {
    let shown = lines.iter().take(12).map(u64::to_string).collect::<Vec<_>>().join(", ");
    if lines.len() > 12 { format!("{shown} and {} more", lines.len() - 12) } else { shown }
}

fn explained(cause: &Cause, data: &Data) -> Failure {
    match cause {
        Cause::Row(row, error) => {
            let line = data.lines.get(*row).copied().unwrap_or_default();
            Failure::of(&data.file, format!("line {line}: {error}"))
        }
        Cause::TooFew { numbers, rank } => {
            let message = format!(
                "{numbers} numbers were measured for {rank} or more unknowns: nothing is left to judge the result by"
            );
            Failure::of(&data.file, message)
                .help("measure more configurations: twice as many numbers as unknowns at least")
        }
        Cause::NotConverged { .. } => Failure::of(&data.file, cause)
            .help("gross errors in the data? `--robust tukey` can do without them"),
    }
}
