//! Acceptance limits on the errors of test rows.

use abbe::LengthUnit;
use abbe_spec::expr::Dimension;
use abbe_spec::value::parse_value;
use abbe_spec::{Diagnostic, Document};
use serde::Serialize;

use crate::sizes::Sizes;
use abbe_study::{Result, number};

/// Names of the figures that can be limited.
pub(crate) const FIGURE_NAMES: [&str; 4] = ["mean", "rms", "p95", "max"];

/// Words that permit a fitted place on the tool.
pub(crate) const TARGET: &str = "target";
pub(crate) const FITTED: &str = "fitted";

/// Acceptance limits on position errors, in the length unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Acceptance {
    /// Name of each limited figure, with its limit.
    pub limits: Vec<(&'static str, f64)>,
    /// A place on the tool that is fitted to the judged rows is permitted.
    pub is_target_fitted: bool,
}

/// Subject of a verdict, whose errors its figures are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Judged {
    /// The machine as built: measured minus ideal.
    Machine,
    /// The machine whose commands were corrected: measured minus what they were corrected for.
    Corrected,
    /// The model of the machine: measured minus predicted.
    Model,
}

/// Outcome of a comparison with limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Decision {
    /// Beyond the limit by more than the uncertainty.
    Rejected,
    /// Nearer to the limit than the uncertainty.
    Undecided,
    /// Within the limit by at least the uncertainty.
    Accepted,
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
    /// Expanded uncertainty of the value, one-sided with 95 %, in the length unit; 0 where none is
    /// counted.
    pub uncertainty: f64,
    /// Outcome: a value is accepted if it conforms beyond its uncertainty.
    pub decision: Decision,
}

/// Acceptance verdict on rows that were not used for fitting.
#[derive(Clone, Debug, Serialize)]
pub struct AcceptanceVerdict {
    /// Subject.
    pub judged: Judged,
    /// Name of the rows, such as `the test rows`.
    pub rows: &'static str,
    /// Comparisons, one per limit.
    pub limits: Vec<LimitCheck>,
    /// The worst of their outcomes.
    pub decision: Decision,
}

/// Normal quantile `Φ⁻¹(0.95)`.
const ONE_SIDED_95: f64 = 1.644_853_626_951_473;

impl AcceptanceVerdict {
    /// Returns whether all limits are met beyond the uncertainty.
    pub fn is_met(&self) -> bool {
        self.decision == Decision::Accepted
    }
}

impl Acceptance {
    /// Parses `mean 0.15 mm, max 0.3 mm`, with `target fitted` among them or not. Mistakes are
    /// reported under the name `option`.
    pub fn read(option: &str, text: &str, length: LengthUnit) -> Result<Self> {
        let document = Document::new(option, text);
        let mut read = Self::default();
        let mut at = 0;
        for part in text.split(',') {
            let start = at + part.len() - part.trim_start().len();
            let end = at + part.trim_end().len();
            at += part.len() + 1;
            let mut words = text[start..end.max(start)].split_whitespace();
            if words.clone().eq([TARGET, FITTED]) {
                read.is_target_fitted = true;
                continue;
            }
            let name = words.next().unwrap_or_default();
            let Some(figure) = FIGURE_NAMES.into_iter().find(|figure| *figure == name) else {
                let message = format!("unknown figure `{}`", name.escape_debug());
                let help = format!(
                    "write a figure and its limit: `mean 0.15 mm, max 0.3 mm`; the figures are {}; `{TARGET} {FITTED}` \
                     permits a place on the tool that is fitted to the rows",
                    FIGURE_NAMES.join(", ")
                );
                document.mistake(Diagnostic::new(start..end.max(start), message).help(help));
                continue;
            };
            let value =
                parse_value(&document, start + name.len()..end, length, Dimension::LENGTH, "this limit");
            read.limits.extend(value.map(|value| (figure, value)));
        }
        if read.limits.is_empty() {
            let mistake = Diagnostic::new(0..text.len(), "there is no limit");
            document
                .mistake(mistake.help("write a figure and its limit beside it: `max 0.3 mm, target fitted`"));
        }
        document.finish(Some(read))
    }

    /// Returns the limit on the largest error; without one, the limit on the next figure in the
    /// order `p95`, `rms`, `mean`.
    pub fn largest_error(&self) -> Option<f64> {
        let limit = |figure: &str| self.limits.iter().find(|(name, _)| *name == figure);
        FIGURE_NAMES.iter().rev().find_map(|figure| limit(figure)).map(|(_, limit)| *limit)
    }

    /// Compares the figures with the limits; returns `None` without limits.
    ///
    /// `noise` is the standard uncertainty of a measured coordinate, and `configurations` their
    /// number; mean and root mean square are known `√configurations` times better than one error.
    /// ISO 14253-1:2017 and JCGM 106:2012, 8.3: the guard band is the uncertainty for a risk of 5
    /// %.
    pub(crate) fn verdict(
        &self,
        (judged, rows): (Judged, &'static str),
        sizes: &Sizes,
        (noise, configurations): (f64, usize),
    ) -> Option<AcceptanceVerdict> {
        let limit = |(figure, limit): &(&'static str, f64)| {
            let of_mean = noise / f64::sqrt(configurations.max(1) as f64);
            let (value, deviation) = match *figure {
                "mean" => (sizes.mean, of_mean),
                "rms" => (sizes.rms, of_mean),
                "p95" => (sizes.p95, noise),
                _ => (sizes.max, noise),
            };
            let uncertainty = ONE_SIDED_95 * deviation;
            let decision = match limit - value {
                room if room >= uncertainty => Decision::Accepted,
                room if room < -uncertainty => Decision::Rejected,
                _ => Decision::Undecided,
            };
            LimitCheck { figure, limit: *limit, value, uncertainty, decision }
        };
        let limits: Vec<LimitCheck> = self.limits.iter().map(limit).collect();
        let decision = limits.iter().map(|limit| limit.decision).min()?;
        Some(AcceptanceVerdict { judged, rows, limits, decision })
    }

    /// Formats the limits as [`read`](Self::read) parses them; empty without any.
    pub(crate) fn text(&self, length: LengthUnit) -> String {
        let limits =
            self.limits.iter().map(|(figure, limit)| format!("{figure} {}", number::length(*limit, length)));
        let fitted = self.is_target_fitted.then(|| format!("{TARGET} {FITTED}"));
        limits.chain(fitted).collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests;
