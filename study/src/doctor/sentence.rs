//! Conclusion in one sentence.

use abbe_spec::Spec;

use super::report::Finding;
use crate::number::digits;

/// Returns the conclusion in one sentence.
pub(super) fn sentence(found: &[Finding], others: &[Finding], spec: &Spec, within: f64) -> String {
    let unit = spec.length.symbol();
    match found {
        [] => {
            let nearest = match others.first() {
                None => "no interpretation of these columns fits".to_owned(),
                Some(one) => {
                    let turns = one.angle.map_or(String::new(), |angle| {
                        format!(
                            " of the positions and {}° of the orientations",
                            digits(angle.to_degrees(), 3)
                        )
                    });
                    let (within, left) = (digits(within, 3), digits(one.residual, 3));
                    format!("{within} {unit} may be left, the nearest leaves {left} {unit}{turns}")
                }
            };
            format!("None fits: {nearest}. Is it another machine, or are other columns the joints?")
        }
        [only] => {
            format!("One reading fits, and leaves {} {unit}: {}.", digits(only.residual, 3), only.words)
        }
        [first, rest @ ..] => format!(
            "These rows fit {} readings that they cannot tell apart; the simplest leaves {} {unit}: {}.",
            rest.len() + 1,
            digits(first.residual, 3),
            first.words
        ),
    }
}
