//! Deterministic sample points and random errors: the same on every run and every machine.

mod draw;
mod streams;

pub use abbe_core::sampling::*;
pub use draw::{draw, draw_parts};
pub use streams::stream;
