//! Agreement with a published figure, in words.

use abbe_study::analyze::{Agreement, Report};
use abbe_study::number;

/// Returns `met`, or `misses by 4 %`.
pub(super) fn agreement_text(agreement: Agreement, report: &Report) -> String {
    match agreement {
        Agreement::Met => "met".to_owned(),
        Agreement::Missed { share: Some(share), .. } => {
            let percent = 100.0 * share.abs();
            format!("misses by {percent:.*} %", usize::from(percent < 1.0))
        }
        Agreement::Missed { difference, .. } => {
            format!("misses by {}", number::length(difference.abs(), report.spec.length))
        }
    }
}
