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
                    format!(
                        "the closest leaves {left} {unit}{turns}, and the limit is {within} \
                        {unit}"
                    )
                }
            };
            format!(
                "No interpretation fits: {nearest}. Check that these are data of this \
                machine, and which columns are the joints."
            )
        }
        [only] => {
            format!(
                "One interpretation fits, with an error of {} {unit}: {}.",
                digits(only.residual, 3),
                only.words
            )
        }
        [first, rest @ ..] => format!(
            "{} interpretations fit these rows equally well; the simplest has an error of {} \
             {unit}: {}.",
            rest.len() + 1,
            digits(first.residual, 3),
            first.words
        ),
    }
}
