//! The certified upper bound of the worst case.

use abbe_study::analyze::{NOT_CERTIFIED, Report};
use abbe_study::number;

use crate::unit::decimals;

/// Returns a sentence with the certified bound; `None` if nothing is certified of a chain.
pub(super) fn certified_norms(report: &Report) -> Option<String> {
    if !report.spec.is_serial() {
        return Some(format!("Certified: nothing; {NOT_CERTIFIED}."));
    }
    let norms = report.certified.as_ref()?;
    let most = number::rounded_up(norms.all_sources()?.certified?, decimals(report));
    let domain = match norms.contains_more {
        true => "the enclosing joint box, which is larger than the workspace,",
        false => "the whole box of the workspace",
    };
    let unit = report.spec.length.symbol();
    Some(format!(
        "Certified, to first order: over {domain} the worst case over all signs is at most {most} {unit}."
    ))
}
