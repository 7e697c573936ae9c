//! Newton's steps that close the loops, of the nominal machine and with errors.

use abbe_spec::expr::Symbol;
use abbe_spec::{Closure, Spec};

use super::closure::{self, Ends};
use super::continuation::{Continuation, home};
use super::factored::Factored;
use super::parts::Parts;
use crate::chain::kinematics::magnitudes;
use crate::chain::real::RealChain;
use crate::chain::sources::{Causes, PlacedErrors};
use crate::graph::{Frame, Graph, Node};

/// Nodes that close the loops. Passive variables are local symbols, from 0.
#[derive(Clone, Debug)]
pub(crate) struct ClosedLoops {
    /// Values of the passive variables at home, from which they are found.
    pub(crate) passive_home: Vec<f64>,
    /// Values of the joint variables at home.
    pub(crate) home: Vec<f64>,
    /// Number of equal steps by which the joint variables move from home to their values.
    pub(crate) continuation: usize,
    /// Newton's step `φ_p⁻¹ φ` of the nominal machine, to be subtracted from p.
    pub(crate) step: Vec<Node>,
    /// The machine with the errors of the repeatable sources.
    pub(crate) real: RealNodes,
    /// The machine with the errors of all sources, each times its magnitude.
    pub(crate) drawn: RealNodes,
    /// The machine with given errors of the frames.
    pub(crate) displaced: RealNodes,
    /// The passive variables.
    pub(crate) passive: Vec<Node>,
}

/// A machine with errors.
#[derive(Clone, Debug)]
pub(crate) struct RealNodes {
    /// The errors, at the nominal values of the passive variables. The other nodes read them as
    /// local symbols after the passive variables.
    pub(crate) errors: Vec<Node>,
    /// Newton's step of the machine with errors, to be subtracted from its p; empty without loops.
    pub(crate) step: Vec<Node>,
    /// Pose of the tool point.
    pub(crate) pose: Frame,
}

impl ClosedLoops {
    pub(in crate::chain) fn new(
        graph: &mut Graph,
        spec: &Spec,
        parts: &Parts<'_>,
        causes: &Causes,
        errors: &[[Node; 6]],
    ) -> Self {
        let Continuation { start: passive_home, steps: continuation } = Continuation::new(spec);
        let residual = parts.residual(graph);
        let step = parts.factored.solve(graph, &residual);
        let [real, drawn] =
            magnitudes(graph, spec).map(|magnitudes| RealNodes::new(graph, spec, causes, &magnitudes));
        let displaced = RealNodes::displaced(graph, spec, errors);
        Self {
            passive_home,
            home: home(&spec.variables),
            continuation,
            step,
            real,
            drawn,
            displaced,
            passive: (0..spec.passive.len()).map(|i| graph.symbol(Symbol::Local(i))).collect(),
        }
    }
}

impl RealNodes {
    /// Returns the machine with the errors of sources, each times its magnitude.
    fn new(graph: &mut Graph, spec: &Spec, causes: &Causes, magnitudes: &[Node]) -> Self {
        let mut causes = causes.clone();
        let mut errors = Vec::new();
        let one = graph.constant(1.0);
        let of_errors = causes.errors.iter_mut().flat_map(|placed| {
            let magnitude = magnitudes[placed.source];
            placed.errors.iter_mut().map(move |error| (magnitude, error))
        });
        let of_numbers = causes
            .deviations
            .iter_mut()
            .map(|deviation| (magnitudes[deviation.source], &mut deviation.error));
        for (magnitude, error) in of_errors.chain(of_numbers) {
            *error = graph.mul(magnitude, *error);
            // Without loops nothing is repeated, and errors need no array.
            if !spec.loops.is_empty() && graph.value(*error).is_none() {
                errors.push(*error);
                *error = graph.symbol(Symbol::Local(spec.passive.len() + errors.len() - 1));
            }
        }
        let chain = RealChain::new(graph, spec, &causes, vec![one; magnitudes.len()]);
        Self::of_chain(graph, spec, &chain, errors)
    }

    /// Returns the machine with given errors of its frames.
    fn displaced(graph: &mut Graph, spec: &Spec, errors: &[[Node; 6]]) -> Self {
        let placed = |(frame, errors): (usize, &[Node; 6])| PlacedErrors {
            source: 0,
            frame,
            place: None,
            of_base: None,
            errors: *errors,
        };
        let errors = errors.iter().enumerate().map(placed).collect();
        let causes = Causes { errors, deviations: Vec::new() };
        let one = graph.constant(1.0);
        let chain = RealChain::new(graph, spec, &causes, vec![one]);
        Self::of_chain(graph, spec, &chain, Vec::new())
    }

    /// Returns `true` if the errors move the passive variables from their nominal values.
    pub(crate) fn moves_passive(&self, nominal: &ClosedLoops) -> bool {
        self.step != nominal.step
    }

    fn of_chain(graph: &mut Graph, spec: &Spec, chain: &RealChain<'_>, errors: Vec<Node>) -> Self {
        let poses = chain.poses(graph);
        let mut residual = Vec::new();
        for closed in &spec.loops {
            let ends = Ends::new(spec, closed);
            let poses = chain.poses_below(graph, ends.root(spec));
            let identity = graph.identity();
            let length = match &closed.closure {
                Closure::Distance(length) => Some(chain.length(graph, length)),
                Closure::Coordinates(_) => None,
            };
            let pose = |frame: Option<usize>| frame.map_or(identity, |frame| poses[frame]);
            residual.extend(closure::residual(graph, ends, &closed.closure, length, pose));
        }
        let columns = (0..spec.passive.len()).map(|i| graph.diff_all(&residual, Symbol::Local(i))).collect();
        let step = Factored::new(graph, columns).solve(graph, &residual);
        Self { errors, step, pose: poses[poses.len() - 1] }
    }
}
