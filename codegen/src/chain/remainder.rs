//! Remainder of the first-order prediction, as a node to be maximized.

use abbe_spec::{Spec, Symbol};

use super::{Implicit, Magnitude, RealChain, kinematics::of_repeatable, sources, tree::curvature};
use crate::graph::Graph;

/// Remainder of the tool point's position after `J_e ε` of the repeatable sources.
///
/// With t times their errors, the exact chain has the tool point at p(t), and `p'(0)` is `J_e ε`.
/// Hence
///
/// ```text
/// p(1) − p(0) − J_e ε  =  ∫₀¹ (1 − t) p″(t) dt        which is no longer than ½ ‖p″(t)‖ is anywhere in 0 ≤ t ≤ 1
/// ```
#[derive(Clone, Debug)]
pub struct Remainder {
    /// The graph of the node.
    pub graph: Graph,
    /// ½ ‖p″(t)‖.
    pub magnitude: Magnitude,
    /// t.
    pub share: Symbol,
    /// Unknowns that the loops determine; the nodes read them as symbols.
    pub implicit: Vec<Implicit>,
}

impl Remainder {
    /// Builds the remainder of a checked spec, as a function of the joint variables, or of the
    /// passive ones that are `given`. Returns `None` if p(t) may have kinks, which its derivatives
    /// do not show.
    pub fn new(spec: &Spec, given: &[usize]) -> Option<Self> {
        let (mut graph, _, causes) = sources::effects_and_causes(spec);
        let g = &mut graph;
        let share = Symbol::Magnitude(0);
        let half = g.constant(0.5);
        let (curvature, implicit) = match spec.is_serial() {
            true => {
                let [t, zero] = [g.symbol(share), g.zero()];
                let magnitudes = of_repeatable(spec, t, zero);
                let point = RealChain::new(g, spec, &causes, magnitudes).tool_point_from_first_error(g);
                if point.iter().any(|node| g.may_have_kinks(*node, |symbol| symbol == share)) {
                    return None;
                }
                let speed = g.diff_all(&point, share);
                let curvature = g.diff_all(&speed, share);
                (<[_; 3]>::try_from(curvature).expect("three parts"), Vec::new())
            }
            false => curvature(g, spec, &causes, share, given)?,
        };
        let half_curvature = g.scale(half, curvature);
        let magnitude = Magnitude::length(g, half_curvature);
        Some(Self { graph, magnitude, share, implicit })
    }
}
