//! Tests of the jobs as library calls.

mod allocate;
mod balls;
mod boxes;
mod checked_loops;
mod closed_loops;
mod compensated;
mod jobs;
mod parts;

#[path = "../../../tests/src/thorough.rs"]
mod thorough;

#[path = "../../../tests/src/closed_machines.rs"]
mod closed_machines;
