//! Uncertainty of every instrument, as stated or as estimated from the data.

use abbe::identify::{Failure, Fit, Model, Options, VarianceComponent, fit, variance_components};
use serde::Serialize;

use super::priors::Prior;
use super::setup::Setup;
use crate::data::{Data, Map};

/// Largest number of iterations of the estimation.
const ROUNDS: usize = 25;

/// Instrument and its residuals.
#[derive(Clone, Debug, Serialize)]
pub struct InstrumentFit {
    /// Name in the map.
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

/// Estimates the uncertainty of every instrument without a stated one from its residuals after a
/// fit of constant errors.
pub(super) fn estimate(setup: &mut Setup, map: &Map, data: &Data, prior: Prior) -> Result<(), Failure> {
    let Some(all) = map.instruments() else { return Ok(()) };
    if all.list.iter().all(|instrument| instrument.uncertainty.is_some()) {
        return Ok(());
    }
    let mut at = Vec::new();
    for _ in 0..ROUNDS {
        let model = setup.real.with(setup.constants());
        let priors = prior.for_model(&model)?;
        let expected = model.expected(&priors)?;
        let found = fit(&model, &data.observations, &Options { at, priors, expected, ..Options::default() })?;
        let factors = variance_components(&model, &data.observations, &found)?;
        at = found.x;
        let mut most: f64 = 0.0;
        for (i, component) in factors.iter().enumerate() {
            // Without degrees of freedom there is no estimate.
            if all.list[i].uncertainty.is_some() || component.freedom < 1.0 || component.factor == 0.0 {
                continue;
            }
            most = most.max(component.factor.ln().abs());
            for model in [&mut setup.ideal, &mut setup.real] {
                let own = model.observables.iter_mut().filter(|reading| reading.instrument == i);
                own.for_each(|reading| reading.uncertainty *= component.factor);
            }
        }
        if most < 1e-3 {
            break;
        }
    }
    Ok(())
}

/// Returns the residual statistics of every instrument; empty if the map has no instruments.
pub(super) fn instrument_fits(
    model: &Model,
    map: &Map,
    data: &Data,
    found: &Fit,
) -> Result<Vec<InstrumentFit>, Failure> {
    let Some(all) = map.instruments() else { return Ok(Vec::new()) };
    let components = variance_components(model, &data.observations, found)?;
    let length = model.manipulator.description().length.symbol();
    let fits = all.list.iter().zip(components).map(|(instrument, component)| {
        let VarianceComponent { numbers, freedom, factor } = component;
        let reading = &model.observables[instrument.observables.start];
        InstrumentFit {
            name: instrument.name.clone(),
            numbers,
            freedom,
            uncertainty: reading.uncertainty,
            unit: reading.kind.unit(length),
            estimated: instrument.uncertainty.is_none(),
            factor,
        }
    });
    Ok(fits.collect())
}
