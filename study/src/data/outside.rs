//! Rows where the errors of an identified machine are extrapolated.

use abbe_codegen::spec::Spec;

use crate::Notes;
use crate::number;

/// Warns of configurations outside the ranges that the errors of a spec were fitted on, with their number. `what` they are,
/// in the plural: `rows`.
pub(crate) fn warn_of_extrapolation<'r>(
    spec: &Spec,
    what: &str,
    configurations: impl Iterator<Item = (&'r [f64], &'r [f64])>,
    notes: &mut dyn Notes,
) {
    if spec.fitted.is_empty() {
        return;
    }
    let (mut all, mut outside, mut of_each) = (0, 0, vec![0; spec.fitted.len()]);
    for (q, u) in configurations {
        let mut any = false;
        for (fitted, count) in spec.fitted.iter().zip(&mut of_each) {
            let here = fitted.is_outside(q, u);
            *count += usize::from(here);
            any |= here;
        }
        all += 1;
        outside += usize::from(any);
    }
    if outside == 0 {
        return;
    }
    let named = spec.fitted.iter().zip(&of_each).filter(|(_, count)| **count > 0);
    let named = named.map(|(fitted, count)| {
        let [lower, upper] = fitted.range.map(|end| number::of_symbol(end, fitted.symbol, spec));
        format!("{} beyond {lower} … {upper} in {count}", fitted.name(spec))
    });
    notes.warn(&format!(
        "{outside} of {all} {what} are outside the ranges on which the errors of this spec were fitted ({}): what is \
         said of them is extrapolated",
        named.collect::<Vec<_>>().join(", ")
    ));
}
