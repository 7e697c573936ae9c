//! What is proved.

use std::sync::Arc;

use abbe::{Class, Orientation};
use abbe_bound::Effort;
use abbe_spec::{Fitted, Spec};
use indexmap::IndexMap;
use serde::Serialize;

use crate::notes::Notes;
use crate::number;
use crate::study_file::Study;
use crate::workspace::{Span, name};

use super::domain::Domain;

/// What [`Bound`](super::Bound) proves. Lengths in the spec's unit, angles in rad; the true maximum of each error, to first
/// order in the errors of the sources, lies between `found` and `certified`.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The manipulator.
    pub manipulator: String,
    /// The unit of every length.
    pub length: &'static str,
    /// Which share of `found` `certified` may exceed it by.
    pub gap: f64,
    /// Of the repeatable sources, with their signs.
    pub repeatable: Errors,
    /// Root sum of squares of the random sources.
    pub random: Errors,
    /// Both, added.
    pub radius: Errors,
    /// What first order leaves out of the repeatable sources; none if there are no such sources.
    pub remainder: Option<Remainder>,
    /// What one step of compensation leaves of the repeatable sources; none if there are no such sources, or fewer than three joints.
    pub after_one_step: Option<AfterStep>,
    /// What the errors leave of the position's tolerance of the study; none if it has none.
    pub margin: Option<Margin>,
    /// What they leave of the orientation's, rad.
    pub orientation_margin: Option<Margin>,
    /// How far the joints move the tool at least; none if it was not asked for, or of fewer than three joints.
    pub dexterity: Option<Dexterity>,
    /// How stiff the machine is at least, N/m: a force at the tool point, in whatever direction, over the length by which the enabled repeatable
    /// beams and compliances let it move; none if it was not asked for, or nothing gives way.
    pub stiffness: Option<Least>,
    /// From where to where everything goes that moves.
    #[serde(rename = "box")]
    pub spans: IndexMap<String, [f64; 2]>,
    /// Whether the box holds more than the workspace of the study.
    pub contains_more: bool,
    /// How many boxes were looked at.
    pub boxes: usize,
    /// Whether the gap was reached everywhere.
    pub complete: bool,
    /// Of which manipulator, for names and units.
    #[serde(skip)]
    pub spec: Arc<Spec>,
    /// The study.
    #[serde(skip)]
    pub study: Study,
    /// The box.
    #[serde(skip)]
    pub moved: Vec<Span>,
}

/// Of which classes there are sources that are switched on.
#[derive(Clone, Copy)]
pub(super) struct Classes {
    pub(super) repeatable: bool,
    pub(super) random: bool,
}

impl Classes {
    pub(super) fn of(spec: &Spec) -> Self {
        let any = |repeatable: bool| {
            spec.enabled_sources().any(|source| (source.class == Class::Repeatable) == repeatable)
        };
        Self { repeatable: any(true), random: any(false) }
    }
}

/// Errors of one kind.
#[derive(Clone, Debug, Serialize)]
pub struct Errors {
    /// ‖ΔX‖ of the position.
    pub norm: Largest,
    /// Along x of `F_0`.
    pub x: Largest,
    /// Along y.
    pub y: Largest,
    /// Along z.
    pub z: Largest,
    /// The norm of rows 4–6, rad.
    pub orientation: Largest,
}

/// The largest size of an error.
#[derive(Clone, Debug, Serialize)]
pub struct Largest {
    /// It is at least this.
    pub found: f64,
    /// It is at most this; none if nothing could be proved.
    pub certified: Option<f64>,
    /// Where `found` is: the value of every variable, and of every parameter and input that moves.
    pub at: IndexMap<String, f64>,
    /// How many boxes were looked at.
    pub boxes: usize,
    /// Whether the gap was reached.
    pub complete: bool,
    /// Where `found` is, but for what is at home.
    #[serde(skip)]
    pub place: String,
}

/// What first order leaves out: how far the exact chain `A_1 E_1 … A_n E_n T` has the tool point from where `ΔX = J_e ε` of the
/// repeatable sources has it.
#[derive(Clone, Debug, Serialize)]
pub struct Remainder {
    /// No more than this, anywhere in the box; none if nothing could be proved.
    pub certified: Option<f64>,
    /// How many boxes were looked at.
    pub boxes: usize,
}

/// What is left of the repeatable sources after one step of compensation, `q′ = q − J_q⁻¹ J_e ε`: how far the exact chain at q′ has the
/// tool from where the ideal one is at q.
#[derive(Clone, Debug, Serialize)]
pub struct AfterStep {
    /// Of the tool point no more than this, anywhere in the box; none if nothing could be proved.
    pub position: Option<f64>,
    /// The tool is turned by no more than this, rad; none if nothing could be proved, or of fewer than six joints, which correct the
    /// tool point alone.
    pub orientation: Option<f64>,
    /// How many boxes were looked at.
    pub boxes: usize,
    /// Whether six joints or more correct the orientation, too.
    #[serde(skip)]
    pub corrects_orientation: bool,
    /// Where joints can hardly do it, if there is such a place.
    #[serde(skip)]
    pub hardly: Option<String>,
}

/// How far the tool moves at least, in whatever direction, where the joints move by 1 m or 1 rad altogether (root sum of squares): the
/// least singular value of `J_q` in metres and rad, 0 in a singular place.
#[derive(Clone, Debug, Serialize)]
pub struct Dexterity {
    /// Of the tool point, rows 1–3.
    pub point: Least,
    /// Of the tool, a rad counted as a metre; none of fewer than six joints.
    pub pose: Option<Least>,
}

/// The least value anywhere in the box.
#[derive(Clone, Debug, Serialize)]
pub struct Least {
    /// It is no less than this.
    pub certified: f64,
    /// It is no more than this; none if there was no number wherever it was looked for.
    pub found: Option<f64>,
    /// Where `found` is.
    pub at: IndexMap<String, f64>,
    /// How many boxes were looked at.
    pub boxes: usize,
    /// Whether the gap was reached, or what is found is next to nothing.
    pub complete: bool,
    /// The same place in words, but for what is at home.
    #[serde(skip)]
    pub place: String,
}

/// What the largest error of both classes, added, leaves of a tolerance, to first order in the errors: negative where the tolerance is
/// exceeded.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Margin {
    /// The tolerance.
    pub tolerance: f64,
    /// So much is left everywhere in the box at least; none if nothing could be proved.
    pub certified: Option<f64>,
    /// No more than this is left at the worst place that was found.
    pub found: f64,
    /// So much is left at least once the repeatable sources are compensated by one step; none if nothing could be proved, or nothing is
    /// compensated.
    pub after_one_step: Option<f64>,
}

impl Margin {
    fn new(tolerance: f64, largest: &Largest, left: Option<f64>, random: &Largest) -> Self {
        let both = left.zip(random.certified).map(|(left, random)| (left + random).next_up());
        let below = |error: f64| (tolerance - error).next_down();
        Self {
            tolerance,
            certified: largest.certified.map(below),
            found: tolerance - largest.found,
            after_one_step: both.map(below),
        }
    }
}

impl AfterStep {
    /// From the largest sizes of position and orientation, and what these are without the step.
    pub(super) fn new(
        domain: &Domain,
        bounds: &[Option<abbe_bound::Bound>; 2],
        before: [f64; 2],
        corrects_orientation: bool,
    ) -> Self {
        let [point, turn] = bounds;
        let certified =
            |bound: &Option<abbe_bound::Bound>| bound.as_ref().and_then(|bound| known(bound.certified));
        let all = bounds.iter().flatten().zip(before);
        let hard = all.clone().find(|(bound, before)| bound.found > *before);
        Self {
            position: certified(point),
            orientation: certified(turn),
            boxes: all.map(|(bound, _)| bound.boxes).sum(),
            corrects_orientation,
            hardly: hard.map(|(bound, _)| domain.place(&bound.at).1),
        }
    }
}

impl Remainder {
    pub(super) fn new(bound: &abbe_bound::Bound) -> Self {
        Self { certified: known(bound.certified), boxes: bound.boxes }
    }
}

/// What is known beside the largest errors.
pub(super) struct Others {
    pub(super) remainder: Option<Remainder>,
    pub(super) after_one_step: Option<AfterStep>,
    pub(super) dexterity: Option<Dexterity>,
    pub(super) stiffness: Option<Least>,
}

impl Report {
    pub(super) fn new(
        Domain { spec, spans: moved }: Domain,
        study: &Study,
        effort: &Effort,
        [repeatable, random, radius]: [Errors; 3],
        Others { remainder, after_one_step, dexterity, stiffness }: Others,
    ) -> Self {
        let of_both = matches!(Classes::of(&spec), Classes { repeatable: true, random: true });
        // Of one class alone the last kind is a copy.
        let kinds = [Some(&repeatable), Some(&random), of_both.then_some(&radius)];
        let all = || kinds.into_iter().flatten().flat_map(Errors::all);
        let spans = moved.iter().map(|span| (name(span.symbol, &spec).to_owned(), span.range)).collect();
        let boxes: usize = all().map(|largest| largest.boxes).sum();
        let boxes = boxes + remainder.as_ref().map_or(0, |remainder| remainder.boxes);
        let boxes = boxes + after_one_step.as_ref().map_or(0, |left| left.boxes);
        let dexterities = dexterity.iter().flat_map(|both| std::iter::once(&both.point).chain(&both.pose));
        let least = dexterities.chain(&stiffness);
        let boxes = boxes + least.clone().map(|least| least.boxes).sum::<usize>();
        let complete = all().all(|largest| largest.complete) && least.clone().all(|least| least.complete);
        let left = after_one_step.as_ref();
        let margin = study.tolerance.map(|tolerance| {
            Margin::new(tolerance, &radius.norm, left.and_then(|left| left.position), &random.norm)
        });
        let is_rotation = spec.orientation == Orientation::RotationVector;
        let orientation_margin = study.orientation_tolerance.map(|tolerance| {
            // Rows 4–6 are no rotation vector elsewhere, and cannot be added to one.
            let left = left.and_then(|left| left.orientation).filter(|_| is_rotation);
            Margin::new(tolerance, &radius.orientation, left, &random.orientation)
        });
        Self {
            manipulator: spec.name.clone(),
            length: spec.length.symbol(),
            gap: effort.gap,
            repeatable,
            random,
            radius,
            remainder,
            after_one_step,
            margin,
            orientation_margin,
            dexterity,
            stiffness,
            spans,
            contains_more: !study.region.is_box(),
            boxes,
            complete,
            spec,
            study: study.clone(),
            moved,
        }
    }

    /// The kinds of errors of which there are sources: what they are called, and how they are summed.
    pub fn kinds(&self) -> Vec<(&'static str, &Errors)> {
        let Classes { repeatable, random } = Classes::of(&self.spec);
        let kinds = [
            ("Repeatable sources, with their signs", &self.repeatable, repeatable),
            ("Random sources at their bounds, root sum of squares", &self.random, random),
            ("Both, added", &self.radius, repeatable && random),
        ];
        kinds.into_iter().filter(|(.., any)| *any).map(|(title, errors, _)| (title, errors)).collect()
    }

    /// How far the box goes beyond the range on which errors were fitted, if it does.
    fn beyond(&self, fitted: &Fitted) -> Option<String> {
        let span = self.moved.iter().find(|span| span.symbol == fitted.symbol)?;
        let [first, last] = fitted.range.map(|end| number::of_symbol(end, fitted.symbol, &self.spec));
        let is_within = span.range.into_iter().all(|end| fitted.contains(end));
        (!is_within).then(|| format!("{} beyond {first} … {last}", self.spec.name_of(fitted.symbol)))
    }

    pub(super) fn warn(&self, notes: &mut dyn Notes) {
        let beyond: Vec<String> = self.spec.fitted.iter().filter_map(|fitted| self.beyond(fitted)).collect();
        if !beyond.is_empty() {
            notes.warn(&format!(
                "the errors were identified on less than the box, and are extrapolated beyond it: {}",
                beyond.join(", ")
            ));
        }
        if self.contains_more {
            notes.note(
                "the box contains more than the workspace of the study: what is certified holds for the workspace, too, but its \
                 own maximum may be smaller",
            );
        }
        if !self.complete {
            notes.warn(&format!(
                "the gap of {} was not reached everywhere: what is certified holds, but may be far more than the maximum; \
                 --boxes and --time allow more work",
                number::percent(self.gap, 1.0)
            ));
        }
    }
}

impl Errors {
    /// With what they cannot exceed because others, added, do not.
    pub(super) fn at_most(self, first: &Self, second: &Self) -> Self {
        let sum = |own: Largest, first: &Largest, second: &Largest| {
            let sum = first.certified.zip(second.certified).map(|(first, second)| (first + second).next_up());
            let certified = [own.certified, sum].into_iter().flatten().reduce(f64::min);
            Largest { certified, ..own }
        };
        Self {
            norm: sum(self.norm, &first.norm, &second.norm),
            x: sum(self.x, &first.x, &second.x),
            y: sum(self.y, &first.y, &second.y),
            z: sum(self.z, &first.z, &second.z),
            orientation: sum(self.orientation, &first.orientation, &second.orientation),
        }
    }

    /// All five, in the order of the report.
    pub fn all(&self) -> [&Largest; 5] {
        [&self.norm, &self.x, &self.y, &self.z, &self.orientation]
    }
}

impl Largest {
    pub(super) fn new(bound: &abbe_bound::Bound, domain: &Domain) -> Self {
        let (at, place) = domain.place(&bound.at);
        Self {
            found: bound.found,
            certified: known(bound.certified),
            at,
            boxes: bound.boxes,
            complete: bound.complete,
            place,
        }
    }
}

/// What is certified, if anything is.
fn known(certified: f64) -> Option<f64> {
    Some(certified).filter(|certified| certified.is_finite())
}
