//! Tests that require tools or data: each is ignored, with the reason, where they are missing.

mod c99;
mod kernels;
mod languages;
mod linuxcnc;
mod measured_data;
mod mutant_table;
mod random_loops;
mod ros;
mod rustfmt;
mod structured_text;

use std::process::ExitCode;

use abbe_tests::needs::run;

fn main() -> ExitCode {
    run(&[
        ("c99", c99::TESTS),
        ("kernels", kernels::TESTS),
        ("languages", languages::TESTS),
        ("linuxcnc", linuxcnc::TESTS),
        ("measured_data", measured_data::TESTS),
        ("mutant_table", mutant_table::TESTS),
        ("ros", ros::TESTS),
        ("rustfmt", rustfmt::TESTS),
        ("structured_text", structured_text::TESTS),
    ])
}
