//! What the figures show, gathered while the sweep goes on: bounded memory, however many configurations.
//!
//! `bins` sorts without knowing the range; `extremes` is what happens within a bin; `points` keeps a part of
//! the configurations; `gather` does it for one figure.

pub(super) mod bins;
pub(super) mod extremes;
pub(super) mod gather;
pub(super) mod points;
