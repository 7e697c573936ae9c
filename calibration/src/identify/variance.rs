//! Variance components: the actual uncertainty of each instrument, from its residuals in a fit.

use super::{Fit, Measurement, Model, Observation, Result, linearize, with_priors};

/// Variance component of one instrument, or of positions or rotations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VarianceComponent {
    /// Number of its readings.
    pub numbers: usize,
    /// Redundancy of its readings: `Σ (1 − h_i)`, with `h_i` the leverage of reading i.
    pub freedom: f64,
    /// Factor of its uncertainty that explains its residuals: `√(Σ r_i² / freedom)`; 0 without
    /// readings.
    pub factor: f64,
}

/// Estimates the variance component of each [instrument](super::Observable::instrument) at a fit;
/// of positions and of rotations, in this order, where points or poses are measured.
///
/// Förstner, *Ein Verfahren zur Schätzung von Varianz- und Kovarianzkomponenten*, 1979: repetition
/// with the new uncertainties until the factors are 1 converges to Helmert's estimates.
pub fn variance_components(model: &Model, data: &[Observation], fit: &Fit) -> Result<Vec<VarianceComponent>> {
    let (kept, x) = fit.of_kept(model);
    let p = x.len();
    let problem = with_priors(linearize(&kept, data, &x, Some(&fit.weights))?, &fit.prior, &x);
    let root = problem.a.rows(0, p.min(problem.a.nrows())).transpose();
    let count = model.observables.iter().map(|reading| reading.instrument + 1).max().unwrap_or(2);
    let mut components = vec![VarianceComponent::default(); count];
    let mut squares = vec![0.0; count];
    let mut kept = kept.at(&x);
    for (observation, weight) in data.iter().zip(&fit.weights).filter(|(_, weight)| **weight > 0.0) {
        let instruments: Vec<usize> = match &observation.measured {
            Measurement::Readings(values) => {
                let read = values.iter().zip(&model.observables).filter(|(value, _)| value.is_some());
                read.map(|(_, observable)| observable.instrument).collect()
            }
            Measurement::Pose(_) => vec![0, 0, 0, 1, 1, 1],
            Measurement::Points(_) => vec![0; observation.count()],
        };
        let mut instruments = instruments.into_iter();
        kept.linear(observation, |residual, row| {
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
