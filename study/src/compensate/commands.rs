//! Corrected commands one by one, for whoever has no file of them.

use abbe::Manipulator;
use abbe_spec::diagnostic::Diagnostics;

use super::rows::Task;

/// Corrects commands of a machine.
pub struct Commands<'a>(Task<'a>);

/// A corrected command.
#[derive(Clone, Debug)]
pub struct Command {
    /// The joint variables, within their limits.
    pub q: Vec<f64>,
    /// ΔX that is left: rows 1–3 in the length unit, 4–6 in rad.
    pub left: [f64; 6],
    /// Why not all is compensated to the tolerance, if so.
    pub reason: Option<String>,
}

impl<'a> Commands<'a> {
    /// Those of this machine; `tolerance` is what may be left, in the length unit, 1 rad counted as 1 m.
    pub fn new(manipulator: &'a dyn Manipulator, tolerance: f64) -> Result<Self, Diagnostics> {
        Task::new(manipulator, false, tolerance).map(Self)
    }

    /// The command that brings the real tool to where the ideal one is at `q`, with the inputs `u`.
    ///
    /// # Errors
    ///
    /// Why this command cannot be corrected: it is beyond a limit, or cannot be evaluated.
    pub fn correct(&self, q: &[f64], u: &[f64]) -> Result<Command, String> {
        self.0.correct(q, u).map(|(found, reason)| Command { q: found.q, left: found.after, reason })
    }
}
