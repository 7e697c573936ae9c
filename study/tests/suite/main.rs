//! The jobs, as whoever calls them without the command.

mod doubt;
mod extrapolated;
mod inputs_from_rows;
mod instruments;
mod jobs;
mod measurements;
mod monitor;
mod parts;
mod readings;
mod round_trips;
mod verdict;

#[path = "../../../tests/src/thorough.rs"]
mod thorough;
