//! What every refusal has: a message, a place, a way out.

use abbe_spec::diagnostic::Diagnostics;

/// Fails unless every mistake has all three.
pub fn told(refused: &Diagnostics) {
    assert!(!refused.list.is_empty());
    for mistake in &refused.list {
        assert!(mistake.span.is_some() || !refused.path.is_empty(), "{refused}");
        assert!(!mistake.message.is_empty() && mistake.help.is_some(), "{refused}");
    }
    assert!(refused.to_string().starts_with("error"));
}
