//! Learning from measurements: identification of generalized errors, and control charts for a
//! machine that is checked repeatedly.
//!
//! | module | contents |
//! |---|---|
//! | [`identify`] | observations of instruments, the model of their unknowns, residuals and derivatives, fits, selection of terms, design of experiments |
//! | [`control`] | self-starting control charts, and the estimated time of a change |

pub mod control;
pub mod identify;

#[cfg(test)]
#[path = "../../runtime/core/src/laws/tests/by_hand/mod.rs"]
mod by_hand;
