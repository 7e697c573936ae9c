//! Acceptance limits on the errors of test rows.

use abbe::LengthUnit;
use abbe_spec::diagnostic::{Diagnostic, Diagnostics};
use abbe_spec::document::Document;
use abbe_spec::expr::Dimension;
use abbe_spec::value::parse_value;
use serde::Serialize;

use crate::sizes::Sizes;
use abbe_study::number;

/// Names of the figures that can be limited.
pub(crate) const FIGURE_NAMES: [&str; 4] = ["mean", "rms", "p95", "max"];

/// Acceptance limits on position errors, in the length unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Acceptance {
    /// Name of each limited figure, with its limit.
    pub limits: Vec<(&'static str, f64)>,
}

/// A limit compared with its figure.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct LimitCheck {
    /// Name of the figure: `mean`, `rms`, `p95` or `max`.
    pub figure: &'static str,
    /// Largest permitted value, in the length unit.
    pub limit: f64,
    /// Actual value, in the length unit.
    pub value: f64,
    /// Indicates that the value does not exceed the limit.
    pub met: bool,
}

/// Acceptance verdict on rows that were not used for fitting.
#[derive(Clone, Debug, Serialize)]
pub struct AcceptanceVerdict {
    /// Name of the rows, such as `the test rows`.
    pub rows: &'static str,
    /// Comparisons, one per limit.
    pub limits: Vec<LimitCheck>,
    /// Indicates that all limits are met.
    pub met: bool,
}

impl Acceptance {
    /// Parses `mean 0.15 mm, max 0.3 mm`. Mistakes are reported under the name `option`.
    pub fn read(option: &str, text: &str, length: LengthUnit) -> Result<Self, Diagnostics> {
        let document = Document::new(option, text);
        let mut limits = Vec::new();
        let mut at = 0;
        for part in text.split(',') {
            let start = at + part.len() - part.trim_start().len();
            let end = at + part.trim_end().len();
            at += part.len() + 1;
            let name = text[start..end.max(start)].split_whitespace().next().unwrap_or_default();
            let Some(figure) = FIGURE_NAMES.into_iter().find(|figure| *figure == name) else {
                let message = format!("unknown figure `{}`", name.escape_debug());
                let help = format!(
                    "write a figure and its limit: `mean 0.15 mm, max 0.3 mm`; the figures are {}",
                    FIGURE_NAMES.join(", ")
                );
                document.mistake(Diagnostic::new(start..end.max(start), message).help(help));
                continue;
            };
            let value =
                parse_value(&document, start + name.len()..end, length, Dimension::LENGTH, "this limit");
            limits.extend(value.map(|value| (figure, value)));
        }
        document.finish(Some(Self { limits }))
    }

    /// Returns the limit on the largest error; without one, the limit on the next figure in the
    /// order `p95`, `rms`, `mean`.
    pub fn largest_error(&self) -> Option<f64> {
        let limit = |figure: &str| self.limits.iter().find(|(name, _)| *name == figure);
        FIGURE_NAMES.iter().rev().find_map(|figure| limit(figure)).map(|(_, limit)| *limit)
    }

    /// Compares the figures with the limits; returns `None` without limits.
    pub fn verdict(&self, rows: &'static str, sizes: &Sizes) -> Option<AcceptanceVerdict> {
        let limit = |(figure, limit): &(&'static str, f64)| {
            let value = match *figure {
                "mean" => sizes.mean,
                "rms" => sizes.rms,
                "p95" => sizes.p95,
                _ => sizes.max,
            };
            LimitCheck { figure, limit: *limit, value, met: value <= *limit }
        };
        let limits: Vec<LimitCheck> = self.limits.iter().map(limit).collect();
        let met = limits.iter().all(|limit| limit.met);
        (!limits.is_empty()).then_some(AcceptanceVerdict { rows, limits, met })
    }

    /// Formats the limits as [`read`](Self::read) parses them; empty without any.
    pub(crate) fn text(&self, length: LengthUnit) -> String {
        let limits =
            self.limits.iter().map(|(figure, limit)| format!("{figure} {}", number::length(*limit, length)));
        limits.collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests;
