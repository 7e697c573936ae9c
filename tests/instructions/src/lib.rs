//! Instruction counts; see `benches/instructions.rs`.
