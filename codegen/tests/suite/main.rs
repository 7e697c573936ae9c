//! Integration tests of the public interface.

mod any_input;
mod corrected_command;
mod graph_laws;
mod hostile_names;
mod readable_rust;
mod used_names;

#[path = "../../../tests/src/closed_machines.rs"]
mod closed_machines;
#[path = "../../../tests/src/hostile.rs"]
#[allow(unreachable_pub)]
mod hostile;
#[path = "../../../tests/src/structured_text/mod.rs"]
#[allow(dead_code, unreachable_pub, unused_imports)]
mod structured_text;
