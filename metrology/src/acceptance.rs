//! Acceptance limits on the errors of test rows.

use abbe::LengthUnit;
use abbe_spec::{Diagnostic, Document, expr::Dimension, value::parse_value};
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
pub(crate) const ONE_SIDED_95: f64 = 1.644_853_626_951_473;

impl LimitCheck {
    /// Compares a value with its limit beyond its uncertainty.
    pub(crate) fn new(figure: &'static str, limit: f64, value: f64, uncertainty: f64) -> Self {
        let decision = match limit - value {
            room if room >= uncertainty => Decision::Accepted,
            room if room < -uncertainty => Decision::Rejected,
            _ => Decision::Undecided,
        };
        Self { figure, limit, value, uncertainty, decision }
    }
}

impl AcceptanceVerdict {
    /// Judges by comparisons; `None` without any.
    pub(crate) fn new((judged, rows): (Judged, &'static str), limits: Vec<LimitCheck>) -> Option<Self> {
        let decision = limits.iter().map(|limit| limit.decision).min()?;
        Some(Self { judged, rows, limits, decision })
    }

    /// Returns whether all limits are met beyond the uncertainty.
    pub fn is_met(&self) -> bool {
        self.decision == Decision::Accepted
    }
}

/// Parses figures and their limits, the parts of `text` that are not something else; the last pair
/// is an example, and what else may be among them.
pub(crate) fn read_limits(
    option: &str,
    text: &str,
    is_else: impl Fn(&str) -> bool,
    names: &[&'static str],
    (length, dimension): (LengthUnit, Dimension),
    (example, more): (&str, &str),
) -> Result<Vec<(&'static str, f64)>> {
    let document = Document::new(option, text);
    let (mut limits, mut at) = (Vec::new(), 0);
    for part in text.split(',') {
        let start = at + part.len() - part.trim_start().len();
        let end = (at + part.trim_end().len()).max(start);
        at += part.len() + 1;
        if is_else(part) {
            continue;
        }
        let name = text[start..end].split_whitespace().next().unwrap_or_default();
        let Some(figure) = names.iter().find(|figure| **figure == name) else {
            let message = format!("unknown figure `{}`", name.escape_debug());
            let names = names.join(", ");
            let help = format!("write a figure and its limit: `{example}`; the figures are {names}{more}");
            document.mistake(Diagnostic::new(start..end, message).help(help));
            continue;
        };
        let value = parse_value(&document, start + name.len()..end, length, dimension, "this limit");
        limits.extend(value.map(|value| (*figure, value)));
    }
    if limits.is_empty() {
        let mistake = Diagnostic::new(0..text.len(), "there is no limit");
        document.mistake(mistake.help(format!("write a figure and its limit beside it: `{example}`")));
    }
    document.finish(Some(limits))
}

impl Acceptance {
    /// Parses `mean 0.15 mm, max 0.3 mm`, with `target fitted` among them or not. Mistakes are
    /// reported under the name `option`.
    pub fn read(option: &str, text: &str, length: LengthUnit) -> Result<Self> {
        let permitted =
            format!("; `{TARGET} {FITTED}` permits a place on the tool that is fitted to the rows");
        let form = ("mean 0.15 mm, max 0.3 mm", &*permitted);
        let is_permission = |part: &str| part.split_whitespace().eq([TARGET, FITTED]);
        let unit = (length, Dimension::LENGTH);
        let limits = read_limits(option, text, is_permission, &FIGURE_NAMES, unit, form)?;
        Ok(Self { limits, is_target_fitted: text.split(',').any(is_permission) })
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
            LimitCheck::new(figure, *limit, value, ONE_SIDED_95 * deviation)
        };
        AcceptanceVerdict::new((judged, rows), self.limits.iter().map(limit).collect())
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
