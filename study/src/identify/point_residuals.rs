//! What is left of every point, for pictures.

use abbe::identify::{Failure, Model, Observation, Room};

/// A measured point, and by how much the models miss it.
#[derive(Clone, Debug)]
pub struct PointResidual {
    /// The line of its row.
    pub line: u64,
    /// The joints of its row.
    pub q: Vec<f64>,
    /// The tool point as the identified model has it, as the instrument sees it.
    pub point: [f64; 3],
    /// Measured minus model with base and tool fitted.
    pub before: [f64; 3],
    /// Measured minus the identified model.
    pub after: [f64; 3],
    /// Whether it was for judging alone.
    pub is_test: bool,
    /// Whether it was left out as a gross error.
    pub is_rejected: bool,
}

/// A model and the values of its unknowns.
pub(super) struct Valued<'m> {
    model: &'m Model<'m>,
    x: &'m [f64],
    room: Room,
}

impl<'m> Valued<'m> {
    pub(super) fn new(model: &'m Model<'m>, x: &'m [f64]) -> Self {
        Self { model, x, room: model.room() }
    }

    fn missed(&mut self, row: &Observation) -> Result<Vec<[f64; 3]>, Failure> {
        let points = self.model.deviations(&mut self.room, row, self.x)?;
        Ok(points.into_iter().map(|point| point.map(|v| -v)).collect())
    }

    /// The points of a row; `self` is the identified model.
    pub(super) fn residuals(
        &mut self,
        before: &mut Valued,
        row: &Observation,
        is_test: bool,
        is_rejected: bool,
    ) -> Result<Vec<PointResidual>, Failure> {
        let point = self.model.pose(&mut self.room, row, self.x)?.position();
        let both = before.missed(row)?.into_iter().zip(self.missed(row)?);
        let one = |(before, after)| PointResidual {
            line: row.line,
            q: row.q.to_vec(),
            point,
            before,
            after,
            is_test,
            is_rejected,
        };
        Ok(both.map(one).collect())
    }
}
