//! The command as its users run it: the binary itself, its output, its exit status.

mod abuse;
mod analyze;
mod bad_input;
mod check;
mod compensate;
mod documents;
mod generate;
mod help;
mod identify;
mod import;
mod inputs;
mod interrupts;
mod jacobian;
mod kills;
mod measure;
mod memory;
mod merge;
mod monitor;
mod outputs;
mod pages;
mod paths;
mod readme;
mod report;
mod running;
mod study;
mod workshop;
