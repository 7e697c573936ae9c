//! Tests of the command that need tools or data that are not everywhere: each is ignored, with the reason, where they are
//! missing.

mod fmu;
mod full_disk;
mod measured_data;
mod reference;

use std::process::ExitCode;

use abbe_tests::needs::run;

fn main() -> ExitCode {
    run(&[
        ("fmu", fmu::TESTS),
        ("full_disk", full_disk::TESTS),
        ("measured_data", measured_data::TESTS),
        ("reference", reference::TESTS),
    ])
}
