//! The UR5 with known errors that several modules measure in simulation.

use abbe_spec::Spec;
use abbe_study::Machine;

pub(crate) use super::erroneous::ERRORS;

/// Returns the nominal machine.
pub(crate) fn ur5() -> Machine {
    Machine::find("ur5").unwrap()
}

/// Returns the machine of a spec.
pub(crate) fn machine(name: &str, text: &str) -> Machine {
    Machine::of_spec(Spec::parse(name, text).unwrap(), name)
}

/// Returns the UR5 with further tables of a spec.
pub(crate) fn ur5_with(sources: &str) -> Machine {
    machine("real.toml", &format!("{}{sources}", ur5().text().unwrap()))
}

/// Returns the lines of `[joints]` for columns j1 … j6 in degrees.
pub(crate) fn joints() -> String {
    (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect()
}
