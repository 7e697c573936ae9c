//! Requirements of every diagnostic: a message, a location, and a help.

use abbe_spec::diagnostic::Diagnostics;

/// Panics unless every diagnostic has all three.
pub fn told(refused: &Diagnostics) {
    assert!(!refused.list.is_empty());
    for mistake in &refused.list {
        assert!(mistake.span.is_some() || !refused.path.is_empty(), "{refused}");
        assert!(!mistake.message.is_empty() && mistake.help.is_some(), "{refused}");
    }
    assert!(refused.to_string().starts_with("error"));
}
