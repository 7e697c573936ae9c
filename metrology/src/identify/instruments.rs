//! Uncertainty of every instrument, and of positions and rotations, as stated or as estimated from
//! the data.

use abbe::identify::{Failure, Fit, Model, Options, VarianceComponent, variance_components};
use serde::Serialize;

use super::{Settings, Setup, diagnose, priors::fit_with_places};
use crate::data::{Data, Map};
use abbe_study::{Result, mistake, number::digits};

/// Largest number of iterations of the estimation.
const ROUNDS: usize = 25;

/// Degrees of freedom below which instruments of one kind share an estimate.
const ALONE: f64 = 10.0;

/// Least degrees of freedom of an estimate, whose standard deviation is then a third of its value.
const LEAST: f64 = 5.0;

/// Estimate, as a share of the arm length or in rad, below which a fit reproduces the values
/// exactly.
const EXACT: f64 = 1e-9;

/// Ratio of the factors of positions and rotations from which their uncertainties contradict each
/// other, and its least distance from 1 in standard deviations.
const UNEQUAL: f64 = 1.5;
const SIGNIFICANT: f64 = 4.0;

/// Instrument, or positions or rotations, and its residuals.
#[derive(Clone, Debug, Serialize)]
pub struct InstrumentFit {
    /// Name in the map, `positions` or `rotations`.
    pub name: String,
    /// Number of values that it measured.
    pub numbers: usize,
    /// Degrees of freedom of its residuals.
    pub freedom: f64,
    /// Standard deviation used in the fit, in `unit`.
    pub uncertainty: f64,
    /// Unit: the length unit, rad or px.
    pub unit: &'static str,
    /// Is true if the uncertainty was estimated from these data.
    pub estimated: bool,
    /// Factor of the uncertainty that explains its residuals.
    pub factor: f64,
}

/// Part of the measurements with an uncertainty of its own: an instrument, or all positions or
/// rotations. Its place in a list of all parts is its index among the variance components.
struct Part<'m> {
    name: &'m str,
    /// Kind of its instrument; empty for positions and rotations.
    kind: &'static str,
    is_angle: bool,
    is_estimated: bool,
}

/// Returns all parts of the measurements of a map.
fn parts(map: &Map) -> Vec<Part<'_>> {
    if let Some(all) = map.instruments() {
        let parts = all.list.iter().map(|one| Part {
            name: &one.name,
            kind: one.kind.name,
            is_angle: one.kind.is_angle,
            is_estimated: one.uncertainty.is_none(),
        });
        return parts.collect();
    }
    let [length, angle] = map.is_estimated;
    let positions = Part { name: "positions", kind: "", is_angle: false, is_estimated: length };
    let rotations = Part { name: "rotations", kind: "", is_angle: true, is_estimated: angle };
    std::iter::once(positions).chain(map.is_pose().then_some(rotations)).collect()
}

/// Returns the uncertainties of the values of a part.
fn uncertainties<'m>(model: &'m mut Model, part: usize) -> Vec<&'m mut f64> {
    match (model.observables.is_empty(), part) {
        (true, 0) => vec![&mut model.uncertainty.length],
        (true, _) => vec![&mut model.uncertainty.angle],
        (false, part) => {
            let own = model.observables.iter_mut().filter(|reading| reading.instrument == part);
            own.map(|reading| &mut reading.uncertainty).collect()
        }
    }
}

/// Returns the uncertainty of a part.
fn uncertainty(model: &Model, part: usize) -> f64 {
    match (model.observables.iter().find(|reading| reading.instrument == part), part) {
        (Some(reading), _) => reading.uncertainty,
        (None, 0) => model.uncertainty.length,
        (None, _) => model.uncertainty.angle,
    }
}

/// Estimates the uncertainty of every instrument without a stated one, and that of positions and
/// rotations, from the residuals of a fit of constant errors.
pub(super) fn estimate(setup: &mut Setup, map: &Map, data: &Data, settings: &Settings) -> Result<()> {
    let parts = parts(map);
    let unknown: Vec<usize> = (0..parts.len()).filter(|i| parts[*i].is_estimated).collect();
    if unknown.is_empty() {
        return Ok(());
    }
    let refuse = |these: &[usize], reason: &str| {
        let names = these.iter().map(|i| match parts[*i].kind {
            "" => parts[*i].name.to_owned(),
            _ => format!("`{}`", parts[*i].name.escape_debug()),
        });
        let names = names.collect::<Vec<_>>().join(", ");
        let message = format!("the uncertainty of {names} cannot be estimated: {reason}");
        let help = "state `uncertainty` from the data sheet, or measure at more configurations";
        mistake::with_help(&data.file, message, help)
    };
    let (mut at, mut shared) = (Vec::new(), None);
    for _ in 0..ROUNDS {
        let model = setup.real.with(setup.unknowns(settings.holds_errors()));
        let estimated = || -> Result<_, Failure> {
            let (priors, scaled) = (settings.prior.for_model(&model, setup)?, settings.prior.scaled(&model));
            let options =
                Options { at: at.clone(), priors, scaled, loss: settings.loss, ..Options::default() };
            let found = fit_with_places(&model, &data.observations, options)?;
            Ok((variance_components(&model, &data.observations, &found)?, found.x))
        };
        let (components, x) = estimated().map_err(|failure| match failure {
            Failure::NotConverged { .. } => {
                refuse(&unknown, &format!("the fit of {} rows does not converge", data.observations.len()))
            }
            failure => diagnose(&failure, data),
        })?;
        at = x;
        let mut most: f64 = 0.0;
        for group in shared.get_or_insert_with(|| groups(&parts, &components)).iter() {
            let sum = |value: fn(&VarianceComponent) -> f64| -> f64 {
                group.iter().map(|i| value(&components[*i])).sum()
            };
            let (freedom, squares) = (sum(|one| one.freedom), sum(|one| one.freedom * one.factor.powi(2)));
            if freedom < LEAST {
                let numbers: usize = group.iter().map(|i| components[*i].numbers).sum();
                let reason = format!(
                    "{numbers} values leave {} degrees of freedom beside the unknowns, and {LEAST} are needed",
                    digits(freedom, 2)
                );
                return Err(refuse(group, &reason));
            }
            let factor = (squares / freedom).sqrt();
            let unit = if parts[group[0]].is_angle { 1.0 } else { setup.arm };
            if factor * uncertainty(&setup.real, group[0]) < EXACT * unit {
                return Err(refuse(group, "the fit reproduces these values exactly, so it tends to 0"));
            }
            most = most.max(factor.ln().abs());
            for model in [&mut setup.ideal, &mut setup.real] {
                for part in group {
                    uncertainties(model, *part).into_iter().for_each(|sigma| *sigma *= factor);
                }
            }
        }
        if most < 1e-3 {
            break;
        }
    }
    Ok(())
}

/// Groups the parts that share an estimate: instruments of one kind with few degrees of freedom.
fn groups(parts: &[Part<'_>], components: &[VarianceComponent]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let is_few = |i: usize| components[i].freedom < ALONE;
    let is_measured = |i: &usize| components.get(*i).is_some_and(|one| one.numbers > 0);
    for i in (0..parts.len()).filter(|i| parts[*i].is_estimated).filter(is_measured) {
        let kind = parts[i].kind;
        let joins = |group: &&mut Vec<usize>| {
            !kind.is_empty() && is_few(i) && is_few(group[0]) && parts[group[0]].kind == kind
        };
        match groups.iter_mut().find(joins) {
            Some(group) => group.push(i),
            None => groups.push(vec![i]),
        }
    }
    groups
}

/// Returns the residual statistics of every instrument, or of positions and rotations.
fn part_fits(model: &Model, map: &Map, data: &Data, found: &Fit) -> Result<Vec<InstrumentFit>, Failure> {
    let components = variance_components(model, &data.observations, found)?;
    let length = model.manipulator.description().length.symbol();
    let fits = parts(map).into_iter().zip(components).enumerate().map(|(i, (part, component))| {
        let VarianceComponent { numbers, freedom, factor } = component;
        let unit = match model.observables.iter().find(|reading| reading.instrument == i) {
            Some(reading) => reading.kind.unit(length),
            None if part.is_angle => "rad",
            None => length,
        };
        InstrumentFit {
            name: part.name.to_owned(),
            numbers,
            freedom,
            uncertainty: uncertainty(model, i),
            unit,
            estimated: part.is_estimated,
            factor,
        }
    });
    Ok(fits.collect())
}

/// Returns the residual statistics of every instrument, and those of positions and rotations where
/// poses are measured or where their uncertainty was estimated; otherwise empty.
pub(super) fn instrument_and_coordinate_fits(
    model: &Model,
    map: &Map,
    data: &Data,
    found: &Fit,
) -> Result<[Vec<InstrumentFit>; 2], Failure> {
    Ok(match map.instruments() {
        Some(_) => [part_fits(model, map, data, found)?, Vec::new()],
        None if map.is_pose() || map.is_estimated[0] => [Vec::new(), part_fits(model, map, data, found)?],
        None => Default::default(),
    })
}

/// Returns a note if the residuals contradict the ratio of the stated uncertainties of positions
/// and rotations, by which the fit weights them.
pub(super) fn unequal_note(coordinates: &[InstrumentFit]) -> Option<String> {
    let [positions, rotations] = coordinates else { return None };
    if positions.estimated && rotations.estimated || positions.factor.min(rotations.factor) <= 0.0 {
        return None;
    }
    let ratio = (rotations.factor / positions.factor).ln().abs();
    // The standard deviation of ln s is 1/√(2f) with f degrees of freedom.
    let deviation = (0.5 / positions.freedom + 0.5 / rotations.freedom).sqrt();
    (ratio > UNEQUAL.ln() && ratio > SIGNIFICANT * deviation).then(|| {
        format!(
            "note: the residuals of positions are {} times `uncertainty`, those of rotations {} times \
             `angle_uncertainty`. Their ratio decides how the fit weights them: `\"unknown\"` for both \
             estimates it from these data",
            digits(positions.factor, 2),
            digits(rotations.factor, 2)
        )
    })
}
