//! Every function of every shipped manipulator in batches: 450 kernels, whose compilation takes
//! longer than that of all other tests.
//!
//! `cargo test --workspace --test kernels`, which the tests of `needs` execute in a thorough run.

#[path = "suite/batches/laws.rs"]
mod laws;

use abbe::lanes::Batches;
use abbe_manipulators::{SHIPPED, general6r, iiwa, machine3, panda, pps, puma560, scara, stanford, ur5, wam};

/// Shipped manipulators, with all their functions compiled for lanes.
const COMPILED: [&dyn Batches; SHIPPED.len()] = [
    &general6r::General6r,
    &iiwa::Iiwa,
    &machine3::Machine3,
    &panda::Panda,
    &pps::Pps,
    &puma560::Puma560,
    &scara::Scara,
    &stanford::Stanford,
    &ur5::Ur5,
    &wam::Wam,
];
