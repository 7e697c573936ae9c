//! Tests of `signs.rs`.

use super::is_utf8;

#[test]
fn the_first_locale_that_is_set_counts() {
    let of = |set: &[(&str, &str)]| {
        is_utf8(|name| set.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned()))
    };
    assert!(of(&[]) && of(&[("LANG", "en_US.UTF-8")]) && of(&[("LC_ALL", "C.utf8"), ("LANG", "C")]));
    assert!(!of(&[("LANG", "C")]) && !of(&[("LANG", "en_US.UTF-8"), ("LC_CTYPE", "POSIX")]));
    assert!(of(&[("LC_ALL", ""), ("LANG", "de_DE.UTF-8")]) && !of(&[("LANG", "de_DE.ISO-8859-1")]));
}
