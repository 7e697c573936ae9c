//! Integration tests of the public interface.

mod any_input;
mod corrected_command;
mod graph_laws;
mod readable_rust;
mod used_names;

#[path = "../../../tests/src/closed_machines.rs"]
mod closed_machines;
