//! Tests of the jobs on measurements as library calls.

mod camera;
mod clinic;
mod extrapolation;
mod hexapod;
mod inputs_from_rows;
mod instruments;
mod interpretations;
mod measurements;
mod monitor;
mod parts_of_turns;
mod placements;
mod plausibility;
mod profiles;
mod round_trips;
mod rows;
mod selection;
mod simulated_ur5;
mod unknown_uncertainty;

#[path = "../../../tests/src/thorough.rs"]
mod thorough;

#[path = "../../../tests/src/erroneous.rs"]
mod erroneous;

#[path = "../../../tests/src/closed_machines.rs"]
mod closed_machines;
