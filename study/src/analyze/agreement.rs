//! Agreement with a published figure, in words.

use super::report::{Agreement, Report};
use crate::number;

impl Agreement {
    /// Returns `met`, or `misses by 4 %`.
    pub fn text(self, report: &Report) -> String {
        match self {
            Self::Met => "met".to_owned(),
            Self::Missed { share: Some(share), .. } => {
                let percent = 100.0 * share.abs();
                format!("misses by {percent:.*} %", usize::from(percent < 1.0))
            }
            Self::Missed { difference, .. } => {
                format!("misses by {}", number::length(difference.abs(), report.spec.length))
            }
        }
    }
}
