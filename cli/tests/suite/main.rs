//! The command as its users run it: the binary itself, its output, its exit status.

mod abuse;
mod analyze;
mod bad_input;
mod bound;
mod check;
mod compensate;
mod documents;
mod export;
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
mod measure;
mod memory;
mod merge;
mod monitor;
mod outputs;
mod pages;
mod paths;
#[cfg(unix)]
mod progress;
mod readme;
mod report;
mod running;
mod study;
mod ways_out;
mod workshop;
