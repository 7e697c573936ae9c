//! Bounds on the first-order error, and on the error after one step of compensation.
//!
//! Smallest singular value of the joint Jacobian, and smallest stiffness of the machine.

use abbe_bound::{Effort, Extreme, Moving, Progress, Singular, Watch, singular_value};
use abbe_codegen::chain::{self, Implicit, Magnitude};
use abbe_codegen::graph::Graph;
use abbe_spec::expr::Symbol;

use super::domain::{Domain, GIVE_UP_BOXES};
use super::report::{Classes, Dexterity, LowerBound, Remainder, StepResidual};

/// Effort for these small errors: a gap of one half is enough.
const REMAINDER_EFFORT: Effort = Effort { gap: 0.5, boxes: 20_000, ..Effort::DEFAULT };

impl Domain {
    /// Bounds the first-order error in the position for the repeatable sources; `None` if there are
    /// none.
    pub(super) fn remainder(&self, requested: &Effort, watch: &mut Watch<'_>) -> Option<Remainder> {
        if !Classes::enabled(&self.spec).repeatable {
            return None;
        }
        let Some(remainder) = chain::Remainder::new(&self.spec, &self.given) else {
            return Some(Remainder { certified: None, boxes: 0 });
        };
        let chain::Remainder { mut graph, magnitude, implicit, share } = remainder;
        let bound = self.largest_on_curve(&mut graph, &magnitude, &implicit, share, requested, watch);
        Some(Remainder::new(&bound))
    }

    /// Bounds the error of the repeatable sources after one step of compensation, where tables hold
    /// their last value if the step goes beyond their ends; `None` without repeatable sources, with
    /// too few joints or for a tree of frames. Stops where it may exceed `before`, the error
    /// without compensation.
    pub(super) fn after_step(
        &self,
        requested: &Effort,
        before: [f64; 2],
        watch: &mut Watch<'_>,
    ) -> Option<StepResidual> {
        if !Classes::enabled(&self.spec).repeatable || !self.spec.is_serial() {
            return None;
        }
        let chain::CompensationResidual { mut graph, point, turn, share } =
            chain::CompensationResidual::new(&self.spec.with_held_tables())?;
        let mut largest = |magnitude: &Magnitude, before: f64| {
            let mut watch = |progress: &Progress| {
                let is_given_up = progress.certified.is_infinite() && progress.boxes >= GIVE_UP_BOXES;
                progress.found <= before && !is_given_up && watch(progress)
            };
            self.largest_on_curve(&mut graph, magnitude, &[], share, requested, &mut watch)
        };
        let corrects_orientation = turn.is_some();
        let point = largest(&point, before[0]);
        let turn = turn.filter(|_| point.certified.is_finite()).map(|turn| largest(&turn, before[1]));
        Some(StepResidual::new(self, &[Some(point), turn], before, corrects_orientation))
    }

    /// Bounds the largest magnitude over the box along the curve from zero to full errors, on which
    /// the symbol `share` runs from 0 to 1.
    fn largest_on_curve(
        &self,
        graph: &mut Graph,
        magnitude: &Magnitude,
        implicit: &[Implicit],
        share: Symbol,
        requested: &Effort,
        watch: &mut Watch<'_>,
    ) -> abbe_bound::Bound {
        let mut moving = self.names();
        moving.push(Moving { symbol: share, range: [0.0, 1.0], home: 0.0, start: 0.0 });
        let gap = requested.gap.max(REMAINDER_EFFORT.gap);
        let effort = Effort { gap, boxes: requested.boxes.min(REMAINDER_EFFORT.boxes), ..REMAINDER_EFFORT };
        abbe_bound::largest(graph, magnitude, implicit, &moving, &|symbol| self.home(symbol), &effort, watch)
    }

    /// Returns the dexterity of the tool point and of the tool; `None` for fewer than three joints.
    pub(super) fn dexterity(&self, effort: &Effort, watch: &mut Watch<'_>) -> Option<Dexterity> {
        let chain::Dexterity { graph, point, pose } = chain::Dexterity::new(&self.spec)?;
        let mut least = |rows: &Vec<_>| {
            let still = |symbol| self.home(symbol);
            let least = singular_value(Extreme::Least, &graph, rows, &self.names(), &still, effort, watch);
            self.least(&least)
        };
        Some(Dexterity { point: least(&point), pose: pose.as_ref().map(least) })
    }

    /// Returns the smallest stiffness at the tool point, in N/m: the inverse of the largest
    /// compliance. `None` if no force deflects the tool point.
    pub(super) fn stiffness(&self, effort: &Effort, watch: &mut Watch<'_>) -> Option<LowerBound> {
        let chain::ToolCompliance { graph, rows } = chain::ToolCompliance::new(&self.spec)?;
        let still = |symbol| self.home(symbol);
        let largest = singular_value(Extreme::Largest, &graph, &rows, &self.names(), &still, effort, watch);
        let certified = (1.0 / largest.certified).next_down().max(0.0);
        Some(self.least(&Singular { certified, found: largest.found.map(f64::recip), ..largest }))
    }

    fn least(&self, least: &Singular) -> LowerBound {
        let (at, label) = self.describe(&least.at);
        let Singular { certified, found, boxes, complete, .. } = *least;
        LowerBound { certified, found: found.filter(|found| found.is_finite()), at, boxes, complete, label }
    }
}
