//! Tests of the command that need tools or data that not every computer has. Where they are
//! missing, the test is ignored with the reason.

mod accessibility;
mod browser;
mod controller;
mod fmu;
mod full_disk;
mod live_page;
mod live_page_figures;
mod measured_data;
mod printing;
mod reference;

use std::process::ExitCode;

use abbe_tests::needs::run;

fn main() -> ExitCode {
    run(&[
        ("accessibility", accessibility::TESTS),
        ("controller", controller::TESTS),
        ("fmu", fmu::TESTS),
        ("full_disk", full_disk::TESTS),
        ("live_page", live_page::TESTS),
        ("live_page_figures", live_page_figures::TESTS),
        ("measured_data", measured_data::TESTS),
        ("printing", printing::TESTS),
        ("reference", reference::TESTS),
    ])
}
