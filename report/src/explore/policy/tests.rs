//! Tests of `policy.rs`.

use super::{base64, source};

/// Test vectors of RFC 4648, section 10.
#[test]
fn base64_is_that_of_the_rfc() {
    let vectors = [
        ("", ""),
        ("f", "Zg=="),
        ("fo", "Zm8="),
        ("foo", "Zm9v"),
        ("foob", "Zm9vYg=="),
        ("fooba", "Zm9vYmE="),
        ("foobar", "Zm9vYmFy"),
    ];
    for (text, encoded) in vectors {
        assert_eq!(base64(text.as_bytes()), encoded);
    }
}

/// Example of the W3C Recommendation "Content Security Policy Level 2", section 4.2.3.
#[test]
fn hash_of_a_script_is_that_of_the_recommendation() {
    let hash = "'sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng='";
    assert_eq!(source("alert('Hello, world.');"), hash);
}
