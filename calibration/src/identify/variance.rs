//! How good every instrument of a fit is, from what is left of its own numbers: variance components.

use super::linearize::{linearize, with_priors};
use super::{Failure, Fit, Measurement, Model, Observation};

/// What is left of the numbers of one instrument.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VarianceComponent {
    /// How many numbers it told.
    pub numbers: usize,
    /// How many of them are left over: `Σ (1 − h_i)`, `h_i` the leverage of number i.
    pub freedom: f64,
    /// What its uncertainty must be multiplied with to explain what is left: `√(Σ r_i² / freedom)`; 0 without numbers.
    pub factor: f64,
}

/// By [instrument](super::Reading::instrument), at the fit. All other measurements count as instrument 0.
///
/// Förstner, *Ein Verfahren zur Schätzung von Varianz- und Kovarianzkomponenten*, 1979: repeated with the new uncertainties
/// until the factors are 1, it leads to the estimates of Helmert.
pub fn variance_components(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
) -> Result<Vec<VarianceComponent>, Failure> {
    let kept = model.with(fit.identifiable.kept.iter().map(|k| model.unknowns[*k]).collect());
    let pick = |k: &usize| (fit.x[*k], fit.priors.get(*k).copied().flatten());
    let (x, priors): (Vec<f64>, Vec<Option<f64>>) = fit.identifiable.kept.iter().map(pick).unzip();
    let p = x.len();
    let problem = with_priors(linearize(&kept, data, &x, Some(&fit.weights))?, &priors, &x);
    let root = problem.a.rows(0, p.min(problem.a.nrows())).transpose();
    let count = model.readings.iter().map(|reading| reading.instrument + 1).max().unwrap_or(1);
    let mut components = vec![VarianceComponent::default(); count];
    let mut squares = vec![0.0; count];
    let mut room = kept.room();
    for (observation, weight) in data.iter().zip(&fit.weights).filter(|(_, weight)| **weight > 0.0) {
        let instruments: Vec<usize> = match &observation.measured {
            Measurement::Readings(values) => {
                let told = values.iter().zip(&model.readings).filter(|(value, _)| value.is_some());
                told.map(|(_, reading)| reading.instrument).collect()
            }
            _ => vec![0; observation.count()],
        };
        let mut instruments = instruments.into_iter();
        kept.linear(&mut room, observation, &x, |residual, row| {
            let instrument = instruments.next().unwrap_or(0);
            let row = nalgebra::DVector::from_column_slice(row) * weight.sqrt();
            // j (RᵀR)⁻¹ jᵀ = |R⁻ᵀ j|².
            let leverage = root.solve_lower_triangular(&row).map_or(1.0, |part| part.norm_squared());
            components[instrument].numbers += 1;
            components[instrument].freedom += (1.0 - leverage).max(0.0);
            squares[instrument] += weight * residual * residual;
        })?;
    }
    for (component, square) in components.iter_mut().zip(squares).filter(|(c, _)| c.freedom > 0.0) {
        component.factor = (square / component.freedom).sqrt();
    }
    Ok(components)
}
