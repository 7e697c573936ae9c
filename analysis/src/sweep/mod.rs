//! Evaluates a workspace block by block, in parallel, and shows every configuration in order; nothing is stored.

mod block;
mod in_order;
mod rows;

pub(super) use block::Block;
pub use in_order::{in_order, in_order_until};
pub(super) use rows::ready;
pub use rows::{BLOCK, Row, Unevaluated, sweep};
