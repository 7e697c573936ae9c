//! The uncertainty of every instrument: as stated, or estimated from the data.

use abbe::identify::{Failure, Fit, Model, Options, VarianceComponent, fit, variance_components};
use serde::Serialize;

use super::priors::Prior;
use super::setup::Setup;
use crate::data::{Data, Map};

/// How often uncertainties are estimated anew, at most.
const ROUNDS: usize = 25;

/// An instrument and its residuals.
#[derive(Clone, Debug, Serialize)]
pub struct InstrumentFit {
    /// What the map calls it.
    pub name: String,
    /// How many numbers it told.
    pub numbers: usize,
    /// How many of them are left over to judge it by.
    pub freedom: f64,
    /// One standard deviation that it counted with.
    pub uncertainty: f64,
    /// The length unit, or rad.
    pub unit: &'static str,
    /// Whether that was estimated from these data.
    pub estimated: bool,
    /// What it must be multiplied with to explain what is left of its numbers.
    pub factor: f64,
}

/// Gives every instrument of unknown uncertainty the one that explains what constant errors leave of its own numbers.
pub(super) fn estimate(setup: &mut Setup, map: &Map, data: &Data, prior: Prior) -> Result<(), Failure> {
    let Some(all) = map.instruments() else { return Ok(()) };
    if all.list.iter().all(|instrument| instrument.uncertainty.is_some()) {
        return Ok(());
    }
    let mut at = Vec::new();
    for _ in 0..ROUNDS {
        let model = setup.real.with(setup.constants());
        let priors = prior.of_model(&model)?;
        let expected = model.expected(&priors)?;
        let found = fit(&model, &data.observations, &Options { at, priors, expected, ..Options::default() })?;
        let factors = variance_components(&model, &data.observations, &found)?;
        at = found.x;
        let mut most: f64 = 0.0;
        for (i, component) in factors.iter().enumerate() {
            // What has nothing left over says nothing of itself.
            if all.list[i].uncertainty.is_some() || component.freedom < 1.0 || component.factor == 0.0 {
                continue;
            }
            most = most.max(component.factor.ln().abs());
            for model in [&mut setup.ideal, &mut setup.real] {
                let own = model.readings.iter_mut().filter(|reading| reading.instrument == i);
                own.for_each(|reading| reading.uncertainty *= component.factor);
            }
        }
        if most < 1e-3 {
            break;
        }
    }
    Ok(())
}

/// What is left of the numbers of every instrument.
pub(super) fn instrument_fits(
    model: &Model,
    map: &Map,
    data: &Data,
    found: &Fit,
) -> Result<Vec<InstrumentFit>, Failure> {
    let Some(all) = map.instruments() else { return Ok(Vec::new()) };
    let components = variance_components(model, &data.observations, found)?;
    let length = model.manipulator.description().length.symbol();
    let told = all.list.iter().zip(components).map(|(instrument, component)| {
        let VarianceComponent { numbers, freedom, factor } = component;
        let reading = &model.readings[instrument.readings.start];
        InstrumentFit {
            name: instrument.name.clone(),
            numbers,
            freedom,
            uncertainty: reading.uncertainty,
            unit: if reading.gauge.is_angle() { "rad" } else { length },
            estimated: instrument.uncertainty.is_none(),
            factor,
        }
    });
    Ok(told.collect())
}
