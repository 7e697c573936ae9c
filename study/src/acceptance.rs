//! Limits for rows that nothing was fitted to, and whether they are met.

use abbe::LengthUnit;
use abbe_spec::diagnostic::{Diagnostic, Diagnostics};
use abbe_spec::document::Document;
use abbe_spec::expr::Dimension;
use abbe_spec::value::parse_value;
use serde::Serialize;

use crate::number;
use crate::sizes::Sizes;

/// The figures that can be limited, by the names that limits call them.
pub(crate) const FIGURES: [&str; 4] = ["mean", "rms", "p95", "max"];

/// Limits of position errors, by the names of figures: `mean`, `rms`, `p95`, `max`. The length unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Acceptance {
    /// Each figure and what it may be at most.
    pub limits: Vec<(&'static str, f64)>,
}

/// A limit, and what was found.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Limit {
    /// `mean`, `rms`, `p95` or `max`.
    pub figure: &'static str,
    /// What it may be at most.
    pub limit: f64,
    /// What it is.
    pub value: f64,
    /// Whether that is no more.
    pub met: bool,
}

/// Whether unseen rows are within the limits that were declared.
#[derive(Clone, Debug, Serialize)]
pub struct Accepted {
    /// Which rows: `the test rows`.
    pub rows: &'static str,
    /// Limit by limit.
    pub limits: Vec<Limit>,
    /// Whether all are met.
    pub met: bool,
}

impl Acceptance {
    /// Reads `mean 0.15 mm, max 0.3 mm`; `option` is where mistakes are shown.
    pub fn read(option: &str, text: &str, length: LengthUnit) -> Result<Self, Diagnostics> {
        let mut document = Document::new(option, text);
        let mut limits = Vec::new();
        let mut at = 0;
        for part in text.split(',') {
            let start = at + part.len() - part.trim_start().len();
            let end = at + part.trim_end().len();
            at += part.len() + 1;
            let name = text[start..end.max(start)].split_whitespace().next().unwrap_or_default();
            let Some(figure) = FIGURES.into_iter().find(|figure| *figure == name) else {
                let message = format!("there is no figure `{}`", name.escape_debug());
                let help = format!(
                    "write a figure and its limit: `mean 0.15 mm, max 0.3 mm`; there are {}",
                    FIGURES.join(", ")
                );
                document.mistake(Diagnostic::new(start..end.max(start), message).help(help));
                continue;
            };
            let value =
                parse_value(&mut document, start + name.len()..end, length, Dimension::LENGTH, "this limit");
            limits.extend(value.map(|value| (figure, value)));
        }
        document.finish(Some(Self { limits }))
    }

    /// The limit of the largest error, or without that of the figure that is nearest to it.
    pub fn largest(&self) -> Option<f64> {
        let limit = |figure: &str| self.limits.iter().find(|(name, _)| *name == figure);
        FIGURES.iter().rev().find_map(|figure| limit(figure)).map(|(_, limit)| *limit)
    }

    /// The verdict; none without limits.
    pub fn judge(&self, rows: &'static str, sizes: &Sizes) -> Option<Accepted> {
        let limit = |(figure, limit): &(&'static str, f64)| {
            let value = match *figure {
                "mean" => sizes.mean,
                "rms" => sizes.rms,
                "p95" => sizes.p95,
                _ => sizes.max,
            };
            Limit { figure, limit: *limit, value, met: value <= *limit }
        };
        let limits: Vec<Limit> = self.limits.iter().map(limit).collect();
        let met = limits.iter().all(|limit| limit.met);
        (!limits.is_empty()).then_some(Accepted { rows, limits, met })
    }
}

impl Accepted {
    /// `Accepted: mean 0.12 mm of at most 0.15 mm … on the test rows.`
    pub fn sentence(&self, length: LengthUnit) -> String {
        let limit = |limit: &Limit| {
            let [value, most] = [limit.value, limit.limit].map(|value| number::length(value, length));
            let more = if limit.met { "" } else { ", which is too much" };
            format!("{} {value} of at most {most}{more}", limit.figure)
        };
        let limits: Vec<String> = self.limits.iter().map(limit).collect();
        let verdict = if self.met { "Accepted" } else { "Not accepted" };
        format!("{verdict} on {}: {}.", self.rows, limits.join("; "))
    }
}

#[cfg(test)]
mod tests {
    use abbe::LengthUnit;

    use super::Acceptance;
    use crate::sizes::Sizes;

    #[test]
    fn limits_are_read_and_judged() {
        let limits =
            Acceptance::read("--accept", "mean 0.15 mm, max 300 um", LengthUnit::Millimetre).unwrap();
        assert_eq!(limits.limits, [("mean", 0.15), ("max", 0.3)]);
        let sizes = Sizes { mean: 0.1, standard_error: None, rms: 0.2, max: 0.31, p95: 0.2 };
        let verdict = limits.judge("the test rows", &sizes).unwrap();
        assert!(!verdict.met && verdict.limits[0].met);
        assert_eq!(
            verdict.sentence(LengthUnit::Millimetre),
            "Not accepted on the test rows: mean 0.1 mm of at most 0.15 mm; max 0.31 mm of at most 0.3 mm, which is too much."
        );
        assert!(Acceptance::default().judge("the test rows", &sizes).is_none());
        for wrong in ["median 1 mm", "mean", "mean 1 deg", ""] {
            assert!(Acceptance::read("--accept", wrong, LengthUnit::Millimetre).is_err(), "{wrong}");
        }
    }
}
