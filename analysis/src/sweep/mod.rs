//! Sweeps: evaluate a workspace block by block, in parallel, and visit every configuration in
//! order; nothing is stored.

mod block;
mod in_order;
mod row;
mod unreachable_summary;

pub use block::{BLOCK, sweep};
pub(super) use block::{Block, ready};
pub use in_order::{in_order, in_order_until};
pub use row::{Row, Unevaluated};
pub use unreachable_summary::UnreachableSummary;
