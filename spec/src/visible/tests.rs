//! Tests of `visible.rs`.

use super::*;

/// Every character that is replaced has four hexadecimal digits, and a placeholder of the same
/// length; none is left.
#[test]
fn nothing_that_alters_text_is_left() {
    let all = (0..=u32::from(char::MAX)).filter_map(char::from_u32).filter(|c| alters_text(*c));
    for c in all {
        assert!(u32::from(c) <= 0xffff, "{c:?}");
        let text = format!("a{c}b");
        let shown = visible(&text);
        assert!(matches!(c, '\n' | '\t') || !shown.contains(alters_text), "{c:?}: {shown:?}");
        let placed = with_placeholders(&text);
        assert_eq!(placed.len(), text.len(), "{c:?}");
        assert!(c.is_ascii() || !placed.contains(alters_text), "{c:?}");
    }
}

/// Letters, accents, joiners and emoji of any language are shown as they are.
#[test]
fn text_of_any_language_is_kept() {
    for text in
        ["Drehachse größer", "می\u{200c}خواهم", "轴 3", "soft\u{ad}hyphen", "👩\u{200d}🔬", "e\u{301}"]
    {
        assert!(matches!(visible(text), Cow::Borrowed(_)), "{text}");
    }
}
