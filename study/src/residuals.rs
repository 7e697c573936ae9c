//! Measured rows with their errors, for the picture of a page.

use std::sync::Arc;

use abbe::{Pose, identify::Observation};
use abbe_spec::Spec;
use serde::Serialize;

/// Largest number of rows on a page.
const COUNT: usize = 400;

/// Measured rows with their errors, evenly chosen.
#[derive(Clone, Debug, Serialize)]
pub struct Residuals {
    /// Name of the errors `before`; `None` if there are none.
    pub before: Option<String>,
    /// Name of the errors `after`.
    pub after: String,
    /// Number of rows, including those that are left out.
    pub count: usize,
    /// Rows in file order, at most 400.
    pub rows: Vec<Residual>,
    /// Spec of the machine that was found; none where the rows are those of the given one.
    #[serde(skip)]
    pub found: Option<Arc<Spec>>,
}

/// Row with its errors, in `F_0` and the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct Residual {
    /// Line in the data file, from 1.
    pub line: u64,
    /// Joint variables, in the length unit and rad.
    #[serde(skip)]
    pub q: Vec<f64>,
    /// Inputs of the spec, in their units.
    #[serde(skip)]
    pub u: Vec<f64>,
    /// Point at which the error is drawn.
    pub point: [f64; 3],
    /// Position error before, such as that of the uncorrected command; `None` if there is none.
    pub before: Option<[f64; 3]>,
    /// Position error after.
    pub after: [f64; 3],
}

impl Residual {
    /// Creates the residual of a row without errors.
    pub fn new(row: &Observation, q: &[f64], point: [f64; 3], after: [f64; 3]) -> Self {
        Self { line: row.line, q: q.to_vec(), u: row.u.to_vec(), point, before: None, after }
    }

    /// Converts from the frame of an instrument, in which `F_0` has the pose `station`.
    pub fn in_f0(self, station: &Pose) -> Self {
        let to_base = station.inverse();
        Self {
            point: to_base.apply(self.point),
            before: self.before.map(|error| to_base.turn(error)),
            after: to_base.turn(self.after),
            ..self
        }
    }
}

impl Residuals {
    /// Chooses rows evenly. Returns `None` without rows.
    pub fn new<'r, R>(
        before: Option<&str>,
        after: &str,
        rows: &'r [R],
        residual: impl Fn(&'r R) -> Residual,
    ) -> Option<Self> {
        let (before, after, count) = (before.map(str::to_owned), after.to_owned(), rows.len());
        let rows: Vec<Residual> = rows.iter().step_by(count.div_ceil(COUNT).max(1)).map(residual).collect();
        (!rows.is_empty()).then_some(Self { before, after, count, rows, found: None })
    }
}
