//! Correction of repeatable errors and tolerances by compensation.

/// Error that remains of a repeatable source or a tolerance after compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Residual {
    /// Share of its error: `f ‖r_k(q)‖` with unknown sign, or `f` times the value of a tolerance.
    Share(f64),
    /// Error of at most this norm, in the length unit, wherever the source has an error.
    Bound(f64),
}

/// Correction of the repeatable errors and tolerances by compensation.
#[derive(Clone, Copy, Debug)]
pub struct Correction<'a> {
    /// Residual of each source; those of random ones mean nothing. A share of 1 is not compensated:
    /// the error keeps its value and sign.
    pub residuals: &'a [Option<Residual>],
    /// Norm of the position error that remains of all repeatable sources and tolerances together,
    /// in the length unit, in place of their residuals.
    pub together: Option<f64>,
}
