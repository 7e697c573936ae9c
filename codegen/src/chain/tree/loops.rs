//! Newton's steps that close the loops, of the nominal machine and with errors.
//!
//! The tool point moves while the errors grow. With t times the errors, the passive variables are
//! r(t), where `φ(r(t), t) = 0`. Along `r + τ r′ + τ²/2 r″` and `t + τ`, the derivatives by τ at 0
//! give the linear equations
//!
//! ```text
//! d/dτ φ = φ_r r′ + φ_t = 0        d²/dτ² φ = φ_r r″ + (terms in r and r′) = 0
//! ```
//!
//! for r′ and r″, and in the same way `p″(t)` of the tool point.

use abbe_spec::{Spec, Symbol};

use super::Parts;
use super::closure::{self, Ends};
use super::factored::Factored;
use super::system::LoopSystem;
use super::units::{Units, at_home, passive_at_home};
use crate::chain::kinematics::{magnitudes, of_repeatable};
use crate::chain::{Causes, Implicit, PlacedErrors, RealChain};
use crate::graph::{Frame, Graph, Node, Six, Vector};

/// Nodes that close the loops. Passive variables are local symbols, from 0.
#[derive(Clone, Debug)]
pub(crate) struct ClosedLoops {
    /// Values of the passive variables at home, from which they are found.
    pub(crate) passive_home: Vec<f64>,
    /// Values of the joint variables at home.
    pub(super) home: Vec<f64>,
    /// Nominal values of the parameters.
    pub(super) parameters: Vec<f64>,
    /// Limits of the passive variables.
    pub(super) limits: Vec<[f64; 2]>,
    pub(super) units: Units,
    /// The nominal machine.
    pub(crate) nominal: LoopSystem,
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
    /// The loops with these errors; without equations if there are no loops.
    pub(crate) system: LoopSystem,
    /// Pose of the tool point.
    pub(crate) pose: Frame,
}

impl ClosedLoops {
    pub(in crate::chain) fn new(
        graph: &mut Graph,
        spec: &Spec,
        parts: &Parts<'_>,
        causes: &Causes,
        errors: &[Six],
    ) -> Self {
        let units = Units::new(spec, graph);
        let equations = [parts.residual(graph), parts.upright(graph)];
        let step = parts.factored.solve(graph, &equations[0]);
        let passive_home = passive_at_home(spec, graph, &equations[0], &step, &units);
        let nominal = LoopSystem::new(graph, equations, &parts.factored, at_home(spec, &passive_home));
        let [real, drawn] = magnitudes(graph, spec)
            .map(|magnitudes| RealNodes::new(graph, spec, causes, &magnitudes, &units, &passive_home));
        let displaced = RealNodes::displaced(graph, spec, errors, &units, &passive_home);
        Self {
            home: spec.variables.iter().map(|variable| variable.home).collect(),
            parameters: spec.parameters.iter().map(|parameter| parameter.value).collect(),
            limits: spec.passive.iter().map(|variable| variable.limits).collect(),
            passive_home,
            units,
            nominal,
            real,
            drawn,
            displaced,
            passive: (0..spec.passive.len()).map(|i| graph.symbol(Symbol::Local(i))).collect(),
        }
    }
}

impl RealNodes {
    /// Returns the machine with the errors of sources, each times its magnitude.
    pub(super) fn new(
        graph: &mut Graph,
        spec: &Spec,
        causes: &Causes,
        magnitudes: &[Node],
        units: &Units,
        passive_home: &[f64],
    ) -> Self {
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
            // Without loops nothing is repeated, and errors need no array; others grow along a
            // path.
            if !spec.loops.is_empty() && *error != graph.zero() {
                errors.push(*error);
                *error = graph.symbol(Symbol::Local(spec.passive.len() + errors.len() - 1));
            }
        }
        let chain = RealChain::new(graph, spec, &causes, vec![one; magnitudes.len()]);
        Self::of_chain(graph, spec, &chain, errors, units, passive_home)
    }

    /// Returns the machine with given errors of its frames.
    fn displaced(
        graph: &mut Graph,
        spec: &Spec,
        errors: &[Six],
        units: &Units,
        passive_home: &[f64],
    ) -> Self {
        let placed = |(frame, errors): (usize, &Six)| PlacedErrors {
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
        Self::of_chain(graph, spec, &chain, Vec::new(), units, passive_home)
    }

    /// Returns `true` if the errors move the passive variables from their nominal values.
    pub(crate) fn moves_passive(&self, nominal: &ClosedLoops) -> bool {
        self.system.residual != nominal.nominal.residual
    }

    fn of_chain(
        graph: &mut Graph,
        spec: &Spec,
        chain: &RealChain<'_>,
        errors: Vec<Node>,
        units: &Units,
        passive_home: &[f64],
    ) -> Self {
        let poses = chain.poses(graph);
        let (mut residual, mut upright) = (Vec::new(), Vec::new());
        for closed in &spec.loops {
            let ends = Ends::new(spec, closed);
            let poses = chain.poses_below(graph, ends.root(spec));
            let identity = graph.identity();
            let length = closed.closure.length().map(|length| chain.length(graph, length));
            let pose = |frame: Option<usize>| frame.map_or(identity, |frame| poses[frame]);
            residual.extend(closure::residual(graph, ends, &closed.closure, length, pose));
            upright.extend(closure::upright(graph, ends, &closed.closure, pose));
        }
        let columns = (0..spec.passive.len()).map(|i| graph.diff_all(&residual, Symbol::Local(i))).collect();
        let factored = Factored::new(graph, columns, units);
        let system = LoopSystem::new(graph, [residual, upright], &factored, at_home(spec, passive_home));
        Self { errors, system, pose: poses[poses.len() - 1] }
    }
}

/// Symbol of τ.
const ALONG: Symbol = Symbol::Magnitude(1);

/// Returns `p″(t)` of the tool point with the share t of the repeatable errors, and what defines
/// the symbols that it reads; `None` if the equations or the point may have kinks.
pub(crate) fn curvature(
    graph: &mut Graph,
    spec: &Spec,
    causes: &Causes,
    share: Symbol,
    given: &[usize],
) -> Option<(Vector, Vec<Implicit>)> {
    let count = spec.passive.len();
    let (_, mut implicit, home) = Parts::implicit(graph, spec, given);
    implicit.truncate(1);
    let [t, tau, half, one] =
        [graph.symbol(share), graph.symbol(ALONG), graph.constant(0.5), graph.constant(1.0)];
    let (t, square) = (graph.add(t, tau), graph.mul(tau, tau));
    let square = graph.mul(half, square);
    let (zero, units) = (graph.zero(), Units::new(spec, graph));
    // Errors are symbols of their own where there are loops.
    let magnitudes = of_repeatable(spec, if count > 0 { one } else { t }, zero);
    let real = RealNodes::new(graph, spec, causes, &magnitudes, &units, &home);

    let first = count + real.errors.len();
    let names = |kind: usize| (0..count).map(move |i| Symbol::Local(first + kind * count + i));
    let mut others: Vec<Node> = Vec::with_capacity(first);
    for ((r, r1), r2) in names(0).zip(names(1)).zip(names(2)) {
        let [r, r1, r2] = [r, r1, r2].map(|symbol| graph.symbol(symbol));
        let (r1, r2) = (graph.mul(tau, r1), graph.mul(square, r2));
        let moved = graph.add(r, r1);
        others.push(graph.add(moved, r2));
    }
    others.extend(real.errors.iter().map(|error| graph.mul(t, *error)));
    let nodes = [&real.system.residual[..], &real.pose.position].concat();
    let other = |symbol| match symbol {
        Symbol::Local(i) => others.get(i).copied(),
        _ => None,
    };
    let moved = graph.substitute(&nodes, other);
    if moved.iter().any(|node| graph.may_have_kinks(*node, |symbol| symbol == ALONG)) {
        return None;
    }
    let once = graph.diff_all(&moved, ALONG);
    let twice = graph.diff_all(&once, ALONG);
    let still = graph.substitute(&[moved, once, twice].concat(), |symbol| (symbol == ALONG).then_some(zero));
    let mut by_order = still.chunks(nodes.len());
    let [at, once, twice] = [(); 3].map(|()| by_order.next().unwrap_or_default());
    if count > 0 {
        let columns: Vec<_> = names(0).map(|r| graph.diff_all(&at[..count], r)).collect();
        let homes = [Some(home), None, None];
        for (kind, (residual, home)) in [at, once, twice].into_iter().zip(homes).enumerate() {
            let sets = vec![(names(kind).collect(), residual[..count].to_vec())];
            implicit.push(Implicit { sets, columns: columns.clone(), home });
        }
    }
    Some((std::array::from_fn(|axis| twice[count + axis]), implicit))
}
