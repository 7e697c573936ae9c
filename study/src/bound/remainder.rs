//! What first order leaves out, and what a step of compensation leaves.

use abbe_bound::{Effort, Moving, Progress};
use abbe_codegen::chain::{self, Magnitude};
use abbe_codegen::graph::Graph;
use abbe_spec::expr::Symbol;

use super::domain::{Domain, home};
use super::report::{AfterStep, Classes, Remainder};

/// What first order leaves out, and a step of compensation leaves, is small: it is known closely enough when it is known to a half, or
/// after so many boxes.
const REMAINDER_EFFORT: Effort = Effort { gap: 0.5, boxes: 20_000, at_most: f64::INFINITY };
/// Of what is still endless after so many boxes nothing will soon be known.
const HOPELESS: usize = 3_000;

impl Domain {
    /// What first order leaves out of the repeatable sources' position; none if there are no such sources.
    pub(super) fn remainder(
        &self,
        asked: &Effort,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Option<Remainder> {
        if !Classes::of(&self.spec).repeatable {
            return None;
        }
        let chain::Remainder { mut graph, magnitude, share } = chain::Remainder::new(&self.spec);
        Some(Remainder::new(&self.curve(&mut graph, &magnitude, share, asked, watch)))
    }

    /// What one step of compensation leaves of the repeatable sources; none if there are no such sources, or too few joints. Where it
    /// may leave more than `before`, what the sources do without it, nothing is sought any longer.
    pub(super) fn after_step(
        &self,
        asked: &Effort,
        before: [f64; 2],
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Option<AfterStep> {
        if !Classes::of(&self.spec).repeatable {
            return None;
        }
        let chain::Residual { mut graph, point, turn, share } = chain::Residual::new(&self.spec)?;
        let mut largest = |magnitude: &Magnitude, before: f64| {
            let mut watch = |progress: &Progress| {
                let is_hopeless = progress.certified.is_infinite() && progress.boxes >= HOPELESS;
                progress.found <= before && !is_hopeless && watch(progress)
            };
            self.curve(&mut graph, magnitude, share, asked, &mut watch)
        };
        let corrects_orientation = turn.is_some();
        let point = largest(&point, before[0]);
        let turn = turn.filter(|_| point.certified.is_finite()).map(|turn| largest(&turn, before[1]));
        Some(AfterStep::new(self, &[Some(point), turn], before, corrects_orientation))
    }

    /// The largest size along a curve that leads to the errors, anywhere in the box.
    fn curve(
        &self,
        graph: &mut Graph,
        magnitude: &Magnitude,
        share: Symbol,
        asked: &Effort,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> abbe_bound::Bound {
        let mut moving = self.names();
        moving.push(Moving { symbol: share, range: [0.0, 1.0], home: 0.0, start: 0.0 });
        let gap = asked.gap.max(REMAINDER_EFFORT.gap);
        let effort = Effort { gap, boxes: asked.boxes.min(REMAINDER_EFFORT.boxes), ..REMAINDER_EFFORT };
        abbe_bound::largest(graph, magnitude, &moving, |symbol| home(symbol, &self.spec), &effort, watch)
    }
}
