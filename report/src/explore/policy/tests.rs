//! Tests of `policy.rs`.

use super::source;

/// Example of the W3C Recommendation "Content Security Policy Level 2", section 4.2.3.
#[test]
fn hash_of_a_script_is_that_of_the_recommendation() {
    let hash = "'sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng='";
    assert_eq!(source("alert('Hello, world.');"), hash);
}
