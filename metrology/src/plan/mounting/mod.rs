//! Numbers of the machine that the targets of a plan hide, and a place for a target that shows
//! them.
//!
//! `numbers` computes the standard deviation σ of each number after the measurement, and `places`
//! the information of the same rows with a target elsewhere; `report` and `sentences` are the
//! result. A number is hidden if σ is more than half of its prior although the number displaces the
//! tool point in use. Of the places within the reach of a bracket, the best one shows the most
//! hidden numbers and has the smallest
//!
//! ```text
//! c = max σ × displacement of the tool point by one unit of the number
//! ```
//!
//! over them and the numbers that they are confused with. The advised place is the nearest that
//! shows the same numbers and brings 90 % of the information of the best one, `ln(c₀/c)` with c₀ of
//! the planned target. The effect of a number is that of its own errors, not of its difference from
//! others: the difference has no effect on the planned target, however large it is.

mod numbers;
mod places;
mod report;

use abbe::analysis::sampling::norm;
use abbe::identify::{Failure, Measurement, Model, Observation};
use abbe_spec::Spec;

use crate::identify::{Setup, target_on_axis};
use abbe_study::calibration::tool_in_last_frame;
use numbers::{Basis, MachineNumbers, Posterior};
use places::{Mounting, displacements, farthest, is_in_tool};

pub use report::{HiddenNumber, TargetMounting};

/// Standard deviation of a number, as a share of its prior; larger ones count as hidden. It is the
/// limit beyond which an identification fixes an error at zero.
const HIDDEN: f64 = 0.5;

/// Correlation beyond which two numbers are confused.
const CONFUSED: f64 = 0.5;

/// Share of the information of the best place.
const MOST: f64 = 0.9;

/// Smallest displacement of the tool point by an error of the size of its prior, in uncertainties
/// of the instrument; smaller ones are rounding errors.
const ROUNDING: f64 = 1e-6;

/// Planned measurement whose targets are assessed.
pub(super) struct Assessed<'a> {
    pub(super) spec: &'a Spec,
    pub(super) setup: &'a Setup<'a>,
    /// Model with all constant errors.
    pub(super) model: &'a Model<'a>,
    pub(super) rows: &'a [Observation],
    /// Configurations of use.
    pub(super) used: &'a [Observation],
    /// Error of the model, per coordinate.
    pub(super) model_error: f64,
}

/// A place of a target, and what the rows show with it there.
struct Place {
    /// Displacement from the planned target.
    by: [f64; 3],
    /// Indices of the hidden numbers that are shown.
    shown: Vec<usize>,
    /// Those, and the numbers that they are confused with.
    named: Vec<usize>,
    /// Largest product c of a standard deviation and an effect.
    largest: f64,
}

impl Assessed<'_> {
    /// Returns none if whole poses or anything but coordinates of targets are measured, if stations
    /// have targets of their own, if the targets hide nothing, or if no place of a target helps.
    pub(super) fn mounting(&self) -> Result<Option<TargetMounting>, Failure> {
        let Self { model, rows, .. } = self;
        let are_points = |row: &Observation| match row.measured {
            Measurement::Points(_) => true,
            Measurement::Readings(_) => model.camera.is_none(),
            Measurement::Pose(_) => false,
        };
        let is_coordinate = model.observables.iter().all(|one| one.kind.is_angle || one.kind.name == "point");
        let has_one_placement = model.mountings.len() == 1 && !model.targets.is_empty();
        if !has_one_placement || !rows.iter().all(are_points) || !is_coordinate {
            return Ok(None);
        }
        let numbers = MachineNumbers::new(self.setup, model, self.spec)?.used_at(model, self.used)?;
        let basis = Basis::new(&numbers, model);
        let Some(planned) = basis.posterior(&model.information(rows, self.model_error)?) else {
            return Ok(None);
        };
        let matters =
            |i: &usize| numbers.effects[*i] * numbers.expected[*i] > ROUNDING * model.uncertainty.length;
        let is_hidden = |i: &usize| planned.deviation(*i) > HIDDEN * numbers.expected[*i];
        let hidden: Vec<usize> = (0..numbers.list.len()).filter(|i| matters(i) && is_hidden(i)).collect();
        if hidden.is_empty() {
            return Ok(None);
        }
        let mut best: Option<(Mounting, Place, Posterior)> = None;
        let mountings = [Mounting::moved(model, rows), Mounting::with_another(model, rows)];
        for mounting in mountings.into_iter().flatten() {
            let found = self.nearest(&mounting, &numbers, &planned, &hidden)?;
            let Some((place, posterior)) = found else { continue };
            if best.as_ref().is_none_or(|(_, best, _)| place.shown.len() > best.shown.len()) {
                best = Some((mounting, place, posterior));
            }
        }
        let Some((mounting, place, there)) = best else { return Ok(None) };
        let names = basis.names(&numbers, model);
        let number = |i: &usize| {
            let confused = |j: &usize| *j != *i && planned.correlation(*i, *j).abs() > CONFUSED;
            let mut confused_with: Vec<String> =
                (0..names.len()).filter(confused).map(|j| names[j].clone()).collect();
            confused_with.dedup();
            HiddenNumber {
                name: names[*i].clone(),
                is_hidden: place.shown.contains(i),
                confused_with,
                unit: if numbers.list[*i].is_angle { "rad" } else { self.spec.length.symbol() },
                prior: numbers.expected[*i],
                standard_deviation: planned.deviation(*i),
                standard_deviation_there: there.deviation(*i),
            }
        };
        Ok(Some(TargetMounting {
            target_on_axis: target_on_axis(self.setup, rows)?,
            numbers: place.named.iter().map(number).collect(),
            position: std::array::from_fn(|i| mounting.planned[i] + place.by[i]),
            distance: norm(place.by),
            is_additional: mounting.is_additional,
            planned_targets: model.targets.len(),
            is_exact: !model.unknowns.iter().any(|unknown| unknown.is_tool()),
        }))
    }

    /// Returns the nearest place that brings most of what the best one does, with the uncertainty
    /// of the numbers there; none if no place shows a hidden number.
    fn nearest(
        &self,
        mounting: &Mounting,
        numbers: &MachineNumbers,
        planned: &Posterior,
        hidden: &[usize],
    ) -> Result<Option<(Place, Posterior)>, Failure> {
        let unit = self.spec.length;
        let farthest = farthest(self.setup.arm, unit);
        let information = mounting.everywhere(farthest, self.model_error)?;
        let basis = Basis::new(numbers, &mounting.model);
        let largest = |posterior: &Posterior, named: &[usize]| {
            named.iter().map(|i| posterior.deviation(*i) * numbers.effects[*i]).fold(0.0, f64::max)
        };
        let place = |by: [f64; 3]| {
            let posterior = basis.posterior(&information.at(by))?;
            let is_shown = |i: &&usize| posterior.deviation(**i) <= HIDDEN * numbers.expected[**i];
            let shown: Vec<usize> = hidden.iter().filter(is_shown).copied().collect();
            let is_confused = |j: &usize| {
                !hidden.contains(j) && shown.iter().any(|i| planned.correlation(*i, *j).abs() > CONFUSED)
            };
            let mut named = shown.clone();
            named.extend((0..numbers.list.len()).filter(is_confused));
            let largest = largest(&posterior, &named);
            (!shown.is_empty()).then_some(Place { by, shown, named, largest })
        };
        let flange = tool_in_last_frame(mounting.model.manipulator).map_err(Failure::Machine)?;
        let flange = flange.inverse().position();
        let places = displacements(farthest, unit).into_iter();
        let places = places.filter(|by| !is_in_tool(*by, mounting.planned, flange));
        let mut places: Vec<Place> = places.filter_map(place).collect();
        let best = places.iter().max_by(|a, b| {
            let more = a.shown.len().cmp(&b.shown.len());
            more.then(b.largest.total_cmp(&a.largest))
        });
        let Some(best) = best else { return Ok(None) };
        let enough = MOST * (largest(planned, &best.named) / best.largest).ln();
        let is_enough = |here: &Place| {
            here.shown == best.shown && (largest(planned, &here.named) / here.largest).ln() >= enough
        };
        let Some(nearest) = places.iter().position(is_enough) else { return Ok(None) };
        let nearest = places.swap_remove(nearest);
        Ok(basis.posterior(&information.at(nearest.by)).map(|posterior| (nearest, posterior)))
    }
}
