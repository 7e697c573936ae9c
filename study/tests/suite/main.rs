//! Tests of the jobs as library calls.

mod camera;
mod checked_loops;
mod clinic;
mod closed_loops;
mod compensated;
mod extrapolation;
mod hexapod;
mod inputs_from_rows;
mod instruments;
mod interpretations;
mod jobs;
mod measurements;
mod monitor;
mod parts;
mod placements;
mod plausibility;
mod profiles;
mod round_trips;
mod selection;
mod simulated_ur5;
mod unknown_uncertainty;
mod verdict;

#[path = "../../../tests/src/thorough.rs"]
mod thorough;

#[path = "../../../tests/src/erroneous.rs"]
mod erroneous;

#[path = "../../../tests/src/closed_machines.rs"]
mod closed_machines;
