//! Tests of `node.rs`.

use super::*;

#[test]
fn an_operation_is_small() {
    assert_eq!(size_of::<Op>(), 16);
}
