//! The `abbe` command.
fn main() {}
