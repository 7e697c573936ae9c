//! Tests of the binary as users run it: its output and its exit status.

mod abuse;
mod allocate;
mod analyses;
mod analyze;
mod answers;
mod bad_input;
mod bound;
mod check;
mod compensate;
mod documents;
mod explore;
mod export;
mod gallery;
mod generate;
mod help;
mod identify;
mod import;
mod inputs;
mod interrupts;
mod jacobian;
mod kills;
#[cfg(unix)]
mod laws;
mod live_panels;
mod measure;
mod memory;
mod merge;
mod monitor;
mod new;
mod outputs;
mod pages;
mod paths;
mod positioning;
#[cfg(unix)]
mod programs;
#[cfg(unix)]
mod progress;
mod readme;
mod report;
mod running;
mod shown_text;
mod study;
mod ways_out;
mod workshop;

#[path = "../../../tests/src/erroneous.rs"]
mod erroneous;
