//! Report of a bound.

use abbe_spec::option::{BOXES, NamedOption, TIME};
use std::sync::Arc;

use abbe::{Class, Orientation};
use abbe_bound::Effort;
use abbe_spec::expr::Extrapolation;
use abbe_spec::{Fitted, Spec};
use indexmap::IndexMap;
use serde::Serialize;

use crate::{Notes, Study, number, workspace::Span};

use super::domain::Domain;

/// Bounds on the errors over a box of configurations. Lengths are in the spec's unit, angles in
/// rad. To first order in the errors of the sources, the true maximum of each error lies between
/// `found` and `certified`.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the manipulator.
    pub manipulator: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Requested gap: largest excess of `certified` over `found`, as a share of `found`.
    pub gap: f64,
    /// Errors of the repeatable sources, with signs.
    pub repeatable: ErrorBounds,
    /// Errors of the random sources together, each with any value within its bound.
    pub random: ErrorBounds,
    /// Errors of all sources together: the worst case.
    pub total: ErrorBounds,
    /// First-order error of the repeatable sources; `None` if there are none.
    pub remainder: Option<Remainder>,
    /// Error of the repeatable sources after one step of compensation; `None` without repeatable
    /// sources, with fewer than three joints, or with branches or loops.
    pub after_one_step: Option<StepResidual>,
    /// Margin to the position tolerance, in the length unit; `None` if the study has no such
    /// tolerance.
    pub margin: Option<Margin>,
    /// Margin to the orientation tolerance, in rad; `None` if the study has no such tolerance.
    pub orientation_margin: Option<Margin>,
    /// Smallest motion of the tool per unit of joint motion; `None` if not requested, or with fewer
    /// than three joints.
    pub dexterity: Option<Dexterity>,
    /// Smallest stiffness at the tool point in any direction, in N/m, from the enabled repeatable
    /// beams and compliances. `None` if not requested, or if nothing is compliant.
    pub stiffness: Option<LowerBound>,
    /// Ranges of all moving joint variables, parameters and inputs, or of given passive variables.
    #[serde(rename = "box")]
    pub spans: IndexMap<String, [f64; 2]>,
    /// Indicates that the enclosing box is larger than the workspace of the study.
    pub contains_more: bool,
    /// Number of evaluated boxes, all searches together.
    pub boxes: usize,
    /// Indicates that every search reached the requested gap between its bounds.
    pub complete: bool,
    /// Spec of the manipulator, for names and units.
    #[serde(skip)]
    pub spec: Arc<Spec>,
    /// The study.
    #[serde(skip)]
    pub study: Study,
    /// Enclosing box of the workspace.
    #[serde(skip)]
    pub moving_spans: Vec<Span>,
    /// Changes of the spec by options, in their order.
    #[serde(skip)]
    pub changes: Vec<NamedOption>,
}

/// Classes that have an enabled source.
#[derive(Clone, Copy)]
pub(super) struct Classes {
    pub(super) repeatable: bool,
    pub(super) random: bool,
}

impl Classes {
    pub(super) fn enabled(spec: &Spec) -> Self {
        let any = |repeatable: bool| {
            spec.enabled_sources().any(|source| (source.class == Class::Repeatable) == repeatable)
        };
        Self { repeatable: any(true), random: any(false) }
    }
}

/// Bounds on one kind of error.
#[derive(Clone, Debug, Serialize)]
pub struct ErrorBounds {
    /// Norm ‖ΔX‖ of the position error, in the length unit.
    pub norm: ErrorBound,
    /// Absolute position error along x of `F_0`.
    pub x: ErrorBound,
    /// Absolute position error along y of `F_0`.
    pub y: ErrorBound,
    /// Absolute position error along z of `F_0`.
    pub z: ErrorBound,
    /// Norm of rows 4–6, in rad.
    pub orientation: ErrorBound,
}

/// Bounds on the largest magnitude of an error over the box, in the length unit or rad.
#[derive(Clone, Debug, Serialize)]
pub struct ErrorBound {
    /// Lower bound: the value at the configuration `at`.
    pub found: f64,
    /// Certified upper bound; `None` if nothing could be proved.
    pub certified: Option<f64>,
    /// Configuration of `found`: values of all joint variables, and of the parameters and inputs
    /// that move.
    pub at: IndexMap<String, f64>,
    /// Number of evaluated boxes.
    pub boxes: usize,
    /// Indicates that the gap was reached.
    pub complete: bool,
    /// Description of the configuration by its differences from home.
    #[serde(skip)]
    pub label: String,
    /// Description of a configuration near which the error may be infinite, if there is one.
    #[serde(skip)]
    pub unbounded: Option<String>,
}

/// First-order error: distance of the tool point between the exact chain `A_1 E_1 … A_n E_n T` and
/// `ΔX = J_e ε` of the repeatable sources.
#[derive(Clone, Debug, Serialize)]
pub struct Remainder {
    /// Certified upper bound over the box, in the length unit; `None` if nothing could be proved.
    pub certified: Option<f64>,
    /// Number of evaluated boxes.
    pub boxes: usize,
}

/// Error of the repeatable sources after one step of compensation, `q′ = q − J_q⁻¹ J_e ε`: the
/// exact chain at q′ compared with the ideal chain at q.
#[derive(Clone, Debug, Serialize)]
pub struct StepResidual {
    /// Certified upper bound on the distance of the tool point over the box, in the length unit;
    /// `None` if nothing could be proved.
    pub position: Option<f64>,
    /// Certified upper bound on the rotation of the tool over the box, in rad. `None` if nothing
    /// could be proved, or with fewer than six joints, which correct the tool point alone.
    pub orientation: Option<f64>,
    /// Number of evaluated boxes.
    pub boxes: usize,
    /// Indicates that six or more joints correct the orientation, too.
    #[serde(skip)]
    pub corrects_orientation: bool,
    /// Configuration where one step can increase the error, if one was found: it is near a
    /// singularity.
    #[serde(skip)]
    pub near_singularity: Option<String>,
    /// Indicates that tables of the spec have ends, beyond which the bound holds their last value.
    #[serde(skip)]
    pub holds_tables: bool,
}

/// Smallest singular value of the joint Jacobian `J_q`, in metres and radians: the smallest motion
/// of the tool for a joint motion of root sum of squares 1. It is 0 at a singularity.
#[derive(Clone, Debug, Serialize)]
pub struct Dexterity {
    /// Dexterity of the tool point, rows 1–3.
    pub point: LowerBound,
    /// Dexterity of the tool, all rows with 1 rad counted as 1 m; `None` with fewer than six
    /// joints.
    pub pose: Option<LowerBound>,
}

/// Bounds on a smallest value over the box, in N/m for a stiffness, in metres and radians for a
/// dexterity.
#[derive(Clone, Debug, Serialize)]
pub struct LowerBound {
    /// Certified lower bound.
    pub certified: f64,
    /// Upper bound: the value at the configuration `at`; `None` if no evaluated value was finite.
    pub found: Option<f64>,
    /// Configuration of `found`: values of all joint variables, and of the parameters and inputs
    /// that move.
    pub at: IndexMap<String, f64>,
    /// Number of evaluated boxes.
    pub boxes: usize,
    /// Indicates that the gap was reached, or that `found` is nearly zero.
    pub complete: bool,
    /// Description of the configuration by its differences from home.
    #[serde(skip)]
    pub label: String,
}

/// Margin between the largest error and a tolerance, to first order, in the length unit or rad. The
/// error is that of all sources in the worst case; a negative margin exceeds the tolerance.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Margin {
    /// Tolerance: the length unit, or rad.
    pub tolerance: f64,
    /// Certified lower bound on the margin over the box; `None` if nothing could be proved.
    pub certified: Option<f64>,
    /// Smallest margin that was found, an upper bound.
    pub found: f64,
    /// Smallest margin at the configurations of the study; `None` if none was evaluated.
    pub in_study: Option<f64>,
    /// Certified lower bound on the margin after one step of compensation of the repeatable
    /// sources; `None` if nothing could be proved or nothing is compensated.
    pub after_one_step: Option<f64>,
}

impl Margin {
    fn new(tolerance: f64, largest: &ErrorBound, left: Option<f64>, random: &ErrorBound) -> Self {
        let both = left.zip(random.certified).map(|(left, random)| (left + random).next_up());
        let below = |error: f64| (tolerance - error).next_down();
        Self {
            tolerance,
            certified: largest.certified.map(below),
            found: tolerance - largest.found,
            in_study: None,
            after_one_step: both.map(below),
        }
    }
}

impl StepResidual {
    /// Creates the result from the bounds on position and orientation. `before` holds the bounds
    /// without compensation.
    pub(super) fn new(
        domain: &Domain,
        bounds: &[Option<abbe_bound::Bound>; 2],
        before: [f64; 2],
        corrects_orientation: bool,
    ) -> Self {
        let [point, turn] = bounds;
        let certified =
            |bound: &Option<abbe_bound::Bound>| bound.as_ref().and_then(|bound| if_finite(bound.certified));
        let all = bounds.iter().flatten().zip(before);
        let hard = all.clone().find(|(bound, before)| bound.found > *before);
        Self {
            position: certified(point),
            orientation: certified(turn),
            boxes: all.map(|(bound, _)| bound.boxes).sum(),
            corrects_orientation,
            near_singularity: hard.map(|(bound, _)| domain.describe(&bound.at).1),
            holds_tables: domain.spec.tables.iter().any(|table| table.outside == Extrapolation::Nothing),
        }
    }
}

impl Remainder {
    pub(super) fn new(bound: &abbe_bound::Bound) -> Self {
        Self { certified: if_finite(bound.certified), boxes: bound.boxes }
    }
}

impl Report {
    pub(super) fn new(
        Domain { spec, spans: moving_spans, .. }: Domain,
        study: &Study,
        effort: &Effort,
        [repeatable, random, total]: [ErrorBounds; 3],
        (remainder, after_one_step): (Option<Remainder>, Option<StepResidual>),
        (dexterity, stiffness): (Option<Dexterity>, Option<LowerBound>),
    ) -> Self {
        let of_both = matches!(Classes::enabled(&spec), Classes { repeatable: true, random: true });
        // With sources of one class only, `total` is a copy and is not counted.
        let kinds = [Some(&repeatable), Some(&random), of_both.then_some(&total)];
        let all = || kinds.into_iter().flatten().flat_map(ErrorBounds::all);
        let spans =
            moving_spans.iter().map(|span| (spec.name_of(span.symbol).to_owned(), span.range)).collect();
        let boxes: usize = all().map(|largest| largest.boxes).sum();
        let boxes = boxes + remainder.as_ref().map_or(0, |remainder| remainder.boxes);
        let boxes = boxes + after_one_step.as_ref().map_or(0, |left| left.boxes);
        let dexterities = dexterity.iter().flat_map(|both| std::iter::once(&both.point).chain(&both.pose));
        let least = dexterities.chain(&stiffness);
        let boxes = boxes + least.clone().map(|least| least.boxes).sum::<usize>();
        let complete = all().all(|largest| largest.complete) && least.clone().all(|least| least.complete);
        let left = after_one_step.as_ref();
        let margin = study.tolerance.map(|tolerance| {
            Margin::new(tolerance, &total.norm, left.and_then(|left| left.position), &random.norm)
        });
        let is_rotation = spec.orientation == Orientation::RotationVector;
        let orientation_margin = study.orientation_tolerance.map(|tolerance| {
            // Euler angles are no rotation vector and cannot be added to one.
            let left = left.and_then(|left| left.orientation).filter(|_| is_rotation);
            Margin::new(tolerance, &total.orientation, left, &random.orientation)
        });
        Self {
            manipulator: spec.name.clone(),
            length: spec.length.symbol(),
            gap: effort.gap,
            repeatable,
            random,
            total,
            remainder,
            after_one_step,
            margin,
            orientation_margin,
            dexterity,
            stiffness,
            spans,
            contains_more: !study.region.is_box(&spec),
            boxes,
            complete,
            spec,
            study: study.clone(),
            moving_spans,
            changes: Vec::new(),
        }
    }

    /// Returns the kinds of error that have a source, with their titles.
    pub fn kinds(&self) -> Vec<(&'static str, &ErrorBounds)> {
        let Classes { repeatable, random } = Classes::enabled(&self.spec);
        let kinds = [
            ("Repeatable sources, with their signs", &self.repeatable, repeatable),
            ("Random sources, with any values within their bounds", &self.random, random),
            ("All sources: the worst case", &self.total, repeatable && random),
        ];
        kinds.into_iter().filter(|(.., any)| *any).map(|(title, errors, _)| (title, errors)).collect()
    }

    /// Describes the range on which errors were fitted, if the box exceeds it.
    fn extrapolated(&self, fitted: &Fitted) -> Option<String> {
        let span = self.moving_spans.iter().find(|span| span.symbol == fitted.symbol)?;
        let [first, last] = fitted.range.map(|end| number::of_symbol(end, fitted.symbol, &self.spec));
        let is_within = span.range.into_iter().all(|end| fitted.contains(end));
        (!is_within).then(|| format!("{} beyond {first} … {last}", self.spec.name_of(fitted.symbol)))
    }

    pub(super) fn warn(&self, notes: &mut dyn Notes) {
        let extrapolated: Vec<String> =
            self.spec.fitted.iter().filter_map(|fitted| self.extrapolated(fitted)).collect();
        if !extrapolated.is_empty() {
            notes.warn(&format!(
                "the box exceeds the ranges on which the errors were identified; they are \
                 extrapolated: {}",
                extrapolated.join(", ")
            ));
        }
        if self.contains_more {
            notes.note(
                "the box has the ranges of the joints over the configurations of the study, and \
                 contains other configurations: the bounds hold for the study, whose own maximum \
                 may be smaller",
            );
        }
        let unknown = self.total.all().into_iter().filter(|largest| largest.certified.is_none());
        let open = unknown.filter_map(|largest| largest.unbounded.as_ref()).next();
        if let Some(place) = open.filter(|_| !self.spec.loops.is_empty()) {
            notes.warn(&format!(
                "near {} a loop may open or reach a dead point, where nothing bounds the errors; or the boxes \
                 there are still too large, and {BOXES} and {TIME} allow smaller ones",
                if place.is_empty() { "home" } else { place }
            ));
        }
        if !self.complete {
            notes.warn(&format!(
                "the gap of {} was not reached everywhere: the bounds hold, but may be far above \
                 the maximum; {BOXES} and {TIME} allow more work",
                number::percent(self.gap, 1.0)
            ));
        }
    }
}

impl ErrorBounds {
    /// Tightens each bound by the sum of the bounds on two parts.
    pub(super) fn tighten_by_sum(self, first: &Self, second: &Self) -> Self {
        let sum = |first: &ErrorBound, second: &ErrorBound| {
            first.certified.zip(second.certified).map(|(first, second)| (first + second).next_up())
        };
        let sums = first.all().into_iter().zip(second.all()).map(|(first, second)| sum(first, second));
        self.at_most(sums)
    }

    /// Tightens each bound by that on a sum of which this is a part.
    pub(super) fn tighten(self, sum: &Self) -> Self {
        self.at_most(sum.all().into_iter().map(|sum| sum.certified))
    }

    /// Tightens each bound, in report order.
    fn at_most(self, limits: impl Iterator<Item = Option<f64>>) -> Self {
        let mut bounds = self;
        for (own, limit) in
            [&mut bounds.norm, &mut bounds.x, &mut bounds.y, &mut bounds.z, &mut bounds.orientation]
                .into_iter()
                .zip(limits)
        {
            own.certified = [own.certified, limit].into_iter().flatten().reduce(f64::min);
        }
        bounds
    }

    /// Returns the five bounds in report order.
    pub fn all(&self) -> [&ErrorBound; 5] {
        [&self.norm, &self.x, &self.y, &self.z, &self.orientation]
    }
}

impl ErrorBound {
    /// Largest ratio of the certified to the found value at which the bound says how large the
    /// error is.
    const CLOSE: f64 = 3.0;

    /// Returns `true` if the certified value is at most three times the found one.
    pub fn is_close(&self) -> bool {
        self.certified.is_some_and(|certified| certified <= Self::CLOSE * self.found)
    }

    pub(super) fn new(bound: &abbe_bound::Bound, domain: &Domain) -> Self {
        let (at, label) = domain.describe(&bound.at);
        Self {
            found: bound.found,
            certified: if_finite(bound.certified),
            at,
            boxes: bound.boxes,
            complete: bound.complete,
            label,
            unbounded: bound.unbounded.as_ref().map(|at| domain.describe(at).1),
        }
    }
}

/// Returns the certified value if it is finite.
fn if_finite(certified: f64) -> Option<f64> {
    Some(certified).filter(|certified| certified.is_finite())
}
