//! Tests of `corrected_spec.rs`.

use super::*;

#[test]
fn factors_are_inverted() {
    let inverse = |product| {
        factors(product).map(|all| {
            let turned: Vec<String> =
                all.iter().rev().map(|(name, amount)| format!("{name}({})", negative(amount))).collect();
            turned.join(" ")
        })
    };
    assert_eq!(
        inverse("Tx(-30) Rz(2*(q1 + 1))  Ty( a )").as_deref(),
        Some("Ty(-(a)) Rz(-(2*(q1 + 1))) Tx(30)")
    );
    assert_eq!(inverse("Tx(30"), None);
}

#[test]
fn names_are_whole_words() {
    let substitutions = [("q3", "(q3 + q2)".to_owned())];
    assert_eq!(
        replace_names("\"q3 - q31*q2 + 2*q3\"", &substitutions),
        "\"(q3 + q2) - q31*q2 + 2*(q3 + q2)\""
    );
}
