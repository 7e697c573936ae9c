//! Published figures for comparison with the computed ones.

use abbe_spec::document::{Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::value::find_name;
use abbe_spec::{Diagnostic, Spec};
use serde::Serialize;

use super::choices::{CombinedFigure, Metric};
use super::keys;
use crate::workspace::{constant, positive_length};

/// Quantity that a published figure states.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// One source in one metric.
    Source(String, Metric),
    /// Combination of all sources.
    Combined(CombinedFigure),
}

/// Published figures of one quantity.
#[derive(Clone, Debug)]
pub struct Published {
    /// Quantity of the figures.
    pub subject: Subject,
    /// Values along x, y, z and of the norm, in the length unit; none if not published.
    pub figures: [Option<f64>; 4],
    /// Largest difference that counts as agreement: half a unit of the last published digit, in the
    /// length unit.
    pub within: f64,
    /// Place in the publication.
    pub reference: String,
}

/// Published errors after compensation, in the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct PublishedResidual {
    /// Repeatable residual after compensation.
    pub residual: f64,
    /// Random errors.
    pub random: f64,
    /// Sum of both.
    pub total: f64,
    /// Place in the publication.
    #[serde(skip)]
    pub reference: String,
}

/// Reads every `[[published]]`.
pub(super) fn read_published(root: &Section<'_>, spec: &Spec) -> Vec<Published> {
    let items = root.get("published").and_then(|item| item.array("an array of tables [[published]]"));
    let mut read: Vec<Published> = Vec::new();
    for item in items.into_iter().flatten() {
        let Some(section) = item.named("a [[published]]") else { continue };
        let Some(published) = read_one(&section, spec) else { continue };
        if read.iter().any(|other| other.subject == published.subject) {
            let message = "duplicate published figure";
            root.document.mistake(Diagnostic::new(item.span(), message).help("remove one of them"));
        }
        read.push(published);
    }
    read
}

fn read_one(section: &Section<'_>, spec: &Spec) -> Option<Published> {
    let subject = match (section.get("source"), section.get("combined")) {
        (Some(source), None) => {
            section.check_keys(&[&keys::OF_A_SOURCE, &keys::PUBLISHED]);
            let names = spec.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>();
            let name = source.string();
            let known = name
                .filter(|name| find_name(section.document, source.span(), name, &names, "source").is_some());
            let metric = section.required("metric");
            let metric = metric.and_then(|item| item.choice(&Metric::ALL));
            known.zip(metric).map(|(name, metric)| Subject::Source(name, metric))
        }
        (None, Some(combined)) => {
            section.check_keys(&[&keys::OF_ALL, &keys::PUBLISHED]);
            combined.choice(&CombinedFigure::ALL).map(Subject::Combined)
        }
        _ => section.document.fail(
            Diagnostic::new(section.span.clone(), "a published figure needs either `source` or `combined`")
                .label("neither or both are given")
                .help("give either `source` and `metric`, or `combined`"),
        ),
    };
    let mut figure = |key: &str| {
        let item = section.get(key)?;
        constant(&item, Dimension::LENGTH, &format!("the figure `{key}`"))
    };
    let figures = ["x", "y", "z", "norm"].map(&mut figure);
    let within = section.required("within");
    let within = within.and_then(|item| positive_length(&item));
    let reference = section.optional_text("reference");
    Some(Published { subject: subject?, figures, within: within?, reference })
}

/// Reads `[compensated]`.
pub(super) fn read_compensated(item: &Item<'_>) -> Option<PublishedResidual> {
    let section = item.section()?;
    section.check_keys(&[&keys::COMPENSATED]);
    let length = |key: &str| {
        let item = section.required(key)?;
        positive_length(&item)
    };
    let (residual, random, total) = (length("residual"), length("random"), length("total"));
    let reference = section.optional_text("reference");
    Some(PublishedResidual { residual: residual?, random: random?, total: total?, reference })
}
