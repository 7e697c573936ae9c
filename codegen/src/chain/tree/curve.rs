//! The tool point of a machine with loops while its errors grow.
//!
//! With t times the errors, the passive variables are r(t), where `φ(r(t), t) = 0`. Along
//! `r + τ r′ + τ²/2 r″` and `t + τ`, the derivatives by τ at 0 give the linear equations
//!
//! ```text
//! d/dτ φ = φ_r r′ + φ_t = 0        d²/dτ² φ = φ_r r″ + (terms in r and r′) = 0
//! ```
//!
//! for r′ and r″, and in the same way `p″(t)` of the tool point.

use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::loops::RealNodes;
use super::parts::Parts;
use super::units::Units;
use crate::chain::kinematics::of_repeatable;
use crate::chain::remainder::Implicit;
use crate::chain::sources::Causes;
use crate::graph::{Graph, Node, Vector};

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
