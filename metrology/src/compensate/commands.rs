//! Compensation of single commands, without a data file.

use abbe::Manipulator;
use abbe_spec::diagnostic::Diagnostics;

use super::rows::Task;

/// Corrects commands of a machine.
pub struct CommandCorrector<'a>(Task<'a>);

/// A corrected command.
#[derive(Clone, Debug)]
pub struct CorrectedCommand {
    /// Joint variables, within their limits, in the length unit or rad.
    pub q: Vec<f64>,
    /// Remaining error ΔX: rows 1–3 in the length unit, rows 4–6 in rad.
    pub remaining: [f64; 6],
    /// Reason why the remaining error exceeds the tolerance; `None` if it does not.
    pub reason: Option<String>,
}

impl<'a> CommandCorrector<'a> {
    /// Creates a corrector for a machine. `tolerance` is the permitted error of the tool point in
    /// the length unit; for angles 1 rad counts as 1 m. `weight` is the length that weighs as much
    /// as 1 rad where both cannot be reached; `None` gives the position priority.
    pub fn new(
        manipulator: &'a dyn Manipulator,
        tolerance: f64,
        weight: Option<f64>,
    ) -> Result<Self, Diagnostics> {
        Task::new(manipulator, false, tolerance, weight).map(Self)
    }

    /// Returns the command that brings the real tool to the pose of the ideal tool at `q`, with the
    /// inputs `u`.
    ///
    /// # Errors
    ///
    /// Returns the reason if the command exceeds a joint limit or cannot be evaluated.
    pub fn correct(&self, q: &[f64], u: &[f64]) -> Result<CorrectedCommand, String> {
        self.0.correct(q, u).map(|(found, reason)| CorrectedCommand {
            q: found.q,
            remaining: found.after,
            reason,
        })
    }
}
