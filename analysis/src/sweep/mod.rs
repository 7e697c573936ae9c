//! Sweeps: evaluate a workspace block by block, in parallel, and visit every configuration in
//! order; nothing is stored.

mod block;
mod in_order;
mod row;
mod rows;
mod unreachable_summary;

pub(super) use block::Block;
pub use in_order::{in_order, in_order_until};
pub use row::{Row, Unevaluated};
pub(super) use rows::ready;
pub use rows::{BLOCK, sweep};
pub use unreachable_summary::UnreachableSummary;
