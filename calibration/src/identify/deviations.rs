//! Position errors of observations, and their figures.

use core::borrow::Borrow;

use super::{Camera, Distances, EvaluatedModel, Figures, Measurement, Model, Observation, Result, by_blocks};
use abbe_analysis::{sampling, sampling::vectors::subtract as difference};
use abbe_core::Pose;

impl EvaluatedModel<'_> {
    /// Returns position errors, model minus measurement: one vector for each measured point, in the
    /// axes of the instrument and the length unit.
    ///
    /// A reading of a length has an error along its gradient, an instrument that reads three
    /// coordinates one vector; angles have none. A corner that a camera sees has its vector from
    /// the line of sight of its pixel.
    pub fn deviations(&mut self, observation: &Observation) -> Result<Vec<[f64; 3]>> {
        let mut values = Vec::new();
        self.each_deviation(observation, |deviation| values.push(deviation))?;
        Ok(values)
    }

    /// Passes each of the [deviations](Self::deviations) to `take`.
    pub(super) fn each_deviation(
        &mut self,
        observation: &Observation,
        mut take: impl FnMut([f64; 3]),
    ) -> Result<()> {
        let model = self.model;
        self.chain(observation)?;
        let last = self.tool_pose();
        match &observation.measured {
            Measurement::Points(points) => {
                for (j, measured) in points.iter().enumerate() {
                    let Some(measured) = measured else { continue };
                    take(difference(last.apply(self.target(observation, j)?), *measured));
                }
            }
            Measurement::Pose(measured) => take(difference(last.position(), measured.position())),
            Measurement::Readings(readings) => {
                if let Some(camera) = &self.camera {
                    model.each_off_sight(camera, &last, readings, take);
                    return Ok(());
                }
                let geometry = self.geometry();
                let mut of_instrument: Option<[f64; 3]> = None;
                for (i, (measured, observable)) in readings.iter().zip(&model.observables).enumerate() {
                    if observable.axis == 0 {
                        of_instrument.take().into_iter().for_each(&mut take);
                    }
                    let Some(measured) = measured.filter(|_| !observable.kind.is_angle) else { continue };
                    let evaluation = self.evaluate(&geometry, i);
                    let along = geometry.base.turn(evaluation.along);
                    let mut sum = of_instrument.unwrap_or_default();
                    (0..3).for_each(|k| sum[k] += (evaluation.value - measured) * along[k]);
                    of_instrument = Some(sum);
                }
                of_instrument.into_iter().for_each(take);
            }
        }
        Ok(())
    }

    /// Returns the norms of the [deviations](Self::deviations).
    pub fn distances(&mut self, observation: &Observation) -> Result<Vec<f64>> {
        Ok(self.deviations(observation)?.into_iter().map(sampling::norm).collect())
    }
}

impl Model<'_> {
    /// Passes the vector of each corner from its line of sight to `take`; if the camera is on the
    /// tool, that of the line of sight from the corner.
    fn each_off_sight(
        &self,
        camera: &Camera,
        tool: &Pose,
        readings: &[Option<f64>],
        mut take: impl FnMut([f64; 3]),
    ) {
        for (pixel, corner) in readings.chunks_exact(2).zip(self.observables.chunks_exact(2)) {
            let ([Some(u), Some(v)], corner) = (pixel, corner[0].corner) else { continue };
            let off = camera.off_sight(camera.seen(tool, corner), [*u, *v]);
            take(if camera.is_on_tool { tool.turn(off).map(|v| -v) } else { off });
        }
    }

    /// Returns whether a row has any [deviations](EvaluatedModel::deviations).
    pub(super) fn has_deviations(&self, observation: &Observation) -> bool {
        match &observation.measured {
            Measurement::Points(points) => points.iter().any(Option::is_some),
            Measurement::Pose(_) => true,
            Measurement::Readings(values) => {
                let mut values = values.iter().zip(&self.observables);
                values.any(|(value, reading)| value.is_some() && !reading.kind.is_angle)
            }
        }
    }

    /// Computes the figures of the position errors of all observations at `x`; the length unit.
    pub fn figures<R: Borrow<Observation> + Sync>(&self, rows: &[R], x: &[f64]) -> Result<Figures> {
        Ok(self.all_distances(rows, x)?.into_figures())
    }

    /// Returns the norms of the position errors of all observations at `x`; the length unit.
    pub fn all_distances<R: Borrow<Observation> + Sync>(&self, rows: &[R], x: &[f64]) -> Result<Distances> {
        self.distances_where(rows, |_| Some(x))
    }

    /// Returns the norms of the position errors of rows; `x` returns the unknowns of a row by its
    /// index, or none to skip it.
    pub fn distances_where<'x, R: Borrow<Observation> + Sync>(
        &self,
        rows: &[R],
        x: impl Fn(usize) -> Option<&'x [f64]> + Sync,
    ) -> Result<Distances> {
        let block = |first: usize, rows: &[R]| {
            let mut here = self.at(&[]);
            let mut norms = Vec::with_capacity(rows.len());
            for (i, row) in rows.iter().enumerate() {
                let Some(x) = x(first + i) else { continue };
                here.x.clear();
                here.x.extend(x);
                let row = row.borrow();
                let norm = |deviation| norms.push((row.configuration, sampling::norm(deviation)));
                here.each_deviation(row, norm)?;
            }
            Ok(norms)
        };
        let mut distances = Distances::default();
        by_blocks(rows, block, |part| distances.extend(part))?;
        Ok(distances)
    }
}
