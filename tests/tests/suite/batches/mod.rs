//! Functions in batches, of three robots: a machine tool, the paper's positioner with Euler rows,
//! and an arm.

mod laws;

use abbe::lanes::Batches;
use abbe_manipulators::{machine3, pps, puma560};

/// Robots with all functions compiled for lanes. `tests/kernels.rs` has all robots.
const COMPILED: [&dyn Batches; 3] = [&machine3::Machine3, &pps::Pps, &puma560::Puma560];
