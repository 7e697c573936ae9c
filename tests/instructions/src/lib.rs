//! Instruction counts: `benches/instructions.rs`.
