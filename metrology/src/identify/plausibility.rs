//! Doubts errors that are too large for a machine: before the fit by the residuals, after it by the
//! lengths that it changes.

use abbe::identify::{Failure, Fit, Loss, Model, Options, Unknown, fit};
use abbe_spec::option::PRIOR;

use super::interpretation_check::{ROWS, subsample};
use super::{Prior, Setup};
use crate::data::{Data, Map};
use abbe_study::{Notes, Result, mistake, number};

/// Residual, as a share of the arm length, above which errors are too large for a machine.
const LARGE: f64 = 1e-2;

/// Returns a warning if a root mean square error is too large for a machine. `fitted` is the error
/// with base and tool fitted, if that fit succeeded.
pub(crate) fn too_large(rms: f64, fitted: Option<f64>, setup: &Setup) -> Option<String> {
    let large = LARGE * setup.arm;
    let length = |value| number::length(value, setup.description.length);
    let reason = match fitted.filter(|left| *left <= large) {
        Some(left) => format!(
            "{} remain with base and tool fitted. Check the placement of the instrument (`base = \"unknown\"` in \
             the map fits it) and of the target.",
            length(left)
        ),
        None => {
            "no placement of base and tool fits, and no other interpretation (units, signs, column order) was \
                 found. Check that these are measurements of this machine; `abbe doctor` tries more conventions."
                .to_owned()
        }
    };
    let (size, share) = (length(rms), number::percent(rms, setup.arm));
    (rms > large)
        .then(|| format!("implausible errors of {size} (root mean square), {share} of the arm: {reason}"))
}

/// Warns if errors are too large for a machine even with base and tool fitted.
///
/// The median of the residuals of a robust fit decides, so that gross errors in less than half of
/// the rows do not matter. Call it after [`Setup::come_near`].
pub(crate) fn check_plausibility(
    setup: &Setup,
    map: &Map,
    data: &Data,
    notes: &mut dyn Notes,
) -> Result<(), Failure> {
    let rows = subsample(&data.observations, ROWS);
    if setup.delivered.figures(&rows, &[])?.rms <= LARGE * setup.arm {
        return Ok(());
    }
    let model = setup.real.with(setup.base_and_tool());
    let options =
        Options { loss: Loss::Tukey, priors: Prior::Auto.for_model(&model, setup)?, ..Options::default() };
    // The fixtures of instruments have no initial position.
    let placed = map.instruments().is_none();
    let rms = match fit(&model, &rows, &options) {
        Ok(found) => {
            let mut left = model.all_distances(&rows, &found.x)?.into_values();
            left.sort_by(f64::total_cmp);
            if left.get(left.len() / 2).is_none_or(|median| *median <= LARGE * setup.arm) {
                return Ok(());
            }
            if placed { None } else { Some(model.figures(&rows, &found.x)?.rms) }
        }
        Err(Failure::NotConverged { .. }) if placed => None,
        // The fit of all errors reports the failure.
        Err(_) => return Ok(()),
    };
    let rms = rms.map_or_else(|| Ok(setup.delivered.figures(&data.observations, &[])?.rms), Ok)?;
    if let Some(statement) = too_large(rms, None, setup) {
        notes.warn(&statement);
    }
    Ok(())
}

/// Changes of a length, in standard deviations of its prior, from which it is doubted and refused.
const DOUBTED: f64 = 5.0;
const REFUSED: f64 = 20.0;

/// Warns of lengths of the machine that a fit changes by far more than their prior.
///
/// Returns an error if a change is impossible: units, spec or machine are wrong, or the readings
/// leave the size of the machine free. Without a prior, the default one counts.
pub(super) fn check_lengths(
    setup: &Setup,
    model: &Model,
    fit: &Fit,
    prior: Prior,
    data: &Data,
    notes: &mut dyn Notes,
) -> Result<()> {
    let deviation = prior.share().max(Prior::DEFAULT_SHARE) * setup.arm;
    let lengths = fit.identifiable.kept.iter().filter_map(|k| match model.unknowns[*k] {
        unknown @ Unknown::Error(frame, component) if !component.is_rotation() => {
            Some((unknown, frame, fit.x[*k]))
        }
        _ => None,
    });
    let Some((unknown, frame, change)) = lengths.max_by(|a, b| a.2.abs().total_cmp(&b.2.abs())) else {
        return Ok(());
    };
    let times = change.abs() / deviation;
    if times < DOUBTED {
        return Ok(());
    }
    let length = |value: f64| number::length(value, setup.description.length);
    let statement = format!(
        "the fit changes a length of the frame `{}` by {} (`{}`), {} times the standard deviation of \
         its prior, {}",
        setup.description.frames[frame].name,
        length(change),
        model.name(unknown),
        number::digits(times, 2),
        length(deviation),
    );
    let help = format!(
        "check the units in the map, the dimensions in the spec, and that these are measurements of \
         this machine; `abbe doctor` tries other interpretations, and a larger `{PRIOR}` permits \
         larger errors"
    );
    if times > REFUSED {
        return Err(mistake::with_help(&data.file, statement, help));
    }
    notes.warn(&format!("{statement}: {help}"));
    Ok(())
}

/// Standard deviation of a place on the tool, as a share of the arm length, from which it is noted.
const VAGUE: f64 = 1e-3;

/// Returns a note if the position of a target on the tool, or of the measured frame, is determined
/// poorly: errors of the machine then stand for a part of it.
pub(super) fn tool_note(setup: &Setup, model: &Model, fit: &Fit) -> Option<String> {
    let kept = &fit.identifiable.kept;
    let sizes = |is_own: &dyn Fn(Unknown) -> bool| {
        let own = kept.iter().enumerate().filter(|(_, k)| is_own(model.unknowns[**k]));
        let squares = own.map(|(i, k)| (fit.x[*k].powi(2), fit.covariance[(i, i)]));
        let (value, variance) =
            squares.fold((0.0, 0.0), |(a, b), (value, variance)| (a + value, b + variance));
        (value.sqrt(), f64::sqrt(variance))
    };
    let count = model.targets_of(0).len();
    let at =
        |placement| model.station_of(placement).map_or(String::new(), |name| format!(" at station {name}"));
    let targets = (0..model.targets.len()).map(|j| {
        let at = at(j / count);
        let name =
            if count > 1 { format!("target {}{at}", j % count + 1) } else { format!("the target{at}") };
        (name, sizes(&|unknown| matches!(unknown, Unknown::Target(target, _) if target == j)))
    });
    let frames = (0..model.mountings.len()).map(|i| {
        let is_own =
            |unknown| matches!(unknown, Unknown::Tool(placement, c) if placement == i && !c.is_rotation());
        (format!("the measured frame{}", at(i)), sizes(&is_own))
    });
    let all = targets.chain(frames);
    let (name, (value, deviation)) = all.max_by(|(_, (_, a)), (_, (_, b))| a.total_cmp(b))?;
    let length = |value: f64| number::length(value, setup.description.length);
    (deviation > VAGUE * setup.arm).then(|| {
        format!(
            "note: the position of {name} on the tool is determined poorly: {}with a standard deviation of \
             {}. Other places, or errors of the machine, can stand for a part of it. Measure with more \
             orientations of the tool, or state the position: `placement = \"exact\"`",
            if setup.is_tool_open() { String::new() } else { length(value) + " from the stated one, " },
            length(deviation)
        )
    })
}

/// Returns a note on coordinates of the measured frame that the rows show only together with those
/// of the machine, as its height on a machine with vertical axes.
pub(super) fn sum_note(setup: &Setup, model: &Model, fit: &Fit) -> Option<String> {
    let is_shift = |k: usize| match model.unknowns[k] {
        Unknown::Base(_, component) | Unknown::Tool(_, component) => !component.is_rotation(),
        _ => false,
    };
    let is_of_base = |k: usize| matches!(model.unknowns[k], Unknown::Base(..));
    let held = fit.identifiable.redundant.iter().filter_map(|(k, acts_as)| {
        let Unknown::Tool(_, component) = model.unknowns[*k] else { return None };
        let is_sum = is_shift(*k) && acts_as.iter().all(|(other, _)| is_shift(*other));
        let of_base = acts_as.iter().filter(|(other, _)| is_sum && is_of_base(*other));
        let (base, _) = *of_base.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        let base = fit.identifiable.kept.iter().position(|kept| *kept == base)?;
        Some((component.name().trim_start_matches("e_"), fit.covariance[(base, base)]))
    });
    let (axes, variances): (Vec<_>, Vec<_>) = held.unzip();
    let largest = variances.into_iter().reduce(f64::max)?;
    let deviation = number::length(largest.sqrt(), setup.description.length);
    let (are, sums) = if axes.len() == 1 { ("is", "its sum") } else { ("are", "their sums") };
    let axes = axes.join(", ");
    Some(format!(
        "note: {axes} of the measured frame on the tool {are} held: these joints show only {sums} with the place of \
         the machine along the same direction, known to {deviation} or better (1 σ)"
    ))
}
