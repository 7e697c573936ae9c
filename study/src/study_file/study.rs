//! Content of a study.
//!
//! Reads `[allocation]`: costs of the factors of the sources.
//!
//! Published figures for comparison with the computed ones.

use std::path::PathBuf;

use abbe_spec::{Diagnostic, Item, Section, Spec, expr::Dimension, value::find_name};
use serde::Serialize;

use super::{CombinedFigure, Compensated, Criterion, Figure, JudgedMachine, Metric, keys, tolerance};
use crate::workspace::{Region, constant, positive};
use crate::{Changes, Result};

/// Probability and yield that are required if a study states none.
pub(super) const PROBABILITY: f64 = 0.95;

/// Analysis to perform on a manipulator.
#[derive(Clone, Debug)]
pub struct Study {
    /// Title of the study.
    pub title: String,
    /// Author of the published figures.
    pub publisher: String,
    /// Permitted position error of the tool point, in the length unit.
    pub tolerance: Option<f64>,
    /// Permitted norm of rows 4–6, in rad.
    pub orientation_tolerance: Option<f64>,
    /// Largest share of the configurations that may be unreachable if a tolerance is to be met.
    pub unreachable: f64,
    /// Criterion of the verdict.
    pub criterion: Criterion,
    /// Probability with which a tolerance must be met, if it is judged by that or by yield.
    pub probability: f64,
    /// Share of machines that must meet it, if it is judged by yield.
    pub required_yield: f64,
    /// Machine whose verdict counts.
    pub judged: JudgedMachine,
    /// Changes of the spec.
    pub changes: Changes,
    /// Workspace to analyze.
    pub region: Region,
    /// Published figures.
    pub published: Vec<Published>,
    /// Published errors after compensation.
    pub compensated: Option<PublishedResidual>,
    /// Residuals after compensation.
    pub compensation: Option<Compensated>,
    /// Costs of the factors of sources: the index of the source, the cost of its factor 1, infinite
    /// if it is fixed, and the exponent.
    pub allocation: Vec<(usize, [f64; 2])>,
    /// Published results that cannot be reproduced, one sentence each.
    pub not_reproducible: Vec<String>,
    /// Figures to compute and draw.
    pub figures: Vec<Figure>,
    /// File name and SHA-256 of the text; none without a study.
    pub file: Option<(String, String)>,
    /// Files that were read: the study itself and those of paths.
    pub files: Vec<PathBuf>,
    /// Tolerances that were given as options, as they were written.
    pub stated_tolerances: Vec<String>,
}

impl Study {
    /// Removes all published results, because the machine has changed. Returns true if there were
    /// any.
    pub fn remove_published(&mut self) -> bool {
        let any = !self.published.is_empty() || self.compensated.is_some();
        self.published.clear();
        self.compensated = None;
        self.not_reproducible.clear();
        any
    }

    /// Returns the tolerances of position, in the length unit, and orientation, in rad.
    pub fn tolerances(&self) -> [Option<f64>; 2] {
        [self.tolerance, self.orientation_tolerance]
    }

    /// Replaces the workspace by configurations of the joints, with nominal parameters and inputs.
    /// Published results, which belong to the workspace, are removed. Returns true if there
    /// were any.
    pub fn restrict(&mut self, mut rows: Vec<Vec<f64>>) -> bool {
        self.region = match rows.pop() {
            Some(q) if rows.is_empty() => Region::one(q),
            last => Region::listed(rows.into_iter().chain(last).collect()),
        };
        self.figures = Figure::defaults(&self.region);
        self.remove_published()
    }

    /// Replaces tolerances by those given as options: lengths for the position, angles for the
    /// orientation.
    ///
    /// # Errors
    ///
    /// Returns a mistake for a text that is no positive length or angle.
    pub fn limit(&mut self, tolerances: &[String], spec: &Spec) -> Result<()> {
        for (is_angle, value) in tolerance::parse(tolerances, spec.length)? {
            let limit = if is_angle { &mut self.orientation_tolerance } else { &mut self.tolerance };
            *limit = Some(value);
        }
        self.stated_tolerances.extend_from_slice(tolerances);
        Ok(())
    }

    /// Keeps inputs nominal in all workspaces, and removes figures over them.
    pub fn fix(&mut self, inputs: &[usize]) {
        self.region.fix(inputs);
        self.figures.retain(|figure| !figure.is_over(inputs));
        self.figures
            .iter_mut()
            .filter_map(|figure| figure.region.as_mut())
            .for_each(|region| region.fix(inputs));
    }

    /// Returns the default study: a thousand joint samples with both ends of every input, and no
    /// tolerance.
    pub fn joint_samples(spec: &Spec) -> Self {
        let region = Region::samples(spec);
        Self {
            title: match region.moving_inputs().is_empty() {
                true => "No study: the limits of the joints are the workspace".to_owned(),
                false => "No study: the limits of the joints and the ranges of the inputs are the workspace"
                    .to_owned(),
            },
            publisher: String::new(),
            tolerance: None,
            orientation_tolerance: None,
            unreachable: 0.0,
            criterion: Criterion::WorstCase,
            probability: PROBABILITY,
            required_yield: PROBABILITY,
            judged: JudgedMachine::AsBuilt,
            changes: Changes::default(),
            figures: Figure::defaults(&region),
            region,
            published: Vec::new(),
            compensated: None,
            compensation: None,
            allocation: Vec::new(),
            not_reproducible: Vec::new(),
            file: None,
            files: Vec::new(),
            stated_tolerances: Vec::new(),
        }
    }
}

/// Reads the costs: the index of a source, the cost c of its factor 1, infinite if it is fixed, and
/// the exponent p. The factor x costs `c x^(−p)`.
pub(super) fn read_allocation(item: &Item<'_>, spec: &Spec) -> Vec<(usize, [f64; 2])> {
    let names = spec.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>();
    let items = item.section().into_iter().flat_map(|section| section.items().collect::<Vec<_>>());
    let cost = |item: Item<'_>| {
        let source = find_name(item.document, item.key_span.clone(), &item.key, &names, "source")?;
        let table = item.table(format!("\"{}\"", item.key), &[&keys::ALLOCATION])?;
        let [cost, exponent] = ["cost", "exponent"]
            .map(|key| table.get(key).map_or(Some(1.0), |item| positive(&item, Dimension::NONE)));
        let is_fixed = table.get("fixed").map_or(Some(false), |item| item.boolean())?;
        Some((source, [if is_fixed { f64::INFINITY } else { cost? }, exponent?]))
    };
    items.filter_map(cost).collect()
}

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
            let metric = section.required("metric").and_then(|item| item.choice(&Metric::ALL));
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
    let figures = ["x", "y", "z", "norm"]
        .map(|key| constant(&section.get(key)?, Dimension::LENGTH, &format!("the figure `{key}`")));
    let within = section.required("within").and_then(|item| positive(&item, Dimension::LENGTH));
    let reference = section.optional_text("reference");
    Some(Published { subject: subject?, figures, within: within?, reference })
}

/// Reads `[compensated]`.
pub(super) fn read_compensated(item: &Item<'_>) -> Option<PublishedResidual> {
    let section = item.section()?;
    section.check_keys(&[&keys::COMPENSATED]);
    let length = |key: &str| positive(&section.required(key)?, Dimension::LENGTH);
    let (residual, random, total) = (length("residual"), length("random"), length("total"));
    let reference = section.optional_text("reference");
    Some(PublishedResidual { residual: residual?, random: random?, total: total?, reference })
}
