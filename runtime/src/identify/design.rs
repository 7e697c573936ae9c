//! Where to measure: the poses of a list that determine the unknowns best.

use nalgebra::{DMatrix, DVector};

use super::{Failure, Identifiable, Model, Observation};

/// Poses chosen from a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// By index in the list, ascending; a pose that is worth measuring again stands there again.
    pub chosen: Vec<usize>,
    /// `ln det(JᵀJ)` of columns that over the whole list have unit length: what is made as large as can be.
    pub log_det: f64,
    /// Covariance of the unknowns, by one standard deviation of the instrument.
    pub covariance: DMatrix<f64>,
    /// How many exchanges were made.
    pub exchanges: usize,
}

/// `count` of the `candidates` with the largest determinant of information: D-optimal, by exchange (DETMAX).
///
/// The unknowns of `model` are those that can be known; what was seen at the candidates does not matter, only which
/// targets or poses would be. None if `count` poses cannot determine them.
///
/// Mitchell, *An algorithm for the construction of D-optimal experimental designs*, 1974: a pose is added where the
/// prediction is worst, the one that is missed least is taken away, as long as that gains.
pub fn d_optimal(
    model: &Model,
    candidates: &[Observation],
    identifiable: &Identifiable,
    count: usize,
) -> Result<Option<Design>, Failure> {
    designed(model, candidates, identifiable, count, 20 * count.max(10))
}

/// A list as it is: every pose once.
pub fn whole(
    model: &Model,
    list: &[Observation],
    identifiable: &Identifiable,
) -> Result<Option<Design>, Failure> {
    designed(model, list, identifiable, list.len(), 0)
}

fn designed(
    model: &Model,
    candidates: &[Observation],
    identifiable: &Identifiable,
    count: usize,
    most: usize,
) -> Result<Option<Design>, Failure> {
    let kept = model.with(identifiable.kept.iter().map(|k| model.unknowns[*k]).collect());
    let p = kept.unknowns.len();
    let mut rows = jacobians(&kept, candidates)?;
    let lengths = DVector::from_fn(p, |k, _| {
        let square: f64 = rows.iter().map(|block| block.column(k).norm_squared()).sum();
        (square / candidates.len().max(1) as f64).sqrt().max(1e-300)
    });
    for block in &mut rows {
        for k in 0..p {
            block.column_mut(k).scale_mut(1.0 / lengths[k]);
        }
    }

    // A start that is spread over the list, held up by a little of everything.
    let mut chosen: Vec<usize> = (0..count).map(|i| i * candidates.len() / count.max(1)).collect();
    let ridge = DMatrix::<f64>::identity(p, p) * 1e-9;
    let sum = |chosen: &[usize]| chosen.iter().fold(ridge.clone(), |sum, i| sum + rows[*i].tr_mul(&rows[*i]));
    let mut exchanges = 0;
    for _ in 0..most {
        let Some(inverse) = sum(&chosen).cholesky().map(|c| c.inverse()) else { return Ok(None) };
        // det(M + JᵀJ) = det M · det(1 + J M⁻¹ Jᵀ).
        let gain = |i: usize, sign: f64, inverse: &DMatrix<f64>| {
            let block = &rows[i];
            let n = block.nrows();
            (DMatrix::identity(n, n) + block * inverse * block.transpose() * sign).determinant()
        };
        let all = (0..rows.len()).map(|i| (i, gain(i, 1.0, &inverse)));
        let Some((add, gained)) = all.max_by(|a, b| a.1.total_cmp(&b.1)) else { return Ok(None) };
        chosen.push(add);
        let Some(inverse) = sum(&chosen).cholesky().map(|c| c.inverse()) else { return Ok(None) };
        let all = chosen.iter().enumerate().map(|(place, i)| (place, gain(*i, -1.0, &inverse)));
        let Some((remove, lost)) = all.max_by(|a, b| a.1.total_cmp(&b.1)) else { return Ok(None) };
        chosen.remove(remove);
        if gained * lost <= 1.0 + 1e-9 {
            break;
        }
        exchanges += 1;
    }
    chosen.sort_unstable();
    let information = sum(&chosen) - ridge;
    let Some(cholesky) = information.cholesky() else { return Ok(None) };
    let log_det = 2.0 * cholesky.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>();
    let inverse = cholesky.inverse();
    let covariance = DMatrix::from_fn(p, p, |i, j| inverse[(i, j)] / (lengths[i] * lengths[j]));
    Ok(Some(Design { chosen, log_det, covariance, exchanges }))
}

fn jacobians(model: &Model, list: &[Observation]) -> Result<Vec<DMatrix<f64>>, Failure> {
    let p = model.unknowns.len();
    let x = vec![0.0; p];
    let mut room = model.room();
    let one = |observation: &Observation| {
        let mut block = DMatrix::zeros(observation.count(), p);
        let mut at = 0;
        model.residuals(&mut room, observation, &x, |_, derivative| {
            for k in 0..p {
                block[(at, k)] = derivative(k);
            }
            at += 1;
        })?;
        Ok(block)
    };
    list.iter().map(one).collect()
}

/// The standard deviation of the predicted point of the first target at every configuration of a list, from the
/// covariance of the kept unknowns: `√ tr(J C Jᵀ)`. The length unit.
pub fn predicted(
    model: &Model,
    identifiable: &Identifiable,
    covariance: &DMatrix<f64>,
    list: &[Observation],
) -> Result<Vec<f64>, Failure> {
    let kept = model.with(identifiable.kept.iter().map(|k| model.unknowns[*k]).collect());
    let blocks = jacobians(&kept, list)?;
    let length = model.uncertainty.length;
    Ok(blocks
        .iter()
        .map(|block| {
            let point = block.rows(0, block.nrows().min(3));
            (point * covariance * point.transpose()).trace().max(0.0).sqrt() * length
        })
        .collect())
}
